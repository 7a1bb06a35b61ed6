//! Solutions with square matrices of a symmetric pattern and unsymmetric values; with
//! `cholesky` the adapter to faer.

mod fronts;
mod whole;

use super::Pattern;
use fronts::Fronts;
use whole::Whole;

/// What is left of a row, in what its terms and its right side come to, before it is corrected. More: more
/// steps of the method that asks. Less: corrections for nothing, for it goes on until nothing is left.
const CLOSELY: f64 = 1e-12;
/// The same where corrections lead no further. More: steps that lead astray. Less: what is nearly
/// singular is factored twice.
const GOOD: f64 = 1e-11;
/// Most corrections.
const CORRECTIONS: usize = 3;

/// Factors of matrices of one pattern, front by front, and where pivots among the rows of a front do not
/// serve, among all of a column. One thread, so that the same matrix always has the same factors.
pub struct Lu {
    pattern: Pattern,
    fronts: Option<Fronts>,
    whole: Option<Whole>,
}

impl Lu {
    /// Prepares the pattern of which this is the lower triangle, diagonal included; `None` where it
    /// is none or does not fit into memory.
    pub fn new(lower: &Pattern) -> Option<Self> {
        let fronts = Some(Fronts::new(lower)?);
        Some(Self { pattern: lower.clone(), fronts, whole: None })
    }

    /// The same with pivots among all rows of a column always: for matrices of which rounding makes a
    /// direction that nothing resists (rounding of fronts moves what stands beside a block that slides).
    pub fn whole(lower: &Pattern) -> Option<Self> {
        Some(Self { pattern: lower.clone(), fronts: None, whole: Some(Whole::new(lower)?) })
    }

    /// Solves with the matrix of these values of the lower triangle and, entry by entry, of its
    /// mirror image, in place; `x` are one or two right-hand sides, one after the other. False
    /// where the matrix is singular or something does not fit.
    pub fn solve(&mut self, lower: &[f64], upper: &[f64], x: &mut [f64]) -> bool {
        let (n, entries) = (self.pattern.size(), self.pattern.rows.len());
        if [lower.len(), upper.len()] != [entries; 2] || (x.len() != n && x.len() != 2 * n) {
            return false;
        }
        if let Some(fronts) = self.fronts.as_mut()
            && fronts.factor(lower, upper)
        {
            let matrix = Matrix { pattern: &self.pattern, lower, upper };
            let solved: Option<Vec<Vec<f64>>> =
                x.chunks_exact(n).map(|right| matrix.solved(fronts, right)).collect();
            if let Some(solved) = solved {
                x.copy_from_slice(&solved.concat());
                return true;
            }
        }
        if self.whole.is_none() {
            self.whole = Whole::new(&self.pattern);
        }
        self.whole.as_mut().is_some_and(|whole| whole.solve(lower, upper, x))
    }
}

/// A matrix by its lower triangle and the mirror image of its upper one.
struct Matrix<'a> {
    pattern: &'a Pattern,
    lower: &'a [f64],
    upper: &'a [f64],
}

