//! Square matrices in blocks of 6 × 6, their incomplete factors, and generalised minimal residuals
//! (Saad & Schultz 1986; Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithms 9.5 and
//! 10.4): for heaps in space, whose complete factors take minutes.

use super::Pattern;
use nalgebra::{Matrix6, Vector6};
use std::ops::Range;

/// Directions that are kept before the method starts again. More: memory. Fewer: slow convergence.
const KEPT: usize = 80;

/// A matrix by rows of blocks, columns ascending.
#[derive(Clone, Debug)]
pub struct Blocks {
    pub(super) starts: Vec<usize>,
    pub(super) columns: Vec<usize>,
    pub(super) values: Vec<Matrix6<f64>>,
}

/// Factors that solve a matrix nearly.
pub trait Factors {
    /// Solves with the factors, in place.
    fn solve(&self, x: &mut [Vector6<f64>]);
}

/// Incomplete factors on the pattern of the matrix.
#[derive(Debug)]
pub struct Incomplete {
    factors: Blocks,
    /// Where the diagonal block of each row stands; it is inverted.
    diagonal: Vec<usize>,
}

impl Blocks {
    /// A matrix of whole blocks by the pattern of its lower triangle, the values there, and those of its
    /// mirror image.
    pub fn new(pattern: &Pattern, lower: &[f64], upper: &[f64]) -> Self {
        let n = pattern.size() / 6;
        // Of each block column the rows of its blocks, the diagonal one first.
        let below: Vec<Vec<usize>> = (0..n)
            .map(|k| {
                let mut rows: Vec<usize> = pattern.rows
                    [pattern.starts[6 * k]..pattern.starts[6 * k + 1]]
                    .iter()
                    .map(|r| r / 6)
                    .collect();
                rows.dedup();
                rows
            })
            .collect();
        // One sweep by ascending column leaves the columns of every row in order.
        let mut rows: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (k, below) in below.iter().enumerate() {
            for &row in below {
                rows[row].push(k);
                if row != k {
                    rows[k].push(row);
                }
            }
        }
        let mut all = Self { starts: vec![0], columns: Vec::new(), values: Vec::new() };
        for row in rows {
            all.columns.extend(row);
            all.starts.push(all.columns.len());
        }
        all.values = vec![Matrix6::zeros(); all.columns.len()];
        for column in 0..pattern.size() {
            let k = column / 6;
            let (mut block, mut places) = (usize::MAX, [0; 2]);
            for e in pattern.starts[column]..pattern.starts[column + 1] {
                let row = pattern.rows[e];
                if row / 6 != block {
                    block = row / 6;
                    places = [all.place(block, k), all.place(k, block)];
                }
                all.values[places[0]][(row % 6, column % 6)] = lower[e];
                all.values[places[1]][(column % 6, row % 6)] = upper[e];
            }
        }
        all
    }

    pub(super) fn place(&self, row: usize, column: usize) -> usize {
        let range = self.row(row);
        range.start + self.columns[range].partition_point(|&c| c < column)
    }

    fn row(&self, i: usize) -> Range<usize> {
        self.starts[i]..self.starts[i + 1]
    }

    fn times(&self, x: &[Vector6<f64>]) -> Vec<Vector6<f64>> {
        let row = |i| self.row(i).map(|e| self.values[e] * x[self.columns[e]]).sum();
        (0..x.len()).map(row).collect()
    }

    /// Incomplete factors; nothing where a pivot is singular.
    pub fn incomplete(&self) -> Option<Incomplete> {
        let mut f = self.clone();
        let n = f.starts.len() - 1;
        let mut diagonal = vec![0; n];
        let mut place = vec![None; n];
        for i in 0..n {
            f.row(i).for_each(|e| place[f.columns[e]] = Some(e));
            diagonal[i] = place[i]?;
            for e in f.starts[i]..diagonal[i] {
                let k = f.columns[e];
                let factor = f.values[e] * f.values[diagonal[k]];
                f.values[e] = factor;
                for m in diagonal[k] + 1..f.starts[k + 1] {
                    if let Some(at) = place[f.columns[m]] {
                        let less = factor * f.values[m];
                        f.values[at] -= less;
                    }
                }
            }
            f.row(i).for_each(|e| place[f.columns[e]] = None);
            f.values[diagonal[i]] = f.values[diagonal[i]].try_inverse()?;
        }
        Some(Incomplete { factors: f, diagonal })
    }

    /// Solves `A x = right` until this share of `right` is left, by no more than `most` products;
    /// nothing where that is not enough.
    pub fn solve(
        &self,
        factors: &dyn Factors,
        right: &[Vector6<f64>],
        share: f64,
        most: usize,
    ) -> Option<Vec<Vector6<f64>>> {
        let enough = share * norm(right);
        let mut x = vec![Vector6::zeros(); right.len()];
        let mut left = right.to_vec();
        let mut products = 0;
        while norm(&left) > enough {
            if products >= most {
                return None;
            }
            let more = self.cycle(factors, &left, enough, most - products)?;
            products += more.1;
            x.iter_mut().zip(&more.0).for_each(|(x, d)| *x += d);
            left = right.iter().zip(self.times(&x)).map(|(b, a)| b - a).collect();
            products += 1;
        }
        Some(x)
    }

