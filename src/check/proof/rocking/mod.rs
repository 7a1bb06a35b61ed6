//! Results of `rock`: what is claimed are the load factors of the mechanism, towards a direction and
//! against it; the machine and its history are computed, and computed again by who checks.

mod verify;

pub(super) use verify::verify;

use super::certificate::Certificate;
use crate::{rocking::RockOptions, terms::Bound, verdict::exact::Grade};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The answer about a mechanism on ground that moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingAnswer {
    /// What was asked, with the record itself.
    pub asked: RockOptions,
    /// Unit direction of the mechanism, horizontal.
    pub toward: [f64; 3],
    /// The mechanism towards it.
    pub towards: RockingSense,
    /// The mechanism against it.
    pub against: RockingSense,
    /// The free blocks that are in it; others touch none of them.
    pub blocks: Vec<String>,
    /// How exactly the load factors are proved, the weaker of both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proof: Option<Grade>,
    /// Why the machine is an idealisation; absent where it is exact for rigid blocks that neither
    /// slide nor bounce.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub idealised: Option<String>,
    /// The block whose way is told.
    pub control: String,
    /// The point of it at the start, m.
    pub point: [f64; 3],
    /// Its least thickness, m.
    pub thickness: f64,
    /// What became of it.
    pub fate: RockingFate,
    /// When no acceleration to come could bring it back any more, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub overturned_at: Option<f64>,
    /// When it first moved, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub released_at: Option<f64>,
    /// Where it was farthest.
    pub greatest: RockingPlace,
    /// Where it is at the end, unless it overturned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub residual: Option<RockingPlace>,
    /// Its impacts.
    pub impacts: Vec<RockingImpact>,
    /// Scales at which its fate flips, where that was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flips: Option<Vec<RockingFlip>>,
    /// What is said beside.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// A mechanism in one sense.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingSense {
    /// The acceleration of the ground beyond which it moves, in multiples of gravity; unbounded
    /// where nothing moves that way.
    pub load_factor: Bound,
    /// Small motions about the unstable equilibrium go with exp(± p t): p, 1/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency: Option<f64>,
    /// The coordinate there, rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unstable: Option<f64>,
    /// What is left of the speed at an impact that ends the motion in this sense.
    pub restitution: f64,
    /// What conserves momentum there.
    pub conserving: f64,
}

/// What became of a mechanism in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RockingFate {
    /// It came to rest where it was.
    Rests,
    /// It still rocked when the time was over.
    Rocks,
    /// It overturned.
    Overturns,
}

/// A place in a history.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingPlace {
    /// s.
    pub time: f64,
    /// The coordinate, rad; < 0 against the direction.
    pub turn: f64,
    /// Way of the control point, m.
    pub way: f64,
}

/// An impact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingImpact {
    /// s.
    pub time: f64,
    /// The rate before it, rad/s.
    pub before: f64,
    /// What was left of it.
    pub factor: f64,
}

/// Two scales next to each other with different fates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingFlip {
    /// The scale at which it overturns.
    pub overturns_at: f64,
    /// The one at which it stands.
    pub stands_at: f64,
}

/// The evidence beside the main one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingResult {
    /// Of the load factor against the direction.
    pub against: Certificate,
}
