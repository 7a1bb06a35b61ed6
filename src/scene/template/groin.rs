//! The groin vault.

use super::Profile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A groin (cross) vault over a square bay: two equal barrels along x and y that cross, cut off at the
/// sides of the bay, the corners of the bay on supports `springer_ne`, `springer_nw`, ….
///
/// Each of the four webs is named by the side that it opens to (`n`, `e`, `s`, `w`) and lies in
/// strips along its barrel, `n_v00`, `n_v01`, …, from one springing to the other; the webs meet in
/// joints upright below the diagonals. The springing lies at z = 0, the middle of the bay is the
/// origin.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Groin {
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
    /// Shape of the intrados of both barrels; its springing joints must be level.
    #[serde(default, skip_serializing_if = "super::is_default")]
    pub profile: Profile,
    /// Clear span of both barrels, m.
    pub clear_span: f64,
    /// Rise of their intrados, m.
    pub rise: f64,
    /// Thickness normal to the intrados, m.
    pub thickness: f64,
    /// Side of the bay, m; at least the clear span and twice the thickness.
    pub side: f64,
    /// Number of strips of a web from springing to springing, even.
    pub voussoirs: usize,
    /// Whether it has springers of its own, yes where absent; without them it stands on what else the
    /// scene has there.
    pub springers: Option<bool>,
}
