//! Options of the question.

use super::{
    asked::{Asked, Idle, chosen},
    directions::{self, check_directions},
};
use crate::terms::Law;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Options of `stages`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StagesOptions {
    /// How joints slide.
    pub law: Law,
    /// In place of the stages of the scene: an order in which its free blocks can be placed one by
    /// one, so that it stands all the time with as few of them held as can be.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub any_order: bool,
    /// The same where the order is given: every free block once, `*` for any letters of a name. What
    /// has to be held on the way is sought.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub order: Vec<String>,
    /// So many blocks can be held at a time; any number where nothing is said.
    pub hands: Option<usize>,
    /// Sets of blocks that the search for the least holds looks at, at most, for every structure that
    /// stands by itself; 5000 where nothing is said.
    pub tries: Option<usize>,
    /// Tilts towards these directions, where a stage has no live load.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "directions::several")]
    pub toward: Vec<[f64; 3]>,
    /// Tilts towards this many directions, evenly spread, the first along x; 8 where nothing is
    /// said.
    pub all: Option<u16>,
    /// No load factors and no tilts. Rows of a sweep ask for none: a plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_margin: bool,
    /// No least forces on what is held. Rows of a sweep ask for none: a plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_held: bool,
}

/// Most sets that a search for an order looks at: days.
pub const MOST_TRIES: usize = 1_000_000;

impl StagesOptions {
    /// Whether an order is asked for, given or sought.
    pub fn has_order(&self) -> bool {
        self.any_order || !self.order.is_empty()
    }
}

impl Asked for StagesOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        let refuse = |key: &str, text: &str| Err(InputError::at(path.key(key), text));
        let tilts = self.all.is_some() || !self.toward.is_empty();
        if self.any_order && !self.order.is_empty() {
            return refuse("any_order", "cannot be combined with \"order\"");
        }
        match self.has_order() {
            true if tilts => {
                refuse("toward", "an order is asked for: tilts are not computed beside it")
            }
            false if self.hands.is_some() => refuse("hands", "needs \"order\" or \"any_order\""),
            false if self.tries.is_some() => refuse("tries", "needs \"order\" or \"any_order\""),
            true if self.tries.is_some_and(|n| !(1..=MOST_TRIES).contains(&n)) => {
                refuse("tries", &format!("must be from 1 to {MOST_TRIES}"))
            }
            _ => check_directions(path, &self.toward, self.all),
        }
    }

    chosen!(law);

    fn quantity(&self) -> Option<&'static str> {
        Some(match self.has_order() {
            true => "blocks held at a time",
            false => "stages that stand before the first that does not",
        })
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        if self.skip_margin {
            return Some(("skip_margin", "remove it: rows give no margins"));
        }
        if self.skip_held {
            return Some(("skip_held", "remove it: rows give no forces on held blocks"));
        }
        let hint = "remove it: rows give no tilts";
        match self.all.is_some() {
            true => Some(("all", hint)),
            false => (!self.toward.is_empty()).then_some(("toward", hint)),
        }
    }

    fn for_one_number(self) -> Self {
        Self { skip_margin: true, skip_held: true, ..self }
    }
}
