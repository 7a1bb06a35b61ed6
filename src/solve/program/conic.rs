//! A conic program without an engine: `min ½ xᵀ diag(p) x + cᵀx` subject to `b − G x ∈ K`.

/// A sparse matrix as a list of entries (row, column, value); equal places add up.
#[derive(Clone, Debug, Default)]
pub struct Sparse {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Row of each entry.
    pub i: Vec<usize>,
    /// Column of each entry.
    pub j: Vec<usize>,
    /// Value of each entry.
    pub v: Vec<f64>,
}

impl Sparse {
    /// An empty matrix of the given shape.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, ..Self::default() }
    }

    /// Adds `value` at (`row`, `column`).
    pub fn push(&mut self, row: usize, column: usize, value: f64) {
        if value != 0.0 {
            self.i.push(row);
            self.j.push(column);
            self.v.push(value);
        }
    }

    /// `y += s · M x`.
    pub fn multiply_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        for ((&i, &j), &v) in self.i.iter().zip(&self.j).zip(&self.v) {
            y[i] += s * v * x[j];
        }
    }
}

/// A cone on consecutive rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cone {
    /// `s = 0`, this many rows.
    Zero(usize),
    /// `s ≥ 0`, this many rows.
    NonNegative(usize),
    /// `s₀ ≥ ‖s₁…‖`, one cone of this many rows.
    SecondOrder(usize),
}

impl Cone {
    /// Number of rows.
    pub fn rows(self) -> usize {
        match self {
            Cone::Zero(n) | Cone::NonNegative(n) | Cone::SecondOrder(n) => n,
        }
    }
}

/// `min ½ xᵀ diag(p) x + cᵀx` subject to `b − G x ∈ K`. Its multipliers `z ∈ K*` satisfy `p x + c +
/// Gᵀ z = 0`.
#[derive(Clone, Debug)]
pub struct ConicProgram {
    /// Diagonal `p ≥ 0` of the quadratic part; empty where there is none.
    pub quadratic: Vec<f64>,
    /// Objective `c`.
    pub objective: Vec<f64>,
    /// Constraint matrix `G`.
    pub matrix: Sparse,
    /// Right-hand side `b`.
    pub rhs: Vec<f64>,
    /// The cones of consecutive rows.
    pub cones: Vec<Cone>,
}

impl ConicProgram {
    /// A program in `columns` variables with no rows yet and a zero objective.
    pub(super) fn new(columns: usize) -> Self {
        Self {
            quadratic: Vec::new(),
            objective: vec![0.0; columns],
            matrix: Sparse::zeros(0, columns),
            rhs: Vec::new(),
            cones: Vec::new(),
        }
    }

    /// Appends a cone with right-hand side zero; returns its first row.
    pub(super) fn cone(&mut self, cone: Cone) -> usize {
        let first = self.matrix.rows;
        self.matrix.rows += cone.rows();
        self.rhs.resize(self.matrix.rows, 0.0);
        match (self.cones.last_mut(), cone) {
            (Some(Cone::Zero(n)), Cone::Zero(k))
            | (Some(Cone::NonNegative(n)), Cone::NonNegative(k)) => *n += k,
            _ => self.cones.push(cone),
        }
        first
    }
}
