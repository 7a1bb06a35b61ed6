//! Equations in blocks of six rows, solved step by step: for contacts in space, whose direct factors
//! fill up.
//!
//! Stabilised bi-conjugate gradients (van der Vorst 1992), preconditioned by an incomplete
//! factorisation on the pattern of the matrix itself, block by block (Saad 2003, chapter 10). Memory
//! and time of a step go with the number of contacts. One thread, so that the same equations always
//! have the same solution.

use nalgebra::{Matrix6, Vector6};

/// The pattern of a matrix of blocks: row by row, columns ascending, the diagonal among them.
pub struct Blocks {
    starts: Vec<usize>,
    columns: Vec<usize>,
    /// Where the diagonal stands in each row.
    diagonal: Vec<usize>,
}

/// The matrix in incomplete factors: lower ones without their unit diagonal, upper ones with the
/// inverse of theirs beside them.
struct Factors {
    values: Vec<Matrix6<f64>>,
    inverse: Vec<Matrix6<f64>>,
}

type Vectors = [Vector6<f64>];

impl Blocks {
    /// Rows as lists of columns, ascending; nothing where one lacks its diagonal.
    pub fn new(rows: &[Vec<usize>]) -> Option<Self> {
        let mut all = Self { starts: vec![0], columns: Vec::new(), diagonal: Vec::new() };
        for (k, row) in rows.iter().enumerate() {
            if !row.windows(2).all(|w| w[0] < w[1]) || row.last().is_some_and(|&c| c >= rows.len())
            {
                return None;
            }
            all.diagonal.push(all.columns.len() + row.binary_search(&k).ok()?);
            all.columns.extend(row);
            all.starts.push(all.columns.len());
        }
        Some(all)
    }

    /// Solves for one right-hand side, to what is left of it over its size, in at most so many steps;
    /// with the solution, what is left. Nothing where the factors do not exist.
    pub fn solve(
        &self,
        values: &[Matrix6<f64>],
        right: &Vectors,
        to: f64,
        steps: usize,
    ) -> Option<(Vec<Vector6<f64>>, f64)> {
        let factors = self.factors(values)?;
        let size = dot(right, right).sqrt();
        let mut x = vec![Vector6::zeros(); right.len()];
        if size == 0.0 {
            return Some((x, 0.0));
        }
        let mut best = (x.clone(), 1.0);
        let mut left = right.to_vec();
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        let mut v = x.clone();
        let mut p = x.clone();
        for _ in 0..steps {
            let next = dot(right, &left);
            let beta = next / rho * (alpha / omega);
            rho = next;
            for ((p, r), v) in p.iter_mut().zip(&left).zip(&v) {
                *p = r + (*p - v * omega) * beta;
            }
            let y = self.apply(&factors, &p);
            v = self.times(values, &y);
            alpha = rho / dot(right, &v);
            add(&mut x, alpha, &y);
            add(&mut left, -alpha, &v);
            let z = self.apply(&factors, &left);
            let t = self.times(values, &z);
            omega = dot(&t, &left) / dot(&t, &t);
            add(&mut x, omega, &z);
            add(&mut left, -omega, &t);
            let now = dot(&left, &left).sqrt() / size;
            if !now.is_finite() {
                break;
            }
            if now < best.1 {
                best = (x.clone(), now);
            }
            if now <= to {
                break;
            }
        }
        Some(best)
    }

    fn row(&self, k: usize) -> std::ops::Range<usize> {
        self.starts[k]..self.starts[k + 1]
    }

    fn times(&self, values: &[Matrix6<f64>], x: &Vectors) -> Vec<Vector6<f64>> {
        let row = |k| self.row(k).map(|e| values[e] * x[self.columns[e]]).sum();
        (0..x.len()).map(row).collect()
    }

    fn factors(&self, values: &[Matrix6<f64>]) -> Option<Factors> {
        let mut all = Factors { values: values.to_vec(), inverse: Vec::new() };
        for k in 0..self.diagonal.len() {
            for e in self.starts[k]..self.diagonal[k] {
                let j = self.columns[e];
                let factor = all.values[e] * all.inverse[j];
                all.values[e] = factor;
                // Of row j what lies in the pattern of this one.
                let mut here = e + 1;
                for there in self.diagonal[j] + 1..self.starts[j + 1] {
                    let column = self.columns[there];
                    while here < self.starts[k + 1] && self.columns[here] < column {
                        here += 1;
                    }
                    if here < self.starts[k + 1] && self.columns[here] == column {
                        let less = factor * all.values[there];
                        all.values[here] -= less;
                    }
                }
            }
            let inverse = all.values[self.diagonal[k]].try_inverse()?;
            all.inverse.push(inverse);
        }
        Some(all)
    }

    fn apply(&self, factors: &Factors, x: &Vectors) -> Vec<Vector6<f64>> {
        let mut y = x.to_vec();
        for k in 0..y.len() {
            let below = self.starts[k]..self.diagonal[k];
            let less: Vector6<f64> = below.map(|e| factors.values[e] * y[self.columns[e]]).sum();
            y[k] -= less;
        }
        for k in (0..y.len()).rev() {
            let above = self.diagonal[k] + 1..self.starts[k + 1];
            let less: Vector6<f64> = above.map(|e| factors.values[e] * y[self.columns[e]]).sum();
            y[k] = factors.inverse[k] * (y[k] - less);
        }
        y
    }
}

fn dot(a: &Vectors, b: &Vectors) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}

fn add(x: &mut Vectors, by: f64, y: &Vectors) {
    x.iter_mut().zip(y).for_each(|(x, y)| *x += y * by);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of blocks with a ring, unsymmetric, against what was multiplied.
    #[test]
    fn what_was_multiplied_comes_back() {
        let n = 40;
        let rows: Vec<Vec<usize>> = (0..n)
            .map(|k| {
                let mut row = vec![k, (k + 1) % n, (k + n - 1) % n, (k + 7) % n];
                row.sort_unstable();
                row.dedup();
                row
            })
            .collect();
        let blocks = Blocks::new(&rows).unwrap();
        let mut seed = 0.37_f64;
        let mut next = || {
            seed = (seed * 997.0 + 0.618_033_988_749_895).fract();
            seed - 0.5
        };
        let values: Vec<Matrix6<f64>> = rows
            .iter()
            .enumerate()
            .flat_map(|(k, row)| row.iter().map(move |&c| (k, c)))
            .map(|(k, c)| {
                let noise = Matrix6::from_fn(|_, _| next());
                if k == c { Matrix6::identity() * 9.0 + noise } else { noise }
            })
            .collect();
        let want: Vec<Vector6<f64>> = (0..n).map(|_| Vector6::from_fn(|_, _| next())).collect();
        let right = blocks.times(&values, &want);
        let (x, left) = blocks.solve(&values, &right, 1e-12, 200).unwrap();
        assert!(left <= 1e-12);
        assert!(x.iter().zip(&want).all(|(a, b)| (a - b).norm() < 1e-10));
    }

    #[test]
    fn what_has_no_factors_is_refused() {
        assert!(Blocks::new(&[vec![1], vec![0, 1]]).is_none());
        assert!(Blocks::new(&[vec![1, 0], vec![0, 1]]).is_none());
        assert!(Blocks::new(&[vec![0, 2], vec![1]]).is_none());
        let one = Blocks::new(&[vec![0]]).unwrap();
        assert!(one.solve(&[Matrix6::zeros()], &[Vector6::repeat(1.0)], 1e-9, 9).is_none());
    }
}
