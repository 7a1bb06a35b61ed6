//! Which pairs of blocks are close enough to be looked at: parry's bounding-volume tree over
//! loosened boxes.
//!
//! parry3d-f64 keeps `f64` in the nodes of its tree, so a box far from the origin is as exact as
//! the coordinates.

use super::{
    body::{BoundedBlock, Bounds},
    limits::{self, Limits},
};
use base::{
    error::{InputError, JsonPath},
    limits as most,
    tolerance::COORDINATE_ROUNDING,
};
use parry3d::{
    bounding_volume::Aabb,
    math::Vector,
    partitioning::{Bvh, BvhBuildStrategy},
};
use scene::ContactSpec;

/// Pairs `(a, b)`, `a < b`, ascending, of blocks to be looked at whose boxes are within the reach of near misses of each
/// other.
///
/// # Errors
/// There are more than can be looked at.
pub(super) fn candidates(
    bodies: &[BoundedBlock],
    looked: &dyn Fn(usize) -> bool,
    spec: &ContactSpec,
) -> Result<Vec<(usize, usize, Limits)>, InputError> {
    let reach = limits::near(spec);
    let loose = |b: &BoundedBlock| {
        aabb(&b.bounds.loosened(reach * b.block.size + COORDINATE_ROUNDING * b.bounds.reach()))
    };
    let list: Vec<usize> = (0..bodies.len()).filter(|&i| looked(i)).collect();
    let boxes: Vec<Aabb> = list.iter().map(|&i| loose(&bodies[i])).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    let mut pairs = Vec::new();
    for (&a, around) in list.iter().zip(&boxes) {
        let (body, start) = (&bodies[a], pairs.len());
        for b in tree.intersect_aabb(around).map(|k| list[k as usize]).filter(|&b| b > a) {
            let limits = Limits::of(body, &bodies[b], spec);
            if body.bounds.distance(&bodies[b].bounds) <= limits.near {
                pairs.push((a, b, limits));
            }
        }
        pairs[start..].sort_unstable_by_key(|&(_, b, _)| b);
        few(pairs.len(), || (body.block.id.clone(), pairs.len() - start))?;
    }
    Ok(pairs)
}

/// Refuses more pairs than can be looked at; `last` is the last block, with its own pairs.
fn few(pairs: usize, last: impl Fn() -> (String, usize)) -> Result<(), InputError> {
    let refuse = |message: String| {
        let (id, own) = last();
        InputError::at(
            JsonPath::root(),
            format!("{message} (block {id:?} alone has {own} neighbours)"),
        )
        .hint("look for blocks that lie in one place, and for a contact.gap that is too large")
    };
    if pairs > most::PAIRS {
        return Err(refuse(format!(
            "more than {} pairs of blocks are near enough to touch",
            most::PAIRS
        )));
    }
    most::afford(
        &format!("checking {pairs} pairs of blocks that are near enough to touch"),
        pairs as u64,
        most::PER_PAIR,
    )
    .map_err(|e| refuse(e.message))
}

fn aabb(bounds: &Bounds) -> Aabb {
    let vector = |v: &nalgebra::Vector3<f64>| Vector::new(v.x, v.y, v.z);
    Aabb::new(vector(&bounds.lo), vector(&bounds.hi))
}
