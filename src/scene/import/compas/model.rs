//! BlockModel: elements by their guid, a graph of their contacts, a tree of their places.

use super::{
    cursor::{Cursor, describe},
    interface::{self, Ids},
    mesh,
};
use crate::{
    Material,
    import::raw::{Raw, Solid, tally},
};
use base::error::{FindingCode, InputError};
use nalgebra::{Matrix4, Point3};
use std::collections::HashMap;

/// The blocks and contacts of a model.
///
/// An element's geometry is in its own frame; its place is model × ancestors in the tree × own
/// transformation. Contacts are in the model's coordinates already.
pub(super) fn read(data: &Cursor) -> Result<Raw, InputError> {
    let mut raw = Raw::default();
    let elements = elements(&data.need("elements")?)?;
    let graph = data.get("graph");
    let (keys, nodes) = names(graph.as_ref())?;
    let materials = materials(data, &mut raw)?;
    let places = places(data);
    let by_guid: HashMap<&str, &Cursor> =
        elements.iter().map(|(guid, element)| (guid.as_str(), element)).collect();
    let model = matrix(data)?.unwrap_or_else(Matrix4::identity);
    let mut without = Vec::new();
    let mut id_of_guid = HashMap::new();
    let mut found: Vec<(i64, Solid)> = Vec::new();
    for (number, (guid, element)) in elements.iter().enumerate() {
        let key = keys.get(guid);
        let id = key.cloned().unwrap_or_else(|| guid.clone());
        let Some(geometry) = mesh::of(element) else {
            without.push(id);
            continue;
        };
        let mut solid = mesh::read(&geometry, id.clone())?;
        let place =
            places.get(guid).map_or(Ok(Matrix4::identity()), |chain| product(chain, &by_guid))?;
        let own = matrix(element)?.unwrap_or_else(Matrix4::identity);
        let whole = model * place * own;
        if whole != Matrix4::identity() {
            for vertex in &mut solid.vertices {
                *vertex = whole.transform_point(&Point3::from(*vertex)).coords.into();
            }
        }
        solid.support = element.flag("is_support")?.unwrap_or(false);
        solid.material =
            element.get("material").and_then(|m| materials.get(m.value().as_str()?).cloned());
        id_of_guid.insert(guid.clone(), id.clone());
        // By node key where that is a number, else in the order of the file.
        let order = key
            .and_then(|k| k.parse().ok())
            .unwrap_or_else(|| i64::try_from(number).unwrap_or(i64::MAX));
        found.push((order, solid));
    }
    found.sort_by_key(|(order, _)| *order);
    raw.blocks = found.into_iter().map(|(_, solid)| solid).collect();
    if !without.is_empty() {
        raw.say(
            FindingCode::LeftOut,
            format!("elements without geometry, left out: {}", tally(&without)),
        );
    }
    if let Some(edges) = graph.and_then(|g| g.get("edge")) {
        let index: HashMap<&str, usize> =
            raw.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
        let ids: Ids = nodes
            .into_iter()
            .filter_map(|(node, guid)| {
                let id = id_of_guid.get(&guid)?;
                Some((node, (*index.get(id.as_str())?, id.clone())))
            })
            .collect();
        interface::read(&edges, &ids, &mut raw)?;
    }
    Ok(raw)
}

/// The elements with their guids: a map, or a list of envelopes with a guid each.
fn elements<'a>(at: &Cursor<'a>) -> Result<Vec<(String, Cursor<'a>)>, InputError> {
    let Some(items) = at.items() else {
        return Ok(at
            .members()?
            .into_iter()
            .map(|(guid, element)| (guid.to_string(), element))
            .collect());
    };
    let guid = |i: usize, item: &Cursor| {
        item.get("guid")
            .and_then(|g| g.value().as_str().map(String::from))
            .unwrap_or_else(|| i.to_string())
    };
    Ok(items.iter().enumerate().map(|(i, item)| (guid(i, item), item.open())).collect())
}

