//! Elastic joints: what blocks and joints of known stiffness do to each other at given
//! displacements.
//!
//! *Law.* Signorini's and Coulomb's conditions with the compliance of the joint: with `ḡ = g + p /
//! k_n` the gap beside what the joint itself closes, `ḡ ≥ 0`, `p ≥ 0`, `ḡ p = 0`, and `‖t‖ ≤ μ p`
//! with slip along `−t` and only where `‖t‖ = μ p`. Displacements are small: the geometry is that of
//! the scene as it is, rotations are vectors, and gravity acts where it did (no second-order
//! effects).
//!
//! *Convention.* As everywhere: `n` from `a` into `b`, forces on `b`, compression positive. A
//! displacement of a block is that of its centre of mass (m) and a small rotation (rad); the
//! relative displacement of a joint is that of its second block against the first, at the joint's
//! place, in its frame `(t1, t2, n)`.
//!
//! Nothing here solves anything: displacements go in, forces come out, so that a saved state can be
//! computed again by whoever checks it.

pub mod bed;
mod factor;
mod frequencies;
pub mod grain;
mod joints;
pub mod law;
pub mod member;
pub mod number;
pub mod residual;
mod state;
mod system;
mod track;

pub use factor::{PathEnd, PathFactor};
pub use frequencies::{COUNT, frequencies};
pub use joints::{ElasticJoint, JointKind, Joints, Past, Quadrature, needs};
pub use member::Carries;
pub use residual::{Residuals, residuals};
pub use state::{ElasticState, JointState, States, corner_forces};
pub use system::{System, Tangent};
pub use track::{
    Condition, Conditions, EventKind, Grip, Step, Touch, Track, Where, conditions, events,
};
