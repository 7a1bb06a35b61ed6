//! What is asked of a train.

use super::asked::{Asked, Idle, chosen};
use crate::terms::Law;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of `moving`: `limit` with a train, position by position.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MovingOptions {
    /// How joints slide.
    pub law: Law,
    /// A load factor below this counts as failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub require: Option<f64>,
    /// Whether it stands under its dead load alone is not asked as well. Rows of a sweep ask it with
    /// dry friction only: a plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_dead: bool,
    /// With dry friction: the value at every position, and not at the others than the worst only that
    /// it is not less.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub every_value: bool,
}

impl Asked for MovingOptions {
    chosen!(law, require);

    fn quantity(&self) -> Option<&'static str> {
        Some("least load factor of the train")
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        let hint = "remove it: rows compute the verdict without the train only where dry friction needs it";
        self.skip_dead.then_some(("skip_dead", hint))
    }

    /// With dry friction all positions share the verdict without the train.
    fn for_one_number(self) -> Self {
        Self { skip_dead: self.law == Law::Associative, ..self }
    }
}
