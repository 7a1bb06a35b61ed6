//! What is asked of a scene without single blocks.

use super::asked::{Asked, chosen};
use crate::terms::Law;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of `without`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WithoutOptions {
    /// How joints slide.
    pub law: Law,
}

impl Asked for WithoutOptions {
    chosen!(law);

    fn quantity(&self) -> Option<&'static str> {
        Some("blocks that may be taken out")
    }
}
