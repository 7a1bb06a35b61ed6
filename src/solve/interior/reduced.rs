//! The reduced system: equilibrium of the blocks on springs.
//!
//! Eliminating the cone rows and then the local variables from the Newton system of an
//! interior-point method leaves `S = E K⁻¹ Eᵀ` with `K = P + Gᵀ W⁻² G`, block-diagonal: the
//! stiffness matrix of the blocks where every contact is a spring of stiffness `K⁻¹`. It has the
//! sparsity of the contact graph; a supernodal Cholesky factorisation with a fill-reducing ordering
//! is all that an iteration costs.

use super::{
    cones::{Cones, MOST_ROWS},
    panels::by_rows,
    structure::Structure,
};
use cholesky::{Cholesky, Pattern};

/// A pivot below this × the diagonal it started from is rounding: it is replaced by 1. Larger:
/// flexible structures are held where they should move. Smaller: rounding becomes motion.
const LEAST_PIVOT: f64 = 1e-15;

/// Added to every scaled diagonal entry (each is 1). Larger: more corrections a solve. Smaller:
/// more pivots that are rounding.
const DIAGONAL: f64 = 1e-14;

/// The reduced system of a program and its factors.
pub(super) struct Reduced {
    /// Where the lower triangle of each panel's springs goes, row by row, one panel after the
    /// other.
    places: Vec<usize>,
    /// `F` with `K⁻¹ = F Fᵀ` of each block, column by column.
    roots: Vec<f64>,
    root_start: Vec<usize>,
    /// The lower triangle.
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
    /// Square roots of the diagonal, inverted.
    jacobi: Vec<f64>,
    /// Added to the diagonal of `K`; zero but where forces would grow without bound ([`super::path`]).
    pub proximal: f64,
    cholesky: Cholesky,
}

impl Reduced {
    /// Finds the pattern and an ordering; `None` where there is not enough memory.
    pub fn new(structure: &Structure) -> Option<Self> {
        let rows = structure.equalities.len();
        let panels = || structure.e.list.iter().map(|panel| structure.e.rows(panel));
        let mut columns: Vec<Vec<usize>> = (0..rows).map(|i| vec![i]).collect();
        for own in panels() {
            for (k, &j) in own.iter().enumerate() {
                columns[j].extend_from_slice(&own[k + 1..]);
            }
        }
        let mut starts = vec![0];
        let mut row = Vec::new();
        for column in &mut columns {
            column.sort_unstable();
            column.dedup();
            row.append(column);
            starts.push(row.len());
        }
        let mut places = Vec::new();
        for own in panels() {
            for (k, i) in own.iter().enumerate() {
                let place = |&j: &usize| {
                    starts[j] + row[starts[j]..starts[j + 1]].partition_point(|r| r < i)
                };
                places.extend(own[..=k].iter().map(place));
            }
        }
        let mut root_start = vec![0];
        for block in &structure.blocks {
            root_start.push(root_start[root_start.len() - 1] + block.variables.len().pow(2));
        }
        Some(Self {
            places,
            roots: vec![0.0; root_start[root_start.len() - 1]],
            root_start,
            values: vec![0.0; row.len()],
            jacobi: vec![0.0; rows],
            proximal: 0.0,
            cholesky: Cholesky::new(Pattern { starts: starts.clone(), rows: row.clone() })?,
            starts,
            rows: row,
        })
    }

    /// Builds the system for a scaling and factors it; false where that fails.
    pub fn factor(&mut self, structure: &Structure, cones: &Cones) -> bool {
        let mut scratch = Vec::new();
        for (index, block) in structure.blocks.iter().enumerate() {
            let root = &mut self.roots[self.root_start[index]..self.root_start[index + 1]];
            let n = block.variables.len();
            if block.plain && self.proximal == 0.0 {
                let cone = &structure.cones[block.cones[0]];
                for k in 0..n {
                    cones.column(cone, k, false, &mut root[k * n..(k + 1) * n]);
                }
            } else if !root_of(structure, cones, index, self.proximal, &mut scratch, root) {
                return false;
            }
        }
        self.values.fill(0.0);
        let (mut sum, mut spring) = (Vec::new(), Vec::new());
        let mut places = self.places.iter();
        for panel in &structure.e.list {
            let (r, mut values) = (structure.e.rows(panel).len(), structure.e.values(panel));
            sum.clear();
            sum.resize(r * r, 0.0);
            spring.resize(r, 0.0);
            for index in panel.blocks.clone() {
                let root = &self.roots[self.root_start[index]..self.root_start[index + 1]];
                let n = structure.blocks[index].variables.len();
                let (own, others) = values.split_at(n * r);
                values = others;
                by_rows!(r, add_springs(own, root, &mut spring, &mut sum));
            }
            for j in 0..r {
                for (v, &p) in sum[j * r..=j * r + j].iter().zip(places.by_ref()) {
                    self.values[p] += v;
                }
            }
        }
        self.decompose()
    }

    fn decompose(&mut self) -> bool {
        for (scale, &first) in self.jacobi.iter_mut().zip(&self.starts) {
            // The diagonal is the first of its column.
            let d = self.values[first];
            if !d.is_finite() {
                return false;
            }
            *scale = if d > 0.0 { 1.0 / d.sqrt() } else { 1.0 };
        }
        for (j, own) in self.jacobi.iter().enumerate() {
            let column = self.starts[j]..self.starts[j + 1];
            for (value, &i) in self.values[column.clone()].iter_mut().zip(&self.rows[column]) {
                *value *= self.jacobi[i] * own;
            }
            self.values[self.starts[j]] += DIAGONAL;
        }
        self.cholesky.factorize_above(&self.values, LEAST_PIVOT)
    }

