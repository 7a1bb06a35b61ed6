//! Face against face.
//!
//! Two facets face each other where their normals are opposite within the angle. Each convex piece
//! of one is cut by each convex piece of the other in a plane between them, and the gap is measured
//! **at the corners of what is left**, not at the corners of the facets: a slab may be a hundred
//! thousand times longer than the block it carries. They touch where the gap is within the
//! tolerance at all these corners. Facets that are not plane stand for their mean planes, and both
//! tolerances grow with their warp: two blocks that share part of a warped joint have different
//! mean planes there, apart by up to the warp and leaning from each other by up to twice the warp
//! over the width of the facet.
//!
//! All facet pairs of two blocks that touch on one plane make one contact: its points are the
//! convex hull, exact for rigid blocks with Coulomb friction, because a force at an inner point is
//! a combination of forces at the hull's corners.

use super::{
    body::{Bounds, Solidity, unit},
    clip::clip,
    limits::Limits,
    plane::Plane,
    polygon::{self, P2},
};
use crate::assembly::Facet;
use base::tolerance;
use nalgebra::Vector3;

/// What the faces of two blocks have to do with each other.
#[derive(Debug, Default)]
pub(super) struct Facing {
    /// Contacts, one per plane.
    pub contacts: Vec<FaceContact>,
    /// The nearest pair of facing facets left apart.
    pub near: Option<NearMiss>,
    /// Contacts below `min_area`: ignored, but known, so that their corners are not found again.
    pub small: Vec<FaceContact>,
}

/// A contact of two blocks on one plane.
#[derive(Debug)]
pub(super) struct FaceContact {
    /// Origin and frame; the normal points from `a` into `b`.
    pub plane: Plane,
    /// Corners of the hull, counter-clockwise, in the plane.
    pub hull: Vec<P2>,
    /// Convex pieces, in the plane.
    pub pieces: Vec<Vec<P2>>,
    /// Sum of the pieces' areas, m².
    pub area: f64,
    /// Connected patches.
    pub patches: usize,
    /// Least, mean and greatest gap, m.
    pub gap: Gap,
}

/// Gaps of one contact, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    pub least: f64,
    pub mean: f64,
    pub greatest: f64,
}

/// Facing facets that nearly touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearMiss {
    /// Mean gap, m; negative where they overlap.
    pub gap: f64,
    /// What would join them.
    pub closing: Closing,
    /// A point between the facets.
    pub at: Vector3<f64>,
    /// Normal from `a` into `b`.
    pub n: Vector3<f64>,
}

/// What would have to be tolerated for two blocks to touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closing {
    /// Gap or overlap at the corner where it is greatest, less the warp, m.
    pub gap: f64,
    /// `|n_a + n_b|`, less what the warp explains.
    pub lean: f64,
}

impl Closing {
    /// Whether facets with these gaps, which do not touch, nearly do.
    fn is_near(&self, gap: &Gap, limits: &Limits) -> bool {
        // Facets that are parallel enough nearly touch with their nearest corner, others only as a
        // whole.
        self.gap <= limits.near
            || self.lean <= limits.chord && gap.least >= -limits.near && gap.least <= limits.near
    }
}

/// What two facets have in common, seen along their normals.
struct Overlay {
    n: Vector3<f64>,
    /// Convex pieces half-way between the facets.
    pieces: Vec<Vec<Vector3<f64>>>,
    area: f64,
    centroid: Vector3<f64>,
    gap: Gap,
    /// Least width of the narrower facet, for telling rims from narrow bearings.
    facets: [usize; 2],
}

