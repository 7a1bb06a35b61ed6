//! Answers that were found and proved, as the files that are saved of them: the evidence is written
//! down here, and what is told of it is derived ([`check::proof::derive()`]), as it is by who checks.

mod derived;
mod evidence;
mod in_time;
mod packing;
mod path;
mod plain;
mod proof;
mod run;

pub use derived::{made, simulated, with_simulation};
pub use evidence::flip;
pub use in_time::{rocking_answer, seen, shaken_answer};
pub use packing::packing;
pub use path::path_evidence;
pub use plain::of;

use crate::{
    Answer as Answered, AssessOptions, Assessment, Control, Critical, CriticalOptions,
    LimitOptions, Limited, Proved, Question, ThrustOptions, TiltOptions, Tilted, doubt, left_out,
    sensitivity, thrust::Thrust,
};
use base::error::{InputError, JsonPath};
use check::{
    proof::{
        Evidence, ResultFile,
        evidence::{ClosedEvidence, PathEvidence},
    },
    terms::Law,
};
use derived::REFUSED;
use model::interface::Model;
pub(super) use proof::standing;
use scene::Scene;

/// The same, with what weakens it: why it is undecided, and what it would be with contacts that
/// were left out.
///
/// # Errors
/// As [`of`].
pub fn of_question(
    question: &Question,
    scene: &Scene,
    model: &Model,
    answer: &Answered,
    control: &Control,
) -> Result<ResultFile, InputError> {
    let mut run = run::of(scene, model, answer);
    run.doubt = doubt(answer, model, control);
    let closed = left_out(question, scene, model, answer, control).and_then(|l| l.closed);
    let closed = closed.map(|c| ClosedEvidence { law: c.law, answer: c.answer });
    let (question, mut evidence) = evidence::of(question, model, answer)?;
    if !question.sensitivity() {
        return made(question, scene, model, (evidence, closed), run);
    }
    let given = (evidence.clone(), closed.clone());
    let file = made(question.clone(), scene, model, given, run.clone())?;
    let open = file.sensitivity.as_ref().map(sensitivity::open).unwrap_or_default();
    let target = file.answer.target();
    let (Some(target), Some(sided)) = (target, evidence.sided_mut()) else { return Ok(file) };
    if open.is_empty() {
        return Ok(file);
    }
    *sided = sensitivity::sided(&question, (scene, model), &target, &open, control);
    made(question, scene, model, (evidence, closed), run)
}

/// The same of a path that goes on from points that were known before, each of which is checked.
///
/// # Errors
/// As [`of`], and where a point that was known before does not hold.
pub fn of_path(
    question: &Question,
    scene: &Scene,
    model: &Model,
    answer: &Answered,
    before: Option<PathEvidence>,
) -> Result<ResultFile, InputError> {
    let (question, mut evidence) = evidence::of(question, model, answer)?;
    let (Evidence::Settle(path) | Evidence::Push(path)) = &mut evidence else {
        return Err(InputError::at(JsonPath::root(), "this question follows no path")
            .hint("ask `settle` or `push`"));
    };
    let known = before.is_some();
    if let Some(before) = before {
        *path = before.and(path.clone());
    }
    let run = run::of(scene, model, answer);
    let file = made(question, scene, model, (evidence, None), run)?;
    let refused = file.run.warnings.iter().find(|w| w.text.starts_with(REFUSED));
    match refused.filter(|_| known) {
        Some(w) => Err(InputError::at(
            JsonPath::root(),
            format!("the saved points of the path do not hold: {}", w.text),
        )
        .hint("start a new file")),
        None => Ok(file),
    }
}

/// The result of `assess`.
///
/// # Errors
/// As [`made`].
pub fn assessment(
    scene: &Scene,
    model: &Model,
    a: &Proved<Assessment>,
) -> Result<ResultFile, InputError> {
    let law = if a.rests_on_statics() { Law::Associative } else { Law::Coulomb };
    let question = Question::Assess(AssessOptions { law });
    of(&question, scene, model, &Answered::Assess(a.clone()))
}

/// The result of `limit`.
///
/// # Errors
/// As [`made`].
pub fn load_factor(
    scene: &Scene,
    model: &Model,
    limited: &Limited,
) -> Result<ResultFile, InputError> {
    let options = LimitOptions { skip_dead: limited.dead.is_none(), ..LimitOptions::default() };
    of(&Question::Limit(options), scene, model, &Answered::Limit(Box::new(limited.clone())))
}

/// The result of `tilt`; `model` is the scene level.
///
/// # Errors
/// As [`made`].
pub fn tilt(scene: &Scene, model: &Model, tilted: &Tilted) -> Result<ResultFile, InputError> {
    let options = TiltOptions {
        toward: tilted.directions.iter().map(|t| t.toward.into()).collect(),
        skip_dead: tilted.level.is_none(),
        ..TiltOptions::default()
    };
    of(&Question::Tilt(options), scene, model, &Answered::Tilt(tilted.clone()))
}

/// The result of `thrust`.
///
/// # Errors
/// As [`made`].
pub fn thrust(scene: &Scene, model: &Model, t: &Thrust) -> Result<ResultFile, InputError> {
    let options = ThrustOptions { range: true, ..ThrustOptions::default() };
    of(&Question::Thrust(options), scene, model, &Answered::Thrust(Box::new(t.clone())))
}

/// The result of `critical`; `model` is that of the scene as it was given.
///
/// # Errors
/// As [`made`].
pub fn critical(scene: &Scene, model: &Model, c: &Critical) -> Result<ResultFile, InputError> {
    let options = CriticalOptions {
        law: c.law,
        vary: c.range.pointer.clone(),
        between: [c.range.from, c.range.to],
        scan: c.range.scan,
    };
    of(&Question::Critical(options), scene, model, &Answered::Critical(Box::new(c.clone())))
}
