//! A simulation in a result: names instead of indices, and what it says beside the verdict.

use crate::{
    question::SimulateOptions,
    terms::{Agreement, Fate, ForceAgreement, Run, agree},
    verdict::Verdict,
};
use base::error::{Finding, FindingCode};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// What was seen in the engine. Computed: who asks it again sees the same.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Seen {
    /// How it was run.
    pub asked: SimulateOptions,
    /// What became of it.
    pub fate: Fate,
    /// When the first block had fallen, s.
    pub collapse: Option<f64>,
    /// The runs, the decisive one last.
    pub runs: Vec<Run>,
    /// Beside a verdict that it falls: cosine between the first motion and the mechanism.
    pub motion: Option<f64>,
    /// Beside a verdict that it stands: the forces between blocks, simulated against computed.
    pub forces: Option<ForceAgreement>,
    /// The first motion, the blocks that moved farthest first; blocks at rest are left out.
    pub first_motion: Vec<BlockMotion>,
    /// Contact forces at the end.
    pub contacts: Vec<PairForce>,
    /// What is left when the contact forces on the supports and all loads are added up, over the
    /// loads: 0 at rest.
    pub reaction_error: f64,
    /// What the simulation could not respect.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
}

/// What happened in time, as an answer tells it. Observed, not proved.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Simulation {
    /// What became of it.
    pub fate: Fate,
    /// When the first block had fallen, s.
    pub collapse: Option<f64>,
    /// The runs, the decisive one last.
    pub runs: Vec<Run>,
    /// Beside the verdict, where there is one.
    pub agreement: Option<Agreement>,
    /// The first motion, the blocks that moved farthest first; blocks at rest are left out.
    pub first_motion: Vec<BlockMotion>,
    /// Contact forces at the end.
    pub contacts: Vec<PairForce>,
    /// What is left when the contact forces on the supports and all loads are added up, over the
    /// loads: 0 at rest.
    pub reaction_error: f64,
    /// What the simulation could not respect.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
}

impl Seen {
    /// What is told of it, beside a verdict where there is one.
    pub fn told(&self, verdict: Option<Verdict>) -> Simulation {
        let left_out = self.findings.iter().any(|f| f.code == FindingCode::LeftOut);
        let agreement = verdict.map(|verdict| Agreement {
            verdict,
            fate: self.fate,
            agrees: agree(verdict, self.fate, left_out),
            motion: self.motion,
            forces: self.forces.clone(),
        });
        Simulation {
            fate: self.fate,
            collapse: self.collapse,
            runs: self.runs.clone(),
            agreement,
            first_motion: self.first_motion.clone(),
            contacts: self.contacts.clone(),
            reaction_error: self.reaction_error,
            findings: self.findings.clone(),
        }
    }
}

/// How a block began to move.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairForce {
    /// The blocks.
    pub between: [String; 2],
    /// Force on the second, N.
    pub force: [f64; 3],
}

/// One time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
