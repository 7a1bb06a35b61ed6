//! All blocks on ground that moved: names instead of indices.

use super::simulation::frame;
use crate::ShakenScene;
use check::proof::{
    answer::Answer,
    certificate::Certificate,
    result::{QuestionKind, ResultFile},
    shaken::{ShakenAnswer, ShakenBlock, ShakenResult, ShakenWord},
};
use dynamics::ShakenFate;
use model::interface::Model;
use scene::Scene;

/// The result of `shake`.
pub fn shaken(scene: &Scene, model: &Model, s: &ShakenScene) -> ResultFile {
    let answer = Answer::Shaken(Box::new(shaken_answer(model, s)));
    let mut file = ResultFile::new(QuestionKind::Shake, scene, model, answer, Certificate::none());
    file.warnings.extend(s.shaken.findings.iter().cloned());
    file.timings.simulate = s.shaken.seconds;
    let frames = s.shaken.frames.iter().map(|f| frame(f, &[])).collect::<Vec<_>>();
    file.shaken = (!frames.is_empty()).then_some(ShakenResult { frames });
    file
}

/// What is said of a history.
pub fn shaken_answer(model: &Model, s: &ShakenScene) -> ShakenAnswer {
    let (assembly, shaken) = (&model.assembly, &s.shaken);
    let id = |i: usize| assembly.blocks[i].id.clone();
    let (fate, overturned, overturned_at) = match shaken.fate {
        ShakenFate::Overturned { block, time } => {
            (ShakenWord::Overturns, Some(id(block)), Some(time))
        }
        ShakenFate::Rests => (ShakenWord::Rests, None, None),
        ShakenFate::Moves => (ShakenWord::Moves, None, None),
    };
    let block = |i: usize| {
        let b = &shaken.blocks[i];
        ShakenBlock {
            block: id(i),
            thickness: b.thickness,
            greatest_over_thickness: b.greatest,
            at: b.at,
            residual_over_thickness: b.residual,
            greatest_turn_deg: b.turn.to_degrees(),
        }
    };
    ShakenAnswer {
        asked: s.options.clone(),
        toward: s.axes[0].into(),
        fate,
        overturned,
        overturned_at,
        blocks: assembly.free().map(block).collect(),
        fidelity: shaken.fidelity,
        step: shaken.step,
        substeps: shaken.substeps,
        steps: shaken.steps,
        time: shaken.time,
        stop: shaken.stop,
    }
}
