//! Shape → [`Solid`] in scene coordinates, with its mass properties at unit density.

use super::{check, origin::Origin, prism};
use crate::assembly::{MassProperties, Mend, Polyhedron, Solid, clump};
use base::error::{InputError, JsonPath};
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use scene::{BlockSpec, Shape};
use std::f64::consts::PI;

/// The motion of a block's own frame: x ↦ R x + t.
pub(super) struct Frame {
    turn: Option<Rotation3<f64>>,
    shift: Vector3<f64>,
}

impl Frame {
    pub(super) fn new(spec: &BlockSpec, place: &Origin) -> Result<Self, InputError> {
        let shift = place.check(check::vector(spec.at, &JsonPath::root().key("at")))?;
        let turn = match &spec.rotation_deg {
            None => None,
            Some(rotation) => {
                let path = JsonPath::root().key("rotation_deg");
                let axis = place.check(check::direction(rotation.axis, &path.key("axis")))?;
                let angle = place.check(check::finite(rotation.angle, &path.key("angle")))?;
                Some(Rotation3::from_axis_angle(&Unit::new_unchecked(axis), angle.to_radians()))
            }
        };
        Ok(Self { turn, shift })
    }

    fn properties(&self, own: MassProperties) -> MassProperties {
        let inertia = self.turn.map_or(own.inertia, |turn| turn * own.inertia * turn.inverse());
        MassProperties { centroid: self.apply(own.centroid), inertia, ..own }
    }

    /// The point of the block's own frame that lies at a point of the scene.
    fn back(&self, point: Vector3<f64>) -> Vector3<f64> {
        let moved = point - self.shift;
        self.turn.map_or(moved, |turn| turn.inverse() * moved)
    }

    pub(super) fn apply(&self, point: Vector3<f64>) -> Vector3<f64> {
        self.turn.map_or(point, |turn| turn * point) + self.shift
    }
}

/// A block's geometry.
pub(super) struct Geometry {
    pub(super) solid: Solid,
    pub(super) properties: MassProperties,
    pub(super) size: f64,
    pub(super) mended: Vec<Mend>,
}

/// Where the other blocks are, as far as a block has to know.
#[derive(Clone, Copy)]
pub(super) struct Around {
    /// The middle of the free blocks, more or less, m.
    pub(super) free: Vector3<f64>,
    /// The box around all blocks that have bounds, m.
    pub(super) bounds: Option<(Vector3<f64>, Vector3<f64>)>,
}

