//! A mechanism on ground that moves: names instead of indices.

use super::{bound, certificate, warn};
use crate::{Claims, Rocking, follow::machine::Exactness};
use check::{
    proof::{
        answer::Answer,
        member::lines,
        result::{MechanismWords, QuestionKind, ResultFile},
        rocking::{
            RockingAnswer, RockingFate, RockingFlip, RockingImpact, RockingPlace, RockingResult,
            RockingSense,
        },
    },
    rocking::{Fate, Sample, Sense},
};
use model::interface::Model;
use scene::Scene;

/// The result of `rock`.
pub fn rocking(scene: &Scene, model: &Model, rocking: &Rocking) -> ResultFile {
    let [(under, towards), (other, against)] = &rocking.built.proofs;
    let answer = Answer::Rocking(Box::new(rocking_answer(model, rocking)));
    let mut file =
        ResultFile::new(QuestionKind::Rock, scene, model, answer, certificate(under, towards));
    file.rocking = Some(RockingResult { against: certificate(other, against) });
    file.mechanism = towards.mechanism.as_ref().map(|m| MechanismWords::new(under, m));
    file.members = lines(under, towards.evidence().forces);
    file.left_out.clone_from(&towards.left_out);
    file.trace = [towards, against].iter().flat_map(|p| p.attempts.clone()).collect();
    warn(&mut file, towards);
    warn(&mut file, against);
    file
}

/// What is said of a history.
pub fn rocking_answer(model: &Model, rocking: &Rocking) -> RockingAnswer {
    let (built, h) = (&rocking.built, &rocking.history);
    let blocks = &model.assembly.blocks;
    let sense = |k: usize| {
        let sense = built.machine.senses[k].as_ref();
        RockingSense {
            load_factor: bound(&built.proofs[k].1),
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
