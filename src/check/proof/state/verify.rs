//! Verifying results of `state`: from the saved displacements the joints' forces are computed anew,
//! step by step, and with them everything that the answer says.

use super::{Given, StateAnswer, StateResult, StepResult};
use crate::{
    elastic::{Joints, PathEnd, Track},
    proof::{
        answer::Answer,
        certificate::Certificate,
        recompute::Recompute,
        result::{QuestionKind, ResultFile},
        verify::{Verification, answer, failure, is_no_better, members, require},
    },
    terms::{Bound, Outcome},
    verdict::{
        Evidence, Forces, Rate, Verdict,
        claim::{self, Claim, Findings},
        evidence::write_forces,
        exact::Grade,
        member::amounts,
    },
};
use base::tolerance;
use model::interface::Model;
use serde_json::Value;
use std::collections::HashMap;

/// Balance and laws hold to this, in multiples of what is greatest. More: forces that balance nothing
/// pass. Less: rounding of displacements in tall scenes is refused.
const HOLDS: f64 = 1e-8;

/// Adds the parts of a result of `state`.
pub(in crate::proof) fn verify(
    all: &mut Verification,
    file: &ResultFile,
    model: &Model,
    again: &dyn Recompute,
) {
    let (Some(said), Some(result)) = (file.answer.state(), &file.state) else {
        return all.part("answer", failure("the answer is not one to its question"));
    };
    require_one_kind(all, file, result);
    if result.steps.is_empty() {
        let proved = file.dead_load.as_ref().is_some_and(|d| d.certificate.claim.is_some());
        all.claimed = proved && said.verdict != Verdict::Undecided;
        return all.part("answer", without(file, said));
    }
    let joints = match Joints::new(model, said.quadrature) {
        Ok(joints) => joints,
        Err(e) => return all.part("answer", failure(e.to_string())),
    };
    let track = match track(model, &joints, result) {
        Ok(track) => track,
        Err(e) => return all.part("states", failure(e)),
    };
    all.part("states", laws(&track));
    let mut dead = forces(file, model, &track, said);
    members(&mut dead, file, model);
    all.part("forces under the dead load", dead);
    let mut f = Findings::default();
    let bound = bound(&mut f, all, model, result, again);
    let end = said.load_factor.map_or(PathEnd::None, |l| l.end);
    path(&mut f, said, &track, bound, result);
    let control = said.control.as_ref().and_then(|c| {
        let block = model.assembly.find(&c.block)?;
        (!model.assembly.blocks[block].support).then(|| (block, c.point.into()))
    });
    let here = Given {
        model,
        joints: &joints,
        quadrature: said.quadrature,
        track: &track,
        proof: said.proof,
        control,
        end,
        bound,
    }
    .answer();
    let differs = match (serde_json::to_value(said), serde_json::to_value(&here)) {
        (Ok(said), Ok(here)) => differs(&said, &here),
        _ => Some(String::new()),
    };
    match differs {
        None => f.holds.push(format!(
            "all numbers of the answer follow from the displacements of {} states",
            track.steps.len()
        )),
        Some(at) => {
            f.fails.push(format!("the answer's {at} does not follow from the displacements"))
        }
    }
    f.computed |= track.steps.len() > 1;
    all.part("answer", f);
}

/// A state, or a verdict in its place.
fn require_one_kind(all: &mut Verification, file: &ResultFile, result: &StateResult) {
    if !result.steps.is_empty() && file.dead_load.is_some() {
        all.part("form", failure("beside a state stands a verdict that was not asked for"));
    }
}

/// No state was found: the verdict is that of `dead_load`, and nothing else is claimed.
fn without(file: &ResultFile, said: &StateAnswer) -> Findings {
    let mut f = Findings::default();
    let verdict = file.dead_load.as_ref().and_then(|d| d.answer.verdict());
    let follows = match verdict {
        Some(Verdict::Stable) => said.verdict == Verdict::Undecided,
        Some(other) => said.verdict == other,
        None => false,
    };
    require(&mut f, follows, "without a state the verdict is that of the dead load");
    let bare = StateAnswer::without(said.verdict, said.quadrature);
    require(&mut f, bare == *said, "without a state nothing is said of one");
    let evidence = Certificate { verified: Vec::new(), ..file.certificate.clone() };
    let nothing = evidence == Certificate::none() && file.members.is_empty();
    require(&mut f, nothing, "nothing else is claimed");
    f
}

