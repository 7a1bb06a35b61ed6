//! Spheres, alone or rigidly joined to a clump: exact nearest points.
//!
//! The members of a clump touch each by itself. Where a member would touch at a point inside
//! another member of the same clump there is no surface, and nothing touches.
//!
//! A sphere touches a polyhedron wherever the distance from its centre to the surface has a local
//! least value equal to the radius: one point on a convex block, two in the groove of a non-convex
//! one.

use super::{
    body::{Bounds, Solidity, unit},
    features::{Touch, nearest_on_segment},
    limits::Limits,
    overlap,
    plane::Plane,
    polygon::{self, P2},
};
use base::tolerance::CONTACT_ROUNDING_ANGLE;
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
    /// Takes over what a member met, but for touches at points that are `hidden`.
    fn join(&mut self, other: Self, hidden: impl Fn(&Vector3<f64>) -> bool) {
        self.touches.extend(other.touches.into_iter().filter(|t| !t.points.iter().any(&hidden)));
        let (near, overlap) = (self.near, self.overlap);
        self.near = other.near.map_or(near, |g| Some(near.map_or(g, |n| n.min(g))));
        self.overlap = other.overlap.map_or(overlap, |d| Some(overlap.map_or(d, |o| o.max(d))));
    }

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

/// Whether every member of each lies at one of the other: the same block, drawn twice.
pub(super) fn is_twice(one: &[Ball], other: &[Ball], limits: &Limits) -> bool {
    let within = |one: &[Ball], other: &[Ball]| {
        one.iter()
            .all(|(p, r)| other.iter().any(|(q, s)| (p - q).norm() + (r - s).abs() <= limits.gap))
    };
    one.len() == other.len() && within(one, other) && within(other, one)
}

/// What members `(centre, radius)` of two blocks have to do with each other.
pub(super) fn balls_balls(one: &[Ball], other: &[Ball], limits: &Limits) -> Meeting {
    if let ([a], [b]) = (one, other) {
        return sphere_sphere(*a, *b, limits);
    }
    let mut all = Meeting::default();
    for (i, a) in one.iter().enumerate() {
        for (j, b) in
            other.iter().enumerate().filter(|(_, b)| (a.0 - b.0).norm() <= a.1 + b.1 + limits.near)
        {
            all.join(sphere_sphere(*a, *b, limits), |p| {
                is_inside(p, one, i, limits) || is_inside(p, other, j, limits)
            });
        }
    }
    all
}

/// What members of a block have to do with a polyhedron; normals point into the polyhedron.
pub(super) fn balls_polyhedron(balls: &[Ball], solid: &Solidity, limits: &Limits) -> Meeting {
    if let [ball] = balls {
        return sphere_polyhedron(ball.0, ball.1, solid, limits);
    }
    let mut all = Meeting::default();
    for (i, ball) in balls.iter().enumerate() {
        all.join(sphere_polyhedron(ball.0, ball.1, solid, limits), |p| {
            is_inside(p, balls, i, limits)
        });
    }
    all
}

/// Centre and radius.
type Ball = (Vector3<f64>, f64);

/// Whether a point on one member lies inside another one.
fn is_inside(point: &Vector3<f64>, balls: &[Ball], member: usize, limits: &Limits) -> bool {
    balls.iter().enumerate().any(|(k, (c, r))| k != member && (point - c).norm() < r - limits.gap)
}

/// Two spheres, `(centre, radius)`.
fn sphere_sphere(a: (Vector3<f64>, f64), b: (Vector3<f64>, f64), limits: &Limits) -> Meeting {
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
fn sphere_polyhedron(
    center: Vector3<f64>,
    radius: f64,
    solid: &Solidity,
    limits: &Limits,
) -> Meeting {
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

/// Points of the surface, within `reach`, at which the distance to an outer point `c` is locally
/// least.
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
    let farther =
        |d: Vector3<f64>, along: &Vector3<f64>| d.dot(along) <= CONTACT_ROUNDING_ANGLE * d.norm();
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
        if d.norm() <= reach
            && !corner.along.is_empty()
            && corner.along.iter().all(|u| farther(d, u))
            && corner.outward.dot(&d) > 0.0
        {
            feet.push(v);
        }
    }
    feet
}
