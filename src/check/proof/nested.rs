//! A question asked of another scene on the way to an answer: of one combination of actions, at one value
//! of a number that varies.

use super::{
    answer::{Answer, Required},
    derive::Derivation,
    evidence::Evidence,
};
use crate::question::{Question, is_the_same};
use model::interface::Model;
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A question with what was not said written out, and the evidence for its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NestedEvidence {
    /// The question.
    pub question: Question,
    /// The evidence.
    pub evidence: Evidence,
}

/// The answer to a question about one of several scenes.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Nested {
    /// The answer.
    pub answer: Answer,
    /// What was required of it, and whether it is met.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub required: Option<Required>,
}

impl Nested {
    /// Whether what is asked holds: what is required is met, or it stands; `None` where that is open.
    pub fn holds(&self) -> Option<bool> {
        match self.required {
            Some(required) => required.met,
            None => match self.answer.verdict()? {
                crate::verdict::Verdict::Stable => Some(true),
                crate::verdict::Verdict::Undecided => None,
                _ => Some(false),
            },
        }
    }

    /// What orders answers, the worst first: what does not hold, what is open, what holds; among these
    /// the load factor.
    pub fn height(&self) -> (u8, f64) {
        let rank = match self.holds() {
            Some(false) => 0,
            None => 1,
            Some(true) => 2,
        };
        let value = self.answer.load_factor().map_or(0.0, |l| {
            let unlimited = l.status == super::answer::FactorStatus::Unbounded;
            let known = l.value.or(l.lower);
            known.unwrap_or(if unlimited { f64::INFINITY } else { f64::NEG_INFINITY })
        });
        (rank, value)
    }
}

impl Derivation<'_> {
    /// Derives the answer to a question about another scene; its parts stand under a title.
    pub(super) fn nested(
        &mut self,
        title: &str,
        asked: &Question,
        (scene, model): (&Scene, &Model),
        e: &NestedEvidence,
    ) -> Result<Nested, String> {
        if !is_the_same(asked, &e.question, model.assembly.gravity) {
            return Err(format!("{title}: the question is not the one that was asked"));
        }
        let check = Default::default();
        let mut own = Derivation { question: &e.question, scene, model, again: self.again, check };
        let told = own.told(&e.evidence).map_err(|e| format!("{title}: {e}"))?;
        for (part, findings) in own.check.parts {
            self.part(format!("{title}: {part}"), findings);
        }
        let required = Required::of(&e.question, scene, &told.answer);
        Ok(Nested { answer: told.answer, required })
    }
}