/// The geometry of a block in scene coordinates.
pub(super) fn body(
    spec: &BlockSpec,
    frame: &Frame,
    place: &Origin,
    around: Around,
) -> Result<Geometry, InputError> {
    let path = JsonPath::root().key("shape");
    match &spec.shape {
        Shape::Sphere { radius } => {
            let radius =
                place.check(check::positive(*radius, &path.key("sphere").key("radius"), "m"))?;
            let volume = 4.0 / 3.0 * PI * radius.powi(3);
            let center = frame.apply(Vector3::zeros());
            let inertia = Matrix3::identity() * (0.4 * volume * radius * radius);
            let properties = MassProperties { volume, centroid: center, inertia };
            Ok(Geometry {
                solid: Solid::Sphere { center, radius },
                properties,
                size: 2.0 * radius * 3f64.sqrt(),
                mended: Vec::new(),
            })
        }
        Shape::Clump { spheres } => {
            let path = path.key("clump").key("spheres");
            if spheres.is_empty() {
                let hint = "for example { \"at\": [0, 0, 0], \"radius\": 1 }";
                return place.check(Err(
                    InputError::at(path, "a clump needs at least one sphere").hint(hint)
                ));
            }
            if spheres.len() > clump::MOST {
                let text =
                    format!("a clump has at most {} spheres, got {}", clump::MOST, spheres.len());
                return place
                    .check(Err(InputError::at(path, text).hint("give the block a simpler shape")));
            }
            for (k, ball) in spheres.iter().enumerate() {
                place.check(check::vector(ball.at, &path.index(k).key("at")))?;
                place.check(check::positive(ball.radius, &path.index(k).key("radius"), "m"))?;
            }
            // In the block's own frame, so that turning it changes nothing but the frame.
            let own: Vec<(Vector3<f64>, f64)> =
                spheres.iter().map(|b| (Vector3::from(b.at), b.radius)).collect();
            let properties = frame.properties(clump::mass_properties(&own));
            let balls: Vec<_> = own.into_iter().map(|(c, r)| (frame.apply(c), r)).collect();
            let ends: Vec<_> =
                balls.iter().flat_map(|(c, r)| [c.add_scalar(-r), c.add_scalar(*r)]).collect();
            if ends.iter().any(|v| v.iter().any(|x| !x.is_finite())) {
                return place.check(Err(InputError::at(
                    path,
                    "the coordinates are too large to compute",
                )
                .hint("lengths are in m")));
            }
            let size = diagonal(&ends);
            Ok(Geometry {
                solid: Solid::Clump { balls, volume: properties.volume },
                properties,
                size,
                mended: Vec::new(),
            })
        }
        shape => {
            let mut file = None;
            let (kind, vertices, faces) = match shape {
                Shape::Cuboid { size } => {
                    let path = path.key("box").key("size");
                    for (k, x) in size.iter().enumerate() {
                        place.check(check::positive(
                            *x,
                            &path.index(k),
                            "full lengths along x, y, z in m",
                        ))?;
                    }
                    let (vertices, faces) = cuboid(*size);
                    ("box", vertices, faces)
                }
                Shape::Prism { polygon, depth } => {
                    let path = path.key("prism");
                    place.check(check::positive(
                        *depth,
                        &path.key("depth"),
                        "length along y in m",
                    ))?;
                    let path = path.key("polygon");
                    for (k, corner) in polygon.iter().enumerate() {
                        for (c, x) in corner.iter().enumerate() {
                            place.check(check::finite(*x, &path.index(k).index(c)))?;
                        }
                    }
                    let (vertices, faces) = place.check(prism::faces(polygon, *depth, &path))?;
                    ("prism", vertices, faces)
                }
                Shape::Polyhedron { vertices, faces } => {
                    place.check(surface(vertices, faces, &path.key("polyhedron")))?;
                    ("polyhedron", vertices.iter().map(|&v| v.into()).collect(), faces.clone())
                }
                Shape::Mesh { path: name, scale, vertices, faces } => {
                    let path = path.key("mesh");
                    let scale = place.check(check::positive(
                        *scale,
                        &path.key("scale"),
                        "0.001 for a file in millimetres",
                    ))?;
                    if vertices.is_empty() && faces.is_empty() {
                        let error = InputError::at(
                            path.key("path"),
                            format!("the file {name:?} was not read"),
                        );
                        return place.check(Err(
                            error.hint("read the files of a scene with import::read_meshes, or give \"vertices\" and \"faces\"")
                        ));
                    }
                    place.check(surface(vertices, faces, &path))?;
                    file = Some(name);
                    (
                        "mesh",
                        vertices.iter().map(|&v| Vector3::from(v) * scale).collect(),
                        faces.clone(),
                    )
                }
                Shape::Plane { normal } => {
                    let path = path.key("plane");
                    if !spec.support {
                        return place.check(Err(InputError::at(
                            path,
                            "a plane cannot be a free block",
                        )
                        .hint("add \"support\": true, or give the block a \"box\"")));
                    }
                    let normal = place.check(check::direction(*normal, &path.key("normal")))?;
                    let (vertices, faces) = slab(frame, normal, around.bounds);
                    ("plane", vertices, faces)
                }
                #[expect(
                    clippy::unreachable,
                    reason = "balls are handled before the match, which the compiler cannot see"
                )]
                Shape::Sphere { .. } | Shape::Clump { .. } => {
                    unreachable!("spheres are handled above")
                }
            };
            let path = path.key(kind);
            let vertices: Vec<Vector3<f64>> =
                vertices.into_iter().map(|v| frame.apply(v)).collect();
            if vertices.iter().any(|v| v.iter().any(|x| !x.is_finite())) {
                return place.check(Err(InputError::at(
                    path,
                    "the coordinates are too large to compute",
                )
                .hint("lengths are in m")));
            }
            let made = match spec.support {
                true => Polyhedron::of_support(vertices, &faces, around.free),
                false => Polyhedron::from_faces(vertices, &faces),
            };
            let (polyhedron, mended) = place.check(made.map_err(|e| {
                let told = file.map_or_else(|| e.to_string(), |file| format!("{file}: {e}"));
                InputError::at(path, told).hint(e.hint())
            }))?;
            let size = diagonal(&polyhedron.vertices);
            let properties = polyhedron.mass_properties();
            Ok(Geometry { solid: Solid::Polyhedron(polyhedron), properties, size, mended })
        }
    }
}

