//! Dry friction exactly: fixed points of the convex programs of [`crate::program::coulomb`].

mod anderson;
mod exact;
mod fixed_point;
mod law;
mod load_factor;
mod newton;
mod rest;
mod state;

pub use super::parts::dry::{load_factor, load_factor_from};
pub use load_factor::{DryLoadFactor, Found};
pub(super) use load_factor::{complementary, of_part};
pub use rest::is_reached;
pub(super) use rest::{loaded, up_to_rest};
pub use state::{Motion, State, Step, state};
