//! What all pages for a browser have in common.

use std::path::PathBuf;
use voussoir::{
    dynamics::Frame,
    report::{
        text::{Layout, Options},
        view::Film,
    },
};

/// A page holds all that can be said; what is long is folded there.
pub const EVERYTHING: Options = Options { verbose: true, brief: false };

/// A browser breaks lines by itself.
pub fn layout(layout: Layout) -> Layout {
    Layout { width: usize::MAX, ..layout }
}

/// Whether the page itself is what standard output holds.
pub fn is_printed(report: &Option<PathBuf>) -> bool {
    report.as_ref().is_some_and(|p| p.as_os_str() == "-")
}

/// Frames in a page at most.
const FRAMES: usize = 120;
/// Poses of blocks in a page at most, of 12 bytes each: 2.4 MB.
const POSES: usize = 200_000;

/// A film for a page, of a scene of so many blocks.
pub fn film(blocks: usize) -> Film {
    Film::new((POSES / blocks.max(1)).clamp(2, FRAMES))
}

/// Shows a film what there is to see at this moment.
pub fn see(film: &mut Option<Film>, moment: Option<&Frame>) {
    if let (Some(film), Some(moment)) = (film, moment) {
        film.see(moment);
    }
}
