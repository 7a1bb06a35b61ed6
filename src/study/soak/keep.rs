//! A soak kept on the disk while it runs: one line a scene, each written by one call as the scene ends, so that a kill costs the scenes
//! that were being asked and no other. The same command goes on from there.

use super::Soaked;
use crate::{error::RowsError, sweep::Alone};
use serde::{Deserialize, Serialize};
use std::{
    collections::BTreeMap,
    io,
    path::Path,
    sync::{Mutex, PoisonError},
};

/// The first line: what the others are about.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    format: String,
    /// Another program may answer otherwise.
    version: String,
    seed: u64,
}

impl Header {
    fn new(seed: u64) -> Self {
        Self { format: "voussoir-soak/1".into(), version: env!("CARGO_PKG_VERSION").into(), seed }
    }
}

/// A file of scenes that were asked, open for more and locked against other runs.
#[derive(Debug)]
pub struct Kept {
    name: String,
    file: Mutex<Alone>,
    /// The scenes that were there already, by number.
    pub there: BTreeMap<usize, Soaked>,
}

impl Kept {
    /// Begins a file, or takes up one of the same seed. A last line that was written in part is cut off.
    ///
    /// # Errors
    /// The file cannot be written, is being written by another run, or is about something else.
    pub fn open(path: &Path, seed: u64) -> Result<Self, RowsError> {
        let name = path.display().to_string();
        let problem = |what, cause| RowsError::File { file: name.clone(), what, cause };
        let (mut file, bytes) = Alone::open(path)?;
        let first = line(&Header::new(seed)).map_err(|e| problem("written", e))?;
        let whole = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
        // What is there of a header may be the beginning of this one; anything else is somebody's file.
        let begins = whole == 0 && first.as_bytes().starts_with(&bytes);
        let there = if begins { BTreeMap::new() } else { read(&name, bytes.get(..whole).unwrap_or_default(), seed)? };
        file.cut(whole).map_err(|e| problem("written", e))?;
        if begins {
            file.write(&first).map_err(|e| problem("written", e))?;
        }
        Ok(Self { name, file: Mutex::new(file), there })
    }

    /// Appends a scene.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn append(&self, soaked: &Soaked) -> Result<(), RowsError> {
        let problem = |cause| RowsError::File { file: self.name.clone(), what: "written", cause };
        let line = line(soaked).map_err(problem)?;
        self.file.lock().unwrap_or_else(PoisonError::into_inner).write(&line).map_err(problem)
    }
}

fn read(name: &str, bytes: &[u8], seed: u64) -> Result<BTreeMap<usize, Soaked>, RowsError> {
    let damaged = |line: usize, why: String| RowsError::Damaged { file: name.into(), line, why };
    let mut lines = bytes.split(|b| *b == b'\n').enumerate().filter(|(_, l)| !l.is_empty());
    let header = lines.next().and_then(|(_, text)| serde_json::from_slice::<Header>(text).ok());
    let Some(header) = header else {
        return Err(damaged(1, "not the beginning of a file of scenes of --soak; give --keep another name".into()));
    };
    if header != Header::new(seed) {
        return Err(RowsError::Differs {
            file: name.into(),
            wanted: "this soak".into(),
            why: format!("they are of version {} and seed {}", header.version, header.seed),
            remedy: "give --keep another name, or remove the file",
        });
    }
    lines
        .map(|(index, text)| match serde_json::from_slice::<Soaked>(text) {
            Ok(soaked) => Ok((soaked.index, soaked)),
            Err(e) => Err(damaged(index + 1, format!("not a scene: {e}; remove the line to have it asked again"))),
        })
        .collect()
}

fn line(value: &impl Serialize) -> io::Result<String> {
    let mut text = serde_json::to_string(value)?;
    text.push('\n');
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::{super::run, *};
    use std::{
        fs,
        sync::atomic::{AtomicUsize, Ordering},
    };

    fn asked(path: &Path, seed: u64, count: usize) -> (usize, Vec<Soaked>) {
        let kept = Kept::open(path, seed).unwrap();
        let fresh = AtomicUsize::new(0);
        let count_it = |_: &Soaked| {
            fresh.fetch_add(1, Ordering::Relaxed);
        };
        let list = run(seed, count, Some(&kept), count_it).unwrap();
        (fresh.into_inner(), list)
    }

    #[test]
    fn a_soak_goes_on_where_it_was_stopped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("soak.jsonl");
        let (fresh, whole) = asked(&path, 1, 14);
        assert_eq!((fresh, whole.len()), (14, 14));
        let text = fs::read(&path).unwrap();
        // Stopped anywhere, within a line too: what is whole is kept to the bit, seconds included, and the rest is asked.
        for part in [0, 5, text.len() / 3, text.len() / 2, text.len() - 1, text.len()] {
            fs::write(&path, &text[..part]).unwrap();
            let lines = text[..part].iter().filter(|b| **b == b'\n').count().saturating_sub(1);
            let (fresh, list) = asked(&path, 1, 14);
            assert_eq!(fresh, 14 - lines, "{part}");
            for (a, b) in list.iter().zip(&whole) {
                assert_eq!(Soaked { seconds: 0.0, ..a.clone() }, Soaked { seconds: 0.0, ..b.clone() });
            }
        }
        // More scenes go on from fewer, and fewer need nothing.
        assert_eq!(asked(&path, 1, 16).0, 2);
        assert_eq!((asked(&path, 1, 3).0, asked(&path, 1, 3).1.len()), (0, 3));
    }

    #[test]
    fn other_files_are_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("soak.jsonl");
        let refused = |text: &str, word: &str| {
            fs::write(&path, text).unwrap();
            let error = Kept::open(&path, 1).unwrap_err().to_string();
            assert!(error.contains(word), "{error}");
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        };
        refused("precious\n", "not the beginning");
        refused("precious", "not the beginning");
        let header = |seed| line(&Header::new(seed)).unwrap();
        refused(&header(2), "seed 2");
        refused(&header(1).replace(env!("CARGO_PKG_VERSION"), "9.9.9"), "version 9.9.9");
        refused(&format!("{}{{\"index\":1}}\n", header(1)), "soak.jsonl:2: not a scene");
        let first = Kept::open(&folder.path().join("other"), 1).unwrap();
        assert!(matches!(Kept::open(&folder.path().join("other"), 1), Err(RowsError::Busy { .. })));
        drop(first);
    }
}
