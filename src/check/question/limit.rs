//! What is asked of a live load.

use super::asked::{Asked, IDLE_SENSITIVITY, Idle, chosen};
use crate::terms::Law;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of `limit`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LimitOptions {
    /// How joints slide.
    pub law: Law,
    /// A load factor below this counts as failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub require: Option<f64>,
    /// Whether it stands under its dead load alone is not asked as well. Rows of a sweep never ask
    /// it: a plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_dead: bool,
    /// How the value changes with every number that was assumed. Rows of a sweep hold one value: a
    /// plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub sensitivity: bool,
}

impl Asked for LimitOptions {
    chosen!(law, require, sensitivity);

    fn quantity(&self) -> Option<&'static str> {
        Some("load factor")
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        if self.sensitivity {
            return Some(IDLE_SENSITIVITY);
        }
        let hint = "remove it: rows never compute the verdict without the live load";
        self.skip_dead.then_some(("skip_dead", hint))
    }

    fn for_one_number(self) -> Self {
        Self { skip_dead: true, sensitivity: false, ..self }
    }
}
