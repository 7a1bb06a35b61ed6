//! The arch.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// An arch of straight-chord voussoirs, `v00`, `v01`, … from left (x < 0) to right, on two supports
/// `springer_left` and `springer_right`.
///
/// The mid-line lies in the x–z plane, symmetric about x = 0. A circular arch has the centre of its
/// circle at the origin; the other profiles have the ends of their mid-line at z = 0. The mid-line
/// is divided equally in angle (circular, pointed), in the eccentric angle s of (a sin s, b cos s)
/// (elliptical) or in x (parabolic, and every profile with vertical joints).
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Arch {
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
    /// Direction of the joints.
    #[serde(default, skip_serializing_if = "super::is_default")]
    pub joints: JointDirection,
    /// Thickness, m, measured as `thickness_along` says.
    pub thickness: f64,
    /// How the thickness is measured; `normal` with radial joints, `vertical` with vertical joints
    /// where absent.
    pub thickness_along: Option<ThicknessAlong>,
    /// Length along y, m.
    pub depth: f64,
    /// Number of voussoirs in the whole arch; even for a pointed arch, whose crown joint is
    /// vertical.
    pub voussoirs: usize,
    /// Free blocks under the springings in place of the springers.
    pub buttresses: Option<Buttresses>,
    /// Whether it has springers of its own, yes where absent; without them it stands on what else the
    /// scene has there.
    pub springers: Option<bool>,
}

/// Shape of an arch's mid-line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// Part of a circle, by `radius` and `embrace_deg`, or by `span` and `rise`.
    #[default]
    Circular,
    /// Two arcs that meet at the crown, by `radius` and `eccentricity`, or by `span` and `rise`.
    Pointed,
    /// Half an ellipse, by `span` and `rise`.
    Elliptical,
    /// A parabola, by `span` and `rise`.
    Parabolic,
    /// Three arcs of 60° that run into each other, upright at the springings (basket handle, anse
    /// de panier), by `span` and `rise`.
    ThreeCentred,
}

/// Direction of an arch's joints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointDirection {
    /// Normal to the mid-line (the crown joint of a pointed arch is vertical).
    #[default]
    Radial,
    /// Vertical.
    Vertical,
}

/// How an arch's thickness is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ThicknessAlong {
    /// Normal to the mid-line. With vertical joints (circular arches up to 180°): a ring between
    /// two circles, cut by vertical joints at equal angles of the intrados; the springing joints
    /// stay radial, the extrados is drawn as 4 chords a voussoir, 8 in the two outer ones.
    Normal,
    /// Along z (vertical joints only): intrados and extrados are the mid-line moved down and up by
    /// half of it.
    Vertical,
}

/// Free rectangular blocks `buttress_left` and `buttress_right` under the springings, inner face
/// flush with the intrados, on a support `ground`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Buttresses {
    /// Width along x, m.
    pub width: f64,
    /// Height, m.
    pub height: f64,
}
