//! Open ends of a bracket in JSON, which has no infinity: they are written as `null`, and read back
//! as the end they stand for.

use serde::{Deserialize, Deserializer};

/// A lower end; `null` is −∞.
pub(super) fn lower<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NEG_INFINITY))
}

/// An upper end; `null` is +∞.
pub(super) fn upper<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
}
