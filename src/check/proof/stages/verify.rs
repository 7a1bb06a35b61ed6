//! Verifying results of `stages`: every stage is made anew from the scene, and its answers are
//! verified there as results of their own.

use super::{HeldForce, Reaction, StageProof, StageResult};
use crate::{
    path::reaction,
    proof::{
        certificate::Certificate,
        recompute::Recompute,
        result::{QuestionKind, ResultFile},
        verify::{Verification, failure, require, verify_model},
    },
    terms::{Bound, Order, Outcome},
    verdict::{
        Evidence, Verdict,
        claim::{self, Claim, Findings},
        evidence::read_rates,
        thrust::{Extreme, ThrustAt},
        tilted::no_tilt,
    },
};
use base::tolerance;
use model::{
    assembly::{self, Stage, Wrench},
    interface::{Model, at_stage},
};
use nalgebra::Vector3;
use scene::Scene;

/// Adds the parts of a result of `stages`.
pub(in crate::proof) fn verify(
    all: &mut Verification,
    file: &ResultFile,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) {
    let (Some(said), Some(result)) = (file.answer.stages(), &file.stages) else {
        return all.part("answer", failure("the answer is not one to its question"));
    };
    let here = match assembly::asked_stages(result.asked(), scene, &model.assembly) {
        Ok(here) => here,
        Err(e) => return all.part("stages", failure(e.to_string())),
    };
    let mut f = Findings::default();
    let names = |s: &Stage| (s.name.clone(), model.ids(&s.holds().collect::<Vec<_>>()));
    let same = here.len() == result.list.len()
        && here.iter().zip(&result.list).all(|(h, s)| names(h) == (s.name.clone(), s.held.clone()));
    require(&mut f, same, format!("the stages are those of the scene, {} of them", here.len()));
    require(
        &mut f,
        result.answer() == *said,
        "what is said of all follows from what is said of each",
    );
    let standing = || result.list.iter().filter(|s| s.stands() == Verdict::Stable);
    let with = standing().filter(|s| s.margin.is_some() || s.no_margin.is_some()).count();
    require(
        &mut f,
        with == 0 || with == standing().count(),
        "margins are given of all stages that stand, or of none",
    );
    require(&mut f, file.certificate.claim.is_none(), "nothing else is claimed");
    let asked = standing().any(|s| !s.least_forces.is_empty());
    if let Some(order) = &result.order {
        complete(&mut f, order, scene, model, again);
    }
    all.part("stages", f);
    if same {
        for (stage, said) in here.iter().zip(&result.list) {
            match at_stage(scene, model, stage) {
                Ok(there) => one(all, said, (scene, &there), asked, again),
                Err(e) => all.part(said.name.clone(), failure(e.to_string())),
            }
        }
    }
    all.claimed = said.verdict != Verdict::Undecided;
}

/// An order: every free block is placed, and with fewer held there is none, as far as a search like
/// the one before finds out.
fn complete(f: &mut Findings, order: &Order, scene: &Scene, model: &Model, again: &dyn Recompute) {
    let free = model.assembly.free().count();
    let all = order.placed.is_empty() || order.placed.len() == free;
    require(f, all, format!("every free block is placed, {free} of them"));
    let least = order.least_held;
    if least == 0 || !f.fails.is_empty() {
        return;
    }
    let text = format!("with fewer than {least} held at a time no order was found");
    f.computed = true;
    match again.least_held(order, scene, model) {
        Some(Ok(here)) => require(f, least <= here, format!("{text} (sought again, not proved)")),
        Some(Err(e)) => f.fails.push(e.to_string()),
        None => f.unchecked.push(text),
    }
}

/// One stage; `model` is made anew for it.
fn one(
    all: &mut Verification,
    said: &StageResult,
    at: (&Scene, &Model),
    asked: bool,
    again: &dyn Recompute,
) {
    let (scene, model) = at;
    let mut f = Findings::default();
    let form = said.verdict.question == QuestionKind::Assess
        && said.blocks == model.assembly.blocks.len()
        && said.margin.as_ref().is_none_or(|m| {
            let live = model.assembly.live.iter().any(|w| *w != Wrench::zero());
            let kind = if live { QuestionKind::Limit } else { QuestionKind::Tilt };
            m.question == kind && said.stands() == Verdict::Stable
        });
    let without =
        said.no_margin.is_none() || (said.margin.is_none() && said.no_margin == no_tilt(model));
    require(&mut f, without, "it has a margin unless no tilt can turn its loads");
    require(&mut f, form, format!("{} blocks stand", model.assembly.blocks.len()));
    let held: Vec<&str> =
        said.held.iter().map(String::as_str).filter(|id| touches(model, id)).collect();
    let stands = said.stands() == Verdict::Stable;
    let forces = said.least_forces.iter();
    let complete = !(asked && stands)
        || held.iter().all(|id| forces.clone().any(|h| h.block == *id && is_down(h, model)));
    require(&mut f, complete, "the least force on all that it holds is given, or on nothing");
    reactions(&mut f, said, model);
    all.part(said.name.clone(), f);
    for proof in [Some(&said.verdict), said.margin.as_ref()].into_iter().flatten() {
        let own = verify_model(&file(proof, scene, model), scene, model, again);
        // Its counts are those of the model itself.
        for (title, findings) in own.parts.into_iter().skip(1) {
            all.part(format!("{}, {title}", said.name), findings);
        }
    }
    for held in &said.least_forces {
        let fits = said.held.contains(&held.block);
        all.part(format!("{}, held {}", said.name, held.block), least(held, model, fits));
    }
}

