//! Templates: structures given by a few numbers. The geometry is made in [`crate::generate`].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A structure given by a few numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Template {
    /// Blocks on top of each other.
    Column(Column),
}

/// A column of equal boxes on a support.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Number of blocks.
    pub blocks: usize,
    /// Size of one block along x, y, z, m.
    pub size: [f64; 3],
}
