//! What is asked of a mechanism under an earthquake.

use super::{
    asked::{Asked, IDLE_SENSITIVITY, Idle, chosen},
    control::ControlPoint,
    directions::{self, check_directions},
};
use crate::terms::Law;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// The factor of confidence where nothing is said: that of the least level of knowledge (Circolare,
/// C8.5.4), which is due where crushing is not in the model.
pub const CONFIDENCE: f64 = 1.35;

/// A verification of a local mechanism (Circolare 7/2019, C8.7.1.2.1). Either may be chosen there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verification {
    /// By accelerations, with the behaviour factor q.
    Linear,
    /// By displacements, on the capacity curve.
    Displacement,
}

/// Options of `kinematic`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct KinematicOptions {
    /// How joints slide.
    pub law: Law,
    /// A load factor α0 below this counts as failure.
    pub require: Option<f64>,
    /// A share ζ_E of the earthquake of the site below this counts as failure; 1 where neither this
    /// nor the scene says more.
    pub site: Option<f64>,
    /// The verification that governs at the site; both where nothing is said.
    pub verify: Option<Verification>,
    /// Earthquakes towards these directions.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "directions::several")]
    pub toward: Vec<[f64; 3]>,
    /// Earthquakes towards this many directions, evenly spread, the first along x; 8 where nothing is
    /// said.
    pub all: Option<u16>,
    /// The point whose way measures the motion; where nothing is said the centre of mass of the block
    /// next to the centre of all masses that move.
    pub control: Option<ControlPoint>,
    /// Factor of confidence; 1.35 where nothing is said.
    pub fc: Option<f64>,
    /// Ways of the control point that become points of the curve, beside others, m.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<f64>,
    /// The linear analysis alone, without a curve. Rows of a sweep ask nothing else: a plan has no
    /// such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub linear: bool,
    /// Whether it stands under its dead load alone is not asked as well. Rows of a sweep ask it with
    /// dry friction only: a plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_dead: bool,
    /// How the value changes with every number that was assumed. Rows of a sweep hold one value: a
    /// plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub sensitivity: bool,
}

impl Asked for KinematicOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        let refuse = |key: &str, text: String| Err(InputError::at(path.key(key), text));
        if let Some(f) = self.fc.filter(|f| !(*f >= 1.0 && f.is_finite())) {
            return refuse("fc", format!("the confidence factor must be at least 1, got {f}"));
        }
        if self.at.iter().any(|v| !(*v >= 0.0 && v.is_finite())) {
            return refuse("at", "must be displacements >= 0".into());
        }
        if self.site.is_some_and(|v| !(v > 0.0 && v.is_finite())) {
            return refuse("site", "must be a share above 0".into());
        }
        if self.linear && self.verify == Some(Verification::Displacement) {
            return refuse("verify", "the linear analysis has no displacements".into());
        }
        if self.linear && !self.at.is_empty() {
            return refuse("at", "the linear analysis has no curve".into());
        }
        check_directions(path, &self.toward, self.all)
    }

    chosen!(law, require, sensitivity);

    fn quantity(&self) -> Option<&'static str> {
        Some("α0")
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        if self.sensitivity {
            return Some(IDLE_SENSITIVITY);
        }
        if self.skip_dead {
            return Some((
                "skip_dead",
                "remove it: rows compute the verdict without the earthquake only where dry friction needs it",
            ));
        }
        if self.linear {
            return Some(("linear", "remove it: rows give α0 and no curve"));
        }
        (!self.at.is_empty()).then_some(("at", "remove it: rows give no curve"))
    }

    /// With dry friction all directions share the verdict without an earthquake; the curve is followed
    /// where its displacements are verified.
    fn for_one_number(self) -> Self {
        let linear = self.verify != Some(Verification::Displacement);
        Self { skip_dead: self.law == Law::Associative, linear, sensitivity: false, ..self }
    }
}
