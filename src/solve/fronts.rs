//! Complete factors of square matrices in blocks of 6 × 6, front by front (Duff & Reid 1983): every
//! front gathers its own rows and what its children leave of theirs in one dense matrix, so that all
//! work is products of dense matrices.
//!
//! Pivots are chosen within the panels of a front alone, and factors have single precision: they serve
//! [`Blocks::solve`], which finds what they miss. Those in double precision are in `lu/fronts.rs`: in their
//! place here they take a fifth more time and memory (2,870 spheres at μ = 0.5) and lose heaps (at μ = 0.6);
//! with the dense factors of `faer` in single precision the Python package gets too large.

use super::{
    Pattern,
    krylov::{Blocks, Factors},
};
use cholesky::dissected;
use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

/// Rows that are eliminated at a time. More: pivots, which are slow. Fewer: thin products.
const PANEL: usize = 96;
/// Fronts are joined where no more than this share of their entries is zero. More: work on zeros.
/// Less: small products.
const ZEROS: f64 = 0.2;

/// Factors of matrices of one pattern.
pub struct Fronts {
    /// Block rows in the order of elimination, and where each stands in it.
    order: Vec<usize>,
    place: Vec<usize>,
    list: Vec<Front>,
    /// Whether there are factors.
    pub ready: bool,
}

struct Front {
    first: usize,
    width: usize,
    /// The rows beyond its own.
    rows: Vec<usize>,
    children: Vec<usize>,
    lower: DMatrix<f32>,
    upper: DMatrix<f32>,
}

impl Fronts {
    /// Prepares a pattern of whole blocks; nothing where no order is found.
    pub fn new(pattern: &Pattern, matrix: &Blocks) -> Option<Self> {
        let (rows, _) = dissected(pattern)?;
        let order: Vec<usize> = rows.iter().step_by(6).map(|r| r / 6).collect();
        // Parents behind their children, one family after the other.
        let parent = parents(matrix, &order);
        let post = postorder(&parent);
        let order: Vec<usize> = post.iter().map(|&k| order[k]).collect();
        let parent = parents(matrix, &order);
        let place = inverse(&order);
        let below = below(matrix, &order, &place, &parent);
        let mut list: Vec<Front> = Vec::new();
        let (mut of, mut zeros) = (vec![0; order.len()], 0);
        for k in 0..order.len() {
            let size = below[k].len() + 1;
            let joined = list.last_mut().filter(|_| parent[k - 1] == k).and_then(|front| {
                let more = zeros + front.width * (size - below[k - 1].len());
                let all = (front.width + 1) * (size + front.width);
                (more as f64 <= ZEROS * all as f64).then_some((front, more))
            });
            if let Some((front, more)) = joined {
                front.width += 1;
                zeros = more;
            } else {
                zeros = 0;
                let (lower, upper) = (DMatrix::zeros(0, 0), DMatrix::zeros(0, 0));
                let (rows, children) = (Vec::new(), Vec::new());
                list.push(Front { first: k, width: 1, rows, children, lower, upper });
            }
            of[k] = list.len() - 1;
        }
        for f in 0..list.len() {
            let last = list[f].first + list[f].width - 1;
            list[f].rows.clone_from(&below[last]);
            if let Some(&parent) = of.get(parent[last]) {
                list[parent].children.push(f);
            }
        }
        Some(Self { order, place, list, ready: false })
    }

