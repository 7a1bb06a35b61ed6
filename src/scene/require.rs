//! What is required of answers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// The least values that are enough. A question that is asked with a requirement of its own keeps it.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Requirements {
    /// Load factor λ of the live load or the train.
    pub load_factor: Option<f64>,
    /// Tilt, degrees.
    pub tilt_deg: Option<f64>,
    /// Load factor α0 of an earthquake.
    pub alpha_0: Option<f64>,
    /// Geometric safety factor of an arch or wall.
    pub geometric_factor: Option<f64>,
    /// Share of the earthquake of the site, ζ_E: what the mechanism has over what is demanded.
    pub site: Option<f64>,
}

impl Requirements {
    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
