//! Which pairs of blocks are close enough to be looked at: parry's bounding-volume tree over loosened boxes.
//!
//! parry3d-f64 keeps `f64` in the nodes of its tree, so a box far from the origin is as exact as the coordinates.

use super::{
    body::{Body, Bounds},
    limits::{self, Limits},
};
use crate::{scene::ContactSpec, tolerance::COORDINATE_ROUNDING};
use parry3d::{
    bounding_volume::Aabb,
    math::Vector,
    partitioning::{Bvh, BvhBuildStrategy},
};

/// Pairs `(a, b)`, `a < b`, ascending, whose boxes are within the reach of near misses of each other.
pub(super) fn candidates(bodies: &[Body], spec: &ContactSpec) -> Vec<(usize, usize, Limits)> {
    let reach = limits::near(spec);
    let loose = |b: &Body| aabb(&b.bounds.loosened(reach * b.block.size + COORDINATE_ROUNDING * b.bounds.reach()));
    let boxes: Vec<Aabb> = bodies.iter().map(loose).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    let mut pairs = Vec::new();
    for (a, body) in bodies.iter().enumerate() {
        let start = pairs.len();
        for b in tree.intersect_aabb(&boxes[a]).map(|b| b as usize).filter(|&b| b > a) {
            let limits = Limits::of(body, &bodies[b], spec);
            if body.bounds.distance(&bodies[b].bounds) <= limits.near {
                pairs.push((a, b, limits));
            }
        }
        pairs[start..].sort_unstable_by_key(|&(_, b, _)| b);
    }
    pairs
}

fn aabb(bounds: &Bounds) -> Aabb {
    let vector = |v: &nalgebra::Vector3<f64>| Vector::new(v.x, v.y, v.z);
    Aabb::new(vector(&bounds.lo), vector(&bounds.hi))
}
