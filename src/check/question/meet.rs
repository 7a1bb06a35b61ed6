//! What is asked of a number of the scene until what is required is met.

use super::{CriticalOptions, Question, asked::Asked, combinations::check_nested};
use crate::terms::Law;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Values scanned where nothing is said. Fewer: more changes stay unseen. More: time, for each is a
/// whole answer.
pub const MEET_SCAN: usize = 9;

/// Options of `meet`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeetOptions {
    /// What is asked, with what is required: `assess`, `limit`, `moving`, `tilt` or `kinematic`.
    pub ask: Box<Question>,
    /// JSON pointer of the number that varies.
    pub vary: String,
    /// Both ends of the range.
    pub between: [f64; 2],
    /// Values scanned, both ends among them: 9 where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scan: Option<usize>,
}

impl Asked for MeetOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        Asked::check(&self.range(), path)?;
        check_nested(&self.ask, &path.key("ask"))
    }

    fn law(&self) -> Law {
        self.ask.law()
    }

    fn law_mut(&mut self) -> Option<&mut Law> {
        self.ask.law_mut()
    }

    fn quantity(&self) -> Option<&'static str> {
        Some("value at which what is required is met")
    }
}

impl MeetOptions {
    /// The number, its range, and the values that are scanned.
    pub fn range(&self) -> CriticalOptions {
        CriticalOptions {
            law: self.law(),
            vary: self.vary.clone(),
            between: self.between,
            scan: Some(self.scan.unwrap_or(MEET_SCAN)),
        }
    }
}
