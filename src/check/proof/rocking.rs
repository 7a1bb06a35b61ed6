//! Results of `rock`: what is claimed are the load factors of the mechanism, towards a direction and
//! against it; the machine and its history are computed, and computed again by who checks.

use super::{
    answer::Answer,
    certificate::Proven,
    compare,
    derive::{Derivation, require},
    evidence::RockEvidence,
    told::Told,
};
use crate::{
    kinematic::quake,
    rocking::RockOptions,
    terms::{Bound, Outcome},
    verdict::{
        claim::{Claim, Findings},
        exact::Grade,
    },
};
use base::tolerance;
use model::interface::Model;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// The answer about a mechanism on ground that moves.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingAnswer {
    /// What was asked, with the record itself.
    pub asked: RockOptions,
    /// Unit direction of the mechanism, horizontal.
    pub toward: [f64; 3],
    /// The mechanism towards it.
    pub towards: RockingSense,
    /// The mechanism against it.
    pub against: RockingSense,
    /// The free blocks that are in it; others touch none of them.
    pub blocks: Vec<String>,
    /// How exactly the load factors are proved, the weaker of both.
    pub proof: Option<Grade>,
    /// Why the machine is an idealisation; absent where it is exact for rigid blocks that neither
    /// slide nor bounce.
    pub idealised: Option<String>,
    /// The block whose way is told.
    pub control: String,
    /// The point of it at the start, m.
    pub point: [f64; 3],
    /// Its least thickness, m.
    pub thickness: f64,
    /// What became of it.
    pub fate: RockingFate,
    /// When no acceleration to come could bring it back any more, s.
    pub overturned_at: Option<f64>,
    /// When it first moved, s.
    pub released_at: Option<f64>,
    /// Where it was farthest.
    pub greatest: RockingPlace,
    /// Where it is at the end, unless it overturned.
    pub residual: Option<RockingPlace>,
    /// Its impacts.
    pub impacts: Vec<RockingImpact>,
    /// Scales at which its fate flips, where that was asked.
    pub flips: Option<Vec<RockingFlip>>,
    /// What is said beside.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// A mechanism in one sense.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingSense {
    /// The acceleration of the ground beyond which it moves, in multiples of gravity; unbounded
    /// where nothing moves that way.
    pub load_factor: Bound,
    /// Small motions about the unstable equilibrium go with exp(± p t): p, 1/s.
    pub frequency: Option<f64>,
    /// The coordinate there, rad.
    pub unstable: Option<f64>,
    /// What is left of the speed at an impact that ends the motion in this sense.
    pub restitution: f64,
    /// What conserves momentum there.
    pub conserving: f64,
}

/// What became of a mechanism in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RockingFate {
    /// It came to rest where it was.
    Rests,
    /// It still rocked when the time was over.
    Rocks,
    /// It overturned.
    Overturns,
}

/// A place in a history.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingPlace {
    /// s.
    pub time: f64,
    /// The coordinate, rad; < 0 against the direction.
    pub turn: f64,
    /// Way of the control point, m.
    pub way: f64,
}

/// An impact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingImpact {
    /// s.
    pub time: f64,
    /// The rate before it, rad/s.
    pub before: f64,
    /// What was left of it.
    pub factor: f64,
}

/// Two scales next to each other with different fates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockingFlip {
    /// The scale at which it overturns.
    pub overturns_at: f64,
    /// The one at which it stands.
    pub stands_at: f64,
}

/// Both load factors follow from the scene; the machine and its history are computed.
pub(super) fn derive(
    d: &mut Derivation,
    o: &RockOptions,
    e: &RockEvidence,
) -> Result<Told, String> {
    let said = &*e.history;
    if said.asked != *o {
        return Err("the history is not the one that was asked for".into());
    }
    let toward = Vector3::from(said.toward);
    let mut answer = said.clone();
    let mut grade = Some(Grade::Exact);
    let mut first: Option<(Model, Option<Proven>)> = None;
    let sides = [
        ("towards the direction", toward, &e.towards),
        ("against the direction", -toward, &e.against),
    ];
    for (k, (title, toward, certificate)) in sides.into_iter().enumerate() {
        let own = part(d, said, toward)?;
        let mut f = Findings::default();
        let proven = certificate.prove(&mut f, &own, d.known());
        let none = |status| Bound { status, value: None, lower: None, upper: None };
        let bound = match proven.as_ref().and_then(|p| p.claim) {
            Some(Claim::LoadFactor { value, lower, upper }) => Bound {
                value: Some(value),
                lower: Some(lower),
                upper: Some(upper),
                ..none(Outcome::Found)
            },
            Some(Claim::Unbounded { .. }) => none(Outcome::Unbounded),
            Some(Claim::Impossible) => none(Outcome::Impossible),
            _ => {
                f.fails.push("no load factor is proved".into());
                none(Outcome::Undecided)
            }
        };
        grade = grade.and_then(|g| Some(g.and(proven.as_ref()?.grade?)));
        if k == 0 {
            require(
                &mut f,
                bound.status == Outcome::Found,
                "there is a mechanism towards the direction",
            );
            answer.towards.load_factor = bound;
            first = Some((own, proven));
        } else {
            answer.against.load_factor = bound;
        }
        d.part(title, f);
    }
    answer.proof = grade;
    let f = history(d, said);
    d.part("history", f);
    d.check.claimed = grade.is_some();
    let mut told = Told::new(d.model, Answer::Rocking(Box::new(answer)), &e.towards);
    if let Some((own, proven)) = first {
        told.in_words(&own, proven.as_ref());
    }
    told.against = Some(e.against.clone());
    Ok(told)
}

/// The blocks of the mechanism under weights that push towards a direction.
fn part(d: &Derivation, said: &RockingAnswer, toward: Vector3<f64>) -> Result<Model, String> {
    let model = d.model;
    let own = quake(d.scene, model, toward).map_err(|e| e.to_string())?;
    if (own.toward - toward).norm() > tolerance::ALONG {
        return Err("the direction is not a unit vector across gravity".into());
    }
    if let Some(id) = said.blocks.iter().find(|id| model.assembly.find(id).is_none()) {
        return Err(format!("the scene has no block {id}"));
    }
    let stays = |i: &usize| !said.blocks.contains(&model.assembly.blocks[*i].id);
    let gone: Vec<usize> = model.assembly.free().filter(stays).collect();
    Ok(own.model.without(&gone))
}

/// The machine and its history are those that come out again.
fn history(d: &Derivation, said: &RockingAnswer) -> Findings {
    let mut f = Findings { computed: true, ..Findings::default() };
    if !d.asks_again() {
        return f;
    }
    let text = format!(
        "the history with {} impacts is the same when computed again (computed, not proved)",
        said.impacts.len()
    );
    // Proved, each from evidence of its own.
    let plain = |a: &RockingAnswer| RockingAnswer { proof: None, ..a.clone() };
    match d.again.rocking(&said.asked, d.scene, d.model) {
        None => f.unchecked.push(text),
        Some(Err(e)) => f.fails.push(format!("the history cannot be computed for this scene: {e}")),
        Some(Ok(here)) => match compare::first_difference(&plain(said), &plain(&here)) {
            None => f.holds.push(text),
            Some(place) => {
                f.fails.push(format!("computed again, the answer differs at {place}"));
            }
        },
    }
    f
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
