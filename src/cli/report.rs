//! What all pages for a browser have in common.

use std::{
    path::{Path, PathBuf},
    time::SystemTime,
};
use voussoir::{
    dynamics::Frame,
    report::{
        record::{Origin, date},
        text::{Layout, TextOptions},
        view::Film,
    },
};

/// A page holds all that can be said; what is long is folded there.
pub const EVERYTHING: TextOptions = TextOptions { verbose: true, brief: false };

/// A browser breaks lines by itself.
pub fn layout(layout: Layout) -> Layout {
    Layout { width: usize::MAX, ..layout }
}

/// Whether the page itself is what standard output holds.
pub fn is_printed(report: &Option<PathBuf>) -> bool {
    report.as_ref().is_some_and(|p| p.as_os_str() == "-")
}

/// Shows a film what there is to see at this moment.
pub fn see(film: &mut Option<Film>, moment: Option<&Frame>) {
    if let (Some(film), Some(moment)) = (film, moment) {
        film.see(moment);
    }
}

/// Where a record comes from.
pub fn origin(scene: &Path, command: String) -> Origin {
    let changed = std::fs::metadata(scene).and_then(|m| m.modified()).ok().and_then(since);
    let name = if scene.as_os_str() == "-" { String::new() } else { scene.display().to_string() };
    let written = changed.map(|s| format!(", as written on {}", date(s))).unwrap_or_default();
    Origin {
        file: if name.is_empty() { name } else { format!("{name}{written}") },
        made: since(SystemTime::now()).map(date).unwrap_or_default(),
        command,
    }
}

/// Seconds since 1970.
fn since(time: SystemTime) -> Option<u64> {
    time.duration_since(SystemTime::UNIX_EPOCH).ok().map(|d| d.as_secs())
}
