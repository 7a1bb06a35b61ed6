//! Sparse Cholesky factorisation of symmetric positive definite matrices of one pattern; with
//! `solve/lu` the adapter to faer.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(target_arch = "wasm32")]
extern crate faer32 as faer;

mod dissection;
mod fronts;
#[cfg(feature = "threads")]
pub mod parallel;
mod pattern;
mod substitution;
mod tree;

pub use dissection::dissected;
pub use pattern::Pattern;
pub use tree::{Front, Tree};

use faer::{
    Conj, MatMut, Par, Side,
    dyn_stack::{MemBuffer, MemStack, StackReq},
    linalg::cholesky::llt::factor::LltRegularization,
    perm::PermRef,
    sparse::{
        SparseColMatRef, SymbolicSparseColMatRef,
        linalg::{
            SupernodalThreshold,
            cholesky::{
                CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw,
                SymmetricOrdering, factorize_symbolic_cholesky,
            },
        },
    },
};
use fronts::Room;
use substitution::Substitution;

/// Rows from which nested dissection of symmetric matrices is tried beside approximate minimum degree.
/// Fewer: time for what is factored in less. More: heaps in space take twice as long.
const LARGE: usize = 6_000;

/// Operations an entry of the factor, in units of 40, from which it is factored in blocks of columns.
/// More: vaults of 400 blocks are factored column by column (17.9 s a state in place of 15.5). Fewer:
/// no gain.
const IN_BLOCKS: f64 = 0.2;
/// The same where every factor goes by blocks of columns: less than any.
const IN_FRONTS: f64 = -1.0;

/// Factors of matrices of one pattern: the ordering, of approximate minimum degree and nested
/// dissection (G. Karypis and V. Kumar 1998) the one with the smaller factor, is found once. The same matrix always has the same factors.
pub struct Cholesky {
    pattern: Pattern,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    work: MemBuffer,
    threads: Par,
    /// Where it is large.
    fronts: Option<(Tree, Substitution)>,
    room: Room,
}

/// How many threads factor a matrix of so many rows. Subtrees and parts of products are shared out,
/// sums are not: the same bits on any number.
fn threads(rows: usize) -> Par {
    #[cfg(all(feature = "threads", not(target_arch = "wasm32")))]
    let all = Par::rayon(0);
    #[cfg(not(all(feature = "threads", not(target_arch = "wasm32"))))]
    let all = Par::Seq;
    if rows < LARGE { Par::Seq } else { all }
}

/// What is known of a factor before there are numbers; `None` where the pattern is none, or the factor
/// does not fit into memory.
fn analysed(
    pattern: &Pattern,
    ordering: SymmetricOrdering<'_, usize>,
    in_blocks: f64,
) -> Option<SymbolicCholesky<usize>> {
    let n = pattern.size();
    let ascending = |k: usize| {
        let column = pattern.rows.get(pattern.starts[k]..pattern.starts[k + 1])?;
        Some(column.windows(2).all(|w| w[0] < w[1]) && column.iter().all(|&i| (k..n).contains(&i)))
    };
    if n == 0
        || pattern.starts[n] != pattern.rows.len()
        || !(0..n).all(|k| ascending(k) == Some(true))
    {
        return None;
    }
    let entries = SymbolicSparseColMatRef::new_checked(n, n, &pattern.starts, None, &pattern.rows);
    let parameters = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold(in_blocks),
        ..Default::default()
    };
    factorize_symbolic_cholesky(entries, Side::Lower, ordering, parameters).ok()
}

/// The same in the order of nested dissection.
fn analysed_by_dissection(pattern: &Pattern, in_blocks: f64) -> Option<SymbolicCholesky<usize>> {
    let (order, inverse) = dissected(pattern)?;
    let order = PermRef::new_checked(&order, &inverse, pattern.size());
    analysed(pattern, SymmetricOrdering::Custom(order), in_blocks)
}

