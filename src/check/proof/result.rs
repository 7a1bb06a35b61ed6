//! The result file (`"format": "voussoir-result/2"`): the question, the answer and its evidence,
//! complete enough to be verified from the scene: what is proved without a solver, states under dry
//! friction by computing them again.

use super::{
    answer::Answer,
    certificate::{Certificate, DryResult},
    critical::CriticalResult,
    member::{MemberLine, MemberWords},
    path::PathResult,
    rocking::RockingResult,
    shaken::ShakenResult,
    simulation::Simulation,
    stages::StagesResult,
    state::StateResult,
    thrust::ThrustResult,
    work::Work,
};
use crate::{
    terms::{Attempt, Doubt, Found, LeftOutContacts, Outcome, StateMotion, StateStep},
    verdict::mechanism::{JointMotion, Mechanism},
};
use base::error::Finding;
use model::interface::{Model, Timings};
use scene::Scene;
use serde::{Deserialize, Serialize};

/// The version of the format.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema,
)]
pub enum ResultFormat {
    /// Version 2.
    #[default]
    #[serde(rename = "voussoir-result/2")]
    V2,
}

/// A saved answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResultFile {
    /// The format and its version.
    pub format: ResultFormat,
    /// What was asked.
    pub question: QuestionKind,
    /// The scene.
    pub scene: SceneSummary,
    /// The answer to the question; of a tilt in several directions, of a train on its way the least.
    pub answer: Answer,
    /// The evidence for `answer`.
    pub certificate: Certificate,
    /// Tilt and kinematic: every direction asked for. Moving: every position of the train.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub directions: Vec<Direction>,
    /// Limit, moving, tilt and kinematic, where asked as well: whether it stands under its dead load alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dead_load: Option<Direction>,
    /// Limit, the least position of a train, the least direction of a tilt and the worst of
    /// `kinematic`: the load factor with dry friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry: Option<DryResult>,
    /// The state under dry friction, where it had to be computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coulomb_state: Option<CoulombState>,
    /// Critical: the flips with the verdicts on both sides of each.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub critical: Option<CriticalResult>,
    /// Thrust: the evidence for both ends and the line of thrust.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thrust: Option<ThrustResult>,
    /// Settle, push and kinematic: the curve, every point with its evidence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<PathResult>,
    /// Kinematic: the curve with members, every point with its evidence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path_with_members: Option<PathResult>,
    /// Stages: every one with its evidence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stages: Option<StagesResult>,
    /// State: displacements, from which everything follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<StateResult>,
    /// Rock: the evidence against the direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rocking: Option<RockingResult>,
    /// Shake: where every block was, where times were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shaken: Option<ShakenResult>,
    /// What happened in time, where it was simulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub simulation: Option<Simulation>,
    /// The mechanism in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mechanism: Option<MechanismWords>,
    /// Contacts that were left out although blocks overlap or nearly touch, where there are such, and
    /// the answer with them closed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left_out_contacts: Option<LeftOutContacts>,
    /// Why the answer is undecided, where it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<Doubt>,
    /// The forces in the members of the scene, of the forces that prove the answer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberLine>,
    /// What the scene did not need.
    pub left_out: Vec<String>,
    /// What the user should know.
    pub warnings: Vec<Finding>,
    /// Seconds per stage.
    pub timings: Timings,
    /// What it cost, beside the seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub work: Option<Work>,
    /// Every attempt at a program.
    pub trace: Vec<Attempt>,
    /// Versions.
    pub versions: Versions,
}

impl ResultFile {
    /// The result as a JSON value. Written here once, so that no other crate writes it again for
    /// itself.
    ///
    /// # Errors
    /// None that a result can bring about.
    pub fn to_value(&self) -> Result<serde_json::Value, serde_json::Error> {
        serde_json::to_value(self)
    }

