//! What can go wrong on the way in, and what is worth saying although nothing went wrong.
//!
//! An error names the place (file, line, column, JSON path) and the remedy:
//! `arch.json:41:18: blocks[3].density: must be > 0, got -2400; hint: kg/m³`.

use crate::plain::readable;
use serde::{Deserialize, Serialize};
use std::fmt;

/// One step into a JSON value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A member of an object.
    Key(String),
    /// An element of an array.
    Index(usize),
}

/// The way from the root of a JSON value to one of its parts, printed as `blocks[3].shape.box`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct JsonPath(pub Vec<Step>);

impl JsonPath {
    /// The root.
    pub fn root() -> Self {
        Self::default()
    }

    /// This path, one key further in.
    pub fn key(&self, key: impl Into<String>) -> Self {
        let mut steps = self.0.clone();
        steps.push(Step::Key(key.into()));
        Self(steps)
    }

    /// This path, one array element further in.
    pub fn index(&self, index: usize) -> Self {
        let mut steps = self.0.clone();
        steps.push(Step::Index(index));
        Self(steps)
    }

    /// This path followed by `tail`.
    pub fn join(&self, tail: &Self) -> Self {
        Self(self.0.iter().chain(&tail.0).cloned().collect())
    }
}

impl fmt::Display for JsonPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return f.write_str("(root)");
        }
        for (i, step) in self.0.iter().enumerate() {
            match step {
                Step::Index(n) => write!(f, "[{n}]")?,
                Step::Key(k) if k.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-') => {
                    write!(f, "{}{k}", if i == 0 { "" } else { "." })?;
                }
                Step::Key(k) => write!(f, "[{k:?}]")?,
            }
        }
        Ok(())
    }
}

/// A scene, a result or a foreign file that cannot be used as it is.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct InputError {
    /// File name as the user gave it, where there is a file.
    pub file: Option<String>,
    /// Line and column, counted from 1, where known.
    pub position: Option<(usize, usize)>,
    /// The place inside the JSON value; the root for other formats.
    pub path: JsonPath,
    /// What is wrong, with the offending value.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
}

impl InputError {
    /// An error at `path`, not yet tied to a file.
    pub fn at(path: JsonPath, message: impl Into<String>) -> Self {
        Self { file: None, position: None, path, message: message.into(), hint: None }
    }

    /// Adds the remedy.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The same error where its path is relative to the value at `prefix`.
    #[must_use]
    pub fn under(mut self, prefix: &JsonPath) -> Self {
        self.path = prefix.join(&self.path);
        self
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}:")?;
        }
        if let Some((line, column)) = self.position {
            write!(f, "{line}:{column}:")?;
        }
        if self.file.is_some() || self.position.is_some() {
            f.write_str(" ")?;
        }
        if !self.path.0.is_empty() {
            write!(f, "{}: ", readable(&self.path.to_string()))?;
        }
        f.write_str(&readable(&self.message))?;
        if let Some(hint) = &self.hint {
            write!(f, "; hint: {}", readable(hint))?;
        }
        Ok(())
    }
}

/// Something the user should know although the work went on: a repair, a near miss, an assumption.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Finding {
    /// What kind of thing it is, for programs.
    pub code: FindingCode,
    /// One sentence with its numbers, for people.
    pub text: String,
}

/// The kinds of [`Finding`].
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    Serialize,
    Deserialize,
    schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum FindingCode {
    /// A value nobody gave was assumed.
    Assumed,
    /// Input geometry was mended (welded vertices, turned faces, …).
    Mended,
    /// Faces that are not plane are treated as plane.
    Warped,
    /// Gaps within the tolerance were closed.
    GapClosed,
    /// Faces that nearly touch were left apart.
    NearMiss,
    /// Most blocks touch nothing: their joints are open.
    Unjoined,
    /// Blocks overlap.
    Overlap,
    /// A block is drawn twice.
    Twice,
    /// Contacts between other blocks' faces, or below the least area, were ignored.
    ContactIgnored,
    /// Edges or corners that meet others, with several normals, stand for small flats.
    Flattened,
    /// Free blocks without a contact path to a support.
    Floating,
    /// A given normal that points against the line from the first block's centre to the second's.
    Orientation,
    /// Numbers that look like a mistake of units.
    Units,
    /// Supports face another way than gravity pulls: a mistake of axes.
    Axes,
    /// A load that acts off its block, or does not say what it seems to.
    Loads,
    /// Something about the way the numbers were found.
    Numerics,
    /// Something that is needed later was not given.
    Missing,
    /// A part of a foreign file has no counterpart in a scene, or is unusable, and was left out.
    LeftOut,
    /// A property of a joint that its contact cannot use.
    WithoutEffect,
    /// How a foreign file was read where there was a choice.
    Converted,
    /// Which values of a range are the worst, and why.
    WorstCase,
    /// Partial factors are in force.
    Factored,
}

