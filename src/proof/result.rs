//! The result file (`"format": "voussoir-result/2"`): the question, the answer and its evidence,
//! complete enough to be verified from the scene: what is proved without a solver, states under dry
//! friction by computing them again.

use super::{
    answer::{Answer, Bound, LimitAnswer, LoadFactorAnswer, TiltAnswer, VerdictAnswer},
    critical::CriticalResult,
    member::{MemberLine, MemberWords, lines},
    simulation::Simulation,
    thrust::ThrustResult,
    work::Work,
};
use crate::{
    analysis::{
        Answer as Answered, Assessment, Attempt, Claims, Deciding, Law, Limited, Outcome, Proved,
        Tilt, Tilted, agreement, coulomb,
    },
    dynamics::SimulationOutcome as Simulated,
    error::Finding,
    interface::{Model, Timings},
    scene::Scene,
    verdict::{
        Evidence, Verdict,
        check::Claim,
        evidence::{
            BlockRate, ContactForces, MemberForce, write_forces, write_members, write_rates,
        },
        mechanism::{JointMotion, Mechanism},
    },
};
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
    /// The answer to the question; of a tilt in several directions, the least.
    pub answer: Answer,
    /// The evidence for `answer`.
    pub certificate: Certificate,
    /// Tilt: every direction asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub directions: Vec<Direction>,
    /// Limit and tilt, where asked as well: whether it stands under its dead load alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dead_load: Option<Direction>,
    /// Limit, and the least direction of a tilt: the load factor with dry friction.
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
    /// What happened in time, where it was simulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub simulation: Option<Simulation>,
    /// The mechanism in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mechanism: Option<MechanismWords>,
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

/// What was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum QuestionKind {
    /// Does it stand?
    Assess,
    /// How large may the live load grow?
    Limit,
    /// At what tilt does it fall?
    Tilt,
    /// At what value of a number in the scene does the verdict flip?
    Critical,
    /// How hard does it push a support?
    Thrust,
    /// What happens in time, and does it agree with the verdict?
    Simulate,
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

/// The evidence for an answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// What is claimed; absent where the question stayed undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub claim: Option<Claim>,
    /// Static side: forces per contact.
    pub forces: Vec<ContactForces>,
    /// The same for members: ties, struts, soil, …
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberForce>,
    /// Unbounded: forces at a load factor at which the scene stands. Conditional: the forces
    /// without the pre-stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<Vec<ContactForces>>,
    /// The same for members.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub base_members: Vec<MemberForce>,
    /// Kinematic side: rates per moving block.
    pub rates: Vec<BlockRate>,
    /// What the verification found when the answer was given. Not saved, for nobody could tell
    /// whether it was edited: `check` finds it anew.
    #[serde(default, skip_serializing)]
    pub verified: Vec<String>,
}

/// An answer beside the main one, with the evidence for it: one direction of a tilt, or the dead
/// load alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Direction {
    /// The answer.
    pub answer: Answer,
    /// The evidence for it.
    pub certificate: Certificate,
    /// A direction of a tilt: its load factor with dry friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry: Option<DryResult>,
}

impl Direction {
    /// The tilt that counts, degrees: with dry friction where that is known, else the bound. A
    /// direction without an answer governs: it must not hide behind the others.
    pub(super) fn governing(&self) -> f64 {
        if self.dry.as_ref().is_some_and(|d| d.found == coulomb::Found::NotAtRest) {
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
    pub motion: coulomb::StateMotion,
    /// The continuation in ε.
    pub steps: Vec<coulomb::StateStep>,
}

/// A load factor with dry friction (program D).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryResult {
    /// How it was found.
    pub found: coulomb::Found,
    /// The part of the scene that decides, where it has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Deciding>,
    /// The value, where found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// The greatest load factor at which the state under dry friction was seen at rest, having
    /// rested from the dead load on. Computed, not proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rests_at: Option<f64>,
    /// The least load factor at which it was seen to move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moves_at: Option<f64>,
    /// How far forces and mechanism are from Coulomb's law.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub natural_map: Option<f64>,
    /// Convex programs solved for it.
    pub solves: usize,
    /// The evidence.
    pub certificate: Certificate,
}

impl DryResult {
    /// Whether the state was seen at rest just below the value.
    pub fn is_reached(&self) -> bool {
        self.rests_at
            .zip(self.value)
            .is_some_and(|(rests_at, value)| coulomb::is_reached(rests_at, value))
    }
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

impl Certificate {
    /// Nothing is claimed.
    pub fn none() -> Self {
        Self {
            claim: None,
            forces: Vec::new(),
            members: Vec::new(),
            base: None,
            base_members: Vec::new(),
            rates: Vec::new(),
            verified: Vec::new(),
        }
    }
}

/// Packs a proof.
pub fn certificate<T: Claims>(model: &Model, proved: &Proved<T>) -> Certificate {
    let Evidence { forces, base, rates } = proved.evidence();
    Certificate {
        claim: proved.claim(),
        forces: write_forces(model, forces),
        members: write_members(model, forces),
        base: base.map(|f| write_forces(model, f)),
        base_members: base.map_or_else(Vec::new, |f| write_members(model, f)),
        rates: write_rates(&model.assembly, rates),
        verified: proved.findings().holds.clone(),
    }
}

impl ResultFile {
    pub(super) fn new(
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
            simulation: None,
            mechanism: None,
            members: Vec::new(),
            left_out: Vec::new(),
            warnings: model.findings().cloned().collect(),
            timings: model.timings,
            work: None,
            trace: Vec::new(),
            versions: Versions::default(),
        }
    }