/// The states that the displacements make.
fn track(model: &Model, joints: &Joints, result: &StateResult) -> Result<Track, String> {
    let index: HashMap<&str, usize> =
        model.assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    let read = |step: &StepResult| -> Result<Vec<Rate>, String> {
        let mut displaced = vec![Rate::zero(); model.assembly.blocks.len()];
        for d in &step.displacements {
            let Some(&i) = index.get(d.block.as_str()) else {
                return Err(format!("the scene has no block {}", d.block));
            };
            if model.assembly.blocks[i].support {
                return Err(format!("block {} is a support and cannot move", d.block));
            }
            displaced[i] = Rate { velocity: d.displacement.into(), spin: d.rotation.into() };
            if !displaced[i].velocity.iter().chain(&displaced[i].spin).all(|v| v.is_finite()) {
                return Err(format!("block {}: a number is not finite", d.block));
            }
        }
        Ok(displaced)
    };
    let first = &result.steps[0];
    if first.load_factor != 0.0 {
        return Err("the first state is not that of the dead load".into());
    }
    let mut track = Track::start(model, joints, read(first)?);
    for pair in result.steps.windows(2) {
        if !(pair[1].load_factor > pair[0].load_factor && pair[1].load_factor.is_finite()) {
            return Err("load factors of the path do not grow".into());
        }
        track.push(model, joints, pair[1].load_factor, read(&pair[1])?);
    }
    Ok(track)
}

/// Balance, Signorini's three conditions and Coulomb's, at every state.
fn laws(track: &Track) -> Findings {
    let r = track.residuals();
    let mut f = Findings { grade: Grade::ToRounding(r.worst()), ..Findings::default() };
    for (what, value) in [
        ("balance: every block, of its load", r.balance),
        ("Signorini, gap >= 0 beside what the joint closes", r.gap),
        ("Signorini, pressure >= 0", r.pressure),
        ("Signorini, gap x pressure = 0", r.complementarity),
        ("Coulomb, shear within the cone", r.cone),
        ("Coulomb, slip only at the limit", r.sticking),
        ("Coulomb, slip against the shear force", r.direction),
    ] {
        require(&mut f, value <= HOLDS, format!("{what}: to {value:.1e}"));
    }
    f
}

/// The forces that prove that it stands are those of the joints.
fn forces(file: &ResultFile, model: &Model, track: &Track, said: &StateAnswer) -> Findings {
    let evidence = &file.certificate;
    let mut f = Findings::default();
    let here = write_forces(model, &track.forces);
    let tension = |forces: &Forces| -> Vec<f64> {
        let own = forces.iter().skip(model.interfaces.list.len());
        own.map(|forces| amounts(forces).x).collect()
    };
    let (pulls, saved) = (tension(&track.forces), evidence.read(model).map(|e| tension(&e.0)));
    let numbers = here.iter().flat_map(|c| c.forces.iter().flatten()).chain(&pulls);
    let scale = numbers.fold(0.0_f64, |m, v| m.max(v.abs()));
    let near = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance::SAVED * scale)
    };
    let same = saved.is_ok_and(|saved| near(&pulls, &saved))
        && here.len() == evidence.forces.len()
        && here.iter().zip(&evidence.forces).all(|(a, b)| {
            a.between == b.between
                && a.forces.len() == b.forces.len()
                && b.couples.is_empty()
                && a.forces.iter().zip(&b.forces).all(|(a, b)| near(a, b))
        });
    require(
        &mut f,
        same,
        "the forces are those of the joints and members at the saved displacements",
    );
    let stands = evidence.claim == Some(Claim::Stable) && said.verdict == Verdict::Stable;
    require(&mut f, stands, "it is claimed that it stands, and said");
    if stands {
        let claimed = claim::verify(model, &Claim::Stable, Evidence::new(&track.forces, &[]));
        let grade = said.proof.unwrap_or(Grade::ToRounding(f64::INFINITY));
        require(
            &mut f,
            is_no_better(grade, claimed.grade),
            format!("the proof is {}, the answer says {grade}", claimed.grade),
        );
        f.grade = claimed.grade;
        f.holds.extend(claimed.holds);
        f.fails.extend(claimed.fails);
    }
    f
}

