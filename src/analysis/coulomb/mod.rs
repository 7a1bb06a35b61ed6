//! Dry friction exactly: fixed points of the convex programs of [`crate::program::coulomb`].

mod anderson;
mod fixed_point;
mod state;

pub use state::{Motion, State, Step, state};
