//! The tower.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A hollow tower, its outer faces |x| ≤ size/2 and |y| ≤ size/2, on a support `base` below z = 0.
///
/// Every course has four walls, each of which passes one corner and ends at the next; from course to
/// course they turn the other way round, so that the corners are bonded. Blocks are
/// `c<course>_<side>_<k>` with the sides `n`, `e`, `s`, `w`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tower {
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
    /// Outer size along x and y, m.
    pub size: [f64; 2],
    /// Thickness of the walls, m.
    pub thickness: f64,
    /// Height of a course, m.
    pub course: f64,
    /// Number of courses.
    pub courses: usize,
    /// Number of blocks of a wall in a course; 1 where absent.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub blocks: usize,
    /// Whether it has a support of its own, yes where absent; without it stands on what else the scene
    /// has there.
    pub base: Option<bool>,
}

fn one() -> usize {
    1
}

fn is_one(n: &usize) -> bool {
    *n == 1
}
