//! glTF 2.0, as text and binary: a node with triangles is a block. Properties of a block are in the `extras`
//! of its node: `support`, `mass_kg`, `density`, `material`.
//!
//! Positions are single precision. Our own exports have the exact shape in the extras, which is taken where
//! it is still what is drawn. The keys needed are read here and not by the crate `gltf`, which keeps places
//! of nodes in single precision and panics where accessors are damaged.
//!
//! Khronos Group, *glTF 2.0 Specification* (ISO/IEC 12113:2022).

mod buffers;
mod document;

use super::{
    Up,
    raw::{Grain, Heft, Raw, Solid, tally},
    rigid,
    text::shorten,
};
use crate::Material;
use base::{
    error::{FindingCode, InputError, JsonPath},
    tolerance::DEFAULT_DENSITY,
};
use buffers::Buffers;
use document::{Document, Node};
use nalgebra::{Matrix3, Matrix4, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::{collections::HashMap, path::Path};

/// Extensions that change nothing of what is read here. Others that a file requires are refused.
const HARMLESS: [&str; 4] =
    ["KHR_mesh_quantization", "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp"];

/// An exact shape is what is drawn where their corners agree within this × the size of the block, and …
/// Larger: small changes in another program are lost. Smaller: rounding to single precision is taken for a
/// change.
const DRAWN: f64 = 1e-5;
/// … within this × the largest coordinate, which programs round as well.
const DRAWN_FAR: f64 = 1e-6;

/// The exact shape of a block, in the coordinates of the file, m.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Exact {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
    spheres: Vec<Sphere>,
    centroid: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct Sphere {
    at: [f64; 3],
    radius: f64,
}

/// A node as it is drawn, in the coordinates of the file.
struct Drawn {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
    material: Option<String>,
}

/// What is told, with the nodes.
#[derive(Default)]
struct Notes {
    exact: Vec<String>,
    changed: Vec<String>,
    lines: Vec<String>,
    several: Vec<String>,
    odd: Vec<String>,
}

fn fault(what: impl Into<String>) -> InputError {
    InputError::at(JsonPath::root(), what).hint("the file is damaged; export it again")
}

/// The blocks of a file; `folder` holds its buffers.
pub(super) fn read(bytes: &[u8], folder: Option<&Path>) -> Result<Raw, InputError> {
    let (document, inside) = document::read(bytes)?;
    let is_unknown = |e: &&String| !HARMLESS.contains(&e.as_str()) && !e.contains("_materials_");
    if let Some(name) = document.extensions_required.iter().find(is_unknown) {
        let text = format!("the extension {:?} is required, and not read", shorten(name));
        return Err(InputError::at(JsonPath::root(), text)
            .hint("export without it (without compression of meshes)"));
    }
    let buffers = Buffers::read(&document, inside, folder)?;
    let mut raw = Raw { up: Some(Up::Y), ..Raw::default() };
    let mut notes = Notes::default();
    let mut copied = 0;
    for (number, pose) in placed(&document)? {
        let node = &document.nodes[number];
        let extras = extras(node);
        if let Some(gravity) = extras.get("gravity_m_s2").and_then(Value::as_f64)
            && gravity.is_finite()
        {
            raw.gravity = Some([0.0, -gravity, 0.0]);
        }
        let Some(mesh) = node.mesh else { continue };
        let Some(drawn) = drawn(&document, &buffers, mesh, &pose, &mut notes)? else { continue };
        // A thousand nodes may draw one mesh: each has its own copy.
        copied += 24 * drawn.vertices.len() + 48 * drawn.faces.len();
        base::limits::afford("the meshes up to this one", copied as u64, 4)?;
        block(node, number, &document, drawn, &extras, &mut raw, &mut notes);
    }
    tell(&document, notes, &mut raw);
    raw.name_apart("node");
    raw.say_parts();
    Ok(raw)
}

/// Nodes of the scene with their poses, in order.
fn placed(document: &Document) -> Result<Vec<(usize, Matrix4<f64>)>, InputError> {
    let scene = document.scenes.get(document.scene.unwrap_or(0));
    let mut open: Vec<(usize, Matrix4<f64>)> = match scene {
        Some(scene) => scene.nodes.iter().rev().map(|k| (*k, Matrix4::identity())).collect(),
        None => {
            let mut is_root = vec![true; document.nodes.len()];
            for child in document.nodes.iter().flat_map(|n| &n.children) {
                if let Some(known) = is_root.get_mut(*child) {
                    *known = false;
                }
            }
            let roots = (0..is_root.len()).rev().filter(|k| is_root[*k]);
            roots.map(|k| (k, Matrix4::identity())).collect()
        }
    };
    let mut seen = vec![false; document.nodes.len()];
    let mut list = Vec::new();
    while let Some((number, above)) = open.pop() {
        let node = document.nodes.get(number);
        let node = node.ok_or_else(|| fault(format!("there is no nodes[{number}]")))?;
        if std::mem::replace(&mut seen[number], true) {
            return Err(fault(format!("nodes[{number}] lies below two others, or below itself")));
        }
        let pose = above * pose(node, number)?;
        list.push((number, pose));
        open.extend(node.children.iter().rev().map(|k| (*k, pose)));
    }
    Ok(list)
}

/// The pose of a node in that above it.
fn pose(node: &Node, number: usize) -> Result<Matrix4<f64>, InputError> {
    let pose = match &node.matrix {
        Some(columns) => Matrix4::from_column_slice(columns),
        None => {
            let [x, y, z] = node.translation.unwrap_or_default();
            let [i, j, k, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
            let turn = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 0.0);
            let turn = turn.ok_or_else(|| fault(format!("nodes[{number}]: rotation of zeros")))?;
            let scale = Vector3::from(node.scale.unwrap_or([1.0; 3]));
            Translation3::new(x, y, z).to_homogeneous()
                * turn.to_homogeneous()
                * Matrix4::new_nonuniform_scaling(&scale)
        }
    };
    match pose.iter().all(|x| x.is_finite()) {
        true => Ok(pose),
        false => Err(fault(format!("nodes[{number}]: its place is not finite"))),
    }
}

/// The triangles of a mesh where they are; none where it has none.
fn drawn(
    document: &Document,
    buffers: &Buffers,
    number: usize,
    pose: &Matrix4<f64>,
    notes: &mut Notes,
) -> Result<Option<Drawn>, InputError> {
    let mesh = document.meshes.get(number);
    let mesh = mesh.ok_or_else(|| fault(format!("there is no meshes[{number}]")))?;
    let mut drawn = Drawn { vertices: Vec::new(), faces: Vec::new(), material: None };
    let mut known: HashMap<[u64; 3], usize> = HashMap::new();
    let linear: Matrix3<f64> = pose.fixed_view::<3, 3>(0, 0).into();
    let is_mirrored = linear.determinant() < 0.0;
    let mut materials = Vec::new();
    for (k, primitive) in mesh.primitives.iter().enumerate() {
        let named = format!("meshes[{number}].primitives[{k}]");
        let mode = primitive.mode.unwrap_or(4);
        if !matches!(mode, 4..=6) {
            notes.lines.push(named);
            continue;
        }
        let Some(position) = primitive.attributes.position else {
            return Err(fault(format!("{named} has no POSITION")));
        };
        let points = buffers.points(position)?;
        let order = match primitive.indices {
            Some(indices) => buffers.indices(indices, points.len())?,
            None => (0..points.len()).collect(),
        };
        // Corners are written once for each face that they are on.
        let place =
            |p: &[f64; 3]| -> [f64; 3] { pose.transform_point(&Point3::from(*p)).coords.into() };
        let numbers: Vec<usize> = points
            .iter()
            .map(place)
            .map(|p| {
                *known.entry(p.map(|c| (c + 0.0).to_bits())).or_insert_with(|| {
                    drawn.vertices.push(p);
                    drawn.vertices.len() - 1
                })
            })
            .collect();
        let mut add = |a: usize, b: usize, c: usize| {
            let [a, b, c] = [a, b, c].map(|i| numbers[order[i]]);
            if a != b && b != c && c != a {
                drawn.faces.push(if is_mirrored { vec![a, c, b] } else { vec![a, b, c] });
            }
        };
        let n = order.len();
        match mode {
            4 => (0..n / 3).for_each(|t| add(3 * t, 3 * t + 1, 3 * t + 2)),
            // Every other triangle of a strip runs the other way.
            5 => (2..n)
                .for_each(|t| if t % 2 == 0 { add(t - 2, t - 1, t) } else { add(t - 1, t - 2, t) }),
            _ => (2..n).for_each(|t| add(0, t - 1, t)),
        }
        let name = primitive.material.and_then(|m| document.materials.get(m)).map(|m| &m.name);
        materials.extend(name.filter(|n| !n.is_empty()).cloned());
    }
    if drawn.faces.is_empty() {
        return Ok(None);
    }
    materials.dedup();
    if materials.len() > 1 {
        notes.several.push(format!("meshes[{number}] {:?}", shorten(&mesh.name)));
    }
    drawn.material = materials.into_iter().next();
    Ok(Some(drawn))
}

/// The properties of a node.
fn extras(node: &Node) -> Map<String, Value> {
    let object = |text: &serde_json::value::RawValue| serde_json::from_str(text.get()).ok();
    node.extras.as_deref().and_then(object).unwrap_or_default()
}

fn block(
    node: &Node,
    number: usize,
    document: &Document,
    drawn: Drawn,
    extras: &Map<String, Value>,
    raw: &mut Raw,
    notes: &mut Notes,
) {
    let of_mesh = node.mesh.and_then(|m| document.meshes.get(m)).map_or("", |m| &m.name);
    let id = if node.name.is_empty() { of_mesh } else { &node.name }.to_string();
    let named = format!("nodes[{number}] {:?}", shorten(&id));
    let positive = |key: &str, notes: &mut Notes| match extras.get(key) {
        None | Some(Value::Null) => None,
        Some(value) => {
            let number = value.as_f64().filter(|v| v.is_finite() && *v > 0.0);
            if number.is_none() {
                notes.odd.push(format!("{named}: {key}"));
            }
            number
        }
    };
    let mass = positive("mass_kg", notes);
    let density = positive("density", notes).filter(|_| mass.is_none());
    let support = match extras.get("support") {
        None | Some(Value::Null) => false,
        Some(Value::Bool(held)) => *held,
        // Programs without words for it write numbers.
        Some(value) => value.as_f64().is_some_and(|v| v != 0.0),
    };
    let material = match extras.get("material") {
        Some(Value::String(name)) => Some(name.clone()),
        // Our own say that there is none.
        Some(Value::Null) => None,
        _ => drawn.material.clone(),
    };
    if let Some(name) = &material {
        let usual = || Material::of_density(DEFAULT_DENSITY);
        raw.materials.entry(name.clone()).or_insert_with(usual);
    }
    let mut heft = Heft { density, mass, centroid: None };
    let exact = extras.get("exact").map(|value| Exact::deserialize(value).ok());
    match exact.map(|e| e.filter(|e| e.fits(&drawn))) {
        Some(Some(exact)) => {
            notes.exact.push(named);
            heft.centroid = exact.own_centroid();
            if exact.spheres.is_empty() {
                let (vertices, faces) = (exact.vertices, exact.faces);
                raw.blocks.push(Solid {
                    id,
                    vertices,
                    faces,
                    support,
                    material,
                    heft,
                    ..Solid::default()
                });
            } else {
                let spheres = exact.spheres.iter().map(|s| (s.at, s.radius)).collect();
                raw.grains.push(Grain { id, spheres, support, material, heft, ..Grain::default() });
            }
            return;
        }
        Some(None) => notes.changed.push(named),
        None => {}
    }
    let Drawn { vertices, faces, .. } = drawn;
    raw.blocks.push(Solid { id, vertices, faces, support, material, heft, ..Solid::default() });
}

/// The box of points: lowest and highest coordinates.
fn bounds(points: impl Iterator<Item = [f64; 3]>) -> (Vector3<f64>, Vector3<f64>) {
    let none = Vector3::repeat(f64::INFINITY);
    points.map(Vector3::from).fold((none, -none), |(l, h), p| (l.inf(&p), h.sup(&p)))
}

impl Exact {
    /// Whether it is sound, and still what is drawn.
    fn fits(&self, drawn: &Drawn) -> bool {
        let numbers = self.vertices.iter().chain(self.spheres.iter().map(|s| &s.at)).flatten();
        let is_sound = numbers.clone().all(|c| c.is_finite())
            && self.spheres.iter().all(|s| s.radius.is_finite() && s.radius > 0.0)
            && self.faces.iter().all(|f| f.len() > 2 && f.iter().all(|v| *v < self.vertices.len()))
            && (self.spheres.is_empty() != self.faces.is_empty());
        if !is_sound {
            return false;
        }
        let ball = |s: &Sphere| [-s.radius, s.radius].map(|r| s.at.map(|c| c + r));
        let own = self.vertices.iter().copied().chain(self.spheres.iter().flat_map(ball));
        let (low, high) = bounds(own);
        let (drawn_low, drawn_high) = bounds(drawn.vertices.iter().copied());
        let far = drawn_low.amax().max(drawn_high.amax());
        let near = DRAWN * (high - low).norm() + DRAWN_FAR * far;
        let is_there = (low - drawn_low).amax() <= near && (high - drawn_high).amax() <= near;
        is_there && (!self.spheres.is_empty() || self.has_corners(drawn, near))
    }

    /// Whether every corner that is drawn is one of its own.
    fn has_corners(&self, drawn: &Drawn, near: f64) -> bool {
        let mut own: Vec<Vector3<f64>> = self.vertices.iter().map(|v| Vector3::from(*v)).collect();
        own.sort_by(|a, b| a.x.total_cmp(&b.x));
        drawn.vertices.iter().map(|v| Vector3::from(*v)).all(|p| {
            let first = own.partition_point(|v| v.x < p.x - near);
            let close = own[first..].iter().take_while(|v| v.x <= p.x + near);
            close.into_iter().any(|v| (v - p).amax() <= near)
        })
    }

    /// The centre of mass, where it is not that of the shape.
    fn own_centroid(&self) -> Option<[f64; 3]> {
        let own = Vector3::from(self.centroid.filter(|c| c.iter().all(|x| x.is_finite()))?);
        let of_shape = match &self.spheres[..] {
            [] => rigid::of_mesh(&self.vertices, &self.faces).1.coords,
            [one] => one.at.into(),
            _ => return Some(own.into()),
        };
        let (low, high) = bounds(self.vertices.iter().copied());
        let size =
            if self.spheres.is_empty() { (high - low).norm() } else { self.spheres[0].radius };
        ((own - of_shape).norm() > ROUNDING * size).then(|| own.into())
    }
}

/// Centres of mass nearer than this × the size of the block are the same.
const ROUNDING: f64 = 1e-10;

fn tell(document: &Document, notes: Notes, raw: &mut Raw) {
    use FindingCode::{Converted, LeftOut};
    let said = [
        (Converted, notes.exact, "exact shapes, read from the extras of nodes", ""),
        (
            Converted,
            notes.changed,
            "nodes that are drawn otherwise than their extras say",
            "; what is drawn is read, in single precision",
        ),
        (LeftOut, notes.lines, "points and lines, left out", ""),
        (Converted, notes.several, "meshes of several materials, of which the first is taken", ""),
        (LeftOut, notes.odd, "extras that are no number above zero, left out", ""),
    ];
    for (code, list, what, rest) in said {
        if !list.is_empty() {
            raw.say(code, format!("{what}: {}{rest}", tally(&list)));
        }
    }
    let moving = document.animations.len() + document.skins.len();
    if moving > 0 {
        raw.say(
            LeftOut,
            format!("animations and skins, left out (nodes are where they rest): {moving}"),
        );
    }
    let blocks = raw.blocks.iter().map(|b| (&b.material, &b.heft));
    let of = |(material, heft): &(&Option<String>, &Heft)| {
        material.is_some() && heft.mass.is_none() && heft.density.is_none()
    };
    if blocks.filter(of).count() > 0 {
        raw.say(Converted, format!("each material is one of {DEFAULT_DENSITY} kg/m³, assumed"));
    }
}
