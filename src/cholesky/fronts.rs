//! Numbers of a Cholesky factor front by front (J. Liu, *The multifrontal method for sparse matrix
//! solution*, SIAM Review 34, 1992): subtrees of the elimination tree are independent pieces of work,
//! and the few fronts above them are products of large matrices, which faer shares out.
//!
//! Order, supernodes and the place of every number are faer's.
//! Here and not there: faer gathers each supernode from all of its descendants in turn, on one thread
//! but for the inside of a product.

use super::Pattern;
use faer::{
    Accum, MatMut, Par,
    dyn_stack::{MemBuffer, MemStack},
    linalg::{
        cholesky::llt::factor::{LltRegularization, cholesky_in_place, cholesky_in_place_scratch},
        matmul::triangular::{self, BlockStructure},
        triangular_solve::solve_lower_triangular_in_place,
    },
    perm::PermRef,
    reborrow::{Reborrow, ReborrowMut},
    sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky,
};
use std::sync::{Mutex, PoisonError};

/// A subtree with at most one of so many parts of all work is one piece. Fewer: threads that wait for
/// the last one. More: small fronts that are done alone.
const PIECES: f64 = 32.0;
/// Operations from which the inside of one front is shared out. Fewer: threads cost more than they do.
const SHARED: f64 = 3e7;

/// What is known of the factors of one pattern before there are numbers.
pub struct Fronts {
    list: Vec<Front>,
    /// Subtrees that are done by themselves, the longest first; each in the order of elimination.
    pieces: Vec<Vec<usize>>,
    /// The last fronts of the pieces, and what is above them, in the order of elimination.
    above: Vec<usize>,
    /// Of each front the piece of which it is the last.
    piece: Vec<Option<usize>>,
}

struct Front {
    width: usize,
    /// Rows of its own and below.
    size: usize,
    children: usize,
    /// Where its rows below its own are in its parent's.
    into: Vec<usize>,
    /// Which entries of the matrix belong to its own columns, and where.
    entries: Vec<(usize, usize)>,
    /// Numbers of the factor that it has.
    count: usize,
    /// Operations.
    work: f64,
}

/// What a front leaves of the rows below its own: a lower triangle, by columns.
#[derive(Default)]
struct Rest {
    of: usize,
    lower: Vec<f64>,
}

/// The matrix was not positive definite, or what a front leaves does not fit into memory.
struct NoFactor;

impl Fronts {
    pub fn new(
        pattern: &Pattern,
        symbolic: &SymbolicSupernodalCholesky<usize>,
        order: Option<PermRef<'_, usize>>,
    ) -> Self {
        let (begin, end) = (symbolic.supernode_begin(), symbolic.supernode_end());
        let count = symbolic.n_supernodes();
        let rows = |s: usize| symbolic.supernode(s).pattern();
        let mut of = vec![0; pattern.size()];
        (0..count).for_each(|s| of[begin[s]..end[s]].fill(s));
        let place = |s: usize, row: usize| match row < end[s] {
            true => row - begin[s],
            false => end[s] - begin[s] + rows(s).partition_point(|&r| r < row),
        };
        let parent = |s: usize| rows(s).first().map(|&r| of[r]);
        let values = symbolic.col_ptr_for_val();
        let mut list: Vec<Front> = (0..count)
            .map(|s| {
                let width = end[s] - begin[s];
                let size = width + rows(s).len();
                let into = parent(s)
                    .map(|p| rows(s).iter().map(|&row| place(p, row)).collect())
                    .unwrap_or_default();
                // Of every column the square of what it leaves.
                let work = (size - width..size).map(|n| (n * n) as f64).sum();
                let (children, count) = (0, values[s + 1] - values[s]);
                Front { width, size, children, into, entries: Vec::new(), count, work }
            })
            .collect();
        let new = |old: usize| order.map_or(old, |p| p.arrays().1[old]);
        for column in 0..pattern.size() {
            for e in pattern.starts[column]..pattern.starts[column + 1] {
                let (i, j) = (new(pattern.rows[e]), new(column));
                let (row, column) = (i.max(j), i.min(j));
                let s = of[column];
                let at = (column - begin[s]) * list[s].size + place(s, row);
                list[s].entries.push((e, at));
            }
        }
        // Children come before their parents.
        let mut children = vec![Vec::new(); count];
        let mut roots = Vec::new();
        let mut below: Vec<f64> = list.iter().map(|f| f.work).collect();
        for s in 0..count {
            match parent(s) {
                Some(p) => {
                    below[p] += below[s];
                    list[p].children += 1;
                    children[p].push(s);
                }
                None => roots.push(s),
            }
        }
        let all: f64 = roots.iter().map(|&r| below[r]).sum();
        let mut piece = vec![None; count];
        let is_piece = |s: usize| below[s] <= all / PIECES;
        let above = postorder(&roots, &children, is_piece);
        let mut last: Vec<usize> = above.iter().copied().filter(|&s| is_piece(s)).collect();
        last.sort_by(|&a, &b| below[b].total_cmp(&below[a]));
        let pieces = last.iter().map(|&s| postorder(&[s], &children, |_| false)).collect();
        last.iter().enumerate().for_each(|(k, &s)| piece[s] = Some(k));
        Self { list, pieces, above, piece }
    }

