//! Stages of construction as the file gives them: what each one changes.
//!
//! The scene itself is everything that ever stands. What some stage adds is not there before it is
//! first added; all else is there from the start.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What one stage changes. Names are ids of blocks, members and loads; `*` stands for any letters,
/// so that `"r2_*"` is a ring.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageSpec {
    /// A name for people; its number where nothing is said.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Blocks, members and loads that come.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub add: Vec<String>,
    /// Blocks, members and loads that go; members and loads on a block go with it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remove: Vec<String>,
    /// Free blocks that are held in place from now on, as by a crane or a prop.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hold: Vec<String>,
    /// Blocks that a stage held and that are left to themselves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub release: Vec<String>,
    /// In place of `add`: a stage for each of these blocks, in the order of the scene, which adds
    /// that block.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub add_one_by_one: Vec<String>,
    /// In place of `remove`: a stage for each of these blocks, in the order of the scene, which
    /// removes that block.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remove_one_by_one: Vec<String>,
}
