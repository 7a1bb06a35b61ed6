//! A question in every combination of actions. Where blocks touch is found once; loads and strengths
//! are those of each.

use super::{Answer, Control, ask, saved};
use base::error::{InputError, JsonPath};
use check::{
    proof::{
        ResultFile,
        combinations::{self, CombinationsEvidence},
        nested::NestedEvidence,
    },
    question::CombinationsOptions,
};
use cholesky::parallel;
use model::interface::Model;
use scene::Scene;

/// The answer of `combinations`.
#[derive(Clone, Debug)]
pub struct Combined {
    /// One a combination, in the order of the scene.
    pub list: Vec<InCombination>,
}

/// A combination with its answer.
#[derive(Clone, Debug)]
pub struct InCombination {
    /// Its name.
    pub name: String,
    /// The scene with its factors, prepared.
    pub model: Model,
    /// The answer.
    pub answer: Answer,
    /// The same as it is told.
    pub file: ResultFile,
}

/// Asks in every combination, on as many threads as there are processors; the answers do not depend
/// on them.
///
/// # Errors
/// The scene has no combinations, or the question has no answer in one of them.
pub fn combined(
    o: &CombinationsOptions,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Result<Combined, InputError> {
    let places = combinations::asked(o, scene)?;
    let question = o.question(scene);
    let list = parallel::try_map(0, &places, |&k| {
        let name = scene.combinations[k].name.clone();
        let scene = scene.in_combination(&name)?;
        let model = model.alike(&scene)?;
        let answer = ask(&question, &scene, &model, control)?;
        let file = saved::of(&question, &scene, &model, &answer)?;
        Ok(InCombination { name, model, answer, file })
    });
    let threads = |e| InputError::at(JsonPath::root(), format!("threads cannot be started: {e}"));
    Ok(Combined { list: list.map_err(threads)?? })
}

impl Combined {
    /// The one that governs.
    pub fn worst(&self) -> Option<&InCombination> {
        let height = |c: &&InCombination| c.file.nested().height();
        let by = |a: (u8, f64), b: (u8, f64)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
        self.list.iter().min_by(|a, b| by(height(a), height(b)))
    }

    /// What it is derived from.
    pub(super) fn evidence(&self) -> CombinationsEvidence {
        let one = |c: &InCombination| NestedEvidence {
            question: c.file.question.clone(),
            evidence: c.file.evidence().clone(),
        };
        CombinationsEvidence { list: self.list.iter().map(one).collect() }
    }
}
