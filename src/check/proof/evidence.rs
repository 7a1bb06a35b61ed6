//! What a result is derived from, one type a question: forces, rates, poses, displacements, each
//! with the direction, position, stage or value that it belongs to, and what a solver or an engine
//! computed where there is no proof. No verdicts, no sentences.

use super::{
    certificate::Certificate, combinations::CombinationsEvidence, kinematic::Control,
    meet::MeetEvidence, rocking::RockingAnswer, shaken::ShakenAnswer, simulation::Seen,
    without::WithoutEvidence,
};
use crate::{
    elastic::{PathEnd, Quadrature},
    path::saved::SavedPose,
    question::Question,
    terms::{ClosedAnswer, Found, Law, Method, Order, Sided, StateMotion},
    verdict::{Verdict, evidence::ContactForces},
};
use model::train::Travel;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::sync::Arc;

/// The evidence for the answer to a question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Evidence {
    /// Does it stand?
    Assess(AssessEvidence),
    /// How large may the live load grow?
    Limit(LimitEvidence),
    /// How heavy may a train be?
    Moving(MovingEvidence),
    /// At what tilt does it fall?
    Tilt(TiltEvidence),
    /// Where does the verdict flip?
    Critical(CriticalEvidence),
    /// How hard does it push a support?
    Thrust(ThrustEvidence),
    /// How far may supports move?
    Settle(PathEvidence),
    /// How does the load factor fall?
    Push(PathEvidence),
    /// Under an earthquake?
    Kinematic(KinematicEvidence),
    /// Does every stage stand?
    Stages(StagesEvidence),
    /// Which blocks may be taken out?
    Without(WithoutEvidence),
    /// What follows from the stiffness of joints?
    State(StateEvidence),
    /// A mechanism on ground that moves.
    Rock(RockEvidence),
    /// What happens in time?
    Simulate(SimulateEvidence),
    /// All blocks on ground that moves. Computed.
    Shake(Box<ShakenAnswer>),
    /// In every combination of actions.
    Combinations(CombinationsEvidence),
    /// Where what is required is met.
    Meet(MeetEvidence),
}

/// Of a verdict.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Standing {
    /// Forces, or a mechanism.
    pub certificate: Arc<Certificate>,
    /// What the state under dry friction does, where it was computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<StateMotion>,
}

/// Of `assess`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AssessEvidence {
    /// Of the verdict.
    pub standing: Standing,
    /// What happened in time, where that was asked as well.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub simulation: Option<Box<Seen>>,
}

/// The answer with contacts closed that were left out. Computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClosedEvidence {
    /// How joints slide in it.
    pub law: Law,
    /// The answer.
    pub answer: ClosedAnswer,
}

/// Of a load factor.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FactorEvidence {
    /// Of the bound: joints open as they slide.
    pub bound: Arc<Certificate>,
    /// Where the bound did not come out: ends between which it lies, as far as they were found.
    #[serde(default, skip_serializing_if = "is_unknown")]
    pub between: [Option<f64>; 2],
    /// With dry friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry: Option<DryEvidence>,
}

/// Of a load factor with dry friction: where it claims something a proof, and the load factors at
/// which a state was computed.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryEvidence {
    /// How it was found.
    pub found: Found,
    /// The value, where found.
    pub value: Option<f64>,
    /// The greatest load factor at which the state was seen at rest.
    pub rests_at: Option<f64>,
    /// The least at which it was seen to move.
    pub moves_at: Option<f64>,
    /// Forces and a mechanism.
    pub certificate: Arc<Certificate>,
}

impl Evidence {
    /// How the value changes with numbers for which that was asked again; nothing where that is no
    /// part of the evidence.
    pub fn sided_mut(&mut self) -> Option<&mut Vec<Sided>> {
        match self {
            Self::Limit(e) => Some(&mut e.sided),
            Self::Tilt(e) => Some(&mut e.sided),
            Self::Kinematic(e) => Some(&mut e.sided),
            _ => None,
        }
    }

    /// The same, to read.
    pub fn sided(&self) -> &[Sided] {
        match self {
            Self::Limit(e) => &e.sided,
            Self::Tilt(e) => &e.sided,
            Self::Kinematic(e) => &e.sided,
            _ => &[],
        }
    }
}

impl DryEvidence {
    /// That nothing is known.
    pub(super) fn undecided() -> Self {
        Self {
            found: Found::Undecided,
            value: None,
            rests_at: None,
            moves_at: None,
            certificate: Arc::default(),
        }
    }
}

/// Of `limit`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitEvidence {
    /// Of the load factor.
    pub factor: FactorEvidence,
    /// Of the scene without its live load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dead: Option<Standing>,
    /// How its value changes with numbers for which that was asked again. Computed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sided: Vec<Sided>,
}

/// Of `moving`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MovingEvidence {
    /// Positions of the train.
    pub positions: Vec<PositionEvidence>,
    /// Of the scene without the train.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dead: Option<Standing>,
}

/// Of one position of a train.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PositionEvidence {
    /// Which way the train goes.
    pub travel: Travel,
    /// Where its origin is, x in the scene, m.
    pub x: f64,
    /// Of the load factor.
    pub factor: FactorEvidence,
}

/// Of `tilt`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TiltEvidence {
    /// One a direction of the question, in its order.
    pub directions: Vec<FactorEvidence>,
    /// Of the scene level.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub level: Option<Standing>,
    /// How the least tilt changes with numbers for which that was asked again. Computed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sided: Vec<Sided>,
}

/// Of `critical`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalEvidence {
    /// The scan: computed.
    pub scan: Vec<ScanPoint>,
    /// Both sides of every flip.
    pub flips: Vec<FlipEvidence>,
    /// Without a flip: the ends of the range.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ends: Vec<SideEvidence>,
}

