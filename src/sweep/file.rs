//! The file of rows on the disk: begun, taken up again, appended to. A row is written by one call
//! as one line, so that a killed run leaves at most one piece of a line, which is cut off when the
//! file is taken up.

use super::{
    Header, Row,
    sum::{Checked, Seal},
};
use crate::keep::{self, Alone, line};
use base::error::RowsError;
use std::{
    collections::BTreeMap,
    path::Path,
    sync::{Mutex, PoisonError},
};

/// The ending of files of rows.
pub(super) const ENDING: &str = "jsonl";

/// A file of rows, open for appending and locked against other runs.
#[derive(Debug)]
pub struct RowsFile {
    name: String,
    seal: Seal,
    file: Mutex<Alone>,
}

/// What was found in a file of rows.
#[derive(Debug)]
pub struct Opened {
    /// The file.
    pub file: RowsFile,
    /// The rows that were there already, by number.
    pub rows: Vec<Row>,
    /// Bytes of a half-written last line that were cut off.
    pub mended: usize,
    /// Rows without a check sum, as older versions wrote them.
    pub unchecked: usize,
}

/// A file of rows as it was read.
pub(super) struct Contents {
    pub header: Header,
    pub rows: Vec<Row>,
    /// Rows without a check sum.
    pub unchecked: usize,
}

impl RowsFile {
    /// Begins a file, or takes up one with the same header.
    ///
    /// # Errors
    /// The file cannot be written, is being written by another run, is no file of rows, or its rows
    /// answer something else.
    pub fn open(path: &Path, header: &Header, restart: bool) -> Result<Opened, RowsError> {
        let name = path.display().to_string();
        let problem = |what, cause| RowsError::File { file: name.clone(), what, cause };
        let (mut file, bytes) = Alone::open(path)?;
        let first = line(header).map_err(|e| problem("written", e))?;
        // What is there of a header may be the beginning of this one; anything else is somebody's
        // file.
        let whole = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
        let nothing = restart && looks_like_rows(&bytes)
            || whole == 0 && first.as_bytes().starts_with(&bytes);
        let there = if nothing { None } else { Some(taken_up(&name, &bytes, whole, header)?) };
        let (kept, mended) = if nothing { (0, 0) } else { (whole, bytes.len() - whole) };
        file.cut(kept).map_err(|e| problem("written", e))?;
        if kept == 0 {
            file.write(&first).map_err(|e| problem("written", e))?;
        }
        // Of the header that is in the file, whose names may be others.
        let seal = Seal::new(if nothing { first.as_bytes() } else { first_line(&bytes) });
        let (rows, unchecked) = there.map_or_else(Default::default, |t| (t.rows, t.unchecked));
        Ok(Opened { file: Self { name, seal, file: Mutex::new(file) }, rows, mended, unchecked })
    }

    /// Begins a file that nobody else has or will have: `name` in `folder`, or `name-2`, `name-3`,
    /// …, the first that is not there.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn fresh(folder: &Path, name: &str, header: &Header) -> Result<Self, RowsError> {
        let mut number = 1_u64;
        loop {
            let own = if number == 1 {
                format!("{name}.{ENDING}")
            } else {
                format!("{name}-{number}.{ENDING}")
            };
            let path = folder.join(own);
            let problem = |cause| RowsError::File {
                file: path.display().to_string(),
                what: "written",
                cause,
            };
            match Alone::fresh(&path) {
                Ok(mut file) => {
                    let first = line(header).map_err(problem)?;
                    file.write(&first).map_err(problem)?;
                    return Ok(Self {
                        name: path.display().to_string(),
                        seal: Seal::new(first.as_bytes()),
                        file: Mutex::new(file),
                    });
                }
                Err(e) if e.kind() == std::io::ErrorKind::AlreadyExists => number += 1,
                Err(e) => return Err(problem(e)),
            }
        }
    }

    /// Appends a row.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn append(&self, row: &Row) -> Result<(), RowsError> {
        let problem = |cause| RowsError::File { file: self.name.clone(), what: "written", cause };
        let line = self.seal.line(row).map_err(problem)?;
        self.file.lock().unwrap_or_else(PoisonError::into_inner).write(&line).map_err(problem)
    }
}

/// Whether a file that is to be replaced is one of ours.
fn looks_like_rows(bytes: &[u8]) -> bool {
    bytes.starts_with(b"{\"format\":\"voussoir-rows/1\"")
}

/// The first line that is not empty.
fn first_line(bytes: &[u8]) -> &[u8] {
    bytes.split(|b| *b == b'\n').find(|l| !l.is_empty()).unwrap_or_default()
}

fn taken_up(
    name: &str,
    bytes: &[u8],
    whole: usize,
    header: &Header,
) -> Result<Contents, RowsError> {
    let there = parse(name, bytes.get(..whole).unwrap_or_default())?;
    let old = &there.header;
    let differs = |why: String| RowsError::Differs {
        file: name.into(),
        wanted: "this plan".into(),
        why,
        remedy: "give another --output, or use --restart to start again",
    };
    if let Some(why) = header.differs(old) {
        return Err(differs(why.into()));
    }
    if old.shard != header.shard {
        return Err(differs(format!("they are shard {}, not {}", old.shard, header.shard)));
    }
    Ok(there)
}

