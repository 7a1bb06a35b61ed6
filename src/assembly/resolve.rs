//! [`Scene`] → [`Assembly`].

use super::Assembly;
use crate::{error::InputError, scene::Scene};

/// Resolves a scene.
///
/// # Errors
/// Anything in the scene that has no meaning: a missing reference, a non-positive density, an open shape, no support, …
pub fn resolve(_scene: &Scene) -> Result<Assembly, InputError> {
    Err(InputError::at(Default::default(), "resolve is being written"))
}
