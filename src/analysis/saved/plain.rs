//! The result of a question, without what weakens it.

use super::{derived::made, evidence, run};
use crate::{Answer as Answered, Question};
use base::error::InputError;
use check::proof::ResultFile;
use model::interface::Model;
use scene::Scene;

/// The result of a question; packings have one of their own ([`packing`](super::packing())).
///
/// # Errors
/// The answer is one about a packing, or is none to the question.
pub fn of(
    question: &Question,
    scene: &Scene,
    model: &Model,
    answer: &Answered,
) -> Result<ResultFile, InputError> {
    let (question, evidence) = evidence::of(question, model, answer)?;
    made(question, scene, model, (evidence, None), run::of(scene, model, answer))
}
