//! A result that was changed.

use serde_json::Value;

/// A false result.
pub(super) struct Forgery {
    pub kind: &'static str,
    pub what: String,
    pub file: Value,
}
