//! Dry friction: fixed points of the convex programs of [`crate::program::coulomb`], and Newton's
//! method on Coulomb's law itself.
//!
//! [`iterate`] holds friction, solves, and holds it anew; each program is solved by [`Newton`] in
//! the rates where that can be, by an engine where not. [`Exact`] and [`CoulombLaw`] hold nothing:
//! Coulomb's law itself, for the state and for the load factor; where none of them gets there, the
//! state is followed as it comes about (`flow`). What any of them finds is a
//! candidate; `analysis::coulomb` asks the questions and decides.

mod anderson;
mod drag;
mod exact;
mod fixed_point;
mod flow;
mod law;
mod newton;
mod point;

pub use anderson::Anderson;
pub use exact::Exact;
pub use fixed_point::{Solvers, StoppingCriterion, iterate};
pub use law::CoulombLaw;
pub use newton::{Newton, Solved};
pub use point::FixedPoint;
