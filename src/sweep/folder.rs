//! The folder of a sweep that many processes work on: what is asked (`sweep.jsonl`, a header
//! alone), and in `rows/` one file of rows for every process that ever wrote. Nobody appends to
//! another's file, so that no lock is needed, which not every shared file system gives; who begins
//! reads what all the others have done. A process that was given up for lost and goes on does no
//! harm: the rows it does twice are the same.

use super::{
    Header, Row, Shard,
    file::{self, ENDING, RowsFile},
};
use crate::keep::line;
use base::{
    error::{InputError, RowsError},
    files, limits,
};
use std::{
    collections::BTreeMap,
    fs,
    io::{ErrorKind, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

/// What is asked.
const HEADER: &str = "sweep.jsonl";
/// Files of rows.
const ROWS: &str = "rows";
/// What the processes say.
const LOG: &str = "log";

/// A folder of rows.
#[derive(Clone, Debug)]
pub struct Folder {
    /// Where.
    pub path: PathBuf,
    /// What is asked, of all rows.
    pub header: Header,
}

/// The rows of a folder.
#[derive(Clone, Debug, Default)]
pub struct Gathered {
    /// By number.
    pub rows: BTreeMap<usize, Row>,
    /// Lines that are no rows, as a machine may leave behind that goes down: their rows count as
    /// not done.
    pub damaged: usize,
    /// Rows without a check sum, as older versions wrote them.
    pub unchecked: usize,
}

impl Folder {
    /// Makes a folder, or opens the one that is there if it asks the same.
    ///
    /// # Errors
    /// It cannot be written, or asks something else.
    pub fn create(path: &Path, header: &Header) -> Result<Self, RowsError> {
        let header = Header { shard: Shard::ALL, ..header.clone() };
        match Self::open(path) {
            Ok(folder) => match header.differs(&folder.header) {
                Some(why) => Err(RowsError::Differs {
                    file: path.display().to_string(),
                    wanted: "this plan".into(),
                    why: why.into(),
                    remedy: "give another --output, or use --restart to start again",
                }),
                None => Ok(folder),
            },
            Err(RowsError::File { cause, .. }) if cause.kind() == ErrorKind::NotFound => {
                let problem = |cause| RowsError::File {
                    file: path.display().to_string(),
                    what: "written",
                    cause,
                };
                for folder in [ROWS, LOG] {
                    fs::create_dir_all(path.join(folder)).map_err(problem)?;
                }
                // Whole or not at all: who opens the folder relies on it.
                let text = line(&header).map_err(problem)?;
                let mut file = tempfile::NamedTempFile::new_in(path)
                    .map_err(files::unnamed)
                    .map_err(problem)?;
                std::io::Write::write_all(&mut file, text.as_bytes()).map_err(problem)?;
                file.persist(path.join(HEADER)).map_err(|e| problem(e.error))?;
                Ok(Self { path: path.to_path_buf(), header })
            }
            Err(e) => Err(e),
        }
    }

    /// Opens a folder.
    ///
    /// # Errors
    /// There is none, or what it asks cannot be read.
    pub fn open(path: &Path) -> Result<Self, RowsError> {
        let (header, _) = file::read_rows(&path.join(HEADER))?;
        Ok(Self { path: path.to_path_buf(), header })
    }

    /// Removes all rows of a folder, and what it asks.
    ///
    /// # Errors
    /// It cannot be removed, or is no folder of rows.
    pub fn remove(path: &Path) -> Result<(), RowsError> {
        match Self::open(path) {
            Ok(_) => fs::remove_dir_all(path).map_err(|cause| RowsError::File {
                file: path.display().to_string(),
                what: "removed",
                cause,
            }),
            Err(RowsError::File { cause, .. }) if cause.kind() == ErrorKind::NotFound => Ok(()),
            Err(e) => Err(e),
        }
    }

    /// The sweep it asks about.
    ///
    /// # Errors
    /// The header was edited into something that has no meaning.
    pub fn sweep(&self) -> Result<super::Sweep, InputError> {
        super::Sweep::new(self.header.plan.clone(), self.header.scene.clone())
    }

    /// Where the files of rows are.
    pub fn rows_folder(&self) -> PathBuf {
        self.path.join(ROWS)
    }

    /// A new file of rows for this process alone.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn fresh(&self, name: &str) -> Result<RowsFile, RowsError> {
        RowsFile::fresh(&self.rows_folder(), name, &self.header)
    }

    /// The files of rows, by name.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn files(&self) -> Result<Vec<PathBuf>, RowsError> {
        let folder = self.rows_folder();
        let problem =
            |cause| RowsError::File { file: folder.display().to_string(), what: "read", cause };
        let entries: Result<Vec<_>, _> =
            fs::read_dir(&folder).map_err(problem)?.map(|e| e.map(|e| e.path())).collect();
        let mut files = entries.map_err(problem)?;
        files.retain(|path| path.extension().is_some_and(|e| e == ENDING));
        files.sort();
        Ok(files)
    }

    /// All rows there are.
    ///
    /// # Errors
    /// A file cannot be read, asks something else, or has another answer than the ones before it.
    pub fn read(&self) -> Result<Gathered, RowsError> {
        let mut all = Gathered::default();
        for path in self.files()? {
            let differs = |why: String, remedy| RowsError::Differs {
                file: path.display().to_string(),
                wanted: self.path.display().to_string(),
                why,
                remedy,
            };
            let remains = file::read_remains(&path)?;
            all.damaged += remains.damaged;
            all.unchecked += remains.unchecked;
            if let Some(why) = remains.header.and_then(|h| h.differs(&self.header)) {
                return Err(differs(why.into(), "move the file away"));
            }
            for row in remains.rows {
                file::add(&mut all.rows, row).map_err(|number| {
                    differs(
                        format!("row {number} has another answer in an earlier file"),
                        "move one of the two away",
                    )
                })?;
            }
        }
        Ok(all)
    }

    /// Numbers of the rows that are not done.
    pub fn missing(&self, gathered: &Gathered) -> Vec<usize> {
        (0..self.header.rows).filter(|row| !gathered.rows.contains_key(row)).collect()
    }
}

