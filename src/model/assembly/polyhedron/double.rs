//! Faces that are listed more than once.

use super::{
    Mend,
    surface::{HalfEdge, Surface, edges},
};
use std::collections::HashMap;

/// Takes faces once that go around the same corners, whichever way round, and returns the
/// half-edges of what is left.
///
/// Only where more than two faces meet in an edge: two faces that close each other are flat, which
/// is told as such.
pub(super) fn take_once(
    surface: &mut Surface,
    list: Vec<HalfEdge>,
    mends: &mut Vec<Mend>,
) -> Vec<HalfEdge> {
    if !edges(&list).any(|edge| edge.len() > 2) {
        return list;
    }
    let mut seen: HashMap<Vec<u32>, usize> = HashMap::with_capacity(surface.faces.len());
    let mut doubled: Option<(usize, usize, usize)> = None;
    surface.faces.retain(|face| {
        let first = *seen.entry(around(&face.corners)).or_insert(face.source);
        if first != face.source {
            doubled = Some(
                doubled.map_or((1, face.source, first), |(n, one, other)| (n + 1, one, other)),
            );
        }
        first == face.source
    });
    let Some((faces, first, repeats)) = doubled else { return list };
    mends.push(Mend::Doubled { faces, first, repeats });
    surface.half_edges()
}

/// The same list for every beginning and both directions: from the least corner on. Where a face
/// passes that corner twice, at a bridge to a hole, it is only known again if it begins alike.
fn around(corners: &[u32]) -> Vec<u32> {
    let from_least = |list: &[u32]| {
        let least = list.iter().enumerate().min_by_key(|(_, c)| **c).map_or(0, |(k, _)| k);
        [&list[least..], &list[..least]].concat()
    };
    let back: Vec<u32> = corners.iter().rev().copied().collect();
    from_least(corners).min(from_least(&back))
}
