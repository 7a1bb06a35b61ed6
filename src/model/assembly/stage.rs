//! A stage of construction with its names resolved.

use super::Assembly;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A block that is placed in a structure, and the blocks that are held while it stands as far as
/// that.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Placed {
    /// The block that comes.
    pub block: String,
    /// Free blocks that are held then; it may be one of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<String>,
}

/// Which stages are asked about.
#[derive(Clone, Copy, Debug)]
pub enum AskedStages<'a> {
    /// Those that the scene names.
    OfScene,
    /// One for each block that is placed.
    InOrder(&'a [Placed]),
}

/// What stands at a stage, and what is held.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Its name.
    pub name: String,
    /// Where it stands in the scene file.
    pub path: JsonPath,
    /// Whether each block of the scene is there.
    pub present: Vec<bool>,
    /// Whether each block that the scene leaves free is held in place.
    pub held: Vec<bool>,
    /// Members of the scene that are not there, by name.
    pub without_members: Vec<String>,
    /// Loads of the scene that are not there, by name.
    pub without_loads: Vec<String>,
}

impl Stage {
    /// Everything stands and nothing is held.
    pub fn whole(blocks: usize) -> Self {
        Self {
            name: String::new(),
            path: JsonPath::root(),
            present: vec![true; blocks],
            held: vec![false; blocks],
            without_members: Vec::new(),
            without_loads: Vec::new(),
        }
    }

    /// For every free block the stage without it, in the order of the scene.
    ///
    /// # Errors
    /// There are fewer than two free blocks.
    pub fn removals(assembly: &Assembly) -> Result<Vec<Self>, InputError> {
        let without = |i: usize| {
            let mut stage = Self::whole(assembly.blocks.len());
            stage.present[i] = false;
            stage.name = format!("without {}", assembly.blocks[i].id);
            stage.path = assembly.blocks[i].path.clone();
            stage
        };
        let all: Vec<Self> = assembly.free().map(without).collect();
        if all.len() < 2 {
            let text = "there are fewer than two free blocks: removing one leaves nothing to check";
            return Err(InputError::at(JsonPath::root(), text).hint("ask `voussoir assess`"));
        }
        Ok(all)
    }

    /// For every block that is placed the stage after it, in this order; where all that is there is
    /// held, there is nothing to decide, and no stage.
    ///
    /// # Errors
    /// A block is none of the free ones, is placed twice, or is held before it is there.
    pub fn in_order(assembly: &Assembly, placed: &[Placed]) -> Result<Vec<Self>, InputError> {
        let mut stage = Self::whole(assembly.blocks.len());
        assembly.free().for_each(|i| stage.present[i] = false);
        let mut stages = Vec::new();
        for Placed { block, held } in placed {
            let free = |id: &str| {
                let here = assembly.find(id).filter(|&i| !assembly.blocks[i].support);
                let text = format!("no free block is called {id:?}");
                here.ok_or_else(|| InputError::at(JsonPath::root(), text))
            };
            let refuse = |text: String| Err(InputError::at(JsonPath::root(), text));
            let i = free(block)?;
            if stage.present[i] {
                return refuse(format!("{block:?} is placed twice"));
            }
            stage.present[i] = true;
            stage.held.fill(false);
            for id in held {
                let i = free(id)?;
                if !stage.present[i] {
                    return refuse(format!("{id:?} is held before it is placed"));
                }
                stage.held[i] = true;
            }
            stage.name = format!("place {block}");
            stage.path = assembly.blocks[i].path.clone();
            if assembly.free().any(|i| stage.present[i] && !stage.held[i]) {
                stages.push(stage.clone());
            }
        }
        Ok(stages)
    }

    /// Blocks that are held here and move otherwise, as indices.
    pub fn holds(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.held.len()).filter(|&i| self.held[i] && self.present[i])
    }

    /// Blocks that are not there, as indices.
    pub fn absent(&self) -> Vec<usize> {
        (0..self.present.len()).filter(|&i| !self.present[i]).collect()
    }

    /// Whether a member of this name is there; those of a strip and fingers of a grip go by the
    /// name before the slash.
    pub fn has_member(&self, id: &str) -> bool {
        !self.without_members.iter().any(|m| is_of(id, m))
    }
}

/// Whether `id` is that of a member called `name`, or of a part of it.
pub(super) fn is_of(id: &str, name: &str) -> bool {
    id.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}
