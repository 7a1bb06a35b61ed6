//! Answers as results have them: one value of a sum, flat in JSON, where only the keys of its
//! question stand.

use super::{
    certificate::DryResult, critical::CriticalValue, kinematic::KinematicAnswer,
    moving::MovingAnswer, path::PathAnswer, rocking::RockingAnswer, shaken::ShakenAnswer,
    stages::StagesAnswer, state::StateAnswer, thrust::ThrustAnswer,
};
use crate::{
    terms::{Bound, Bracket, Deciding, Fate, Found, Law, Outcome},
    verdict::{Verdict, exact::Grade},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Flat", into = "Flat")]
pub enum Answer {
    /// Does it stand?
    Verdict(VerdictAnswer),
    /// How large may the live load grow?
    Limit(LimitAnswer),
    /// How heavy may a train be?
    Moving(Box<MovingAnswer>),
    /// At what tilt does it fall?
    Tilt(TiltAnswer),
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
    /// What follows from the stiffness of its joints.
    State(Box<StateAnswer>),
    /// On ground that moves: what its mechanism does.
    Rocking(Box<RockingAnswer>),
    /// On ground that moves: what all its blocks do.
    Shaken(Box<ShakenAnswer>),
    /// What became of it in time, beside the verdict where that was asked.
    Simulation(Fate, Option<VerdictAnswer>),
}

/// Does it stand?
#[derive(Clone, Debug, PartialEq)]
pub struct VerdictAnswer {
    /// The verdict.
    pub verdict: Verdict,
    /// It stands: for which law of sliding. With `associative` forces exist, and whether the loads
    /// produce them was not asked.
    pub law: Option<Law>,
    /// Bracket of the least unbalance, in multiples of gravity.
    pub unbalance: Bracket,
    /// The part of the scene that decides, where it has several.
    pub part: Option<Deciding>,
    /// How exactly it is proved; nothing where it is undecided.
    pub proof: Option<Grade>,
}

/// How large may the live load grow?
#[derive(Clone, Debug, PartialEq)]
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
#[derive(Clone, Debug, PartialEq)]
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadFactorAnswer {
    /// What became of it.
    pub status: FactorStatus,
    /// The law of sliding that it holds for.
    pub law: Law,
    /// The value to use; absent where none was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Lower end of its bracket. With dry friction that slides it is computed: up to there the
    /// state was seen at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lower: Option<f64>,
    /// Upper end of its bracket. With dry friction that slides the least value at which the state
    /// was seen to move, or else the proved bound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upper: Option<f64>,
    /// How the value with dry friction was found, where that was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found: Option<Found>,
    /// The bound: joints that slide open as well.
    pub associative: Bound,
}

/// What became of a load factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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
    /// falls where the bound is below zero, and needs a pre-stress otherwise.
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
            Self::Verdict(a) | Self::Simulation(_, Some(a)) => Some(a.verdict),
            Self::Limit(a) => a.verdict,
            Self::Tilt(a) => a.verdict,
            Self::Moving(a) => a.verdict,
            Self::Kinematic(a) => a.verdict,
            Self::Stages(a) => Some(a.verdict),
            Self::State(a) => Some(a.verdict),
            Self::Critical(_)
            | Self::Thrust(_)
            | Self::Path(_)
            | Self::Rocking(_)
            | Self::Shaken(_)
            | Self::Simulation(_, None) => None,
        }
    }

    /// The verdict with what belongs to it, where it is the answer.
    pub fn as_verdict(&self) -> Option<&VerdictAnswer> {
        match self {
            Self::Verdict(a) | Self::Simulation(_, Some(a)) => Some(a),
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
            Self::Simulation(fate, _) => Some(*fate),
            _ => None,
        }
    }

    /// The part of the scene that decides.
    pub fn part(&self) -> Option<&Deciding> {
        match self {
            Self::Verdict(a) | Self::Simulation(_, Some(a)) => a.part.as_ref(),
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
            Self::Verdict(a) | Self::Simulation(_, Some(a)) => a.proof,
            Self::Limit(a) => a.proof,
            Self::Tilt(a) => a.proof,
            Self::Moving(a) => a.proof,
            Self::Kinematic(a) => a.proof,
            Self::Rocking(a) => a.proof,
            Self::State(a) => a.proof,
            _ => None,
        }
    }
}