/// The fronts of a pattern, and of each the rows of the matrix that it has, its own first, for factors
/// that need not be symmetric; `None` where the pattern is none, or they do not fit into memory.
pub fn fronts(pattern: &Pattern) -> Option<(Tree, Vec<Vec<usize>>)> {
    let mut symbolic = analysed(pattern, SymmetricOrdering::Amd, IN_FRONTS)?;
    if let Some(other) = analysed_by_dissection(pattern, IN_FRONTS)
        && other.len_val() < symbolic.len_val()
    {
        symbolic = other;
    }
    let SymbolicCholeskyRaw::Supernodal(supernodes) = symbolic.raw() else { return None };
    let order = symbolic.perm();
    let old = |new: usize| order.map_or(new, |p| p.arrays().0[new]);
    let rows = (0..supernodes.n_supernodes()).map(|s| {
        let own = supernodes.supernode_begin()[s]..supernodes.supernode_end()[s];
        own.chain(supernodes.supernode(s).pattern().iter().copied()).map(old).collect()
    });
    let rows = rows.collect();
    Some((Tree::new(pattern, supernodes, order), rows))
}

impl Cholesky {
    /// Prepares a pattern; `None` where it is none or its factor does not fit into memory.
    pub fn new(pattern: Pattern) -> Option<Self> {
        let n = pattern.size();
        let mut symbolic = analysed(&pattern, SymmetricOrdering::Amd, IN_BLOCKS)?;
        if n >= LARGE
            && let Some(other) = analysed_by_dissection(&pattern, IN_BLOCKS)
            && other.len_val() < symbolic.len_val()
        {
            symbolic = other;
        }
        let threads = threads(n);
        let need = StackReq::any_of(&[
            symbolic.factorize_numeric_llt_scratch::<f64>(threads, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]);
        let work = MemBuffer::try_new(need).ok()?;
        let mut factor = Vec::new();
        factor.try_reserve_exact(symbolic.len_val()).ok()?;
        factor.resize(symbolic.len_val(), 0.0);
        let fronts = match symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(s) if n >= LARGE => {
                let tree = Tree::new(&pattern, s, symbolic.perm());
                let substitution = Substitution::new(&tree, s, symbolic.perm(), n);
                Some((tree, substitution))
            }
            _ => None,
        };
        Some(Self { pattern, symbolic, factor, work, threads, fronts, room: Room::default() })
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
        if let Some((tree, _)) = &self.fronts {
            let into = (self.factor.as_mut_slice(), &self.room);
            return tree.factor(values, into, regularization, self.threads);
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
                self.threads,
                stack,
                Default::default(),
            )
            .is_ok()
    }

