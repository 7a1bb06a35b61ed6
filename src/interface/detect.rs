//! Detection: candidate pairs from parry's bounding-volume tree, then face against face.

use super::Interfaces;
use crate::assembly::Assembly;

/// Finds every contact of an assembly.
pub fn detect(_assembly: &Assembly) -> Interfaces {
    Interfaces::default()
}
