//! A stage of construction with its names resolved.

use super::Assembly;
use crate::error::JsonPath;

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
    pub fn removals(assembly: &Assembly) -> Vec<Self> {
        let without = |i: usize| {
            let mut stage = Self::whole(assembly.blocks.len());
            stage.present[i] = false;
            stage.name = format!("without {}", assembly.blocks[i].id);
            stage.path = assembly.blocks[i].path.clone();
            stage
        };
        assembly.free().map(without).collect()
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
