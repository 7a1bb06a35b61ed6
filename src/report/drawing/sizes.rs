//! Sizes of a drawing, in its own units.

/// Width of the drawing, in user units.
pub(super) const WIDTH: f64 = 800.0;

/// Between panels, and around them.
pub(super) const MARGIN: f64 = 20.0;

/// Height of a line of text with its gap.
pub(super) const LINE: f64 = 24.0;

/// More signs of a kind than this are drawn smaller.
pub(super) const MANY: usize = 24;
