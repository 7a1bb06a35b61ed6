//! Whether statics agrees that a heap rests: forces inside the friction cones that balance every
//! grain as it lies, by a method that shares nothing with the dynamics but the places of the grains.

use super::super::{Control, assess, stability::held};
use check::verdict::Verdict;
use model::interface::prepare;
use scene::Scene;
use serde::{Deserialize, Serialize};

/// Grains that are named where many creep.
const NAMED: usize = 5;

/// What statics says of a heap at rest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Confirmed {
    /// How often the heap settled with finer steps until it was so.
    pub rounds: usize,
    /// Whether admissible forces exist.
    pub admissible: bool,
    /// Ids of the grains that nothing balances as they lie, the fastest first: they creep, too
    /// slowly for the engine to call it motion.
    pub creeping: Vec<String>,
}

impl Confirmed {
    /// What there is to say of it; nothing where forces exist.
    pub fn says(&self) -> Option<String> {
        let named: Vec<&str> = self.creeping.iter().take(NAMED).map(String::as_str).collect();
        let more = if self.creeping.len() > NAMED { ", …" } else { "" };
        (!self.admissible).then(|| {
            format!(
                "no admissible forces exist for the heap as it lies, after {} rounds of finer steps: {} grains creep ({}{more})",
                self.rounds,
                self.creeping.len(),
                named.join(", ")
            )
        })
    }
}

/// The grains that creep; none where admissible forces exist, `None` where that stayed open or the
/// scene has no model.
pub(super) fn creeping(heap: &Scene, control: &Control) -> Option<Vec<String>> {
    let (model, _) = held(&prepare(heap).ok()?);
    let answer = assess(&model, control);
    match answer.verdict {
        Verdict::Stable | Verdict::Conditional => Some(Vec::new()),
        Verdict::Unstable => {
            let moving = answer.mechanism.as_ref().map(|m| model.ids(&m.moving));
            moving.filter(|ids| !ids.is_empty())
        }
        Verdict::Undecided => None,
    }
}
