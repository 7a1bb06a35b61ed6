//! Frequencies of small motion about a state, contacts as they are: what is open stays open, what
//! presses and sticks goes on, what slides slides on without any stiffness along its joint.
//!
//! `K x = ω² M x` with the tangent of the joints (made symmetric) and the masses and inertias of the
//! blocks. Small models by a dense decomposition, large ones by subspace iteration with a shift
//! (Bathe & Wilson 1972). Second-order effects, the work of gravity on the motion among them, are
//! left out.

use super::{law::Friction, state::ElasticState, system::System};
use crate::verdict::Rate;
use cholesky::{Cholesky, Pattern};
use nalgebra::{DMatrix, DVector, Matrix6, SymmetricEigen};
use std::collections::BTreeMap;

/// So many are given at most.
pub const COUNT: usize = 12;
/// Up to so many unknowns all are computed at once. More: seconds. Fewer: the iteration is used
/// where it is not needed.
const DENSE: usize = 300;
/// Structures of more unknowns have none. More: minutes, and gigabytes of heaps in space.
const MOST: usize = 12_000;
/// And structures whose factor has more entries: heaps in space, of which so many motions are nearly
/// equally fast that the iteration does not settle. More: minutes for nothing.
const FILL: usize = 2_000_000;
/// Vectors of the iteration beside those that are given.
const SPARE: usize = 8;
/// Most rounds of it.
const ROUNDS: usize = 200;
/// Squares of frequencies that change by less have settled.
const SETTLED: f64 = 1e-12;
/// Squares of frequencies below this share of the greatest are motions that nothing resists.
const FREE: f64 = 1e-12;

/// The lowest frequencies, Hz, ascending; 0 of motions that nothing resists. None where a large
/// structure did not settle, or is too large.
///
/// Structures that do not touch are decomposed by themselves: what is rounding beside a stiff one
/// is a frequency of a soft one.
pub fn frequencies(system: &System, state: &ElasticState, displaced: &[Rate]) -> Vec<f64> {
    let tangent = system.tangent(state, displaced, 0.0, Friction::Stays);
    let [lower, upper] = system.values(&tangent, &vec![1.0; 6 * system.free.len()], 0.0);
    let values: Vec<f64> = lower.iter().zip(&upper).map(|(l, u)| 0.5 * (l + u)).collect();
    let masses = system.masses();
    let mut parts: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (row, part) in system.parts().into_iter().enumerate() {
        parts.entry(part).or_default().push(row);
    }
    let mut squares = Vec::new();
    for rows in parts.values() {
        let piece = Piece::new(system, &values, &masses, rows);
        let own = match piece.size() {
            0..=DENSE => piece.dense(),
            n if n <= MOST => piece.iterated(),
            _ => None,
        };
        match own {
            Some(own) => squares.extend(own),
            None => return Vec::new(),
        }
    }
    squares.sort_by(f64::total_cmp);
    let hertz = |square: f64| square.max(0.0).sqrt() / std::f64::consts::TAU;
    squares.into_iter().take(COUNT).map(hertz).collect()
}

/// Stiffness and masses of a structure.
struct Piece {
    pattern: Pattern,
    /// The lower triangle of the stiffness.
    values: Vec<f64>,
    masses: Vec<Matrix6<f64>>,
}

impl Piece {
    /// That of some free blocks, by their rows, which nothing joins with others.
    fn new(system: &System, values: &[f64], masses: &[Matrix6<f64>], rows: &[usize]) -> Self {
        let whole = &system.pattern;
        let place = |r: usize| 6 * rows.partition_point(|&row| row < r / 6) + r % 6;
        let mut piece = Self {
            pattern: Pattern { starts: vec![0], rows: Vec::new() },
            values: Vec::new(),
            masses: rows.iter().map(|&row| masses[row]).collect(),
        };
        for column in rows.iter().flat_map(|row| 6 * row..6 * row + 6) {
            let entries = whole.starts[column]..whole.starts[column + 1];
            piece.values.extend_from_slice(&values[entries.clone()]);
            piece.pattern.rows.extend(whole.rows[entries].iter().map(|&r| place(r)));
            piece.pattern.starts.push(piece.pattern.rows.len());
        }
        piece
    }