    /// A result that holds an answer with its evidence, and nothing else yet.
    pub fn new(
        question: QuestionKind,
        scene: &Scene,
        model: &Model,
        answer: Answer,
        certificate: Certificate,
    ) -> Self {
        Self {
            format: ResultFormat::V2,
            question,
            scene: SceneSummary {
                name: scene.name.clone(),
                blocks: model.assembly.blocks.len(),
                supports: model.assembly.blocks.iter().filter(|b| b.support).count(),
                interfaces: model.interfaces.list.len(),
                contact_points: model.contact_points(),
                members: model.interfaces.members.len(),
                input: scene.clone(),
            },
            answer,
            certificate,
            directions: Vec::new(),
            dead_load: None,
            dry: None,
            coulomb_state: None,
            critical: None,
            thrust: None,
            path: None,
            path_with_members: None,
            stages: None,
            state: None,
            rocking: None,
            shaken: None,
            simulation: None,
            mechanism: None,
            members: Vec::new(),
            left_out_contacts: model
                .interfaces
                .left_out
                .map(|contacts| LeftOutContacts { contacts, closed: None }),
            doubt: None,
            left_out: Vec::new(),
            warnings: model.findings().cloned().collect(),
            timings: model.timings,
            work: None,
            trace: Vec::new(),
            versions: Versions::default(),
        }
    }
}

/// What was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum QuestionKind {
    /// Does it stand?
    Assess,
    /// How large may the live load grow?
    Limit,
    /// How heavy may the train be that drives over it?
    Moving,
    /// At what tilt does it fall?
    Tilt,
    /// At what value of a number in the scene does the verdict flip?
    Critical,
    /// How hard does it push a support?
    Thrust,
    /// What happens in time, and does it agree with the verdict?
    Simulate,
    /// How far may supports move until it falls?
    Settle,
    /// How does the load factor fall as it moves?
    Push,
    /// Under an earthquake: at what acceleration does it start to move, and what then?
    Kinematic,
    /// Does every stage of its construction stand?
    Stages,
    /// What follows from the stiffness of its joints?
    State,
    /// What does its mechanism do on ground that moves?
    Rock,
    /// What do all its blocks do on ground that moves?
    Shake,
}

/// The scene a result is about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneSummary {
    /// Its name.
    pub name: String,
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
    /// The scene itself, so that the result can be verified on its own.
    pub input: Scene,
}

/// An answer beside the main one, with the evidence for it: one direction of a tilt, one position of
/// a train, or the dead load alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Direction {
    /// The answer.
    pub answer: Answer,
    /// The evidence for it.
    pub certificate: Certificate,
    /// A direction of a tilt or an earthquake, a position of a train: its load factor with dry friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry: Option<DryResult>,
}

impl Direction {
    /// The tilt that counts, degrees: with dry friction where that is known, else the bound. A
    /// direction without an answer governs: it must not hide behind the others.
    pub fn governing(&self) -> f64 {
        if self.dry.as_ref().is_some_and(|d| d.found == Found::NotAtRest) {
            return f64::NEG_INFINITY;
        }
        let dry = self.dry.as_ref().and_then(|d| d.value).map(|v| v.atan().to_degrees());
        let bound = self.answer.bound().and_then(|b| match b.status {
            Outcome::Unbounded => Some(90.0),
            _ => b.value.map(|v| v.atan().to_degrees()),
        });
        dry.or(bound).unwrap_or(f64::NEG_INFINITY)
    }
}

/// The state under dry friction (program C). Where it rests it is computed, not proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CoulombState {
    /// What it does.
    pub motion: StateMotion,
    /// The continuation in ε.
    pub steps: Vec<StateStep>,
}

/// A mechanism with names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointWords {
    /// The blocks.
    pub between: [String; 2],
    /// What it does.
    pub motion: JointMotion,
    /// Where, m.
    pub at: [f64; 3],
}

/// Versions of what made a result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Versions {
    /// This program.
    pub voussoir: String,
}

impl Default for Versions {
    fn default() -> Self {
        Self { voussoir: env!("CARGO_PKG_VERSION").to_string() }
    }
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

/// The JSON Schema (draft 2020-12) of a result file.
pub fn schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(ResultFile);
    schema.insert("title".into(), "voussoir result, version 2".into());
    schema.to_value()
}
