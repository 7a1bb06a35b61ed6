//! JSON written by COMPAS and the packages of its family (compas_assembly, compas_cra, compas_dem).
//!
//! Every typed value may sit in an envelope: `{"dtype", "data"}` (COMPAS 2), `{"dtype", "value"}`
//! (1), `{"compas", "datatype", "data"}` (0.x); [`cursor::Cursor`] takes them off wherever it
//! steps. Below that there are three layouts:
//!
//! | layout | blocks | interfaces |
//! |---|---|---|
//! | Assembly, CRA_Assembly ([`graph`]) | `graph.node[key].block`, in old files `blocks[key]` | `graph.edge[u][v].interfaces`, `.interface` or `.interface_points` |
//! | BlockModel ([`model`]) | `elements[guid].geometry`, in old files `.shape`, key in `graph.node[key].element` | `graph.edge[u][v].contacts` |
//! | lists of meshes, nested as they like | the meshes | none |
//!
//! Ids are the keys of the graph, else the place in the list. Keys are strings in no particular
//! order; where all of them are whole numbers they are sorted as numbers, else they stay as they
//! are.

mod cursor;
mod graph;
mod interface;
mod mesh;
mod model;

use super::{
    raw::{Raw, Solid},
    text,
};
use base::error::{FindingCode, InputError, JsonPath};
use cursor::Cursor;
use serde_json::Value;

/// The blocks and interfaces of a COMPAS file.
pub(super) fn read(bytes: &[u8]) -> Result<Raw, InputError> {
    let value: Value = serde_json::from_slice(text::unmarked(bytes)).map_err(|e| {
        let message = e.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        let hint = match e.is_eof() {
            true => "the file is cut off; export it again",
            false => "the file is damaged or not JSON; NaN and Infinity, which Python writes, are not JSON either",
        };
        let position = (e.line() > 0).then(|| (e.line(), e.column()));
        InputError { position, ..InputError::at(JsonPath::root(), message).hint(hint) }
    })?;
    let root = Cursor::root(&value);
    if let Some(format) =
        value.get("format").and_then(Value::as_str).filter(|f| f.starts_with("voussoir"))
    {
        return Err(root
            .error(format!("a {format:?} file needs no import"))
            .hint("use it as it is"));
    }
    let data = root.open();
    if data.has("elements") {
        model::read(&data)
    } else if data.has("graph") || data.has("assembly") || (data.has("node") && data.has("edge")) {
        graph::read(&data)
    } else {
        let mut raw = Raw::default();
        collect(&data, &mut raw)?;
        Ok(raw)
    }
}

/// A mesh, an element with a mesh, or a list of such, nested in lists as deep as JSON itself may
/// be.
fn collect(at: &Cursor, raw: &mut Raw) -> Result<(), InputError> {
    let at = at.open();
    if let Some(list) = at.items() {
        list.iter().try_for_each(|item| collect(item, raw))
    } else if at.value().is_null() {
        raw.say(
            FindingCode::LeftOut,
            format!("{}: null instead of a mesh was left out", at.path()),
        );
        Ok(())
    } else {
        let support = at.flag("is_support")?.unwrap_or(false);
        let id = raw.blocks.len().to_string();
        let geometry = mesh::of(&at).unwrap_or(at);
        let solid = mesh::read(&geometry, id)?;
        raw.blocks.push(Solid { support, ..solid });
        Ok(())
    }
}
