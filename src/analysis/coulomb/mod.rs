//! Dry friction exactly: what the fixed points of [`crate::program::coulomb`] say about state and
//! load factor.

mod crushing;
mod load_factor;
mod rest;
mod state;

pub use super::parts::{
    assess::motion,
    dry::{load_factor, load_factor_from, rests_alone},
};
pub use crate::terms::{Found, StateMotion, StateStep, is_reached, resolution};
pub use load_factor::DryLoadFactor;
pub(super) use load_factor::{complementary, of_part, part_rests_alone};
pub(super) use rest::up_to_rest;
pub use state::{State, state};
