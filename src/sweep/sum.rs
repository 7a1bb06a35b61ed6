//! Check sums of rows: whether a row, or the header above it, is still what the program wrote. They
//! are there against mistakes (an editor, a merge by hand, a worn disk), not against forgery: who
//! wants to can compute them anew.

use base::{error::RowsError, plain};
use fnv::FnvHasher;
use serde::Serialize;
use std::{hash::Hasher, io};

/// The text before the sum, which ends the line.
const KEY: &[u8] = b",\"sum\":\"";
/// The text behind it.
const END: &[u8] = b"\"}";
/// Digits of a sum.
const DIGITS: usize = 16;

/// Whether a row is what was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Checked {
    /// It is.
    Same,
    /// It has no sum, as older versions wrote them.
    Unknown,
    /// It is not.
    Edited,
}

/// The header that the rows of a file stand under; it goes into their sums.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seal(u64);

impl Seal {
    /// Of the first line of a file, with or without its end.
    pub fn new(header: &[u8]) -> Self {
        Self(sum(FnvHasher::default().finish(), header.trim_ascii_end()))
    }

    /// A row as one line with its sum.
    pub fn line(self, row: &impl Serialize) -> io::Result<String> {
        let mut text = plain::json(serde_json::to_string(row)?);
        // The brace comes back behind the sum.
        text.pop();
        let sum = sum(self.0, text.as_bytes());
        Ok(format!(
            "{text}{}{sum:0DIGITS$x}{}\n",
            String::from_utf8_lossy(KEY),
            String::from_utf8_lossy(END)
        ))
    }

    /// Looks at a line without its end.
    pub fn check(self, line: &[u8]) -> Checked {
        let parts = line
            .strip_suffix(END)
            .and_then(|l| l.split_last_chunk::<DIGITS>())
            .and_then(|(l, s)| Some((l.strip_suffix(KEY)?, s)));
        let Some((text, digits)) = parts else {
            return if line.windows(KEY.len()).any(|w| w == KEY) {
                Checked::Edited
            } else {
                Checked::Unknown
            };
        };
        let said = std::str::from_utf8(digits).ok().and_then(|d| u64::from_str_radix(d, 16).ok());
        if said == Some(sum(self.0, text)) { Checked::Same } else { Checked::Edited }
    }

    /// Refuses a row that was edited. Returns whether it has a sum; where `all` rows of the file
    /// have one, it must.
    pub fn require(
        self,
        line: &[u8],
        all: bool,
        at: impl FnOnce(String) -> RowsError,
    ) -> Result<bool, RowsError> {
        let remedy =
            "remove the line to recompute the row, or restore the first line if that was edited";
        match self.check(line) {
            Checked::Same => Ok(true),
            Checked::Unknown if !all => Ok(false),
            Checked::Unknown => {
                Err(at(format!("the row was edited: its checksum is missing; {remedy}")))
            }
            Checked::Edited => Err(at(format!(
                "the row or the first line of the file was edited: the checksum differs; {remedy}"
            ))),
        }
    }
}

/// FNV-1a, 64 bits (Fowler, Noll & Vo; draft-eastlake-fnv), going on from a sum.
fn sum(from: u64, bytes: &[u8]) -> u64 {
    let mut hasher = FnvHasher::with_key(from);
    hasher.write(bytes);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn every_changed_byte_is_noticed() {
        // http://www.isthe.com/chongo/src/fnv/test_fnv.c
        assert_eq!(sum(FnvHasher::default().finish(), b"foobar"), 0x8594_4171_f739_67e8);
        let seal = Seal::new(b"{\"format\":1}\n");
        let line = seal.line(&json!({ "row": 3, "value": 0.5, "seconds": 0.25 })).unwrap();
        let line = line.trim_end().as_bytes();
        assert_eq!(serde_json::from_slice::<serde_json::Value>(line).unwrap()["value"], 0.5);
        assert_eq!(seal.check(line), Checked::Same);
        assert_eq!(Seal::new(b"{\"format\":2}").check(line), Checked::Edited);
        for at in 0..line.len() {
            let mut other = line.to_vec();
            other[at] ^= 1;
            assert_ne!(seal.check(&other), Checked::Same, "byte {at}");
        }
        assert_eq!(seal.check(b"{\"row\":3,\"seconds\":0.25}"), Checked::Unknown);
        assert!(
            seal.require(b"{\"row\":3}", true, |why| RowsError::Unreadable {
                file: "f".into(),
                why
            })
            .is_err()
        );
    }
}
