//! A simulation in a result: names instead of indices, and what it says beside the verdict.

use crate::terms::{Agreement, Fate, Run};
use base::error::Finding;
use serde::{Deserialize, Serialize};

/// What happened in time. Observed, not proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Simulation {
    /// What became of it.
    pub fate: Fate,
    /// When the first block had fallen, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub collapse: Option<f64>,
    /// The runs, the decisive one last.
    pub runs: Vec<Run>,
    /// Beside the verdict, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub agreement: Option<Agreement>,
    /// The first motion, the blocks that moved farthest first; blocks at rest are left out.
    pub first_motion: Vec<BlockMotion>,
    /// Contact forces at the end.
    pub contacts: Vec<PairForce>,
    /// What is left when the contact forces on the supports and all loads are added up, over the
    /// loads: 0 at rest.
    pub reaction_error: f64,
    /// Where every block was at the times asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<FrameResult>,
    /// What the simulation could not respect.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
}

/// How a block began to move.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockMotion {
    /// The block.
    pub block: String,
    /// Way of its centre of mass, m.
    pub way: [f64; 3],
    /// Its rotation vector, radians.
    pub turn: [f64; 3],
}

/// The contact force between two blocks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairForce {
    /// The blocks.
    pub between: [String; 2],
    /// Force on the second, N.
    pub force: [f64; 3],
}

/// One time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrameResult {
    /// s.
    pub time: f64,
    /// Index of the run.
    pub run: usize,
    /// Kinetic energy of all blocks, J.
    pub energy: f64,
    /// Centre of mass of each block (x, y, z; m) and its rotation from the start (quaternion w, x,
    /// y, z), in scene order.
    pub blocks: Vec<[f64; 7]>,
}
