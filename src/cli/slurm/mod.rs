//! `voussoir sweep --slurm`, `--attach`, `sweep status` and `sweep task`.

pub mod status;
pub mod submit;
pub mod task;
pub mod watch;

use super::terminal;
use std::path::{Path, PathBuf};

/// Where the rows of an output arrive.
pub fn folder_of(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_os_string();
    name.push(".slurm");
    name.into()
}

/// Lines that could not be read are never passed over in silence.
pub fn say_damaged(damaged: usize) {
    if damaged > 0 {
        terminal::say(&format!(
            "note: {damaged} damaged or edited lines are ignored; their rows count as missing unless another file has them"
        ));
    }
}

/// Nor rows that may have been edited.
pub fn say_unchecked(unchecked: usize) {
    if unchecked > 0 {
        let rows =
            if unchecked == 1 { "1 row has".into() } else { format!("{unchecked} rows have") };
        terminal::say(&format!(
            "note: {rows} no checksum, as written by older versions: later edits cannot be detected"
        ));
    }
}
