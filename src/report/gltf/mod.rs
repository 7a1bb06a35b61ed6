//! glTF 2.0, which programs for buildings, games and the web read: blocks as named nodes with their
//! materials, mechanisms and films as animations, lines of thrust and members as lines.
//!
//! glTF has y upwards: the root node `voussoir` turns the scene and carries the middle of what one
//! looks at, so that single precision is spent on the blocks whatever the survey coordinates. Its
//! `extras` say what every animation shows, and how far the fastest corner goes: mechanisms have no
//! size of their own.
//!
//! Positions are single precision; the `extras` of a block have its exact shape, in the coordinates of the
//! file, by which importing it gives the same block.
//!
//! Khronos Group, *glTF 2.0 Specification* (ISO/IEC 12113:2022).

mod animation;
mod buffer;
mod shapes;

use super::view::View;
use animation::animations;
use buffer::Buffer;
use data_encoding::BASE64;
use serde_json::{Value, json};
use shapes::{Shapes, upright};

/// Magic number of the binary container, and its kinds of chunks.
const MAGIC: u32 = 0x4654_6c67;
const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

/// The file with its buffer inside, as text (`.gltf`).
///
/// # Errors
/// Only if memory runs out.
pub fn text(view: &View) -> Result<String, serde_json::Error> {
    let (mut document, bytes) = document(view);
    if !bytes.is_empty() {
        let uri = format!("data:application/octet-stream;base64,{}", BASE64.encode(&bytes));
        document["buffers"][0]["uri"] = uri.into();
    }
    serde_json::to_string(&document)
}

/// The file as a binary container (`.glb`).
///
/// # Errors
/// Only if memory runs out.
pub fn binary(view: &View) -> Result<Vec<u8>, serde_json::Error> {
    let (document, mut bytes) = document(view);
    let mut text = serde_json::to_vec(&document)?;
    // Chunks are whole words: JSON is filled with spaces, the rest with zeros.
    text.resize(text.len().next_multiple_of(4), b' ');
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let rest = if bytes.is_empty() { 0 } else { 8 + bytes.len() };
    let mut out = Vec::with_capacity(20 + text.len() + rest);
    let word = |out: &mut Vec<u8>, value: u32| out.extend(value.to_le_bytes());
    for value in [MAGIC, 2, (20 + text.len() + rest) as u32, text.len() as u32, JSON] {
        word(&mut out, value);
    }
    out.extend(text);
    if !bytes.is_empty() {
        for value in [bytes.len() as u32, BIN] {
            word(&mut out, value);
        }
        out.extend(bytes);
    }
    Ok(out)
}

/// The document, and what its one buffer holds.
fn document(view: &View) -> (Value, Vec<u8>) {
    let mut buffer = Buffer::default();
    let shapes = Shapes::of(view, &mut buffer);
    let (animations, told) = animations(view, &shapes, &mut buffer);
    let turn = upright(view);
    let root = json!({
        "name": "voussoir",
        "rotation": turn.coords.as_slice(),
        "translation": (turn * view.middle()).as_slice(),
        "children": (1..=shapes.nodes.len()).collect::<Vec<_>>(),
        "extras": {
            "scene": view.name, "unit": "m", "gravity_m_s2": view.gravity, "animations": told,
        },
    });
    let nodes: Vec<Value> = std::iter::once(root).chain(shapes.nodes).collect();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("voussoir ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "name": if view.name.is_empty() { "scene" } else { &view.name }, "nodes": [0] }],
        "nodes": nodes,
    });
    let views = buffer.views;
    // Lists may not be empty.
    for (name, list) in [
        ("meshes", shapes.meshes),
        ("materials", shapes.materials),
        ("animations", animations),
        ("accessors", buffer.accessors),
        ("bufferViews", views),
    ] {
        if !list.is_empty() {
            document[name] = list.into();
        }
    }
    if !buffer.bytes.is_empty() {
        document["buffers"] = json!([{ "byteLength": buffer.bytes.len() }]);
    }
    (document, buffer.bytes)
}
