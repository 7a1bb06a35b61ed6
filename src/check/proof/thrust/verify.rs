//! Verifying thrusts: both ends from their forces and mechanisms, the factor from the shrunk
//! sections, the table from the forces.

use super::{ThrustSection, factor, table};
use crate::{
    proof::{
        certificate::Certificate,
        recompute::Recompute,
        result::{QuestionKind, ResultFile},
        verify::{Verification, answer, failure, mechanism_words, require},
    },
    terms::{Bound, Outcome},
    verdict::section::shrunk_model,
    verdict::{
        Evidence, Forces, Rate,
        claim::{self, Claim, Findings},
        evidence::read_rates,
        thrust::{Extreme, MemberAt, Sought, ThrustAt},
    },
};
use base::tolerance;
use model::interface::Model;

/// Adds the parts of a result of `thrust`.
pub fn verify(all: &mut Verification, file: &ResultFile, model: &Model, again: &dyn Recompute) {
    let (said, proof) = match (file.answer.thrust(), &file.thrust) {
        (None, None) => {
            let (mut f, rates) = answer(
                again,
                model,
                QuestionKind::Assess,
                &file.answer,
                &file.certificate,
                all.refuted(),
            );
            mechanism_words(&mut f, file, model, rates.as_deref());
            return all.part("answer", f);
        }
        (Some(said), Some(proof)) => (said, proof),
        _ => return all.part("answer", failure("the answer is not one to its question")),
    };
    let mut form = Findings::default();
    require(&mut form, file.certificate.claim.is_none(), "nothing else is claimed");
    let at = match (&said.support, said.direction, &said.member) {
        (Some(id), Some(direction), None) => match model.assembly.find(id) {
            Some(support) => Sought::Thrust(ThrustAt { support, direction }),
            None => return all.part("answer", failure(format!("the scene has no block {id}"))),
        },
        (None, along, Some(id)) => {
            match model.interfaces.members.iter().position(|m| m.id == *id) {
                Some(member) => Sought::Member(MemberAt { member, along }),
                None => {
                    return all.part("answer", failure(format!("the scene has no member {id}")));
                }
            }
        }
        _ => return all.part("answer", failure("it is not said whose force is meant")),
    };
    let [least, greatest] = match at {
        Sought::Thrust(_) => ["least thrust", "greatest thrust"],
        Sought::Member(_) => ["least force", "greatest force"],
    };
    let mut found = Vec::new();
    for (title, extreme, value, evidence) in [
        (least, Extreme::Least, &said.least, &proof.least),
        (greatest, Extreme::Greatest, &said.greatest, &proof.greatest),
    ] {
        let (findings, forces) = end(model, at, extreme, value, evidence);
        all.part(title, findings);
        found.push(forces.filter(|_| value.status == Outcome::Found));
    }
    all.claimed = proof.least.claim.is_some() || proof.greatest.claim.is_some();
    let value = said.geometric_factor.and_then(|f| f.value);
    let between = said
        .geometric_factor
        .is_none_or(|f| f.value.is_none_or(|v| f.lower <= v && f.upper.is_some_and(|u| v <= u)));
    let order = match &proof.shrunk[..] {
        [stands, falls] => {
            let verdicts = (stands.verdict(), falls.verdict());
            stands.value > falls.value && matches!(verdicts, (Some(a), Some(b)) if a != b)
        }
        _ => value.is_none(),
    };
    require(
        &mut form,
        between && order && factor(&proof.shrunk, value) == said.geometric_factor,
        "the geometric safety factor lies between those of the shrunk sections",
    );
    if let [least, greatest] = &found[..] {
        let here = table(model, [least.as_ref(), greatest.as_ref()]);
        require(
            &mut form,
            same(&here, &proof.sections),
            format!("the line of thrust is that of the forces, at {} sections", here.len()),
        );
    }
    all.part("answer", form);
    for side in &proof.shrunk {
        let sane = side.value > 0.0 && side.value <= 1.0;
        let findings = if sane {
            answer(
                again,
                &shrunk_model(model, side.value),
                QuestionKind::Assess,
                &side.answer,
                &side.certificate,
                all.refuted(),
            )
            .0
        } else {
            failure("sections cannot be shrunk by this")
        };
        all.part(format!("sections shrunk to {}", side.value), findings);
    }
}

