//! Solution with the factors of [`super::fronts`]: subtrees are independent here as there. Forward, each
//! hands what it takes from the rows above on to them; backward, it reads those rows.
//!
//! Here and not faer's: that goes through general products of matrices for every supernode, most of
//! which have a handful of columns, and on one thread.

use super::tree::Tree;
use faer::{Par, perm::PermRef, sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky};
use std::sync::{Mutex, PoisonError};

/// Numbers of a factor from which subtrees are shared out. Fewer: threads are started for less than
/// they cost. More: one thread does what two do in half of the time.
const SHARED: usize = 300_000;

/// Numbers of a panel from which its rows or columns are shared out. Fewer: threads wait for each other
/// longer than they work.
const PANEL: usize = 100_000;

/// How to solve with the factors of one pattern.
pub struct Substitution {
    pieces: Vec<Mutex<Part>>,
    above: Mutex<Part>,
    /// Whether panels above are shared out.
    shares: bool,
}

/// Some of the columns of a factor, in the order of elimination, and the rows that they reach.
struct Part {
    /// Where its rows are in the whole: its own columns, and then rows of other parts.
    rows: Vec<usize>,
    own: usize,
    panels: Vec<Panel>,
    /// Values at its rows, and of one panel.
    values: Vec<f64>,
    work: Vec<f64>,
}

/// Columns with one pattern.
struct Panel {
    first: usize,
    width: usize,
    /// Where its numbers begin in the factor.
    at: usize,
    /// Rows below its own, in its part.
    below: Vec<usize>,
}

impl Substitution {
    pub fn new(
        tree: &Tree,
        symbolic: &SymbolicSupernodalCholesky<usize>,
        order: Option<PermRef<'_, usize>>,
        size: usize,
    ) -> Self {
        let old = |new: usize| order.map_or(new, |p| p.arrays().0[new]);
        // Where a row is in the part at hand; no row is elsewhere in it.
        let mut place = vec![usize::MAX; size];
        let mut part = |list: &[usize]| {
            let (begin, end) = (symbolic.supernode_begin(), symbolic.supernode_end());
            let mut rows: Vec<usize> = list.iter().flat_map(|&s| begin[s]..end[s]).collect();
            let own = rows.len();
            rows.iter().enumerate().for_each(|(k, &row)| place[row] = k);
            let panels = list
                .iter()
                .map(|&s| {
                    let mut local = |&row: &usize| {
                        if place[row] == usize::MAX {
                            place[row] = rows.len();
                            rows.push(row);
                        }
                        place[row]
                    };
                    Panel {
                        first: local(&begin[s]),
                        width: end[s] - begin[s],
                        at: symbolic.col_ptr_for_val()[s],
                        below: symbolic.supernode(s).pattern().iter().map(local).collect(),
                    }
                })
                .collect();
            for row in &mut rows {
                place[*row] = usize::MAX;
                *row = old(*row);
            }
            Mutex::new(Part { rows, own, panels, values: Vec::new(), work: Vec::new() })
        };
        let pieces = tree.pieces().map(&mut part).collect();
        let above: Vec<usize> = tree.above().collect();
        let above = part(&above);
        let shares = lock(&above).panels.iter().any(|panel| panel.near() < panel.size());
        Self { pieces, above, shares }
    }

    /// Solves in place. Sums are taken in one order: the same bits on any number of threads.
    pub fn solve(&self, factor: &[f64], x: &mut [f64], threads: Par) {
        self.on_pieces(factor, threads, |part| {
            part.read(x);
            part.values[part.own..].fill(0.0);
            part.forward(factor, 1);
        });
        for part in &self.pieces {
            let part = lock(part);
            for (k, (&row, value)) in part.rows.iter().zip(&part.values).enumerate() {
                if k < part.own {
                    x[row] = *value;
                } else {
                    x[row] += value;
                }
            }
        }
        let inside = if self.shares { threads.degree() } else { 1 };
        in_pool(inside, || {
            let mut above = lock(&self.above);
            above.read(x);
            above.forward(factor, inside);
            above.backward(factor, inside);
            above.write(x);
        });
        self.on_pieces(factor, threads, |part| {
            part.read(x);
            part.backward(factor, 1);
        });
        self.pieces.iter().for_each(|part| lock(part).write(x));
    }

    fn on_pieces(&self, factor: &[f64], threads: Par, work: impl Fn(&mut Part) + Sync) {
        let one = |part: &Mutex<Part>| work(&mut lock(part));
        // Where not all threads can be started, what was done is done once more.
        let alone = || self.pieces.iter().for_each(one);
        let many = if factor.len() > SHARED { threads.degree() } else { 1 };
        #[cfg(feature = "threads")]
        if many > 1 {
            return crate::parallel::map(many, &self.pieces, one).map_or_else(|_| alone(), drop);
        }
        debug_assert_eq!(many, 1, "threads come with the solvers");
        alone();
    }
}

