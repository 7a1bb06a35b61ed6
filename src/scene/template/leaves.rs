//! The wall of two leaves.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A wall of two leaves along x with a hollow between them, each in running bond, and courses of
/// through stones that tie them; on a support `base` below z = 0.
///
/// Blocks are `f<course>_<k>` in the front leaf (towards −y), `b<course>_<k>` in the back one, through
/// stones `t<course>_<k>`. The hollow is empty; what fills it may be given as loads. The left end is
/// x = 0, the wall is centred on y = 0.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Leaves {
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
    /// Size of a whole block along x, y, z, m.
    pub size: [f64; 3],
    /// Width of the hollow between the leaves, m.
    pub hollow: f64,
    /// Number of courses.
    pub courses: usize,
    /// Number of whole blocks in a course.
    pub blocks: usize,
    /// Every so many courses, counted from the ground, one is of through stones; without it there
    /// are none.
    pub through_every: Option<usize>,
    /// Whether it has a support of its own, yes where absent; without it stands on what else the scene
    /// has there.
    pub base: Option<bool>,
}
