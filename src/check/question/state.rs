//! Options of the question.

use super::ControlPoint;
use crate::elastic::Quadrature;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Options of `state`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StateOptions {
    /// Where joints with an area are integrated.
    #[serde(skip_serializing_if = "is_area")]
    pub quadrature: Quadrature,
    /// The point whose way along the live load is the curve; where nothing is said the centre of mass
    /// of the block with the greatest live load.
    pub control: Option<ControlPoint>,
    /// Load factors that become points of the curve, beside others.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<f64>,
    /// The state under the dead load alone. Rows of a sweep show the load factor of the path, and
    /// without a live load the greatest displacement.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub dead_only: bool,
    /// A load factor below this counts as failure.
    pub require: Option<f64>,
}

fn is_area(q: &Quadrature) -> bool {
    *q == Quadrature::Area
}
