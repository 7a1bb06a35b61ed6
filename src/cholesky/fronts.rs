//! Numbers of a Cholesky factor front by front (J. Liu, *The multifrontal method for sparse matrix
//! solution*, SIAM Review 34, 1992): subtrees of the elimination tree are independent pieces of work,
//! and the few fronts above them are products of large matrices, which faer shares out.
//!
//! Order, supernodes and the place of every number are faer's.
//! Here and not there: faer gathers each supernode from all of its descendants in turn, on one thread
//! but for the inside of a product.

use super::tree::Tree;
use faer::{
    Accum, MatMut, Par,
    dyn_stack::{MemBuffer, MemStack},
    linalg::{
        cholesky::llt::factor::{LltRegularization, cholesky_in_place, cholesky_in_place_scratch},
        matmul::triangular::{self, BlockStructure},
        triangular_solve::solve_lower_triangular_in_place,
    },
    reborrow::{Reborrow, ReborrowMut},
};
use std::sync::{Mutex, PoisonError};

/// Operations from which the inside of one front is shared out. Fewer: threads cost more than they do.
const SHARED: f64 = 3e7;

/// What a front leaves of the rows below its own: a lower triangle, by columns.
#[derive(Default)]
struct Rest {
    of: usize,
    lower: Vec<f64>,
}

/// The matrix was not positive definite, or what a front leaves does not fit into memory.
struct NoFactor;

impl Tree {
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
