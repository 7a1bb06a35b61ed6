//! Why an answer is undecided.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DoubtCause {
    /// Edges or corners meet with several normals, and which of them acts decides.
    Edges,
    /// Time was over first.
    TimeLimit,
    /// What came out did not pass its own check on the scene.
    Refused,
    /// The state under dry friction came neither to rest nor to a motion.
    DryFriction,
    /// Masses, sizes or friction of the scene are spread wider than the numbers of a solver carry.
    WideNumbers,
    /// The scene lies on the line between standing and falling, as far as numbers tell.
    OnTheLine,
    /// The bracket closed in part, and no attempt closed it further.
    OpenBracket,
    /// No attempt of the solver came to anything.
    NoAttempt,
    /// Values of the range make no scene, or are undecided themselves.
    Range,
    /// In time it neither rests nor has fallen.
    StillMoving,
    /// The simulation broke off.
    BrokeOff,
}

/// Why an answer is undecided.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Doubt {
    /// The most probable cause.
    pub cause: DoubtCause,
    /// What speaks for it, with its numbers.
    pub evidence: String,
    /// The one thing to do next.
    pub next: String,
}

impl Doubt {
    /// A doubt, wrapped as every branch that looks for one gives it.
    pub fn new(
        cause: DoubtCause,
        evidence: impl Into<String>,
        next: impl Into<String>,
    ) -> Option<Self> {
        Some(Self { cause, evidence: evidence.into(), next: next.into() })
    }
}
