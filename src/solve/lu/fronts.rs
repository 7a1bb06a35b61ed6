//! Complete factors of square matrices, front by front (Duff & Reid 1983): every front gathers its own
//! rows and what its children leave of theirs in one dense matrix, so that all work is products of dense
//! matrices.
//!
//! The order is that of symmetric matrices of the pattern, and pivots are chosen among the rows of a
//! front alone. Here and not from a library: `faer` takes no order of one's own for matrices that are
//! not symmetric, and the one that it finds costs three to seven times as much.

use super::super::Pattern;
use cholesky::{Front as Place, Tree, fronts};
use faer::{
    Accum, MatMut, Par,
    dyn_stack::{MemBuffer, MemStack},
    linalg::{
        lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch},
        matmul::matmul,
        triangular_solve::{solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place},
    },
    reborrow::{Reborrow, ReborrowMut},
};

/// Factors of matrices of one pattern.
pub struct Fronts {
    tree: Tree,
    /// Fronts in the order of elimination.
    order: Vec<usize>,
    factors: Vec<Front>,
}

/// The factors of one front.
struct Front {
    /// Its rows of the matrix, its own first.
    rows: Vec<usize>,
    /// Entries of the matrix in its own rows and columns, and where that of the lower triangle and its
    /// mirror image stand in `values`.
    entries: Vec<(usize, [usize; 2])>,
    /// Its own columns, and then, by columns of their own, its rows beyond them.
    values: Vec<f64>,
    /// Which of its rows is each pivot.
    pivots: Vec<usize>,
}

/// What a front leaves of the rows beyond its own, by columns.
struct Rest {
    of: usize,
    values: Vec<f64>,
}

impl Fronts {
    /// Prepares the pattern of a lower triangle, diagonal included; nothing where it is none, or does not
    /// fit into memory.
    pub fn new(pattern: &Pattern) -> Option<Self> {
        let (mut tree, rows) = fronts(pattern)?;
        let mut column_of = vec![0; pattern.rows.len()];
        (0..pattern.size())
            .for_each(|c| column_of[pattern.starts[c]..pattern.starts[c + 1]].fill(c));
        let mut factors = Vec::with_capacity(rows.len());
        for (front, rows) in tree.list.iter_mut().zip(rows) {
            let (width, size) = (front.width, front.size);
            let entries = std::mem::take(&mut front.entries).into_iter().map(|(e, at)| {
                let (row, column) = (at % size, at / size);
                let mirrored = match row.checked_sub(width) {
                    None => row * size + column,
                    Some(beyond) => (size + beyond) * width + column,
                };
                // In this order it may stand in the other triangle.
                let same = rows[column] == column_of[e];
                (e, if same { [at, mirrored] } else { [mirrored, at] })
            });
            let entries = entries.collect();
            let mut values = Vec::new();
            let count = width * (2 * size - width);
            values.try_reserve_exact(count).ok()?;
            values.resize(count, 0.0);
            factors.push(Front { rows, entries, values, pivots: vec![0; width] });
        }
        let alone = |s: usize| tree.piece[s].map(|piece| tree.pieces[piece].clone());
        let order = tree.above.iter().flat_map(|&s| alone(s).unwrap_or(vec![s])).collect();
        Some(Self { tree, order, factors })
    }

    /// Factors the matrix with these values of the lower triangle and, entry by entry, of its mirror image;
    /// false where a pivot is zero, or memory is short.
    pub fn factor(&mut self, lower: &[f64], upper: &[f64]) -> bool {
        let mut rests = Vec::new();
        (0..self.order.len())
            .all(|k| self.eliminate(self.order[k], lower, upper, &mut rests).is_some())
    }