    /// The result of a question; packings have one of their own
    /// ([`PackingFile`](super::PackingFile)).
    pub fn of(scene: &Scene, model: &Model, answer: &Answered) -> Option<Self> {
        Some(match answer {
            Answered::Assess(a) => Self::assessment(scene, model, a),
            Answered::Limit(l) => Self::load_factor(scene, model, l),
            Answered::Tilt(t) => return Self::tilt(scene, model, t),
            Answered::Critical(c) => Self::critical(scene, model, c),
            Answered::Thrust(t) => Self::thrust(scene, model, t),
            Answered::Simulate(outcome) => Self::simulated(scene, model, None, outcome),
            Answered::Repose(_) => return None,
        })
    }

    /// The result of `assess`. What its check refused is undecided, and the reasons are warnings.
    pub fn assessment(scene: &Scene, model: &Model, a: &Proved<Assessment>) -> Self {
        let mut file = Self::new(
            QuestionKind::Assess,
            scene,
            model,
            Answer::Verdict(assessment(a)),
            certificate(model, a),
        );
        file.mechanism = a.mechanism.as_ref().map(|m| words(model, m));
        file.members = lines(model, a.evidence().forces);
        file.coulomb_state =
            a.state.as_ref().map(|s| CoulombState { motion: s.motion, steps: s.steps.clone() });
        file.left_out.clone_from(&a.left_out);
        file.trace.clone_from(&a.attempts);
        file.warn(a);
        file
    }

    /// The result of `limit`.
    pub fn load_factor(scene: &Scene, model: &Model, limited: &Limited) -> Self {
        let l = &limited.bound;
        let dry = limited.dry.as_ref().map(|dry| dry_result(model, dry));
        let answer = LimitAnswer {
            load_factor: LoadFactorAnswer::new(Bound::of(l), dry.as_ref()),
            verdict: limited.dead.as_ref().map(|a| a.verdict),
            part: l.part.clone(),
            proof: l.grade(),
        };
        let mut file = Self::new(
            QuestionKind::Limit,
            scene,
            model,
            Answer::Limit(answer),
            certificate(model, l),
        );
        file.mechanism = l.mechanism.as_ref().map(|m| words(model, m));
        file.members = lines(model, l.evidence().forces);
        file.left_out.clone_from(&l.left_out);
        file.trace.clone_from(&l.attempts);
        file.warn(l);
        if let Some(dead) = &limited.dead {
            file = file.with_dead_load(model, dead);
        }
        limited.dry.iter().for_each(|dry| file.warn(dry));
        file.dry = dry;
        file
    }

    /// The result of `tilt`, one entry per direction; `model` is the scene level. The least tilt is
    /// the answer.
    pub fn tilt(scene: &Scene, model: &Model, tilted: &Tilted) -> Option<Self> {
        let list = &tilted.directions;
        let level = tilted.level.as_ref().map(|a| a.verdict);
        let directions: Vec<Direction> = list.iter().map(|tilt| direction(tilt, level)).collect();
        let least = (0..directions.len())
            .min_by(|&i, &j| directions[i].governing().total_cmp(&directions[j].governing()))?;
        let (tilt, direction) = (&list[least], directions[least].clone());
        let mut file = Self::new(
            QuestionKind::Tilt,
            scene,
            &tilt.model,
            direction.answer,
            direction.certificate,
        );
        file.dry = direction.dry;
        file.mechanism = tilt.load_factor.mechanism.as_ref().map(|m| words(&tilt.model, m));
        file.members = lines(&tilt.model, tilt.load_factor.evidence().forces);
        file.left_out.clone_from(&tilt.load_factor.left_out);
        file.trace = list.iter().flat_map(|t| t.load_factor.attempts.iter().cloned()).collect();
        if directions.len() > 1 {
            file.directions = directions;
        }
        for tilt in list {
            file.warn(&tilt.load_factor);
            tilt.dry.iter().for_each(|dry| file.warn(&dry.load_factor));
        }
        Some(match &tilted.level {
            Some(level) => file.with_dead_load(model, level),
            None => file,
        })
    }

