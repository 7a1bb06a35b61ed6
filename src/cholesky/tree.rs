//! The elimination tree of a pattern in fronts: dense matrices, each of the columns of a supernode and
//! of what it leaves to its parent (Duff & Reid 1983). Order, supernodes and the place of every number
//! are faer's.

use super::Pattern;
use faer::{perm::PermRef, sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky};

/// A subtree with at most one of so many parts of all work is one piece. Fewer: threads that wait for
/// the last one. More: small fronts that are done alone.
const PIECES: f64 = 32.0;

/// What is known of the factors of one pattern before there are numbers.
pub struct Tree {
    /// Children before their parents.
    pub list: Vec<Front>,
    /// Subtrees that are done by themselves, the longest first; each in the order of elimination.
    pub pieces: Vec<Vec<usize>>,
    /// The last fronts of the pieces, and what is above them, in the order of elimination.
    pub above: Vec<usize>,
    /// Of each front the piece of which it is the last.
    pub piece: Vec<Option<usize>>,
}

/// One front.
pub struct Front {
    /// Columns of its own.
    pub width: usize,
    /// Rows of its own and below.
    pub size: usize,
    /// How many fronts leave something to it.
    pub children: usize,
    /// Where its rows below its own are in its parent's, from the first on.
    pub into: Vec<Run>,
    /// Which entries of the matrix belong to its own columns, and where.
    pub entries: Vec<(usize, usize)>,
    /// Numbers of a symmetric factor that it has.
    pub count: usize,
    /// Operations of a symmetric factor.
    pub work: f64,
}

/// Rows beyond those that a front has of its own, counted from the first of them, that are neighbours
/// in its parent, too: all of the parent's own, or none.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Run {
    pub from: usize,
    pub to: usize,
    pub count: usize,
}

/// Runs of rows with these places in a parent with so many rows of its own.
fn runs(places: impl Iterator<Item = usize>, width: usize) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (from, to) in places.enumerate() {
        match runs.last_mut().filter(|run| run.to + run.count == to && to != width) {
            Some(run) => run.count += 1,
            None => runs.push(Run { from, to, count: 1 }),
        }
    }
    runs
}

impl Tree {
    /// Of the supernodes of a pattern, in their order.
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
                    .map(|p| runs(rows(s).iter().map(|&row| place(p, row)), end[p] - begin[p]))
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