/// Reads a file of rows: its header and its rows by number. A half-written last line is left out.
///
/// # Errors
/// The file cannot be read, or is no file of rows.
pub fn read_rows(path: &Path) -> Result<(Header, Vec<Row>), RowsError> {
    parse_rows(&path.display().to_string(), &keep::read_file(path)?)
}

/// As [`read_rows`], and how many rows have no check sum.
pub(super) fn contents(path: &Path) -> Result<Contents, RowsError> {
    let bytes = keep::read_file(path)?;
    parse(&path.display().to_string(), whole(&bytes))
}

/// As [`read_rows`], from the bytes of a file; `name` stands for it in messages.
///
/// # Errors
/// The bytes are no file of rows.
pub fn parse_rows(name: &str, bytes: &[u8]) -> Result<(Header, Vec<Row>), RowsError> {
    parse(name, whole(bytes)).map(|c| (c.header, c.rows))
}

/// The lines that were written to their ends.
fn whole(bytes: &[u8]) -> &[u8] {
    let end = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
    bytes.get(..end).unwrap_or_default()
}

/// What could be read of a file that another process may be writing, or whose writer lost its
/// machine.
#[derive(Debug, Default)]
pub(super) struct Remains {
    /// Its header, where that is whole.
    pub header: Option<Header>,
    /// Its rows, in the order of the lines.
    pub rows: Vec<Row>,
    /// Lines that are no rows of it, or were edited.
    pub damaged: usize,
    /// Rows without a check sum.
    pub unchecked: usize,
}

/// Reads what can be read: a half-written last line is left out, other lines that are no rows are
/// counted.
///
/// # Errors
/// The file cannot be read.
pub(super) fn read_remains(path: &Path) -> Result<Remains, RowsError> {
    let bytes = keep::read_file(path)?;
    let mut lines = whole(&bytes).split(|b| *b == b'\n').filter(|l| !l.is_empty());
    let Some(first) = lines.next() else { return Ok(Remains::default()) };
    let Ok(header) = serde_json::from_slice::<Header>(first) else {
        return Ok(Remains { damaged: 1 + lines.count(), ..Remains::default() });
    };
    let (mut remains, seal) = (Remains::default(), Seal::new(first));
    for line in lines {
        let checked = seal.check(line);
        let genuine = checked == Checked::Same || checked == Checked::Unknown && !header.sums;
        match serde_json::from_slice::<Row>(line) {
            Ok(row)
                if genuine
                    && row.row < header.rows
                    && row.parameters.len() == header.plan.vary.len() =>
            {
                remains.unchecked += usize::from(checked == Checked::Unknown);
                remains.rows.push(row);
            }
            _ => remains.damaged += 1,
        }
    }
    remains.header = Some(header);
    Ok(remains)
}

fn parse(name: &str, bytes: &[u8]) -> Result<Contents, RowsError> {
    let damaged = |line: usize, why: String| RowsError::Damaged { file: name.into(), line, why };
    let mut lines = bytes.split(|b| *b == b'\n').enumerate().filter(|(_, l)| !l.is_empty());
    let header: Header = match lines.next() {
        Some((_, line)) => serde_json::from_slice(line)
            .map_err(|e| damaged(1, format!("not the header of a file of rows: {e}")))?,
        None => {
            return Err(damaged(1, "not the header of a file of rows: it is incomplete".into()));
        }
    };
    let (mut rows, mut unchecked, seal) = (BTreeMap::new(), 0, Seal::new(first_line(bytes)));
    for (index, text) in lines {
        let at = |why: String| damaged(index + 1, why);
        let row: Row = serde_json::from_slice(text)
            .map_err(|e| at(format!("not a row: {e}; remove the line to recompute the row")))?;
        if row.row >= header.rows
            || !header.shard.holds(row.row)
            || row.parameters.len() != header.plan.vary.len()
        {
            return Err(at(format!("row {} does not belong to this plan", row.row)));
        }
        unchecked += usize::from(!seal.require(text, header.sums, at)?);
        add(&mut rows, row).map_err(|number| {
            at(format!("row {number} appears twice with different answers; remove one of them"))
        })?;
    }
    Ok(Contents { header, rows: rows.into_values().collect(), unchecked })
}

/// Adds a row unless the same one is there.
///
/// # Errors
/// Another row with its number is there.
pub(super) fn add(rows: &mut BTreeMap<usize, Row>, row: Row) -> Result<(), usize> {
    match rows.get(&row.row) {
        Some(old) if old.same(&row) => Ok(()),
        Some(_) => Err(row.row),
        None => {
            rows.insert(row.row, row);
            Ok(())
        }
    }
}
