//! What is asked of a live load as the scene moves.

use super::{asked::Asked, control::ControlPoint, directions};
use crate::{path::saved::SavedPose, terms::Law};
use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of `push`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PushOptions {
    /// The point whose way is the parameter, m.
    pub control: ControlPoint,
    /// The direction in which its way is measured.
    #[serde(deserialize_with = "directions::one")]
    pub toward: [f64; 3],
    /// Values of the parameter that become the points of the curve, beside its start, its events and
    /// its end, m; empty: where it bends.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<f64>,
    /// Poses to begin at, as a result of the same scene has them; empty: the start.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub from: Vec<SavedPose>,
}

impl Asked for PushOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        let refuse = |key: &str, text: &str| Err(InputError::at(path.key(key), text));
        if !Vector3::from(self.toward).normalize().iter().all(|v| v.is_finite()) {
            return refuse("toward", "the direction must not be zero");
        }
        if self.at.iter().any(|v| !(*v >= 0.0 && v.is_finite())) {
            return refuse("at", "must be displacements >= 0");
        }
        Ok(())
    }

    /// Hinges alone are followed, which are the same for both.
    fn law(&self) -> Law {
        Law::Associative
    }

    fn quantity(&self) -> Option<&'static str> {
        Some("displacement of the control point up to which it resists in m")
    }
}
