//! Assembly and CRA_Assembly: a graph with a block at every node and the interfaces on its edges.

use super::{
    cursor::Cursor,
    interface::{self, Ids},
    mesh,
};
use crate::import::raw::{Raw, Solid, tally};
use base::error::{FindingCode, InputError};

/// The blocks and interfaces of an assembly.
pub(super) fn read(data: &Cursor) -> Result<Raw, InputError> {
    let mut raw = Raw::default();
    // Newest first: a graph inside the assembly; graph and blocks side by side; the graph itself.
    let graph = data.get("graph").or_else(|| data.get("assembly")).unwrap_or_else(|| data.clone());
    let graph = graph.get("graph").unwrap_or(graph);
    let nodes = graph.get("node").map_or_else(|| graph.need("vertex"), Ok)?;
    let apart = data.get("blocks");
    let defaults = ["default_node_attributes", "dna", "default_vertex_attributes", "dva"]
        .into_iter()
        .find_map(|k| graph.get(k));
    let default_support = defaults.map_or(Ok(None), |d| d.flag("is_support"))?.unwrap_or(false);
    let mut bare = Vec::new();
    for (key, node) in nodes.members()? {
        let Some(block) = node.get("block").or_else(|| apart.as_ref()?.get(key)) else {
            bare.push(key.to_string());
            continue;
        };
        let of_block = block.get("attributes").map_or(Ok(None), |a| a.flag("is_support"))?;
        let support = node.flag("is_support")?.or(of_block).unwrap_or(default_support);
        let geometry = mesh::of(&block).unwrap_or(block);
        raw.blocks.push(Solid { support, ..mesh::read(&geometry, key.into())? });
    }
    if !bare.is_empty() {
        raw.say(FindingCode::LeftOut, format!("nodes without a block, left out: {}", tally(&bare)));
    }
    if let Some(edges) = graph.get("edge") {
        let ids: Ids =
            raw.blocks.iter().enumerate().map(|(i, b)| (b.id.clone(), (i, b.id.clone()))).collect();
        interface::read(&edges, &ids, &mut raw)?;
    }
    Ok(raw)
}