/// A value of the scan. Computed.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScanPoint {
    /// The value.
    pub value: f64,
    /// Its verdict; absent where there is no scene with this value.
    pub verdict: Option<Verdict>,
    /// Its least equilibrium error, g, as the mechanism bounds it from below.
    pub equilibrium_error: Option<f64>,
}

/// Of a flip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlipEvidence {
    /// The value.
    pub value: f64,
    /// How it was found.
    pub method: Method,
    /// The nearest value below.
    pub below: SideEvidence,
    /// The nearest value above.
    pub above: SideEvidence,
}

/// Of a verdict at a value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SideEvidence {
    /// The value.
    pub value: f64,
    /// Of the verdict there.
    pub standing: Standing,
}

/// Of `thrust`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThrustEvidence {
    /// Of the verdict: without one that stands there is no thrust.
    pub standing: Standing,
    /// Of the least and the greatest thrust.
    pub ends: Option<[Arc<Certificate>; 2]>,
    /// The geometric safety factor that was found between the shrunk sections.
    pub factor: Option<f64>,
    /// Of the verdicts with shrunk sections, by the share of the section that is left.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shrunk: Vec<SideEvidence>,
}

/// Of a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathEvidence {
    /// Points, in order. A jump has two at one value.
    pub points: Vec<PointEvidence>,
    /// It falls: the last pose that stands and the first that falls, of the same linkage.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ends: Vec<PointEvidence>,
    /// How it ends.
    pub end: EndEvidence,
    /// Settle: of the least reaction at the start; its rates are of the free blocks, and the
    /// supports' are those of the movement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least: Option<Arc<Certificate>>,
}

impl PathEvidence {
    /// This one, and what follows from its last point.
    #[must_use]
    pub fn and(mut self, next: Self) -> Self {
        let last = self.points.last().map_or(f64::NEG_INFINITY, |p| p.value);
        self.points.extend(next.points.into_iter().filter(|p| p.value > last));
        Self { ends: next.ends, end: next.end, ..self }
    }
}

/// How the search for a path ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum EndEvidence {
    /// All of the movement was followed.
    Reached,
    /// It falls.
    Falls,
    /// The load factor vanishes.
    Vanishes,
    /// These two slide on each other, and no motion was found that leads on.
    Slides([String; 2]),
    /// It was not followed any further.
    Open,
}

/// A point of a path: a scene of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointEvidence {
    /// The parameter.
    pub value: f64,
    /// Where the blocks are.
    pub poses: Vec<SavedPose>,
    /// Of the verdict or the load factor of the scene there.
    pub certificate: Arc<Certificate>,
    /// Of a load factor with dry friction: of its bound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<Arc<Certificate>>,
    /// Forces that the motion has here where those of the certificate are others: friction that is
    /// used up leaves no room for an exact proof.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<ContactForces>,
}

/// Of `kinematic`.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KinematicEvidence {
    /// One a direction of the question, in its order.
    pub directions: Vec<FactorEvidence>,
    /// Of the scene without an earthquake.
    pub dead: Option<Standing>,
    /// The point whose displacement the curve of the worst direction shows.
    pub control: Option<Control>,
    /// The curve.
    pub curve: Option<PathEvidence>,
    /// The curve with members.
    pub curve_with_members: Option<PathEvidence>,
    /// How the worst α0 changes with numbers for which that was asked again. Computed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sided: Vec<Sided>,
}

/// Of `stages`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StagesEvidence {
    /// The order that was found. Computed, but for what is proved of its stages.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub order: Option<Order>,
    /// One a stage.
    pub stages: Vec<StageEvidence>,
}

/// Of a stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageEvidence {
    /// Of its verdict.
    pub standing: Standing,
    /// Of the load factor of its live load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limit: Option<FactorEvidence>,
    /// Of its tilts, one a direction of the question.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tilts: Vec<FactorEvidence>,
    /// Of the least forces on what it holds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub least_forces: Vec<HeldEvidence>,
}

/// Of the least force on what is held.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeldEvidence {
    /// The block that is held.
    pub block: String,
    /// Unit direction: down, or outwards.
    pub direction: [f64; 3],
    /// Of the force.
    pub certificate: Arc<Certificate>,
}

/// Of `state`.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StateEvidence {
    /// Where joints yield, where that is not as the question has it: over an area the search took too
    /// long, or found nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quadrature: Option<Quadrature>,
    /// The states, the dead load first.
    pub steps: Vec<StepEvidence>,
    /// How the path along the live load ended.
    pub end: PathEnd,
    /// Of the bound on the live load.
    pub bound: Option<FactorEvidence>,
    /// Without a state: of the verdict.
    pub standing: Option<Standing>,
}

/// A state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepEvidence {
    /// The load factor.
    pub load_factor: f64,
    /// Displacements of the free blocks.
    pub displacements: Vec<super::state::Displacement>,
}

/// Of `rock`: of the load factors towards the direction and against it, and what was computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockEvidence {
    /// Towards the direction.
    pub towards: Arc<Certificate>,
    /// Against it.
    pub against: Arc<Certificate>,
    /// The machine and its history. Computed.
    pub history: Box<RockingAnswer>,
}

/// Of `simulate`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SimulateEvidence {
    /// What was seen. Computed.
    pub seen: Box<Seen>,
    /// Of the verdict, where it was asked as well.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub standing: Option<Standing>,
}

/// A question with what was not said written out, and the evidence for its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NestedEvidence {
    /// The question.
    pub question: Question,
    /// The evidence.
    pub evidence: Evidence,
}

fn is_unknown(ends: &[Option<f64>; 2]) -> bool {
    *ends == [None; 2]
}
