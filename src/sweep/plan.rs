//! What a plan file says, and nothing more (`"format": "voussoir-sweep/1"`). [`open`](super::open()) checks it.

use crate::analysis::Law;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum PlanFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-sweep/1")]
    V1,
}

/// A question over a parameter space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The format and its version.
    pub format: PlanFormat,
    /// A name for people.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// The scene file, relative to the folder of the plan.
    pub scene: String,
    /// What is asked of every scene.
    pub question: Question,
    /// The numbers that vary.
    pub vary: Vec<Vary>,
    /// How the parameter space is covered.
    #[serde(default)]
    pub sampling: Sampling,
    /// Start of the random numbers of samples; a grid has none.
    #[serde(default)]
    pub seed: u64,
}

/// A question of the command line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// Does it stand under its dead load?
    Assess(AssessOptions),
    /// How large may the live load grow?
    Limit(LimitOptions),
    /// At what tilt does it fall? In several directions the least.
    Tilt(TiltOptions),
    /// Least or greatest thrust on a support.
    Thrust(ThrustOptions),
    /// The angle of maximum stability of a packing of grains; in several directions the least.
    Repose(ReposeOptions),
    /// Does it stand in time, by the rigid-body engine? A second opinion, not a proof.
    Simulate(SimulateOptions),
}

/// Options of `assess`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AssessOptions {
    /// How joints slide.
    pub law: Law,
}

/// Options of `limit`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LimitOptions {
    /// How joints slide.
    pub law: Law,
    /// A load factor below this counts as failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub require: Option<f64>,
}

/// Options of `tilt`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TiltOptions {
    /// How joints slide.
    pub law: Law,
    /// A tilt below this, in degrees, counts as failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub require: Option<f64>,
    /// Tip towards these directions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x; 8 where nothing is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub all: Option<u16>,
}

/// Options of `thrust`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ThrustOptions {
    /// Whether there must be forces only, or such as the loads produce.
    pub law: Law,
    /// The support; the first that touches a free block where nothing is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub support: Option<String>,
    /// Direction of the thrust; outwards where nothing is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// The greatest thrust instead of the least.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub greatest: bool,
}

/// Options of `repose`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ReposeOptions {
    /// How grains slide.
    pub law: Law,
    /// An angle below this, in degrees, counts as failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub require: Option<f64>,
    /// Tip towards these directions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x; 8 where nothing is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub all: Option<u16>,
    /// The share of the grains' mass that has to move; 0, the first grain, where nothing is said.
    pub moving_mass: f64,
}

/// Options of `simulate`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SimulateOptions {
    /// Fast steps only: to be trusted 3 % away from a limit.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fast: bool,
    /// This factor × the live loads is added.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_factor: Option<f64>,
}

/// One number of the scene, and what it takes. Exactly one of `from` and `to`, `values`, `normal`, `lognormal`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Vary {
    /// JSON pointer (RFC 6901) to a number of the scene file: `/templates/0/arch/thickness`. A key that the file leaves out may be named too.
    pub pointer: String,
    /// What tables and charts call it; the pointer where nothing is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Lower end of an interval: evenly spaced on a grid, uniform in a sample.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
    /// Upper end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
    /// These values, each as likely as the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub values: Option<Vec<f64>>,
    /// Normal distribution; on a grid the quantiles (k + 1/2) / count.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<Normal>,
    /// Lognormal distribution; on a grid the quantiles (k + 1/2) / count.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lognormal: Option<Lognormal>,
    /// Grid: so many values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// Normal and lognormal: cut off below (truncated distribution).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Normal and lognormal: cut off above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Round to whole numbers, for counts.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub round: bool,
}

/// A normal distribution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Normal {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub sd: f64,
}

/// A lognormal distribution, by the mean and standard deviation of the value itself (not of its logarithm).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lognormal {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub sd: f64,
}

/// How the parameter space is covered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Sampling {
    /// Every combination; the last number of `vary` changes fastest.
    Grid {},
    /// Latin hypercube (McKay, Beckman & Conover 1979): every number takes each of `samples` equally likely slices once.
    LatinHypercube {
        /// Rows.
        samples: usize,
    },
    /// Sobol points with Owen scrambling (Burley 2020), which fill the space evenly.
    Sobol {
        /// Rows; a power of two is best.
        samples: usize,
    },
    /// Independent random rows.
    Random {
        /// Rows.
        samples: usize,
    },
}

impl Default for Sampling {
    fn default() -> Self {
        Self::Grid {}
    }
}

impl Question {
    /// How joints slide.
    pub fn law(&self) -> Law {
        match self {
            Self::Assess(o) => o.law,
            Self::Limit(o) => o.law,
            Self::Tilt(o) => o.law,
            Self::Thrust(o) => o.law,
            Self::Repose(o) => o.law,
            // What slides in time does not open.
            Self::Simulate(_) => Law::Coulomb,
        }
    }

    /// The value below which an answer counts as failure.
    pub fn require(&self) -> Option<f64> {
        match self {
            Self::Assess(_) | Self::Thrust(_) | Self::Simulate(_) => None,
            Self::Limit(o) => o.require,
            Self::Tilt(o) => o.require,
            Self::Repose(o) => o.require,
        }
    }

    /// What the value of a row is, with its unit; nothing where the answer is a verdict.
    pub fn quantity(&self) -> Option<&'static str> {
        match self {
            Self::Assess(_) | Self::Simulate(_) => None,
            Self::Thrust(o) => Some(if o.greatest { "greatest thrust in N" } else { "least thrust in N" }),
            Self::Limit(_) => Some("load factor"),
            Self::Tilt(_) => Some("tilt in degrees"),
            Self::Repose(_) => Some("angle of maximum stability in degrees"),
        }
    }
}

impl Vary {
    /// What tables and charts call it.
    pub fn label(&self) -> &str {
        self.name.as_deref().unwrap_or(&self.pointer)
    }
}

/// The JSON Schema (draft 2020-12) of a plan file.
pub fn schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(Plan);
    schema.insert("title".into(), "voussoir sweep plan, version 1".into());
    schema.to_value()
}