/// Matches all facets of `a` with all facets of `b`.
pub(super) fn facing(a: &Solidity, b: &Solidity, window: &Bounds, limits: &Limits) -> Facing {
    let mut facing = Facing::default();
    let (mut touching, mut apart) = (Vec::new(), Vec::new());
    let of_b: Vec<_> = b.facets_in(window).collect();
    for (i, fa) in a.facets_in(window) {
        for &(j, fb) in &of_b {
            // The plane of a warped facet is known no better than its warp, and its direction no
            // better than its twist.
            let lean = limits.lean(&fa.normal, &fb.normal, a.facet_twist[i] + b.facet_twist[j]);
            if lean > limits.near_chord
                || a.facet_bounds[i].distance(&b.facet_bounds[j]) > limits.near
            {
                continue;
            }
            let Some(overlay) = overlay(a, b, [i, j], limits) else { continue };
            let closing = Closing {
                gap: overlay.gap.greatest.max(-overlay.gap.least) - fa.warp - fb.warp,
                lean,
            };
            if closing.gap <= limits.gap && lean <= limits.chord {
                touching.push(overlay);
            } else if overlay.area >= limits.min_area && closing.is_near(&overlay.gap, limits) {
                apart.push((closing, overlay));
            }
        }
    }
    for group in by_plane(touching, limits) {
        let contact = join(&group.iter().collect::<Vec<_>>(), limits);
        if is_rim(&contact, &group[0], a, b, limits) {
            continue;
        }
        if contact.area < limits.min_area {
            facing.small.push(contact);
        } else {
            facing.contacts.push(contact);
        }
    }
    drop_far_sides(&mut facing.contacts, limits);
    // Convex blocks that meet face to face meet nowhere else.
    if facing.contacts.is_empty() || !(a.polyhedron.convex && b.polyhedron.convex) {
        apart.sort_by(|(x, _), (y, _)| x.gap.total_cmp(&y.gap));
        facing.near = apart.iter().find_map(|(closing, overlay)| {
            near_miss(*closing, overlay, &facing.contacts, a, b, limits)
        });
    }
    facing
}

/// A near miss of two facets, unless a contact lies there already or there would be none even if
/// they were closed.
fn near_miss(
    closing: Closing,
    overlay: &Overlay,
    contacts: &[FaceContact],
    a: &Solidity,
    b: &Solidity,
    limits: &Limits,
) -> Option<NearMiss> {
    let closed = Limits { gap: closing.gap.max(limits.gap), ..*limits };
    // Where the blocks touch already, facets that lean only belong to the same rounded surface.
    let known = contacts
        .iter()
        .any(|c| closing.lean > limits.chord || c.covers(overlay.centroid, &overlay.n, limits));
    (!known && !is_rim(&join(&[overlay], limits), overlay, a, b, &closed)).then_some(NearMiss {
        gap: overlay.gap.mean,
        closing,
        at: overlay.centroid,
        n: overlay.n,
    })
}

/// Two plates thinner than the gap tolerance meet twice within it: face to face, and back to back
/// as if each had gone through the other. Of contacts with opposite normals only the one that
/// closes less is kept.
fn drop_far_sides(contacts: &mut Vec<FaceContact>, limits: &Limits) {
    let closes: Vec<(Plane, f64)> = contacts.iter().map(|c| (c.plane, c.gap.mean.abs())).collect();
    contacts.retain(|c| {
        !closes.iter().any(|(plane, less)| {
            *less < c.gap.mean.abs()
                && plane.frame.n.dot(&c.plane.frame.n) < -0.9
                && plane.height(c.plane.origin).abs() <= 2.0 * limits.gap
        })
    });
}

