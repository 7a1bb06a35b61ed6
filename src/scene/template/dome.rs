//! The dome.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A spherical dome of rings on a ring of supports, closed by a keystone or open at an oculus; the
/// centre of the sphere is the origin.
///
/// The corners of the blocks lie on the spheres of radius ± thickness / 2. Every ring is cut into
/// the same number of segments and the cuts of all rings lie in the same meridian planes: only so
/// are the bed joints, which lie on cones, met by plane faces that fit each other exactly. Blocks
/// are `r<ring>_<segment>`, rings from the bottom up, segments counter-clockwise from the x axis;
/// the supports are `springer_<segment>`, the closing block is `keystone`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dome {
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
    /// Radius of the mid-surface at the corners, m.
    pub radius: f64,
    /// Thickness along the radius at the corners, m.
    pub thickness: f64,
    /// Number of rings, the keystone not counted.
    pub rings: usize,
    /// Number of voussoirs in a ring, at least 3.
    pub segments: usize,
    /// Angle between the axis and the lowest bed joint; 90 (a hemisphere) where absent.
    pub springing_deg: Option<f64>,
    /// Angle between the axis and the edge of the oculus; where absent the dome is closed by a
    /// keystone as wide as a ring is high.
    pub oculus_deg: Option<f64>,
    /// Voussoirs that are left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub openings: Vec<DomeOpening>,
    /// A drum with a slab upon the edge of the oculus (with `oculus_deg`).
    pub lantern: Option<Lantern>,
    /// Whether it has springers of its own, yes where absent; without them it stands on what else the
    /// scene has there.
    pub springers: Option<bool>,
}

/// An opening in a dome: some segments of some rings.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DomeOpening {
    /// The first and the last ring, from 0 at the springing.
    pub rings: [usize; 2],
    /// The first and the last segment, from 0; the first may be the greater, where the opening
    /// passes the meridian of segment 0.
    pub segments: [usize; 2],
}

/// A lantern: an upright drum of blocks `lantern_00`, …, on the upper bed of the last ring, one a
/// segment, and a slab `lantern_cap` upon them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lantern {
    /// Height of the drum above the highest corner of the dome, m.
    pub height: f64,
    /// Thickness of the slab, m.
    pub cap: f64,
}
