//! What a file may ask for: counts beyond which a number is taken for a mistake, and memory that is
//! estimated before it is taken.
//!
//! Estimates are upper bounds by the measured cost of one item (corner, block, contact point); what
//! does not fit is an error that says how much it would take. The memory that counts is
//! [`set_memory`]'s, else what the system says is free (Linux), else without bound. It is one
//! number for the process, as memory itself is; no answer depends on it.

mod system;

pub use system::group;

use crate::{
    error::{InputError, JsonPath},
    files,
};
use std::{
    fs::File,
    io::{self, Read},
    path::Path,
    sync::{
        OnceLock,
        atomic::{AtomicU64, Ordering},
    },
};

/// Longest file, bytes. Longer: the text and what is made of it no longer fit into common machines.
/// Shorter: a million blocks with their corners (some 700 bytes each) are refused.
pub const FILE: u64 = 2 << 30;

/// Most blocks of a scene, and of one template. More: a mistake in a count ends in minutes of work
/// or in exhausted memory. Fewer: large packings are refused.
pub const BLOCKS: usize = 1_000_000;

/// Most pairs of blocks near enough to touch. More: a thousand copies of a block in one place, or
/// ten thousand in a large overlap, take hours. Fewer: heaps of a million grains (some seven pairs
/// each) are refused.
pub const PAIRS: usize = 20_000_000;

/// Most contact points of a scene. More: no program of this size is solved here. Fewer: walls of a
/// million bricks are refused by `check`, which solves nothing.
pub const CONTACT_POINTS: usize = 40_000_000;

/// Bytes that reading takes per byte of a scene, a plan or a result: its text, and what is made of
/// it.
pub const PER_BYTE: u64 = 16;
/// The same for files of other programs, which are first read as they are.
pub const PER_FOREIGN_BYTE: u64 = 40;
/// The same for rows and other pieces of long work, which are numbers for the most part.
pub const PER_KEPT_BYTE: u64 = 4;
/// Bytes per block of a template: spec, block, polyhedron, names.
pub const PER_BLOCK: u64 = 6 << 10;
/// Bytes per pair of blocks near enough to touch.
pub const PER_PAIR: u64 = 256;
/// Bytes per contact point while a program is solved: its rows and columns, the engine's copies,
/// the factors.
pub const PER_CONTACT_POINT: u64 = 8 << 10;

/// Values of a range that are scanned: each is a question of its own.
pub const SCANNED: usize = 100_000;

static MEMORY: AtomicU64 = AtomicU64::new(0);

/// Sets the memory that estimates have to fit into; `None` for what the system has free.
pub fn set_memory(bytes: Option<u64>) {
    MEMORY.store(bytes.unwrap_or(0), Ordering::Relaxed);
}

/// The memory that estimates have to fit into, where anything is known about it.
pub fn memory() -> Option<u64> {
    static FREE: OnceLock<Option<u64>> = OnceLock::new();
    match MEMORY.load(Ordering::Relaxed) {
        0 => *FREE.get_or_init(system::free),
        bytes => Some(bytes),
    }
}

/// Whether so many items of so many bytes each fit; `what` begins the sentence that says why not.
///
/// # Errors
/// They do not.
pub fn afford(what: &str, count: u64, each: u64) -> Result<(), InputError> {
    let bytes = count.saturating_mul(each);
    match memory() {
        Some(most) if bytes > most => {
            let given = if MEMORY.load(Ordering::Relaxed) > 0 { "allowed" } else { "free" };
            let message =
                format!("{what} would take about {} of memory; {} {given}", size(bytes), is(most));
            Err(InputError::at(JsonPath::root(), message)
                .hint("reduce the problem, or raise --max-memory if the machine has more"))
        }
        _ => Ok(()),
    }
}

fn is(bytes: u64) -> String {
    format!("{} {}", size(bytes), if bytes == 1 { "is" } else { "are" })
}