    /// Adds whether it stands under its dead load alone to a result of `limit`, `tilt` or `thrust`.
    #[must_use]
    pub(super) fn with_dead_load(mut self, model: &Model, a: &Proved<Assessment>) -> Self {
        self.dead_load = Some(Direction {
            answer: Answer::Verdict(assessment(a)),
            certificate: certificate(model, a),
            dry: None,
        });
        self.trace.extend(a.attempts.iter().cloned());
        self.warn(a);
        self
    }

    /// The result of `simulate`, beside the verdict where there is one.
    pub fn simulated(
        scene: &Scene,
        model: &Model,
        a: Option<&Proved<Assessment>>,
        outcome: &Simulated,
    ) -> Self {
        let answer = Answer::Simulation(outcome.fate, a.map(assessment));
        let file = match a {
            Some(a) => Self {
                question: QuestionKind::Simulate,
                answer,
                ..Self::assessment(scene, model, a)
            },
            None => Self::new(QuestionKind::Simulate, scene, model, answer, Certificate::none()),
        };
        file.with_simulation(model, a, outcome)
    }

    /// Adds what happened in time to a result of `assess`.
    #[must_use]
    pub fn with_simulation(
        mut self,
        model: &Model,
        a: Option<&Proved<Assessment>>,
        outcome: &Simulated,
    ) -> Self {
        let agreement = a.map(|a| agreement(model, a, outcome));
        self.warnings.extend(outcome.findings.iter().cloned());
        self.simulation = Some(Simulation::new(model, outcome, agreement));
        self
    }

    /// Takes over what the check of an answer took, and why it took the answer back.
    pub(super) fn warn<T>(&mut self, proved: &Proved<T>) {
        self.timings.check += proved.seconds();
        let code = crate::error::FindingCode::Numerics;
        self.warnings.extend(
            proved
                .findings()
                .fails
                .iter()
                .map(|f| Finding::new(code, format!("certificate refused: {f}"))),
        );
    }
}

/// One direction of a tilt; `level` is the verdict at level, where it was asked.
fn direction(tilt: &Tilt, level: Option<Verdict>) -> Direction {
    let dry = tilt.dry.as_ref().map(|d| dry_result(&d.model, &d.load_factor));
    let tan_tilt = LoadFactorAnswer::new(Bound::of(&tilt.load_factor), dry.as_ref());
    let answer = TiltAnswer {
        toward: tilt.toward.into(),
        tan_tilt,
        tilt_deg: tan_tilt.degrees(),
        verdict: level,
        part: tilt.load_factor.part.clone(),
        proof: tilt.load_factor.grade(),
    };
    Direction {
        answer: Answer::Tilt(answer),
        certificate: certificate(&tilt.model, &tilt.load_factor),
        dry,
    }
}

fn is_zero(n: &usize) -> bool {
    *n == 0
}

fn finite(v: f64) -> Option<f64> {
    v.is_finite().then_some(v)
}

fn dry_result(model: &Model, d: &Proved<coulomb::DryLoadFactor>) -> DryResult {
    DryResult {
        found: d.found,
        value: finite(d.value),
        rests_at: finite(d.rests_at),
        moves_at: finite(d.moves_at),
        part: d.part.clone(),
        natural_map: finite(d.natural_map),
        solves: d.solves,
        certificate: certificate(model, d),
    }
}

pub(super) fn assessment(a: &Proved<Assessment>) -> VerdictAnswer {
    let law = (a.verdict == Verdict::Stable).then_some(if a.rests_on_statics() {
        Law::Associative
    } else {
        Law::Coulomb
    });
    VerdictAnswer {
        verdict: a.verdict,
        law,
        unbalance: a.unbalance,
        part: a.part.clone(),
        proof: a.grade(),
    }
}

pub(super) fn words(model: &Model, m: &Mechanism) -> MechanismWords {
    let id = |i: usize| model.assembly.blocks[i].id.clone();
    MechanismWords {
        moving: m.moving.iter().map(|&i| id(i)).collect(),
        joints: m
            .joints
            .iter()
            .map(|j| {
                let face = &model.interfaces.list[j.interface];
                JointWords { between: [id(face.a), id(face.b)], motion: j.motion, at: j.at.into() }
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

/// The JSON Schema (draft 2020-12) of a result file.
pub fn schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(ResultFile);
    schema.insert("title".into(), "voussoir result, version 2".into());
    schema.to_value()
}
