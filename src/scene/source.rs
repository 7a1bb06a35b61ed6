//! Where a part of a JSON value stands in the text it was read from.

use base::error::{InputError, JsonPath, Step};
use serde::de::{DeserializeSeed, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use std::{cell::Cell, fmt};

/// The text a scene was read from, kept to say where an error lies.
#[derive(Clone, Debug)]
pub struct Source {
    /// File name as given by the user.
    pub name: String,
    /// The text, without a byte order mark.
    pub text: String,
}

impl Source {
    /// A named text; a leading byte order mark is dropped.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let mut text = text.into();
        if text.starts_with('\u{feff}') {
            text.drain(..'\u{feff}'.len_utf8());
        }
        Self { name: name.into(), text }
    }

    /// Line and column (counted from 1, columns in characters) of the value at `path`; `None` where
    /// the text has no such value.
    pub fn locate(&self, path: &JsonPath) -> Option<(usize, usize)> {
        self.descend(&path.0).map(|m| self.position(m.value))
    }

    /// Line and column of the last key of `path` itself (of the value, where the last step is an
    /// array index).
    pub(super) fn locate_key(&self, path: &JsonPath) -> Option<(usize, usize)> {
        self.descend(&path.0).map(|m| self.position(m.key.unwrap_or(m.value)))
    }

    /// Line and column of the deepest part of `path` that the text has; the start of the text if it
    /// has none.
    pub fn locate_nearest(&self, path: &JsonPath) -> (usize, usize) {
        let found = (0..=path.0.len()).rev().find_map(|n| self.descend(&path.0[..n]));
        self.position(found.map_or(0, |m| m.value))
    }

    /// Line and column of a byte offset, both counted from 1; columns count characters.
    pub(super) fn position(&self, offset: usize) -> (usize, usize) {
        let mut end = offset.min(self.text.len());
        while !self.text.is_char_boundary(end) {
            end -= 1;
        }
        let before = &self.text[..end];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
    }

    /// The byte offset of a line and a column in bytes, both counted from 1; the end of the text
    /// where there is no such line.
    pub(super) fn offset(&self, line: usize, column: usize) -> usize {
        let start = match line {
            0 | 1 => 0,
            n => self.text.match_indices('\n').nth(n - 2).map_or(self.text.len(), |(i, _)| i + 1),
        };
        (start + column.saturating_sub(1)).min(self.text.len())
    }

    fn descend(&self, steps: &[Step]) -> Option<Member> {
        let start = self.text.len() - self.text.trim_start().len();
        let mut at = Member { key: None, value: start, len: self.text.len() - start };
        for step in steps {
            let inner = &self.text[at.value..at.value + at.len];
            let found = child(inner, step)?;
            at = Member {
                key: found.key.map(|k| k + at.value),
                value: found.value + at.value,
                len: found.len,
            };
        }
        Some(at)
    }

    /// An error with this file's name and the position of its path (of the nearest enclosing value
    /// where the file leaves the path out).
    #[must_use]
    pub fn located(&self, mut error: InputError) -> InputError {
        error.position = Some(self.locate_nearest(&error.path));
        error.file = Some(self.name.clone());
        error
    }
}

/// Byte offsets of a member of a JSON value.
#[derive(Clone, Copy)]
struct Member {
    key: Option<usize>,
    value: usize,
    len: usize,
}

/// The last member of the JSON value `text` that `step` leads to; offsets are relative to `text`.
fn child(text: &str, step: &Step) -> Option<Member> {
    let found = Cell::new(None);
    let mut deserializer = serde_json::Deserializer::from_str(text);
    // An error further on in the text does not make the member that was found less true.
    let _ = Find { text, step, found: &found }.deserialize(&mut deserializer);
    found.get()
}

struct Find<'a> {
    text: &'a str,
    step: &'a Step,
    found: &'a Cell<Option<Member>>,
}

impl Find<'_> {
    fn offset(&self, raw: &RawValue) -> usize {
        // Both borrow from the same text.
        raw.get().as_ptr() as usize - self.text.as_ptr() as usize
    }
}

impl<'de> DeserializeSeed<'de> for Find<'_> {
    type Value = ();
    fn deserialize<D: serde::Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Find<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an object or an array")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<&'de RawValue>()? {
            let wanted = matches!(self.step, Step::Key(k) if serde_json::from_str::<String>(key.get()).is_ok_and(|name| name == *k));
            if wanted {
                let value = map.next_value::<&'de RawValue>()?;
                self.found.set(Some(Member {
                    key: Some(self.offset(key)),
                    value: self.offset(value),
                    len: value.get().len(),
                }));
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        let mut index = 0;
        while let Some(value) = seq.next_element::<&'de RawValue>()? {
            if matches!(self.step, Step::Index(n) if *n == index) {
                self.found.set(Some(Member {
                    key: None,
                    value: self.offset(value),
                    len: value.get().len(),
                }));
                break;
            }
            index += 1;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(steps: &[&str]) -> JsonPath {
        steps.iter().fold(JsonPath::root(), |p, s| match s.parse() {
            Ok(i) => p.index(i),
            Err(_) => p.key(*s),
        })
    }

    #[test]
    fn finds_every_kind_of_step() {
        let s = Source::new(
            "f",
            "\u{feff}{\n  \"a\\u0062\": [1, {\"ü\": [true, \"x\"]}],\n  \"c\": null\n}\n",
        );
        assert_eq!(s.locate(&path(&[])), Some((1, 1)));
        assert_eq!(s.locate(&path(&["ab"])), Some((2, 14)));
        assert_eq!(s.locate(&path(&["ab", "1", "ü"])), Some((2, 24)));
        assert_eq!(s.locate(&path(&["ab", "1", "ü", "1"])), Some((2, 31)));
        assert_eq!(s.locate(&path(&["c"])), Some((3, 8)));
        assert_eq!(s.locate_key(&path(&["c"])), Some((3, 3)));
        for missing in [&["x"][..], &["ab", "2"], &["ab", "x"], &["c", "x"], &["c", "0"]] {
            assert_eq!(s.locate(&path(missing)), None);
        }
        assert_eq!(s.locate_nearest(&path(&["ab", "1", "nope", "5"])), (2, 18));
    }

    #[test]
    fn offsets_and_positions_are_inverse_on_one_byte_text() {
        let s = Source::new("f", "ab\ncd\n\ne");
        for offset in 0..s.text.len() {
            let (line, column) = s.position(offset);
            assert_eq!(s.offset(line, column), offset);
        }
        assert_eq!(s.offset(99, 1), s.text.len());
    }

    #[test]
    fn survives_texts_that_are_not_json() {
        for text in ["", "   ", "{", "[1,", "nonsense", "{\"a\": }", "{\"a\" 1}"] {
            let s = Source::new("f", text);
            assert_eq!(s.locate_nearest(&path(&["a", "0"])).0, 1);
        }
    }
}
