//! Values of a sweep by one or two of its numbers: what charts draw. Every row is in it, those
//! without a value too.

use analysis::Question;
use sweep::{Sampling, Shown, groups, same};

/// The rows whose number is alike, or whose two numbers are.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Group {
    /// Mean of the number; of two the middle of the cell.
    pub at: [f64; 2],
    /// Half the width and height of the cell of two numbers.
    pub half: [f64; 2],
    /// Their mean where every one of them has a value; else what the gravest of them shows.
    pub shown: Shown,
    /// The least and the greatest value, where every one of them has one.
    pub ends: [f64; 2],
    /// Rows in it.
    pub rows: usize,
    /// Rows in it without a value.
    pub without: usize,
}

impl Group {
    fn of(at: [f64; 2], half: [f64; 2], rows: &[Shown]) -> Self {
        let values: Vec<f64> = rows.iter().filter_map(|s| s.value()).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let gravest = rows.iter().copied().reduce(Shown::graver);
        let shown = match gravest {
            Some(Shown::Value(_)) => Shown::Value(mean),
            Some(other) => other,
            None => Shown::Undecided,
        };
        let (low, high) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        let without = rows.len() - values.len();
        Self { at, half, shown, ends: [low, high], rows: rows.len(), without }
    }
}

/// Groups of rows with like values of one number; in a grid, whose values were chosen one by one,
/// with equal ones.
pub(crate) fn bands(xs: &[f64], shown: &[Shown], sampling: &Sampling) -> Vec<Group> {
    let is_grid = matches!(sampling, Sampling::Grid {});
    let groups = if is_grid { same(xs) } else { groups(xs) };
    groups
        .iter()
        .map(|group| {
            let mean = group.iter().map(|&i| xs[i]).sum::<f64>() / group.len() as f64;
            let rows: Vec<Shown> = group.iter().map(|&i| shown[i]).collect();
            Group::of([mean, 0.0], [0.0; 2], &rows)
        })
        .collect()
}

/// The cell borders along one axis: halfway between group means, as far outside at both ends.
fn borders(xs: &[f64], groups: &[Vec<usize>]) -> Vec<f64> {
    let means: Vec<f64> =
        groups.iter().map(|g| g.iter().map(|&i| xs[i]).sum::<f64>() / g.len() as f64).collect();
    let between: Vec<f64> = means.windows(2).map(|w| (w[0] + w[1]) / 2.0).collect();
    let (Some(first), Some(last)) = (means.first(), means.last()) else { return Vec::new() };
    let (low, high) = match (between.first(), between.last()) {
        (Some(a), Some(b)) => (2.0 * first - a, 2.0 * last - b),
        _ => (first - 0.5, last + 0.5),
    };
    [low].into_iter().chain(between).chain([high]).collect()
}

/// The cells that hold a row, column by column.
pub(crate) fn cells(xs: &[f64], ys: &[f64], shown: &[Shown]) -> Vec<Group> {
    let (columns, lines) = (groups(xs), groups(ys));
    let (bx, by) = (borders(xs, &columns), borders(ys, &lines));
    let place = |groups: &[Vec<usize>]| {
        let mut at = vec![0; shown.len()];
        groups.iter().enumerate().for_each(|(g, list)| list.iter().for_each(|&i| at[i] = g));
        at
    };
    let (px, py) = (place(&columns), place(&lines));
    let mut there = vec![Vec::new(); columns.len() * lines.len()];
    for (i, row) in shown.iter().enumerate() {
        there[px[i] * lines.len() + py[i]].push(*row);
    }
    there
        .iter()
        .enumerate()
        .filter(|(_, rows)| !rows.is_empty())
        .map(|(k, rows)| {
            let (cx, cy) = (k / lines.len(), k % lines.len());
            let (x, y) = ([bx[cx], bx[cx + 1]], [by[cy], by[cy + 1]]);
            let middle = |e: [f64; 2]| 0.5 * (e[0] + e[1]);
            let half = |e: [f64; 2]| 0.5 * (e[1] - e[0]);
            Group::of([middle(x), middle(y)], [half(x), half(y)], rows)
        })
        .collect()
}

/// What rows without a value are called, and the colour they have (red, green, blue).
pub(crate) fn mark(question: &Question, shown: Shown) -> Option<(&'static str, [u8; 3])> {
    match shown {
        Shown::Value(_) => None,
        Shown::Falls => Some(("falls", [200, 30, 45])),
        Shown::Error => Some(("error", [0, 0, 0])),
        Shown::Undecided => Some(("undecided", [150, 150, 150])),
        Shown::Unlimited => {
            let throughout = matches!(question, Question::Critical(_));
            Some((if throughout { "stands" } else { "no limit" }, [150, 205, 240]))
        }
    }
}

/// The marks that occur, the gravest first, each with how many rows show it by themselves.
pub(crate) fn marks(rows: &[Shown]) -> Vec<(Shown, usize)> {
    [Shown::Falls, Shown::Error, Shown::Undecided, Shown::Unlimited]
        .into_iter()
        .map(|kind| (kind, rows.iter().filter(|s| **s == kind).count()))
        .filter(|(_, n)| *n > 0)
        .collect()
}
