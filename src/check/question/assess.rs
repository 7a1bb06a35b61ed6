//! What is asked of a scene under its dead load.

use super::asked::{Asked, chosen};
use crate::terms::Law;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of `assess`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AssessOptions {
    /// How joints slide.
    pub law: Law,
}

impl Asked for AssessOptions {
    chosen!(law);
}
