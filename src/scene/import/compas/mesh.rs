//! A COMPAS mesh: vertices and faces by key, or as plain lists (Polyhedron).

use super::cursor::{Cursor, describe};
use crate::import::raw::Solid;
use base::error::InputError;
use serde_json::Value;
use std::collections::HashMap;

/// Where an element has its mesh: `geometry`, in old files `shape`. None where it has neither.
pub(super) fn of<'a>(element: &Cursor<'a>) -> Option<Cursor<'a>> {
    ["geometry", "shape"].into_iter().find_map(|key| element.get(key))
}

/// The solid of a mesh.
///
/// `vertex[key] = {x, y, z}`, where a missing coordinate is the one of `default_vertex_attributes`
/// (`dva` in old files); `face[key] = [vertex keys]`.
pub(super) fn read(at: &Cursor, id: String) -> Result<Solid, InputError> {
    let at = at.open();
    if at.has("vertices") && at.has("faces") {
        return from_lists(&at, id);
    }
    if !(at.has("vertex") && at.has("face")) {
        return Err(at
            .error(format!("expected a mesh with \"vertex\" and \"face\", got {}", describe(at.value())))
            .hint("blocks must be meshes or polyhedra; convert boxes, breps and other shapes to meshes before the export"));
    }
    let defaults = ["default_vertex_attributes", "dva"].into_iter().find_map(|k| at.get(k));
    let mut solid = Solid { id, ..Solid::default() };
    let mut index = HashMap::new();
    for (key, vertex) in at.need("vertex")?.members()? {
        index.insert(key, solid.vertices.len());
        solid.vertices.push(coordinates(&vertex, defaults.as_ref())?);
    }
    let faces = at.need("face")?;
    let faces = match faces.items() {
        Some(list) => list,
        None => faces.members()?.into_iter().map(|(_, face)| face).collect(),
    };
    let lookup = |corner: &Value| match corner {
        Value::String(key) => index.get(key.as_str()).copied(),
        other => index.get(other.to_string().as_str()).copied(),
    };
    solid.faces = faces.iter().map(|f| face(f, lookup)).collect::<Result<_, _>>()?;
    Ok(solid)
}

fn from_lists(at: &Cursor, id: String) -> Result<Solid, InputError> {
    let list = |key: &str| {
        let at = at.need(key)?;
        at.items().ok_or_else(|| {
            at.error(format!("expected a list, got {}", describe(at.value())))
                .hint("export the file again")
        })
    };
    let vertices: Vec<[f64; 3]> =
        list("vertices")?.iter().map(Cursor::point).collect::<Result<_, _>>()?;
    let lookup = |corner: &Value| {
        corner.as_u64().and_then(|i| usize::try_from(i).ok()).filter(|&i| i < vertices.len())
    };
    let faces = list("faces")?.iter().map(|f| face(f, lookup)).collect::<Result<_, _>>()?;
    Ok(Solid { id, vertices, faces, ..Solid::default() })
}

fn coordinates(vertex: &Cursor, defaults: Option<&Cursor>) -> Result<[f64; 3], InputError> {
    if vertex.value().is_array() {
        return vertex.point();
    }
    let mut point = [0.0; 3];
    for (value, axis) in point.iter_mut().zip(["x", "y", "z"]) {
        let at =
            vertex.get(axis).or_else(|| defaults.and_then(|d| d.get(axis))).ok_or_else(|| {
                vertex
                    .error(format!(
                        "coordinate {axis} is missing, here and in the default attributes"
                    ))
                    .hint("export the mesh again, with all coordinates")
            })?;
        *value = at.number()?;
    }
    Ok(point)
}

fn face(at: &Cursor, lookup: impl Fn(&Value) -> Option<usize>) -> Result<Vec<usize>, InputError> {
    let at = at.open();
    let corners = at.items().filter(|c| c.len() >= 3).ok_or_else(|| {
        at.error(format!("expected three corners or more, got {}", describe(at.value())))
            .hint("export the mesh again")
    })?;
    let find = |c: &Cursor| {
        lookup(c.value()).ok_or_else(|| {
            c.error(format!("the mesh has no vertex {}", describe(c.value())))
                .hint("every corner must be a key of \"vertex\"")
        })
    };
    corners.iter().map(find).collect()
}
