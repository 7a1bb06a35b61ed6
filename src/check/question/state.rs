//! What is asked of a scene whose joints have a stiffness.

use super::{
    asked::{Asked, Idle, chosen},
    control::ControlPoint,
};
use crate::{elastic::Quadrature, terms::Law};
use base::error::{InputError, JsonPath};
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

impl Asked for StateOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        let refuse = |key: &str, text: &str| Err(InputError::at(path.key(key), text));
        if self.at.iter().any(|v| !(*v > 0.0 && v.is_finite())) {
            return refuse("at", "must be load factors above 0");
        }
        if self.dead_only && (!self.at.is_empty() || self.control.is_some()) {
            return refuse("dead_only", "without a live load there is no curve");
        }
        Ok(())
    }

    /// Joints that slide do not open.
    fn law(&self) -> Law {
        Law::Coulomb
    }

    chosen!(require);

    fn quantity(&self) -> Option<&'static str> {
        Some(match self.dead_only {
            true => "greatest displacement in m",
            false => "load factor of the path",
        })
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        let hint = "remove it: rows give no curve";
        match self.at.is_empty() {
            false => Some(("at", hint)),
            true => self.control.is_some().then_some(("control", hint)),
        }
    }
}

fn is_area(q: &Quadrature) -> bool {
    *q == Quadrature::Area
}
