//! What a check computes again, with the solvers and the engine of this build.

use crate::{
    Answer, Control, Question, StateOptions, Watch, ask, ask_watched, assess, closing, coulomb,
    critical::probe, saved, sensitivity, stages,
};
use base::error::InputError;
use check::{
    elastic::PathEnd,
    proof::{
        self, Saved,
        recompute::{Obtained, Recompute},
        rocking::RockingAnswer,
        shaken::ShakenAnswer,
        simulation::Seen,
        verify::Verified,
    },
    rocking::RockOptions,
    sensitivity::Target,
    terms::{ClosedAnswer, Law, Order, Sided, StateMotion, Stop},
    verdict::Verdict,
};
use dynamics::Progress;
use model::interface::{Model, prepare};
use scene::Scene;
use solve::deadline::Deadline;
use std::ops::ControlFlow;

/// Asks again by the questions of this crate.
#[derive(Clone, Copy, Debug, Default)]
pub struct Solvers {
    /// What is not done by then stays unchecked.
    pub deadline: Deadline,
}

/// Verifies a result against a scene, the one inside it or one that the reader trusts more, and
/// computes again what no theorem says.
///
/// # Errors
/// The scene cannot be resolved.
pub fn verify(file: &Saved, scene: &Scene) -> Result<Verified, InputError> {
    proof::verify(file, scene, &Solvers::default())
}

impl Solvers {
    fn control(&self) -> Control {
        Control { deadline: self.deadline, ..Control::default() }
    }

    /// What was found, if it was found in time: cut short, it says nothing about what was saved.
    fn in_time<T>(&self, found: impl FnOnce() -> T) -> Option<T> {
        if self.deadline.is_over() {
            return None;
        }
        let found = found();
        (!self.deadline.is_over()).then_some(found)
    }
}

impl Recompute for Solvers {
    fn motion(&self, model: &Model) -> Option<StateMotion> {
        self.in_time(|| coulomb::motion(model, &self.control()))
    }

    fn rests_alone(&self, model: &Model) -> Option<bool> {
        self.in_time(|| coulomb::rests_alone(model, &self.control()))
    }

    fn with_value(
        &self,
        scene: &Scene,
        pointer: &str,
        value: f64,
        law: Law,
    ) -> Option<Result<(Verdict, f64), InputError>> {
        let control = Control { law, ..self.control() };
        let probe = self.in_time(|| probe(scene, pointer, value, &control))?;
        Some(probe.map(|p| (p.assessment.verdict, p.equilibrium_error())))
    }

    fn met(&self, question: &Question, scene: &Scene) -> Option<Result<Obtained, InputError>> {
        self.in_time(|| {
            let model = prepare(scene)?;
            let answer = ask(question, scene, &model, &self.control())?;
            let own = saved::of(question, scene, &model, &answer)?.nested();
            Ok((own.holds(), own.required.and_then(|r| r.obtained)))
        })
    }

    fn closed(
        &self,
        question: &Question,
        law: Law,
        scene: &Scene,
        model: &Model,
    ) -> Option<Option<(Law, ClosedAnswer)>> {
        let mut question = question.clone();
        if let Some(own) = question.law_mut() {
            *own = law;
        }
        self.in_time(|| closing::again(&question, scene, model, &self.control()))
    }

    fn simulated(
        &self,
        said: &Seen,
        scene: &Scene,
        model: &Model,
    ) -> Option<Result<Seen, InputError>> {
        let control = self.control();
        let beside = said.motion.is_some() || said.forces.is_some();
        let assessment = beside.then(|| assess(model, &control));
        // What takes longer than it is said to have taken is not the same; each run is heard of once before its first step.
        let most =
            said.runs.iter().fold(0_usize, |sum, r| sum.saturating_add(r.steps).saturating_add(1));
        let mut heard = 0;
        let mut each = |_: &Progress| {
            heard += 1;
            if heard > most || self.deadline.is_over() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let watch =
            Watch { threads: 1, frames: 0, keep_frames: false, every_step: true, each: &mut each };
        let question = Question::Simulate(said.asked.clone());
        match self.in_time(|| ask_watched(&question, scene, model, &control, watch))? {
            Ok(Answer::Simulate(outcome)) => {
                Some(Ok(saved::seen(model, &said.asked, assessment.as_ref(), &outcome)))
            }
            Ok(_) => None,
            Err(e) => Some(Err(e)),
        }
    }

    fn rocking(
        &self,
        options: &RockOptions,
        scene: &Scene,
        model: &Model,
    ) -> Option<Result<RockingAnswer, InputError>> {
        let question = Question::Rock(options.clone());
        match self.in_time(|| ask(&question, scene, model, &self.control()))? {
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
            if steps >= most || self.deadline.is_over() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let watch =
            Watch { threads: 1, frames: 0, keep_frames: false, every_step: true, each: &mut each };
        let question = Question::Shake(said.asked.clone());
        let control = self.control();
        match self.in_time(|| ask_watched(&question, scene, model, &control, watch))? {
            Ok(Answer::Shake(s)) => Some(Ok(saved::shaken_answer(model, &s))),
            Ok(_) => None,
            Err(e) => Some(Err(e)),
        }
    }

    fn stated(
        &self,
        options: &StateOptions,
        scene: &Scene,
        model: &Model,
    ) -> Option<Result<(PathEnd, f64), InputError>> {
        let question = Question::State(options.clone());
        match self.in_time(|| ask(&question, scene, model, &self.control()))? {
            Ok(Answer::State(s)) => {
                let last = s.track.as_ref().and_then(|t| t.steps.last()).map(|s| s.load_factor);
                Some(Ok((s.end, last.unwrap_or(0.0))))
            }
            Ok(_) => None,
            Err(e) => Some(Err(e)),
        }
    }

    fn sided(
        &self,
        question: &Question,
        of: (&Scene, &Model),
        target: &Target,
        pointers: &[&str],
    ) -> Option<Vec<Sided>> {
        self.in_time(|| sensitivity::sided(question, of, target, pointers, &self.control()))
    }

    fn least_held(
        &self,
        order: &Order,
        scene: &Scene,
        model: &Model,
    ) -> Option<Result<usize, InputError>> {
        self.in_time(|| stages::least_held(order, scene, model))
    }
}
