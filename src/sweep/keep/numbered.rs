//! Pieces of work with numbers, done on all threads and kept one by one.

use super::Kept;
use base::error::RowsError;
use cholesky::parallel;
use serde::{Serialize, de::DeserializeOwned};
use std::{
    collections::BTreeMap,
    sync::{Mutex, PoisonError},
};

/// A piece that knows its number.
pub trait Numbered: Clone + Send + Sync + Serialize + DeserializeOwned {
    /// Its number.
    fn number(&self) -> usize;
}

/// Does the pieces 0 to `count` by `one`, but for those that are kept already; each is kept as it
/// ends, where there is a file, and `each` hears of it. All of them, in order.
///
/// # Errors
/// Threads cannot be started, or the file cannot be written.
pub fn numbered<T: Numbered>(
    count: usize,
    kept: Option<&Kept<T>>,
    one: impl Fn(usize) -> T + Sync,
    each: impl Fn(&T) + Sync,
) -> Result<Vec<T>, RowsError> {
    let there = kept.iter().flat_map(|k| &k.there).map(|piece| (piece.number(), piece));
    let mut all: BTreeMap<usize, T> = there
        .filter(|(number, _)| *number < count)
        .map(|(number, piece)| (number, piece.clone()))
        .collect();
    let missing: Vec<usize> = (0..count).filter(|number| !all.contains_key(number)).collect();
    let fresh = Mutex::new(Vec::new());
    parallel::for_each(0, &missing, |&number| {
        let piece = one(number);
        kept.map_or(Ok(()), |kept| kept.append(&piece))?;
        each(&piece);
        fresh.lock().unwrap_or_else(PoisonError::into_inner).push(piece);
        Ok(())
    })
    .map_err(|e| RowsError::Threads { threads: 0, cause: e.to_string() })??;
    all.extend(
        fresh
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner)
            .into_iter()
            .map(|piece| (piece.number(), piece)),
    );
    Ok(all.into_values().collect())
}
