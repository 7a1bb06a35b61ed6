//! A DXF file as what it is: pairs of a group code and a value, as text (two lines a pair) or binary.
//! Codes and their types are those of Autodesk's DXF reference ("Group code value types").

use super::super::text::{self, shorten};
use base::error::{InputError, JsonPath};
use std::borrow::Cow;

/// How a binary file begins.
const BINARY: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// One value with its group code.
pub(super) struct Pair<'a> {
    pub code: i32,
    pub value: Cow<'a, str>,
    /// The line of the value, counted from 1; none in a binary file.
    pub line: Option<usize>,
}

impl Pair<'_> {
    /// An error at this pair.
    pub fn error(&self, message: impl Into<String>) -> InputError {
        match self.line {
            Some(line) => text::error(line, message),
            None => InputError::at(JsonPath::root(), message),
        }
    }

    /// Its value as a number.
    pub fn number(&self) -> Result<f64, InputError> {
        self.value.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
            self.error(format!("expected a finite number, got {:?}", shorten(&self.value)))
                .hint("the file may be damaged here")
        })
    }
}

/// The pairs that the reader looks at.
pub(super) fn pairs(bytes: &[u8]) -> Result<Vec<Pair<'_>>, InputError> {
    match bytes.strip_prefix(BINARY) {
        Some(rest) => binary(rest),
        None if bytes.starts_with(b"AutoCAD Binary DXF") => {
            Err(text::error(1, "a binary DXF file that is damaged in its first bytes")
                .hint("transfer it as binary, or save as ASCII DXF"))
        }
        None => ascii(bytes),
    }
}

/// Others are dropped at once.
fn is_read(code: i32) -> bool {
    matches!(code, 0 | 2 | 5 | 8 | 9 | 10..=13 | 20..=23 | 30..=33 | 41..=45 | 50 | 67 | 70..=74 | 210 | 220 | 230)
}

fn ascii(bytes: &[u8]) -> Result<Vec<Pair<'_>>, InputError> {
    let mut lines = text::split(text::unmarked(bytes)).enumerate();
    let mut pairs = Vec::new();
    while let Some((index, code)) = lines.next() {
        let word = String::from_utf8_lossy(code);
        let Some((at, value)) = lines.next() else {
            if word.trim().is_empty() {
                break;
            }
            return Err(text::error(index + 1, "a group code without a value")
                .hint("the file may be cut off here"));
        };
        let code = word.trim().parse().map_err(|_| {
            text::error(index + 1, format!("expected a group code, got {:?}", shorten(&word)))
                .hint("the file is damaged, or no DXF")
        })?;
        if is_read(code) {
            let value = String::from_utf8_lossy(value.trim_ascii());
            pairs.push(Pair { code, value, line: Some(at + 1) });
        }
    }
    Ok(pairs)
}

/// After the mark: codes of two bytes (of one up to R12), values by the type of their code, the low byte
/// first.
fn binary(mut rest: &[u8]) -> Result<Vec<Pair<'_>>, InputError> {
    // The first code is 0, of SECTION.
    let old = rest.get(1).is_some_and(|b| *b != 0);
    let mut pairs = Vec::new();
    while !rest.is_empty() {
        let left = rest.len();
        let (code, value) = next(&mut rest, old).ok_or_else(|| {
            let message =
                format!("the binary DXF file ends within a value, {left} bytes before its end");
            InputError::at(JsonPath::root(), message).hint("the file may be cut off")
        })?;
        if is_read(code) {
            pairs.push(Pair { code, value, line: None });
        }
    }
    Ok(pairs)
}

/// The next pair, unless the file ends within it.
fn next<'a>(rest: &mut &'a [u8], old: bool) -> Option<(i32, Cow<'a, str>)> {
    let code = match old {
        true => match take::<1>(rest)? {
            [255] => i32::from(i16::from_le_bytes(take(rest)?)),
            [code] => i32::from(code),
        },
        false => i32::from(i16::from_le_bytes(take(rest)?)),
    };
    let value: Cow<str> = match code {
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
            format!("{:?}", f64::from_le_bytes(take(rest)?)).into()
        }
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
            i16::from_le_bytes(take(rest)?).to_string().into()
        }
        90..=99 | 420..=429 | 440..=459 | 1071 => {
            i32::from_le_bytes(take(rest)?).to_string().into()
        }
        160..=169 => i64::from_le_bytes(take(rest)?).to_string().into(),
        290..=299 => take::<1>(rest)?[0].to_string().into(),
        // A length, and as many bytes.
        310..=319 | 1004 => {
            let [length] = take(rest)?;
            *rest = rest.get(usize::from(length)..)?;
            "".into()
        }
        _ => {
            let end = rest.iter().position(|b| *b == 0)?;
            let text = String::from_utf8_lossy(rest[..end].trim_ascii());
            *rest = &rest[end + 1..];
            text
        }
    };
    Some((code, value))
}

fn take<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
    let (head, tail) = rest.split_first_chunk()?;
    *rest = tail;
    Some(*head)
}
