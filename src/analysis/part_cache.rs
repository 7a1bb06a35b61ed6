//! Models that have independent parts in common: each part is answered once.
//!
//! No load, force or rate of a part depends on anything beside it, and each is asked in units and
//! about an origin of its own ([`model::interface::parts`]). So its answer is the same to the last
//! bit in every model that has the same blocks in it, free and held alike, with the same loads,
//! contacts and members; contacts follow from the blocks where all models are made of one
//! ([`model::interface::at_stage`]). What is taken over is checked again in each model
//! ([`Proved`]).

use super::{Assessment, Control, Proved, assess::of_part, parts};
use check::verdict::Verdict;
use model::{
    assembly::Wrench,
    interface::{Model, Part},
};
use std::{
    collections::HashMap,
    sync::{Arc, Mutex, PoisonError},
};

/// What tells parts of models that are made of one apart: blocks by name and whether they are held,
/// the bits of their loads, members by name, and how many contacts between supports are counted.
#[derive(PartialEq, Eq, Hash)]
struct Key(Vec<(String, bool)>, Vec<u64>, Vec<String>, usize);

impl Key {
    fn new(model: &Model, part: &Part) -> Self {
        let blocks = part.blocks.iter().map(|&i| &model.assembly.blocks[i]);
        let bits = |w: &Wrench| w.force.iter().chain(&w.moment).map(|v| v.to_bits()).collect();
        let of = &model.assembly;
        let wrenches = part.blocks.iter().flat_map(|&i| [&of.dead[i], &of.live[i]]);
        let loads = wrenches.flat_map(|w| -> Vec<u64> { bits(w) });
        let members = part.members.iter().map(|&m| model.interfaces.members[m].id.clone());
        Self(
            blocks.map(|b| (b.id.clone(), b.support)).collect(),
            loads.collect(),
            members.collect(),
            part.model.interfaces.support_pairs,
        )
    }
}

type Slot = Arc<Mutex<Option<Assessment>>>;

/// Answers about parts of models that are made of one.
#[derive(Default)]
pub(super) struct Known(Mutex<HashMap<Key, Slot>>);

impl Known {
    /// Decides whether a model stands under its dead load, part by part. Threads that ask about the
    /// same part wait for each other.
    pub fn assess(&self, model: &Model, control: &Control) -> Proved<Assessment> {
        let solve = |part: &Part, control: &Control| {
            let slot = {
                let mut slots = self.0.lock().unwrap_or_else(PoisonError::into_inner);
                slots.entry(Key::new(model, part)).or_default().clone()
            };
            let mut known = slot.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(answer) = &*known {
                return answer.clone();
            }
            let answer = of_part(&part.model, control);
            // With more time it might be decided.
            if answer.verdict != Verdict::Undecided || !control.deadline.is_set() {
                *known = Some(answer.clone());
            }
            answer
        };
        Proved::new(model, parts::assess::assess_by(model, control, &solve))
    }
}
