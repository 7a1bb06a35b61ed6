//! Following the motion: poses as functions of one parameter that only grows.

mod advance;
mod anchor;
pub mod answer;
mod branch;
mod control;
pub mod crack;
mod drop;
mod linkage;
pub mod machine;
mod member;
mod moved;
mod passed;
mod point;
mod program;
mod rebalance;
mod rested;
mod root;
mod slide;
mod tracker;

pub use branch::Follow;
pub use point::{End, Event, Path, Point};
