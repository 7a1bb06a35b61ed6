//! Spheres: exact nearest points.
//!
//! A sphere touches a polyhedron wherever the distance from its centre to the surface has a local least value equal to the radius:
//! one point on a convex block, two in the groove of a non-convex one.

use super::{
    body::{Bounds, Solidity, unit},
    features::{Touch, nearest_on_segment},
    limits::Limits,
    overlap,
    plane::Plane,
    polygon::{self, P2},
};
use crate::tolerance::CONTACT_ROUNDING_ANGLE;
use nalgebra::Vector3;

/// What a sphere has to do with another block.
#[derive(Debug, Default)]
pub(super) struct Meeting {
    /// Contacts.
    pub touches: Vec<Touch>,
    /// Least gap beyond the tolerance, m.
    pub near: Option<f64>,
    /// Greatest overlap beyond the tolerance, m.
    pub overlap: Option<f64>,
}

impl Meeting {
    fn add(&mut self, touch: Touch, limits: &Limits) {
        let gap = touch.gap.mean;
        if gap.abs() <= limits.gap {
            self.touches.push(touch);
        } else if gap > 0.0 && gap <= limits.near {
            self.near = Some(self.near.map_or(gap, |g| g.min(gap)));
        } else if gap < 0.0 {
            self.overlap = Some(self.overlap.map_or(-gap, |g| g.max(-gap)));
        }
    }
}

/// Two spheres, `(centre, radius)`.
pub(super) fn sphere_sphere(a: (Vector3<f64>, f64), b: (Vector3<f64>, f64), limits: &Limits) -> Meeting {
    let mut meeting = Meeting::default();
    let between = b.0 - a.0;
    let n = unit(between);
    if n == Vector3::zeros() {
        meeting.overlap = Some(a.1 + b.1);
        return meeting;
    }
    let gap = between.norm() - a.1 - b.1;
    meeting.add(Touch::point(n, a.0 + n * (a.1 + gap / 2.0), gap), limits);
    meeting
}

/// A sphere against a polyhedron; normals point from the sphere into the polyhedron.
pub(super) fn sphere_polyhedron(center: Vector3<f64>, radius: f64, solid: &Solidity, limits: &Limits) -> Meeting {
    let mut meeting = Meeting::default();
    if let Some(depth) = overlap::depth_inside(solid, center) {
        meeting.overlap = Some(radius + depth);
        return meeting;
    }
    let mut feet = feet(center, radius + limits.near, solid, limits);
    feet.sort_by(|p, q| (p - center).norm().total_cmp(&(q - center).norm()));
    let mut taken: Vec<Vector3<f64>> = Vec::new();
    for foot in feet {
        // A foot on a rim is found from several sides.
        if taken.iter().any(|t| (t - foot).norm() <= limits.gap) {
            continue;
        }
        taken.push(foot);
        let n = unit(foot - center);
        let gap = (foot - center).norm() - radius;
        meeting.add(Touch::point(n, foot - n * (gap / 2.0), gap), limits);
        if solid.polyhedron.convex {
            break; // a convex block has one nearest point
        }
    }
    meeting
}

/// Points of the surface, within `reach`, at which the distance to an outer point `c` is locally least.
fn feet(c: Vector3<f64>, reach: f64, solid: &Solidity, limits: &Limits) -> Vec<Vector3<f64>> {
    let window = Bounds { lo: c, hi: c }.loosened(reach);
    let mut feet = Vec::new();
    for (_, facet) in solid.facets_in(&window) {
        let height = facet.normal.dot(&c) - facet.offset;
        let plane = Plane::new(c - facet.normal * height, facet.normal);
        let over = |piece: &Vec<u32>| {
            let corners: Vec<P2> = piece.iter().map(|&v| plane.flat(solid.at(v))).collect();
            polygon::contains(&corners, P2::zeros(), limits.weld)
        };
        if (0.0..=reach).contains(&height) && facet.pieces.iter().any(over) {
            feet.push(plane.origin);
        }
    }
    // Outside the cone of directions along the surface: no way along it comes nearer.
    let farther = |d: Vector3<f64>, along: &Vector3<f64>| d.dot(along) <= CONTACT_ROUNDING_ANGLE * d.norm();
    for edge in solid.edges_in(&window).filter(|e| e.convex) {
        let [p, q] = solid.ends(edge.ends);
        let foot = nearest_on_segment(c, p, q);
        let d = c - foot;
        if foot != p && foot != q && d.norm() <= reach && edge.into.iter().all(|t| farther(d, t)) {
            feet.push(foot);
        }
    }
    for (corner, &v) in solid.topology().corners.iter().zip(&solid.polyhedron.vertices) {
        let d = c - v;
        if d.norm() <= reach && !corner.along.is_empty() && corner.along.iter().all(|u| farther(d, u)) && corner.outward.dot(&d) > 0.0 {
            feet.push(v);
        }
    }
    feet
}
