//! Answers that were found and proved, as the files that are saved of them.

mod critical;
mod kinematic;
mod moving;
mod packing;
mod path;
mod rocking;
mod shaken;
mod simulation;
mod stages;
mod state;
mod thrust;

pub use critical::{critical, flip, side};
pub use kinematic::kinematic;
pub use moving::moving;
pub use packing::packing;
pub use path::path;
pub use rocking::{rocking, rocking_answer};
pub use shaken::{shaken, shaken_answer};
pub use simulation::{simulated, simulation, with_simulation};
pub use stages::stages;
pub use state::state;
pub use thrust::thrust;

use crate::{
    Answer as Answered, Assessment, Claims, Control, Limited, LoadFactor, Proved, Question, Tilt,
    Tilted, coulomb::DryLoadFactor, doubt, left_out,
};
use base::error::{Finding, FindingCode};
use check::proof::{
    answer::{Answer, LimitAnswer, LoadFactorAnswer, TiltAnswer, VerdictAnswer},
    certificate::{Certificate, DryResult},
    member::lines,
    result::{CoulombState, Direction, MechanismWords, QuestionKind, ResultFile},
};
use check::{
    terms::{Bound, Law},
    verdict::{
        Evidence, Verdict,
        evidence::{write_forces, write_members, write_rates},
    },
};
use model::interface::Model;
use scene::Scene;

/// Packs a proof.
fn certificate<T: Claims>(model: &Model, proved: &Proved<T>) -> Certificate {
    let Evidence { forces, base, rates } = proved.evidence();
    Certificate {
        claim: proved.claim(),
        forces: write_forces(model, forces),
        members: write_members(model, forces),
        base: base.map(|f| write_forces(model, f)),
        base_members: base.map_or_else(Vec::new, |f| write_members(model, f)),
        rates: write_rates(&model.assembly, rates),
        verified: proved.findings().holds.clone(),
    }
}

/// The result of a question; packings have one of their own
/// ([`packing`](packing())).
pub fn of(scene: &Scene, model: &Model, answer: &Answered) -> Option<ResultFile> {
    Some(match answer {
        Answered::Assess(a) => assessment(scene, model, a),
        Answered::Limit(l) => load_factor(scene, model, l),
        Answered::Moving(m) => return moving(scene, model, m),
        Answered::Tilt(t) => return tilt(scene, model, t),
        Answered::Critical(c) => critical(scene, model, c),
        Answered::Thrust(t) => thrust(scene, model, t),
        Answered::Path(p) => path(scene, model, p),
        Answered::Kinematic(k) => return kinematic(scene, model, k),
        Answered::Stages(s) => stages(scene, model, s),
        Answered::Simulate(outcome) => simulated(scene, model, None, outcome),
        Answered::Shake(s) => shaken(scene, model, s),
        Answered::Rock(r) => rocking(scene, model, r),
        Answered::State(s) => state(scene, model, s),
        Answered::Repose(_) => return None,
    })
}

/// The same, with what weakens it: why it is undecided, and what it would be with contacts that
/// were left out.
pub fn of_question(
    question: &Question,
    scene: &Scene,
    model: &Model,
    answer: &Answered,
    control: &Control,
) -> Option<ResultFile> {
    let mut file = of(scene, model, answer)?;
    file.doubt = doubt(answer, model, control);
    file.left_out_contacts = left_out(question, scene, model, answer, control);
    Some(file)
}

/// The result of `assess`. What its check refused is undecided, and the reasons are warnings.
pub fn assessment(scene: &Scene, model: &Model, a: &Proved<Assessment>) -> ResultFile {
    let mut file = ResultFile::new(
        QuestionKind::Assess,
        scene,
        model,
        Answer::Verdict(verdict_answer(a)),
        certificate(model, a),
    );
    file.mechanism = a.mechanism.as_ref().map(|m| MechanismWords::new(model, m));
    file.members = lines(model, a.evidence().forces);
    file.coulomb_state =
        a.state.as_ref().map(|s| CoulombState { motion: s.motion, steps: s.steps.clone() });
    file.left_out.clone_from(&a.left_out);
    file.trace.clone_from(&a.attempts);
    warn(&mut file, a);
    file
}

