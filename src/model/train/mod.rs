//! Trains on bridges: where their axles may stand, and the scene under them.
//!
//! A position is a place of the train's origin on its way and a direction of travel. Towards +x an
//! axle stands at `x + at`, towards −x the train is turned round and it stands at `x − at`. The
//! forces of all axles that press on a span, spread by the fill, are the live load of the scene
//! there; live loads of its own are left out. Blocks, joints, dead loads and members are the same
//! everywhere.

use crate::{
    assembly::{AppliedForce, Wrench},
    interface::Model,
};
use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use scene::{At, Axle, AxleForce, LIVE, OnRoad, Scene, Train, generate::Road};
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

/// The spans of the bridges of a scene from left to right: both springings of each, x, m.
pub fn spans(scene: &Scene) -> Vec<[f64; 2]> {
    let roads = scene.templates.iter().filter_map(Road::of);
    let mut list: Vec<[f64; 2]> = roads.flat_map(|r| r.spans().collect::<Vec<_>>()).collect();
    list.sort_by(|a, b| a[0].total_cmp(&b[0]));
    list
}

/// The spans at neither quarter point of which any axle of the train ever stands, by their number from
/// 1, with their springings: a worse position may lie there. One of the two is enough where bridge and
/// train are symmetric.
pub fn not_crossed(scene: &Scene) -> Vec<(usize, [f64; 2])> {
    let Some(train) = &scene.train else { return Vec::new() };
    let [from, to] = train.path;
    let crosses = |[left, right]: [f64; 2]| {
        let quarters = [0.25, 0.75].map(|share| left + share * (right - left));
        let signs = travels(train).iter().map(|t| t.sign());
        let mut ways = signs.flat_map(|sign| train.axles.iter().map(move |a| sign * a.at));
        ways.any(|at| quarters.iter().any(|x| (from + at..=to + at).contains(x)))
    };
    let list = spans(scene).into_iter().enumerate();
    list.filter(|(_, span)| !crosses(*span)).map(|(k, span)| (k + 1, span)).collect()
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

/// The way of the train of a scene, with all that no position changes made ready once: the roads
/// and what lies below them.
pub struct Way<'a> {
    train: &'a Train,
    model: &'a Model,
    roads: Vec<Road>,
    down: Vector3<f64>,
    /// Partial factor of its action.
    factor: f64,
}

impl<'a> Way<'a> {
    /// Nothing where the scene has no train. `model` is the scene as prepared.
    pub fn of(scene: &'a Scene, model: &'a Model) -> Option<Self> {
        let train = scene.train.as_ref()?;
        let roads = scene.templates.iter().filter_map(Road::of).collect();
        // A scene that was prepared has factors.
        let factor = scene.factors().ok()?.of(train.action.as_deref(), LIVE);
        Some(Self { train, model, roads, down: model.assembly.gravity.normalize(), factor })
    }

    /// The scene with its train at a position; nothing where no axle presses on a block that may
    /// move.
    ///
    /// # Errors
    /// A road lies on a block that the model does not have.
    pub fn at(&self, position: Position) -> Result<Option<Loaded>, InputError> {
        let assembly = &self.model.assembly;
        let mut live = vec![Wrench::zero(); assembly.blocks.len()];
        let mut live_forces = Vec::new();
        let mut axles = Vec::new();
        for (k, axle) in self.train.axles.iter().enumerate() {
            let x = position.x + position.travel.sign() * axle.at;
            let on = OnRoad { x, patch: axle.patch, across: axle.across };
            let whole = force(axle, &self.down) * self.factor;
            let push = (self.down * whole).into();
            let Some(spread) = self.roads.iter().find_map(|r| r.under(on, push)) else { continue };
            for load in &spread.loads {
                // All three are there: so a road makes its loads.
                let (Some(id), Some(force), Some(At::Point(p))) =
                    (load.block.as_deref(), load.force.map(Vector3::from), load.at)
                else {
                    continue;
                };
                let block = assembly.find(id).ok_or_else(|| missing(k, x, id))?;
                let arm = Vector3::from(p) - assembly.blocks[block].centroid;
                live[block] += Wrench { force, moment: arm.cross(&force) };
                live_forces.push(AppliedForce { block, force, arm });
            }
            axles.push(Standing { axle: k, x, force: whole, share: 1.0 - spread.beside });
        }
        if live.iter().all(|w| *w == Wrench::zero()) {
            return Ok(None);
        }
        let mut model = self.model.clone();
        (model.assembly.live, model.assembly.live_forces) = (live, live_forces);
        Ok(Some(Loaded { model, axles }))
    }
}

/// A road on a block that is not there: the position must not pass for one without a load.
fn missing(axle: usize, x: f64, id: &str) -> InputError {
    let path = JsonPath::root().key("train").key("axles").index(axle);
    let text = format!("at x = {x} the train stands on block {id:?} of the road, which is missing");
    InputError::at(path, text).hint(
        "use the whole scene with all blocks of its bridge, or end the path before that block",
    )
}
