//! Values of a sweep by one or two of its numbers: what charts draw.

use crate::sweep::groups;

/// The mean of the rows whose two numbers are alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::report) struct Cell {
    /// Its ends along the first number.
    pub x: [f64; 2],
    /// Its ends along the second.
    pub y: [f64; 2],
    /// The mean value.
    pub mean: f64,
    /// Rows in it.
    pub rows: usize,
}

/// Groups of rows with like values of one number: mean of the number, least, mean and greatest
/// value.
pub(in crate::report) fn bands(xs: &[f64], values: &[f64]) -> Vec<[f64; 4]> {
    groups(xs)
        .iter()
        .map(|group| {
            let n = group.len() as f64;
            let mean = |of: &[f64]| group.iter().map(|&i| of[i]).sum::<f64>() / n;
            let (low, high) =
                group.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &i| {
                    (l.min(values[i]), h.max(values[i]))
                });
            [mean(xs), low, mean(values), high]
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
pub(in crate::report) fn cells(xs: &[f64], ys: &[f64], values: &[f64]) -> Vec<Cell> {
    let (columns, lines) = (groups(xs), groups(ys));
    let (bx, by) = (borders(xs, &columns), borders(ys, &lines));
    let place = |groups: &[Vec<usize>]| {
        let mut at = vec![0; values.len()];
        groups.iter().enumerate().for_each(|(g, list)| list.iter().for_each(|&i| at[i] = g));
        at
    };
    let (px, py) = (place(&columns), place(&lines));
    let mut sums = vec![(0.0, 0_usize); columns.len() * lines.len()];
    for (i, value) in values.iter().enumerate() {
        let cell = &mut sums[px[i] * lines.len() + py[i]];
        *cell = (cell.0 + value, cell.1 + 1);
    }
    let there = sums.into_iter().enumerate().filter(|(_, (_, rows))| *rows > 0);
    there
        .map(|(k, (sum, rows))| {
            let (cx, cy) = (k / lines.len(), k % lines.len());
            Cell { x: [bx[cx], bx[cx + 1]], y: [by[cy], by[cy + 1]], mean: sum / rows as f64, rows }
        })
        .collect()
}
