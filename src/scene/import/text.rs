//! Lines and numbers of text formats, with errors that name the line.

use base::error::{InputError, JsonPath};

/// An error in a line (counted from 1).
pub(super) fn error(line: usize, message: impl Into<String>) -> InputError {
    InputError { position: Some((line, 1)), ..InputError::at(JsonPath::root(), message) }
}

/// A file without the mark by which some editors say that it is UTF-8.
pub(super) fn unmarked(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The lines of a text, which ends them by LF, CR LF or, as old programs do, CR alone.
pub(super) fn split(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    bytes
        .split(|&b| b == b'\n')
        .map(|line| line.strip_suffix(b"\r").unwrap_or(line))
        .flat_map(|line| line.split(|&b| b == b'\r'))
}

/// The words of every line with the line's number (from 1).
///
/// Lines that start with `#` are comments; a backslash at the end joins a line to the next, under
/// the number of the first. Bytes that are no UTF-8 are replaced, for old exporters write names in
/// other encodings; a zero byte means that the file is no text at all.
pub(super) fn lines(bytes: &[u8]) -> Result<Vec<(usize, String)>, InputError> {
    let mut lines: Vec<(usize, String)> = Vec::new();
    let mut continued = false;
    for (index, line) in split(bytes).enumerate() {
        if line.contains(&0) {
            return Err(error(index + 1, "a zero byte: this is not a text file")
                .hint("the file is damaged, or not of the format in its name"));
        }
        let text = String::from_utf8_lossy(line);
        let text = if text.trim_start().starts_with('#') { "" } else { text.trim() };
        let (text, continues) = text.strip_suffix('\\').map_or((text, false), |t| (t, true));
        match lines.last_mut() {
            Some((_, last)) if continued => {
                last.push(' ');
                last.push_str(text);
            }
            _ => lines.push((index + 1, text.into())),
        }
        continued = continues;
    }
    lines.retain(|(_, text)| !text.trim().is_empty());
    Ok(lines)
}

/// Three finite numbers.
pub(super) fn point<'a>(
    line: usize,
    words: impl Iterator<Item = &'a str>,
) -> Result<[f64; 3], InputError> {
    let mut point = [0.0; 3];
    let mut words = words;
    for (value, axis) in point.iter_mut().zip(["x", "y", "z"]) {
        let word = words.next().ok_or_else(|| {
            error(line, format!("coordinate {axis} is missing"))
                .hint("a corner has three coordinates; the file may be cut off here")
        })?;
        *value = word.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
            error(
                line,
                format!("coordinate {axis}: expected a finite number, got {:?}", shorten(word)),
            )
            .hint("look for NaN, infinite values and decimal commas in the export")
        })?;
    }
    Ok(point)
}

/// At most 60 characters of a text, without line breaks: files are quoted in messages, and some are
/// garbage.
pub(super) fn shorten(text: &str) -> String {
    let mut short: String =
        text.chars().take(60).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(60).is_some() {
        short.push('…');
    }
    short
}
