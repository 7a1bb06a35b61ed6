//! How far a path goes along the live load.

use super::{joints::Joints, track::Track};
use crate::terms::{Bound, Outcome};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How far a path goes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathFactor {
    /// How it ended.
    pub end: PathEnd,
    /// The load factor of the path: where nothing slides on the way the proved bound, else the
    /// greatest at which a state was found. Absent where it was not followed to its end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// The greatest load factor at which a state was found.
    pub reached: f64,
    /// Whether anything slides on the way.
    pub slides: bool,
    /// The bound by limit analysis: never below.
    pub associative: Bound,
}

/// How a path ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PathEnd {
    /// There is no live load, or it was not asked about.
    #[default]
    None,
    /// A thousandth below the bound of limit analysis; where anything slides, and displacements do not
    /// grow without end, a millionth.
    Bound,
    /// There is no bound: at ten times the load factor at which live and dead load weigh the same.
    Unbounded,
    /// No displacements balance the loads beyond.
    NoBalance,
    /// It was not followed to its end.
    Open,
}

impl PathFactor {
    /// That of a path that ended so, with the bound by limit analysis.
    pub fn new(end: PathEnd, track: &Track, joints: &Joints, associative: Bound) -> Self {
        let reached = track.steps[track.steps.len() - 1].load_factor;
        let slides = track.slides(joints);
        let value = match (end, associative.status) {
            (PathEnd::Bound, Outcome::Found) if !slides => associative.value,
            (PathEnd::Bound | PathEnd::NoBalance, _) => Some(reached),
            (PathEnd::None | PathEnd::Unbounded | PathEnd::Open, _) => None,
        };
        Self { end, value, reached, slides, associative }
    }
}
