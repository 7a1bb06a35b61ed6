//! Answers: one value of a sum. They are derived, and never read from a file.

use super::{
    certificate::DryResult, combinations::CombinationsAnswer, critical::CriticalValue,
    kinematic::KinematicAnswer, meet::MeetAnswer, moving::MovingAnswer, path::PathAnswer,
    rocking::RockingAnswer, shaken::ShakenAnswer, stages::StagesAnswer, state::StateAnswer,
    thrust::ThrustAnswer, without::WithoutAnswer,
};
use crate::{
    elastic::PathEnd,
    question::{KinematicOptions, Question},
    sensitivity::{Target, Under},
    terms::{Bound, Bracket, Changing, Deciding, Fate, Found, Law, Outcome},
    verdict::{Verdict, exact::Grade},
};
use nalgebra::Vector3;
use scene::Scene;
use schemars::JsonSchema;
use serde::Serialize;
use serde_with::skip_serializing_none;

/// An answer. In JSON a verdict, a load factor and a tilt stand by themselves, all others under the
/// name of what they are about.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// How heavy may a train be?
    Moving(Box<MovingAnswer>),
    /// The values at which the verdict flips.
    Critical(Vec<CriticalValue>),
    /// The range of the thrust on a support.
    Thrust(Box<ThrustAnswer>),
    /// How far supports or a control point move.
    Path(Box<PathAnswer>),
    /// Under an earthquake: at what acceleration it starts to move, and what then.
    Kinematic(Box<KinematicAnswer>),
    /// Does every stage of its construction stand, and how safely?
    Stages(Box<StagesAnswer>),
    /// Which blocks may be taken out?
    Without(Box<WithoutAnswer>),
    /// What follows from the stiffness of its joints.
    State(Box<StateAnswer>),
    /// On ground that moves: what its mechanism does.
    Rocking(Box<RockingAnswer>),
    /// On ground that moves: what all its blocks do.
    Shaken(Box<ShakenAnswer>),
    /// In every combination of actions.
    Combinations(Box<CombinationsAnswer>),
    /// Where what is required is met.
    Meet(Box<MeetAnswer>),
    /// Does it stand?
    #[serde(untagged)]
    Verdict(VerdictAnswer),
    /// How large may the live load grow?
    #[serde(untagged)]
    Limit(LimitAnswer),
    /// At what tilt does it fall?
    #[serde(untagged)]
    Tilt(TiltAnswer),
    /// What became of it in time, beside the verdict where that was asked.
    #[serde(untagged)]
    Simulation(SimulationAnswer),
}

/// What became of a scene in time.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SimulationAnswer {
    /// Its fate.
    pub fate: Fate,
    /// The verdict beside it.
    #[serde(flatten)]
    pub verdict: Option<VerdictAnswer>,
}

/// Does it stand?
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct VerdictAnswer {
    /// The verdict.
    pub verdict: Verdict,
    /// It stands: for which law of sliding. With `associative` forces exist, and whether the loads
    /// produce them was not asked.
    pub law: Option<Law>,
    /// Bracket of the least equilibrium error, in multiples of gravity.
    pub equilibrium_error: Bracket,
    /// The part of the scene that decides, where it has several.
    pub part: Option<Deciding>,
    /// How exactly it is proved; nothing where it is undecided.
    pub proof: Option<Grade>,
}

/// How large may the live load grow?
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LimitAnswer {
    /// The load factor.
    pub load_factor: LoadFactorAnswer,
    /// Whether it stands without its live load, where that was asked.
    pub verdict: Option<Verdict>,
    /// The part of the scene that decides the bound, where it has several.
    pub part: Option<Deciding>,
    /// How exactly the bound is proved; nothing where it is undecided.
    pub proof: Option<Grade>,
}

/// At what tilt does it fall?
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct TiltAnswer {
    /// The direction of the tilt.
    pub toward: [f64; 3],
    /// The tangent of the tilt.
    pub tan_tilt: LoadFactorAnswer,
    /// The tilt in degrees.
    pub tilt_deg: LoadFactorAnswer,
    /// Whether it stands level, where that was asked.
    pub verdict: Option<Verdict>,
    /// The part of the scene that decides the bound, where it has several.
    pub part: Option<Deciding>,
    /// How exactly the bound is proved; nothing where it is undecided.
    pub proof: Option<Grade>,
}

