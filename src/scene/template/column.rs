//! The column.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Equal boxes `b00`, `b01`, … from the bottom up on a support `base`; the axis is x = y = 0, the
/// foot z = 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Put before the ids of the blocks.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub prefix: String,
    /// Where the origin of the template lies, m.
    #[serde(default, skip_serializing_if = "super::is_origin")]
    pub at: [f64; 3],
    /// Name of the material of all blocks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Members that join its blocks, named without the prefix, with points about its origin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<crate::Member>,
    /// Number of blocks.
    pub blocks: usize,
    /// Size of one block along x, y, z, m.
    pub size: [f64; 3],
}