    /// Fronts of the subtrees that are done by themselves, each in the order of elimination.
    pub fn pieces(&self) -> impl Iterator<Item = &[usize]> {
        self.pieces.iter().map(Vec::as_slice)
    }

    /// Fronts of no piece, in the order of elimination.
    pub fn above(&self) -> impl Iterator<Item = usize> {
        self.above.iter().copied().filter(|&s| self.piece[s].is_none())
    }

    /// The numbers of the factor; false where the matrix is not positive definite or memory is short.
    pub fn factor(
        &self,
        matrix: &[f64],
        factor: &mut [f64],
        regularization: LltRegularization<f64>,
        threads: Par,
    ) -> bool {
        let mut columns: Vec<Option<&mut [f64]>> = Vec::with_capacity(self.list.len());
        let mut left = factor;
        for front in &self.list {
            let (own, others) = left.split_at_mut(front.count);
            columns.push(Some(own));
            left = others;
        }
        let mut take = |s: usize| columns[s].take().unwrap_or_default();
        let pieces: Vec<_> = self
            .pieces
            .iter()
            .map(|piece| {
                let own: Vec<_> = piece.iter().map(|&s| (s, take(s))).collect();
                Mutex::new(own)
            })
            .collect();
        let one = |piece: &Mutex<Vec<(usize, &mut [f64])>>| {
            // Nothing is used up: where not all threads could be started, it is done once more.
            let mut own = piece.lock().unwrap_or_else(PoisonError::into_inner);
            let mut rests = Vec::new();
            for (s, columns) in own.iter_mut() {
                self.eliminate(*s, matrix, columns, &mut rests, regularization, Par::Seq)?;
            }
            Ok(rests.pop().unwrap_or_default())
        };
        let alone = || pieces.iter().map(&one).collect();
        #[cfg(feature = "solve")]
        let done: Result<Vec<Rest>, NoFactor> = match threads.degree() {
            1 => alone(),
            many => crate::parallel::try_map(many, &pieces, one).unwrap_or_else(|_| alone()),
        };
        #[cfg(not(feature = "solve"))]
        let done: Result<Vec<Rest>, NoFactor> = alone();
        let Ok(mut done) = done else { return false };
        let mut rests = Vec::new();
        self.above.iter().all(|&s| {
            if let Some(piece) = self.piece[s] {
                rests.push(std::mem::take(&mut done[piece]));
                return true;
            }
            let threads = if self.list[s].work < SHARED { Par::Seq } else { threads };
            self.eliminate(s, matrix, take(s), &mut rests, regularization, threads).is_ok()
        })
    }

    /// Eliminates a front: what its children left is last of `rests`, and what it leaves takes their
    /// place.
    fn eliminate(
        &self,
        s: usize,
        matrix: &[f64],
        columns: &mut [f64],
        rests: &mut Vec<Rest>,
        regularization: LltRegularization<f64>,
        threads: Par,
    ) -> Result<(), NoFactor> {
        let front = &self.list[s];
        let (width, size) = (front.width, front.size);
        let below = size - width;
        columns.fill(0.0);
        for &(e, at) in &front.entries {
            columns[at] += matrix[e];
        }
        let mut rest = Vec::new();
        rest.try_reserve_exact(below * below).map_err(|_| NoFactor)?;
        rest.resize(below * below, 0.0);
        for child in rests.drain(rests.len() - front.children..) {
            let into = &self.list[child.of].into;
            for (j, &column) in into.iter().enumerate() {
                let from = &child.lower[j * into.len() + j..(j + 1) * into.len()];
                let (to, first) = match column.checked_sub(width) {
                    None => (&mut columns[column * size..(column + 1) * size], 0),
                    Some(k) => (&mut rest[k * below..(k + 1) * below], width),
                };
                into[j..].iter().zip(from).for_each(|(row, v)| to[row - first] += v);
            }
        }
        let columns = MatMut::from_column_major_slice_mut(columns, size, width);
        let (mut own, mut lower) = columns.split_at_row_mut(width);
        let need = cholesky_in_place_scratch::<f64>(width, threads, Default::default());
        let mut work = MemBuffer::new(need);
        let stack = MemStack::new(&mut work);
        cholesky_in_place(own.rb_mut(), regularization, threads, stack, Default::default())
            .map_err(|_| NoFactor)?;
        solve_lower_triangular_in_place(own.rb(), lower.rb_mut().transpose_mut(), threads);
        triangular::matmul(
            MatMut::from_column_major_slice_mut(&mut rest, below, below),
            BlockStructure::TriangularLower,
            Accum::Add,
            lower.rb(),
            BlockStructure::Rectangular,
            lower.rb().transpose(),
            BlockStructure::Rectangular,
            -1.0,
            threads,
        );
        rests.push(Rest { of: s, lower: rest });
        Ok(())
    }
}

/// What hangs on the roots, children before their parents; what ends a branch has none.
fn postorder(roots: &[usize], children: &[Vec<usize>], ends: impl Fn(usize) -> bool) -> Vec<usize> {
    let (mut order, mut stack) = (Vec::new(), roots.to_vec());
    // Parents first, and then all of it backwards.
    while let Some(s) = stack.pop() {
        order.push(s);
        if !ends(s) {
            stack.extend(&children[s]);
        }
    }
    order.reverse();
    order
}
