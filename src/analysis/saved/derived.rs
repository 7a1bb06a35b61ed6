//! What follows from evidence that was found this moment.

use super::{
    in_time::{frame, seen},
    proof::standing,
    run,
};
use crate::{Assessment, Proved, Question, SimulateOptions};
use base::error::{Finding, FindingCode, InputError, JsonPath};
use check::proof::{
    Derived, Evidence, ResultFile, Run, derive,
    evidence::{ClosedEvidence, SimulateEvidence},
    recompute::JustComputed,
};
use dynamics::SimulationOutcome;
use model::interface::Model;
use scene::Scene;

/// How warnings begin that are about a result's own check.
pub(super) const REFUSED: &str = "failed its own check: ";

/// The result that follows from evidence that was found and checked this moment. What it rests on
/// and does not hold is a warning.
///
/// # Errors
/// The evidence is none for the question.
pub fn made(
    question: Question,
    scene: &Scene,
    model: &Model,
    evidence: (Evidence, Option<ClosedEvidence>),
    run: Run,
) -> Result<ResultFile, InputError> {
    let refuse = |text: String| InputError::at(JsonPath::root(), text);
    let derived = derive(question, scene, model, evidence, run, &JustComputed);
    let Derived { mut file, check } = derived.map_err(refuse)?;
    let fails = check.parts.into_iter().flat_map(|(title, f)| {
        f.fails.into_iter().map(move |text| format!("{REFUSED}{title}: {text}"))
    });
    file.run.warnings.extend(fails.map(|text| Finding::new(FindingCode::Numerics, text)));
    Ok(file)
}

/// The result of `simulate`, beside the verdict where there is one.
///
/// # Errors
/// As [`made`].
pub fn simulated(
    options: &SimulateOptions,
    scene: &Scene,
    model: &Model,
    a: Option<&Proved<Assessment>>,
    outcome: &SimulationOutcome,
) -> Result<ResultFile, InputError> {
    let mut run = match a {
        Some(a) => run::of(scene, model, &crate::Answer::Assess(a.clone())),
        None => Run::new(model.timings),
    };
    add(&mut run, outcome);
    let evidence = SimulateEvidence {
        seen: Box::new(seen(model, options, a, outcome)),
        standing: a.map(|a| standing(model, a)),
    };
    let question = Question::Simulate(options.clone());
    made(question, scene, model, (Evidence::Simulate(evidence), None), run)
}

/// Adds what happened in time to a result of `assess`.
///
/// # Errors
/// As [`made`].
pub fn with_simulation(
    file: &ResultFile,
    options: &SimulateOptions,
    model: &Model,
    a: &Proved<Assessment>,
    outcome: &SimulationOutcome,
) -> Result<ResultFile, InputError> {
    let mut run = file.run.clone();
    add(&mut run, outcome);
    let mut evidence = file.evidence().clone();
    if let Evidence::Assess(e) = &mut evidence {
        e.simulation = Some(Box::new(seen(model, options, Some(a), outcome)));
    }
    let closed: Option<ClosedEvidence> = file.closed().cloned();
    made(file.question.clone(), &file.scene.input, model, (evidence, closed), run)
}

fn add(run: &mut Run, outcome: &SimulationOutcome) {
    run.warnings.extend(outcome.findings.iter().cloned());
    run.frames = outcome.frames.iter().map(|f| frame(f, &outcome.runs)).collect();
}
