//! Edges and corners: an edge on a face, a corner on a face, two crossing edges.
//!
//! Own geometry, not parry's `contact` or `closest_points`: those give one point of what may be a
//! whole edge, and a normal that is wrong for exactly touching aligned hulls. Here the feature
//! gives the normal: the face's, or the common perpendicular of two crossing edges; and the same
//! test serves convex and non-convex blocks, because it only looks at the neighbourhood of the
//! touch. A touch counts where neither block digs into the other there: around an edge both facets,
//! around a corner all sides, lie on the outer side.
//!
//! Edges along each other, an edge on a face's rim, a corner on an edge and two corners may have many
//! normals: they are [rims](super::rims).

use super::{
    body::{Bounds, Edge, Solidity, unit},
    faces::Gap,
    limits::Limits,
    plane::Plane,
    polygon::{self, P2},
};
use base::tolerance::CONTACT_ROUNDING_ANGLE;
use nalgebra::Vector3;

/// A contact along an edge (two points) or at one point.
#[derive(Debug)]
pub(super) struct Touch {
    /// Unit normal from `a` into `b`.
    pub n: Vector3<f64>,
    /// Where it is not the only one: the outermost of all.
    pub ways: Vec<Vector3<f64>>,
    /// The two ends of the edge, or the point, half-way between the blocks.
    pub points: Vec<Vector3<f64>>,
    /// Pieces of the edge that touch.
    pub patches: usize,
    /// Gap, m.
    pub gap: Gap,
}

/// An edge of one block on a facet of the other.
struct Segment {
    n: Vector3<f64>,
    ends: [Vector3<f64>; 2],
    gaps: [f64; 2],
}

impl Segment {
    fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

/// Whether a point, touched along a normal, lies on a contact already found.
pub(super) type Known<'a> = &'a dyn Fn(Vector3<f64>, &Vector3<f64>) -> bool;

/// All touches of edges and corners that are not `known` already.
pub(super) fn touches(
    a: &Solidity,
    b: &Solidity,
    window: &Bounds,
    limits: &Limits,
    known: Known,
) -> Vec<Touch> {
    let mut segments = Vec::new();
    edges_on_facets(a, b, -1.0, window, limits, &mut segments);
    edges_on_facets(b, a, 1.0, window, limits, &mut segments);
    segments.retain(|s| !s.ends.iter().all(|&p| known(p, &s.n)));
    let mut touches: Vec<Touch> = by_line(segments, limits);

    let mut points = Vec::new();
    corners_on_facets(a, b, -1.0, window, limits, &mut points);
    corners_on_facets(b, a, 1.0, window, limits, &mut points);
    crossing_edges(a, b, window, limits, &mut points);
    for point in points {
        let p = point.points[0];
        if !known(p, &point.n) && !touches.iter().any(|t| t.covers(p, &point.n, limits)) {
            touches.push(point);
        }
    }
    touches
}

impl Touch {
    pub(super) fn point(n: Vector3<f64>, at: Vector3<f64>, gap: f64) -> Self {
        Self {
            n,
            ways: Vec::new(),
            points: vec![at],
            patches: 1,
            gap: Gap { least: gap, mean: gap, greatest: gap },
        }
    }

