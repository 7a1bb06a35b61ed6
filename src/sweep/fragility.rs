//! The probability of failure against a demand or a parameter, with the uncertainty of a finite
//! sample.

use super::{
    Header, LognormalFit, Plan, Row, RowAnswer, RowStatus, Sampling,
    influence::{groups, same},
    records,
};
use analysis::Question;
use serde::Serialize;
use serde_with::skip_serializing_none;

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
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fragility {
    /// What runs along it.
    pub along: String,
    /// The number or the words of the plan that do, where it is not the demand.
    #[serde(skip)]
    pub vary: Option<super::Vary>,
    /// Its points: where, and how many failed there.
    pub points: Vec<(f64, Proportion)>,
    /// Under ground that moves: the lognormal curve of most likelihood.
    pub lognormal: Option<LognormalFit>,
    /// Why there is no such curve, where one was looked for.
    pub no_lognormal: Option<String>,
}

/// Whether rows are a sample of something: those of a grid are none, unless records of ground motion
/// vary in it, which are a sample of earthquakes.
pub fn is_sample(plan: &Plan) -> bool {
    !matches!(plan.sampling, Sampling::Grid {})
        || plan.vary.iter().any(|v| records::is_record(&v.pointer))
}

/// The number that says how strong the ground moves, where one varies.
fn intensity(plan: &Plan) -> Option<usize> {
    const ENDS: [&str; 3] = ["/scale", "/acceleration", "/velocity"];
    plan.vary.iter().position(|v| {
        let ground = ["/question/rock/ground/", "/question/shake/ground/"]
            .iter()
            .any(|g| v.pointer.starts_with(g));
        ground && ENDS.iter().any(|end| v.pointer.ends_with(end))
    })
}

/// Points of a curve against a demand.
const POINTS: usize = 21;

/// Whether a row failed; nothing where that is not known.
///
/// Failed is what falls or stands only with self-stress, a value below what the plan requires, and
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
    if !is_sample(&header.plan) || matches!(header.plan.question, Question::Thrust(_)) {
        return None;
    }
    match (header.plan.question.quantity(), header.plan.question.require()) {
        (Some(quantity), None) => {
            let rocks = matches!(header.plan.question, Question::Rock(_) | Question::Shake(_));
            against_demand(quantity, rows, rocks)
        }
        _ => {
            let rocks = matches!(header.plan.question, Question::Rock(_) | Question::Shake(_));
            let grid = matches!(header.plan.sampling, Sampling::Grid {});
            let shakes = intensity(&header.plan).filter(|_| rocks);
            if grid && shakes.is_none() {
                return None;
            }
            let parameter = shakes.unwrap_or(parameter);
            let known: Vec<(f64, bool)> = rows
                .iter()
                .filter_map(|r| {
                    let fails = failed(&header.plan.question, &r.answer)?;
                    Some((header.coordinate(r, parameter), fails))
                })
                .collect();
            let vary = header.plan.vary.get(parameter)?.clone();
            let along = vary.label().to_string();
            let places: Vec<f64> = known.iter().map(|k| k.0).collect();
            // Values of a grid were chosen one by one.
            let points = if grid { same(&places) } else { groups(&places) }
                .into_iter()
                .map(|group| {
                    let middle =
                        group.iter().map(|&i| known[i].0).sum::<f64>() / group.len() as f64;
                    (middle, wilson(group.iter().filter(|&&i| known[i].1).count(), group.len()))
                })
                .collect::<Vec<_>>();
            let fit = shakes.map(|_| LognormalFit::of_fates(&known));
            (points.len() >= 2).then(|| with_fit(along, Some(vary), points, fit))
        }
    }
}

fn with_fit(
    along: String,
    vary: Option<super::Vary>,
    points: Vec<(f64, Proportion)>,
    fit: Option<Result<LognormalFit, String>>,
) -> Fragility {
    let no_lognormal = fit.as_ref().and_then(|f| f.as_ref().err().cloned());
    let lognormal = fit.and_then(Result::ok);
    Fragility { along, vary, points, lognormal, no_lognormal }
}

fn against_demand(quantity: &str, rows: &[Row], fits: bool) -> Option<Fragility> {
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
    let fit = fits.then(|| match strengths.iter().all(|s| s.is_finite()) {
        true => LognormalFit::of_capacities(&strengths),
        false => {
            Err("some rows have no scale at which they overturn: their capacity is unknown".into())
        }
    });
    let points = (0..POINTS).map(|k| point(at(k))).collect();
    Some(with_fit(format!("demanded {quantity}"), None, points, fit))
}
