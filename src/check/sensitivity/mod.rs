//! How a load factor changes with a number of the scene that was assumed, without solving again.
//!
//! The greatest load factor is `λ(p) = max λ` subject to `A f + w + λ ℓ = 0`, `f ∈ K`, all of which
//! depend on the number `p`. At forces `f` and rates `q` that prove it from both sides the
//! derivative is that of the Lagrangian with `f`, `q` and λ held (`lagrangian`; Danskin 1967,
//! Gol'shtein 1972 for values that are both a maximum and a minimum), forces in the axes of their
//! joints:
//!
//! `∂λ/∂p = (−q · ∂(A f + w + λ ℓ)/∂p + Σ m ∂s/∂p) / (ℓ · q)`,
//!
//! where `s` are the rooms that strengths and friction leave and `m` their multipliers, which
//! follow from the rates: `‖v_t‖` of `μ f_n + c a − ‖f_t‖ ≥ 0`, `v_n − μ ‖v_t‖` of `f_n + T a ≥ 0`,
//! the closing of the area of the compressive strength. Both are differences of the scene's own
//! data between a little more and a little less of `p` (`varied`): no formula knows any number.
//!
//! Where other forces or other mechanisms prove the same λ they may give other numbers; then λ has a
//! bend there, and its derivatives on both sides differ. `unique` tells whether what counts is the
//! same in all of them.

mod bodies;
mod lagrangian;
mod numbers;
mod target;
mod unique;
mod varied;

pub use lagrangian::Proof;
pub use numbers::Number;
pub use target::Target;
pub use unique::Faces;
pub use varied::{Under, Varied};
