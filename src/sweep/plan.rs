//! What a plan file says, and nothing more (`"format": "voussoir-sweep/1"`).
//! [`open`](super::open()) checks it.

use crate::analysis::Question;
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

/// One number of the scene, and what it takes. Exactly one of `from` and `to`, `values`, `normal`,
/// `lognormal`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Vary {
    /// JSON pointer (RFC 6901) to a number of the scene file: `/templates/0/arch/thickness`. A key
    /// that the file leaves out may be named too.
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

/// A lognormal distribution, by the mean and standard deviation of the value itself (not of its
/// logarithm).
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
    /// Latin hypercube (McKay, Beckman & Conover 1979): every number takes each of `samples`
    /// equally likely slices once.
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
