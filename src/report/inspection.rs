//! A scene as it was resolved (`"format": "voussoir-model/1"`): blocks with their loads, interfaces
//! with their contact points and frames. Everything another program needs to ask its own questions
//! about the very same contacts.
//!
//! Loads are forces (N) and moments (N·m) about the centre of mass. The frame `(t1, t2, n)` is
//! right-handed, `n` points from the first block into the second; contact forces act on the second.
//! Indices count `blocks` from 0.

use base::error::Finding;
use check::verdict::member::legs;
use model::{
    assembly::{Action, JointLaw, Member, MemberKind, Wrench},
    interface::{ContactKind, Model},
};
use scene::{Friction, Scene, Train};
use schemars::{JsonSchema, generate::SchemaSettings};
use serde::Serialize;
use serde_with::skip_serializing_none;

/// The resolved scene.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Inspection<'a> {
    format: &'static str,
    name: &'a str,
    gravity: [f64; 3],
    blocks: Vec<Block<'a>>,
    interfaces: Vec<Contact<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    members: Vec<Joined<'a>>,
    /// The train that `limit --moving` drives over it, as the scene has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    train: Option<&'a Train>,
    findings: Vec<&'a Finding>,
}

#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Block<'a> {
    id: &'a str,
    support: bool,
    mass: f64,
    centroid: [f64; 3],
    dead: Load,
    live: Load,
}

#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Load {
    force: [f64; 3],
    moment: [f64; 3],
}

#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Contact<'a> {
    between: [usize; 2],
    kind: ContactKind,
    t1: [f64; 3],
    t2: [f64; 3],
    n: [f64; 3],
    points: Vec<[f64; 3]>,
    area: f64,
    gap: f64,
    #[serde(flatten)]
    law: Law<'a>,
}

/// A member: its amounts act along these legs, each on the second block and oppositely on the first
/// (the ground where there is none).
#[skip_serializing_none]
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Joined<'a> {
    id: &'a str,
    kind: MemberKind,
    legs: Vec<Pull>,
    least: Option<f64>,
    greatest: Option<f64>,
    friction: Option<f64>,
}

#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Pull {
    amount: usize,
    between: [Option<usize>; 2],
    at: [f64; 3],
    direction: [f64; 3],
}

/// Strengths that a joint does not have are left out.
#[skip_serializing_none]
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Law<'a> {
    friction: &'a Friction,
    cohesion: Option<f64>,
    tension: Option<f64>,
    compression: Option<f64>,
    pore_pressure: Option<f64>,
    rolling_arm: Option<f64>,
    normal_stiffness: Option<f64>,
    shear_stiffness: Option<f64>,
}

impl<'a> Inspection<'a> {
    /// A model as it stands.
    pub fn new(model: &'a Model) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let blocks = assembly.blocks.iter().zip(assembly.dead.iter().zip(&assembly.live)).map(
            |(b, (dead, live))| Block {
                id: &b.id,
                support: b.support,
                mass: b.mass,
                centroid: b.centroid.into(),
                dead: dead.into(),
                live: live.into(),
            },
        );
        let contacts = interfaces.list.iter().map(|face| Contact {
            between: [face.a, face.b],
            kind: face.kind,
            t1: face.frame.t1.into(),
            t2: face.frame.t2.into(),
            n: face.frame.n.into(),
            points: face.points.iter().map(|&p| p.into()).collect(),
            area: face.area,
            gap: face.gap,
            law: (&face.law).into(),
        });
        Self {
            format: "voussoir-model/1",
            name: &assembly.name,
            gravity: assembly.gravity.into(),
            blocks: blocks.collect(),
            interfaces: contacts.collect(),
            members: interfaces.members.iter().map(Into::into).collect(),
            train: None,
            findings: model.findings().collect(),
        }
    }

    /// The same with the train of its scene.
    #[must_use]
    pub fn with_train(self, scene: &'a Scene) -> Self {
        Self { train: scene.train.as_ref(), ..self }
    }
}

impl<'a> From<&'a Member> for Joined<'a> {
    fn from(m: &'a Member) -> Self {
        let legs = legs(m).into_iter().map(|leg| Pull {
            amount: leg.axis,
            between: [leg.a, leg.b],
            at: leg.at.into(),
            direction: leg.direction.into(),
        });
        let finite = |v: f64| v.is_finite().then_some(v);
        let friction = match &m.action {
            Action::Press { friction, .. } => Some(*friction),
            _ => None,
        };
        Self {
            id: &m.id,
            kind: m.kind,
            legs: legs.collect(),
            least: finite(m.least),
            greatest: finite(m.greatest),
            friction,
        }
    }
}

impl From<&Wrench> for Load {
    fn from(w: &Wrench) -> Self {
        Self { force: w.force.into(), moment: w.moment.into() }
    }
}

impl<'a> From<&'a JointLaw> for Law<'a> {
    fn from(law: &'a JointLaw) -> Self {
        let some = |v: f64| (v != 0.0 && v.is_finite()).then_some(v);
        Self {
            friction: &law.friction,
            cohesion: some(law.cohesion),
            tension: some(law.tension),
            compression: law.compression.is_finite().then_some(law.compression),
            pore_pressure: some(law.pore_pressure),
            rolling_arm: some(law.rolling_arm),
            normal_stiffness: law.normal_stiffness,
            shear_stiffness: law.shear_stiffness,
        }
    }
}

/// The JSON Schema (draft 2020-12) of a resolved scene, as it is written.
pub fn schema() -> serde_json::Value {
    let generator = SchemaSettings::draft2020_12().for_serialize().into_generator();
    let mut schema = generator.into_root_schema_for::<Inspection>();
    schema.insert("title".into(), "voussoir resolved scene, version 1".into());
    schema.to_value()
}
