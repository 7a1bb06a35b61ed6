//! Importers, by behaviour. The files are written here, but for [`real`], which reads those of
//! other projects where they are at hand.

mod bad;
mod bodies;
mod chrono;
mod compas;
mod dxf;
mod mesh_formats;
mod options;
mod packing;
mod real;
mod svg;
mod threedec;

use super::*;
use crate::{BlockSpec, Shape};
use base::error::FindingCode;

/// Imports text or bytes under a file name.
fn import(name: &str, bytes: impl AsRef<[u8]>) -> Result<Imported, InputError> {
    import_bytes(name, bytes.as_ref(), &ImportOptions::default())
}

fn good(name: &str, bytes: impl AsRef<[u8]>) -> Imported {
    let imported = import(name, bytes).unwrap_or_else(|e| panic!("{e}"));
    check(&imported.scene);
    imported
}

/// What holds for every scene an importer makes.
fn check(scene: &Scene) {
    let mut ids: Vec<&str> = scene.blocks.iter().map(|b| b.id.as_str()).collect();
    for block in &scene.blocks {
        let (vertices, faces) = mesh(block);
        assert!(vertices.iter().flatten().all(|c| c.is_finite()), "{}", block.id);
        assert!(faces.iter().flatten().all(|&i| i < vertices.len()), "{}", block.id);
        assert!(faces.iter().all(|f| f.len() >= 3), "{}", block.id);
        assert!(block.material.as_ref().is_none_or(|m| scene.materials.contains_key(m)));
    }
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "ids are unique");
    for interface in &scene.interfaces {
        assert!(
            interface.between.iter().all(|id| ids.binary_search(&id.as_str()).is_ok()),
            "{:?}",
            interface.between
        );
        assert!(
            interface
                .points
                .iter()
                .flatten()
                .chain(interface.normal.iter().flatten())
                .all(|c| c.is_finite())
        );
    }
    let text = serde_json::to_string(scene).expect("a scene can be written");
    assert_eq!(&serde_json::from_str::<Scene>(&text).expect("and read"), scene, "and is the same");
}

fn mesh(block: &BlockSpec) -> (&[[f64; 3]], &[Vec<usize>]) {
    match &block.shape {
        Shape::Polyhedron { vertices, faces } => (vertices, faces),
        other => panic!("an importer made {other:?}"),
    }
}

/// Volume by the divergence theorem; positive where the faces are counter-clockwise seen from
/// outside.
fn volume(block: &BlockSpec) -> f64 {
    let (v, faces) = mesh(block);
    let p = |i: usize| nalgebra::Vector3::from(v[i]);
    faces
        .iter()
        .flat_map(|f| {
            f.windows(2).skip(1).map(move |w| p(f[0]).dot(&p(w[0]).cross(&p(w[1]))) / 6.0)
        })
        .sum()
}

fn ids(imported: &Imported) -> Vec<&str> {
    imported.scene.blocks.iter().map(|b| b.id.as_str()).collect()
}

fn supports(imported: &Imported) -> Vec<&str> {
    imported.scene.blocks.iter().filter(|b| b.support).map(|b| b.id.as_str()).collect()
}

/// The finding that contains all of these words.
fn finding<'a>(imported: &'a Imported, code: FindingCode, words: &[&str]) -> &'a str {
    let found = imported
        .findings
        .iter()
        .find(|f| f.code == code && words.iter().all(|w| f.text.contains(w)));
    &found.unwrap_or_else(|| panic!("no {code:?} with {words:?} in {:#?}", imported.findings)).text
}

