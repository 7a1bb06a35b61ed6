//! Results of `thrust`: both ends of its range, the line of thrust at every section, the geometric
//! safety factor.

use super::{
    answer::Answer,
    certificate::Certificate,
    critical::{Side, side},
    derive::{Derivation, failure, motion, require},
    evidence::ThrustEvidence,
    told::{Direction, Told},
};
use crate::{
    question::ThrustOptions,
    terms::{Bound, Outcome},
    verdict::{
        Forces, Verdict,
        claim::{Claim, Findings},
        section::{SectionForce, sections, shrunk_model},
        thrust::{Extreme, MemberAt, Sought, ThrustAt},
    },
};
use base::tolerance;
use model::{interface::Model, strength::laws::are_dry};
use schemars::JsonSchema;
use serde::Serialize;
use serde_with::skip_serializing_none;
use std::sync::Arc;

/// The range of the thrust on a support, or of the force in a member.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ThrustAnswer {
    /// The support.
    pub support: Option<String>,
    /// Unit direction of the thrust, or of the shear of a dowel.
    pub direction: Option<[f64; 3]>,
    /// The member whose force is meant, in place of a support.
    pub member: Option<String>,
    /// Its least value.
    pub least: Bound,
    /// Its greatest value.
    pub greatest: Bound,
    /// The geometric safety factor.
    pub geometric_factor: Option<Factor>,
}

/// A geometric safety factor.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Factor {
    /// The factor, where there is one; it is beyond `lower` otherwise.
    pub value: Option<f64>,
    /// With sections shrunk by this it stands.
    pub lower: f64,
    /// With sections shrunk by this it falls.
    pub upper: Option<f64>,
}

/// The evidence, and the line of thrust.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ThrustResult {
    /// For the least thrust.
    #[serde(skip)]
    pub least: Arc<Certificate>,
    /// For the greatest.
    #[serde(skip)]
    pub greatest: Arc<Certificate>,
    /// Shrunk sections, with the verdict at each: `value` is the share of the section that is left.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shrunk: Vec<Side>,
    /// Why there is no geometric safety factor; it stands under `run`.
    #[serde(skip)]
    pub without_factor: Option<String>,
    /// The line of thrust, section by section.
    pub sections: Vec<ThrustSection>,
}

/// A section with the lines of thrust through it.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ThrustSection {
    /// The two blocks.
    pub between: [String; 2],
    /// At the least thrust, where found.
    pub least: Option<Line>,
    /// At the greatest.
    pub greatest: Option<Line>,
}

/// The line of thrust at a section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Line {
    /// Normal force, N; compression > 0.
    pub normal: f64,
    /// Shear force, N.
    pub shear: f64,
    /// Centre of pressure, m.
    pub at: [f64; 3],
    /// Its distance from the centroid, m.
    pub eccentricity: f64,
    /// Share of the section used: 1 at the edge.
    pub used: f64,
    /// Whether it lies in the kern: the whole section presses.
    pub in_kern: bool,
    /// Whether it lies inside the section.
    pub inside: bool,
}

impl From<&SectionForce> for Line {
    fn from(s: &SectionForce) -> Self {
        Self {
            normal: s.normal,
            shear: s.shear,
            at: s.at.into(),
            eccentricity: s.eccentricity.norm(),
            used: s.used,
            in_kern: s.in_kern,
            inside: s.used <= 1.0 + 1e-9,
        }
    }
}

/// The factor that shrunk sections prove: a value only where the two sides are near each other.
fn factor(shrunk: &[Side], value: Option<f64>) -> Option<Factor> {
    let is = |s: &&Side, verdict| s.verdict() == Some(verdict);
    let (lower, upper) = (
        1.0 / shrunk.first().filter(|s| is(s, Verdict::Stable))?.value,
        shrunk.get(1).filter(|s| is(s, Verdict::Unstable)).map(|s| 1.0 / s.value),
    );
    let is_known = |v: &f64| {
        upper
            .is_some_and(|u| lower <= *v && *v <= u && u - lower <= tolerance::CRITICAL_BRACKET * u)
    };
    Some(Factor { value: value.filter(is_known), lower, upper })
}

/// The line of thrust for up to two sets of forces.
fn table(model: &Model, forces: [Option<&Forces>; 2]) -> Vec<ThrustSection> {
    let [least, greatest] = forces.map(|f| f.map(|f| sections(&model.interfaces, f)));
    let line =
        |s: &Option<Vec<SectionForce>>, k: usize| s.as_ref().and_then(|s| s.get(k)).map(Line::from);
    let id = |i: usize| model.assembly.blocks[i].id.clone();
    let faces = model.interfaces.list.iter().enumerate();
    faces
        .map(|(k, f)| ThrustSection {
            between: [id(f.a), id(f.b)],
            least: line(&least, k),
            greatest: line(&greatest, k),
        })
        .collect()
}

