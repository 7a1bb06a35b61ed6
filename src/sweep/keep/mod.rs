//! Long work kept on the disk while it goes on: a header that says what it is, then one line a
//! piece, each written by one call as the piece ends, so that a kill costs the pieces that were
//! being done and no other. The same command takes the file up again.

mod alone;
mod digest;
mod numbered;

pub(crate) use alone::Alone;
pub use digest::digest;
pub use numbered::{Numbered, numbered};

use base::{error::RowsError, files, limits, plain};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use serde_json::Value;
use std::{
    fs::File,
    io,
    path::Path,
    sync::{Mutex, PoisonError},
};

/// The first line: what the others are about.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    format: String,
    /// Another program may answer otherwise.
    version: String,
    of: Value,
}

/// A file of pieces that were done, open for more and locked against other runs.
#[derive(Debug)]
pub struct Kept<T> {
    name: String,
    file: Mutex<Alone>,
    /// The pieces that were there already, as they came.
    pub there: Vec<T>,
}

impl<T: Serialize + DeserializeOwned> Kept<T> {
    /// Begins a file, or takes up one of the same `format` and about the same thing. A last line
    /// that was written in part is cut off.
    ///
    /// # Errors
    /// The file cannot be written, is being written by another run, or is about something else.
    pub fn open(path: &Path, format: &str, of: Value) -> Result<Self, RowsError> {
        let name = path.display().to_string();
        let problem = |what, cause| RowsError::File { file: name.clone(), what, cause };
        let header =
            Header { format: format.into(), version: env!("CARGO_PKG_VERSION").into(), of };
        let first = line(&header).map_err(|e| problem("written", e))?;
        let (mut file, bytes) = Alone::open(path)?;
        let whole = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
        // What is there of a header may be the beginning of this one; anything else is somebody's
        // file.
        let begins = whole == 0 && first.as_bytes().starts_with(&bytes);
        let there = if begins {
            Vec::new()
        } else {
            read(&name, bytes.get(..whole).unwrap_or_default(), &header)?
        };
        file.cut(whole).map_err(|e| problem("written", e))?;
        if begins {
            file.write(&first).map_err(|e| problem("written", e))?;
        }
        Ok(Self { name, file: Mutex::new(file), there })
    }

    /// Appends a piece.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn append(&self, piece: &T) -> Result<(), RowsError> {
        let problem = |cause| RowsError::File { file: self.name.clone(), what: "written", cause };
        let line = line(piece).map_err(problem)?;
        self.file.lock().unwrap_or_else(PoisonError::into_inner).write(&line).map_err(problem)
    }
}

fn read<T: DeserializeOwned>(
    name: &str,
    bytes: &[u8],
    wanted: &Header,
) -> Result<Vec<T>, RowsError> {
    let damaged = |line: usize, why: String| RowsError::Damaged { file: name.into(), line, why };
    let mut lines = bytes.split(|b| *b == b'\n').enumerate().filter(|(_, l)| !l.is_empty());
    let header = lines.next().and_then(|(_, text)| serde_json::from_slice::<Header>(text).ok());
    let Some(header) = header.filter(|h| h.format == wanted.format) else {
        return Err(damaged(
            1,
            format!("not the header of a file of {}; give --keep another name", wanted.format),
        ));
    };
    if header != *wanted {
        return Err(RowsError::Differs {
            file: name.into(),
            wanted: format!("version {} and {}", wanted.version, wanted.of),
            why: format!("they are of version {} and {}", header.version, header.of),
            remedy: "give --keep another name, or remove the file",
        });
    }
    lines
        .map(|(index, text)| {
            serde_json::from_slice(text).map_err(|e| {
                damaged(
                    index + 1,
                    format!("not of {}: {e}; remove the line to recompute it", wanted.format),
                )
            })
        })
        .collect()
}

/// The bytes of a file that was kept, unless it is longer than can be read.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, RowsError> {
    let name = path.display().to_string();
    let file = files::open(path).map_err(|cause| RowsError::File {
        file: name.clone(),
        what: "read",
        cause,
    })?;
    bytes(&name, &file)
}

/// As [`read_file`], of a file that is open already.
fn bytes(name: &str, file: &File) -> Result<Vec<u8>, RowsError> {
    limits::read_opened(file, limits::PER_KEPT_BYTE)
        .map_err(|e| RowsError::Unreadable { file: name.into(), why: e.to_string() })
}

/// A value as one line.
pub(crate) fn line(value: &impl Serialize) -> Result<String, io::Error> {
    let mut text = plain::json(serde_json::to_string(value)?);
    text.push('\n');
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::fs;

    const FORMAT: &str = "voussoir-tests/1";

    #[test]
    fn what_was_done_is_taken_up_wherever_it_was_cut() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("kept.jsonl");
        let open = || Kept::<f64>::open(&path, FORMAT, json!({ "seed": 1 })).unwrap();
        let pieces = [0.1, 1.0 / 3.0, 1e300];
        let kept = open();
        pieces.iter().for_each(|p| kept.append(p).unwrap());
        drop(kept);
        let text = fs::read(&path).unwrap();
        for part in 0..=text.len() {
            fs::write(&path, &text[..part]).unwrap();
            let lines = text[..part].iter().filter(|b| **b == b'\n').count().saturating_sub(1);
            let kept = open();
            assert_eq!(kept.there, pieces[..lines], "{part}");
            pieces[lines..].iter().for_each(|p| kept.append(p).unwrap());
            drop(kept);
            assert_eq!(fs::read(&path).unwrap(), text, "{part}");
        }
    }

    #[test]
    fn other_files_are_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("kept.jsonl");
        let refused = |text: &str, word: &str| {
            fs::write(&path, text).unwrap();
            let error =
                Kept::<f64>::open(&path, FORMAT, json!({ "seed": 1 })).unwrap_err().to_string();
            assert!(error.contains(word), "{error}");
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        };
        refused("precious\n", "not the header of a file of voussoir-tests/1");
        refused("precious", "not the header");
        let header = |format: &str, of| {
            line(&Header { format: format.into(), version: env!("CARGO_PKG_VERSION").into(), of })
                .unwrap()
        };
        let own = header(FORMAT, json!({ "seed": 1 }));
        refused(&header("voussoir-others/1", json!({ "seed": 1 })), "not the header");
        refused(&header(FORMAT, json!({ "seed": 2 })), "{\"seed\":2}");
        refused(&own.replace(env!("CARGO_PKG_VERSION"), "9.9.9"), "version 9.9.9");
        refused(&format!("{own}{{\"index\":1}}\n"), "kept.jsonl:2: not of voussoir-tests/1");
        let other = folder.path().join("other");
        let first = Kept::<f64>::open(&other, FORMAT, Value::Null).unwrap();
        assert!(matches!(
            Kept::<f64>::open(&other, FORMAT, Value::Null),
            Err(RowsError::Busy { .. })
        ));
        drop(first);
    }
}
