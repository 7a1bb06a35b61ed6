//! Where the entries of a matrix are.

/// The pattern of the lower triangle of a symmetric matrix, column by column.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Where each column starts in `rows`, and where the last one ends.
    pub starts: Vec<usize>,
    /// Rows of the entries, ascending in each column.
    pub rows: Vec<usize>,
}

impl Pattern {
    /// Rows (and columns) of the matrix.
    pub fn size(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }
}