    /// Solves with the last factors, in place.
    pub fn solve(&mut self, x: &mut [f64]) {
        let n = self.pattern.size();
        if let Some((_, substitution)) = &self.fronts {
            return substitution.solve(&self.factor, x, self.threads);
        }
        let factors = LltRef::new(&self.symbolic, self.factor.as_slice());
        let column = MatMut::from_column_major_slice_mut(x, n, 1);
        factors.solve_in_place_with_conj(Conj::No, column, Par::Seq, MemStack::new(&mut self.work));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix of a cubic lattice, six neighbours each.
    fn lattice(side: usize) -> (Pattern, Vec<f64>) {
        let n = side.pow(3);
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for k in 0..n {
            rows.push(k);
            values.push(6.1);
            for (step, at) in [(1, k), (side, k / side), (side * side, k / (side * side))] {
                if at % side + 1 < side {
                    rows.push(k + step);
                    values.push(-1.0);
                }
            }
            starts.push(rows.len());
        }
        (Pattern { starts, rows }, values)
    }

    /// The factor of a lattice in space is smaller than that of approximate minimum degree, and
    /// solves as well.
    #[test]
    fn lattices_in_space_are_dissected() {
        let (Pattern { starts, rows }, values) = lattice(19);
        let n = starts.len() - 1;
        assert!(n >= LARGE);
        let usual = factorize_symbolic_cholesky(
            SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &rows),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .unwrap();
        let pattern = Pattern { starts: starts.clone(), rows: rows.clone() };
        let mut cholesky = Cholesky::new(pattern).unwrap();
        assert!(cholesky.fill() < usual.len_val(), "{} of {}", cholesky.fill(), usual.len_val());
        assert!(cholesky.factorize(&values));
        let wanted: Vec<f64> = (0..n).map(|k| ((k * 7919) % 1009) as f64 / 1009.0).collect();
        let mut x = vec![0.0; n];
        for k in 0..n {
            for (&i, &v) in rows[starts[k]..starts[k + 1]].iter().zip(&values[starts[k]..]) {
                x[i] += v * wanted[k];
                if i != k {
                    x[k] += v * wanted[i];
                }
            }
        }
        cholesky.solve(&mut x);
        let off = x.iter().zip(&wanted).map(|(x, w)| (x - w).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{off}");
    }

    /// Front by front the factor is that of faer, and solves as it does, also where pivots are
    /// replaced, and what is not positive definite is refused.
    #[test]
    fn fronts_give_the_factor_of_faer() {
        let (pattern, mut values) = lattice(20);
        let n = pattern.size();
        let last = values.len() - 1;
        let mut fronts = Cholesky::new(pattern.clone()).unwrap();
        let mut faer = Cholesky { fronts: None, ..Cholesky::new(pattern.clone()).unwrap() };
        let (tree, _) = Cholesky::new(pattern.clone()).unwrap().fronts.unwrap();
        assert!(fronts.fronts.is_some());
        let mut agree = |values: &[f64], least: f64| {
            let done = [fronts.factorize_above(values, least), faer.factorize_above(values, least)];
            assert_eq!(done, [true; 2]);
            let far = |(a, b): (&f64, &f64)| (a - b).abs();
            let (mut own, mut other) = (&fronts.factor[..], &faer.factor[..]);
            for front in &tree.list {
                for k in 0..front.width {
                    // What is above the diagonal is nothing.
                    let lower = k * front.size + k..(k + 1) * front.size;
                    let pairs = own[lower.clone()].iter().zip(&other[lower]);
                    let off = pairs.map(far).fold(0.0, f64::max);
                    assert!(off < 1e-12, "{off}");
                }
                (own, other) = (&own[front.count..], &other[front.count..]);
            }
            let mut x: Vec<f64> = (0..n).map(|k| ((k * 7919) % 1009) as f64).collect();
            let mut y = x.clone();
            fronts.solve(&mut x);
            faer.solve(&mut y);
            let most = y.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
            let off = x.iter().zip(&y).map(far).fold(0.0, f64::max);
            assert!(off < 1e-12 * most, "{off} of {most}");
        };
        agree(&values, 1e-12);
        // One row stands alone, and has rounding.
        let alone = n / 2;
        for column in 0..n {
            let own = pattern.starts[column]..pattern.starts[column + 1];
            for (value, &row) in values[own.clone()].iter_mut().zip(&pattern.rows[own]) {
                if [row, column].contains(&alone) {
                    *value = if row == column { 1e-14 } else { 0.0 };
                }
            }
        }
        agree(&values, 1e-12);
        let (_, mut values) = lattice(20);
        values[last] = -1.0;
        assert!(!fronts.factorize(&values));
    }

    /// On any number of threads factor and solution have the same bits.
    #[cfg(feature = "threads")]
    #[test]
    fn factors_and_solutions_are_the_same_on_any_number_of_threads() {
        let (pattern, values) = lattice(20);
        let factor = |threads: Par| {
            let mut cholesky = Cholesky::new(pattern.clone()).unwrap();
            cholesky.threads = threads;
            assert!(cholesky.factorize(&values));
            let mut x: Vec<f64> = (0..pattern.size()).map(|k| (k % 17) as f64 - 8.0).collect();
            cholesky.solve(&mut x);
            cholesky.factor.iter().chain(&x).map(|v| v.to_bits()).collect::<Vec<_>>()
        };
        let one = factor(Par::Seq);
        for count in [1, 2, 3, 4] {
            assert!(factor(Par::rayon(count)) == one, "{count} of them");
        }
    }

    /// What a matrix that has no factor left in the room of its fronts is in no later factor.
    #[test]
    fn a_matrix_without_a_factor_leaves_nothing_behind() {
        let (pattern, values) = lattice(20);
        let mut spoiled = values.clone();
        // Rows of the first columns have fronts of their own; those above gather what they leave.
        spoiled.iter_mut().step_by(97).for_each(|v| *v = f64::NAN);
        let mut cholesky = Cholesky::new(pattern.clone()).unwrap();
        cholesky.threads = Par::Seq;
        let room = |cholesky: &Cholesky| -> usize {
            cholesky.room.lock().unwrap().iter().map(Vec::len).sum()
        };
        assert!(cholesky.factorize(&values));
        assert!(room(&cholesky) > 0);
        assert!(!cholesky.factorize(&spoiled));
        cholesky.room.lock().unwrap().iter_mut().for_each(|place| place.fill(f64::NAN));
        assert!(cholesky.factorize(&values));
        let mut fresh = Cholesky::new(pattern).unwrap();
        assert!(fresh.factorize(&values));
        assert!(fresh.factor == cholesky.factor);
    }

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
