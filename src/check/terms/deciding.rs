//! Which part of a scene decided an answer.

use model::interface::Part;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The part of a scene that decided an answer, where there are several.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Deciding {
    /// Its first free block.
    pub first: String,
    /// How many free blocks it has.
    pub blocks: usize,
    /// How many free blocks the scene has.
    pub of_blocks: usize,
    /// How many parts the scene has.
    pub of_parts: usize,
}

impl Deciding {
    /// The name of part `index`; none where it is the only one.
    pub fn new(parts: &[Part], index: usize) -> Option<Self> {
        let part = parts.get(index).filter(|_| parts.len() > 1)?;
        Some(Self {
            first: part.name().to_string(),
            blocks: part.free_count(),
            of_blocks: parts.iter().map(Part::free_count).sum(),
            of_parts: parts.len(),
        })
    }
}

impl fmt::Display for Deciding {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { first, blocks, of_blocks, of_parts } = self;
        write!(
            f,
            "the part with {first}: {blocks} of {of_blocks} free blocks, one of {of_parts} independent parts"
        )
    }
}
