//! Where a block comes from.

use base::error::{InputError, JsonPath};

/// Where a block comes from, for errors about it.
pub(super) struct Origin {
    pub path: JsonPath,
    /// The name of a block that no key of the file holds.
    pub generated: Option<String>,
}

impl Origin {
    /// Turns a path relative to the block into one from the root: a block of a template has no keys
    /// of its own.
    pub(super) fn check<T>(&self, result: Result<T, InputError>) -> Result<T, InputError> {
        result.map_err(|e| match &self.generated {
            None => e.under(&self.path),
            Some(id) => InputError {
                message: format!("block {id:?}, {}: {}", e.path, e.message),
                path: self.path.clone(),
                ..e
            },
        })
    }
}
