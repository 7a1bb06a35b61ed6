//! The greatest horizontal acceleration that a scene bears in every direction.
//!
//! The accelerations under which admissible forces exist are a convex set of the plane. A load
//! factor in one direction is a point of its edge; a polygon of such points lies inside it, so that
//! its distance from the origin is borne in every direction, and the nearest of the points bounds
//! what is. Directions are added where the polygon is nearest.

use crate::{Control, Law, limit};
use check::terms::{Bracket, Outcome};
use model::interface::{ContactFrame, Model};
use nalgebra::Vector3;

/// The bracket is narrowed to this × its upper end. Smaller: more programs.
pub const WITHIN: f64 = 0.02;

/// Directions that are looked at, at most.
pub const MOST_DIRECTIONS: usize = 32;

/// Directions to begin with.
const FIRST: usize = 4;

/// A factor beyond which there is no limit.
const NO_LIMIT: f64 = 1e9;

/// A direction and the load factors that are borne, and not, along it.
struct Ray {
    angle: f64,
    lower: f64,
    upper: f64,
}

/// The margin of a model that stands, in g.
pub(super) fn margin(model: &Model, control: &Control) -> Bracket {
    let gravity = model.assembly.gravity;
    let frame = ContactFrame::around(-gravity / gravity.norm());
    let control = Control { law: Law::Associative, ..*control };
    let mut pushed = model.clone();
    let mut along = |angle: f64| {
        let toward = frame.t1 * angle.cos() + frame.t2 * angle.sin();
        push(&mut pushed, &(toward * gravity.norm()));
        let answer = limit::limit(&pushed, &control);
        let (lower, upper) = match answer.outcome {
            Outcome::Unbounded => (NO_LIMIT, NO_LIMIT),
            // It stands without the push.
            _ => (answer.bracket.lower.max(0.0), answer.bracket.upper),
        };
        let finite = |x: f64, or: f64| if x.is_nan() { or } else { x.min(NO_LIMIT) };
        Ray { angle, lower: finite(lower, 0.0), upper: finite(upper, NO_LIMIT) }
    };
    let turn = std::f64::consts::TAU;
    let mut rays: Vec<Ray> = (0..FIRST).map(|k| along(turn * k as f64 / FIRST as f64)).collect();
    loop {
        let upper = rays.iter().map(|r| r.upper).fold(f64::INFINITY, f64::min);
        let nearest = (0..rays.len())
            .map(|k| side(&rays[k], &rays[(k + 1) % rays.len()]))
            .enumerate()
            .min_by(|(_, x), (_, y)| x.0.total_cmp(&y.0));
        let Some((k, (lower, angle))) = nearest else { return Bracket { lower: 0.0, upper } };
        let lower = lower.min(upper);
        let is_new = (angle - rays[k].angle).abs() > 1e-6;
        if lower >= (1.0 - WITHIN) * upper
            || rays.len() >= MOST_DIRECTIONS
            || control.deadline.is_over()
            || !is_new
        {
            return Bracket { lower, upper };
        }
        rays.insert(k + 1, along(angle));
    }
}

/// How far the side of the polygon between two rays is from the origin, and the direction in which
/// it is looked at next: where it is nearest, or half-way where that is one of its ends.
fn side(one: &Ray, next: &Ray) -> (f64, f64) {
    let turn = std::f64::consts::TAU;
    let between = (next.angle - one.angle).rem_euclid(turn);
    let at = |r: &Ray| (r.lower * r.angle.cos(), r.lower * r.angle.sin());
    let ((px, py), (qx, qy)) = (at(one), at(next));
    let (dx, dy) = (qx - px, qy - py);
    let length = dx.hypot(dy);
    let share = if length > 0.0 { -(px * dx + py * dy) / (length * length) } else { 0.0 };
    let half = one.angle + 0.5 * between;
    if !(0.0..=1.0).contains(&share) {
        return (one.lower.min(next.lower), half);
    }
    let (x, y) = (px + share * dx, py + share * dy);
    let own = (y.atan2(x) - one.angle).rem_euclid(turn);
    // Neither end again.
    let own = own.clamp(0.1 * between, 0.9 * between);
    (x.hypot(y), one.angle + own)
}

/// Lets the weight of every free block, turned this way, be the live load.
fn push(model: &mut Model, acceleration: &Vector3<f64>) {
    let assembly = &mut model.assembly;
    for (block, live) in assembly.blocks.iter().zip(&mut assembly.live) {
        live.force = if block.support { Vector3::zeros() } else { acceleration * block.mass };
    }
}
