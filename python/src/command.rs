//! The command `voussoir`, in the process of Python.

use crate::memory;
use pyo3::prelude::*;
use std::{ffi::OsString, path::PathBuf};

/// Runs the command with these arguments and returns its exit code; `program` is the path by which
/// it can be called again.
#[pyfunction]
pub fn command(py: Python, program: PathBuf, arguments: Vec<OsString>) -> u8 {
    let arguments = [OsString::from("voussoir")].into_iter().chain(arguments);
    py.detach(|| voussoir::command::run_as(program, arguments, memory::LIMITS) as u8)
}
