//! What is asked of a packing of grains.

use super::{
    asked::{Asked, chosen},
    directions::{self, check_directions},
};
use crate::terms::Law;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Options of `repose`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ReposeOptions {
    /// How grains slide.
    pub law: Law,
    /// An angle below this, in degrees, counts as failure.
    pub require: Option<f64>,
    /// Tip towards these directions.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "directions::several")]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x; 8 where nothing is said.
    pub all: Option<u16>,
    /// The share of the grains' mass that has to move; 0, the first grain, where nothing is said.
    pub moving_mass: f64,
}

impl Asked for ReposeOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        if !(0.0..=1.0).contains(&self.moving_mass) {
            let text = format!("must be a share from 0 to 1, got {}", self.moving_mass);
            return Err(InputError::at(path.key("moving_mass"), text));
        }
        check_directions(path, &self.toward, self.all)
    }

    chosen!(law, require);

    fn quantity(&self) -> Option<&'static str> {
        Some("angle of maximum stability in degrees")
    }
}
