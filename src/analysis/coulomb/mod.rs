//! Dry friction exactly: fixed points of the convex programs of [`crate::program::coulomb`].

mod anderson;
mod fixed_point;
mod law;
mod load_factor;
mod newton;
mod state;

pub use load_factor::{DryLoadFactor, Found, load_factor};
pub use state::{Motion, State, Step, state};
