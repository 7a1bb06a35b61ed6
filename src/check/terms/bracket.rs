//! Two ends and a value between them.

use super::ends;
use serde::{Deserialize, Serialize};

/// Two ends that enclose a value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Bracket {
    /// Lower end.
    #[serde(deserialize_with = "ends::lower")]
    #[schemars(with = "Option<f64>")]
    pub lower: f64,
    /// Upper end.
    #[serde(deserialize_with = "ends::upper")]
    #[schemars(with = "Option<f64>")]
    pub upper: f64,
}

impl Bracket {
    /// Nothing is known.
    pub const UNKNOWN: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// Upper minus lower end.
    pub fn width(&self) -> f64 {
        self.upper - self.lower
    }

    /// Whether the ends meet within `width`: ends that cross by more enclose nothing.
    pub fn is_narrow(&self, width: f64) -> bool {
        self.width().abs() <= width
    }
}