/// Faces of a box whose corners are numbered as in [`corners`], counter-clockwise seen from
/// outside.
const FACES: [[usize; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

/// Corners of a box of 1 × 2 × 3 with its lowest corner at `origin`.
fn corners([x, y, z]: [f64; 3]) -> [[f64; 3]; 8] {
    let at = |dx: f64, dy: f64, dz: f64| [x + dx, y + 2.0 * dy, z + 3.0 * dz];
    [
        at(0.0, 0.0, 0.0),
        at(1.0, 0.0, 0.0),
        at(1.0, 1.0, 0.0),
        at(0.0, 1.0, 0.0),
        at(0.0, 0.0, 1.0),
        at(1.0, 0.0, 1.0),
        at(1.0, 1.0, 1.0),
        at(0.0, 1.0, 1.0),
    ]
}

/// A box in OBJ; `corner` writes one corner of a face from its index, counted from 1 within the
/// box.
fn obj_box(origin: [f64; 3], corner: impl Fn(usize) -> String) -> String {
    let v: String = corners(origin).iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    let f: String =
        FACES.iter().map(|f| format!("f {}\n", f.map(|i| corner(i + 1)).join(" "))).collect();
    v + &f
}

/// A box as the data of a COMPAS mesh; the keys of its vertices do not start at 0 and are not in
/// order.
fn compas_mesh(origin: [f64; 3]) -> serde_json::Value {
    let key = |i: usize| (20 - 2 * i).to_string();
    let vertex: serde_json::Map<_, _> = corners(origin)
        .iter()
        .enumerate()
        .map(|(i, [x, y, z])| (key(i), serde_json::json!({"x": x, "y": y, "z": z})))
        .collect();
    let face: serde_json::Map<_, _> = FACES
        .iter()
        .enumerate()
        .map(|(i, f)| (i.to_string(), serde_json::json!(f.map(|c| 20 - 2 * c))))
        .collect();
    serde_json::json!({"attributes": {}, "default_vertex_attributes": {"x": 0.0, "y": 0.0, "z": 0.0}, "vertex": vertex, "face": face})
}

/// An ASCII PLY of a box.
fn ply_box() -> String {
    let v: String = corners([0.0; 3]).iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    let f: String =
        FACES.iter().map(|f| format!("4 {}\n", f.map(|i| i.to_string()).join(" "))).collect();
    let header = "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n";
    format!("{header}element face 6\nproperty list uchar int vertex_indices\nend_header\n{v}{f}")
}

/// A binary PLY of a box with a colour between the coordinates and single-precision numbers.
fn ply_box_binary(little: bool) -> Vec<u8> {
    let order = if little { "little" } else { "big" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\ncomment a box\nelement vertex 8\nproperty float x\nproperty uchar red\nproperty float y\n\
         property float z\nelement face 6\nproperty list uchar uint vertex_index\nend_header\n"
    )
    .into_bytes();
    let put = |word: [u8; 4]| {
        let mut word = word;
        if !little {
            word.reverse();
        }
        word
    };
    for [x, y, z] in corners([0.0; 3]) {
        bytes.extend(put((x as f32).to_le_bytes()));
        bytes.push(7);
        bytes.extend(put((y as f32).to_le_bytes()));
        bytes.extend(put((z as f32).to_le_bytes()));
    }
    for face in FACES {
        bytes.push(4);
        face.iter().for_each(|&i| bytes.extend(put((i as u32).to_le_bytes())));
    }
    bytes
}

/// The twelve triangles of a box.
fn triangles() -> Vec<[[f64; 3]; 3]> {
    let v = corners([0.0; 3]);
    FACES.iter().flat_map(|f| [[v[f[0]], v[f[1]], v[f[2]]], [v[f[0]], v[f[2]], v[f[3]]]]).collect()
}

fn stl_ascii(name: &str) -> String {
    let facet = |t: [[f64; 3]; 3]| {
        let v = t.map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).concat();
        format!("facet normal 0 0 0\nouter loop\n{v}endloop\nendfacet\n")
    };
    format!(
        "solid {name}\n{}endsolid {name}\n",
        triangles().into_iter().map(facet).collect::<String>()
    )
}

fn stl_binary(title: &str) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes[..title.len()].copy_from_slice(title.as_bytes());
    bytes.extend(12u32.to_le_bytes());
    for triangle in triangles() {
        bytes.extend([0; 12]);
        triangle.iter().flatten().for_each(|&c| bytes.extend((c as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}