/// Lays two facets over each other; `None` where they have no area in common.
fn overlay(a: &Solidity, b: &Solidity, facets: [usize; 2], limits: &Limits) -> Option<Overlay> {
    let (fa, fb) = (&a.polyhedron.facets[facets[0]], &b.polyhedron.facets[facets[1]]);
    // Weighted by area: the larger facet knows its plane better.
    let n = unit(fa.normal * fa.area - fb.normal * fb.area);
    if n == Vector3::zeros() {
        return None;
    }
    let common = a.facet_bounds[facets[0]]
        .loosened(limits.near)
        .common(&b.facet_bounds[facets[1]].loosened(limits.near));
    let plane = Plane::new((common.lo + common.hi) / 2.0, n);
    let flat = |s: &Solidity, f: &Facet, reversed: bool| -> Vec<Vec<P2>> {
        let loops = f.pieces.iter().map(|piece| {
            let mut corners: Vec<P2> = piece.iter().map(|&v| plane.flat(s.at(v))).collect();
            if reversed {
                corners.reverse();
            }
            corners
        });
        loops.collect()
    };
    let (of_a, of_b) = (flat(a, fa, false), flat(b, fb, true));
    // The smaller facet is the one to be cut: its corners carry the smaller rounding.
    let (subjects, clips) = if fa.area <= fb.area { (&of_a, &of_b) } else { (&of_b, &of_a) };
    let boxes: Vec<_> = clips.iter().map(|c| extent(c)).collect();

    // Height of a facet's plane over a point of the common plane, along n.
    let height = |f: &Facet, x: Vector3<f64>| (f.offset - f.normal.dot(&x)) / f.normal.dot(&n);
    let mut result = Overlay {
        n,
        pieces: Vec::new(),
        area: 0.0,
        centroid: Vector3::zeros(),
        gap: Gap { least: f64::INFINITY, mean: 0.0, greatest: f64::NEG_INFINITY },
        facets,
    };
    for subject in subjects {
        let (lo, hi) = extent(subject);
        for (other, (other_lo, other_hi)) in clips.iter().zip(&boxes) {
            if lo.x > other_hi.x || lo.y > other_hi.y || other_lo.x > hi.x || other_lo.y > hi.y {
                continue;
            }
            let piece = clip(subject, other, limits.weld);
            let area = polygon::area(&piece);
            if piece.is_empty() || area <= limits.weld * polygon::perimeter(&piece) {
                continue; // rounding along a shared side
            }
            let gap_at = |p: P2| {
                let x = plane.lift(p);
                let (below, above) = (height(fa, x), height(fb, x));
                (above - below, x + n * ((above + below) / 2.0))
            };
            let mut corners = Vec::with_capacity(piece.len());
            for &p in &piece {
                let (gap, between) = gap_at(p);
                result.gap.least = result.gap.least.min(gap);
                result.gap.greatest = result.gap.greatest.max(gap);
                corners.push(between);
            }
            let (gap, between) = gap_at(polygon::centroid(&piece));
            result.gap.mean += gap * area;
            result.centroid += (between - plane.origin) * area;
            result.area += area;
            result.pieces.push(corners);
        }
    }
    if result.pieces.is_empty() {
        return None;
    }
    result.gap.mean /= result.area;
    result.centroid = plane.origin + result.centroid / result.area;
    Some(result)
}

fn extent(polygon: &[P2]) -> (P2, P2) {
    polygon
        .iter()
        .fold((P2::repeat(f64::INFINITY), P2::repeat(f64::NEG_INFINITY)), |(lo, hi), p| {
            (lo.inf(p), hi.sup(p))
        })
}

/// Sorts overlays by the plane they lie on, largest first.
fn by_plane(mut overlays: Vec<Overlay>, limits: &Limits) -> Vec<Vec<Overlay>> {
    overlays.sort_by(|p, q| q.area.total_cmp(&p.area));
    let mut groups: Vec<Vec<Overlay>> = Vec::new();
    for overlay in overlays {
        let lies_on = |first: &Overlay| {
            (overlay.n - first.n).norm() <= limits.chord
                && overlay
                    .pieces
                    .iter()
                    .flatten()
                    .all(|p| (p - first.centroid).dot(&first.n).abs() <= limits.gap)
                && first
                    .pieces
                    .iter()
                    .flatten()
                    .all(|p| (p - overlay.centroid).dot(&overlay.n).abs() <= limits.gap)
        };
        match groups.iter().position(|g| lies_on(&g[0])) {
            Some(k) => groups[k].push(overlay),
            None => groups.push(vec![overlay]),
        }
    }
    groups
}

