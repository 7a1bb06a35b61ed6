//! What a check computes again, because no theorem says it. A build without a solver cannot: it
//! answers `None` to everything here, and what was to be known stays unchecked.

use crate::{
    error::InputError,
    interface::Model,
    proof::{
        self,
        result::{QuestionKind, ResultFile},
        rocking::RockingAnswer,
        shaken::ShakenAnswer,
    },
    rocking::RockOptions,
    scene::Scene,
    terms::{ClosedAnswer, Law, Order, StateMotion},
    verdict::Verdict,
};

#[cfg(feature = "dynamics")]
use crate::{
    analysis::{Watch, ask_watched},
    dynamics::Progress,
    terms::Stop,
};
#[cfg(feature = "dynamics")]
use std::ops::ControlFlow;

#[cfg(feature = "solve")]
use crate::analysis::{
    Answer, AssessOptions, Control, CriticalOptions, KinematicOptions, LimitOptions, MovingOptions,
    Question, ThrustOptions, TiltOptions, ask, closing, coulomb, critical::probe, stages,
};

/// What the scene does under its dead load with dry friction.
#[cfg(feature = "solve")]
pub fn motion(model: &Model) -> Option<StateMotion> {
    Some(coulomb::motion(model, &Control::default()))
}

/// Whether the live load alone comes to rest on the forces that it produces.
#[cfg(feature = "solve")]
pub fn rests_alone(model: &Model) -> Option<bool> {
    Some(coulomb::rests_alone(model, &Control::default()))
}

/// Verdict and least unbalance (g) of the scene with this value at `pointer`, or that there is no
/// such scene.
#[cfg(feature = "solve")]
pub fn with_value(
    scene: &Scene,
    pointer: &str,
    value: f64,
    law: Law,
) -> Option<Result<(Verdict, f64), InputError>> {
    let control = Control { law, ..Control::default() };
    let probe = probe(scene, pointer, value, &control);
    Some(probe.map(|p| (p.assessment.verdict, p.unbalance())))
}

/// The question of a result asked again with contacts closed that were left out: the law by which
/// joints slide there, and the answer, where it is asked at all.
#[cfg(feature = "solve")]
pub fn closed(
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
        (QuestionKind::Thrust, proof::Answer::Thrust(t), _) => Question::Thrust(ThrustOptions {
            support: t.support.clone(),
            member: t.member.clone(),
            direction: t.direction,
            ..ThrustOptions::default()
        }),
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

/// What a mechanism on ground that moves does, run again.
#[cfg(feature = "solve")]
pub fn rocking(
    options: &RockOptions,
    scene: &Scene,
    model: &Model,
) -> Option<Result<RockingAnswer, InputError>> {
    let answer = ask(&Question::Rock(options.clone()), scene, model, &Control::default());
    match answer {
        Ok(Answer::Rock(r)) => Some(Ok(RockingAnswer::new(model, &r))),
        Ok(_) => None,
        Err(e) => Some(Err(e)),
    }
}

/// What all blocks do on ground that moves, run again for as many steps as it is said to have taken.
#[cfg(feature = "dynamics")]
pub fn shaken(
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
        Ok(Answer::Shake(s)) => Some(Ok(ShakenAnswer::new(model, &s))),
        Ok(_) => None,
        Err(e) => Some(Err(e)),
    }
}

/// Nothing here runs in time.
#[cfg(not(feature = "dynamics"))]
pub fn shaken(_: &ShakenAnswer, _: &Scene, _: &Model) -> Option<Result<ShakenAnswer, InputError>> {
    None
}

/// The number of held blocks below which a search finds no order like this one.
#[cfg(feature = "solve")]
pub fn least_held(
    order: &Order,
    scene: &Scene,
    model: &Model,
) -> Option<Result<usize, InputError>> {
    Some(stages::least_held(order, scene, model))
}

#[cfg(not(feature = "solve"))]
mod none {
    use super::*;

    pub fn motion(_: &Model) -> Option<StateMotion> {
        None
    }

    pub fn rests_alone(_: &Model) -> Option<bool> {
        None
    }

    pub fn closed(
        _: &ResultFile,
        _: Law,
        _: &Scene,
        _: &Model,
    ) -> Option<Option<(Law, ClosedAnswer)>> {
        None
    }

    pub fn rocking(
        _: &RockOptions,
        _: &Scene,
        _: &Model,
    ) -> Option<Result<RockingAnswer, InputError>> {
        None
    }

    pub fn least_held(_: &Order, _: &Scene, _: &Model) -> Option<Result<usize, InputError>> {
        None
    }

    pub fn with_value(
        _: &Scene,
        _: &str,
        _: f64,
        _: Law,
    ) -> Option<Result<(Verdict, f64), InputError>> {
        None
    }
}

#[cfg(not(feature = "solve"))]
pub use none::{closed, least_held, motion, rests_alone, rocking, with_value};
