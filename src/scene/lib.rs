//! What a scene file says, and nothing more (`"format": "voussoir-scene/1"`).
//!
//! These types mirror the JSON one to one: units as written, references by name, defaults not yet
//! applied where they depend on anything else. `resolve` of the crate `model` turns a [`Scene`] into an
//! assembly. Unknown keys are refused; writing a scene and
//! reading it back gives the same scene.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod block;
mod combination;
mod contact;
mod explain;
mod field;
pub mod generate;
pub mod import;
mod interface;
mod joint;
mod load;
pub mod member;
mod pattern;
pub mod preset;
mod protocol;
mod read;
mod record;
mod require;
mod schema;
pub mod site;
mod sizes;
mod source;
mod stage;
mod suggest;
pub mod template;
mod touches;
mod train;
pub mod vehicle;

#[cfg(test)]
mod tests;

pub use block::{Ball, BlockSpec, Rotation, Shape};
pub use combination::{Combination, DEAD, Factors, LIVE, MaterialFactors};
pub use contact::ContactSpec;
pub use explain::Kind;
pub use interface::InterfaceSpec;
pub use joint::{Friction, JointOverride, JointSpec, Joints, Material};
pub use load::{At, Load, Loads, OnRoad, PushingMass};
pub use member::Member;
pub use pattern::fits;
pub use protocol::{FloorKind, GrainKind, Protocol, ProtocolKind};
pub use read::{read_as, text};
pub use read::{read_bytes, read_file, read_str};
pub use record::Record;
pub use require::Requirements;
pub use schema::schema;
pub use site::Site;
pub use sizes::Sizes;
pub use source::Source;
pub use stage::StageSpec;
pub use suggest::suggest;
pub use template::Template;
pub use touches::Touches;
pub use train::{Axle, AxleForce, Train};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::collections::BTreeMap;

/// The version of the format, the only value of the key `format`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum SceneFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-scene/1")]
    V1,
}

/// A scene: blocks given one by one, by templates, or both; SI units (m, kg, s, N), z up.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The format and its version.
    pub format: SceneFormat,
    /// A name for people.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Where the geometry and the values come from.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub source: String,
    /// Project and people, for the first page of the record of an assessment.
    #[serde(default, skip_serializing_if = "Record::is_empty")]
    pub record: Record,
    /// Gravity, m/s².
    #[serde(default = "standard_gravity")]
    pub gravity: [f64; 3],
    /// Materials by name.
    #[serde(
        default,
        deserialize_with = "joint::distinct_names",
        skip_serializing_if = "BTreeMap::is_empty"
    )]
    pub materials: BTreeMap<String, Material>,
    /// How joints resist.
    #[serde(default, skip_serializing_if = "Joints::is_empty")]
    pub joints: Joints,
    /// Blocks given one by one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub blocks: Vec<BlockSpec>,
    /// Structures given by a few numbers each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub templates: Vec<Template>,
    /// Interfaces given by hand; detection skips these pairs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub interfaces: Vec<InterfaceSpec>,
    /// Loads besides the weight of the blocks.
    #[serde(default, skip_serializing_if = "Loads::is_empty")]
    pub loads: Loads,
    /// Ties, struts, tendons, strips, dowels, soil and grips beside the contacts; templates may
    /// carry members of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<Member>,
    /// When faces touch.
    #[serde(default, skip_serializing_if = "ContactSpec::is_default")]
    pub contact: ContactSpec,
    /// The earthquakes of the place where it stands. `kinematic` alone asks for them.
    pub site: Option<Site>,
    /// Stages of construction, in order; the scene itself is all that ever stands. `stages` alone
    /// asks for them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<StageSpec>,
    /// Axles that drive over the road of a bridge. `limit --moving` alone asks for them.
    pub train: Option<Train>,
    /// Combinations of actions with their partial factors. `combinations` asks a question in each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub combinations: Vec<Combination>,
    /// The name of the combination in force for all questions; loads and strengths are characteristic
    /// values where there is none.
    pub combination: Option<String>,
    /// What is required of answers; options of a question come before it.
    #[serde(default, skip_serializing_if = "Requirements::is_empty")]
    pub require: Requirements,
}

/// 9.81 m/s² downward.
pub fn standard_gravity() -> [f64; 3] {
    [0.0, 0.0, -9.81]
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            format: SceneFormat::V1,
            name: String::new(),
            source: String::new(),
            record: Record::default(),
            gravity: standard_gravity(),
            materials: BTreeMap::new(),
            joints: Joints::default(),
            blocks: Vec::new(),
            templates: Vec::new(),
            interfaces: Vec::new(),
            loads: Loads::default(),
            members: Vec::new(),
            contact: ContactSpec::default(),
            site: None,
            stages: Vec::new(),
            train: None,
            combinations: Vec::new(),
            combination: None,
            require: Requirements::default(),
        }
    }
}
