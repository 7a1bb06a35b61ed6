//! Where a program begins that differs from the last one by its loads alone, as those of two directions of
//! a tilt do: near a point that the last one passed.

use model::interface::Part;
use solve::Passed;
use std::{
    collections::BTreeMap,
    sync::{Mutex, PoisonError},
};

/// One point for each part: whichever order parts are solved in, each begins where it left off.
#[derive(Debug, Default)]
pub(super) struct Near(Mutex<BTreeMap<Option<usize>, Passed>>);

impl Near {
    /// What `solve` gives from the point of a part; it leaves the next one.
    pub fn part<T>(&self, part: &Part, solve: impl FnOnce(&mut Option<Passed>) -> T) -> T {
        // No contact is in two parts; those without any have no point.
        let key = part.contacts.first().copied();
        let points = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut near = points().remove(&key);
        let answer = solve(&mut near);
        if let Some(passed) = near {
            points().insert(key, passed);
        }
        answer
    }
}