/// How an answer stands in JSON. Of the keys only those that belong to the question are present.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Flat {
    /// Does it stand? Beside a load factor or a tilt: without the live load, where that was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    verdict: Option<Verdict>,
    /// It stands: for which law of sliding. With `associative` forces exist, and whether the loads
    /// produce them was not asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    law: Option<Law>,
    /// What became of it in time.
    #[serde(skip_serializing_if = "Option::is_none")]
    fate: Option<Fate>,
    /// Bracket of the least unbalance, in multiples of gravity.
    #[serde(skip_serializing_if = "Option::is_none")]
    unbalance: Option<Bracket>,
    /// The part of the scene that decides, where it has several.
    #[serde(skip_serializing_if = "Option::is_none")]
    part: Option<Deciding>,
    /// How exactly what is claimed is proved.
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<Grade>,
    /// The load factor.
    #[serde(skip_serializing_if = "Option::is_none")]
    load_factor: Option<LoadFactorAnswer>,
    /// The direction of the tilt.
    #[serde(skip_serializing_if = "Option::is_none")]
    toward: Option<[f64; 3]>,
    /// The tangent of the tilt at which it falls.
    #[serde(skip_serializing_if = "Option::is_none")]
    tan_tilt: Option<LoadFactorAnswer>,
    /// The same in degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt_deg: Option<LoadFactorAnswer>,
    /// The values at which the verdict flips.
    #[serde(skip_serializing_if = "Option::is_none")]
    critical: Option<Vec<CriticalValue>>,
    /// The range of the thrust on a support, and the geometric safety factor.
    #[serde(skip_serializing_if = "Option::is_none")]
    thrust: Option<Box<ThrustAnswer>>,
    /// How far supports or a control point move.
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<Box<PathAnswer>>,
    /// What an earthquake does.
    #[serde(skip_serializing_if = "Option::is_none")]
    kinematic: Option<Box<KinematicAnswer>>,
    /// What its stages do.
    #[serde(skip_serializing_if = "Option::is_none")]
    stages: Option<Box<StagesAnswer>>,
    /// What follows from the stiffness of its joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    state: Option<Box<StateAnswer>>,
    /// What a mechanism does on ground that moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    rocking: Option<Box<RockingAnswer>>,
    /// What all blocks do on ground that moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    shaken: Option<Box<ShakenAnswer>>,
    /// One position of a train.
    #[serde(skip_serializing_if = "Option::is_none")]
    moving: Option<Box<MovingAnswer>>,
}

impl JsonSchema for Answer {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Answer".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        Flat::json_schema(generator)
    }
}

impl From<Answer> for Flat {
    fn from(answer: Answer) -> Self {
        let verdict = |a: VerdictAnswer| Self {
            verdict: Some(a.verdict),
            law: a.law,
            unbalance: Some(a.unbalance),
            part: a.part,
            proof: a.proof,
            ..Self::default()
        };
        match answer {
            Answer::Verdict(a) => verdict(a),
            Answer::Simulation(fate, a) => {
                Self { fate: Some(fate), ..a.map_or_else(Self::default, verdict) }
            }
            Answer::Limit(LimitAnswer { load_factor, verdict, part, proof }) => {
                Self { verdict, part, proof, load_factor: Some(load_factor), ..Self::default() }
            }
            Answer::Tilt(TiltAnswer { toward, tan_tilt, tilt_deg, verdict, part, proof }) => Self {
                verdict,
                part,
                proof,
                toward: Some(toward),
                tan_tilt: Some(tan_tilt),
                tilt_deg: Some(tilt_deg),
                ..Self::default()
            },
            Answer::Critical(list) => Self { critical: Some(list), ..Self::default() },
            Answer::Thrust(thrust) => Self { thrust: Some(thrust), ..Self::default() },
            Answer::Path(path) => Self { path: Some(path), ..Self::default() },
            Answer::Kinematic(a) => Self { kinematic: Some(a), ..Self::default() },
            Answer::Stages(a) => Self { stages: Some(a), ..Self::default() },
            Answer::State(a) => Self { state: Some(a), ..Self::default() },
            Answer::Rocking(a) => Self { rocking: Some(a), ..Self::default() },
            Answer::Shaken(a) => Self { shaken: Some(a), ..Self::default() },
            Answer::Moving(a) => Self { moving: Some(a), ..Self::default() },
        }
    }
}

