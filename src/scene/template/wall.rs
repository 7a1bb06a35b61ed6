//! The wall.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A wall of one leaf in running bond; its foot reaches from x = 0 to `blocks` × length at z = 0.
/// Blocks are `c<course>_<block>` from the bottom up and from left to right. The joints of a course
/// lie on the block grid, moved by half a block from course to course; ends, rakes and openings cut
/// the blocks they cross.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wall {
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
    /// Size of a whole block along x, y, z, m.
    pub size: [f64; 3],
    /// Number of free courses.
    pub courses: usize,
    /// Length of the foot in whole blocks.
    pub blocks: usize,
    /// How the lowest free course ends.
    #[serde(default, skip_serializing_if = "super::is_default")]
    pub first: WallEnd,
    /// What the wall stands on.
    #[serde(default, skip_serializing_if = "super::is_default")]
    pub base: WallBase,
    /// How far the left end moves in from one course to the next, in blocks (0.5: half a block).
    #[serde(default, skip_serializing_if = "super::is_zero")]
    pub rake_left: f64,
    /// How far the right end moves in from one course to the next, in blocks.
    #[serde(default, skip_serializing_if = "super::is_zero")]
    pub rake_right: f64,
    /// Rectangular openings. Nothing is added above them: a wide opening needs the bond, or the
    /// reader, to carry what is over it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub openings: Vec<Opening>,
}

/// How a course begins at a vertical end of a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallEnd {
    /// With a whole block.
    #[default]
    Whole,
    /// With half a block.
    Half,
}

/// What a wall stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallBase {
    /// One support `base` under the whole foot, as high as a course.
    #[default]
    Slab,
    /// A course of supports `base_<block>` that continues the bond downwards.
    Course,
    /// Nothing: the scene provides it.
    None,
}

/// A rectangular opening: what lies in it is left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Opening {
    /// Left edge, m from the left end of the foot.
    pub x: f64,
    /// Sill, m above the foot; a multiple of the course height.
    pub z: f64,
    /// Width, m.
    pub width: f64,
    /// Height, m; a multiple of the course height.
    pub height: f64,
}
