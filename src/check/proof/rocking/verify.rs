//! Verifying results of `rock`: both load factors from the scene, and the history by running it
//! again.

use super::{RockingAnswer, RockingSense};
use crate::{
    kinematic::quake,
    proof::{
        answer::Answer,
        certificate::Certificate,
        kinematic::differs,
        recompute::Recompute,
        result::ResultFile,
        verify::{
            Verification, bound_says, failure, is_no_better, mechanism_words, members, require,
        },
    },
    terms::Outcome,
    verdict::{
        Evidence, Rate,
        claim::{self, Findings},
        evidence::read_rates,
        exact::Grade,
    },
};
use base::{error::InputError, tolerance};
use model::interface::Model;
use nalgebra::Vector3;
use scene::Scene;

/// Adds the parts of a result of `rock`.
pub(in crate::proof) fn verify(
    all: &mut Verification,
    file: &ResultFile,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) {
    let (Some(said), Some(result)) = (file.answer.rocking(), &file.rocking) else {
        return all.part("answer", failure("the answer is not one to its question"));
    };
    let toward = Vector3::from(said.toward);
    let mut grade = Grade::Exact;
    let sides = [
        ("towards the direction", toward, &said.towards, &file.certificate),
        ("against the direction", -toward, &said.against, &result.against),
    ];
    for (k, (title, toward, sense, certificate)) in sides.into_iter().enumerate() {
        let own = match part(scene, model, said, toward) {
            Ok(own) => own,
            Err(e) => return all.part(title, failure(e.to_string())),
        };
        let (mut f, rates) = load_factor(&own, sense, certificate);
        if k == 0 {
            require(
                &mut f,
                sense.load_factor.status == Outcome::Found,
                "towards its direction there is a mechanism",
            );
            mechanism_words(&mut f, file, &own, rates.as_deref());
            members(&mut f, file, &own);
        }
        grade = grade.and(f.grade);
        all.part(title, f);
    }
    let mut f = Findings::default();
    let worst = said.proof.unwrap_or(Grade::ToRounding(f64::INFINITY));
    require(
        &mut f,
        is_no_better(worst, grade),
        format!("the proof is {grade}, the answer says {worst}"),
    );
    let dead_end = file.directions.is_empty() && file.dead_load.is_none() && file.dry.is_none();
    require(&mut f, dead_end, "nothing else is answered");
    if !all.refuted() && f.fails.is_empty() {
        history(&mut f, said, scene, model, again);
    }
    all.part("history", f);
    all.claimed = file.certificate.claim.is_some();
}

/// The blocks of the mechanism under weights that push towards a direction.
fn part(
    scene: &Scene,
    model: &Model,
    said: &RockingAnswer,
    toward: Vector3<f64>,
) -> Result<Model, InputError> {
    let own = quake(scene, model, toward)?;
    let unit = (own.toward - toward).norm() <= tolerance::ALONG;
    let fits = said.blocks.iter().all(|id| model.assembly.find(id).is_some());
    if !unit || !fits {
        let what = if unit { "names no such block" } else { "has no unit direction" };
        return Err(InputError::at(Default::default(), format!("the answer {what}")));
    }
    let stays = |i: &usize| !said.blocks.contains(&model.assembly.blocks[*i].id);
    let gone: Vec<usize> = model.assembly.free().filter(stays).collect();
    Ok(own.model.without(&gone))
}

/// A load factor with its evidence.
fn load_factor(
    model: &Model,
    said: &RockingSense,
    evidence: &Certificate,
) -> (Findings, Option<Vec<Rate>>) {
    let read = || -> Result<_, String> {
        let (forces, base) = evidence.read(model)?;
        Ok((forces, base, read_rates(&model.assembly, &evidence.rates)?))
    };
    let (forces, base, rates) = match read() {
        Ok(read) => read,
        Err(e) => return (failure(e), None),
    };
    let Some(claim) = &evidence.claim else {
        return (failure("no load factor is claimed"), None);
    };
    let mut f = claim::verify(
        model,
        claim,
        Evidence { forces: &forces, base: base.as_ref(), rates: &rates },
    );
    require(
        &mut f,
        bound_says(&said.load_factor, Some(claim)),
        "the answer says the load factor that the certificate claims",
    );
    (f, Some(rates))
}

/// The machine and its history are those that come out again.
fn history(
    f: &mut Findings,
    said: &RockingAnswer,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) {
    let text = format!(
        "the history of {} impacts comes out again (computed, not proved)",
        said.impacts.len()
    );
    f.computed = true;
    let json = |a: &RockingAnswer| {
        let mut plain = a.clone();
        // Proved above, each from evidence of its own.
        plain.proof = None;
        serde_json::to_value(plain).unwrap_or_default()
    };
    match again.rocking(&said.asked, scene, model) {
        None => f.unchecked.push(text),
        Some(Err(e)) => f.fails.push(format!("the scene has no such history: {e}")),
        Some(Ok(here)) => match differs(&json(said), &json(&here), String::new()) {
            None => f.holds.push(text),
            Some(place) => {
                f.fails.push(format!("run again, the answer says otherwise at {place}"));
            }
        },
    }
}

impl Answer {
    /// What it says of a mechanism on ground that moves.
    pub fn rocking(&self) -> Option<&RockingAnswer> {
        match self {
            Self::Rocking(a) => Some(a),
            _ => None,
        }
    }
}
