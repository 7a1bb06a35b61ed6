//! The flat arch.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A flat arch (platbande) of voussoirs `v00`, `v01`, … from left to right between the supports
/// `abutment_left` and `abutment_right`; intrados at z = 0, extrados at z = `height`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlatArch {
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
    /// Distance between the abutments at mid-height, m.
    pub span: f64,
    /// Height, m.
    pub height: f64,
    /// Length along y, m.
    pub depth: f64,
    /// Number of voussoirs, equally wide at mid-height.
    pub voussoirs: usize,
    /// Depth below mid-height of the point through which all joints pass, m; more than half the
    /// height. Vertical joints where absent.
    pub center_depth: Option<f64>,
}