/// One contact out of overlays on one plane.
fn join(overlays: &[&Overlay], limits: &Limits) -> FaceContact {
    let area: f64 = overlays.iter().map(|o| o.area).sum();
    let first = overlays[0].centroid;
    let centroid =
        first + overlays.iter().map(|o| (o.centroid - first) * o.area).sum::<Vector3<f64>>() / area;
    let plane = Plane::new(centroid, unit(overlays.iter().map(|o| o.n * o.area).sum()));
    let pieces: Vec<Vec<P2>> = overlays
        .iter()
        .flat_map(|o| &o.pieces)
        .map(|piece| piece.iter().map(|&p| plane.flat(p)).collect())
        .collect();
    let hull = polygon::hull(&pieces.concat(), limits.weld);
    FaceContact {
        patches: patches(&pieces, limits.weld),
        area,
        gap: Gap {
            least: overlays.iter().map(|o| o.gap.least).fold(f64::INFINITY, f64::min),
            mean: overlays.iter().map(|o| o.gap.mean * o.area).sum::<f64>() / area,
            greatest: overlays.iter().map(|o| o.gap.greatest).fold(f64::NEG_INFINITY, f64::max),
        },
        plane,
        hull,
        pieces,
    }
}

/// Number of connected patches among convex pieces; pieces that meet along a side or in a point are
/// connected.
fn patches(pieces: &[Vec<P2>], tol: f64) -> usize {
    let extents: Vec<_> = pieces.iter().map(|p| extent(p)).collect();
    let near = |i: usize, j: usize| {
        let ((lo, hi), (other_lo, other_hi)) = (extents[i], extents[j]);
        lo.x <= other_hi.x + tol
            && lo.y <= other_hi.y + tol
            && other_lo.x <= hi.x + tol
            && other_lo.y <= hi.y + tol
    };
    let mut unvisited: Vec<usize> = (0..pieces.len()).collect();
    let mut count = 0;
    while let Some(seed) = unvisited.pop() {
        count += 1;
        let mut front = vec![seed];
        while let Some(i) = front.pop() {
            unvisited.retain(|&j| {
                let joined = near(i, j) && polygon::touch(&pieces[i], &pieces[j], 4.0 * tol);
                if joined {
                    front.push(j);
                }
                !joined
            });
        }
    }
    count
}

/// Whether a contact is only the rim of two faces that just overlap: no wider than the gap that is
/// closed anyway, while both faces are much wider. (The edge of a thin plate is a bearing: the
/// contact is narrow because the face is.)
fn is_rim(
    contact: &FaceContact,
    overlay: &Overlay,
    a: &Solidity,
    b: &Solidity,
    limits: &Limits,
) -> bool {
    let width = polygon::width(&contact.hull);
    if width > limits.gap {
        return false;
    }
    let facet_width = |s: &Solidity, f: usize| {
        let corners: Vec<P2> = s.polyhedron.facets[f]
            .pieces
            .iter()
            .flatten()
            .map(|&v| contact.plane.flat(s.at(v)))
            .collect();
        polygon::width(&polygon::hull(&corners, 0.0))
    };
    width
        < tolerance::RIM_SHARE
            * facet_width(a, overlay.facets[0]).min(facet_width(b, overlay.facets[1]))
}

impl FaceContact {
    /// Whether the contact is the whole of its hull.
    pub fn fills_hull(&self, limits: &Limits) -> bool {
        self.patches == 1
            && polygon::area(&self.hull) - self.area
                <= 4.0 * limits.weld * polygon::perimeter(&self.hull)
    }

    /// Whether `p`, touched along a normal `n`, lies on this contact already.
    pub fn covers(&self, p: Vector3<f64>, n: &Vector3<f64>, limits: &Limits) -> bool {
        self.hull.len() > 2
            && self.plane.frame.n.dot(n) > 0.9
            && self.plane.height(p).abs() <= limits.gap.max(-self.gap.least).max(self.gap.greatest)
            && polygon::contains(&self.hull, self.plane.flat(p), limits.gap)
    }
}
