//! The value whose changes are asked for.

use super::varied::Under;
use crate::terms::{Changing, Law};

/// A value whose changes are asked for.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// What it is.
    pub of: Changing,
    /// What makes the live load.
    pub under: Under,
    /// The load factor that is proved, of a tilt its tangent: the value, or the bound on it.
    pub bound: f64,
    /// With dry friction that slides: the load factor, of a tilt its tangent.
    pub dry: Option<f64>,
    /// For which law of sliding the value holds.
    pub law: Law,
}

impl Target {
    /// What changes of a load factor are multiplied by to be those of the value that is told.
    pub fn scale(&self, load_factor: f64) -> f64 {
        match self.of {
            Changing::LoadFactor | Changing::Alpha0 => 1.0,
            Changing::TiltDeg => (1.0 / (1.0 + load_factor * load_factor)).to_degrees(),
        }
    }
}
