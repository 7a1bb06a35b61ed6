//! Solving a conic program. What comes back is a candidate, never an answer: every verdict is
//! recomputed from the scene.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(target_arch = "wasm32")]
extern crate faer32 as faer;

mod clarabel;
pub mod clock;
pub mod coulomb;
pub mod deadline;
mod engine;
mod fronts;
mod interior;
mod krylov;
mod lu;
pub mod program;
mod watched;

pub use self::{
    fronts::Fronts,
    krylov::Blocks,
    lu::Lu,
    watched::{Session, solve, solve_near},
};

pub use check::terms::{Engine, Status};
pub use cholesky::{Cholesky, Pattern};

use crate::deadline::Deadline;
use serde::{Deserialize, Serialize};

/// What solves a program, with the settings that it alone has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EngineSettings {
    /// [`Engine::Clarabel`].
    Clarabel {
        /// Static regularisation of the KKT system.
        regularization: f64,
        /// Whether the engine rescales rows and columns once more.
        equilibrate: bool,
    },
    /// [`Engine::Interior`]; clarabel, as it usually is, where the program is not one of contacts.
    Interior,
}

impl EngineSettings {
    /// Clarabel with this regularisation.
    pub const fn clarabel(regularization: f64) -> Self {
        Self::Clarabel { regularization, equilibrate: true }
    }

    /// The name of the engine.
    pub fn engine(&self) -> Engine {
        match self {
            Self::Clarabel { .. } => Engine::Clarabel,
            Self::Interior => Engine::Interior,
        }
    }

    /// The regularisation of an engine that has one.
    pub fn regularization(&self) -> Option<f64> {
        match self {
            Self::Clarabel { regularization, .. } => Some(*regularization),
            Self::Interior => None,
        }
    }
}

impl Default for EngineSettings {
    fn default() -> Self {
        Self::clarabel(1e-8)
    }
}

/// Settings of one solve.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// What solves it.
    pub engine: EngineSettings,
    /// Tolerance on gap and feasibility, relative and absolute in the scaled program.
    pub tolerance: f64,
    /// The same where it is the value's sign that counts, and the value, which cannot be negative, is
    /// far from zero. The engine for programs of contacts heeds it.
    pub where_positive: f64,
    /// Most iterations.
    pub iterations: u32,
    /// When all solves of a session together have to end.
    pub deadline: Deadline,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            engine: EngineSettings::default(),
            tolerance: 1e-10,
            where_positive: 0.0,
            iterations: 200,
            deadline: Deadline::NEVER,
        }
    }
}

/// One interior-point iteration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Iteration {
    /// Seconds since the start of the solve.
    pub seconds: f64,
    /// Primal objective.
    pub primal: f64,
    /// Dual objective.
    pub dual: f64,
    /// Primal residual.
    pub primal_residual: f64,
    /// Dual residual.
    pub dual_residual: f64,
}

/// What the engine left behind.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Primal variables; empty where the program was refused.
    pub x: Vec<f64>,
    /// Multipliers.
    pub z: Vec<f64>,
    /// The engine's word.
    pub status: Status,
    /// The iterations.
    pub trace: Vec<Iteration>,
    /// Seconds, set-up included.
    pub seconds: f64,
    /// A point on the way, where that of a program alike may begin; not every engine passes one.
    pub passed: Option<Passed>,
}

/// A point inside the cones that an engine passed on its way.
#[derive(Clone, Debug)]
pub struct Passed {
    /// Primal variables.
    pub x: Vec<f64>,
    /// Slack of the rows; zero in those of equalities.
    pub slack: Vec<f64>,
    /// Multipliers.
    pub z: Vec<f64>,
}

impl Solution {
    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        !self.x.is_empty() && self.x.iter().chain(&self.z).all(|v| v.is_finite())
    }
}