    /// Eliminates a front: what its children left is last of `rests`, and what it leaves takes their place.
    fn eliminate(
        &mut self,
        s: usize,
        lower: &[f64],
        upper: &[f64],
        rests: &mut Vec<Rest>,
    ) -> Option<()> {
        let (front, factors) = (&self.tree.list[s], &mut self.factors[s]);
        let (width, size) = (front.width, front.size);
        let beyond = size - width;
        factors.values.fill(0.0);
        for &(e, [below, above]) in &factors.entries {
            factors.values[below] += lower[e];
            if above != below {
                factors.values[above] += upper[e];
            }
        }
        let (columns, across) = factors.values.split_at_mut(width * size);
        let mut rest = Vec::new();
        rest.try_reserve_exact(beyond * beyond).ok()?;
        rest.resize(beyond * beyond, 0.0);
        for child in rests.drain(rests.len() - front.children..) {
            let Place { into, size: all, width: own, .. } = &self.tree.list[child.of];
            let mut from = child.values.chunks_exact((all - own).max(1));
            for column in into.iter().flat_map(|run| run.to..run.to + run.count) {
                let (to_here, to_left) = match column.checked_sub(width) {
                    None => columns[column * size..(column + 1) * size].split_at_mut(width),
                    Some(k) => (
                        &mut across[k * width..(k + 1) * width],
                        &mut rest[k * beyond..(k + 1) * beyond],
                    ),
                };
                let from = from.next().unwrap_or_default();
                for run in into {
                    let to = match run.to.checked_sub(width) {
                        None => &mut to_here[run.to..],
                        Some(row) => &mut to_left[row..],
                    };
                    to.iter_mut()
                        .zip(&from[run.from..run.from + run.count])
                        .for_each(|(to, v)| *to += v);
                }
            }
        }
        let columns = MatMut::from_column_major_slice_mut(columns, size, width);
        let (mut own, mut under) = columns.split_at_row_mut(width);
        let mut inverse = vec![0; width];
        let mut work = MemBuffer::new(lu_in_place_scratch::<usize, f64>(
            width,
            width,
            Par::Seq,
            Default::default(),
        ));
        let stack = MemStack::new(&mut work);
        let pivots = &mut factors.pivots;
        lu_in_place(own.rb_mut(), pivots, &mut inverse, Par::Seq, stack, Default::default());
        let is_pivot = |k: usize| own[(k, k)].is_finite() && own[(k, k)] != 0.0;
        if !(0..width).all(is_pivot) {
            return None;
        }
        for column in across.chunks_exact_mut(width) {
            let before: Vec<f64> = pivots.iter().map(|&row| column[row]).collect();
            column.copy_from_slice(&before);
        }
        let mut across = MatMut::from_column_major_slice_mut(across, width, beyond);
        solve_unit_lower_triangular_in_place(own.rb(), across.rb_mut(), Par::Seq);
        solve_lower_triangular_in_place(
            own.rb().transpose(),
            under.rb_mut().transpose_mut(),
            Par::Seq,
        );
        let left = MatMut::from_column_major_slice_mut(&mut rest, beyond, beyond);
        matmul(left, Accum::Add, under.rb(), across.rb(), -1.0, Par::Seq);
        rests.push(Rest { of: s, values: rest });
        Some(())
    }

    /// Solves with the factors, in place.
    pub fn solve(&self, x: &mut [f64]) {
        let mut work = Vec::new();
        for &s in &self.order {
            let (front, width) = (&self.factors[s], self.tree.list[s].width);
            work.clear();
            work.extend(front.pivots.iter().map(|&row| x[front.rows[row]]));
            work.extend(front.rows[width..].iter().map(|&row| x[row]));
            for (k, column) in front.values.chunks_exact(work.len()).take(width).enumerate() {
                let (solved, others) = work.split_at_mut(k + 1);
                less(others, solved[k], &column[k + 1..]);
            }
            front.rows.iter().zip(&work).for_each(|(&row, v)| x[row] = *v);
        }
        for &s in self.order.iter().rev() {
            let (front, width) = (&self.factors[s], self.tree.list[s].width);
            let size = front.rows.len();
            work.clear();
            work.extend(front.rows[..width].iter().map(|&row| x[row]));
            let (columns, across) = front.values.split_at(width * size);
            for (&row, column) in front.rows[width..].iter().zip(across.chunks_exact(width)) {
                less(&mut work, x[row], column);
            }
            for (k, column) in columns.chunks_exact(size).enumerate().rev() {
                work[k] /= column[k];
                let (others, solved) = work.split_at_mut(k);
                less(others, solved[0], &column[..k]);
            }
            front.rows.iter().zip(&work).for_each(|(&row, v)| x[row] = *v);
        }
    }
}

fn less(to: &mut [f64], by: f64, column: &[f64]) {
    to.iter_mut().zip(column).for_each(|(to, v)| *to -= by * *v);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fronts::tests::lattice;

    #[test]
    fn what_was_multiplied_comes_back() {
        let (pattern, [lower, upper], [x, mut right]) = lattice();
        let mut fronts = Fronts::new(&pattern).unwrap();
        assert!(fronts.factor(&lower, &upper));
        fronts.solve(&mut right);
        for (a, b) in right.iter().zip(&x) {
            assert!((a - b).abs() < 1e-10, "{a} {b}");
        }
    }
}