/// Both ends of a thrust, or of the force in a member; where the scene does not stand, that it does
/// not.
pub(super) fn derive(
    d: &mut Derivation,
    o: &ThrustOptions,
    e: &ThrustEvidence,
) -> Result<Told, String> {
    let Some([least, greatest]) = &e.ends else {
        let mut f = Findings::default();
        let (answer, proven) = d.verdict(&mut f, d.model, &e.standing);
        let verdict = answer.verdict;
        d.check.claimed = verdict != Verdict::Undecided;
        d.part("answer", f);
        let mut told = Told::new(d.model, Answer::Verdict(answer), &e.standing.certificate);
        told.in_words(d.model, proven.as_ref());
        told.motion = motion(&e.standing, verdict);
        return Ok(told);
    };
    let at = place(d.model, o)?;
    let words = if matches!(at, Sought::Thrust(_)) { "thrust" } else { "force" };
    let (low, least_forces) = end(d, (at, Extreme::Least), (format!("least {words}"), least));
    let (high, greatest_forces) =
        end(d, (at, Extreme::Greatest), (format!("greatest {words}"), greatest));
    d.check.claimed = [&low, &high].into_iter().any(|b: &Bound| b.status != Outcome::Undecided);
    let mut shrunk = Vec::new();
    for e in &e.shrunk {
        if !(e.value > 0.0 && e.value <= 1.0) {
            return Err(format!("sections cannot be shrunk to {}", e.value));
        }
        let model = shrunk_model(d.model, e.value);
        shrunk.push(side(d, format!("sections shrunk to {}", e.value), &model, e));
    }
    let mut f = Findings::default();
    let order = match &shrunk[..] {
        [] => e.factor.is_none(),
        [_] => e.factor.is_none(),
        [stands, falls] => {
            let verdicts = (stands.verdict(), falls.verdict());
            stands.value > falls.value && matches!(verdicts, (Some(a), Some(b)) if a != b)
        }
        _ => false,
    };
    let dry = shrunk.is_empty() || are_dry(&d.model.interfaces);
    require(
        &mut f,
        dry,
        "sections are shrunk only where joints have neither strength nor pore pressure",
    );
    require(&mut f, order, "the geometric safety factor lies between those of the shrunk sections");
    d.part("answer", f);
    let (support, direction, member) = match at {
        Sought::Thrust(at) => {
            (Some(d.model.assembly.blocks[at.support].id.clone()), Some(at.direction), None)
        }
        Sought::Member(at) => {
            (None, at.along, Some(d.model.interfaces.members[at.member].id.clone()))
        }
    };
    let sections = table(d.model, [least_forces.as_ref(), greatest_forces.as_ref()]);
    let answer = ThrustAnswer {
        support,
        direction,
        member,
        least: low,
        greatest: high,
        geometric_factor: factor(&shrunk, e.factor),
    };
    let dead = d.dead(d.model, Some(&e.standing));
    let mut told = Told::new(d.model, Answer::Thrust(Box::new(answer)), &Arc::default());
    told.dead_load = dead.filter(|d: &Direction| !d.certificate.is_empty());
    told.thrust = Some(ThrustResult {
        least: least.clone(),
        greatest: greatest.clone(),
        shrunk,
        without_factor: None,
        sections,
    });
    Ok(told)
}

/// Whose force is meant: all of it stands in the question.
fn place(model: &Model, o: &ThrustOptions) -> Result<Sought, String> {
    match (&o.support, o.direction, &o.member) {
        (Some(id), Some(direction), None) => {
            let support = model.assembly.find(id).ok_or(format!("the scene has no block {id}"))?;
            Ok(Sought::Thrust(ThrustAt { support, direction }))
        }
        (None, along, Some(id)) => {
            let member = model.interfaces.members.iter().position(|m| m.id == *id);
            let member = member.ok_or(format!("the scene has no member {id}"))?;
            Ok(Sought::Member(MemberAt { member, along }))
        }
        _ => Err("the question names neither a support nor a member".into()),
    }
}

/// One end of the range, with its forces where it was found.
fn end(
    d: &mut Derivation,
    (here, wanted): (Sought, Extreme),
    (title, e): (String, &Certificate),
) -> (Bound, Option<Forces>) {
    let mut f = Findings::default();
    let proven = e.prove(&mut f, d.model, d.known());
    let none = |status| Bound { status, value: None, lower: None, upper: None };
    let found = |value, lower, upper| Bound {
        status: Outcome::Found,
        value: Some(value),
        lower: Some(lower),
        upper: Some(upper),
    };
    let claim = proven.as_ref().and_then(|p| p.claim);
    let (at, extreme, bound) = match claim {
        None => {
            f.holds.push("undecided: nothing is claimed".into());
            (here, wanted, none(Outcome::Undecided))
        }
        Some(Claim::Thrust { at, extreme, value, lower, upper }) => {
            (Sought::Thrust(at), extreme, found(value, lower, upper))
        }
        Some(Claim::MemberForce { member, along, extreme, value, lower, upper }) => {
            (Sought::Member(MemberAt { member, along }), extreme, found(value, lower, upper))
        }
        Some(Claim::EndlessThrust { at, extreme }) => {
            (Sought::Thrust(at), extreme, none(Outcome::Unbounded))
        }
        Some(Claim::EndlessMemberForce { member, along, extreme }) => {
            (Sought::Member(MemberAt { member, along }), extreme, none(Outcome::Unbounded))
        }
        Some(_) => {
            d.part(title, failure("the proved claim is not a thrust"));
            return (none(Outcome::Undecided), None);
        }
    };
    require(&mut f, at == here && extreme == wanted, "the force is the one that was asked for");
    d.part(title, f);
    let forces = proven.map(|p| p.forces).filter(|_| bound.status == Outcome::Found);
    (bound, forces)
}
