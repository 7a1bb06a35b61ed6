//! Vertices in the middle of another face's edge: the edge is split there, so that neighbours share
//! whole edges.

use super::{
    Mend,
    surface::{HalfEdge, Surface, edges},
    weld::tidy,
};
use base::tolerance;
use std::collections::HashMap;

/// Splits edges at corners closer to them than [`tolerance::WELD`] × size.
///
/// Only edges with an odd number of faces are looked at, and only their ends can lie in the middle
/// of another: a closed surface has none. Returns the half-edges of the result.
pub(super) fn split_edges(surface: &mut Surface, mends: &mut Vec<Mend>) -> Vec<HalfEdge> {
    let list = surface.half_edges();
    let odd: Vec<(u32, u32)> =
        edges(&list).filter(|e| e.len() % 2 == 1).map(|e| (e[0].low, e[0].high)).collect();
    if odd.is_empty() {
        return list;
    }
    let mut corners: Vec<u32> = odd.iter().flat_map(|&(a, b)| [a, b]).collect();
    corners.sort_unstable();
    corners.dedup();

    // Along the longest axis an edge meets the fewest corners.
    let (mut low, mut high) = (surface.point(corners[0]), surface.point(corners[0]));
    for &c in &corners {
        low = low.inf(&surface.point(c));
        high = high.sup(&surface.point(c));
    }
    let axis = (high - low).imax();
    let along = |c: u32| surface.point(c)[axis];
    corners.sort_unstable_by(|&a, &b| along(a).total_cmp(&along(b)));

    let reach = tolerance::WELD * surface.size;
    let mut splits: HashMap<(u32, u32), Vec<u32>> = HashMap::new();
    let mut put = 0;
    for &(a, b) in &odd {
        let (from, way) = (surface.point(a), surface.point(b) - surface.point(a));
        let square = way.norm_squared();
        let (least, most) = (along(a).min(along(b)) - reach, along(a).max(along(b)) + reach);
        let first = corners.partition_point(|&c| along(c) < least);
        let mut inner: Vec<(f64, u32)> = corners[first..]
            .iter()
            .take_while(|&&c| along(c) <= most)
            .filter(|&&c| c != a && c != b)
            .filter_map(|&c| {
                let r = surface.point(c) - from;
                let t = r.dot(&way) / square;
                (t > 0.0 && t < 1.0 && (r - way * t).norm() <= reach).then_some((t, c))
            })
            .collect();
        if !inner.is_empty() {
            inner.sort_unstable_by(|x, y| x.0.total_cmp(&y.0));
            put += inner.len();
            splits.insert((a, b), inner.into_iter().map(|(_, c)| c).collect());
        }
    }
    let Some(at) = odd.iter().find_map(|e| splits.get(e)).map(|inner| surface.place(inner[0]))
    else {
        return list;
    };

    for face in &mut surface.faces {
        if !face.edges().any(|(a, b)| splits.contains_key(&(a.min(b), a.max(b)))) {
            continue;
        }
        let mut corners = Vec::with_capacity(face.corners.len() + 1);
        for (a, b) in face.edges() {
            corners.push(a);
            match splits.get(&(a.min(b), a.max(b))) {
                Some(inner) if a < b => corners.extend(inner),
                Some(inner) => corners.extend(inner.iter().rev()),
                None => {}
            }
        }
        tidy(&mut corners);
        face.corners = corners;
    }
    surface.faces.retain(|f| f.corners.len() >= 3);
    mends.push(Mend::Split { vertices: put, at });
    surface.half_edges()
}
