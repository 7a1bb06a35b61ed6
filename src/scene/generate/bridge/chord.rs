//! Straight pieces of the upper surface of a bridge.

use crate::generate::midline::Xz;

/// A straight piece of the upper surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Chord {
    /// The block below it.
    pub block: String,
    /// Its left end (x, z), m.
    pub from: Xz,
    /// Its right end, m.
    pub to: Xz,
    /// Which way the fill pushes that resists it: towards the span, +1 or −1 along x; 0 on piers
    /// and where it is level.
    pub towards: f64,
}

impl Chord {
    /// Length along x, m.
    pub fn length(&self) -> f64 {
        self.to[0] - self.from[0]
    }

    /// Height over a place along x between its ends, m.
    pub fn height(&self, x: f64) -> f64 {
        let share = (x - self.from[0]) / self.length();
        self.from[1] + share * (self.to[1] - self.from[1])
    }
}