impl FindingCode {
    /// Whether the scene is then likely not the one that is meant: its numbers, axes or loads look
    /// like mistakes. Such findings reach everybody who asks.
    pub fn is_implausible(self) -> bool {
        matches!(self, Self::Units | Self::Axes | Self::Loads | Self::Twice)
    }

    /// Whether it is likely a mistake in the scene, and not only worth knowing.
    pub fn is_mistake(self) -> bool {
        match self {
            Self::Units
            | Self::Axes
            | Self::Loads
            | Self::NearMiss
            | Self::Overlap
            | Self::Twice
            | Self::Unjoined
            | Self::Floating => true,
            Self::Orientation | Self::Missing | Self::WithoutEffect => true,
            Self::Assumed
            | Self::Mended
            | Self::Warped
            | Self::GapClosed
            | Self::ContactIgnored
            | Self::Flattened => false,
            Self::Numerics | Self::LeftOut | Self::Converted | Self::WorstCase | Self::Factored => {
                false
            }
        }
    }
}

impl Finding {
    /// A finding of kind `code`.
    pub fn new(code: FindingCode, text: impl Into<String>) -> Self {
        Self { code, text: text.into() }
    }
}

/// A file of rows that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RowsError {
    /// The system refuses.
    #[error("{file}: cannot be {what}: {cause}")]
    File {
        /// The file.
        file: String,
        /// Read, written, …
        what: &'static str,
        /// The system's word, which is part of the message.
        cause: std::io::Error,
    },
    /// The system does not let it be read, or it is too long.
    #[error("{file}: {why}")]
    Unreadable {
        /// The file.
        file: String,
        /// Why, and the remedy.
        why: String,
    },
    /// Another run writes it.
    #[error("{file}: another run is writing it; wait for its end, or give another name")]
    Busy {
        /// The file.
        file: String,
    },
    /// It is no file of rows.
    #[error("{file}:{line}: {why}")]
    Damaged {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong, and the remedy.
        why: String,
    },
    /// Its rows answer something else.
    #[error("{file}: its rows are not those of {wanted}: {why}; {remedy}")]
    Differs {
        /// The file.
        file: String,
        /// What they should be.
        wanted: String,
        /// In what they differ.
        why: String,
        /// What to do.
        remedy: &'static str,
    },
    /// The threads cannot be started.
    #[error("cannot start {threads} threads: {cause}")]
    Threads {
        /// So many.
        threads: usize,
        /// Why.
        cause: String,
    },
}

/// A sweep that cannot be given to Slurm.
#[derive(Debug, thiserror::Error)]
pub enum SlurmError {
    /// A command is missing.
    #[error(
        "`{program}` is not on the path; hint: --slurm works on a machine from which jobs are submitted; without it the sweep runs on this \
         machine alone"
    )]
    NotInstalled {
        /// The command.
        program: String,
    },
    /// A command failed.
    #[error("{program} reports an error: {said}")]
    Refused {
        /// The command.
        program: String,
        /// Its words.
        said: String,
    },
    /// The partition is unknown.
    #[error("{}; hint: this cluster has {known}", no_partition(.asked.as_deref()))]
    NoPartition {
        /// The one that was asked for.
        asked: Option<String>,
        /// Those there are.
        known: String,
    },
    /// The partition starts no jobs.
    #[error("partition {name} starts no jobs now; hint: `sinfo` shows which do")]
    PartitionDown {
        /// The partition.
        name: String,
    },
    /// The nodes do not see the folder.
    #[error(
        "{folder} lies on a disk of this machine ({kind}, mounted at {at}), which nodes such as {node} cannot reach; hint: give an --output in a shared folder, or --shared if the nodes reach this one under the same path"
    )]
    NotShared {
        /// The folder.
        folder: String,
        /// The kind of file system.
        kind: String,
        /// Where that is mounted.
        at: String,
        /// A node.
        node: String,
    },
}

fn no_partition(asked: Option<&str>) -> String {
    match asked {
        Some(name) => format!("there is no partition {name:?}"),
        None => "there is no default partition, give --partition".into(),
    }
}
