//! Equality rows of the local variables in dense panels: the forces of neighbouring contacts act on
//! the same two blocks.

use super::columns::{Block, Columns};
use std::ops::Range;

/// Blocks of variables on the same equality rows.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    /// Blocks `first..last`.
    pub blocks: Range<usize>,
    /// Their variables.
    pub variables: Range<usize>,
    /// Where its rows are in [`Panels::rows`].
    at: Range<usize>,
    /// Where its values are.
    values: Range<usize>,
}

/// A matrix made of panels.
#[derive(Clone, Debug)]
pub(super) struct Panels {
    /// In the order of the variables, without gaps.
    pub list: Vec<Panel>,
    rows: Vec<usize>,
    /// Column by column of each panel.
    values: Vec<f64>,
}

/// Calls `$f` made for the number of rows where it is a usual one (contacts with the ground and
/// between blocks, in a plane and in space), and for any number, 0, otherwise.
macro_rules! by_rows {
    ($rows:expr, $f:ident($($argument:expr),*)) => {
        match $rows {
            3 => $f::<3>($($argument),*),
            6 => $f::<6>($($argument),*),
            12 => $f::<12>($($argument),*),
            _ => $f::<0>($($argument),*),
        }
    };
}
pub(super) use by_rows;

impl Panels {
    /// From the equality rows of each variable.
    pub fn new(blocks: &[Block], columns: &Columns) -> Self {
        let mut groups: Vec<(Range<usize>, Vec<usize>)> = Vec::new();
        for (index, block) in blocks.iter().enumerate() {
            let mut own: Vec<usize> =
                block.variables.clone().flat_map(|j| columns.of(j).map(|(i, _)| i)).collect();
            own.sort_unstable();
            own.dedup();
            match groups.last_mut() {
                Some((blocks, rows)) if own.iter().all(|i| rows.binary_search(i).is_ok()) => {
                    blocks.end = index + 1
                }
                Some((blocks, rows)) if rows.iter().all(|i| own.binary_search(i).is_ok()) => {
                    (blocks.end, *rows) = (index + 1, own)
                }
                _ => groups.push((index..index + 1, own)),
            }
        }
        let mut this =
            Self { list: Vec::with_capacity(groups.len()), rows: Vec::new(), values: Vec::new() };
        for (group, rows) in groups {
            let variables =
                blocks[group.start].variables.start..blocks[group.end - 1].variables.end;
            let (at, first) = (this.rows.len(), this.values.len());
            this.values.resize(first + rows.len() * variables.len(), 0.0);
            for (column, j) in
                this.values[first..].chunks_exact_mut(rows.len().max(1)).zip(variables.clone())
            {
                columns.of(j).for_each(|(i, v)| column[rows.partition_point(|&r| r < i)] += v);
            }
            this.rows.extend(rows);
            this.list.push(Panel {
                blocks: group,
                variables,
                at: at..this.rows.len(),
                values: first..this.values.len(),
            });
        }
        this
    }

    /// The rows of a panel, ascending.
    pub fn rows(&self, panel: &Panel) -> &[usize] {
        &self.rows[panel.at.clone()]
    }

    /// The values of a panel, column by column.
    pub fn values(&self, panel: &Panel) -> &[f64] {
        &self.values[panel.values.clone()]
    }

    /// `y += sign · M x`.
    pub fn add(&self, sign: f64, x: &[f64], y: &mut [f64]) {
        for panel in &self.list {
            let (rows, values, x) =
                (self.rows(panel), self.values(panel), &x[panel.variables.clone()]);
            by_rows!(rows.len(), combine(rows, values, sign, x, y));
        }
    }

    /// `x += sign · Mᵀ y`.
    pub fn add_transposed(&self, sign: f64, y: &[f64], x: &mut [f64]) {
        for panel in &self.list {
            let (rows, values, x) =
                (self.rows(panel), self.values(panel), &mut x[panel.variables.clone()]);
            by_rows!(rows.len(), project(rows, values, sign, y, x));
        }
    }
}

/// `y += sign · M x` of one panel.
fn combine<const R: usize>(rows: &[usize], values: &[f64], sign: f64, x: &[f64], y: &mut [f64]) {
    if R == 0 {
        for (column, x) in values.chunks_exact(rows.len().max(1)).zip(x) {
            rows.iter().zip(column).for_each(|(&i, v)| y[i] += sign * v * x);
        }
        return;
    }
    let mut sum = [0.0; R];
    for (column, x) in values.as_chunks::<R>().0.iter().zip(x) {
        sum.iter_mut().zip(column).for_each(|(s, v)| *s += v * x);
    }
    rows.iter().zip(sum).for_each(|(&i, s)| y[i] += sign * s);
}

/// `x += sign · Mᵀ y` of one panel.
fn project<const R: usize>(rows: &[usize], values: &[f64], sign: f64, y: &[f64], x: &mut [f64]) {
    if R == 0 {
        for (column, x) in values.chunks_exact(rows.len().max(1)).zip(x) {
            *x += sign * rows.iter().zip(column).map(|(&i, v)| v * y[i]).sum::<f64>();
        }
        return;
    }
    let mut own = [0.0; R];
    own.iter_mut().zip(rows).for_each(|(own, &i)| *own = sign * y[i]);
    for (column, x) in values.as_chunks::<R>().0.iter().zip(x) {
        *x += column.iter().zip(&own).map(|(v, y)| v * y).sum::<f64>();
    }
}
