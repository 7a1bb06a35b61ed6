//! Results of `moving`: a load factor for every position of a train, each claimed and proved as one
//! of a scene of its own; the least is the answer.

mod verify;

pub(super) use verify::verify;

use super::answer::{Answer, FactorStatus, LoadFactorAnswer};
use crate::{
    terms::Deciding,
    verdict::{Verdict, exact::Grade},
};
use base::tolerance;
use model::train::{Position, Standing, Travel};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The answer about one position of a train; that of a result is the least.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MovingAnswer {
    /// Which way the train goes.
    pub travel: Travel,
    /// Where its origin is, x in the scene, m.
    pub x: f64,
    /// The axles that stand on a span.
    pub axles: Vec<Standing>,
    /// By how much their forces may be multiplied.
    pub load_factor: LoadFactorAnswer,
    /// Whether it stands without the train, where that was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// The part of the scene that decides the bound, where it has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Deciding>,
    /// How exactly that bound is proved; absent where it is undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proof: Option<Grade>,
}

impl MovingAnswer {
    /// Where the train is.
    pub fn position(&self) -> Position {
        Position { travel: self.travel, x: self.x }
    }

    /// What orders positions: one without an answer governs, for it must not hide behind the others;
    /// of these the least bound comes first. Of which it is only known that they bear what another
    /// one does, they come last.
    pub fn governing(&self) -> (f64, f64) {
        let l = &self.load_factor;
        let value = match l.status {
            FactorStatus::Unbounded | FactorStatus::AtLeast => f64::INFINITY,
            _ => l.value.unwrap_or(f64::NEG_INFINITY),
        };
        (value, l.associative.value.unwrap_or(f64::INFINITY))
    }

    /// Whether it is not below this one, as far as values are: up to where that was seen at rest.
    fn bears(&self, least: &Self) -> bool {
        let (own, other) = (&self.load_factor, &least.load_factor);
        let floor = other.value.map(|v| v - 1.01 * tolerance::REST_BELOW * v.abs()).or(other.lower);
        own.status != FactorStatus::AtLeast || own.lower.zip(floor).is_some_and(|(l, f)| l >= f)
    }
}

/// Which of these answers counts: the first of the least; nothing where one is about something else.
pub fn least<'a>(answers: impl Iterator<Item = &'a Answer>) -> Option<usize> {
    let keys: Vec<(f64, f64)> =
        answers.map(|a| a.moving().map(MovingAnswer::governing)).collect::<Option<_>>()?;
    let order = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
    (0..keys.len()).min_by(|&i, &j| order(&keys[i], &keys[j]))
}

impl Answer {
    /// What it says of a train.
    pub fn moving(&self) -> Option<&MovingAnswer> {
        match self {
            Self::Moving(a) => Some(a),
            _ => None,
        }
    }
}
