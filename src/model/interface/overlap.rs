//! How deep two blocks overlap.
//!
//! Convex blocks: the separating-axis theorem. Two convex polyhedra are apart by the greatest
//! separation over the normals of their facets and the common perpendiculars of those edges whose
//! normal arcs cross (Gottschalk, Lin & Manocha 1996; arcs: Gregorius 2013); its negative is the
//! depth. Parry's expanding-polytope answer is not asked: near touching it may return a wrong
//! normal. Facets that are not plane stand for their mean planes, so that the depth is good to
//! their warp.
//!
//! Non-convex blocks: points of one, corners, parts of edges and points just under the faces, are
//! looked for inside the other. The depth found is a lower bound; an overlap that is deeper than
//! the tolerance at none of these points is missed.

use super::{
    body::{Bounds, Solidity},
    features::{distance_to_segment, separating},
    limits::Limits,
    plane::Plane,
    polygon::{self, P2},
};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Depth of the overlap of two polyhedra if it is more than the gap tolerance, m.
pub(super) fn depth(a: &Solidity, b: &Solidity, common: &Bounds, limits: &Limits) -> Option<f64> {
    let depth = if a.polyhedron.convex && b.polyhedron.convex {
        convex_depth(a, b, limits)?
    } else {
        sampled_depth(a, b, common, limits).max(sampled_depth(b, a, common, limits))
    };
    (depth > limits.gap).then_some(depth)
}

/// Whether every corner of each lies at one of the other: the same block, drawn twice.
pub(super) fn is_twice(a: &Solidity, b: &Solidity, limits: &Limits) -> bool {
    let (a, b) = (&a.polyhedron.vertices, &b.polyhedron.vertices);
    let within = |one: &[Vector3<f64>], other: &[Vector3<f64>]| {
        one.iter().all(|v| other.iter().any(|w| (v - w).norm() <= limits.gap))
    };
    within(a, b) && within(b, a)
}

/// Least overlap over all separating directions; `None` as soon as one keeps the blocks apart
/// within the gap.
fn convex_depth(a: &Solidity, b: &Solidity, limits: &Limits) -> Option<f64> {
    let mut least = f64::INFINITY;
    for (s, o) in [(a, b), (b, a)] {
        for facet in &s.polyhedron.facets {
            let lowest = o
                .polyhedron
                .vertices
                .iter()
                .map(|v| facet.normal.dot(v))
                .fold(f64::INFINITY, f64::min);
            least = least.min(facet.offset - lowest);
            if least <= limits.gap {
                return None;
            }
        }
    }
    for ea in &a.topology().edges {
        let [pa, qa] = a.ends(ea.ends);
        for eb in &b.topology().edges {
            let [pb, qb] = b.ends(eb.ends);
            if let Some(n) = separating(ea, eb, qa - pa, qb - pb) {
                least = least.min((pa - pb).dot(&n));
                if least <= limits.gap {
                    return None;
                }
            }
        }
    }
    Some(least)
}

/// Greatest depth in `o` of sample points of `s`.
fn sampled_depth(s: &Solidity, o: &Solidity, common: &Bounds, limits: &Limits) -> f64 {
    let mut samples: Vec<Vector3<f64>> = s.polyhedron.vertices.clone();
    for edge in s.edges_in(common) {
        let [p, q] = s.ends(edge.ends);
        let mut cuts = vec![0.0, 1.0];
        for (_, facet) in o.facets_in(&Bounds::around(&[p, q])) {
            let (hp, hq) =
                (facet.normal.dot(&p) - facet.offset, facet.normal.dot(&q) - facet.offset);
            if hp * hq < 0.0 {
                cuts.push(hp / (hp - hq));
            }
        }
        cuts.sort_by(f64::total_cmp);
        samples.extend(cuts.windows(2).map(|w| p + (q - p) * ((w[0] + w[1]) / 2.0)));
    }
    for (_, facet) in s.facets_in(common) {
        for piece in &facet.pieces {
            let center = piece.iter().map(|&v| s.at(v)).sum::<Vector3<f64>>() / piece.len() as f64;
            let below =
                [2.0 * limits.gap, 0.02 * limits.size, 0.1 * limits.size, 0.25 * limits.size]
                    .map(|d| center - facet.normal * d);
            samples.extend(
                below.into_iter().filter(|&p| meets(common, p) && depth_inside(s, p).is_some()),
            );
        }
    }
    samples
        .into_iter()
        .filter(|&p| meets(common, p))
        .filter_map(|p| depth_inside(o, p))
        .fold(0.0, f64::max)
}

fn meets(bounds: &Bounds, p: Vector3<f64>) -> bool {
    bounds.meets(&Bounds { lo: p, hi: p })
}

/// Distance of a point inside a polyhedron from its surface; `None` outside.
pub(super) fn depth_inside(s: &Solidity, p: Vector3<f64>) -> Option<f64> {
    let facets = &s.polyhedron.facets;
    let above = |f: &crate::assembly::Facet| f.normal.dot(&p) - f.offset;
    if s.polyhedron.convex {
        // The nearest plane of a convex polyhedron carries the nearest face.
        let height = facets.iter().map(above).fold(f64::NEG_INFINITY, f64::max);
        return (height < 0.0).then_some(-height);
    }
    if winding(s, p) < 0.5 {
        return None;
    }
    let mut least = f64::INFINITY;
    for facet in facets {
        let height = above(facet);
        if height.abs() >= least {
            continue;
        }
        let plane = Plane::new(p - facet.normal * height, facet.normal);
        for piece in &facet.pieces {
            let corners: Vec<P2> = piece.iter().map(|&v| plane.flat(s.at(v))).collect();
            let distance = if polygon::contains(&corners, P2::zeros(), 0.0) {
                height.abs()
            } else {
                (0..piece.len())
                    .map(|k| {
                        distance_to_segment(p, s.at(piece[k]), s.at(piece[(k + 1) % piece.len()]))
                    })
                    .fold(f64::INFINITY, f64::min)
            };
            least = least.min(distance);
        }
    }
    Some(least)
}

/// How often the surface winds around a point: 1 inside, 0 outside; from the solid angles of its
/// triangles (Van Oosterom & Strackee 1983).
fn winding(s: &Solidity, p: Vector3<f64>) -> f64 {
    let mut angle = 0.0;
    for piece in s.polyhedron.facets.iter().flat_map(|f| &f.pieces) {
        for k in 1..piece.len().saturating_sub(1) {
            let [a, b, c] = [piece[0], piece[k], piece[k + 1]].map(|v| s.at(v) - p);
            let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
            angle += 2.0
                * a.dot(&b.cross(&c))
                    .atan2(la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb);
        }
    }
    angle / (4.0 * PI)
}
