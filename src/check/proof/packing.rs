//! The angle of maximum stability of a packing as a result: every round verified, names instead of
//! indices.

use crate::{
    terms::{Deciding, Doubt, Found, Outcome},
    verdict::fabric::Fabric,
};
use base::error::Finding;
use model::interface::Timings;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// The version of the format.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema,
)]
pub enum PackingFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-packing/1")]
    V1,
}

/// The answer about a packing.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PackingFile {
    /// The format and its version.
    pub format: PackingFormat,
    /// Name of the scene.
    pub name: String,
    /// Free grains that were asked about.
    pub grains: usize,
    /// Contacts between blocks.
    pub contacts: usize,
    /// Share of the mass of the free grains that has to move.
    pub moving_mass: f64,
    /// Index of the direction with the least tilt.
    pub least: usize,
    /// Every direction asked for.
    pub directions: Vec<PackingDirection>,
    /// How the packing carries its load when level.
    pub fabric: Option<Fabric>,
    /// Whose forces these are, or why there are none.
    pub fabric_forces: Option<String>,
    /// Why the answer is undecided, where it is.
    pub doubt: Option<Doubt>,
    /// What the question did not need.
    pub left_out: Vec<String>,
    /// What the user should know.
    pub warnings: Vec<Finding>,
    /// Seconds per stage.
    pub timings: Timings,
    /// Versions.
    pub versions: Versions,
}

/// One direction.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PackingDirection {
    /// Unit direction towards which the ground tips.
    pub toward: [f64; 3],
    /// What became of the tilt.
    pub status: Outcome,
    /// The tilt with joints that open as they slide, an upper bound for dry friction, degrees; 90
    /// where the packing is wedged.
    pub tilt_deg: Option<f64>,
    /// Its bracket, degrees.
    pub bracket_deg: Option<[f64; 2]>,
    /// How the tilt with dry friction was found, where it was asked for.
    pub dry: Option<Found>,
    /// The tilt with dry friction, degrees.
    pub dry_deg: Option<f64>,
    /// Share of the mass of the free grains that has moved, earlier rounds included.
    pub moved: f64,
    /// Whether that is as much as was asked for.
    pub reached: bool,
    /// Grains that move in the round with the answer, the one with the greatest tilt, the fastest
    /// first.
    pub moving: Vec<String>,
    /// The part of the packing that loses balance there, where it has several.
    pub part: Option<Deciding>,
    /// Joints of its mechanism that roll, slide and part.
    pub joints: [usize; 3],
    /// All rounds, where there are several: the tilt (degrees) and the grains that lost balance.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub removed: Vec<Removed>,
}

/// One round.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Removed {
    /// Degrees; absent where they fell with those before, or the verification failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_deg: Option<f64>,
    /// Grains that lost balance there.
    pub grains: Vec<String>,
}

impl PackingDirection {
    /// Whether it falls before it is tilted, or however it is.
    pub fn falls(&self) -> bool {
        match self.status {
            Outcome::Impossible => true,
            Outcome::Found | Outcome::Unbounded | Outcome::Undecided => {
                self.dry == Some(Found::NotAtRest) || self.tilt_deg.is_some_and(|tilt| tilt < 0.0)
            }
        }
    }

    /// The tilt that counts: with dry friction where known, else the bound. One without an answer
    /// governs: it must not hide.
    pub fn governing(&self) -> f64 {
        if self.dry == Some(Found::NotAtRest) {
            return f64::NEG_INFINITY;
        }
        self.dry_deg.or(self.tilt_deg).unwrap_or(f64::NEG_INFINITY)
    }
}

/// Versions of what made a result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Versions {
    /// This program.
    pub voussoir: String,
}

impl Default for Versions {
    fn default() -> Self {
        Self { voussoir: env!("CARGO_PKG_VERSION").to_string() }
    }
}
