//! How the ground moves: records of earthquakes, and pulses with a formula.

mod asked;
mod given;
mod motion;
mod pulse;
mod record;

pub use asked::ShakeOptions;
pub use given::{Formula, Given, Recorded, Series, Wave};
pub use motion::{Jump, Motion, Piece, Shape, When};
pub use pulse::{PULSES, Pulse};
pub use record::{Format, Record, STANDARD_GRAVITY, STRONGEST, UNITS, Unit, WEAKEST};
