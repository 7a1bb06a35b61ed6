//! What was submitted, kept beside the rows (`job.json`).

use super::states;
use crate::keep;
use base::{
    error::{RowsError, SlurmError},
    files,
};
use serde::{Deserialize, Serialize};
use std::{io::Write, path::Path};

/// The name of the file.
const NAME: &str = "job.json";

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum JobFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-slurm/1")]
    V1,
}

/// The submissions of a sweep.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Job {
    /// The format and its version.
    pub format: JobFormat,
    /// Shards of the last submission.
    pub tasks: usize,
    /// Slurm's numbers of the arrays, the last submission last.
    pub jobs: Vec<u64>,
}

impl Job {
    /// Reads the record of a folder; nothing where nothing was submitted.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read(folder: &Path) -> Result<Option<Self>, RowsError> {
        let path = folder.join(NAME);
        let file = path.display().to_string();
        let bytes = match keep::read_file(&path) {
            Ok(bytes) => bytes,
            Err(RowsError::File { cause, .. }) if cause.kind() == std::io::ErrorKind::NotFound => {
                return Ok(None);
            }
            Err(e) => return Err(e),
        };
        let damaged = |e: serde_json::Error| RowsError::Damaged {
            file,
            line: e.line(),
            why: format!("not the record of a job: {e}; remove the file; the rows are kept"),
        };
        serde_json::from_slice(&bytes).map(Some).map_err(damaged)
    }

    /// The last of the arrays of which a task may still write, by Slurm's number.
    ///
    /// # Errors
    /// Slurm does not answer.
    pub fn alive(&self) -> Result<Option<u64>, SlurmError> {
        for &number in self.jobs.iter().rev() {
            if states(number)?.values().any(|task| task.state.is_alive()) {
                return Ok(Some(number));
            }
        }
        Ok(None)
    }

    /// Writes the record, whole or not at all.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), RowsError> {
        let path = folder.join(NAME);
        let problem =
            |cause| RowsError::File { file: path.display().to_string(), what: "written", cause };
        let text = serde_json::to_string(self).map_err(|e| problem(e.into()))?;
        let mut file =
            tempfile::NamedTempFile::new_in(folder).map_err(files::unnamed).map_err(problem)?;
        writeln!(file, "{text}").and_then(|()| file.as_file().sync_all()).map_err(problem)?;
        file.persist(&path).map(drop).map_err(|e| problem(e.error))
    }
}
