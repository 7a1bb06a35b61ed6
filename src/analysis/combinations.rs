//! A question in every combination of actions. Where blocks touch is found once; loads and strengths
//! are those of each.

use super::{
    Control,
    answer::{Combined, Door, InCombination},
    saved::of,
    watch::Counted,
};
use base::error::{InputError, JsonPath};
use check::{proof::combinations, question::CombinationsOptions};
use cholesky::parallel;
use model::{assembly::resolve_blocks, interface::Model};
use scene::Scene;

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
    ask: Door,
) -> Result<Combined, InputError> {
    let places = combinations::asked(o, scene)?;
    let question = o.question(scene);
    let blocks = resolve_blocks(scene)?;
    let counted = Counted::new(control.watcher, "combination", places.len());
    let list = parallel::try_map(0, &places, |&k| {
        counted.next();
        let name = scene.combinations[k].name.clone();
        let scene = scene.in_combination(&name)?;
        let model = model.of_blocks(&scene, blocks.clone())?;
        let answer = ask(&question, &scene, &model, control)?;
        let file = of(&question, &scene, &model, &answer)?;
        Ok(InCombination { name, model, answer, file })
    });
    let threads = |e| InputError::at(JsonPath::root(), format!("threads cannot be started: {e}"));
    Ok(Combined { list: list.map_err(threads)?? })
}
