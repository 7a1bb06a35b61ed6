//! What a plan file says, and nothing more (`"format": "voussoir-sweep/1"`).
//! [`open`](super::open()) checks it.

use analysis::Question;
use base::number::short;
use check::ground::Series;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Number, Value};
use serde_with::skip_serializing_none;
use std::fmt;

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
    /// The numbers and words that vary.
    pub vary: Vec<Vary>,
    /// How the parameter space is covered.
    #[serde(default)]
    pub sampling: Sampling,
    /// Start of the random numbers of samples; a grid has none.
    #[serde(default)]
    pub seed: u64,
    /// Records of ground motion that the question names, and rows put there. Files that a plan names
    /// are read into here when it is opened, so that rows need no file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub records: Vec<Series>,
}

/// What a row puts into a place of the scene: a number, or a word such as the id of a block.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Parameter {
    /// A number.
    Number(f64),
    /// A word.
    Word(String),
}

impl From<f64> for Parameter {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Parameter {
    fn from(word: &str) -> Self {
        Self::Word(word.into())
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Word(word) => word.fmt(f),
        }
    }
}

impl Parameter {
    /// The number, where it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Word(_) => None,
        }
    }

    /// As it is written into a scene: whole numbers as such, for counts are read as well.
    pub(super) fn value(&self) -> Value {
        const EXACT: f64 = 9_007_199_254_740_992.0;
        match self {
            Self::Word(word) => Value::from(word.as_str()),
            Self::Number(n) if n.fract() == 0.0 && n.abs() < EXACT => Value::from(*n as i64),
            Self::Number(n) => Number::from_f64(*n).map_or(Value::Null, Value::Number),
        }
    }
}

/// One number or word of the scene, and what it takes. Exactly one of `from` and `to`, `values`, `normal`,
/// `lognormal`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Vary {
    /// JSON pointer (RFC 6901) to a number of the scene file: `/templates/0/arch/thickness`, or,
    /// with words among the `values`, to a word: `/loads/live/0/block`. A key that the file leaves
    /// out may be named too. Beginning with `/question` it leads into the question of the plan:
    /// `/question/rock/ground/scale`.
    pub pointer: String,
    /// What tables and charts call it; the pointer where nothing is said.
    pub name: Option<String>,
    /// Lower end of an interval: evenly spaced on a grid, uniform in a sample.
    pub from: Option<f64>,
    /// Upper end.
    pub to: Option<f64>,
    /// These values, each as likely as the others: numbers, or words such as ids of blocks and
    /// names of materials.
    pub values: Option<Vec<Parameter>>,
    /// Of a record of ground motion: every record in this folder, relative to that of the plan, in
    /// the order of their names. They become the `values`.
    pub folder: Option<String>,
    /// Normal distribution; on a grid the quantiles (k + 1/2) / count.
    pub normal: Option<Normal>,
    /// Lognormal distribution; on a grid the quantiles (k + 1/2) / count.
    pub lognormal: Option<Lognormal>,
    /// Grid: so many values.
    pub count: Option<usize>,
    /// Normal and lognormal: cut off below (truncated distribution).
    pub min: Option<f64>,
    /// Normal and lognormal: cut off above.
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

    /// Its values, where there are words among them.
    pub fn words(&self) -> Option<&[Parameter]> {
        self.values.as_deref().filter(|all| all.iter().any(|v| v.number().is_none()))
    }

    /// Where a value stands along an axis: a number at itself, values with words among them in
    /// their order, from 0. Not a number for what is none of them.
    pub fn coordinate(&self, value: &Parameter) -> f64 {
        match self.words() {
            Some(all) => all.iter().position(|v| v == value).map_or(f64::NAN, |k| k as f64),
            None => value.number().unwrap_or(f64::NAN),
        }
    }

    /// The value at a place along the axis.
    pub fn at(&self, coordinate: f64) -> Parameter {
        let word = self.words().and_then(|all| all.get(coordinate.round().max(0.0) as usize));
        word.cloned().unwrap_or(Parameter::Number(coordinate))
    }

    /// The name of a place along the axis: the word there, or the number in a few digits.
    pub fn place(&self, coordinate: f64) -> String {
        match self.words() {
            None => short(coordinate),
            Some(_) => match self.at(coordinate) {
                Parameter::Number(number) => short(number),
                Parameter::Word(word) => word,
            },
        }
    }
}

/// The JSON Schema (draft 2020-12) of a plan file.
pub fn schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(Plan);
    schema.insert("title".into(), "voussoir sweep plan, version 1".into());
    schema.to_value()
}
