//! The stack.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Equal boxes `b00`, `b01`, … from the bottom up, each shifted along x against the one below, on a
/// support `base` with its top at z = 0. Exactly one of `shift` and `harmonic` is given.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stack {
    /// Put before the ids of the blocks.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub prefix: String,
    /// Where the origin of the template lies, m.
    #[serde(default, skip_serializing_if = "super::is_origin")]
    pub at: [f64; 3],
    /// Name of the material of all blocks.
    pub material: Option<String>,
    /// Members that join its blocks, named without the prefix, with points about its origin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<crate::Member>,
    /// Number of blocks.
    pub blocks: usize,
    /// Size of one block along x, y, z, m.
    pub size: [f64; 3],
    /// Shift of each block against the one below, m. The lowest block reaches from x = 0 to its
    /// length. A stack of n leans until n × shift exceeds the length of a block.
    pub shift: Option<f64>,
    /// Overhang over the edge of a table (x ≤ 0) as a multiple of the harmonic one: block k,
    /// counted from the top, has its right end at harmonic × length × Σ 1/(2j), j = k … blocks. At
    /// 1 every joint is critical.
    pub harmonic: Option<f64>,
}