/// The bounding-box diagonal of some points.
pub(super) fn diagonal(points: &[Vector3<f64>]) -> f64 {
    let Some(first) = points.first() else { return 0.0 };
    let (low, high) = points.iter().fold((*first, *first), |(l, h), p| (l.inf(p), h.sup(p)));
    (high - low).norm()
}

/// How far the slab of a plane reaches from the middle of the other blocks, × the half diagonal of
/// the box around them. Below 1 a block could stand beside it; far above, pictures show little but
/// ground.
const REACH: f64 = 3.0;

/// How thick it is, × that distance. Blocks touch its face alone.
const DEPTH: f64 = 0.1;

/// A plane as a slab in its own frame, below all that has bounds in scene coordinates.
fn slab(
    frame: &Frame,
    normal: Vector3<f64>,
    bounds: Option<(Vector3<f64>, Vector3<f64>)>,
) -> prism::Surface {
    let (middle, half) = bounds
        .map_or((frame.shift, 1.0), |(low, high)| (0.5 * (low + high), 0.5 * (high - low).norm()));
    let middle = frame.back(middle);
    let middle = middle - normal * middle.dot(&normal);
    let reach = REACH * half;
    let turn = Rotation3::rotation_between(&Vector3::z(), &normal)
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), PI));
    let (vertices, faces) = cuboid([2.0 * reach, 2.0 * reach, DEPTH * reach]);
    let below = Vector3::z() * (0.5 * DEPTH * reach);
    (vertices.into_iter().map(|v| middle + turn * (v - below)).collect(), faces)
}

fn cuboid(size: [f64; 3]) -> prism::Surface {
    // Bit k of the index is the side along axis k.
    let side = |i: usize, k: usize| if i >> k & 1 == 1 { 0.5 } else { -0.5 };
    let vertices = (0..8).map(|i| Vector3::from_fn(|k, _| side(i, k) * size[k])).collect();
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (vertices, faces.iter().map(|f| f.to_vec()).collect())
}

/// Refuses coordinates that are not finite, and faces as [`indices`].
fn surface(vertices: &[[f64; 3]], faces: &[Vec<usize>], path: &JsonPath) -> Result<(), InputError> {
    for (k, x) in vertices.iter().enumerate().filter(|(_, x)| x.iter().any(|c| !c.is_finite())) {
        check::vector(*x, &path.key("vertices").index(k))?;
    }
    indices(vertices.len(), faces, &path.key("faces"))
}

/// Refuses faces that are no polygons over the vertices there are.
fn indices(vertices: usize, faces: &[Vec<usize>], path: &JsonPath) -> Result<(), InputError> {
    for (j, face) in faces.iter().enumerate() {
        if face.len() < 3 {
            return Err(InputError::at(
                path.index(j),
                format!("a face needs at least 3 vertices, got {}", face.len()),
            ));
        }
        if let Some((k, &index)) = face.iter().enumerate().find(|&(_, &index)| index >= vertices) {
            return Err(InputError::at(
                path.index(j).index(k),
                format!("vertex {index} does not exist: the shape has {vertices} vertices"),
            )
            .hint("vertices are counted from 0"));
        }
    }
    Ok(())
}