/// The result of `limit`.
pub fn load_factor(scene: &Scene, model: &Model, limited: &Limited) -> ResultFile {
    let l = &limited.bound;
    let dry = limited.dry.as_ref().map(|dry| dry_result(model, dry));
    let answer = LimitAnswer {
        load_factor: LoadFactorAnswer::new(bound(l), dry.as_ref()),
        verdict: limited.dead.as_ref().map(|a| a.verdict),
        part: l.part.clone(),
        proof: l.grade(),
    };
    let mut file = ResultFile::new(
        QuestionKind::Limit,
        scene,
        model,
        Answer::Limit(answer),
        certificate(model, l),
    );
    file.mechanism = l.mechanism.as_ref().map(|m| MechanismWords::new(model, m));
    file.members = lines(model, l.evidence().forces);
    file.left_out.clone_from(&l.left_out);
    file.trace.clone_from(&l.attempts);
    warn(&mut file, l);
    if let Some(dead) = &limited.dead {
        file = with_dead_load(file, model, dead);
    }
    limited.dry.iter().for_each(|dry| warn(&mut file, dry));
    file.dry = dry;
    file
}

/// The result of `tilt`, one entry per direction; `model` is the scene level. The least tilt is
/// the answer.
pub fn tilt(scene: &Scene, model: &Model, tilted: &Tilted) -> Option<ResultFile> {
    let list = &tilted.directions;
    let level = tilted.level.as_ref().map(|a| a.verdict);
    let directions: Vec<Direction> = list.iter().map(|tilt| direction(tilt, level)).collect();
    let least = (0..directions.len())
        .min_by(|&i, &j| directions[i].governing().total_cmp(&directions[j].governing()))?;
    let (tilt, direction) = (&list[least], directions[least].clone());
    let mut file = ResultFile::new(
        QuestionKind::Tilt,
        scene,
        &tilt.model,
        direction.answer,
        direction.certificate,
    );
    file.dry = direction.dry;
    file.mechanism =
        tilt.load_factor.mechanism.as_ref().map(|m| MechanismWords::new(&tilt.model, m));
    file.members = lines(&tilt.model, tilt.load_factor.evidence().forces);
    file.left_out.clone_from(&tilt.load_factor.left_out);
    file.trace = list.iter().flat_map(|t| t.load_factor.attempts.iter().cloned()).collect();
    if directions.len() > 1 {
        file.directions = directions;
    }
    for tilt in list {
        warn(&mut file, &tilt.load_factor);
        tilt.dry.iter().for_each(|dry| warn(&mut file, &dry.load_factor));
    }
    Some(match &tilted.level {
        Some(level) => with_dead_load(file, model, level),
        None => file,
    })
}

/// Adds whether it stands under its dead load alone to a result of `limit`, `tilt` or `thrust`.
fn with_dead_load(mut file: ResultFile, model: &Model, a: &Proved<Assessment>) -> ResultFile {
    file.dead_load = Some(Direction {
        answer: Answer::Verdict(verdict_answer(a)),
        certificate: certificate(model, a),
        dry: None,
    });
    file.trace.extend(a.attempts.iter().cloned());
    warn(&mut file, a);
    file
}

/// Takes over what the check of an answer took, and why it took the answer back.
fn warn<T>(file: &mut ResultFile, proved: &Proved<T>) {
    file.timings.check += proved.seconds();
    file.warnings.extend(
        proved
            .findings()
            .fails
            .iter()
            .map(|f| Finding::new(FindingCode::Numerics, format!("certificate refused: {f}"))),
    );
}

/// One direction of a tilt; `level` is the verdict at level, where it was asked.
fn direction(tilt: &Tilt, level: Option<Verdict>) -> Direction {
    let dry = tilt.dry.as_ref().map(|d| dry_result(&d.model, &d.load_factor));
    let tan_tilt = LoadFactorAnswer::new(bound(&tilt.load_factor), dry.as_ref());
    let answer = TiltAnswer {
        toward: tilt.toward.into(),
        tan_tilt,
        tilt_deg: tan_tilt.degrees(),
        verdict: level,
        part: tilt.load_factor.part.clone(),
        proof: tilt.load_factor.grade(),
    };
    Direction {
        answer: Answer::Tilt(answer),
        certificate: certificate(&tilt.model, &tilt.load_factor),
        dry,
    }
}

fn finite(v: f64) -> Option<f64> {
    v.is_finite().then_some(v)
}

fn dry_result(model: &Model, d: &Proved<DryLoadFactor>) -> DryResult {
    DryResult {
        found: d.found,
        value: d.value,
        rests_at: d.rests_at,
        moves_at: d.moves_at,
        part: d.part.clone(),
        natural_map: finite(d.natural_map),
        solves: d.solves,
        certificate: certificate(model, d),
    }
}

fn verdict_answer(a: &Proved<Assessment>) -> VerdictAnswer {
    let law = (a.verdict == Verdict::Stable).then_some(if a.rests_on_statics() {
        Law::Associative
    } else {
        Law::Coulomb
    });
    VerdictAnswer {
        verdict: a.verdict,
        law,
        unbalance: a.unbalance,
        part: a.part.clone(),
        proof: a.grade(),
    }
}

fn bound(l: &LoadFactor) -> Bound {
    Bound::new(l.outcome, l.value, l.bracket)
}