fn touches(model: &Model, id: &str) -> bool {
    let Some(i) = model.assembly.find(id) else { return false };
    model.interfaces.list.iter().any(|f| f.a == i || f.b == i)
}

fn is_down(held: &HeldForce, model: &Model) -> bool {
    let down = model.assembly.gravity.normalize();
    (Vector3::from(held.direction) - down).norm() <= tolerance::ALONG
}

/// An answer about a stage as a result about a scene.
fn file(proof: &StageProof, scene: &Scene, model: &Model) -> ResultFile {
    let StageProof {
        question,
        answer,
        certificate,
        directions,
        dry,
        coulomb_state,
        mechanism,
        members,
    } = proof.clone();
    let named = Scene { name: scene.name.clone(), ..Scene::default() };
    ResultFile {
        directions,
        dry,
        coulomb_state,
        mechanism,
        members,
        ..ResultFile::new(question, &named, model, answer, certificate)
    }
}

/// The weight of a block along a direction, N; what is rounding is nothing.
pub fn weight_along(model: &Model, block: usize, direction: [f64; 3]) -> f64 {
    let gravity = model.assembly.gravity;
    let share = gravity.normalize().dot(&Vector3::from(direction));
    if share.abs() <= tolerance::ALONG { 0.0 } else { model.assembly.weight(block) * share }
}

/// The reactions that the forces of a proof make on everything that does not move.
pub fn reactions_of(model: &Model, evidence: &Certificate) -> Vec<Reaction> {
    let Ok((forces, _)) = evidence.read(model) else { return Vec::new() };
    let blocks = &model.assembly.blocks;
    let on = |i: usize| {
        let w = reaction::on_support(model, &forces, i);
        let zero = w.force == Vector3::zeros() && w.moment == Vector3::zeros();
        (!zero).then(|| Reaction {
            support: blocks[i].id.clone(),
            force: w.force.into(),
            moment: w.moment.into(),
        })
    };
    (0..blocks.len()).filter(|&i| blocks[i].support).filter_map(on).collect()
}

fn reactions(f: &mut Findings, said: &StageResult, model: &Model) {
    let here = match said.stands() {
        Verdict::Stable => reactions_of(model, &said.verdict.certificate),
        _ => Vec::new(),
    };
    let total: f64 = model.assembly.free().map(|i| model.assembly.weight(i)).sum();
    let near = |a: &[f64; 3], b: &[f64; 3], scale: f64| {
        (Vector3::from(*a) - Vector3::from(*b)).norm() <= tolerance::SAVED * scale
    };
    let size = |id: &str| model.assembly.find(id).map_or(0.0, |i| model.assembly.blocks[i].size);
    // What is next to nothing is left out or not by rounding alone.
    let small = |r: &&Reaction| !near(&r.force, &[0.0; 3], total);
    let [a, b] = [&here, &said.reactions].map(|l| l.iter().filter(small).collect::<Vec<_>>());
    let same = a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| {
            a.support == b.support
                && near(&a.force, &b.force, total)
                && near(&a.moment, &b.moment, total * size(&a.support))
        });
    require(f, same, format!("the reactions are those of the forces, on {} blocks", a.len()));
}

/// The least force on what is held.
fn least(held: &HeldForce, model: &Model, fits: bool) -> Findings {
    let mut f = Findings::default();
    let evidence = &held.certificate;
    let support =
        model.assembly.find(&held.block).filter(|&i| fits && model.assembly.blocks[i].support);
    let Some(support) = support else {
        return failure(format!("the stage does not hold {}", held.block));
    };
    let read = || -> Result<_, String> {
        let (forces, base) = evidence.read(model)?;
        Ok((forces, base, read_rates(&model.assembly, &evidence.rates)?))
    };
    let (forces, base, rates) = match read() {
        Ok(read) => read,
        Err(text) => return failure(text),
    };
    let Bound { status, value, lower, upper } = held.least;
    let own = ThrustAt { support, direction: held.direction };
    let weight = weight_along(model, support, held.direction);
    let near = |a: f64, b: f64| (a - b).abs() <= tolerance::SAVED * model.assembly.weight(support);
    let follows =
        near(weight, held.weight) && held.needed == HeldForce::needed(&held.least, held.weight);
    require(&mut f, follows, "what holds it follows from that and its weight");
    let along = (Vector3::from(held.direction).norm() - 1.0).abs() <= tolerance::ALONG;
    require(&mut f, along, "its direction is a unit one");
    let said = match (status, evidence.claim) {
        (Outcome::Undecided, None) => true,
        (Outcome::Found, Some(Claim::Thrust { at, extreme, value: v, lower: l, upper: u })) => {
            at == own
                && extreme == Extreme::Least
                && (value, lower, upper) == (Some(v), Some(l), Some(u))
        }
        (Outcome::Unbounded, Some(Claim::EndlessThrust { at, extreme })) => {
            at == own && extreme == Extreme::Least && value.is_none()
        }
        _ => false,
    };
    require(&mut f, said, "the least force is the one claimed");
    if let Some(claim) = &evidence.claim {
        let proof = Evidence { forces: &forces, base: base.as_ref(), rates: &rates };
        let claimed = claim::verify(model, claim, proof);
        f.grade = claimed.grade;
        f.holds.extend(claimed.holds);
        f.fails.extend(claimed.fails);
    }
    f
}
