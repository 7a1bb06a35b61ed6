//! Figures in a plane, and sets of things that belong together: what every stage needs and none
//! owns.

pub mod clip;
pub mod polygon;
mod sets;

pub use sets::Sets;
