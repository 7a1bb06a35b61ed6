//! Which single blocks may be taken out with everything left standing. Each is left out by itself,
//! of blocks, contacts and members that were found once, and what stands apart from it is answered
//! once for all.

use super::{Assessment, Control, Proved, part_cache::Known, saved::standing};
use base::error::{InputError, JsonPath};
use check::{proof::without::WithoutEvidence, verdict::Verdict};
use cholesky::parallel;
use model::{
    assembly::Stage,
    interface::{Model, at_stage},
};
use scene::Scene;

/// The answer of `without`.
#[derive(Clone, Debug)]
pub struct Without {
    /// One a free block, in the order of the scene.
    pub each: Vec<Left>,
}

/// What is left without one block.
#[derive(Clone, Debug)]
pub struct Left {
    /// Its blocks, contacts and loads.
    pub model: Model,
    /// Does it stand?
    pub verdict: Proved<Assessment>,
}

/// Takes every free block of a scene, prepared as `model`, out by itself, on as many threads as
/// there are processors; the answers do not depend on them.
///
/// # Errors
/// There are fewer than two free blocks.
pub fn without(scene: &Scene, model: &Model, control: &Control) -> Result<Without, InputError> {
    let known = Known::default();
    let stages = Stage::removals(&model.assembly)?;
    let each = parallel::try_map(0, &stages, |stage| {
        let model = at_stage(scene, model, stage)?;
        let verdict = known.assess(&model, control);
        Ok(Left { model, verdict })
    });
    let threads = |e| InputError::at(JsonPath::root(), format!("threads cannot be started: {e}"));
    Ok(Without { each: each.map_err(threads)?? })
}

impl Without {
    /// What it is derived from.
    pub(super) fn evidence(&self) -> WithoutEvidence {
        let left = |l: &Left| standing(&l.model, &l.verdict);
        WithoutEvidence { left: self.each.iter().map(left).collect() }
    }

    /// How many blocks may be taken out; nothing where that is open for one of them.
    pub fn count(&self) -> Option<usize> {
        let verdicts = || self.each.iter().map(|l| l.verdict.verdict);
        let open = verdicts().any(|v| v == Verdict::Undecided);
        (!open).then(|| verdicts().filter(|v| *v == Verdict::Stable).count())
    }
}
