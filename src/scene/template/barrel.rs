//! The barrel vault.

use super::Profile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A barrel vault: an arch with radial joints drawn out along y, in running bond, on two continuous
/// supports `springer_left` and `springer_right`.
///
/// Strip `i` (from left to right) runs along the vault between two bed joints; its blocks are
/// `v<i>_<k>` with `k` along y. Every other strip, starting with the second, has half blocks at
/// both ends.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Barrel {
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
    /// Shape of the mid-line.
    #[serde(default, skip_serializing_if = "super::is_default")]
    pub profile: Profile,
    /// Radius of the mid-line, m (circular and pointed).
    pub radius: Option<f64>,
    /// Angle at the centre between the two springing joints (circular, with `radius`); 180 where
    /// absent.
    pub embrace_deg: Option<f64>,
    /// Distance of the two centres from the axis, m (pointed, with `radius`).
    pub eccentricity: Option<f64>,
    /// Span of the mid-line: distance between its ends, m (every profile; then `rise` too). The
    /// clear span is smaller: `intrados_span`.
    pub span: Option<f64>,
    /// Rise of the mid-line: height of its crown above its ends, m (with `span`).
    pub rise: Option<f64>,
    /// Clear span: distance between the ends of the intrados, m, in place of `span` (then
    /// `intrados_rise` too).
    pub intrados_span: Option<f64>,
    /// Clear rise: height of the crown of the intrados (of its curve, where it is drawn with
    /// chords) above its ends, m (with `intrados_span`).
    pub intrados_rise: Option<f64>,
    /// Thickness normal to the mid-line, m.
    pub thickness: f64,
    /// Length of the vault along y, m.
    pub depth: f64,
    /// Number of strips from springing to springing; even for a pointed vault.
    pub voussoirs: usize,
    /// Number of whole blocks along y.
    pub courses: usize,
    /// Whether it has springers of its own, yes where absent; without them it stands on what else the
    /// scene has there.
    pub springers: Option<bool>,
}