    /// Factors a matrix of the pattern; false where a pivot is singular.
    pub fn factor(&mut self, matrix: &Blocks) -> bool {
        self.ready = false;
        let mut rests: Vec<Option<DMatrix<f32>>> = vec![None; self.list.len()];
        let mut at = vec![0; self.order.len()];
        for s in 0..self.list.len() {
            let (before, here) = self.list.split_at_mut(s);
            let front = &mut here[0];
            let end = front.first + front.width;
            (front.first..end)
                .chain(front.rows.iter().copied())
                .enumerate()
                .for_each(|(k, r)| at[r] = k);
            let own = 6 * front.width;
            let size = own + 6 * front.rows.len();
            let mut m = DMatrix::<f32>::zeros(size, size);
            for k in 0..front.width {
                let row = self.order[front.first + k];
                for e in matrix.starts[row]..matrix.starts[row + 1] {
                    let column = self.place[matrix.columns[e]];
                    if column >= front.first {
                        put(&mut m, k, at[column], &matrix.values[e]);
                    }
                    if column >= end {
                        let mirrored = matrix.place(matrix.columns[e], row);
                        put(&mut m, at[column], k, &matrix.values[mirrored]);
                    }
                }
            }
            for &child in &front.children {
                if let Some(rest) = rests[child].take() {
                    add(&mut m, &rest, before[child].rows.iter().map(|&r| 6 * at[r]).collect());
                }
            }
            for k in (0..own).step_by(PANEL) {
                let width = PANEL.min(own - k);
                let (next, rest) = (k + width, size - k - width);
                let pivot = m.view((k, k), (width, width)).clone_owned();
                let Some(pivot) = pivot.try_inverse() else { return false };
                let lower = m.view((next, k), (rest, width)) * &pivot;
                let upper = m.view((k, next), (width, rest)).clone_owned();
                m.view_mut((next, next), (rest, rest)).gemm(-1.0, &lower, &upper, 1.0);
                m.view_mut((k, k), (width, width)).copy_from(&pivot);
                m.view_mut((next, k), (rest, width)).copy_from(&lower);
            }
            rests[s] = Some(m.view((own, own), (size - own, size - own)).clone_owned());
            front.upper = m.view((0, own), (own, size - own)).clone_owned();
            front.lower = m.resize_horizontally(own, 0.0);
        }
        self.ready = true;
        true
    }
}

impl Factors for Fronts {
    fn solve(&self, x: &mut [Vector6<f64>]) {
        let mut y: Vec<f32> =
            self.order.iter().flat_map(|&k| x[k].map(|v| v as f32).data.0[0]).collect();
        for front in &self.list {
            let own = 6 * front.width;
            let mut v = front.gather(&y);
            for k in (0..own).step_by(PANEL) {
                let width = PANEL.min(own - k);
                let (next, rest) = (k + width, v.len() - k - width);
                let solved = v.rows(k, width).clone_owned();
                let lower = front.lower.view((next, k), (rest, width));
                v.rows_mut(next, rest).gemv(-1.0, &lower, &solved, 1.0);
            }
            front.scatter(&v, &mut y);
        }
        for front in self.list.iter().rev() {
            let own = 6 * front.width;
            let mut v = front.gather(&y);
            let beyond = v.rows(own, v.len() - own).clone_owned();
            v.rows_mut(0, own).gemv(-1.0, &front.upper, &beyond, 1.0);
            for k in (0..own).step_by(PANEL).rev() {
                let width = PANEL.min(own - k);
                let (next, rest) = (k + width, own - k - width);
                let mut right = v.rows(k, width).clone_owned();
                right.gemv(
                    -1.0,
                    &front.lower.view((k, next), (width, rest)),
                    &v.rows(next, rest),
                    1.0,
                );
                let solved = front.lower.view((k, k), (width, width)) * right;
                v.rows_mut(k, width).copy_from(&solved);
            }
            front.scatter(&v, &mut y);
        }
        for (&k, y) in self.order.iter().zip(y.chunks_exact(6)) {
            x[k] = Vector6::from_fn(|i, _| f64::from(y[i]));
        }
    }
}

impl Front {
    fn all(&self) -> impl Iterator<Item = usize> {
        (self.first..self.first + self.width).chain(self.rows.iter().copied())
    }

    fn gather(&self, y: &[f32]) -> DVector<f32> {
        let values: Vec<f32> =
            self.all().flat_map(|r| y[6 * r..6 * r + 6].iter().copied()).collect();
        DVector::from_vec(values)
    }

    fn scatter(&self, v: &DVector<f32>, y: &mut [f32]) {
        for (r, v) in self.all().zip(v.as_slice().chunks_exact(6)) {
            y[6 * r..6 * r + 6].copy_from_slice(v);
        }
    }
}

fn put(m: &mut DMatrix<f32>, row: usize, column: usize, block: &Matrix6<f64>) {
    m.view_mut((6 * row, 6 * column), (6, 6)).copy_from(&block.map(|v| v as f32));
}

/// Adds what a child leaves, whose blocks stand there.
fn add(m: &mut DMatrix<f32>, rest: &DMatrix<f32>, to: Vec<usize>) {
    for (j, from) in rest.column_iter().enumerate() {
        let mut column = m.column_mut(to[j / 6] + j % 6);
        let column = column.as_mut_slice();
        for (to, from) in to.iter().zip(from.as_slice().chunks_exact(6)) {
            column[*to..to + 6].iter_mut().zip(from).for_each(|(a, b)| *a += b);
        }
    }
}

fn inverse(order: &[usize]) -> Vec<usize> {
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(new, &old)| place[old] = new);
    place
}

