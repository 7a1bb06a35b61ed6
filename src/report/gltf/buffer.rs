//! Arrays in the one buffer of a file.

use nalgebra::Vector3;
use serde_json::{Value, json};

/// Kinds of numbers.
const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
/// What a view of the buffer is for: vertices, their indices.
pub(super) const VERTICES: u32 = 34962;
pub(super) const INDICES: u32 = 34963;

/// The bytes, with views and accessors into them.
#[derive(Default)]
pub(super) struct Buffer {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl Buffer {
    /// Points or directions, single precision; with their bounds, which positions need.
    pub(super) fn vectors(&mut self, list: &[Vector3<f64>], target: Option<u32>) -> usize {
        let numbers: Vec<f32> =
            list.iter().flat_map(|v| [v.x as f32, v.y as f32, v.z as f32]).collect();
        self.floats(&numbers, 3, "VEC3", target)
    }

    /// Single precision numbers, so many to an element.
    pub(super) fn floats(
        &mut self,
        numbers: &[f32],
        size: usize,
        kind: &str,
        target: Option<u32>,
    ) -> usize {
        let bound = |start: f32, pick: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..size)
                .map(|k| numbers.iter().skip(k).step_by(size).copied().fold(start, pick))
                .collect()
        };
        let (low, high) = (bound(f32::INFINITY, f32::min), bound(f32::NEG_INFINITY, f32::max));
        let view = self.view(numbers.iter().flat_map(|v| v.to_le_bytes()), target);
        self.accessors.push(json!({
            "bufferView": view, "componentType": FLOAT, "count": numbers.len() / size,
            "type": kind, "min": low, "max": high,
        }));
        self.accessors.len() - 1
    }

    /// Indices of vertices.
    pub(super) fn indices(&mut self, list: &[u32]) -> usize {
        let view = self.view(list.iter().flat_map(|v| v.to_le_bytes()), Some(INDICES));
        self.accessors.push(json!({
            "bufferView": view, "componentType": UNSIGNED, "count": list.len(), "type": "SCALAR",
        }));
        self.accessors.len() - 1
    }

    fn view(&mut self, bytes: impl Iterator<Item = u8>, target: Option<u32>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view =
            json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        self.views.len() - 1
    }
}
