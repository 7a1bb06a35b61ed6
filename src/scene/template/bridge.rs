//! The masonry arch bridge.

use super::Profile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A masonry arch bridge in its plane, spans along x, road above, symmetric in y.
///
/// Dimensions are those of the intrados, as bridge records give them. All springings lie at z = 0;
/// the middle of the bridge, from the first springing of the intrados to the last, is x = 0. Voussoirs
/// are `v00`, `v01`, … from left to right (with several spans `s1_v00`, with several rings `r1_v00`
/// from inside out, with both `s1_r1_v00`), on supports `springer_left` and `springer_right` and
/// piers `pier_1`, … that stand on supports `footing_1`, ….
///
/// The fill is no block: its weight is a dead load on every chord of the extrados, its resistance to
/// being pushed a member `soil` on every one. Skew is left out.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bridge {
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
    /// The spans from left to right.
    pub spans: Vec<BridgeSpan>,
    /// The piers between them, one fewer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub piers: Vec<BridgePier>,
    /// Width of the bridge along y, m.
    pub width: f64,
    /// What lies on the arches.
    pub fill: Option<Fill>,
    /// Whether it has springers of its own, yes where absent; without them it stands on what else the
    /// scene has there.
    pub springers: Option<bool>,
}

/// A span of a bridge.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BridgeSpan {
    /// Shape of the intrados.
    #[serde(default, skip_serializing_if = "super::is_default")]
    pub profile: Profile,
    /// Clear span: distance between the ends of the intrados, m. Needed unless `intrados` is given.
    #[serde(default, skip_serializing_if = "super::is_zero")]
    pub clear_span: f64,
    /// Clear rise: height of the crown of the intrados above the springings, m. Needed unless
    /// `intrados` is given.
    #[serde(default, skip_serializing_if = "super::is_zero")]
    pub rise: f64,
    /// Points of the intrados as surveyed (x, z in m, from any origin), from the left springing to the
    /// right one, which lie level, in place of profile, clear span and rise. Joints lie at the points
    /// where there are as many, one more than voussoirs, else evenly along the curve through them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub intrados: Vec<[f64; 2]>,
    /// Thickness of all rings together, m; at the crown where they are thicker at the springings.
    pub thickness: f64,
    /// Thickness of all rings together at the springings, m, normal to the intrados; between crown
    /// and springing it changes in proportion to the place along the ring. That of the crown where
    /// absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub springing_thickness: Option<f64>,
    /// Number of rings, with friction between them; 1 where absent.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub rings: usize,
    /// Number of voussoirs of a ring.
    pub voussoirs: usize,
}

/// A pier: a free block between two spans, its top cut along their springing joints.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BridgePier {
    /// Distance between the two springings of the intrados, m.
    pub width: f64,
    /// Height from the foot to the springings, m.
    pub height: f64,
    /// Width at the foot, m; that at the springings where absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub foot: Option<f64>,
}

/// What lies on the arches of a bridge.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fill {
    /// Thickness over the crown of the highest extrados, to the surface of the road at that crown, m.
    pub cover: f64,
    /// Weight per volume, N/m³.
    pub unit_weight: f64,
    /// Rise of the road per metre towards +x.
    #[serde(default, skip_serializing_if = "super::is_zero")]
    pub gradient: f64,
    /// Passive pressure: at a depth z an arch that moves into the fill meets up to `passive` ×
    /// unit weight × z. None where neither this nor `friction_deg` is given. Active pressure is
    /// left out.
    pub passive: Option<f64>,
    /// Angle of friction of the fill, degrees, in place of `passive`: half of tan²(45° + φ/2), for
    /// the whole of it needs more movement than arches make.
    pub friction_deg: Option<f64>,
    /// How far a load spreads on either side per metre of depth, m; 0.5, 1 horizontally to 2
    /// vertically, where neither this nor `dispersal_deg` is given.
    pub dispersal: Option<f64>,
    /// The angle from the vertical at which a load spreads, degrees, in place of `dispersal`, which is
    /// its tangent.
    pub dispersal_deg: Option<f64>,
    /// How it is distributed over the length that it spreads to.
    #[serde(default, skip_serializing_if = "super::is_default")]
    pub distribution: Distribution,
    /// Heavier and stiffer fill, or masonry, over the springings.
    pub backing: Option<Backing>,
    /// Weight of both parapets per metre of the bridge, N/m.
    #[serde(default, skip_serializing_if = "super::is_zero")]
    pub parapets: f64,
    /// The action that its weight, with backing as fill and parapets, belongs to in combinations;
    /// `dead` where absent.
    pub action: Option<String>,
}

/// How a load that has spread through the fill presses on the extrados.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// Evenly.
    #[default]
    Even,
    /// As the pressure in an elastic half-space below the patch, cut off where the spread ends, and
    /// raised in proportion so that nothing of the load is lost.
    Boussinesq,
}

/// Backing over the springings: fill of its own, which weighs and resists and carries nothing itself;
/// or masonry, which is blocks.
///
/// Masonry stands in level courses over the piers, between the extrados on both sides, named
/// `backing_1_c00`, `backing_1_c01`, … over `pier_1` from below; with `behind` also at the ends, between
/// extrados and a vertical back, as `backing_left_c00`, … and `backing_right_c00`, … on supports
/// `abutment_left` and `abutment_right`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Backing {
    /// Height of its level top above the springings, m; as fill nothing of it counts above the road.
    pub height: f64,
    /// Weight per volume, N/m³, of backing as fill.
    pub unit_weight: Option<f64>,
    /// Passive coefficient of the chords whose middle lies below its top, with the unit weight of the
    /// fill; that of the fill where absent. Of backing as fill.
    pub passive: Option<f64>,
    /// Name of a material: the backing is masonry of it.
    pub masonry: Option<String>,
    /// How far masonry reaches behind the outer ends of the first and the last springing, m; where absent
    /// there is none at the ends.
    pub behind: Option<f64>,
}

fn one() -> usize {
    1
}

fn is_one(n: &usize) -> bool {
    *n == 1
}
