//! What is asked of tilts.

use super::{
    asked::{Asked, IDLE_SENSITIVITY, Idle, chosen},
    directions::{self, check_directions},
};
use crate::terms::Law;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Options of `tilt`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TiltOptions {
    /// How joints slide.
    pub law: Law,
    /// A tilt below this, in degrees, counts as failure.
    pub require: Option<f64>,
    /// Tip towards these directions.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "directions::several")]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x; 8 where nothing is said.
    pub all: Option<u16>,
    /// Whether it stands level is not asked as well. Rows of a sweep ask it with dry friction only: a
    /// plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_dead: bool,
    /// How the value changes with every number that was assumed. Rows of a sweep hold one value: a
    /// plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub sensitivity: bool,
}

impl Asked for TiltOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        check_directions(path, &self.toward, self.all)
    }

    chosen!(law, require, sensitivity);

    fn quantity(&self) -> Option<&'static str> {
        Some("tilt in degrees")
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        if self.sensitivity {
            return Some(IDLE_SENSITIVITY);
        }
        let hint =
            "remove it: rows compute the verdict without tilt only where dry friction needs it";
        self.skip_dead.then_some(("skip_dead", hint))
    }

    /// With dry friction all directions share the verdict when level.
    fn for_one_number(self) -> Self {
        Self { skip_dead: self.law == Law::Associative, sensitivity: false, ..self }
    }
}