/// Does the work on a thread of the pool where it shares something out: from there that takes
/// microseconds, from elsewhere tens of them.
fn in_pool(threads: usize, work: impl FnOnce() + Send) {
    #[cfg(feature = "threads")]
    if threads > 1 {
        return crate::parallel::in_pool(work);
    }
    debug_assert_eq!(threads, 1, "threads come with the solvers");
    work();
}

/// A part belongs to one thread at a time.
fn lock(part: &Mutex<Part>) -> std::sync::MutexGuard<'_, Part> {
    part.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Part {
    fn read(&mut self, x: &[f64]) {
        self.values.clear();
        self.values.extend(self.rows.iter().map(|&row| x[row]));
    }

    fn write(&self, x: &mut [f64]) {
        self.rows.iter().zip(&self.values).take(self.own).for_each(|(&row, v)| x[row] = *v);
    }

    /// With the lower triangle, from the first column on.
    fn forward(&mut self, factor: &[f64], threads: usize) {
        let Self { panels, values, work, .. } = self;
        for panel in panels {
            let (width, near) = (panel.width, panel.near());
            let own = &mut values[panel.first..panel.first + width];
            work.clear();
            work.extend_from_slice(own);
            work.resize(panel.size(), 0.0);
            let columns = panel.columns(factor);
            let (here, far) = work.split_at_mut(near);
            for (k, column) in columns.clone().enumerate() {
                let (done, left) = here.split_at_mut(k + 1);
                let value = done[k] / column[k];
                done[k] = value;
                less(left, value, &column[k + 1..near]);
            }
            let done = &here[..width];
            shared_out(far, threads, |first, far| {
                let rows = near + first..near + first + far.len();
                for (value, column) in done.iter().zip(columns.clone()) {
                    less(far, *value, &column[rows.clone()]);
                }
            });
            own.copy_from_slice(&work[..width]);
            panel.below.iter().zip(&work[width..]).for_each(|(&row, w)| values[row] += w);
        }
    }

    /// With its transpose, from the last column on.
    fn backward(&mut self, factor: &[f64], threads: usize) {
        let Self { panels, values, work, .. } = self;
        for panel in panels.iter().rev() {
            let (width, near) = (panel.width, panel.near());
            let own = panel.first..panel.first + width;
            work.clear();
            work.extend_from_slice(&values[own.clone()]);
            work.extend(panel.below.iter().map(|&row| values[row]));
            let columns = panel.columns(factor);
            let (here, far) = work.split_at_mut(near);
            if !far.is_empty() {
                shared_out(&mut here[..width], threads, |first, own| {
                    for (value, column) in own.iter_mut().zip(columns.clone().skip(first)) {
                        *value -= product(&column[near..], far);
                    }
                });
            }
            for (k, column) in columns.enumerate().rev() {
                let (own, known) = here.split_at_mut(k + 1);
                own[k] = (own[k] - product(&column[k + 1..near], known)) / column[k];
            }
            values[own].copy_from_slice(&here[..width]);
        }
    }
}

impl Panel {
    /// Its rows.
    fn size(&self) -> usize {
        self.width + self.below.len()
    }

    /// How many of its rows are done on one thread: its own, or all of them where it is small.
    fn near(&self) -> usize {
        if self.width * self.below.len() < PANEL { self.size() } else { self.width }
    }

    /// Its columns of the factor.
    fn columns<'a>(&self, factor: &'a [f64]) -> std::slice::ChunksExact<'a, f64> {
        factor[self.at..self.at + self.width * self.size()].chunks_exact(self.size())
    }
}

/// Does the work on as many neighbouring parts of a list as there are threads, each with where it begins.
fn shared_out(list: &mut [f64], threads: usize, work: impl Fn(usize, &mut [f64]) + Sync + Send) {
    if list.is_empty() {
        return;
    }
    #[cfg(feature = "threads")]
    if threads > 1 {
        let size = list.len().div_ceil(threads);
        let parts = list.chunks_mut(size).enumerate().collect();
        return crate::parallel::small(parts, |(k, part)| work(k * size, part));
    }
    debug_assert_eq!(threads, 1, "threads come with the solvers");
    work(0, list);
}

/// `to − by × column`.
fn less(to: &mut [f64], by: f64, column: &[f64]) {
    to.iter_mut().zip(column).for_each(|(to, l)| *to -= by * l);
}

/// The scalar product, summed in lanes so that the processor takes several at once.
fn product(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut sums = [0.0; LANES];
    let ((a, last_a), (b, last_b)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    for (a, b) in a.iter().zip(b) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    let last: f64 = last_a.iter().zip(last_b).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + last
}
