//! Numbers of a Cholesky factor front by front (J. Liu, *The multifrontal method for sparse matrix
//! solution*, SIAM Review 34, 1992): subtrees of the elimination tree are independent pieces of work,
//! and the few fronts above them are products of large matrices, which faer shares out.
//!
//! Order, supernodes and the place of every number are faer's.
//! Here and not there: faer gathers each supernode from all of its descendants in turn, on one thread
//! but for the inside of a product.

use super::tree::{Run, Tree};
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

/// Places of fronts that are gone which are kept for those to come. More: memory. Fewer: the pages of
/// each front are asked for anew, which takes longer than to fill them.
const KEPT: usize = 4;

/// A place may be this much larger than what is put there. More: small fronts take the places of large
/// ones. Less: places fit no other front.
const ROOMY: usize = 2;

/// What a front leaves of the rows below its own: a lower triangle, by columns; beyond it anything.
struct Rest {
    of: usize,
    lower: Vec<f64>,
}

/// Places of fronts that are gone, for those to come, of the next factors too.
pub type Room = Mutex<Vec<Vec<f64>>>;

/// What fronts have left that are not gathered yet, the last one last, and places for further ones.
struct Rests<'a> {
    list: Vec<Rest>,
    free: &'a Room,
}

impl Rests<'_> {
    /// So many numbers or more, whatever they are.
    fn place(&mut self, count: usize) -> Result<Vec<f64>, NoFactor> {
        let mut free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        let fits = |&k: &usize| (count..=ROOMY * count).contains(&free[k].len());
        let least = (0..free.len()).filter(fits).min_by_key(|&k| free[k].len());
        if let Some(k) = least {
            return Ok(free.swap_remove(k));
        }
        drop(free);
        // Whether there is room, before it is asked for as zeros, of which only the pages that are
        // written to are ever there: half of them stay out.
        Vec::<f64>::new().try_reserve_exact(count).map_err(|_| NoFactor)?;
        Ok(vec![0.0; count])
    }

    /// Gives back the places of what was gathered.
    fn give(&mut self, gone: Vec<Rest>) {
        let mut free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        free.extend(gone.into_iter().map(|rest| rest.lower));
        free.sort_by_key(|v| std::cmp::Reverse(v.len()));
        free.truncate(KEPT);
    }
}

/// Some columns of a front.
struct Strip<'a> {
    /// The first, counted in the front, and the row that its numbers begin with.
    first: usize,
    row: usize,
    /// Numbers a column.
    size: usize,
    values: &'a mut [f64],
}

impl Strip<'_> {
    /// Its own lower triangle becomes zero; where rows of the front are left out so does the rest.
    fn clear(&mut self) {
        for (k, column) in self.values.chunks_exact_mut(self.size.max(1)).enumerate() {
            let above = if self.row > 0 { self.first + k - self.row } else { 0 };
            column[above..].fill(0.0);
        }
    }

    /// Adds what is in its columns of what a child left, with so many rows, that stand there.
    fn add(&mut self, rest: &[f64], rows: usize, into: &[Run]) {
        let end = self.first + self.values.len() / self.size.max(1);
        for (k, run) in into.iter().enumerate() {
            for column in run.to.max(self.first)..(run.to + run.count).min(end) {
                let j = column - run.to;
                let from = &rest[(run.from + j) * rows..(run.from + j + 1) * rows];
                let to = &mut self.values[(column - self.first) * self.size..][..self.size];
                let first = Run { from: run.from + j, to: column, count: run.count - j };
                for run in std::iter::once(&first).chain(&into[k + 1..]) {
                    to[run.to - self.row..]
                        .iter_mut()
                        .zip(&from[run.from..run.from + run.count])
                        .for_each(|(to, v)| *to += v);
                }
            }
        }
    }
}

/// The matrix was not positive definite, or what a front leaves does not fit into memory.
struct NoFactor;

impl Tree {
    /// The numbers of the factor; false where the matrix is not positive definite or memory is short.
    pub fn factor(
        &self,
        matrix: &[f64],
        (factor, room): (&mut [f64], &Room),
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
            let mut rests = Rests { list: Vec::new(), free: room };
            for (s, columns) in own.iter_mut() {
                self.eliminate(*s, matrix, columns, &mut rests, regularization, Par::Seq)?;
            }
            Ok(rests.list.pop())
        };
        let alone = || pieces.iter().map(&one).collect();
        #[cfg(feature = "threads")]
        let done: Result<Vec<Option<Rest>>, NoFactor> = match threads.degree() {
            1 => alone(),
            many => crate::parallel::try_map(many, &pieces, one).unwrap_or_else(|_| alone()),
        };
        #[cfg(not(feature = "threads"))]
        let done: Result<Vec<Option<Rest>>, NoFactor> = alone();
        let Ok(mut done) = done else { return false };
        let mut rests = Rests { list: Vec::new(), free: room };
        self.above.iter().all(|&s| {
            if let Some(piece) = self.piece[s] {
                rests.list.extend(done[piece].take());
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
        rests: &mut Rests<'_>,
        regularization: LltRegularization<f64>,
        threads: Par,
    ) -> Result<(), NoFactor> {
        let front = &self.list[s];
        let (width, size) = (front.width, front.size);
        let below = size - width;
        let mut place = rests.place(below * below)?;
        let rest = &mut place[..below * below];
        let children = rests.list.split_off(rests.list.len() - front.children);
        let gather = |mut strip: Strip<'_>| {
            strip.clear();
            for child in &children {
                let from = &self.list[child.of];
                strip.add(&child.lower, from.size - from.width, &from.into);
            }
        };
        let own = Strip { first: 0, row: 0, size, values: &mut *columns };
        let others = Strip { first: width, row: width, size: below, values: &mut *rest };
        match threads.degree() {
            1 => [own, others].into_iter().for_each(gather),
            many => on_threads([own, others], many, gather),
        }
        rests.give(children);
        for &(e, at) in &front.entries {
            columns[at] += matrix[e];
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
            MatMut::from_column_major_slice_mut(rest, below, below),
            BlockStructure::TriangularLower,
            Accum::Add,
            lower.rb(),
            BlockStructure::Rectangular,
            lower.rb().transpose(),
            BlockStructure::Rectangular,
            -1.0,
            threads,
        );
        rests.list.push(Rest { of: s, lower: place });
        Ok(())
    }
}

/// Strips in narrower ones, each by itself.
#[cfg(feature = "threads")]
fn on_threads(strips: [Strip<'_>; 2], threads: usize, work: impl Fn(Strip<'_>) + Sync + Send) {
    // The first columns of a triangle have more numbers than the last.
    let mut narrow = Vec::new();
    for Strip { first, row, size, values } in strips {
        let columns = (values.len() / size.max(1)).div_ceil(4 * threads).max(1);
        let parts = values.chunks_mut((columns * size).max(1)).enumerate();
        narrow.extend(parts.map(|(k, values)| Strip {
            first: first + k * columns,
            row,
            size,
            values,
        }));
    }
    crate::parallel::small(narrow, work);
}

#[cfg(not(feature = "threads"))]
fn on_threads(strips: [Strip<'_>; 2], _: usize, work: impl Fn(Strip<'_>)) {
    strips.into_iter().for_each(work);
}
