//! The portal, and the section of a nave.

use super::Profile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// An arch on two piers: voussoirs `v00`, `v01`, … from left to right, piers of blocks
/// `pier_left_00`, … from the ground up, on supports `base_left` and `base_right`. With `buttress` the
/// section of a nave: vault, walls and buttresses.
///
/// The inner faces of the piers are flush with the intrados. The springing lies at z = 0, the axis
/// is x = 0.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Portal {
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
    /// Shape of the intrados; its springing joints must be level.
    #[serde(default, skip_serializing_if = "super::is_default")]
    pub profile: Profile,
    /// Clear span, m.
    pub clear_span: f64,
    /// Rise of the intrados, m.
    pub rise: f64,
    /// Thickness of the arch normal to the intrados, m.
    pub thickness: f64,
    /// Length along y, m.
    pub depth: f64,
    /// Number of voussoirs.
    pub voussoirs: usize,
    /// The piers, or walls, below the springings.
    pub pier: Pier,
    /// Stands against the outer face of each pier: blocks `buttress_left_00`, …, with no more than
    /// contact and friction between them.
    pub buttress: Option<Pier>,
    /// Whether it has a support of its own, yes where absent; without it stands on what else the scene
    /// has there.
    pub base: Option<bool>,
}

/// A pier: equal boxes upon each other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pier {
    /// Width along x, m.
    pub width: f64,
    /// Height, m.
    pub height: f64,
    /// Number of blocks; 1 where absent.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub courses: usize,
}

fn one() -> usize {
    1
}

fn is_one(n: &usize) -> bool {
    *n == 1
}
