//! What a file says, before units; and how its lines are read.

use super::{format::Format, unit::Unit};
use base::error::{Finding, FindingCode, InputError, JsonPath};

/// What a file says.
#[derive(Clone, Debug)]
pub(super) struct Raw {
    pub format: Format,
    /// Time between two samples, s.
    pub step: f64,
    /// By component.
    pub columns: Vec<Column>,
    /// The line with the unit, or where it should be.
    pub unit_line: usize,
    pub findings: Vec<Finding>,
}

/// A component of the acceleration.
#[derive(Clone, Debug, Default)]
pub(super) struct Column {
    pub values: Vec<f64>,
    /// The line of each value.
    pub lines: Vec<usize>,
    pub unit: Option<Unit>,
    /// The greatest value that the header announces, in its unit.
    pub announced: Option<f64>,
}

/// An error in a line (counted from 1).
pub(super) fn error(line: usize, message: impl Into<String>) -> InputError {
    InputError { position: Some((line, 1)), ..InputError::at(JsonPath::root(), message) }
}

/// A finite number.
pub(super) fn number(line: usize, word: &str) -> Result<f64, InputError> {
    match word.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(error(line, format!("the sample {:?} is not finite", word.trim()))
            .hint("correct or cut the record there: missing samples are not filled in")),
        Err(_) => Err(error(line, format!("expected a number, got {:?}", shortened(word)))
            .hint("samples are numbers with a decimal point; comments begin with #")),
    }
}

pub(super) fn shortened(text: &str) -> String {
    text.trim().chars().take(40).collect()
}

/// The lines of a text with their numbers.
pub(super) fn lines(bytes: &[u8]) -> Result<Vec<(usize, String)>, InputError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = Vec::new();
    for (index, line) in bytes.split(|&b| b == b'\n').enumerate() {
        if line.contains(&0) {
            return Err(error(index + 1, "a zero byte: this is not a text file")
                .hint("records are text: CSV, PEER AT2, ESM/ITACA ASCII"));
        }
        let text = String::from_utf8_lossy(line);
        lines.push((index + 1, text.trim_end_matches('\r').to_string()));
    }
    Ok(lines)
}

/// Words between commas and blanks.
pub(super) fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty())
}

/// As many samples as are announced.
pub(super) fn counted(
    line: usize,
    key: &str,
    count: usize,
    column: &mut Column,
    findings: &mut Vec<Finding>,
) -> Result<(), InputError> {
    let there = column.values.len();
    if there < count {
        return Err(error(
            column.lines.last().copied().unwrap_or(line),
            format!("the file ends after {there} samples; {key} in line {line} announces {count}"),
        )
        .hint("the file is incomplete: download it again"));
    }
    if there > count {
        findings.push(Finding::new(
            FindingCode::LeftOut,
            format!("{there} samples, {key} announces {count}: the rest is ignored"),
        ));
        column.values.truncate(count);
        column.lines.truncate(count);
    }
    Ok(())
}