impl TryFrom<Flat> for Answer {
    type Error = &'static str;

    fn try_from(flat: Flat) -> Result<Self, Self::Error> {
        const MIXED: &str =
            "keys of several questions stand in one answer, or some of one are missing";
        let Flat {
            verdict,
            law,
            fate,
            unbalance,
            part,
            proof,
            load_factor,
            toward,
            tan_tilt,
            tilt_deg,
            critical,
            thrust,
            path,
            kinematic,
            stages,
            state,
            rocking,
            shaken,
            moving,
        } = flat;
        let alone_in_all = verdict.is_none()
            && law.is_none()
            && fate.is_none()
            && unbalance.is_none()
            && part.is_none()
            && proof.is_none()
            && load_factor.is_none()
            && toward.is_none()
            && tan_tilt.is_none()
            && tilt_deg.is_none()
            && critical.is_none()
            && thrust.is_none();
        let mut lone = [
            path.map(Self::Path),
            kinematic.map(Self::Kinematic),
            stages.map(Self::Stages),
            state.map(Self::State),
            rocking.map(Self::Rocking),
            shaken.map(Self::Shaken),
            moving.map(Self::Moving),
        ]
        .into_iter()
        .flatten();
        match (lone.next(), lone.next()) {
            (None, _) => {}
            (Some(answer), None) if alone_in_all => return Ok(answer),
            _ => return Err(MIXED),
        }
        let alone = verdict.is_none() && part.is_none() && proof.is_none();
        match (fate, load_factor, (toward, tan_tilt, tilt_deg), critical, thrust) {
            (None, Some(load_factor), (None, None, None), None, None)
                if law.is_none() && unbalance.is_none() =>
            {
                Ok(Self::Limit(LimitAnswer { load_factor, verdict, part, proof }))
            }
            (None, None, (Some(toward), Some(tan_tilt), Some(tilt_deg)), None, None)
                if law.is_none() && unbalance.is_none() =>
            {
                Ok(Self::Tilt(TiltAnswer { toward, tan_tilt, tilt_deg, verdict, part, proof }))
            }
            (None, None, (None, None, None), Some(list), None)
                if alone && law.is_none() && unbalance.is_none() =>
            {
                Ok(Self::Critical(list))
            }
            (None, None, (None, None, None), None, Some(thrust))
                if alone && law.is_none() && unbalance.is_none() =>
            {
                Ok(Self::Thrust(thrust))
            }
            (fate, None, (None, None, None), None, None) => {
                let verdict = match (verdict, unbalance) {
                    (Some(verdict), Some(unbalance)) => {
                        Some(VerdictAnswer { verdict, law, unbalance, part, proof })
                    }
                    (None, None) if alone && law.is_none() => None,
                    _ => return Err(MIXED),
                };
                match (fate, verdict) {
                    (Some(fate), verdict) => Ok(Self::Simulation(fate, verdict)),
                    (None, Some(verdict)) => Ok(Self::Verdict(verdict)),
                    (None, None) => Err("the answer is empty"),
                }
            }
            _ => Err(MIXED),
        }
    }
}
