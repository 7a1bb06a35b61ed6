//! What all pages for a browser have in common.

use std::path::PathBuf;
use voussoir::{
    dynamics::Frame,
    report::{
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
