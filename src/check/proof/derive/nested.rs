//! A question asked of another scene on the way to an answer: of one combination of actions, at one value
//! of a number that varies.

use super::Derivation;
use crate::{
    proof::{
        answer::{Nested, Required},
        evidence::NestedEvidence,
    },
    question::{Question, is_the_same},
};
use model::interface::Model;
use scene::Scene;

impl Derivation<'_> {
    /// Derives the answer to a question about another scene; its parts stand under a title.
    pub(in crate::proof) fn nested(
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
