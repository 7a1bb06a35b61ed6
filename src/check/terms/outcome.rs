//! What became of a load factor, a tilt, an end of a range.

use serde::{Deserialize, Serialize};

/// What became of the load factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The greatest load factor, in a narrow bracket.
    Found,
    /// The live load can grow without limit: contact forces balance it by themselves (wedged).
    Unbounded,
    /// No multiple of the live load lets the scene stand.
    Impossible,
    /// The bracket did not close.
    Undecided,
}
