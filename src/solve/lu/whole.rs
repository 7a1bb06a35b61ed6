//! Factors of square matrices by faer, which chooses its own order and pivots among all rows of a column.

use super::super::Pattern;
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
pub struct Whole {
    pattern: Pattern,
    /// Where each entry of the lower triangle, and its mirror image, stand in the whole matrix.
    places: Vec<[usize; 2]>,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    values: Vec<f64>,
    work: MemBuffer,
}

impl Whole {
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
