//! What is told of a result: all of it follows from question, scene and evidence ([`derive`]), and
//! is never read from a file.
//!
//! [`derive`]: super::derive::derive

use super::{
    answer::{Answer, Required},
    certificate::{Certificate, DryResult},
    critical::CriticalResult,
    member::{MemberLine, MemberWords},
    path::PathResult,
    simulation::Simulation,
    stages::StagesResult,
    thrust::ThrustResult,
};
use crate::{
    terms::{Found, LeftOutContacts, Outcome, Sensitivity, StateMotion},
    verdict::mechanism::{JointMotion, Mechanism},
};
use base::error::Finding;
use model::interface::Model;
use schemars::JsonSchema;
use serde::Serialize;
use serde_with::skip_serializing_none;
use std::sync::Arc;

/// What is told: the answer, and what stands beside it.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Told {
    /// The answer to the question; of a tilt in several directions, of a train on its way the least.
    #[serde(flatten)]
    pub answer: Answer,
    /// The evidence for it.
    #[serde(skip)]
    pub certificate: Arc<Certificate>,
    /// Tilt and kinematic: every direction asked for. Moving: every position of the train.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub directions: Vec<Direction>,
    /// Whether it stands under its dead load alone, where that was asked as well.
    pub dead_load: Option<Direction>,
    /// The load factor with dry friction.
    pub dry: Option<DryResult>,
    /// How the value changes with the numbers that were assumed, where that was asked.
    pub sensitivity: Option<Sensitivity>,
    /// What the state under dry friction does, where it was computed.
    #[serde(rename = "state_under_dry_friction")]
    pub motion: Option<StateMotion>,
    /// Critical: the scan and both sides of every flip.
    #[serde(rename = "search")]
    pub critical: Option<CriticalResult>,
    /// Thrust: the line of thrust.
    #[serde(rename = "line_of_thrust")]
    pub thrust: Option<ThrustResult>,
    /// Settle, push and kinematic: the curve.
    #[serde(rename = "curve")]
    pub path: Option<PathResult>,
    /// Kinematic: the curve with members.
    #[serde(rename = "curve_with_members")]
    pub path_with_members: Option<PathResult>,
    /// Stages: every one.
    #[serde(rename = "each_stage")]
    pub stages: Option<StagesResult>,
    /// State: the bound on the live load.
    pub bound: Option<Direction>,
    /// Rock: the evidence against the direction.
    #[serde(skip)]
    pub against: Option<Arc<Certificate>>,
    /// What happened in time, where it was simulated.
    pub simulation: Option<Simulation>,
    /// The mechanism in words.
    pub mechanism: Option<MechanismWords>,
    /// The forces in the members of the scene, of the forces that prove the answer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberLine>,
    /// Contacts that were left out although blocks overlap or nearly touch, where there are such, and
    /// the answer with them closed.
    pub left_out_contacts: Option<LeftOutContacts>,
    /// Edges and corners that meet others with several normals: those across whose flat the forces
    /// of the answer act; all where it is undecided.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub flattened: Vec<[String; 2]>,
    /// Of a scene that stands: blocks that touch others along one line or at one point below them,
    /// and so stand only as long as nothing pushes them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub in_balance: Vec<String>,
    /// What was required of the answer, and whether it is met.
    pub required: Option<Required>,
    /// What is to be known about the scene.
    #[serde(rename = "warnings", default, skip_serializing_if = "Vec::is_empty")]
    pub scene_warnings: Vec<Finding>,
    /// How much there is of it.
    pub counts: Counts,
}

/// How much there is of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Counts {
    /// Number of blocks, supports included.
    pub blocks: usize,
    /// Number of supports.
    pub supports: usize,
    /// Number of interfaces.
    pub interfaces: usize,
    /// Number of contact points.
    pub contact_points: usize,
    /// Number of members: ties, struts, soil, …
    #[serde(default, skip_serializing_if = "is_zero")]
    pub members: usize,
}

impl Counts {
    /// Those of a model.
    pub fn of(model: &Model) -> Self {
        Self {
            blocks: model.assembly.blocks.len(),
            supports: model.assembly.blocks.iter().filter(|b| b.support).count(),
            interfaces: model.interfaces.list.len(),
            contact_points: model.contact_points(),
            members: model.interfaces.members.len(),
        }
    }
}

impl Told {
    /// An answer about a model, and nothing else yet.
    pub(super) fn new(model: &Model, answer: Answer, certificate: &Arc<Certificate>) -> Self {
        Self {
            answer,
            certificate: certificate.clone(),
            directions: Vec::new(),
            dead_load: None,
            dry: None,
            sensitivity: None,
            motion: None,
            critical: None,
            thrust: None,
            path: None,
            path_with_members: None,
            stages: None,
            bound: None,
            against: None,
            simulation: None,
            mechanism: None,
            members: Vec::new(),
            left_out_contacts: None,
            flattened: Vec::new(),
            in_balance: Vec::new(),
            required: None,
            scene_warnings: Vec::new(),
            counts: Counts::of(model),
        }
    }
}

/// An answer beside the main one, with the evidence for it: one direction of a tilt, one position of
/// a train, or the dead load alone.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Direction {
    /// The answer.
    pub answer: Answer,
    /// The evidence for it.
    #[serde(skip)]
    pub certificate: Arc<Certificate>,
    /// A direction of a tilt or an earthquake, a position of a train: its load factor with dry friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry: Option<DryResult>,
}

impl Direction {
    /// The tilt that counts, degrees: with dry friction where that was asked, up to where it was seen
    /// at rest where no value was found; else the bound. A direction without an answer governs: it
    /// must not hide behind the others.
    pub fn governing(&self) -> f64 {
        let degrees = |v: f64| v.atan().to_degrees();
        let bound = || {
            self.answer.bound().and_then(|b| match b.status {
                Outcome::Unbounded => Some(90.0),
                _ => b.value.map(degrees),
            })
        };
        let known = match &self.dry {
            None => bound(),
            Some(d) => match d.found {
                Found::NotAtRest => None,
                Found::Unlimited => Some(90.0),
                _ => d.value.or(d.rests_at).map(degrees),
            },
        };
        known.unwrap_or(f64::NEG_INFINITY)
    }
}

/// A mechanism with names.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MechanismWords {
    /// Moving blocks, the fastest first.
    pub moving: Vec<String>,
    /// Moving joints.
    pub joints: Vec<JointWords>,
    /// Members that yield, go slack or slide.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberWords>,
}

/// A joint of a mechanism with names.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct JointWords {
    /// The blocks.
    pub between: [String; 2],
    /// What it does.
    pub motion: JointMotion,
    /// Where, m.
    pub at: [f64; 3],
}

impl MechanismWords {
    /// The words for a mechanism.
    pub fn new(model: &Model, m: &Mechanism) -> Self {
        let id = |i: usize| model.assembly.blocks[i].id.clone();
        Self {
            moving: m.moving.iter().map(|&i| id(i)).collect(),
            joints: m
                .joints
                .iter()
                .map(|j| {
                    let face = &model.interfaces.list[j.interface];
                    JointWords {
                        between: [id(face.a), id(face.b)],
                        motion: j.motion,
                        at: j.at.into(),
                    }
                })
                .collect(),
            members: m
                .members
                .iter()
                .map(|m| MemberWords {
                    member: model.interfaces.members[m.member].id.clone(),
                    motion: m.motion,
                })
                .collect(),
        }
    }
}

fn is_zero(n: &usize) -> bool {
    *n == 0
}
