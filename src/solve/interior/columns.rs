//! Sparse columns, and the blocks of variables that they belong to.

/// Compressed columns: rows and values of each.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    pub start: Vec<usize>,
    pub row: Vec<usize>,
    pub value: Vec<f64>,
    /// Whether the entries are those of a square diagonal and no others.
    diagonal: bool,
}

impl Columns {
    /// From (column, row, value), sorted; equal places add up.
    pub fn new(columns: usize, mut entries: Vec<(usize, usize, f64)>) -> Self {
        entries.sort_by_key(|e| (e.0, e.1));
        let mut this = Self {
            start: vec![0; columns + 1],
            row: Vec::new(),
            value: Vec::new(),
            diagonal: false,
        };
        let mut last = None;
        for (column, row, value) in entries {
            if last == Some((column, row)) {
                if let Some(v) = this.value.last_mut() {
                    *v += value;
                }
                continue;
            }
            last = Some((column, row));
            this.start[column + 1] += 1;
            this.row.push(row);
            this.value.push(value);
        }
        for k in 0..columns {
            this.start[k + 1] += this.start[k];
        }
        this.diagonal = this.start[columns] == columns
            && this.start.windows(2).all(|w| w[1] - w[0] == 1)
            && this.row.iter().copied().eq(0..columns);
        this
    }

    /// Rows and values of a column.
    pub fn of(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.start[column]..self.start[column + 1];
        self.row[range.clone()].iter().copied().zip(self.value[range].iter().copied())
    }

    /// `y += sign · M x`.
    pub fn add(&self, sign: f64, x: &[f64], y: &mut [f64]) {
        if self.diagonal {
            return self.add_diagonal(sign, x, y);
        }
        for (column, x) in x.iter().enumerate() {
            for (row, v) in self.of(column) {
                y[row] += sign * v * x;
            }
        }
    }

    /// `x += sign · Mᵀ y`.
    pub fn add_transposed(&self, sign: f64, y: &[f64], x: &mut [f64]) {
        if self.diagonal {
            return self.add_diagonal(sign, y, x);
        }
        for (column, x) in x.iter_mut().enumerate() {
            *x += sign * self.of(column).map(|(row, v)| v * y[row]).sum::<f64>();
        }
    }

    fn add_diagonal(&self, sign: f64, from: &[f64], to: &mut [f64]) {
        for ((to, from), v) in to.iter_mut().zip(from).zip(&self.value) {
            *to += sign * v * from;
        }
    }
}

/// Variables that share cones, numbered consecutively.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// Its variables.
    pub variables: std::ops::Range<usize>,
    /// Its cones, indices.
    pub cones: Vec<usize>,
    /// Whether its only cone holds its variables themselves, up to the sign: `K⁻¹ = W²`.
    pub plain: bool,
}
