//! What happened in time, beside a verdict where there is one: names instead of indices.

use super::{assessment, verdict_answer};
use crate::{Assessment, Proved, agreement};
use check::{
    proof::{
        answer::Answer,
        certificate::Certificate,
        result::{QuestionKind, ResultFile},
        simulation::{BlockMotion, FrameResult, PairForce, Simulation},
    },
    terms::{Agreement, Run},
};
use dynamics::{Frame, Pose, SimulationOutcome};
use model::interface::Model;
use scene::Scene;

/// So many blocks of the first motion are kept, the ones that moved farthest first.
const MOVED: usize = 1000;

/// The result of `simulate`, beside the verdict where there is one.
pub fn simulated(
    scene: &Scene,
    model: &Model,
    a: Option<&Proved<Assessment>>,
    outcome: &SimulationOutcome,
) -> ResultFile {
    let answer = Answer::Simulation(outcome.fate, a.map(verdict_answer));
    let file = match a {
        Some(a) => {
            ResultFile { question: QuestionKind::Simulate, answer, ..assessment(scene, model, a) }
        }
        None => ResultFile::new(QuestionKind::Simulate, scene, model, answer, Certificate::none()),
    };
    with_simulation(file, model, a, outcome)
}

/// Adds what happened in time to a result of `assess`.
pub fn with_simulation(
    mut file: ResultFile,
    model: &Model,
    a: Option<&Proved<Assessment>>,
    outcome: &SimulationOutcome,
) -> ResultFile {
    let agreement = a.map(|a| agreement(model, a, outcome));
    file.warnings.extend(outcome.findings.iter().cloned());
    file.simulation = Some(simulation(model, outcome, agreement));
    file
}

/// Packs an outcome.
pub fn simulation(
    model: &Model,
    outcome: &SimulationOutcome,
    agreement: Option<Agreement>,
) -> Simulation {
    let blocks = &model.assembly.blocks;
    let id = |i: usize| blocks[i].id.clone();
    let mut moved: Vec<(usize, f64)> = outcome
        .first_motion
        .iter()
        .enumerate()
        .map(|(i, m)| (i, m.way.norm() + m.turn.norm() * blocks[i].size))
        .filter(|(_, way)| *way > 0.0)
        .collect();
    moved.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let motion = |&(i, _): &(usize, f64)| {
        let motion = outcome.first_motion[i];
        BlockMotion { block: id(i), way: motion.way.into(), turn: motion.turn.into() }
    };
    Simulation {
        fate: outcome.fate,
        collapse: outcome.collapse,
        runs: outcome.runs.clone(),
        agreement,
        first_motion: moved.iter().take(MOVED).map(motion).collect(),
        contacts: outcome
            .contacts
            .iter()
            .map(|c| PairForce { between: [id(c.a), id(c.b)], force: c.force.into() })
            .collect(),
        reaction_error: outcome.reaction_error,
        frames: outcome.frames.iter().map(|f| frame(f, &outcome.runs)).collect(),
        findings: outcome.findings.clone(),
    }
}

/// A moment; `runs` are those it may belong to.
pub(super) fn frame(frame: &Frame, runs: &[Run]) -> FrameResult {
    let row = |p: &Pose| {
        let (c, q) = (p.center, p.turn);
        [c.x, c.y, c.z, q.w, q.i, q.j, q.k]
    };
    FrameResult {
        time: frame.time,
        run: runs.iter().position(|r| r.fidelity == frame.fidelity).unwrap_or(0),
        energy: frame.energy,
        blocks: frame.blocks.iter().map(row).collect(),
    }
}