/// The elimination tree (Liu 1990): of each row the first one that it is eliminated into, or what is no
/// row.
fn parents(matrix: &Blocks, order: &[usize]) -> Vec<usize> {
    let none = usize::MAX;
    let (mut parent, mut top) = (vec![none; order.len()], vec![none; order.len()]);
    let place = inverse(order);
    for (k, &row) in order.iter().enumerate() {
        for &c in &matrix.columns[matrix.starts[row]..matrix.starts[row + 1]] {
            let mut j = place[c];
            while j < k {
                let next = std::mem::replace(&mut top[j], k);
                if next == none {
                    parent[j] = k;
                }
                j = next;
            }
        }
    }
    parent
}

fn children(parent: &[usize]) -> Vec<Vec<usize>> {
    let mut list = vec![Vec::new(); parent.len() + 1];
    parent.iter().enumerate().for_each(|(k, &p)| list[p.min(parent.len())].push(k));
    list
}

fn postorder(parent: &[usize]) -> Vec<usize> {
    let children = children(parent);
    let mut order = Vec::with_capacity(parent.len());
    let mut stack = vec![parent.len()];
    // Parents first, and then all of it backwards.
    while let Some(k) = stack.pop() {
        order.push(k);
        stack.extend(&children[k]);
    }
    order.reverse();
    order.pop();
    order
}

/// Of each row, in the order of elimination, the later ones that its column has.
fn below(matrix: &Blocks, order: &[usize], place: &[usize], parent: &[usize]) -> Vec<Vec<usize>> {
    let children = children(parent);
    let mut below: Vec<Vec<usize>> = Vec::with_capacity(order.len());
    for (k, &row) in order.iter().enumerate() {
        let own =
            matrix.columns[matrix.starts[row]..matrix.starts[row + 1]].iter().map(|&c| place[c]);
        let from = children[k].iter().flat_map(|&c| below[c].iter().copied());
        let mut rows: Vec<usize> = own.chain(from).filter(|&r| r > k).collect();
        rows.sort_unstable();
        rows.dedup();
        below.push(rows);
    }
    below
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A lattice of blocks in space, unsymmetric and not definite: its pattern, the values below and above
    /// the diagonal, some numbers, and what it makes of them.
    pub fn lattice() -> (Pattern, [Vec<f64>; 2], [Vec<f64>; 2]) {
        let side = 5;
        let n = side * side * side;
        let mut pattern = Pattern { starts: vec![0], rows: Vec::new() };
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for k in 0..n {
            let steps = [(1, k), (side, k / side), (side * side, k / (side * side))];
            let others: Vec<usize> =
                steps.iter().filter(|s| s.1 % side + 1 < side).map(|s| k + s.0).collect();
            for c in 0..6 {
                let own = 6 * k + c;
                for row in (own..6 * k + 6).chain(others.iter().flat_map(|o| 6 * o..6 * o + 6)) {
                    let value = ((row * 7 + own * 3) % 11) as f64 / 30.0;
                    let diagonal = if k % 3 == 0 { -3.0 } else { 3.0 };
                    pattern.rows.push(row);
                    lower.push(if row == own { diagonal } else { -value });
                    upper.push(if row == own { diagonal } else { 0.5 * value });
                }
                pattern.starts.push(pattern.rows.len());
            }
        }
        let x: Vec<f64> = (0..6 * n).map(|i| (i % 13) as f64 - 6.0).collect();
        let mut right = vec![0.0; 6 * n];
        for column in 0..6 * n {
            for e in pattern.starts[column]..pattern.starts[column + 1] {
                let row = pattern.rows[e];
                right[row] += lower[e] * x[column];
                if row != column {
                    right[column] += upper[e] * x[row];
                }
            }
        }
        (pattern, [lower, upper], [x, right])
    }

    #[test]
    fn what_was_multiplied_comes_back() {
        let (pattern, [lower, upper], [x, right]) = lattice();
        let right: Vec<Vector6<f64>> =
            right.chunks_exact(6).map(Vector6::from_column_slice).collect();
        let matrix = Blocks::new(&pattern, &lower, &upper);
        let mut fronts = Fronts::new(&pattern, &matrix).unwrap();
        assert!(!fronts.ready);
        assert!(fronts.factor(&matrix));
        assert!(fronts.ready);
        // Single precision leaves little to find.
        let got = matrix.solve(&fronts, &right, 1e-12, 12).unwrap();
        for (a, b) in got.iter().zip(x.chunks_exact(6)) {
            assert!((a - Vector6::from_column_slice(b)).norm() < 1e-8, "{a} {b:?}");
        }
    }
}
