//! Sparse LU factorisation of square matrices of a symmetric pattern and unsymmetric values; with
//! `cholesky.rs` the adapter to faer.

use super::Pattern;
use faer::{
    Conj, MatMut, Par,
    dyn_stack::{MemBuffer, MemStack, StackReq},
    sparse::{
        SparseColMatRef, SymbolicSparseColMatRef,
        linalg::{
            SupernodalThreshold,
            lu::{LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu},
        },
    },
};

/// Factors of matrices of one pattern: the ordering is found once. One thread, so that the same
/// matrix always has the same factors.
pub struct Lu {
    pattern: Pattern,
    /// Where each entry of the lower triangle, and its mirror image, stand in the whole matrix.
    places: Vec<[usize; 2]>,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    values: Vec<f64>,
    work: MemBuffer,
}

impl Lu {
    /// Prepares the pattern of which this is the lower triangle, diagonal included; `None` where it
    /// is none or does not fit into memory.
    pub fn new(lower: &Pattern) -> Option<Self> {
        let n = lower.size();
        if n == 0 || lower.starts[n] != lower.rows.len() || !lower.starts.is_sorted() {
            return None;
        }
        let mut columns = vec![Vec::new(); n];
        // One sweep by ascending column leaves the rows of every column in order.
        for j in 0..n {
            for (k, &i) in
                lower.rows.iter().enumerate().take(lower.starts[j + 1]).skip(lower.starts[j])
            {
                columns.get(i)?;
                columns[j].push((i, k, 0));
                if i != j {
                    columns[i].push((j, k, 1));
                }
            }
        }
        let mut pattern = Pattern { starts: vec![0], rows: Vec::new() };
        let mut places = vec![[0; 2]; lower.rows.len()];
        for column in &columns {
            for &(row, entry, side) in column {
                // The diagonal is its own mirror image.
                if side == 0 {
                    places[entry] = [pattern.rows.len(); 2];
                }
                places[entry][side] = pattern.rows.len();
                pattern.rows.push(row);
            }
            pattern.starts.push(pattern.rows.len());
        }
        if columns.iter().any(|c| !c.windows(2).all(|w| w[0].0 < w[1].0)) {
            return None;
        }
        let entries =
            SymbolicSparseColMatRef::new_checked(n, n, &pattern.starts, None, &pattern.rows);
        // In blocks always: column by column, faer 0.21 panics at a pivot of exactly zero.
        let in_blocks = LuSymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_lu(entries, in_blocks).ok()?;
        let need = StackReq::any_of(&[
            symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(2, Par::Seq),
        ]);
        let work = MemBuffer::try_new(need).ok()?;
        let values = vec![0.0; pattern.rows.len()];
        Some(Self { pattern, places, symbolic, numeric: NumericLu::new(), values, work })
    }

    /// Solves with the matrix of these values of the lower triangle and, entry by entry, of its
    /// mirror image, in place; `x` are one or two right-hand sides, one after the other. False
    /// where the matrix is singular or something does not fit.
    pub fn solve(&mut self, lower: &[f64], upper: &[f64], x: &mut [f64]) -> bool {
        let n = self.pattern.size();
        if lower.len() != self.places.len()
            || upper.len() != self.places.len()
            || (x.len() != n && x.len() != 2 * n)
        {
            return false;
        }
        for ((place, l), u) in self.places.iter().zip(lower).zip(upper) {
            self.values[place[1]] = *u;
            self.values[place[0]] = *l;
        }
        let entries = SymbolicSparseColMatRef::new_checked(
            n,
            n,
            &self.pattern.starts,
            None,
            &self.pattern.rows,
        );
        let matrix = SparseColMatRef::new(entries, &self.values[..]);
        let stack = MemStack::new(&mut self.work);
        let Ok(factors) = self.symbolic.factorize_numeric_lu(
            &mut self.numeric,
            matrix,
            Par::Seq,
            stack,
            Default::default(),
        ) else {
            return false;
        };
        let columns = x.len() / n;
        factors.solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(x, n, columns),
            Par::Seq,
            stack,
        );
        // A pivot of exactly zero was divided by.
        x.iter().all(|v| v.is_finite())
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
        let mut lu = Lu::new(&pattern).unwrap();
        // The matrix times (1, −2, 3) and times (0, 1, 1).
        let mut x = [0.0, -8.0, 4.0, 2.0, 2.0, 3.0];
        assert!(lu.solve(&lower, &upper, &mut x));
        for (x, want) in x.iter().zip([1.0, -2.0, 3.0, 0.0, 1.0, 1.0]) {
            assert!((x - want).abs() < 1e-14);
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
            let mut x = rhs.clone();
            let solved = Lu::new(&pattern).unwrap().solve(&lower, &upper, &mut x);
            // The determinant of whole numbers is one.
            if whole.determinant().abs() > 0.5 {
                prop_assert!(solved);
                prop_assert!((whole * DVector::from(x) - DVector::from(rhs)).norm() < 1e-8);
            } else if solved {
                prop_assert!(x.iter().all(|v| v.is_finite()));
            }
        }
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