/// A load factor, or a tilt: the one to use, and the bound beside it under its own name.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LoadFactorAnswer {
    /// What became of it.
    pub status: FactorStatus,
    /// The law of sliding that it holds for.
    pub law: Law,
    /// The value to use; absent where none was found.
    pub value: Option<f64>,
    /// Lower end of its bracket. With dry friction that slides it is computed: up to there the
    /// state was seen at rest.
    pub lower: Option<f64>,
    /// Upper end of its bracket. With dry friction that slides the least value at which the state
    /// was seen to move, or else the proved bound.
    pub upper: Option<f64>,
    /// How the value with dry friction was found, where that was asked.
    pub found: Option<Found>,
    /// The bound: joints that slide open as well.
    pub associative: Bound,
}

/// What became of a load factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FactorStatus {
    /// There is a value.
    Found,
    /// There is no limit.
    Unbounded,
    /// No load factor lets the scene stand.
    Impossible,
    /// It is not less than `lower`, which another answer is known to bear; how much more was not
    /// asked.
    AtLeast,
    /// Under the dead load alone it does not come to rest: there is no value with dry friction. It
    /// falls where the bound is below zero, and needs self-stress otherwise.
    NotAtRest,
    /// It did not come out.
    Undecided,
}

impl From<Outcome> for FactorStatus {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Found => Self::Found,
            Outcome::Unbounded => Self::Unbounded,
            Outcome::Impossible => Self::Impossible,
            Outcome::Undecided => Self::Undecided,
        }
    }
}

impl LoadFactorAnswer {
    /// The load factor to use, from the bound and what is known with dry friction, where that was
    /// asked.
    pub fn new(bound: Bound, dry: Option<&DryResult>) -> Self {
        let Bound { status, value, lower, upper } = bound;
        let same = Self {
            status: status.into(),
            law: Law::Associative,
            value,
            lower,
            upper,
            found: None,
            associative: bound,
        };
        let Some(dry) = dry else { return same };
        let same = Self { law: Law::Coulomb, found: Some(dry.found), ..same };
        let none = |status| Self { status, value: None, lower: None, upper: None, ..same };
        match dry.found {
            // The bound itself, with its bracket.
            Found::NothingSlides if dry.is_reached() => same,
            Found::Unlimited => same,
            Found::NotAtRest => none(FactorStatus::NotAtRest),
            Found::AtLeast => Self { lower: dry.rests_at, upper, ..none(FactorStatus::AtLeast) },
            // A value is one only up to which the state was seen at rest.
            Found::FixedPoint | Found::Rests | Found::RestsBelow if dry.is_reached() => {
                let upper = dry.moves_at.filter(|_| dry.found != Found::FixedPoint).or(upper);
                Self {
                    status: FactorStatus::Found,
                    value: dry.value,
                    lower: dry.rests_at,
                    upper,
                    ..same
                }
            }
            _ => Self { lower: dry.rests_at, upper, ..none(FactorStatus::Undecided) },
        }
    }

    /// The same as an angle in degrees, of which it is the tangent.
    #[must_use]
    pub fn degrees(self) -> Self {
        let angle = |v: Option<f64>| v.map(|v| v.atan().to_degrees());
        let Bound { status, value, lower, upper } = self.associative;
        let associative =
            Bound { status, value: angle(value), lower: angle(lower), upper: angle(upper) };
        Self {
            value: angle(self.value),
            lower: angle(self.lower),
            upper: angle(self.upper),
            associative,
            ..self
        }
    }
}

impl Answer {
    /// The verdict: of a load factor, a tilt that of the scene without its live load, where it was
    /// asked.
    pub fn verdict(&self) -> Option<Verdict> {
        match self {
            Self::Verdict(a) | Self::Simulation(SimulationAnswer { verdict: Some(a), .. }) => {
                Some(a.verdict)
            }
            Self::Limit(a) => a.verdict,
            Self::Tilt(a) => a.verdict,
            Self::Moving(a) => a.verdict,
            Self::Kinematic(a) => a.verdict,
            Self::Stages(a) => Some(a.verdict),
            Self::State(a) => Some(a.verdict),
            Self::Critical(_)
            | Self::Thrust(_)
            | Self::Path(_)
            | Self::Without(_)
            | Self::Rocking(_)
            | Self::Shaken(_)
            | Self::Combinations(_)
            | Self::Meet(_)
            | Self::Simulation(SimulationAnswer { verdict: None, .. }) => None,
        }
    }

