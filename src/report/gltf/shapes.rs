//! Blocks, lines of thrust and members as nodes with meshes.

use super::buffer::{Buffer, VERTICES};
use crate::{
    view::{BlockView, Surface, View, ViewShape},
    vtk::ball,
};
use nalgebra::{UnitQuaternion, Vector3};
use serde_json::{Value, json};

/// Colours of stone that take turns, one a material; linear red, green, blue.
const STONES: [[f64; 3]; 6] = [
    [0.64, 0.54, 0.39],
    [0.34, 0.46, 0.57],
    [0.54, 0.34, 0.27],
    [0.39, 0.51, 0.32],
    [0.52, 0.41, 0.57],
    [0.27, 0.32, 0.39],
];
const SUPPORT: [f64; 3] = [0.40, 0.42, 0.45];
const THRUST: [f64; 3] = [0.003, 0.12, 0.39];
const MEMBER: [f64; 3] = [0.0, 0.14, 0.11];
/// Halvings of the octahedron that a ball is drawn as.
const BALL: usize = 3;

/// The turn that brings what is up in the scene to y.
pub(super) fn upright(view: &View) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between(&view.ground, &Vector3::y()).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    })
}

/// A point of the scene in the coordinates of the file; to the last digit where z is up.
fn in_file(view: &View, p: Vector3<f64>) -> [f64; 3] {
    if view.ground == Vector3::z() {
        return [p.x, p.z, 0.0 - p.y];
    }
    (upright(view) * p).into()
}

/// The shape of a block in double precision, and its centre of mass.
fn exact(body: &BlockView, place: &dyn Fn(Vector3<f64>) -> [f64; 3]) -> Value {
    let spheres = |list: &[(Vector3<f64>, f64)]| -> Vec<Value> {
        list.iter().map(|(c, r)| json!({ "at": place(*c), "radius": r })).collect()
    };
    let centroid = place(body.center);
    match &body.shape {
        ViewShape::Sphere(radius) => json!({ "spheres": spheres(&[(body.center, *radius)]) }),
        ViewShape::Surface(s) if !s.balls.is_empty() => {
            json!({ "spheres": spheres(&s.balls), "centroid": centroid })
        }
        ViewShape::Surface(s) => {
            let vertices: Vec<[f64; 3]> = s.corners.iter().map(|c| place(*c)).collect();
            json!({ "vertices": vertices, "faces": s.pieces, "centroid": centroid })
        }
    }
}

/// What there is to draw; nodes in the order of the blocks, then lines.
pub(super) struct Shapes {
    pub(super) nodes: Vec<Value>,
    pub(super) meshes: Vec<Value>,
    pub(super) materials: Vec<Value>,
    /// The node of each block, the root being 0; none for supports that are left out.
    pub(super) node_of: Vec<Option<usize>>,
}

impl Shapes {
    pub(super) fn of(view: &View, buffer: &mut Buffer) -> Self {
        let mut shapes = Self {
            nodes: Vec::new(),
            meshes: Vec::new(),
            materials: Vec::new(),
            node_of: Vec::new(),
        };
        let mut names: Vec<Option<&str>> = Vec::new();
        // One ball a material, which nodes scale.
        let mut balls: Vec<(usize, usize)> = Vec::new();
        for body in &view.bodies {
            if body.support && view.hides_supports {
                shapes.node_of.push(None);
                continue;
            }
            let key =
                if body.support { None } else { Some(body.material.as_deref().unwrap_or("")) };
            let material = names.iter().position(|n| *n == key).unwrap_or_else(|| {
                names.push(key);
                let stones = names.iter().flatten().count().saturating_sub(1);
                let (name, colour) = match key {
                    None => ("support", SUPPORT),
                    Some("") => ("stone", STONES[stones % STONES.len()]),
                    Some(name) => (name, STONES[stones % STONES.len()]),
                };
                shapes.material(name, colour, false)
            });
            let at = body.center - view.middle();
            let mut node = json!({
                "name": body.id,
                "translation": at.as_slice(),
                "extras": {
                    "support": body.support,
                    "mass_kg": body.mass,
                    "material": body.material,
                    "exact": exact(body, &|p| in_file(view, p)),
                },
            });
            let mesh = match &body.shape {
                ViewShape::Surface(surface) => shapes.surface(body, surface, material, buffer),
                ViewShape::Sphere(radius) => {
                    node["scale"] = json!([radius, radius, radius]);
                    match balls.iter().find(|b| b.0 == material) {
                        Some(known) => known.1,
                        None => {
                            let mesh = shapes.ball(material, buffer);
                            balls.push((material, mesh));
                            mesh
                        }
                    }
                }
            };
            node["mesh"] = mesh.into();
            shapes.nodes.push(node);
            shapes.node_of.push(Some(shapes.nodes.len()));
        }
        shapes.lines(view, buffer);
        shapes
    }

