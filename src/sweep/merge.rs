//! Shards → one file of rows.

use super::{
    Folder, Header, Row, Shard,
    file::{add, contents},
    sum::Seal,
};
use crate::keep::line;
use base::error::RowsError;
use std::{collections::BTreeMap, path::Path};

/// Rows of several files.
#[derive(Debug)]
pub struct Merged {
    /// Lines in folders that are no rows, left out.
    pub damaged: usize,
    /// Rows without a check sum, as older versions wrote them.
    pub unchecked: usize,
    /// What they are about.
    pub header: Header,
    /// The rows, by number.
    pub rows: Vec<Row>,
}

/// Reads files of rows of the same plan, and [`Folder`]s of such files, which may still be written.
/// Rows that several of them have must agree.
///
/// # Errors
/// A file cannot be read, or is about something else than the first.
pub fn merge(paths: &[impl AsRef<Path>]) -> Result<Option<Merged>, RowsError> {
    let mut header: Option<(String, Header)> = None;
    let (mut rows, mut damaged, mut unchecked) = (BTreeMap::new(), 0, 0);
    for path in paths {
        let path = path.as_ref();
        let file = path.display().to_string();
        let (own, more) = if path.is_dir() {
            let folder = Folder::open(path)?;
            let gathered = folder.read()?;
            damaged += gathered.damaged;
            unchecked += gathered.unchecked;
            (folder.header, gathered.rows.into_values().collect())
        } else {
            let there = contents(path)?;
            unchecked += there.unchecked;
            (there.header, there.rows)
        };
        let differs = |wanted: &str, why: String| RowsError::Differs {
            file: file.clone(),
            wanted: wanted.into(),
            why,
            remedy: "merge shards of one plan only",
        };
        match &header {
            None => header = Some((file.clone(), own)),
            Some((first, header)) => {
                if let Some(why) = own.differs(header) {
                    return Err(differs(first, why.into()));
                }
            }
        }
        for row in more {
            add(&mut rows, row).map_err(|number| {
                differs("the earlier files", format!("row {number} has another answer"))
            })?;
        }
    }
    let Some((_, header)) = header else { return Ok(None) };
    Ok(Some(Merged {
        damaged,
        unchecked,
        header: Header { shard: Shard::ALL, ..header },
        rows: rows.into_values().collect(),
    }))
}

impl Merged {
    /// The text of one file of rows, in the order of their numbers.
    ///
    /// # Errors
    /// A row has no JSON form.
    pub fn text(&self) -> Result<String, std::io::Error> {
        let mut text = line(&Header { sums: true, ..self.header.clone() })?;
        let seal = Seal::new(text.as_bytes());
        for row in &self.rows {
            text.push_str(&seal.line(row)?);
        }
        Ok(text)
    }

    /// Rows of the plan that none of the files has: how many, and the first.
    pub fn missing(&self) -> Option<(usize, usize)> {
        let many = self.header.rows - self.rows.len().min(self.header.rows);
        let first = self
            .rows
            .iter()
            .enumerate()
            .find(|(i, r)| r.row != *i)
            .map_or(self.rows.len(), |(i, _)| i);
        (many > 0).then_some((many, first))
    }
}
