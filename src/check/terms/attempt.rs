//! What was tried, as an answer records it.

use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// What the engine said. Only ever reported, never decided on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Within its own tolerances.
    Solved,
    /// Within its own reduced tolerances, or stopped near them.
    AlmostSolved,
    /// Says that no point satisfies the constraints.
    PrimalInfeasible,
    /// Says that the objective is unbounded.
    DualInfeasible,
    /// Ran into its limit of iterations or time.
    Limit,
    /// Lost its way numerically.
    Stalled,
    /// Refused the program.
    Refused,
}

/// What solves a program, by name.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// Clarabel: any conic program.
    #[default]
    Clarabel,
    /// The interior-point method of this crate, on the stiffness matrix of the blocks: programs in
    /// forces.
    Interior,
}

impl Engine {
    /// Whether it is the usual one.
    pub fn is_usual(&self) -> bool {
        *self == Self::default()
    }
}

/// A record of one attempt.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Attempt {
    /// Which program, in which unknowns.
    pub program: String,
    /// Force unit over the total load of the free blocks.
    pub force_unit: f64,
    /// What solved it.
    #[serde(default, skip_serializing_if = "Engine::is_usual")]
    pub engine: Engine,
    /// The engine's tolerance.
    pub tolerance: f64,
    /// The engine's regularisation, where it has one.
    pub regularization: Option<f64>,
    /// The engine's word.
    pub engine_status: Status,
    /// Iterations.
    pub iterations: usize,
    /// Unknowns and rows of the program.
    pub size: [usize; 2],
    /// Seconds.
    pub seconds: f64,
    /// The engine's number for the load factor, not recomputed.
    pub engine_value: Option<f64>,
    /// Recomputed lower end.
    #[serde(deserialize_with = "super::ends::lower")]
    #[schemars(with = "Option<f64>")]
    pub lower: f64,
    /// Recomputed upper end.
    #[serde(deserialize_with = "super::ends::upper")]
    #[schemars(with = "Option<f64>")]
    pub upper: f64,
}