/// One end of the range; gives back its forces where they could be read.
fn end(
    model: &Model,
    here: Sought,
    wanted: Extreme,
    said: &Bound,
    evidence: &Certificate,
) -> (Findings, Option<Forces>) {
    let mut f = Findings::default();
    let numbers = (said.value, said.lower, said.upper);
    let agrees = match (&evidence.claim, said.status) {
        (None, Outcome::Undecided) => {
            f.holds.push("undecided: nothing is claimed".into());
            return (f, None);
        }
        (Some(Claim::Thrust { at, extreme, value, lower, upper }), Outcome::Found) => {
            Sought::Thrust(*at) == here
                && *extreme == wanted
                && numbers == (Some(*value), Some(*lower), Some(*upper))
        }
        (
            Some(Claim::MemberForce { member, along, extreme, value, lower, upper }),
            Outcome::Found,
        ) => {
            Sought::Member(MemberAt { member: *member, along: *along }) == here
                && *extreme == wanted
                && numbers == (Some(*value), Some(*lower), Some(*upper))
        }
        (Some(Claim::EndlessThrust { at, extreme }), Outcome::Unbounded) => {
            Sought::Thrust(*at) == here && *extreme == wanted && numbers == (None, None, None)
        }
        (Some(Claim::EndlessMemberForce { member, along, extreme }), Outcome::Unbounded) => {
            Sought::Member(MemberAt { member: *member, along: *along }) == here
                && *extreme == wanted
                && numbers == (None, None, None)
        }
        _ => false,
    };
    require(&mut f, agrees, "the answer says what the certificate claims");
    let assembly = &model.assembly;
    let read = || -> Result<(Forces, Option<Forces>, Vec<Rate>), String> {
        let (forces, base) = evidence.read(model)?;
        Ok((forces, base, read_rates(assembly, &evidence.rates)?))
    };
    match (read(), &evidence.claim) {
        (Ok((forces, base, rates)), Some(claim)) => {
            let claimed = claim::verify(
                model,
                claim,
                Evidence { forces: &forces, base: base.as_ref(), rates: &rates },
            );
            f.holds.extend(claimed.holds);
            f.fails.extend(claimed.fails);
            (f, Some(forces))
        }
        (Ok(_), None) => (f, None),
        (Err(e), _) => {
            f.fails.push(e);
            (f, None)
        }
    }
}

fn same(here: &[ThrustSection], said: &[ThrustSection]) -> bool {
    let largest = here
        .iter()
        .flat_map(|s| [s.least, s.greatest])
        .flatten()
        .map(|l| l.normal.abs())
        .fold(0.0, f64::max);
    let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= tolerance::SAVED * scale.max(a.abs());
    let lines = |a: &Option<super::Line>, b: &Option<super::Line>| match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => {
            near(a.normal, b.normal, largest)
                && near(a.shear, b.shear, largest)
                // Where next to nothing presses, its place is rounding.
                && (a.normal.abs() <= tolerance::SAVED * largest
                    || (near(a.used, b.used, 1.0) && (0..3).all(|k| near(a.at[k], b.at[k], a.eccentricity))
                        && near(a.eccentricity, b.eccentricity, a.eccentricity)
                        && a.in_kern == b.in_kern
                        && a.inside == b.inside))
        }
        _ => false,
    };
    here.len() == said.len()
        && here.iter().zip(said).all(|(a, b)| {
            a.between == b.between && lines(&a.least, &b.least) && lines(&a.greatest, &b.greatest)
        })
}
