//! Results of `without`: for every free block the verdict on all others, with its evidence.

use super::{
    answer::{Answer, VerdictAnswer},
    derive::{Derivation, require},
    evidence::Standing,
    told::Told,
};
use crate::verdict::{Verdict, claim::Findings, exact::Grade};
use model::{
    assembly::Stage,
    interface::{Model, at_stage},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::sync::Arc;

/// Of `without`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WithoutEvidence {
    /// Of the verdict on what is left, one a free block, in the order of the scene.
    pub left: Vec<Standing>,
}

/// Which blocks may be taken out, one at a time.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct WithoutAnswer {
    /// The blocks without which the others stand.
    pub removable: Vec<String>,
    /// Every free block, in the order of the scene.
    pub each: Vec<Without>,
    /// How exactly the verdicts are proved, the weakest of all; absent where one is undecided.
    pub proof: Option<Grade>,
}

/// A scene without one block.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Without {
    /// The block that is taken out.
    pub block: String,
    /// What the others do.
    #[serde(flatten)]
    pub left: VerdictAnswer,
    /// The blocks that move then, the fastest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub moving: Vec<String>,
}

impl WithoutAnswer {
    fn new(each: Vec<Without>) -> Self {
        let stands = |w: &&Without| w.left.verdict == Verdict::Stable;
        let grades = each.iter().map(|w| w.left.proof);
        Self {
            removable: each.iter().filter(stands).map(|w| w.block.clone()).collect(),
            proof: grades.reduce(|a, b| Some(a?.and(b?))).flatten(),
            each,
        }
    }

    /// The blocks without which the others are told this verdict.
    pub fn with(&self, verdict: Verdict) -> impl Iterator<Item = &Without> {
        self.each.iter().filter(move |w| w.left.verdict == verdict)
    }
}

/// Every scene without a block is made anew, and its verdict derived there.
pub(super) fn derive(d: &mut Derivation, e: &WithoutEvidence) -> Result<Told, String> {
    let (scene, model) = (d.scene, d.model);
    let stages = Stage::removals(&model.assembly).map_err(|e| e.to_string())?;
    let mut f = Findings::default();
    let text = format!("every free block has a verdict ({} in all)", stages.len());
    require(&mut f, e.left.len() <= stages.len(), text);
    d.part("blocks", f);
    let nothing = Standing::default();
    let mut each = Vec::new();
    for (k, stage) in stages.iter().enumerate() {
        let there = at_stage(scene, model, stage).map_err(|e| format!("{}: {e}", stage.name))?;
        let block = model.ids(&stage.absent()).concat();
        each.push(one(d, (&stage.name, block), &there, e.left.get(k).unwrap_or(&nothing)));
    }
    let answer = WithoutAnswer::new(each);
    d.check.claimed = answer.with(Verdict::Undecided).count() < answer.each.len();
    Ok(Told::new(model, Answer::Without(Box::new(answer)), &Arc::default()))
}

/// The verdict on what is left.
fn one(d: &mut Derivation, (title, block): (&str, String), model: &Model, e: &Standing) -> Without {
    let mut f = Findings::default();
    let (left, proven) = d.verdict(&mut f, model, e);
    d.part(title, f);
    let mut told = Told::new(model, Answer::Verdict(left.clone()), &e.certificate);
    told.in_words(model, proven.as_ref());
    Without { block, left, moving: told.mechanism.map(|m| m.moving).unwrap_or_default() }
}
