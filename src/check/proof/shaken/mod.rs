//! Results of `shake`: nothing is claimed. The history of all blocks is observed in the engine, and
//! observed again by who checks.

mod verify;

pub(super) use verify::verify;

use super::simulation::FrameResult;
use crate::{
    ground::ShakeOptions,
    terms::{Fidelity, Stop},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The answer about all blocks on ground that moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShakenAnswer {
    /// What was asked, with the record itself.
    pub asked: ShakeOptions,
    /// Unit direction of the motion, horizontal.
    pub toward: [f64; 3],
    /// What became of it.
    pub fate: ShakenWord,
    /// The first block that overturned or fell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub overturned: Option<String>,
    /// When, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub overturned_at: Option<f64>,
    /// Free blocks in scene order.
    pub blocks: Vec<ShakenBlock>,
    /// Settings of the steps.
    pub fidelity: Fidelity,
    /// A step, s.
    pub step: f64,
    /// Substeps of it.
    pub substeps: usize,
    /// Steps taken.
    pub steps: usize,
    /// Time simulated, s.
    pub time: f64,
    /// Why it ended.
    pub stop: Stop,
}

/// What became of a scene on ground that moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ShakenWord {
    /// Everything came to rest.
    Rests,
    /// Something still moved when the time was over.
    Moves,
    /// A block overturned or fell.
    Overturns,
}

/// What a block did, ways in its own thickness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShakenBlock {
    /// The block.
    pub block: String,
    /// Its thickness, m.
    pub thickness: f64,
    /// The greatest way of its centre of mass over its thickness.
    pub greatest_over_thickness: f64,
    /// When, s.
    pub at: f64,
    /// Its way at the end over its thickness.
    pub residual_over_thickness: f64,
    /// The greatest angle by which it had turned, degrees.
    pub greatest_turn_deg: f64,
}

/// What stands beside the answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShakenResult {
    /// Where every block was at the times asked for.
    pub frames: Vec<FrameResult>,
}

impl ShakenAnswer {
    /// The blocks that went farthest for their thickness first.
    pub fn by_way(&self) -> Vec<&ShakenBlock> {
        let mut order: Vec<&ShakenBlock> = self.blocks.iter().collect();
        order.sort_by(|a, b| b.greatest_over_thickness.total_cmp(&a.greatest_over_thickness));
        order
    }

    /// The greatest way over thickness that is left.
    pub fn residual(&self) -> f64 {
        self.blocks.iter().map(|b| b.residual_over_thickness).fold(0.0, f64::max)
    }
}