    fn material(&mut self, name: &str, [r, g, b]: [f64; 3], line: bool) -> usize {
        let mut material = json!({
            "name": name,
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.9,
            },
        });
        // Lines have no normals to be lit by.
        if line {
            material["emissiveFactor"] = json!([r, g, b]);
        }
        self.materials.push(material);
        self.materials.len() - 1
    }

    fn mesh(&mut self, name: &str, primitive: Value) -> usize {
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        self.meshes.len() - 1
    }

    /// Plane pieces as fans about the centre of mass, each with its own normal: edges stay sharp.
    fn surface(
        &mut self,
        body: &BlockView,
        s: &Surface,
        material: usize,
        buffer: &mut Buffer,
    ) -> usize {
        let (mut points, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
        for piece in &s.pieces {
            let first = points.len() as u32;
            let corner = |k: usize| s.corners[piece[k] as usize] - body.center;
            let normal: Vector3<f64> = (1..piece.len().saturating_sub(1))
                .map(|k| (corner(k) - corner(0)).cross(&(corner(k + 1) - corner(0))))
                .sum();
            // Slivers without an area have no normal, and nothing to show.
            let Some(normal) = normal.try_normalize(0.0) else { continue };
            points.extend((0..piece.len()).map(corner));
            normals.extend(piece.iter().map(|_| normal));
            for k in 1..piece.len() as u32 - 1 {
                indices.extend([first, first + k, first + k + 1]);
            }
        }
        let primitive = json!({
            "attributes": {
                "POSITION": buffer.vectors(&points, Some(VERTICES)),
                "NORMAL": buffer.vectors(&normals, Some(VERTICES)),
            },
            "indices": buffer.indices(&indices),
            "material": material,
        });
        self.mesh(&body.id, primitive)
    }

    fn ball(&mut self, material: usize, buffer: &mut Buffer) -> usize {
        let (points, faces) = ball(BALL);
        let indices: Vec<u32> = faces.into_iter().flatten().collect();
        let at = buffer.vectors(&points, Some(VERTICES));
        let primitive = json!({
            "attributes": { "POSITION": at, "NORMAL": buffer.vectors(&points, Some(VERTICES)) },
            "indices": buffer.indices(&indices),
            "material": material,
        });
        self.mesh("ball", primitive)
    }

    /// Lines of thrust, one node a system of forces, and members, one node each.
    fn lines(&mut self, view: &View, buffer: &mut Buffer) {
        let mut list: Vec<(String, Vec<Vector3<f64>>, bool, Value)> = Vec::new();
        for state in view.states.iter().filter(|s| s.balances) {
            let ends = state.line.iter().flat_map(|s| [s.from, s.to]).collect();
            list.push((format!("line of thrust: {}", state.name), ends, false, json!({})));
        }
        for member in &view.members {
            let ends = member.points.windows(2).flat_map(|w| [w[0], w[1]]).collect();
            let extras = json!({ "kind": member.kind.word(), "force_N": member.force, "slack": member.slack });
            list.push((format!("member {}", member.id), ends, true, extras));
        }
        let mut inks = [None; 2];
        for (name, ends, member, extras) in list.into_iter().filter(|l| !l.1.is_empty()) {
            let (title, colour) =
                if member { ("members", MEMBER) } else { ("lines of thrust", THRUST) };
            let kind = usize::from(member);
            let material = match inks[kind] {
                Some(known) => known,
                None => *inks[kind].insert(self.material(title, colour, true)),
            };
            let points: Vec<Vector3<f64>> = ends.iter().map(|p| p - view.middle()).collect();
            let at = buffer.vectors(&points, Some(VERTICES));
            let primitive =
                json!({ "attributes": { "POSITION": at }, "mode": 1, "material": material });
            let mesh = self.mesh(&name, primitive);
            self.nodes.push(json!({ "name": name, "mesh": mesh, "extras": extras }));
        }
    }
}
