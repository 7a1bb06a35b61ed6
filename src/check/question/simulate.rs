//! What is asked of a scene in time.

use super::asked::Asked;
use crate::terms::Law;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Options of `simulate`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SimulateOptions {
    /// Fast steps only: to be trusted 3 % away from a limit.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fast: bool,
    /// Fine steps from the start.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fine: bool,
    /// Time to simulate at most, s.
    pub seconds: Option<f64>,
    /// Simulate until then although the outcome is clear.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub to_the_end: bool,
    /// This factor × the live loads is added.
    pub load_factor: Option<f64>,
}

impl Asked for SimulateOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        let refuse = |key: &str, text: &str| Err(InputError::at(path.key(key), text));
        if self.fast && self.fine {
            return refuse("fine", "\"fast\" and \"fine\" are both given");
        }
        if self.seconds.is_some_and(|s| s.is_nan() || s <= 0.0) {
            return refuse("seconds", "must be > 0");
        }
        Ok(())
    }

    /// What slides in time does not open.
    fn law(&self) -> Law {
        Law::Coulomb
    }
}