/// guid → key, and key → guid, of the graph's nodes.
type Names = (HashMap<String, String>, Vec<(String, String)>);

fn names(graph: Option<&Cursor>) -> Result<Names, InputError> {
    let mut names = Names::default();
    let Some(nodes) = graph.and_then(|g| g.get("node")) else { return Ok(names) };
    for (key, node) in nodes.members()? {
        if let Some(guid) = node.get("element").and_then(|e| e.value().as_str()) {
            names.0.insert(guid.into(), key.into());
            names.1.push((key.into(), guid.into()));
        }
    }
    Ok(names)
}

/// guid → name of the materials that have a density; they go into the scene.
fn materials(data: &Cursor, raw: &mut Raw) -> Result<HashMap<String, String>, InputError> {
    let mut names = HashMap::new();
    let Some(all) = data.get("materials") else { return Ok(names) };
    for (guid, material) in elements(&all)? {
        let Some(density) = material.get("density") else { continue };
        let density = density.number()?;
        let name = material.get("name").and_then(|n| n.value().as_str()).unwrap_or("material");
        let entry = Material::of_density(density);
        let mut unique = name.to_string();
        let mut number = 2;
        while raw.materials.get(&unique).is_some_and(|m| *m != entry) {
            unique = format!("{name}-{number}");
            number += 1;
        }
        raw.materials.insert(unique.clone(), entry);
        names.insert(guid, unique);
    }
    Ok(names)
}

/// guid → guids of its ancestors in the tree, outermost first.
fn places(data: &Cursor) -> HashMap<String, Vec<String>> {
    fn walk(node: &Cursor, above: &[String], places: &mut HashMap<String, Vec<String>>) {
        for child in node.get("children").and_then(|c| c.items()).unwrap_or_default() {
            let child = child.open();
            let mut chain = above.to_vec();
            if let Some(guid) = child.get("element").and_then(|e| e.value().as_str()) {
                places.insert(guid.into(), chain.clone());
                chain.push(guid.into());
            }
            walk(&child, &chain, places);
        }
    }
    let mut places = HashMap::new();
    if let Some(root) = data.get("tree").and_then(|t| t.get("root")) {
        walk(&root, &[], &mut places);
    }
    places
}

/// The transformation of a chain of ancestors, outermost first.
fn product(
    chain: &[String],
    elements: &HashMap<&str, &Cursor>,
) -> Result<Matrix4<f64>, InputError> {
    let mut product = Matrix4::identity();
    for guid in chain {
        if let Some(element) = elements.get(guid.as_str())
            && let Some(matrix) = matrix(element)?
        {
            product *= matrix;
        }
    }
    Ok(product)
}

/// The affine transformation of an element or model: four rows of four, the last 0 0 0 1.
fn matrix(at: &Cursor) -> Result<Option<Matrix4<f64>>, InputError> {
    let Some(transformation) = at.get("transformation") else { return Ok(None) };
    let rows = transformation.get("matrix").unwrap_or(transformation);
    let wrong = || {
        rows.error(format!(
            "expected a transformation of four rows of four with the last row 0 0 0 1, got {}",
            describe(rows.value())
        ))
        .hint("apply the transformation to the meshes before the export")
    };
    let mut matrix = Matrix4::zeros();
    let list = rows.items().filter(|r| r.len() == 4).ok_or_else(wrong)?;
    for (i, row) in list.iter().enumerate() {
        let values = row.items().filter(|v| v.len() == 4).ok_or_else(wrong)?;
        for (j, value) in values.iter().enumerate() {
            matrix[(i, j)] = value.number()?;
        }
    }
    let last = [matrix[(3, 0)], matrix[(3, 1)], matrix[(3, 2)], matrix[(3, 3)]];
    if last == [0.0, 0.0, 0.0, 1.0] { Ok(Some(matrix)) } else { Err(wrong()) }
}
