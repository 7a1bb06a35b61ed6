//! Sparse Cholesky factorisation of symmetric positive definite matrices of one pattern; with
//! `lu.rs` the adapter to faer.

use faer::{
    Conj, MatMut, Par, Side,
    dyn_stack::{MemBuffer, MemStack, StackReq},
    linalg::cholesky::llt::factor::LltRegularization,
    sparse::{
        SparseColMatRef, SymbolicSparseColMatRef,
        linalg::cholesky::{
            CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
            factorize_symbolic_cholesky,
        },
    },
};

/// The pattern of the lower triangle of a symmetric matrix, column by column.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Where each column starts in `rows`, and where the last one ends.
    pub starts: Vec<usize>,
    /// Rows of the entries, ascending in each column.
    pub rows: Vec<usize>,
}

impl Pattern {
    /// Rows (and columns) of the matrix.
    pub fn size(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }
}

/// Factors of matrices of one pattern: the ordering (approximate minimum degree) and the fill are
/// found once. One thread, so that the same matrix always has the same factors.
pub struct Cholesky {
    pattern: Pattern,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    work: MemBuffer,
}

impl Cholesky {
    /// Prepares a pattern; `None` where it is none or its factor does not fit into memory.
    pub fn new(pattern: Pattern) -> Option<Self> {
        let n = pattern.size();
        let ascending = |k: usize| {
            let column = pattern.rows.get(pattern.starts[k]..pattern.starts[k + 1])?;
            Some(
                column.windows(2).all(|w| w[0] < w[1])
                    && column.iter().all(|&i| (k..n).contains(&i)),
            )
        };
        if n == 0
            || pattern.starts[n] != pattern.rows.len()
            || !(0..n).all(|k| ascending(k) == Some(true))
        {
            return None;
        }
        let entries =
            SymbolicSparseColMatRef::new_checked(n, n, &pattern.starts, None, &pattern.rows);
        let symbolic = factorize_symbolic_cholesky(
            entries,
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .ok()?;
        let need = StackReq::any_of(&[
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]);
        let work = MemBuffer::try_new(need).ok()?;
        let mut factor = Vec::new();
        factor.try_reserve_exact(symbolic.len_val()).ok()?;
        factor.resize(symbolic.len_val(), 0.0);
        Some(Self { pattern, symbolic, factor, work })
    }

    /// Entries of the factor.
    pub fn fill(&self) -> usize {
        self.factor.len()
    }

    /// Factors the matrix with these values of the pattern; false where it is not positive definite
    /// to working precision.
    pub fn factorize(&mut self, values: &[f64]) -> bool {
        self.factorize_from(values, LltRegularization::default())
    }

    /// The same where pivots of at most `least` are rounding: they are replaced by 1.
    pub fn factorize_above(&mut self, values: &[f64], least: f64) -> bool {
        self.factorize_from(
            values,
            LltRegularization {
                dynamic_regularization_delta: 1.0,
                dynamic_regularization_epsilon: least,
            },
        )
    }

    fn factorize_from(&mut self, values: &[f64], regularization: LltRegularization<f64>) -> bool {
        let n = self.pattern.size();
        if values.len() != self.pattern.rows.len() {
            return false;
        }
        let entries = SymbolicSparseColMatRef::new_checked(
            n,
            n,
            &self.pattern.starts,
            None,
            &self.pattern.rows,
        );
        let matrix = SparseColMatRef::new(entries, values);
        let (factor, stack) = (&mut self.factor, MemStack::new(&mut self.work));
        self.symbolic
            .factorize_numeric_llt(
                factor,
                matrix,
                Side::Lower,
                regularization,
                Par::Seq,
                stack,
                Default::default(),
            )
            .is_ok()
    }

    /// Solves with the last factors, in place.
    pub fn solve(&mut self, x: &mut [f64]) {
        let n = self.pattern.size();
        let factors = LltRef::new(&self.symbolic, self.factor.as_slice());
        let column = MatMut::from_column_major_slice_mut(x, n, 1);
        factors.solve_in_place_with_conj(Conj::No, column, Par::Seq, MemStack::new(&mut self.work));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[[4, 1, 0], [1, 3, 1], [0, 1, 2]]`.
    fn three() -> (Pattern, [f64; 5]) {
        (Pattern { starts: vec![0, 2, 4, 5], rows: vec![0, 1, 1, 2, 2] }, [4.0, 1.0, 3.0, 1.0, 2.0])
    }

    #[test]
    fn what_was_multiplied_comes_back() {
        let (pattern, values) = three();
        let mut cholesky = Cholesky::new(pattern).unwrap();
        assert!(cholesky.factorize(&values));
        // A (1, −2, 3).
        let mut x = [2.0, -2.0, 4.0];
        cholesky.solve(&mut x);
        for (x, want) in x.iter().zip([1.0, -2.0, 3.0]) {
            assert!((x - want).abs() < 1e-14);
        }
    }

    #[test]
    fn a_pivot_that_is_rounding_is_replaced() {
        let pattern = Pattern { starts: vec![0, 2, 3], rows: vec![0, 1, 1] };
        let mut cholesky = Cholesky::new(pattern).unwrap();
        assert!(cholesky.factorize_above(&[1.0, 1.0, 1.0], 1e-15));
        let mut x = [1.0, 1.0];
        cholesky.solve(&mut x);
        assert!((x[0] - 1.0).abs() < 1e-14 && x[1].abs() < 1e-14, "{x:?}");
    }

    #[test]
    fn what_is_no_positive_definite_matrix_is_refused() {
        let (pattern, mut values) = three();
        values[4] = -2.0;
        assert!(!Cholesky::new(pattern.clone()).unwrap().factorize(&values));
        assert!(!Cholesky::new(pattern.clone()).unwrap().factorize(&values[..4]));
        assert!(Cholesky::new(Pattern { rows: vec![1, 0, 1, 2, 2], ..pattern.clone() }).is_none());
        assert!(Cholesky::new(Pattern { rows: vec![0, 9, 1, 2, 2], ..pattern.clone() }).is_none());
        assert!(Cholesky::new(Pattern { starts: vec![0, 2, 4, 7], ..pattern }).is_none());
    }
}
