//! Trains on bridges: where their axles may stand, and the scene under them.
//!
//! A position is a place of the train's origin on its way and a direction of travel. Towards +x an
//! axle stands at `x + at`, towards −x the train is turned round and it stands at `x − at`. The
//! forces of all axles that press on a span, spread by the fill, are the live load of the scene
//! there; live loads of its own are left out. Blocks, joints, dead loads and members are the same
//! everywhere.

use crate::{
    assembly::{AppliedForce, Wrench},
    generate,
    interface::Model,
    scene::{At, Axle, AxleForce, OnRoad, Scene, Train},
};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which way a train goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Travel {
    /// Towards +x.
    Forward,
    /// Towards −x, turned round.
    Backward,
}

impl Travel {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Forward => "towards +x",
            Self::Backward => "towards -x",
        }
    }

    /// +1 or −1.
    fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }
}

/// Where a train is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Position {
    /// Which way it goes.
    pub travel: Travel,
    /// Where its origin is, x in the scene, m.
    pub x: f64,
}

/// An axle where it stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Standing {
    /// Its place in the list of axles, from 0.
    pub axle: usize,
    /// Where it stands, x in the scene, m.
    pub x: f64,
    /// Its force, N.
    pub force: f64,
    /// The share of it that presses on the spans; the rest presses beside them and is left out.
    pub share: f64,
}

/// How many steps a way has, the last one shorter where they do not divide it. A thousandth of a step
/// is no step of its own: it is what rounding leaves.
fn steps(train: &Train) -> f64 {
    ((train.path[1] - train.path[0]) / train.step - 1e-3).ceil().max(0.0)
}

/// Whether the train looks the same from both ends, about its own origin: then the other direction of
/// travel has no positions of its own.
pub fn is_symmetric(train: &Train) -> bool {
    let key = |a: &Axle, sign: f64| (a.force, a.patch, a.across, sign * a.at);
    // Every axle as often as its image.
    let count = |wanted: &(AxleForce, f64, Option<f64>, f64)| {
        let of = |sign: f64| train.axles.iter().filter(|a| key(a, sign) == *wanted).count();
        of(1.0) == of(-1.0)
    };
    train.axles.iter().all(|a| count(&key(a, 1.0)))
}

/// The directions of travel that differ.
pub fn travels(train: &Train) -> &'static [Travel] {
    match is_symmetric(train) {
        true => &[Travel::Forward],
        false => &[Travel::Forward, Travel::Backward],
    }
}

/// The positions on the way, step by step, all of one direction of travel before the other.
pub fn positions(train: &Train) -> Vec<Position> {
    let [from, to] = train.path;
    let count = steps(train) as usize;
    let place = |k: usize| if k == count { to } else { from + k as f64 * train.step };
    travels(train)
        .iter()
        .flat_map(|&travel| (0..=count).map(move |k| Position { travel, x: place(k) }))
        .collect()
}

/// The force of an axle along gravity, N; the part of a vector along it.
pub fn force(axle: &Axle, down: &Vector3<f64>) -> f64 {
    match axle.force {
        AxleForce::Down(force) => force,
        AxleForce::Vector(v) => Vector3::from(v).dot(down),
    }
}

/// The scene with a train on it.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene, its live load that of the axles.
    pub model: Model,
    /// The axles that stand on a span, in their order.
    pub axles: Vec<Standing>,
}

/// The scene with its train at a position; nothing where no axle presses on a block that may move.
/// `model` is the scene as prepared.
pub fn at(scene: &Scene, model: &Model, position: Position) -> Option<Loaded> {
    let train = scene.train.as_ref()?;
    let down = model.assembly.gravity.normalize();
    let blocks = &model.assembly.blocks;
    let mut live = vec![Wrench::zero(); blocks.len()];
    let mut live_forces = Vec::new();
    let mut axles = Vec::new();
    for (k, axle) in train.axles.iter().enumerate() {
        let x = position.x + position.travel.sign() * axle.at;
        let on = OnRoad { x, patch: axle.patch, across: axle.across };
        let whole = force(axle, &down);
        let push = (down * whole).into();
        let spread = scene.templates.iter().find_map(|t| generate::on_road(t, on, push));
        let Some(spread) = spread else { continue };
        for load in &spread.loads {
            let block = load.block.as_deref().and_then(|id| model.assembly.find(id))?;
            let (Some(force), Some(At::Point(p))) = (load.force.map(Vector3::from), load.at) else {
                continue;
            };
            let arm = Vector3::from(p) - blocks[block].centroid;
            live[block] += Wrench { force, moment: arm.cross(&force) };
            live_forces.push(AppliedForce { block, force, arm });
        }
        axles.push(Standing { axle: k, x, force: whole, share: 1.0 - spread.beside });
    }
    if live.iter().all(|w| *w == Wrench::zero()) {
        return None;
    }
    let mut model = model.clone();
    (model.assembly.live, model.assembly.live_forces) = (live, live_forces);
    Some(Loaded { model, axles })
}
