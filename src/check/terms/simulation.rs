//! What a simulation says of itself.

use serde::{Deserialize, Serialize};

/// What became of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// It came to rest where it was.
    Stands,
    /// A block moved by more than [`FALLEN`](base::tolerance::FALLEN) × its thickness and was
    /// still moving.
    Falls,
    /// Neither.
    Undecided,
}

/// How finely time is cut; measured on masonry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Fidelity {
    /// √(L/g) / 100, L the median block size, 20 substeps: to be trusted 3 % away from a critical
    /// parameter.
    Fast,
    /// √(L/g) / 400, 20 substeps: to be trusted 1 % away from it.
    Fine,
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// A block had fallen.
    Fallen,
    /// Everything rested long enough.
    Rest,
    /// The horizon was reached.
    Horizon,
    /// The caller wanted no more.
    Stopped,
    /// The engine's numbers were no longer finite.
    Broken,
}

/// One run of the engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Settings.
    pub fidelity: Fidelity,
    /// What it shows.
    pub fate: Fate,
    /// Why it ended.
    pub stop: Stop,
    /// Length of a step, s.
    pub step: f64,
    /// Substeps of a step.
    pub substeps: usize,
    /// Steps taken.
    pub steps: usize,
    /// Time simulated, s.
    pub time: f64,
    /// Time allowed, s.
    pub horizon: f64,
    /// The block that moved farthest for its thickness; empty where nothing is free.
    pub farthest: String,
    /// How far, over all times: its centre's way and the way of its farthest corner about it, m.
    pub displacement: f64,
    /// The same over the least thickness of that block.
    pub relative: f64,
    /// Largest kinetic energy of a block at the end over its m g L.
    pub energy: f64,
    /// Seconds of computing; not saved.
    #[serde(skip)]
    pub seconds: f64,
}