    /// The verdict with what belongs to it, where it is the answer.
    pub fn as_verdict(&self) -> Option<&VerdictAnswer> {
        match self {
            Self::Verdict(a) | Self::Simulation(SimulationAnswer { verdict: Some(a), .. }) => {
                Some(a)
            }
            _ => None,
        }
    }

    /// The load factor to use, or the tangent of the tilt.
    pub fn load_factor(&self) -> Option<&LoadFactorAnswer> {
        match self {
            Self::Limit(a) => Some(&a.load_factor),
            Self::Tilt(a) => Some(&a.tan_tilt),
            Self::Moving(a) => Some(&a.load_factor),
            Self::Kinematic(a) => Some(&a.alpha0),
            _ => None,
        }
    }

    /// The bound on it.
    pub fn bound(&self) -> Option<&Bound> {
        self.load_factor().map(|l| &l.associative)
    }

    /// The direction of a tilt or an earthquake.
    pub fn toward(&self) -> Option<[f64; 3]> {
        match self {
            Self::Tilt(a) => Some(a.toward),
            Self::Kinematic(a) => Some(a.toward),
            _ => None,
        }
    }

    /// The value whose changes with the numbers of the scene can be told; nothing where it has none.
    pub fn target(&self) -> Option<Target> {
        let toward = || self.toward().map(Vector3::from);
        let (of, under) = match self {
            Self::Limit(_) => (Changing::LoadFactor, Under::Load),
            Self::Tilt(_) => (Changing::TiltDeg, Under::Tilt(toward()?)),
            Self::Kinematic(_) => (Changing::Alpha0, Under::Quake(toward()?)),
            _ => return None,
        };
        let said = self.load_factor()?;
        let bound = said.associative.value.filter(|_| said.associative.status == Outcome::Found)?;
        let slides =
            matches!(said.found, Some(Found::FixedPoint | Found::Rests | Found::RestsBelow));
        let law = if said.value.is_some() { said.law } else { Law::Associative };
        Some(Target { of, under, bound, dry: said.value.filter(|_| slides), law })
    }

    /// The flips of a verdict.
    pub fn critical(&self) -> Option<&[CriticalValue]> {
        match self {
            Self::Critical(list) => Some(list),
            _ => None,
        }
    }

    /// The range of a thrust.
    pub fn thrust(&self) -> Option<&ThrustAnswer> {
        match self {
            Self::Thrust(a) => Some(a),
            _ => None,
        }
    }

    /// How far it goes.
    pub fn path(&self) -> Option<&PathAnswer> {
        match self {
            Self::Path(a) => Some(a),
            _ => None,
        }
    }

    /// What its stages do.
    pub fn stages(&self) -> Option<&StagesAnswer> {
        match self {
            Self::Stages(a) => Some(a),
            _ => None,
        }
    }

    /// What became of it in time.
    pub fn fate(&self) -> Option<Fate> {
        match self {
            Self::Simulation(a) => Some(a.fate),
            _ => None,
        }
    }

    /// The part of the scene that decides.
    pub fn part(&self) -> Option<&Deciding> {
        match self {
            Self::Verdict(a) | Self::Simulation(SimulationAnswer { verdict: Some(a), .. }) => {
                a.part.as_ref()
            }
            Self::Limit(a) => a.part.as_ref(),
            Self::Tilt(a) => a.part.as_ref(),
            Self::Moving(a) => a.part.as_ref(),
            Self::Kinematic(a) => a.part.as_ref(),
            _ => None,
        }
    }

    /// How exactly it is proved.
    pub fn proof(&self) -> Option<Grade> {
        match self {
            Self::Verdict(a) | Self::Simulation(SimulationAnswer { verdict: Some(a), .. }) => {
                a.proof
            }
            Self::Limit(a) => a.proof,
            Self::Tilt(a) => a.proof,
            Self::Moving(a) => a.proof,
            Self::Kinematic(a) => a.proof,
            Self::Rocking(a) => a.proof,
            Self::State(a) => a.proof,
            Self::Without(a) => a.proof,
            Self::Combinations(a) => a.proof,
            _ => None,
        }
    }
}

