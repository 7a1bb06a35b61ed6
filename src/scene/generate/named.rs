//! What every template makes its blocks with: their names, and supports among them.

use crate::{BlockSpec, Shape};

/// The most blocks one template may make. More is taken for a mistake (a count of 10⁹ would
/// otherwise end in memory exhaustion).
pub const MAX_BLOCKS: usize = base::limits::BLOCKS;

/// A support of the given shape.
pub(super) fn support(id: impl Into<String>, shape: Shape) -> BlockSpec {
    BlockSpec { support: true, ..BlockSpec::new(id, shape) }
}

/// `v07`: a letter and a number, padded with zeros so that `count` of them sort by name.
pub(super) fn numbered(letter: &str, index: usize, count: usize) -> String {
    format!("{letter}{index:0width$}", width = digits(count))
}

/// Digits of the largest index among `count`, at least 2.
pub(super) fn digits(count: usize) -> usize {
    count.saturating_sub(1).max(10).ilog10() as usize + 1
}
