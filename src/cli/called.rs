//! How this command is called again.

use std::{io, path::PathBuf, sync::OnceLock};

/// Where that is not by the path of this process.
static PROGRAM: OnceLock<PathBuf> = OnceLock::new();

/// It is called by this path: that of a script.
pub fn set_by(path: PathBuf) {
    let _ = PROGRAM.set(path);
}

/// The path by which it is called.
pub fn path() -> io::Result<PathBuf> {
    PROGRAM.get().cloned().map_or_else(std::env::current_exe, Ok)
}