    /// Unknowns.
    fn size(&self) -> usize {
        6 * self.masses.len()
    }

    fn dense(&self) -> Option<Vec<f64>> {
        let n = self.size();
        let mut k = DMatrix::zeros(n, n);
        for c in 0..n {
            for e in self.pattern.starts[c]..self.pattern.starts[c + 1] {
                let r = self.pattern.rows[e];
                (k[(r, c)], k[(c, r)]) = (self.values[e], self.values[e]);
            }
        }
        let mut root = DMatrix::zeros(n, n);
        for (b, m) in self.masses.iter().enumerate() {
            let inverse = m.cholesky()?.l().try_inverse()?;
            root.view_mut((6 * b, 6 * b), (6, 6)).copy_from(&inverse);
        }
        Some(ascending(SymmetricEigen::new(&root * k * root.transpose()).eigenvalues))
    }

    fn iterated(&self) -> Option<Vec<f64>> {
        let Self { pattern, masses, .. } = self;
        let n = self.size();
        // A shift well below what matters, so that free motions have no zero pivot.
        let stiffness = |column: usize| self.values[pattern.starts[column]];
        let ratio = masses.iter().enumerate().map(|(b, m)| stiffness(6 * b) / m[(0, 0)]);
        let shift = 1e-8 * ratio.fold(0.0, f64::max);
        let mut values = self.values.clone();
        for (b, m) in masses.iter().enumerate() {
            for c in 0..6 {
                // A column begins with what is left of its block's own.
                let start = pattern.starts[6 * b + c];
                (c..6).for_each(|r| values[start + r - c] += shift * m[(r, c)]);
            }
        }
        let mut factors = Cholesky::new(pattern.clone())?;
        if factors.fill() > FILL || !factors.factorize(&values) {
            return None;
        }
        let times = |x: &DMatrix<f64>| {
            let mut y = DMatrix::zeros(n, x.ncols());
            for (b, m) in masses.iter().enumerate() {
                y.rows_mut(6 * b, 6).copy_from(&(m * x.rows(6 * b, 6)));
            }
            y
        };
        let width = (COUNT + SPARE).min(n);
        // Vectors that have nothing to do with the scene: a fixed sequence.
        let mut seed = 0.5_f64;
        let mut x = DMatrix::from_fn(n, width, |_, _| {
            seed = (seed * 997.0 + 0.618_033_988_749_895).fract();
            seed - 0.5
        });
        let mut before = vec![f64::INFINITY; COUNT];
        for _ in 0..ROUNDS {
            let right = times(&x);
            let mut next = right.clone();
            for mut column in next.column_iter_mut() {
                factors.solve(column.as_mut_slice());
            }
            // Rayleigh and Ritz: K next = right.
            let small = next.transpose() * &right;
            let mass = next.transpose() * times(&next);
            let root = mass.cholesky()?.l().try_inverse()?;
            let eigen = SymmetricEigen::new(&root * small * root.transpose());
            let mut order: Vec<usize> = (0..width).collect();
            order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
            let turned = root.transpose() * &eigen.eigenvectors;
            let turned = DMatrix::from_fn(width, width, |i, j| turned[(i, order[j])]);
            x = next * turned;
            let now: Vec<f64> = order.iter().take(COUNT).map(|&i| eigen.eigenvalues[i]).collect();
            let settled =
                now.iter().zip(&before).all(|(a, b)| (a - b).abs() <= SETTLED * a.abs().max(shift));
            if settled {
                let least = 1e-4 * shift;
                let back = |v: f64| if v - shift <= least { 0.0 } else { v - shift };
                return Some(now.into_iter().map(back).collect());
            }
            before = now;
        }
        None
    }
}

fn ascending(values: DVector<f64>) -> Vec<f64> {
    let mut list: Vec<f64> = values.iter().copied().collect();
    list.sort_by(f64::total_cmp);
    let most = list.last().copied().unwrap_or(0.0).abs();
    list.iter_mut().filter(|v| v.abs() <= FREE * most).for_each(|v| *v = 0.0);
    list
}