/// Bytes for people.
pub fn size(bytes: u64) -> String {
    const UNITS: [&str; 5] = ["bytes", "KiB", "MiB", "GiB", "TiB"];
    let power = (bytes.max(1).ilog2() / 10).min(4);
    let value = bytes as f64 / (1_u64 << (10 * power)) as f64;
    let digits = usize::from(power > 0 && value < 99.95);
    format!("{value:.digits$} {}", UNITS[power as usize])
}

/// The bytes of a regular file, unless it is longer than can be read; `each` is what reading takes
/// per byte.
///
/// # Errors
/// It cannot be read, is a folder, a pipe, a device or the like, or is too long.
pub fn read_file(path: &Path, each: u64) -> Result<Vec<u8>, InputError> {
    let named = |e: InputError| InputError { file: Some(path.display().to_string()), ..e };
    files::open(path).map_err(failed).and_then(|file| read_opened(&file, each)).map_err(named)
}

/// As [`read_file`], of a file that is no link.
///
/// # Errors
/// As [`read_file`], or it is a link.
pub fn read_itself(path: &Path, each: u64) -> Result<Vec<u8>, InputError> {
    files::open_itself(path).map_err(failed).and_then(|file| read_opened(&file, each))
}

/// As [`read_file`], of a file that is open already.
///
/// # Errors
/// It cannot be read, or is too long.
pub fn read_opened(file: &File, each: u64) -> Result<Vec<u8>, InputError> {
    fits(file.metadata().map_err(failed)?.len(), each)?;
    read(file, each).map_err(failed)?
}

fn failed(e: io::Error) -> InputError {
    InputError::at(JsonPath::root(), format!("cannot be read: {e}"))
        .hint("check the path and the permissions")
}

/// The bytes of a stream, as [`read_file`].
///
/// # Errors
/// The outer error is the system's; the inner one says that the stream is too long.
pub fn read(stream: impl Read, each: u64) -> io::Result<Result<Vec<u8>, InputError>> {
    let most = memory().map_or(FILE, |m| (m / each.max(1)).min(FILE));
    let mut bytes = Vec::new();
    stream.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    Ok(fits(bytes.len() as u64, each).map(|()| bytes))
}

fn fits(length: u64, each: u64) -> Result<(), InputError> {
    if length > FILE {
        let message = format!("the file has {}, at most {} are read", size(length), size(FILE));
        return Err(InputError::at(JsonPath::root(), message)
            .hint("split it, or give structures by templates"));
    }
    afford(&format!("a file of {}", size(length)), length, each)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_readable() {
        for (bytes, text) in [
            (0, "0 bytes"),
            (1023, "1023 bytes"),
            (1024, "1.0 KiB"),
            (1536, "1.5 KiB"),
            (500 << 20, "500 MiB"),
            (u64::MAX, "16777216 TiB"),
        ] {
            assert_eq!(size(bytes), text);
        }
    }

    #[test]
    fn what_does_not_fit_is_said_with_both_numbers() {
        // Beyond any machine, so that the test needs no limit of its own, which other tests would
        // see.
        if memory().is_some() {
            let text = afford("a test", 1 << 40, 1 << 20).expect_err("does not fit").to_string();
            assert!(
                text.contains("a test would take about 1048576 TiB")
                    && text.contains("--max-memory"),
                "{text}"
            );
        }
        assert!(afford("a test", 1, 1).is_ok());
        assert!(fits(FILE + 1, 1).unwrap_err().message.contains("at most 2.0 GiB"));
    }

    #[test]
    fn an_endless_stream_is_not_read_to_its_end() {
        struct Endless(u64);
        impl Read for Endless {
            fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
                self.0 += buffer.len() as u64;
                assert!(self.0 < 8 << 30, "read on and on");
                Ok(buffer.len())
            }
        }
        // So dear a byte that few fit.
        let each = memory().map_or(1, |m| m / 1000);
        if each > 1 {
            assert!(read(Endless(0), each).unwrap().is_err());
        }
    }
}
