//! What all pages for a browser have in common.

use std::{
    path::{Path, PathBuf},
    time::SystemTime,
};
use voussoir::{
    dynamics::Frame,
    error::{InputError, JsonPath},
    keep::digest,
    limits,
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

/// What a page verifies itself by, where that is wanted.
pub fn checker(file: Option<&Path>) -> anyhow::Result<Option<Vec<u8>>> {
    let Some(path) = file else { return Ok(None) };
    let make = "make it with `web/build --checker` in a checkout of voussoir's repository: web/site/checker.wasm.gz";
    let refused = |why: String| InputError {
        file: Some(path.display().to_string()),
        ..InputError::at(JsonPath::root(), why).hint(make)
    };
    let module = limits::read_file(path, limits::PER_BYTE).map_err(|e| refused(e.message))?;
    match module.starts_with(GZIP) {
        true => Ok(Some(module)),
        false => Err(refused("not a checker: it is no file of gzip".into()).into()),
    }
}

/// How files of gzip begin (RFC 1952).
const GZIP: &[u8] = &[0x1f, 0x8b];

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

/// The digest of the file of a scene, if it still holds the text that was read.
fn digest_of(scene: &Path, text: &str) -> String {
    if scene.as_os_str() == "-" {
        return digest(text.as_bytes());
    }
    match limits::read_file(scene, limits::PER_BYTE) {
        // A byte order mark is none of the text.
        Ok(bytes)
            if bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&bytes) == text.as_bytes() =>
        {
            digest(&bytes)
        }
        _ => "none: the file has changed since it was read".into(),
    }
}

/// When a record is made.
pub fn now() -> String {
    since(SystemTime::now()).map(date).unwrap_or_default()
}

/// Where a record comes from; `text` is what was read of the scene.
pub fn origin(scene: &Path, text: &str, command: String) -> Origin {
    let changed = std::fs::metadata(scene).and_then(|m| m.modified()).ok().and_then(since);
    let name = if scene.as_os_str() == "-" { String::new() } else { scene.display().to_string() };
    let written = changed.map(|s| format!(", as written on {}", date(s))).unwrap_or_default();
    Origin {
        file: if name.is_empty() { name } else { format!("{name}{written}") },
        digest: digest_of(scene, text),
        made: now(),
        command,
    }
}

/// Seconds since 1970.
fn since(time: SystemTime) -> Option<u64> {
    time.duration_since(SystemTime::UNIX_EPOCH).ok().map(|d| d.as_secs())
}
