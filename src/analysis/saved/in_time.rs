//! What happened in time: names instead of indices.

use crate::{
    Assessment, Proved, Rocking, ShakenScene, SimulateOptions, agreement,
    follow::machine::Exactness,
};
use check::{
    proof::{
        rocking::{
            RockingAnswer, RockingFate, RockingFlip, RockingImpact, RockingPlace, RockingSense,
        },
        shaken::{ShakenAnswer, ShakenBlock, ShakenWord},
        simulation::{BlockMotion, FrameResult, PairForce, Seen},
    },
    rocking::{Fate, Sample, Sense},
    terms::{Bound, Run},
};
use dynamics::{Frame, Pose, ShakenFate, SimulationOutcome};
use model::interface::Model;

/// So many blocks of the first motion are kept, the ones that moved farthest first.
const MOVED: usize = 1000;

/// What was seen, beside a verdict where there is one.
pub fn seen(
    model: &Model,
    options: &SimulateOptions,
    a: Option<&Proved<Assessment>>,
    outcome: &SimulationOutcome,
) -> Seen {
    let blocks = &model.assembly.blocks;
    let id = |i: usize| blocks[i].id.clone();
    let agreement = a.map(|a| agreement(model, a, outcome));
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
    Seen {
        asked: options.clone(),
        fate: outcome.fate,
        collapse: outcome.collapse,
        runs: outcome.runs.clone(),
        motion: agreement.as_ref().and_then(|a| a.motion),
        forces: agreement.and_then(|a| a.forces),
        first_motion: moved.iter().take(MOVED).map(motion).collect(),
        contacts: outcome
            .contacts
            .iter()
            .map(|c| PairForce { between: [id(c.a), id(c.b)], force: c.force.into() })
            .collect(),
        reaction_error: outcome.reaction_error,
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

/// What is said of a history.
pub fn rocking_answer(model: &Model, rocking: &Rocking) -> RockingAnswer {
    let (built, h) = (&rocking.built, &rocking.history);
    let blocks = &model.assembly.blocks;
    let bound = |k: usize| {
        let proved = &built.proofs[k].1;
        let bound = Bound::new(proved.outcome, proved.value, proved.bracket);
        if proved.outcome == crate::Outcome::Found {
            bound
        } else {
            Bound { lower: None, upper: None, ..bound }
        }
    };
    let sense = |k: usize| {
        let sense = built.machine.senses[k].as_ref();
        RockingSense {
            load_factor: bound(k),
            frequency: sense.and_then(Sense::frequency),
            unstable: sense.and_then(|s| s.unstable),
            restitution: built.machine.restitution[k],
            conserving: built.conserving[k],
        }
    };
    let place = |s: &Sample| {
        let moved = built.machine.senses[usize::from(s.q < 0.0)].as_ref();
        let way = moved.filter(|_| s.q != 0.0).map_or(0.0, |m| m.law.at(s.q.abs()).way);
        RockingPlace { time: s.time, turn: s.q, way }
    };
    let own = &built.proofs[0].0.assembly;
    let (fate, overturned_at) = match h.fate {
        Fate::Overturns { time } => (RockingFate::Overturns, Some(time)),
        Fate::Rests => (RockingFate::Rests, None),
        Fate::Rocks => (RockingFate::Rocks, None),
    };
    let grades = built.proofs.iter().map(|p| p.1.grade());
    let impact = |i: &check::rocking::Impact| RockingImpact {
        time: i.time,
        before: i.before,
        factor: i.factor,
    };
    let flip = |b: &check::rocking::Bracket| RockingFlip {
        overturns_at: b.overturns_at(),
        stands_at: b.stands_at(),
    };
    RockingAnswer {
        asked: rocking.options.clone(),
        toward: built.toward.into(),
        towards: sense(0),
        against: sense(1),
        blocks: own.free().map(|i| own.blocks[i].id.clone()).collect(),
        proof: grades.reduce(|a, b| Some(a?.and(b?))).flatten(),
        idealised: match &built.exactness {
            Exactness::Exact => None,
            Exactness::Idealised(why) => Some(why.clone()),
        },
        control: blocks[built.control.0].id.clone(),
        point: built.control.1.into(),
        thickness: built.thickness,
        fate,
        overturned_at,
        released_at: h.released,
        greatest: place(&h.greatest),
        residual: (!h.overturned()).then(|| place(&h.last)),
        impacts: h.impacts.iter().map(impact).collect(),
        flips: rocking.scan.as_ref().map(|s| s.flips.iter().map(flip).collect()),
        notes: built.notes.clone(),
    }
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
