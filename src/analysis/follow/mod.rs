//! Following the motion: poses as functions of one parameter that only grows.

mod branch;
mod drive;
mod drop;
mod linkage;
mod program;
mod root;

pub use branch::{End, Event, EventKind, Follow, Path, Point, follow};
pub use drive::{Drive, Move, Moves};
