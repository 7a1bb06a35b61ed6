//! The boundary of a facet, and its convex pieces.

use super::{
    plane::{self, Frame},
    surface::Surface,
};
use base::plane::polygon::{self, P2};

/// What bounds a facet and what fills it.
pub(super) struct Outline {
    /// Directed edges with the facet on their left.
    pub boundary: Vec<(u32, u32)>,
    /// Convex loops, counter-clockwise.
    pub pieces: Vec<Vec<u32>>,
}

/// The outline of `faces` as a whole: edges between them vanish, corners within `reach` of a
/// straight edge too, so that nothing is left of the way the facet was cut up.
pub(super) fn outline(
    surface: &Surface,
    faces: &[u32],
    frame: &Frame,
    area: f64,
    reach: f64,
) -> Outline {
    let boundary = boundary(surface, faces);
    let loops = loops(surface, &boundary, frame);
    if let [single] = loops.as_slice() {
        let points: Vec<P2> = single.iter().map(|&c| frame.project(&surface.point(c))).collect();
        if let Some(corners) = plane::convex_corners(&points, reach) {
            let pieces = vec![corners.into_iter().map(|i| single[i]).collect()];
            return Outline { boundary, pieces };
        }
    }
    let pieces = cut(surface, &loops, frame, reach);
    // Earcut promises no correctness where loops touch: believe it only if it fills the area.
    let filled: f64 = pieces.iter().map(|p| piece_area(surface, p, frame)).sum();
    let length: f64 =
        boundary.iter().map(|&(a, b)| (surface.point(b) - surface.point(a)).norm()).sum();
    if (filled - area).abs() <= reach * length {
        return Outline { boundary, pieces };
    }
    let each = faces.iter().flat_map(|&f| {
        cut(surface, std::slice::from_ref(&surface.faces[f as usize].corners), frame, 0.0)
    });
    Outline { pieces: each.collect(), boundary }
}

fn piece_area(surface: &Surface, piece: &[u32], frame: &Frame) -> f64 {
    let points: Vec<P2> = piece.iter().map(|&c| frame.project(&surface.point(c))).collect();
    polygon::area(&points)
}

/// Convex pieces of the region within loops.
fn cut(surface: &Surface, loops: &[Vec<u32>], frame: &Frame, reach: f64) -> Vec<Vec<u32>> {
    let mut corners: Vec<u32> = Vec::new();
    let mut points: Vec<P2> = Vec::new();
    let mut straight: Vec<Vec<usize>> = Vec::new();
    for each in loops {
        let own: Vec<P2> = each.iter().map(|&c| frame.project(&surface.point(c))).collect();
        let base = points.len();
        let kept = plane::straighten(&own, reach);
        if kept.len() >= 3 {
            straight.push(kept.into_iter().map(|i| base + i).collect());
            points.extend(own);
            corners.extend(each);
        }
    }
    plane::convex_pieces(&points, &straight)
        .into_iter()
        .map(|p| p.into_iter().map(|i| corners[i]).collect())
        .collect()
}

/// The edges of `faces` that no other of them runs back along, sorted by where they begin.
fn boundary(surface: &Surface, faces: &[u32]) -> Vec<(u32, u32)> {
    let mut list: Vec<(u32, u32)> =
        faces.iter().flat_map(|&f| surface.faces[f as usize].edges()).collect();
    // Edge and opposite next to each other, then cancelled against one another.
    list.sort_unstable_by_key(|&(a, b)| (a.min(b), a.max(b), a < b));
    let mut kept: Vec<(u32, u32)> = Vec::with_capacity(list.len());
    for edges in list.chunk_by(|x, y| (x.0.min(x.1), x.0.max(x.1)) == (y.0.min(y.1), y.0.max(y.1)))
    {
        let back = edges.iter().filter(|e| e.0 > e.1).count();
        let (less, more) = if 2 * back >= edges.len() {
            (edges.len() - back, edges[0])
        } else {
            (back, edges[edges.len() - 1])
        };
        kept.extend(std::iter::repeat_n(more, edges.len() - 2 * less));
    }
    kept.sort_unstable();
    kept
}

/// Walks along boundary edges. Where several leave a corner, the walk takes the first one clockwise
/// from where it came from: it stays in its own corner of the facet.
fn loops(surface: &Surface, boundary: &[(u32, u32)], frame: &Frame) -> Vec<Vec<u32>> {
    let mut gone = vec![false; boundary.len()];
    let mut loops = Vec::new();
    for first in 0..boundary.len() {
        if gone[first] {
            continue;
        }
        let mut walk = Vec::new();
        let mut edge = first;
        loop {
            gone[edge] = true;
            let (from, to) = boundary[edge];
            walk.push(from);
            let begin = boundary.partition_point(|e| e.0 < to);
            let end = begin + boundary[begin..].partition_point(|e| e.0 == to);
            let mut ahead = (begin..end).filter(|&e| !gone[e]);
            let next = if end - begin == 1 {
                ahead.next()
            } else {
                let at = frame.project(&surface.point(to));
                let angle = |corner: u32| {
                    let p = frame.project(&surface.point(corner));
                    (p[1] - at[1]).atan2(p[0] - at[0])
                };
                let back = angle(from);
                ahead.min_by(|&a, &b| {
                    let clockwise =
                        |e: usize| (back - angle(boundary[e].1)).rem_euclid(std::f64::consts::TAU);
                    clockwise(a).total_cmp(&clockwise(b))
                })
            };
            match next {
                Some(next) => edge = next,
                None => break,
            }
        }
        loops.push(walk);
    }
    loops
}