/// What may be required.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// A load factor λ.
    LoadFactor,
    /// A tilt, degrees.
    TiltDeg,
    /// The load factor α0 of an earthquake.
    Alpha0,
    /// The geometric safety factor.
    GeometricFactor,
    /// ζ_E, the share of the earthquake of the site.
    Site,
}

/// What was required of an answer; of several requirements the one that is met least.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Required {
    /// Of what.
    pub quantity: Quantity,
    /// The least value that is enough.
    pub least: f64,
    /// The value that is there, where it is known.
    pub obtained: Option<f64>,
    /// Whether it is reached; absent where that is open.
    pub met: Option<bool>,
}

impl Required {
    /// What is required, where anything is: by the question, or else by the scene.
    pub(super) fn of(question: &Question, scene: &Scene, answer: &Answer) -> Option<Self> {
        let own = least(question, scene).map(|(quantity, least)| {
            let met = reaches(question, answer, Some(least));
            let value = answer.load_factor().and_then(|l| l.value);
            let obtained = match quantity {
                Quantity::TiltDeg => value.map(|v| v.atan().to_degrees()),
                Quantity::GeometricFactor => {
                    geometric_factor(answer).map(|f| f.value.unwrap_or(f.lower))
                }
                _ => value,
            };
            Self { quantity, least, obtained, met }
        });
        let site = site(question, scene).map(|(o, least)| {
            let quantity = Quantity::Site;
            let met = and(reaches(question, answer, None), site_met(o, answer, least));
            Self { quantity, least, obtained: share(o, answer), met }
        });
        own.into_iter().chain(site).min_by_key(|r| match r.met {
            Some(false) => 0,
            None => 1,
            Some(true) => 2,
        })
    }
}

fn and(a: Option<bool>, b: Option<bool>) -> Option<bool> {
    match (a, b) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    }
}

/// The least value that is required of a question's own quantity.
fn least(question: &Question, scene: &Scene) -> Option<(Quantity, f64)> {
    let r = &scene.require;
    let (quantity, usual) = match question {
        Question::Limit(_) | Question::Moving(_) | Question::State(_) => {
            (Quantity::LoadFactor, r.load_factor)
        }
        Question::Tilt(_) | Question::Repose(_) => (Quantity::TiltDeg, r.tilt_deg),
        Question::Kinematic(_) => (Quantity::Alpha0, r.alpha_0),
        Question::Thrust(o) if o.range => (Quantity::GeometricFactor, r.geometric_factor),
        _ => return None,
    };
    question.require().or(usual).map(|least| (quantity, least))
}

/// The least share of the earthquake of the site: a site asks whether it is enough.
fn site<'a>(question: &'a Question, scene: &Scene) -> Option<(&'a KinematicOptions, f64)> {
    let (Question::Kinematic(o), Some(_)) = (question, &scene.site) else { return None };
    Some((o, o.site.or(scene.require.site).unwrap_or(1.0)))
}

/// The share of the earthquake of the site by the verification that governs.
fn share(o: &KinematicOptions, answer: &Answer) -> Option<f64> {
    answer.kinematic()?.numbers.demand.as_ref()?.governing(o.verify)
}

/// Whether the verification that governs gives this share.
fn site_met(o: &KinematicOptions, answer: &Answer, least: f64) -> Option<bool> {
    let numbers = &answer.kinematic()?.numbers;
    let ratio = share(o, answer)?;
    match numbers.of_bodies(ratio) {
        _ if ratio < least => Some(false),
        // Met only because a body is drawn as several blocks.
        bodies if bodies < least => None,
        _ => Some(true),
    }
}

/// Whether the answer to a question is a yes: it is known, and as much as is required where anything
/// is; `None` where that is open. A requirement inside the bracket is not decided. Where dry friction
/// was asked for, the bound alone meets no requirement.
pub fn holds(question: &Question, scene: &Scene, answer: &Answer) -> Option<bool> {
    match answer {
        Answer::Combinations(a) => return a.holds(),
        Answer::Meet(a) if !a.changes.is_empty() => return Some(true),
        Answer::Meet(a) => return a.throughout,
        _ => {}
    }
    let own = reaches(question, answer, least(question, scene).map(|l| l.1));
    match site(question, scene) {
        Some((o, least)) => and(own, site_met(o, answer, least)),
        None => own,
    }
}

