//! A share of the rows, for one of several machines.

use serde::{Deserialize, Serialize};
use std::{fmt, str::FromStr};

/// Every `of`-th row, starting with the `one`-th: shard 2/3 has rows 1, 4, 7, …
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Shard {
    one: usize,
    of: usize,
}

impl Shard {
    /// All rows.
    pub const ALL: Self = Self { one: 1, of: 1 };

    /// The `one`-th of `of` shards, counted from 1.
    pub fn new(one: usize, of: usize) -> Option<Self> {
        (one >= 1 && one <= of).then_some(Self { one, of })
    }

    /// Which it is, of how many.
    pub fn numbers(self) -> (usize, usize) {
        (self.one, self.of)
    }

    /// Its rows, of so many.
    pub fn rows(self, all: usize) -> impl Iterator<Item = usize> {
        (self.one - 1..all).step_by(self.of)
    }

    /// Whether a row belongs to it.
    pub fn holds(self, row: usize) -> bool {
        row % self.of == self.one - 1
    }
}

impl Default for Shard {
    fn default() -> Self {
        Self::ALL
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.one, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text
            .split_once('/')
            .and_then(|(k, n)| Some((k.trim().parse().ok()?, n.trim().parse().ok()?)));
        parts
            .and_then(|(k, n)| Self::new(k, n))
            .ok_or_else(|| "not of the form K/N with 1 <= K <= N, such as 2/8".into())
    }
}

impl TryFrom<String> for Shard {
    type Error = String;
    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}
