//! How the ground moves: records of earthquakes, and pulses with a formula.

mod motion;
mod pulse;

pub use motion::{Jump, Motion, Piece, Shape, When};
pub use pulse::{PULSES, Pulse};