/// The bound with its evidence, where there is one.
fn bound(
    f: &mut Findings,
    all: &mut Verification,
    model: &Model,
    result: &StateResult,
    again: &dyn Recompute,
) -> Option<Bound> {
    let asked = result.bound.as_ref()?;
    let Answer::Limit(said) = &asked.answer else {
        f.fails.push("the bound is no load factor".into());
        return None;
    };
    require(
        f,
        asked.dry.is_none() && said.verdict.is_none() && said.load_factor.found.is_none(),
        "beside the path stands the bound alone",
    );
    let found =
        answer(again, model, QuestionKind::Limit, &asked.answer, &asked.certificate, all.refuted());
    all.part("bound on the live load", found.0);
    Some(said.load_factor.associative)
}

/// The path does not reach beyond its bound, and ends where it says.
fn path(
    f: &mut Findings,
    said: &StateAnswer,
    track: &Track,
    bound: Option<Bound>,
    result: &StateResult,
) {
    let last = track.steps[track.steps.len() - 1].load_factor;
    require(
        f,
        bound.is_some() == said.load_factor.is_some()
            && (bound.is_some() || result.steps.len() == 1),
        "the answer has a path where there is a bound",
    );
    let Some(bound) = bound else { return };
    let Some(top) = bound.upper.filter(|_| bound.status == Outcome::Found) else { return };
    require(f, last <= top, format!("the path ends at {last}, not above the bound {top}"));
    if said.load_factor.is_some_and(|l| l.end == PathEnd::Bound) {
        let near = bound.value.is_some_and(|v| last >= (1.0 - 2e-3) * v);
        require(f, near, "it ends a thousandth below the bound");
    }
}

/// Where two answers differ: a number by itself, of a vector by its size; what is nothing beside all
/// numbers of the same place is rounding.
fn differs(said: &Value, here: &Value) -> Option<String> {
    let mut scales = HashMap::new();
    scale(here, "", &mut scales);
    compare(said, here, (String::new(), ""), &scales, 0.0)
}

/// The greatest number by place, whatever its position in a list.
fn scale(value: &Value, at: &str, scales: &mut HashMap<String, f64>) {
    match value {
        Value::Number(n) => {
            let all = scales.entry(at.to_string()).or_insert(0.0);
            *all = all.max(n.as_f64().unwrap_or(0.0).abs());
        }
        Value::Array(list) => list.iter().for_each(|v| scale(v, at, scales)),
        Value::Object(map) => map.iter().for_each(|(k, v)| scale(v, &format!("{at}.{k}"), scales)),
        _ => {}
    }
}

/// Residuals of this size are rounding, which another machine has otherwise.
const RESIDUAL: f64 = 1e-9;
/// So are numbers of this size beside the greatest of the same place.
const ROUNDING: f64 = 1e-13;

fn compare(
    said: &Value,
    here: &Value,
    (at, place): (String, &str),
    scales: &HashMap<String, f64>,
    vector: f64,
) -> Option<String> {
    match (said, here) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap_or(f64::NAN), b.as_f64().unwrap_or(f64::NAN));
            let floor = if place.starts_with(".residuals") { RESIDUAL } else { 0.0 };
            let greatest = scales.get(place).copied().unwrap_or(0.0);
            let allowed = tolerance::SAVED * b.abs().max(vector) + ROUNDING * greatest + floor;
            ((a - b).abs() > allowed || a.is_nan()).then_some(at)
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            let size = |v: &Value| v.as_f64().unwrap_or(0.0).abs();
            let vector = b.iter().map(size).fold(0.0, f64::max);
            a.iter().zip(b).enumerate().find_map(|(k, (a, b))| {
                compare(a, b, (format!("{at}[{k}]"), place), scales, vector)
            })
        }
        (Value::Object(a), Value::Object(b)) if a.len() == b.len() => {
            a.iter().find_map(|(k, a)| {
                let inner = format!("{place}.{k}");
                let at = if at.is_empty() { k.clone() } else { format!("{at}.{k}") };
                match b.get(k) {
                    Some(b) => compare(a, b, (at, &inner), scales, 0.0),
                    None => Some(at),
                }
            })
        }
        (a, b) => (a != b).then_some(at),
    }
}