fn geometric_factor(answer: &Answer) -> Option<super::thrust::Factor> {
    answer.thrust()?.geometric_factor
}

/// The same by the question's own quantity.
fn reaches(question: &Question, answer: &Answer, require: Option<f64>) -> Option<bool> {
    if let Answer::State(a) = answer {
        return match (a.load_factor, require) {
            _ if a.verdict == Verdict::Undecided => None,
            _ if a.verdict != Verdict::Stable => Some(false),
            (Some(l), Some(r)) if l.reached >= r || l.value.is_some_and(|v| v >= r) => Some(true),
            (Some(l), Some(r)) if l.associative.upper.is_some_and(|u| u < r) => Some(false),
            (Some(l), Some(_)) if l.value.is_some() => Some(false),
            (_, Some(_)) => None,
            (Some(l), None) if l.end == PathEnd::Open => None,
            (_, None) => Some(true),
        };
    }
    if let (Question::Thrust(_), Some(least)) = (question, require) {
        return match geometric_factor(answer) {
            Some(f) if f.lower >= least => Some(true),
            Some(f) if f.upper.is_some_and(|u| u < least) => Some(false),
            Some(_) => None,
            None => (answer.verdict() == Some(Verdict::Unstable)).then_some(false),
        };
    }
    let said = answer.load_factor()?;
    let scale = |lambda: f64| match question {
        Question::Tilt(_) | Question::Repose(_) => lambda.atan().to_degrees(),
        _ => lambda,
    };
    // A scene that needs self-stress already without its live load, or falls, is no yes.
    let negative = said.associative.found().is_some_and(|(.., upper)| upper < 0.0);
    let level = answer.verdict();
    let dead = matches!(level, Some(Verdict::Conditional | Verdict::Unstable)) || negative;
    let is_open = level == Some(Verdict::Undecided);
    let (lower, upper) = (said.lower.map(scale), said.upper.map(scale));
    match (said.status, require) {
        (FactorStatus::Impossible | FactorStatus::NotAtRest, _) => Some(false),
        _ if dead => Some(false),
        (_, Some(r)) if said.associative.upper.map(scale).is_some_and(|u| u < r) => Some(false),
        // Nor is one of which that is not known.
        _ if is_open => None,
        (FactorStatus::Found | FactorStatus::Unbounded, None)
        | (FactorStatus::Unbounded, Some(_)) => Some(true),
        // Seen at rest there, whatever is known beyond.
        (_, Some(r)) if lower.is_some_and(|l| l >= r) => Some(true),
        (FactorStatus::Found, Some(r)) if upper.is_some_and(|u| u < r) => Some(false),
        // Of a value with dry friction that slides, the ends are what was seen beside it.
        (FactorStatus::Found, Some(r))
            if matches!(said.found, Some(Found::FixedPoint | Found::Rests | Found::RestsBelow)) =>
        {
            Some(said.value.map(scale).is_none_or(|v| v >= r))
        }
        (FactorStatus::Found | FactorStatus::AtLeast | FactorStatus::Undecided, _) => None,
    }
}

/// The answer to a question about one of several scenes.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Nested {
    /// The answer.
    pub answer: Answer,
    /// What was required of it, and whether it is met.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub required: Option<Required>,
}

impl Nested {
    /// Whether what is asked holds: what is required is met, or it stands; `None` where that is open.
    pub fn holds(&self) -> Option<bool> {
        match self.required {
            Some(required) => required.met,
            None => match self.answer.verdict()? {
                Verdict::Stable => Some(true),
                Verdict::Undecided => None,
                _ => Some(false),
            },
        }
    }

    /// What orders answers, the worst first: what does not hold, what is open, what holds; among these
    /// the load factor.
    pub fn height(&self) -> (u8, f64) {
        let rank = match self.holds() {
            Some(false) => 0,
            None => 1,
            Some(true) => 2,
        };
        let value = self.answer.load_factor().map_or(0.0, |l| {
            let unlimited = l.status == FactorStatus::Unbounded;
            let known = l.value.or(l.lower);
            known.unwrap_or(if unlimited { f64::INFINITY } else { f64::NEG_INFINITY })
        });
        (rank, value)
    }
}
