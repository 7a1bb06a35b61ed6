//! Standard vehicles, as data with their sources: what a `"train"` may be made of.

use serde_json::Value;

/// The vehicles by name: their source, and their axles as a train has them.
pub const VEHICLES: &str = include_str!("vehicles.json");

/// The same as JSON, in the order of the file.
///
/// # Errors
/// None: a test reads it.
pub fn vehicles() -> Result<Value, serde_json::Error> {
    serde_json::from_str(VEHICLES)
}