    /// One round: what to add, and how many products it took.
    fn cycle(
        &self,
        factors: &dyn Factors,
        left: &[Vector6<f64>],
        enough: f64,
        most: usize,
    ) -> Option<(Vec<Vector6<f64>>, usize)> {
        let size = norm(left);
        let mut basis: Vec<Vec<Vector6<f64>>> = vec![left.iter().map(|v| v / size).collect()];
        let mut ways: Vec<Vec<Vector6<f64>>> = Vec::new();
        // The triangle that rotations make of the small matrix, column by column, and its right side.
        let mut triangle: Vec<Vec<f64>> = Vec::new();
        let mut turns: Vec<[f64; 2]> = Vec::new();
        let mut sides = vec![size];
        while ways.len() < KEPT.min(most) {
            let k = ways.len();
            let mut way = basis[k].clone();
            factors.solve(&mut way);
            let mut next = self.times(&way);
            let mut column = Vec::with_capacity(k + 2);
            for v in &basis {
                let h = dot(v, &next);
                next.iter_mut().zip(v).for_each(|(w, v)| *w -= v * h);
                column.push(h);
            }
            let rest = norm(&next);
            for (j, [c, s]) in turns.iter().enumerate() {
                let (a, b) = (column[j], column[j + 1]);
                column[j] = c * a + s * b;
                column[j + 1] = c * b - s * a;
            }
            let h = column[k].hypot(rest);
            if !(h.is_finite() && h > 0.0) {
                return None;
            }
            let [c, s] = [column[k] / h, rest / h];
            column[k] = h;
            triangle.push(column);
            turns.push([c, s]);
            ways.push(way);
            sides.push(-s * sides[k]);
            sides[k] *= c;
            if sides[k + 1].abs() <= enough || rest == 0.0 {
                break;
            }
            basis.push(next.iter().map(|v| v / rest).collect());
        }
        let k = ways.len();
        let mut shares = vec![0.0; k];
        for i in (0..k).rev() {
            let sum: f64 = (i + 1..k).map(|j| triangle[j][i] * shares[j]).sum();
            shares[i] = (sides[i] - sum) / triangle[i][i];
        }
        let mut x = vec![Vector6::zeros(); left.len()];
        for (way, share) in ways.iter().zip(&shares) {
            x.iter_mut().zip(way).for_each(|(x, d)| *x += d * *share);
        }
        Some((x, k))
    }
}

impl Factors for Incomplete {
    fn solve(&self, x: &mut [Vector6<f64>]) {
        let f = &self.factors;
        for i in 0..x.len() {
            let less: Vector6<f64> =
                (f.starts[i]..self.diagonal[i]).map(|e| f.values[e] * x[f.columns[e]]).sum();
            x[i] -= less;
        }
        for i in (0..x.len()).rev() {
            let above = self.diagonal[i] + 1..f.starts[i + 1];
            let less: Vector6<f64> = above.map(|e| f.values[e] * x[f.columns[e]]).sum();
            x[i] = f.values[self.diagonal[i]] * (x[i] - less);
        }
    }
}

fn dot(a: &[Vector6<f64>], b: &[Vector6<f64>]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x.dot(y)).sum()
}

fn norm(a: &[Vector6<f64>]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of blocks, unsymmetric: what was multiplied comes back, and nothing where too few products
    /// are allowed.
    #[test]
    fn what_was_multiplied_comes_back() {
        let n = 40;
        let mut pattern = Pattern { starts: vec![0], rows: Vec::new() };
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for k in 0..n {
            for c in 0..6 {
                let others = [k + 1, k + 7].into_iter().filter(|o| *o < n);
                let rows = (6 * k + c..6 * k + 6).chain(others.flat_map(|o| 6 * o..6 * o + 6));
                for row in rows {
                    let column = 6 * k + c;
                    let value = ((row * 7 + column * 3) % 11) as f64 / 30.0;
                    let own = row == column;
                    pattern.rows.push(row);
                    lower.push(if own { 9.0 } else { -value });
                    upper.push(if own { 9.0 } else { 0.5 * value });
                }
                pattern.starts.push(pattern.rows.len());
            }
        }
        let matrix = Blocks::new(&pattern, &lower, &upper);
        let x: Vec<Vector6<f64>> =
            (0..n).map(|i| Vector6::from_fn(|k, _| ((i * 6 + k) % 13) as f64 - 6.0)).collect();
        // By the entries themselves.
        let mut right = vec![Vector6::zeros(); n];
        for column in 0..6 * n {
            for e in pattern.starts[column]..pattern.starts[column + 1] {
                let row = pattern.rows[e];
                right[row / 6][row % 6] += lower[e] * x[column / 6][column % 6];
                if row != column {
                    right[column / 6][column % 6] += upper[e] * x[row / 6][row % 6];
                }
            }
        }
        let factors = matrix.incomplete().unwrap();
        let got = matrix.solve(&factors, &right, 1e-12, 100).unwrap();
        for (a, b) in got.iter().zip(&x) {
            assert!((a - b).norm() < 1e-9, "{a} {b}");
        }
        assert!(matrix.solve(&factors, &right, 1e-12, 2).is_none());
    }
}
