//! What the rows of a sweep have in common.

use super::{
    Fragility, Header, Influence, Proportion, Row, RowStatus,
    fragility::{failed, fragility},
    influence::influence,
    wilson,
};
use base::tolerance;
use serde::Serialize;
use serde_with::skip_serializing_none;
use std::collections::BTreeMap;

/// A sweep in a few numbers.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Rows that are there.
    pub rows: usize,
    /// How they ended.
    pub counts: BTreeMap<&'static str, usize>,
    /// Rows without an answer: with an error, or undecided.
    pub open: usize,
    /// Rows with a value: what quantiles and influences are of.
    pub valued: usize,
    /// Quantiles of the values that were found.
    pub quantiles: Option<Quantiles>,
    /// How many failed, of those whose answer tells.
    pub failed: Option<Proportion>,
    /// What matters, the most first, of the rows with a value.
    pub influence: Vec<Influence>,
    /// The fragility curve, of a sample.
    pub fragility: Option<Fragility>,
    /// The first row with an error, and its error.
    pub first_error: Option<(usize, String)>,
    /// Seconds of all rows together.
    pub seconds: f64,
}

/// Quantiles of a sample, linear between its values (type 7 of Hyndman & Fan 1996).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quantiles {
    /// The least, and the number of its row.
    pub least: (f64, usize),
    /// 5 %.
    pub p05: f64,
    /// 25 %.
    pub p25: f64,
    /// Half lie below.
    pub median: f64,
    /// 75 %.
    pub p75: f64,
    /// 95 %.
    pub p95: f64,
    /// The greatest, and the number of its row.
    pub greatest: (f64, usize),
}

/// Sums up the rows that are there.
pub fn summarize(header: &Header, rows: &[Row]) -> Summary {
    let mut counts = BTreeMap::new();
    for row in rows {
        *counts.entry(row.answer.status.word()).or_insert(0) += 1;
    }
    let question = &header.plan.question;
    let fates: Vec<bool> = rows.iter().filter_map(|r| failed(question, &r.answer)).collect();
    let told = question.quantity().is_none() || question.require().is_some();
    let influence = influences(header, rows);
    let most = influence.first().map_or(0, |i| i.index);
    Summary {
        rows: rows.len(),
        counts,
        valued: rows.iter().filter(|r| value_of(header, r).is_some()).count(),
        open: rows
            .iter()
            .filter(|r| matches!(r.answer.status, RowStatus::Error | RowStatus::Undecided))
            .count(),
        quantiles: quantiles(rows),
        failed: (told && !fates.is_empty())
            .then(|| wilson(fates.iter().filter(|f| **f).count(), fates.len())),
        fragility: fragility(header, rows, most),
        influence,
        first_error: rows
            .iter()
            .find(|r| r.answer.status == RowStatus::Error)
            .map(|r| (r.row, r.error.clone().unwrap_or_default())),
        seconds: rows.iter().map(|r| r.seconds).sum(),
    }
}

fn quantiles(rows: &[Row]) -> Option<Quantiles> {
    let mut values: Vec<(f64, usize)> = rows
        .iter()
        .filter_map(|r| Some((r.answer.value.filter(|v| v.is_finite())?, r.row)))
        .collect();
    values.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let at = |p: f64| {
        let place = p * (values.len() - 1) as f64;
        let (low, high) = (place.floor() as usize, place.ceil() as usize);
        values[low].0 + (place - place.floor()) * (values[high].0 - values[low].0)
    };
    let (least, greatest) =
        (extreme(&values, values.first()?.0), extreme(&values, values.last()?.0));
    Some(Quantiles {
        least,
        p05: at(0.05),
        p25: at(0.25),
        median: at(0.5),
        p75: at(0.75),
        p95: at(0.95),
        greatest,
    })
}

/// An extreme value with the first of the rows that have it: what differs by its rounding alone is
/// the same.
fn extreme(values: &[(f64, usize)], value: f64) -> (f64, usize) {
    let same =
        values.iter().filter(|v| (v.0 - value).abs() <= tolerance::SAME_ANSWER * value.abs());
    (value, same.map(|v| v.1).min().unwrap_or(0))
}

/// What a row has to show where values are drawn: every row is one of them, so that none is left
/// out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown {
    /// Its value, or 0 for failed and 1 for not where the answer is a verdict.
    Value(f64),
    /// There is no limit, or it stands throughout.
    Unlimited,
    /// Neither proof closes.
    Undecided,
    /// The scene has no answer.
    Error,
    /// It falls, or stands only with self-stress, whatever the value.
    Falls,
}

impl Shown {
    /// What a row shows.
    pub fn of(header: &Header, row: &Row) -> Self {
        let value = match header.plan.question.quantity() {
            Some(_) => row.answer.value.filter(|v| v.is_finite()),
            None => failed(&header.plan.question, &row.answer).map(|f| if f { 0.0 } else { 1.0 }),
        };
        match (value, row.answer.status) {
            (Some(value), _) => Self::Value(value),
            (_, RowStatus::Impossible | RowStatus::Unstable | RowStatus::Conditional) => {
                Self::Falls
            }
            (_, RowStatus::Unbounded | RowStatus::Stable) => Self::Unlimited,
            (_, RowStatus::Error) => Self::Error,
            (_, RowStatus::Undecided | RowStatus::Found) => Self::Undecided,
        }
    }

    /// Its value, where it has one.
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Value(value) => Some(value),
            _ => None,
        }
    }

    /// Which of two stands for both where they are drawn in one place: a mean of values is one of
    /// all rows or none, and what weighs most against safety is seen.
    #[must_use]
    pub fn graver(self, other: Self) -> Self {
        if other.weight() > self.weight() { other } else { self }
    }

    fn weight(self) -> u8 {
        match self {
            Self::Value(_) => 0,
            Self::Unlimited => 1,
            Self::Undecided => 2,
            Self::Error => 3,
            Self::Falls => 4,
        }
    }
}

/// The number of an answer: its value, or 0 for failed and 1 for not; nothing where there is none.
pub fn value_of(header: &Header, row: &Row) -> Option<f64> {
    Shown::of(header, row).value()
}

fn influences(header: &Header, rows: &[Row]) -> Vec<Influence> {
    let known: Vec<(&Row, f64)> =
        rows.iter().filter_map(|r| Some((r, value_of(header, r)?))).collect();
    let answers: Vec<f64> = known.iter().map(|k| k.1).collect();
    let mut list: Vec<Influence> = header
        .plan
        .vary
        .iter()
        .enumerate()
        .filter_map(|(index, vary)| {
            let values: Vec<f64> = known.iter().map(|(r, _)| header.coordinate(r, index)).collect();
            let share = if values.len() == answers.len() {
                influence(&values, &answers)?
            } else {
                return None;
            };
            Some(Influence { parameter: vary.label().to_string(), index, share })
        })
        .collect();
    list.sort_by(|a, b| b.share.total_cmp(&a.share).then(a.index.cmp(&b.index)));
    list
}
