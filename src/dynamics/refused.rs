//! What the engine does not take, as an error about the scene.

use base::error::{InputError, JsonPath};
use model::assembly::Block;

/// What the engine does not take.
#[derive(Debug)]
pub enum Refused {
    /// A piece of this body.
    Piece(usize),
    /// The number of threads, and why.
    Threads(String),
}

impl Refused {
    /// This as an error about the block, by its name.
    pub fn told(self, blocks: &[Block]) -> InputError {
        match self {
            Self::Threads(why) => InputError::at(
                JsonPath::root(),
                format!("the simulation could not start its threads: {why}"),
            )
            .hint("give --threads 1"),
            Self::Piece(body) => {
                let Block { id, path, .. } = &blocks[body];
                let text = format!("the simulation rejects a piece of block {id:?}");
                InputError::at(path.clone(), text)
                    .hint("give it a simpler shape, or run `voussoir assess`")
            }
        }
    }
}
