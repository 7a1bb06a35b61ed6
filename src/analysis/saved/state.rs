//! States of joints that yield.

use super::{bound, certificate, verdict_answer, warn};
use crate::state::Stated;
use check::proof::{
    answer::{Answer, LimitAnswer, LoadFactorAnswer},
    certificate::Certificate,
    member::lines,
    result::{Direction, QuestionKind, ResultFile},
    state::{Given, StateAnswer, StateResult, StepResult, displacements},
};
use model::interface::Model;
use scene::Scene;

/// The result of `state`.
pub fn state(scene: &Scene, model: &Model, asked: &Stated) -> ResultFile {
    let limit = asked.bound.as_ref().map(|b| bound(b));
    let answer = match &asked.track {
        Some(track) => Given {
            model,
            joints: &asked.joints,
            quadrature: asked.options.quadrature,
            track,
            proof: asked.rest.grade(),
            control: asked.control,
            end: asked.end,
            bound: limit,
        }
        .answer(),
        None => StateAnswer::without(asked.standing(), asked.options.quadrature),
    };
    let evidence = match &asked.track {
        Some(_) => certificate(model, &asked.rest),
        None => Certificate::none(),
    };
    let mut file = ResultFile::new(
        QuestionKind::State,
        scene,
        model,
        Answer::State(Box::new(answer)),
        evidence,
    );
    if let Some(track) = &asked.track {
        file.members = lines(model, &track.forces);
    }
    file.warnings.extend(asked.joints.findings.iter().cloned());
    if asked.track.is_some() || asked.rest.refused().is_some() {
        warn(&mut file, &asked.rest);
    }
    let steps = asked.track.iter().flat_map(|t| &t.steps).map(|s| StepResult {
        load_factor: s.load_factor,
        displacements: displacements(model, &s.displaced),
    });
    let bound = asked.bound.as_ref().map(|l| {
        file.trace.extend(l.attempts.iter().cloned());
        file.left_out.clone_from(&l.left_out);
        warn(&mut file, l);
        Direction {
            answer: Answer::Limit(LimitAnswer {
                load_factor: LoadFactorAnswer::new(super::bound(l), None),
                verdict: None,
                part: l.part.clone(),
                proof: l.grade(),
            }),
            certificate: certificate(model, l),
            dry: None,
        }
    });
    file.state = Some(StateResult { steps: steps.collect(), bound, newton_steps: asked.steps });
    if let Some(dead) = &asked.verdict {
        file.dead_load = Some(Direction {
            answer: Answer::Verdict(verdict_answer(dead)),
            certificate: certificate(model, dead),
            dry: None,
        });
        file.trace.extend(dead.attempts.iter().cloned());
        warn(&mut file, dead);
    }
    file
}
