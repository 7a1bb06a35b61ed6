//! A point whose motion is followed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A point of a block.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ControlPoint {
    /// The block.
    pub block: String,
    /// Where it is at the start, m.
    pub point: [f64; 3],
}