    fn covers(&self, p: Vector3<f64>, n: &Vector3<f64>, limits: &Limits) -> bool {
        let (start, end) = (self.points[0], self.points[self.points.len() - 1]);
        self.n.dot(n) > 0.9 && distance_to_segment(p, start, end) <= limits.gap
    }
}

/// Edges of `s` on facets of `o`; `sign` turns the facet's normal so that it points from `a` into
/// `b`.
fn edges_on_facets(
    s: &Solidity,
    o: &Solidity,
    sign: f64,
    window: &Bounds,
    limits: &Limits,
    found: &mut Vec<Segment>,
) {
    // Shorter than the side of the least contact area is no edge contact.
    let shortest = limits.min_area.sqrt().max(limits.gap);
    for edge in s.edges_in(window).filter(|e| e.convex) {
        let [p, q] = s.ends(edge.ends);
        let bounds = Bounds::around(&[p, q]).loosened(limits.gap);
        for (i, facet) in o.facets_in(&bounds) {
            let n = facet.normal;
            if edge.into.iter().any(|t| t.dot(&n) < -CONTACT_ROUNDING_ANGLE) {
                continue;
            }
            let height = |x: &Vector3<f64>| n.dot(x) - facet.offset;
            let (hp, hq) = (height(&p), height(&q));
            if hp.min(hq) > limits.gap || hp.max(hq) < -limits.gap {
                continue;
            }
            let plane = Plane::new(p - n * hp, n);
            for [from, to] in inside(o, i, &plane, plane.flat(p), plane.flat(q), limits.weld) {
                let gaps = [hp + (hq - hp) * from, hp + (hq - hp) * to];
                let at = |t: f64, gap: f64| p + (q - p) * t - n * (gap / 2.0);
                let segment =
                    Segment { n: n * sign, ends: [at(from, gaps[0]), at(to, gaps[1])], gaps };
                let in_interior = [0.25, 0.5, 0.75]
                    .iter()
                    .any(|t| off_rim(o, i, p + (q - p) * (from + (to - from) * t), limits));
                if gaps.iter().all(|g| g.abs() <= limits.gap)
                    && segment.length() > shortest
                    && in_interior
                {
                    found.push(segment);
                }
            }
        }
    }
}

/// Intervals of the segment `p`–`q` over a facet, as fractions, ascending, merged where they meet.
fn inside(s: &Solidity, facet: usize, plane: &Plane, p: P2, q: P2, tol: f64) -> Vec<[f64; 2]> {
    let length = (q - p).norm();
    let mut intervals: Vec<[f64; 2]> = Vec::new();
    if length <= tol {
        return intervals;
    }
    for piece in &s.polyhedron.facets[facet].pieces {
        let corners: Vec<P2> = piece.iter().map(|&v| plane.flat(s.at(v))).collect();
        let [mut from, mut to] = [0.0f64, 1.0f64];
        for (a, b) in polygon::edges(&corners) {
            let side = (b - a).norm();
            if side <= tol {
                continue;
            }
            let (dp, dq) = (polygon::cross(a, b, p) / side, polygon::cross(a, b, q) / side);
            if dp < -tol && dq < -tol {
                to = -1.0;
            } else if dp < -tol && dq > tol {
                from = from.max(dp / (dp - dq));
            } else if dp > tol && dq < -tol {
                to = to.min(dp / (dp - dq));
            } else if dp < -tol {
                from = 1.0;
            } else if dq < -tol {
                to = 0.0;
            }
        }
        if to - from > tol / length {
            intervals.push([from, to]);
        }
    }
    merge(intervals, 4.0 * tol / length)
}

/// Sorts intervals and joins those no further apart than `tol`.
fn merge(mut intervals: Vec<[f64; 2]>, tol: f64) -> Vec<[f64; 2]> {
    intervals.sort_by(|x, y| x[0].total_cmp(&y[0]));
    let mut merged: Vec<[f64; 2]> = Vec::new();
    for [from, to] in intervals {
        match merged.last_mut() {
            Some(last) if from <= last[1] + tol => last[1] = last[1].max(to),
            _ => merged.push([from, to]),
        }
    }
    merged
}

/// Whether a point on a facet is further than the gap from the facet's rim.
fn off_rim(s: &Solidity, facet: usize, p: Vector3<f64>, limits: &Limits) -> bool {
    s.topology().rims[facet].iter().all(|&side| {
        let [a, b] = s.ends(side);
        distance_to_segment(p, a, b) > limits.gap
    })
}

/// Joins segments on one line: an edge over two feet is one contact with two patches.
fn by_line(mut segments: Vec<Segment>, limits: &Limits) -> Vec<Touch> {
    segments.sort_by(|x, y| y.length().total_cmp(&x.length()));
    let mut lines: Vec<Vec<Segment>> = Vec::new();
    for segment in segments {
        let on_line = |first: &Segment| {
            let along = unit(first.ends[1] - first.ends[0]);
            let off = |p: &Vector3<f64>| (p - first.ends[0]).cross(&along).norm();
            (segment.n - first.n).norm() <= limits.chord
                && segment.ends.iter().all(|p| off(p) <= limits.gap)
        };
        match lines.iter().position(|line| on_line(&line[0])) {
            Some(k) => lines[k].push(segment),
            None => lines.push(vec![segment]),
        }
    }
    lines.iter().map(|line| edge_contact(line, limits)).collect()
}

fn edge_contact(line: &[Segment], limits: &Limits) -> Touch {
    let (start, along) = (line[0].ends[0], unit(line[0].ends[1] - line[0].ends[0]));
    let n = unit(line.iter().map(|s| s.n * s.length()).sum());
    let place = |p: Vector3<f64>| (p - start).dot(&along);
    let interval = |s: &Segment| {
        let (x, y) = (place(s.ends[0]), place(s.ends[1]));
        [x.min(y), x.max(y)]
    };
    let patches = merge(line.iter().map(interval).collect(), limits.gap).len();
    let mut ends: Vec<Vector3<f64>> = line.iter().flat_map(|s| s.ends).collect();
    ends.sort_by(|p, q| place(*p).total_cmp(&place(*q)));
    let gaps = || line.iter().flat_map(|s| s.gaps);
    Touch {
        n,
        ways: Vec::new(),
        points: vec![ends[0], ends[ends.len() - 1]],
        patches,
        gap: Gap {
            least: gaps().fold(f64::INFINITY, f64::min),
            mean: line.iter().map(|s| (s.gaps[0] + s.gaps[1]) / 2.0 * s.length()).sum::<f64>()
                / line.iter().map(Segment::length).sum::<f64>(),
            greatest: gaps().fold(f64::NEG_INFINITY, f64::max),
        },
    }
}

/// Corners of `s` on facets of `o`.
fn corners_on_facets(
    s: &Solidity,
    o: &Solidity,
    sign: f64,
    window: &Bounds,
    limits: &Limits,
    found: &mut Vec<Touch>,
) {
    for (corner, &v) in s.topology().corners.iter().zip(&s.polyhedron.vertices) {
        let here = Bounds { lo: v, hi: v }.loosened(limits.gap);
        if corner.along.is_empty() || !here.meets(window) {
            continue;
        }
        for (i, facet) in o.facets_in(&here) {
            let n = facet.normal;
            let height = n.dot(&v) - facet.offset;
            let outside = corner.along.iter().all(|u| u.dot(&n) >= -CONTACT_ROUNDING_ANGLE)
                && corner.outward.dot(&n) < 0.0;
            if height.abs() > limits.gap || !outside {
                continue;
            }
            let plane = Plane::new(v - n * height, n);
            let over = facet.pieces.iter().any(|piece| {
                let corners: Vec<P2> = piece.iter().map(|&v| plane.flat(o.at(v))).collect();
                polygon::contains(&corners, P2::zeros(), limits.weld)
            });
            if over && off_rim(o, i, plane.origin, limits) {
                found.push(Touch::point(n * sign, v - n * (height / 2.0), height));
            }
        }
    }
}

/// Where edges of `a` and `b` cross, their common perpendicular keeping the blocks apart.
fn crossing_edges(
    a: &Solidity,
    b: &Solidity,
    window: &Bounds,
    limits: &Limits,
    found: &mut Vec<Touch>,
) {
    for (ea, eb) in edge_pairs(a, b, window, limits.gap) {
        if !(ea.convex && eb.convex) {
            continue;
        }
        let ([pa, qa], [pb, qb]) = (a.ends(ea.ends), b.ends(eb.ends));
        let Some(n) = separating(ea, eb, qa - pa, qb - pb) else { continue };
        if unit(qa - pa).cross(&unit(qb - pb)).norm() <= limits.chord {
            continue; // as good as parallel
        }
        let (ta, tb) = nearest_of_lines(pa, qa, pb, qb);
        let (xa, xb) = (pa + (qa - pa) * ta, pb + (qb - pb) * tb);
        let within =
            |t: f64, length: f64| t * length > limits.weld && (1.0 - t) * length > limits.weld;
        let gap = (xb - xa).dot(&n);
        if within(ta, (qa - pa).norm()) && within(tb, (qb - pb).norm()) && gap.abs() <= limits.gap {
            found.push(Touch::point(n, (xa + xb) / 2.0, gap));
        }
    }
}

/// The common perpendicular of two edges, from `a` into `b`, if the blocks lie on different sides
/// of it near the edges (the arcs of their facets' normals cross on the sphere of directions).
pub(super) fn separating(
    ea: &Edge,
    eb: &Edge,
    along_a: Vector3<f64>,
    along_b: Vector3<f64>,
) -> Option<Vector3<f64>> {
    let n = unit(along_a.cross(&along_b));
    let apart = |n: &Vector3<f64>| {
        ea.into.iter().all(|t| t.dot(n) < -CONTACT_ROUNDING_ANGLE)
            && eb.into.iter().all(|t| t.dot(n) > CONTACT_ROUNDING_ANGLE)
    };
    [n, -n].into_iter().find(apart)
}

/// Edges of `a` and `b` whose boxes come within `reach` of each other.
pub(super) fn edge_pairs<'s>(
    a: &'s Solidity,
    b: &'s Solidity,
    window: &Bounds,
    reach: f64,
) -> Vec<(&'s Edge, &'s Edge)> {
    let boxed = |s: &'s Solidity| -> Vec<(&'s Edge, Bounds)> {
        s.edges_in(window)
            .map(|e| (e, Bounds::around(&s.ends(e.ends)).loosened(reach / 2.0)))
            .collect()
    };
    let of_b = boxed(b);
    let mut pairs = Vec::new();
    for (ea, around) in boxed(a) {
        pairs.extend(of_b.iter().filter(|(_, other)| around.meets(other)).map(|&(eb, _)| (ea, eb)));
    }
    pairs
}

/// Fractions along two segments at which their lines come closest; beyond 0..1 where that is off
/// the segment, NaN where parallel.
fn nearest_of_lines(
    pa: Vector3<f64>,
    qa: Vector3<f64>,
    pb: Vector3<f64>,
    qb: Vector3<f64>,
) -> (f64, f64) {
    let (u, v, w) = (qa - pa, qb - pb, pb - pa);
    let n = u.cross(&v);
    let square = n.norm_squared();
    (w.cross(&v).dot(&n) / square, w.cross(&u).dot(&n) / square)
}

/// Distance of a point from a segment.
pub(super) fn distance_to_segment(p: Vector3<f64>, a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    (p - nearest_on_segment(p, a, b)).norm()
}

/// The point of a segment nearest to `p`.
pub(super) fn nearest_on_segment(
    p: Vector3<f64>,
    a: Vector3<f64>,
    b: Vector3<f64>,
) -> Vector3<f64> {
    let along = b - a;
    let square = along.norm_squared();
    let s = if square > 0.0 { ((p - a).dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
    a + along * s
}
