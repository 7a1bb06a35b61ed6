//! What a check computes again, with the solvers and the engine of this build.

use crate::{
    Answer, AssessOptions, Control, CriticalOptions, KinematicOptions, LimitOptions, MovingOptions,
    Question, ThrustOptions, TiltOptions, Watch, ask, ask_watched, closing, coulomb,
    critical::probe, saved, stages,
};
use base::error::InputError;
use check::{
    proof::{
        self,
        recompute::Recompute,
        result::{QuestionKind, ResultFile},
        rocking::RockingAnswer,
        shaken::ShakenAnswer,
        verify::Verification,
    },
    rocking::RockOptions,
    terms::{ClosedAnswer, Law, Order, StateMotion, Stop},
    verdict::Verdict,
};
use dynamics::Progress;
use model::interface::Model;
use scene::Scene;
use std::ops::ControlFlow;

/// Asks again by the questions of this crate.
#[derive(Clone, Copy, Debug)]
pub struct Solvers;

/// Verifies a result against a scene, the one inside it or one that the reader trusts more, and
/// computes again what no theorem says.
///
/// # Errors
/// The scene cannot be resolved.
pub fn verify(file: &ResultFile, scene: &Scene) -> Result<Verification, InputError> {
    proof::verify(file, scene, &Solvers)
}

impl Recompute for Solvers {
    fn motion(&self, model: &Model) -> Option<StateMotion> {
        Some(coulomb::motion(model, &Control::default()))
    }

    fn rests_alone(&self, model: &Model) -> Option<bool> {
        Some(coulomb::rests_alone(model, &Control::default()))
    }

    fn with_value(
        &self,
        scene: &Scene,
        pointer: &str,
        value: f64,
        law: Law,
    ) -> Option<Result<(Verdict, f64), InputError>> {
        let control = Control { law, ..Control::default() };
        let probe = probe(scene, pointer, value, &control);
        Some(probe.map(|p| (p.assessment.verdict, p.unbalance())))
    }

    fn closed(
        &self,
        file: &ResultFile,
        law: Law,
        scene: &Scene,
        model: &Model,
    ) -> Option<Option<(Law, ClosedAnswer)>> {
        let all = file.directions.iter().map(|d| &d.answer).chain([&file.answer]);
        let toward = all.filter_map(proof::Answer::toward).collect();
        let question = match (file.question, &file.answer, &file.critical) {
            (QuestionKind::Assess, ..) | (QuestionKind::Thrust, proof::Answer::Verdict(_), _) => {
                Question::Assess(AssessOptions { law })
            }
            (QuestionKind::Limit, ..) => Question::Limit(LimitOptions::default()),
            (QuestionKind::Tilt, ..) => {
                Question::Tilt(TiltOptions { toward, ..TiltOptions::default() })
            }
            (QuestionKind::Moving, ..) => Question::Moving(MovingOptions::default()),
            (QuestionKind::Kinematic, ..) => {
                Question::Kinematic(KinematicOptions { toward, ..KinematicOptions::default() })
            }
            (QuestionKind::Thrust, proof::Answer::Thrust(t), _) => {
                Question::Thrust(ThrustOptions {
                    support: t.support.clone(),
                    member: t.member.clone(),
                    direction: t.direction,
                    ..ThrustOptions::default()
                })
            }
            (QuestionKind::Critical, _, Some(c)) => Question::Critical(CriticalOptions {
                law,
                vary: c.vary.clone(),
                between: c.between,
                scan: Some(c.scan.len()),
            }),
            _ => return Some(None),
        };
        Some(closing::again(&question, scene, model, &Control::default()))
    }

    fn rocking(
        &self,
        options: &RockOptions,
        scene: &Scene,
        model: &Model,
    ) -> Option<Result<RockingAnswer, InputError>> {
        let answer = ask(&Question::Rock(options.clone()), scene, model, &Control::default());
        match answer {
            Ok(Answer::Rock(r)) => Some(Ok(saved::rocking_answer(model, &r))),
            Ok(_) => None,
            Err(e) => Some(Err(e)),
        }
    }

    fn shaken(
        &self,
        said: &ShakenAnswer,
        scene: &Scene,
        model: &Model,
    ) -> Option<Result<ShakenAnswer, InputError>> {
        // What ended by itself has to do so again, at the same step.
        let most = said.steps.saturating_add(usize::from(said.stop != Stop::Stopped));
        let mut steps = 0;
        let mut each = |_: &Progress| {
            steps += 1;
            if steps >= most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let watch =
            Watch { threads: 1, frames: 0, keep_frames: false, every_step: true, each: &mut each };
        let question = Question::Shake(said.asked.clone());
        match ask_watched(&question, scene, model, &Control::default(), watch) {
            Ok(Answer::Shake(s)) => Some(Ok(saved::shaken_answer(model, &s))),
            Ok(_) => None,
            Err(e) => Some(Err(e)),
        }
    }

    fn least_held(
        &self,
        order: &Order,
        scene: &Scene,
        model: &Model,
    ) -> Option<Result<usize, InputError>> {
        Some(stages::least_held(order, scene, model))
    }
}
