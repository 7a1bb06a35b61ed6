//! Which number matters most: the correlation ratio, the share of the variance of the answer that
//! one number explains by itself, whatever the form of the dependence (Pearson 1905; for
//! independent numbers the first-order index of Sobol' 1993).

use base::tolerance;
use serde::Serialize;

/// How much of the answer one number explains.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Influence {
    /// What the number is called.
    pub parameter: String,
    /// Its index in the plan.
    pub index: usize,
    /// Share of the variance between groups of rows with like values, less what chance gives; 0 to 1.
    pub share: f64,
}

/// At most so many groups, where a number takes more values than [`DISTINCT`].
const GROUPS: usize = 10;
/// Up to so many distinct values each is a group of its own.
const DISTINCT: usize = 40;

/// Indices of values grouped by like values, in rising order: one group a distinct value, or else
/// groups of nearly equal size.
pub fn groups(values: &[f64]) -> Vec<Vec<usize>> {
    let same = same(values);
    if same.len() <= DISTINCT {
        return same;
    }
    alike(&same.concat(), GROUPS)
}

/// Indices of equal values, in rising order.
pub fn same(values: &[f64]) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]).then(i.cmp(&j)));
    order.chunk_by(|&i, &j| values[i] == values[j]).map(<[usize]>::to_vec).collect()
}

/// An order cut into groups of nearly equal size.
fn alike(order: &[usize], groups: usize) -> Vec<Vec<usize>> {
    order.chunks(order.len().div_ceil(groups.max(1)).max(1)).map(<[usize]>::to_vec).collect()
}

/// The share of the variance of `answers` that a number with these `values` explains: η² corrected
/// for chance to `1 − (1 − η²)(n − 1)/(n − k)` (Kelley 1935), not below 0. Nothing where the
/// answers do not vary, or there are too few.
pub fn influence(values: &[f64], answers: &[f64]) -> Option<f64> {
    let n = answers.len();
    let mean = |list: &mut dyn Iterator<Item = f64>, count: usize| list.sum::<f64>() / count as f64;
    let all = mean(&mut answers.iter().copied(), n);
    let total: f64 = answers.iter().map(|a| (a - all).powi(2)).sum();
    let mut groups = groups(values);
    if groups.len() * 2 > n {
        // Hardly a group has two members to compare: fewer, larger ones.
        groups = alike(&groups.concat(), GROUPS.min(n / 3));
    }
    let spread = answers.iter().fold(0.0_f64, |m, a| m.max((a - all).abs()));
    // Answers that differ by their rounding alone do not vary.
    if n < 3
        || groups.len() < 2
        || groups.len() >= n
        || spread <= tolerance::SAME_ANSWER * all.abs()
        || total == 0.0
    {
        return None;
    }
    let within: f64 = groups
        .iter()
        .map(|g| {
            let own = mean(&mut g.iter().map(|&i| answers[i]), g.len());
            g.iter().map(|&i| (answers[i] - own).powi(2)).sum::<f64>()
        })
        .sum();
    Some((1.0 - within / total * (n - 1) as f64 / (n - groups.len()) as f64).max(0.0))
}
