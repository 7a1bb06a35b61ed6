//! The file of rows (`"format": "voussoir-rows/1"`): a header, then one row a line.

use super::{Plan, Shard, Sweep};
use crate::analysis::coulomb::Found;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RowsFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-rows/1")]
    V1,
}

/// The first line: everything the rows depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// The format and its version.
    pub format: RowsFormat,
    /// Version of the program.
    pub voussoir: String,
    /// Rows of all shards.
    pub rows: usize,
    /// Which of them are here.
    pub shard: Shard,
    /// Whether every row carries a check sum; older files have none.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub sums: bool,
    /// The plan.
    pub plan: Plan,
    /// The scene it names.
    pub scene: Value,
}

impl Header {
    pub(super) fn new(sweep: &Sweep, shard: Shard) -> Self {
        Self {
            format: RowsFormat::V1,
            voussoir: env!("CARGO_PKG_VERSION").into(),
            rows: sweep.rows(),
            shard,
            sums: true,
            plan: sweep.plan.clone(),
            scene: sweep.scene.clone(),
        }
    }

    /// Why rows under this header are not rows under `other`; the path of the scene file, the names
    /// and whether there are check sums do not matter.
    pub fn differs(&self, other: &Self) -> Option<&'static str> {
        let (a, b) = (&self.plan, &other.plan);
        let vary = |p: &Plan| -> Vec<super::Vary> { p.vary.iter().map(|v| super::Vary { name: None, ..v.clone() }).collect() };
        [
            (self.voussoir != other.voussoir, "another version of this program made them"),
            (a.question != b.question, "the question differs"),
            (vary(a) != vary(b), "what varies differs"),
            (a.sampling != b.sampling, "the sampling differs"),
            (a.seed != b.seed, "the seed differs"),
            (self.scene != other.scene, "the scene differs"),
        ]
        .into_iter()
        .find_map(|(differs, why)| differs.then_some(why))
    }
}

/// How a row ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RowStatus {
    /// It stands.
    Stable,
    /// It stands only with a pre-stress that nobody applied.
    Conditional,
    /// It falls.
    Unstable,
    /// There is a value.
    Found,
    /// There is no limit.
    Unbounded,
    /// No load factor lets it stand.
    Impossible,
    /// Neither proof closes.
    Undecided,
    /// The scene has no answer; the row says why.
    Error,
}

impl RowStatus {
    /// As written in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Conditional => "conditional",
            Self::Unstable => "unstable",
            Self::Found => "found",
            Self::Unbounded => "unbounded",
            Self::Impossible => "impossible",
            Self::Undecided => "undecided",
            Self::Error => "error",
        }
    }
}

/// An answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowAnswer {
    /// What became of the question.
    pub status: RowStatus,
    /// The load factor, or the tilt in degrees: with dry friction unless the plan says `associative`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Lower end of its bracket; of `assess` that of the least unbalance, in multiples of gravity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lower: Option<f64>,
    /// Upper end. With dry friction that slides it is the bound by associative sliding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upper: Option<f64>,
    /// How the value with dry friction was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry: Option<Found>,
    /// The direction of the least tilt.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub toward: Option<[f64; 3]>,
}

impl RowAnswer {
    /// An answer that is only a word.
    pub fn of(status: RowStatus) -> Self {
        Self { status, value: None, lower: None, upper: None, dry: None, toward: None }
    }
}

/// One row. The time stands last: everything before it is the same whatever the threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its number, from 0.
    pub row: usize,
    /// The numbers, in the order of the plan's `vary`.
    pub parameters: Vec<f64>,
    /// The answer.
    #[serde(flatten)]
    pub answer: RowAnswer,
    /// Why there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Seconds it took.
    pub seconds: f64,
}

impl Row {
    /// Whether two rows say the same, the time apart.
    pub fn same(&self, other: &Self) -> bool {
        Self { seconds: other.seconds, ..self.clone() } == *other
    }
}
