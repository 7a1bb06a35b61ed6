//! An order in which blocks are placed.

use model::assembly::Placed;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An order in which a structure is built block by block, and what is held on the way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Order {
    /// It was given; else it was sought.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub given: bool,
    /// Sets of blocks looked at, at most.
    pub tries: usize,
    /// With fewer held at a time there is no such order: computed by a search through all of them,
    /// not proved. Where tries or time were up, as far as it went.
    pub least_held: usize,
    /// The blocks in their order; none where time was up before one was found.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub placed: Vec<Placed>,
}

impl Order {
    /// The most blocks that are held at a time; nothing where no order was found.
    pub fn most_held(&self) -> Option<usize> {
        self.placed.iter().map(|p| p.held.len()).max()
    }
}