/// Counts the rows of a folder again and again, and looks only at what is new.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Of each file how much was looked at, and the lines in it.
    seen: BTreeMap<PathBuf, (u64, usize)>,
}

impl Tally {
    /// Lines with rows in all files. Rows that were done twice count twice.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn count(&mut self, folder: &Folder) -> Result<usize, RowsError> {
        let mut all = 0;
        for path in folder.files()? {
            let problem =
                |cause| RowsError::File { file: path.display().to_string(), what: "read", cause };
            let (at, lines) = self.seen.entry(path.clone()).or_default();
            let mut file = files::open(&path).map_err(problem)?;
            file.seek(SeekFrom::Start(*at)).map_err(problem)?;
            let mut more = Vec::new();
            // What is longer than a file of rows may be is told when its rows are read.
            file.take(limits::FILE).read_to_end(&mut more).map_err(problem)?;
            *at += more.len() as u64;
            *lines += more.iter().filter(|b| **b == b'\n').count();
            all += lines.saturating_sub(1);
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plan, RowAnswer, RowStatus, Sweep};
    use serde_json::json;

    fn header() -> Header {
        let plan: Plan = serde_json::from_value(json!({
            "format": "voussoir-sweep/1", "scene": "s.json", "question": { "assess": {} },
            "vary": [{ "pointer": "/joints/default/friction", "from": 0.1, "to": 1.0, "count": 4 }]
        }))
        .unwrap();
        let scene = json!({ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.5 } }, "templates": [{ "column": {
            "blocks": 1, "size": [1, 1, 1] } }] });
        Sweep::new(plan, scene).unwrap().header(Shard::ALL)
    }

    fn row(number: usize, seconds: f64, status: RowStatus) -> Row {
        Row {
            row: number,
            parameters: vec![0.5.into()],
            answer: RowAnswer::of(status),
            error: None,
            seconds,
        }
    }

    #[test]
    fn rows_of_all_files_count_once_and_what_a_lost_machine_leaves_is_left_out() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("sweep");
        let folder = Folder::create(&path, &header()).unwrap();
        Folder::create(&path, &header()).unwrap();
        let mut tally = Tally::default();
        assert_eq!(tally.count(&folder).unwrap(), 0);
        for rows in [
            vec![row(0, 1.0, RowStatus::Stable), row(1, 1.0, RowStatus::Error)],
            vec![row(1, 2.0, RowStatus::Error)],
        ] {
            let file = folder.fresh("task").unwrap();
            rows.iter().for_each(|row| file.append(row).unwrap());
        }
        assert_eq!(folder.files().unwrap().len(), 2);
        assert_eq!(tally.count(&folder).unwrap(), 3);
        // A line of zeros, another file's beginning cut short, half a row.
        let torn = folder.files().unwrap()[0].clone();
        let mut bytes = fs::read(&torn).unwrap();
        bytes.extend(b"\0\0\0\0\n{\"row\":3,\"param");
        fs::write(&torn, bytes).unwrap();
        fs::write(folder.rows_folder().join("begun.jsonl"), "{\"format\":").unwrap();
        let gathered = folder.read().unwrap();
        assert_eq!((gathered.rows.len(), gathered.damaged), (2, 1));
        assert_eq!(folder.missing(&gathered), [2, 3]);
        // Two answers to one row are never merged in silence.
        let file = folder.fresh("task").unwrap();
        file.append(&row(0, 1.0, RowStatus::Unstable)).unwrap();
        assert!(folder.read().unwrap_err().to_string().contains("row 0 has another answer"));
    }

    #[test]
    fn a_folder_answers_one_plan() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("sweep");
        Folder::create(&path, &header()).unwrap();
        let mut other = header();
        other.plan.seed = 7;
        assert!(
            Folder::create(&path, &other).unwrap_err().to_string().contains("the seed differs")
        );
        Folder::remove(&path).unwrap();
        Folder::remove(&path).unwrap();
        assert!(!path.exists());
        fs::create_dir(&path).unwrap();
        fs::write(path.join("sweep.jsonl"), "somebody's\n").unwrap();
        assert!(Folder::remove(&path).is_err() && path.exists());
    }
}