    /// `S⁻¹ v` in place, up to rounding.
    pub fn solve(&mut self, v: &mut [f64]) {
        v.iter_mut().zip(&self.jacobi).for_each(|(v, j)| *v *= j);
        self.cholesky.solve(v);
        v.iter_mut().zip(&self.jacobi).for_each(|(v, j)| *v *= j);
    }

    /// `K⁻¹ v` in place.
    pub fn flex(&self, structure: &Structure, v: &mut [f64]) {
        if self.roots.len() == v.len() {
            // One variable a block.
            v.iter_mut().zip(&self.roots).for_each(|(v, root)| *v *= root * root);
            return;
        }
        let mut part = [0.0; MOST_ROWS];
        for (index, block) in structure.blocks.iter().enumerate() {
            let root = &self.roots[self.root_start[index]..self.root_start[index + 1]];
            let n = block.variables.len();
            let v = &mut v[block.variables.clone()];
            if n == 1 {
                v[0] *= root[0] * root[0];
                continue;
            }
            for (c, part) in part[..n].iter_mut().enumerate() {
                *part = root[c * n..(c + 1) * n].iter().zip(v.iter()).map(|(a, b)| a * b).sum();
            }
            v.fill(0.0);
            for (c, part) in part[..n].iter().enumerate() {
                v.iter_mut().zip(&root[c * n..(c + 1) * n]).for_each(|(v, r)| *v += r * part);
            }
        }
    }
}

/// Adds `E F (E F)ᵀ` of one block of variables, whose panel has `R` rows (0: as many as `spring`),
/// to `sum`.
fn add_springs<const R: usize>(own: &[f64], root: &[f64], spring: &mut [f64], sum: &mut [f64]) {
    let r = if R == 0 { spring.len() } else { R };
    let (n, spring) = (own.len() / r.max(1), &mut spring[..r]);
    for c in 0..n {
        spring.fill(0.0);
        for k in 0..n {
            let (column, f) = (&own[k * r..(k + 1) * r], root[c * n + k]);
            spring.iter_mut().zip(column).for_each(|(s, v)| *s += v * f);
        }
        for j in 0..r {
            let by = spring[j];
            sum[j * r..(j + 1) * r].iter_mut().zip(spring.iter()).for_each(|(s, v)| *s += by * v);
        }
    }
}

/// `R⁻¹` of the QR decomposition of `(W⁻¹ G; √P)`: with `K` itself, half of the digits would be
/// lost near the boundary of a cone. False where some variable is held by nothing.
fn root_of(
    structure: &Structure,
    cones: &Cones,
    index: usize,
    proximal: f64,
    q: &mut Vec<f64>,
    root: &mut [f64],
) -> bool {
    let block = &structure.blocks[index];
    let (first, n) = (block.variables.start, block.variables.len());
    let rows: usize = block.cones.iter().map(|&c| structure.cones[c].size).sum::<usize>() + n;
    q.clear();
    q.resize(rows * n, 0.0);
    let mut at = 0;
    let mut scaled = [0.0; MOST_ROWS];
    for &cone in &block.cones {
        let cone = &structure.cones[cone];
        for k in 0..n {
            for (row, v) in structure.g.of(first + k) {
                if row >= cone.first && row < cone.first + cone.size {
                    cones.column(cone, row - cone.first, true, &mut scaled[..cone.size]);
                    for (t, s) in scaled[..cone.size].iter().enumerate() {
                        q[k * rows + at + t] += v * s;
                    }
                }
            }
        }
        at += cone.size;
    }
    for k in 0..n {
        let own = structure.quadratic.get(first + k).copied().unwrap_or(0.0);
        q[k * rows + at + k] = (own + proximal).sqrt();
    }
    // Gram and Schmidt, modified, twice; R upper triangular, column by column.
    let mut r = [0.0; MOST_ROWS * MOST_ROWS];
    for k in 0..n {
        for _ in 0..2 {
            for i in 0..k {
                let (a, b) = q.split_at_mut(k * rows);
                let (a, b) = (&a[i * rows..(i + 1) * rows], &mut b[..rows]);
                let dot: f64 = a.iter().zip(b.iter()).map(|(a, b)| a * b).sum();
                r[k * n + i] += dot;
                b.iter_mut().zip(a).for_each(|(b, a)| *b -= dot * a);
            }
        }
        let own = &mut q[k * rows..(k + 1) * rows];
        let norm = own.iter().map(|v| v * v).sum::<f64>().sqrt();
        if !(norm > 0.0 && norm.is_finite()) {
            return false;
        }
        r[k * n + k] = norm;
        own.iter_mut().for_each(|v| *v /= norm);
    }
    // K = Rᵀ R, so F = R⁻¹: back substitution, column by column.
    root.fill(0.0);
    for c in 0..n {
        root[c * n + c] = 1.0 / r[c * n + c];
        for i in (0..c).rev() {
            let sum: f64 = (i + 1..=c).map(|k| r[k * n + i] * root[c * n + k]).sum();
            root[c * n + i] = -sum / r[i * n + i];
        }
    }
    true
}
