//! ..
use super::raw::Raw; use base::error::InputError; use std::path::Path;
pub(super) fn read(_b: &[u8], _f: Option<&Path>) -> Result<Raw, InputError> { Ok(Raw::default()) }