impl Matrix<'_> {
    /// The solution by factors, corrected; `None` where it stays off.
    fn solved(&self, fronts: &Fronts, right: &[f64]) -> Option<Vec<f64>> {
        let mut x = right.to_vec();
        fronts.solve(&mut x);
        let (mut left, mut off) = self.left(&x, right);
        for _ in 0..CORRECTIONS {
            if off <= CLOSELY || !off.is_finite() {
                break;
            }
            fronts.solve(&mut left);
            let next: Vec<f64> = x.iter().zip(&left).map(|(x, d)| x + d).collect();
            let (next_left, next_off) = self.left(&next, right);
            if next_off >= off {
                break;
            }
            (x, left, off) = (next, next_left, next_off);
        }
        (off <= GOOD).then_some(x)
    }

    /// What `x` leaves of the right side, and the greatest of it in what the terms of its row and the right
    /// side come to (Oettli & Prager 1964).
    fn left(&self, x: &[f64], right: &[f64]) -> (Vec<f64>, f64) {
        let mut left = right.to_vec();
        let mut terms: Vec<f64> = right.iter().map(|b| b.abs()).collect();
        for column in 0..x.len() {
            let own = self.pattern.starts[column]..self.pattern.starts[column + 1];
            let (rows, lower) = (&self.pattern.rows[own.clone()], &self.lower[own.clone()]);
            let (mut sum, mut all) = (0.0, 0.0);
            for ((&row, l), u) in rows.iter().zip(lower).zip(&self.upper[own]) {
                let term = l * x[column];
                left[row] -= term;
                terms[row] += term.abs();
                if row != column {
                    let term = u * x[row];
                    sum += term;
                    all += term.abs();
                }
            }
            left[column] -= sum;
            terms[column] += all;
        }
        let share =
            |(left, terms): (&f64, &f64)| if *left == 0.0 { 0.0 } else { left.abs() / terms };
        // What is no number is the greatest.
        let most = left.iter().zip(&terms).map(share).fold(0.0, |most: f64, share| {
            if share <= most || most.is_nan() { most } else { share }
        });
        (left, most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    /// `[[4, 2, 0], [1, 3, −1], [0, 1, 2]]`.
    fn three() -> (Pattern, [f64; 5], [f64; 5]) {
        (
            Pattern { starts: vec![0, 2, 4, 5], rows: vec![0, 1, 1, 2, 2] },
            [4.0, 1.0, 3.0, 1.0, 2.0],
            [4.0, 2.0, 3.0, -1.0, 2.0],
        )
    }

    #[test]
    fn what_was_multiplied_comes_back() {
        let (pattern, lower, upper) = three();
        for lu in [Lu::new(&pattern), Lu::whole(&pattern)] {
            // The matrix times (1, −2, 3) and times (0, 1, 1).
            let mut x = [0.0, -8.0, 4.0, 2.0, 2.0, 3.0];
            assert!(lu.unwrap().solve(&lower, &upper, &mut x));
            for (x, want) in x.iter().zip([1.0, -2.0, 3.0, 0.0, 1.0, 1.0]) {
                assert!((x - want).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn a_pivot_of_exactly_zero_is_singular() {
        // [[1, 1], [1, 1]], and no entry but zeros.
        let mut lu = Lu::new(&Pattern { starts: vec![0, 2, 3], rows: vec![0, 1, 1] }).unwrap();
        assert!(!lu.solve(&[1.0; 3], &[1.0; 3], &mut [1.0, 2.0]));
        assert!(!lu.solve(&[0.0; 3], &[0.0; 3], &mut [1.0, 2.0]));
        // What comes after is not spoilt.
        let mut x = [1.0, 2.0];
        assert!(lu.solve(&[2.0, 0.0, 1.0], &[2.0, 0.0, 1.0], &mut x) && x == [0.5, 2.0]);
    }

    proptest! {
        /// Small whole numbers on random patterns: pivots cancel exactly. Against a dense
        /// factorisation.
        #[test]
        fn whole_numbers_are_solved_or_singular(n in 1usize..9, seed in any::<u64>(), share in 1u64..9) {
            let mut state = seed;
            let mut next = |below: u64| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 33) % below
            };
            let (mut pattern, mut lower, mut upper) = (Pattern { starts: vec![0], rows: Vec::new() }, Vec::new(), Vec::new());
            let mut whole = DMatrix::zeros(n, n);
            for j in 0..n {
                for i in j..n {
                    if i == j || next(10) < share {
                        let mut entry = || next(5) as f64 - 2.0;
                        let (l, u) = (entry(), entry());
                        let u = if i == j { l } else { u };
                        pattern.rows.push(i);
                        lower.push(l);
                        upper.push(u);
                        (whole[(i, j)], whole[(j, i)]) = (l, u);
                    }
                }
                pattern.starts.push(pattern.rows.len());
            }
            let rhs: Vec<f64> = (0..n).map(|_| next(7) as f64 - 3.0).collect();
            for lu in [Lu::new(&pattern), Lu::whole(&pattern)] {
                let mut x = rhs.clone();
                let solved = lu.unwrap().solve(&lower, &upper, &mut x);
                // The determinant of whole numbers is one.
                if whole.determinant().abs() > 0.5 {
                    prop_assert!(solved);
                    let left = &whole * DVector::from(x) - DVector::from(rhs.clone());
                    prop_assert!(left.norm() < 1e-8);
                } else if solved {
                    prop_assert!(x.iter().all(|v| v.is_finite()));
                }
            }
        }
    }

    /// Whatever the other rows leave.
    #[test]
    fn what_is_no_number_is_not_small() {
        let pattern = Pattern { starts: vec![0, 1, 2], rows: vec![0, 1] };
        let matrix = Matrix { pattern: &pattern, lower: &[1.0, 1.0], upper: &[1.0, 1.0] };
        for x in [[f64::INFINITY, 1.0], [1.0, f64::NAN]] {
            assert!(matrix.left(&x, &[1.0, 1.0]).1.is_nan());
        }
        assert_eq!(matrix.left(&[1.0, 3.0], &[1.0, 1.0]).1, 0.5);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let (pattern, lower, upper) = three();
        let mut lu = Lu::new(&pattern).unwrap();
        assert!(!lu.solve(&lower[..4], &upper, &mut [0.0; 3]));
        assert!(!lu.solve(&lower, &upper, &mut [0.0; 4]));
        assert!(!lu.solve(&lower, &upper, &mut [0.0; 9]));
        assert!(Lu::new(&Pattern { rows: vec![1, 0, 1, 2, 2], ..pattern.clone() }).is_none());
        assert!(Lu::new(&Pattern { rows: vec![0, 9, 1, 2, 2], ..pattern.clone() }).is_none());
        assert!(Lu::new(&Pattern { starts: vec![0, 2, 4, 7], ..pattern }).is_none());
    }
}
