//! Stages of construction.

use super::{assessment, certificate, of};
use crate::{
    Answer as Answered,
    stages::{Staged, Stages},
    thrust::ThrustEnd,
};
use base::error::{Finding, FindingCode};
use check::{
    proof::{
        answer::Answer,
        certificate::Certificate,
        result::{QuestionKind, ResultFile},
        stages::{HeldForce, StageProof, StageResult, StagesResult, reactions_of, weight_along},
    },
    terms::{Attempt, Bound},
    verdict::{Verdict, thrust::Sought},
};
use model::interface::Model;
use scene::Scene;

/// The result of `stages`; `model` is that of the whole scene.
pub fn stages(scene: &Scene, model: &Model, asked: &Stages) -> ResultFile {
    // Evidence of a stage names the scene in no place.
    let bare = Scene { name: scene.name.clone(), ..Scene::default() };
    let mut told = Vec::new();
    let list = asked.stages.iter().map(|s| stage(&bare, model, s, &mut told)).collect();
    let Stages { remove_each, order, hands, .. } = asked;
    let result =
        StagesResult { remove_each: *remove_each, order: order.clone(), hands: *hands, list };
    let answer = result.answer();
    let mut file = ResultFile::new(
        QuestionKind::Stages,
        scene,
        model,
        Answer::Stages(Box::new(answer)),
        Certificate::none(),
    );
    if model.interfaces.left_out.is_some() {
        let text = "contacts between blocks that overlap or nearly touch are left out at every stage: no stage is asked again with them closed, `assess` does that for the whole scene";
        file.warnings.push(Finding::new(FindingCode::ContactIgnored, text.to_string()));
    }
    for (stage, seconds, said, trace) in told {
        // What stages have in common was tried once.
        let new: Vec<_> = trace.into_iter().filter(|a| !file.trace.contains(a)).collect();
        file.trace.extend(new);
        file.timings.check += seconds;
        let said = said.into_iter();
        file.warnings.extend(said.map(|w| Finding { text: format!("{stage}: {}", w.text), ..w }));
    }
    file.stages = Some(result);
    file
}

/// Of an answer about a stage: the stage, the seconds of its check, what was said, what was tried.
type Told = (String, f64, Vec<Finding>, Vec<Attempt>);

fn stage(scene: &Scene, whole: &Model, s: &Staged, told: &mut Vec<Told>) -> StageResult {
    let model = &s.model;
    let mut proof = |mut file: ResultFile| {
        let said = std::mem::take(&mut file.warnings);
        let trace = std::mem::take(&mut file.trace);
        told.push((s.stage.name.clone(), file.timings.check, said, trace));
        StageProof::from(file)
    };
    let verdict = proof(assessment(scene, model, &s.verdict));
    let margin = s.margin.as_ref().and_then(|m| match m {
        Answered::Limit(_) | Answered::Tilt(_) => of(scene, model, m).map(&mut proof),
        _ => None,
    });
    let stands = s.verdict.verdict == Verdict::Stable;
    let reactions = if stands { reactions_of(model, &verdict.certificate) } else { Vec::new() };
    let least_forces = s.held.iter().filter_map(|end| {
        let Sought::Thrust(at) = end.at else { return None };
        let ThrustEnd { outcome, value, bracket, .. } = **end;
        let least = Bound::new(outcome, value, bracket);
        let weight = weight_along(model, at.support, at.direction);
        Some(HeldForce {
            block: model.assembly.blocks[at.support].id.clone(),
            direction: at.direction,
            needed: HeldForce::needed(&least, weight),
            least,
            weight,
            certificate: certificate(model, end),
        })
    });
    StageResult {
        name: s.stage.name.clone(),
        blocks: model.assembly.blocks.len(),
        held: whole.ids(&s.stage.holds().collect::<Vec<_>>()),
        verdict,
        margin,
        no_margin: s.no_margin.clone(),
        reactions,
        least_forces: least_forces.collect(),
        doubt: s.doubt.clone(),
    }
}
