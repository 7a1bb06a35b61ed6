//! The probability of failure against a demand or a parameter, with the uncertainty of a finite
//! sample.

use super::{Header, Row, RowAnswer, RowStatus, Sampling, influence::groups};
use crate::analysis::Question;
use serde::Serialize;

/// A share of a sample, with its Wilson interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Proportion {
    /// So many failed.
    pub failed: usize,
    /// Of so many.
    pub of: usize,
    /// Their share.
    pub share: f64,
    /// Lower end of the 95 % interval.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

/// 97.5 % quantile of the standard normal distribution.
const Z95: f64 = 1.959_963_984_540_054;

/// The share `failed` / `of` with its 95 % interval after Wilson (1927), which holds near 0 and 1
/// and for small samples as well.
pub fn wilson(failed: usize, of: usize) -> Proportion {
    let (k, n) = (failed as f64, of as f64);
    if of == 0 {
        return Proportion { failed, of, share: f64::NAN, lower: 0.0, upper: 1.0 };
    }
    let (p, z2) = (k / n, Z95 * Z95);
    let middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = Z95 / (1.0 + z2 / n) * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    // At the ends the interval is closed exactly.
    let lower = if failed == 0 { 0.0 } else { (middle - half).max(0.0) };
    let upper = if failed == of { 1.0 } else { (middle + half).min(1.0) };
    Proportion { failed, of, share: p, lower, upper }
}

/// A fragility curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fragility {
    /// What runs along it.
    pub along: String,
    /// The number or the words of the plan that do, where it is not the demand.
    #[serde(skip)]
    pub vary: Option<super::Vary>,
    /// Its points: where, and how many failed there.
    pub points: Vec<(f64, Proportion)>,
}

/// Points of a curve against a demand.
const POINTS: usize = 21;

/// Whether a row failed; nothing where that is not known.
///
/// Failed is what falls or stands only with a pre-stress, a value below what the plan requires, and
/// what no load factor lets stand.
pub(super) fn failed(question: &Question, answer: &RowAnswer) -> Option<bool> {
    match (question.require(), answer.status) {
        (_, RowStatus::Stable | RowStatus::Unbounded) => Some(false),
        (_, RowStatus::Conditional | RowStatus::Unstable | RowStatus::Impossible) => Some(true),
        (Some(require), RowStatus::Found) => answer.value.map(|v| v < require),
        (None, RowStatus::Found) | (_, RowStatus::Undecided | RowStatus::Error) => None,
    }
}

/// The curve; a grid has none, for its rows are no sample of anything. Samples that fill the space
/// evenly (Latin hypercube, Sobol) scatter less than independent ones: their intervals are on the
/// wide side.
///
/// Of a load factor or tilt without a requirement it runs against the demand (a structure fails
/// where its value is below it), else against the number with index `parameter`.
pub(super) fn fragility(header: &Header, rows: &[Row], parameter: usize) -> Option<Fragility> {
    // A thrust is no resistance: nothing fails below a demand.
    if matches!(header.plan.sampling, Sampling::Grid {})
        || matches!(header.plan.question, Question::Thrust(_))
    {
        return None;
    }
    match (header.plan.question.quantity(), header.plan.question.require()) {
        (Some(quantity), None) => against_demand(quantity, rows),
        _ => {
            let known: Vec<(f64, bool)> = rows
                .iter()
                .filter_map(|r| {
                    let fails = failed(&header.plan.question, &r.answer)?;
                    Some((header.coordinate(r, parameter), fails))
                })
                .collect();
            let vary = header.plan.vary.get(parameter)?.clone();
            let along = vary.label().to_string();
            let points = groups(&known.iter().map(|k| k.0).collect::<Vec<_>>())
                .into_iter()
                .map(|group| {
                    let middle =
                        group.iter().map(|&i| known[i].0).sum::<f64>() / group.len() as f64;
                    (middle, wilson(group.iter().filter(|&&i| known[i].1).count(), group.len()))
                })
                .collect::<Vec<_>>();
            (points.len() >= 2).then_some(Fragility { along, vary: Some(vary), points })
        }
    }
}

fn against_demand(quantity: &str, rows: &[Row]) -> Option<Fragility> {
    let strengths: Vec<f64> = rows
        .iter()
        .filter_map(|r| match r.answer.status {
            RowStatus::Found => r.answer.value,
            RowStatus::Unbounded => Some(f64::INFINITY),
            RowStatus::Impossible => Some(f64::NEG_INFINITY),
            _ => None,
        })
        .collect();
    let found = || strengths.iter().copied().filter(|v| v.is_finite());
    let (least, most) =
        (found().fold(f64::INFINITY, f64::min), found().fold(f64::NEG_INFINITY, f64::max));
    if least >= most {
        return None;
    }
    // Exactly the greatest at the end: rounding must not let it fail its own demand.
    let at = |k: usize| {
        if k + 1 == POINTS { most } else { least + (most - least) * k as f64 / (POINTS - 1) as f64 }
    };
    let point = |demand: f64| {
        (demand, wilson(strengths.iter().filter(|s| **s < demand).count(), strengths.len()))
    };
    Some(Fragility {
        along: format!("demanded {quantity}"),
        vary: None,
        points: (0..POINTS).map(|k| point(at(k))).collect(),
    })
}
