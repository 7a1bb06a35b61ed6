//! What joints carry beside friction: cohesion, tension, couples of a rolling arm, pressures up to
//! a compressive strength, water.
//!
//! Stresses act on the area that touches, forces at the corners of its hull; this room says what
//! the one amounts to in the other, for the program and the dynamics. The checker may ask it for
//! [`crushing`] and [`laws`] alone: corner shares, uplift, tension and rolling arm it derives by
//! itself, another way (`verdict::joint`).

pub mod crushing;
pub mod laws;
mod section;
mod shares;
#[cfg(test)]
mod tests;

pub use shares::{shares, uplift};

use crate::interface::Interface;

/// Tensile strength that counts, Pa: cohesion and friction end at cohesion / μ.
pub fn tension(face: &Interface) -> f64 {
    let (law, mu) = (&face.law, face.law.friction.mu());
    if mu == 0.0 || mu.is_infinite() { law.tension } else { law.tension.min(law.cohesion / mu) }
}

/// Rolling arm that counts, m: corners of a face carry couples by themselves.
pub fn rolling_arm(face: &Interface) -> f64 {
    if face.points.len() < 3 { face.law.rolling_arm } else { 0.0 }
}
