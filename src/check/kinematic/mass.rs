//! Which masses an earthquake pushes, and the load that it makes of them.

use crate::verdict::tilted::direction;
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
use model::{
    assembly::{AppliedForce, Wrench},
    interface::Model,
};
use nalgebra::Vector3;
use scene::{At, DEAD, Load, Scene, generate};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a mass is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MassKind {
    /// The block itself.
    Block,
    /// A dead load along gravity: it rests on the block and is pushed (P).
    Rests,
    /// It is pushed against the block and rests elsewhere (Q).
    Pushes,
}

/// A mass that an earthquake pushes.
#[derive(Clone, Debug, PartialEq)]
pub struct Mass {
    /// What it is.
    pub kind: MassKind,
    /// The block that it moves with.
    pub block: usize,
    /// From the block's centre of mass to where it acts, m.
    pub arm: Vector3<f64>,
    /// Its weight, N.
    pub weight: f64,
}

/// A scene under an earthquake towards one direction: the pushes of all masses, each as large as
/// its weight, are the live load, so that the load factor is α; all other loads are dead.
#[derive(Clone, Debug)]
pub struct Quake {
    /// The scene with that live load; live loads of its own are left out.
    pub model: Model,
    /// The masses.
    pub masses: Vec<Mass>,
    /// Unit direction across gravity.
    pub toward: Vector3<f64>,
}

/// The earthquake towards a direction (its part across gravity); `model` is the scene as prepared.
///
/// # Errors
/// The direction is along gravity.
pub fn quake(scene: &Scene, model: &Model, toward: Vector3<f64>) -> Result<Quake, InputError> {
    let down = model.assembly.gravity.normalize();
    let across = toward - down * down.dot(&toward);
    let share = across.norm() / toward.norm();
    if share.is_nan() || share <= tolerance::ALONG {
        return Err(InputError::at(
            JsonPath::root(),
            format!(
                "the direction {:?} of the earthquake is parallel to gravity",
                toward.as_slice()
            ),
        )
        .hint("give a direction across gravity, such as 1,0"));
    }
    let toward = direction(down, toward);
    let masses = masses(scene, model, &down);
    let mut model = model.clone();
    let assembly = &mut model.assembly;
    assembly.live = vec![Wrench::zero(); assembly.blocks.len()];
    assembly.live_forces = Vec::new();
    for &Mass { block, arm, weight, .. } in &masses {
        let force = toward * weight;
        assembly.live[block] += Wrench { force, moment: arm.cross(&force) };
        if arm != Vector3::zeros() {
            assembly.live_forces.push(AppliedForce { block, force, arm });
        }
    }
    Ok(Quake { model, masses, toward })
}

/// The masses of a scene: blocks in their order, then loads, then what is pushed only.
fn masses(scene: &Scene, model: &Model, down: &Vector3<f64>) -> Vec<Mass> {
    let assembly = &model.assembly;
    let own = assembly.free().map(|block| Mass {
        kind: MassKind::Block,
        block,
        arm: Vector3::zeros(),
        weight: assembly.weight(block),
    });
    let mut all: Vec<Mass> = own.collect();
    // A scene that was prepared has factors.
    let factors = scene.factors().unwrap_or_default();
    let act = |load: &Load| factors.load(load, DEAD);
    let dead = scene.loads.dead.iter().filter(|l| !l.massless && l.road.is_none());
    all.extend(dead.filter_map(act).flat_map(|load| rests(&load, model, down)));
    for template in &scene.templates {
        let on_road = scene.loads.dead.iter().filter(|l| !l.massless);
        let on_road = on_road.filter_map(act);
        let spread = on_road.filter_map(|l| generate::on_road(template, l.road?, l.force?));
        let own = generate::loads(template).iter().filter_map(act).collect::<Vec<_>>();
        let loads = own.into_iter().chain(spread.flat_map(|s| s.loads));
        all.extend(loads.flat_map(|load| rests(&load, model, down)));
    }
    all.extend(scene.loads.masses.iter().filter_map(|m| {
        let block = assembly.find(&m.block)?;
        Some(Mass {
            kind: MassKind::Pushes,
            block,
            arm: Vector3::from(m.at) - assembly.blocks[block].centroid,
            weight: m.mass * assembly.gravity.norm(),
        })
    }));
    all.retain(|m| m.weight > 0.0);
    all
}

/// The masses of a dead load: what pulls straight down is a weight, all else comes from elsewhere.
fn rests(load: &Load, model: &Model, down: &Vector3<f64>) -> Vec<Mass> {
    let assembly = &model.assembly;
    let block = load.block.as_deref().and_then(|id| assembly.find(id));
    let on = || block.map_or_else(|| assembly.free().collect(), |i| vec![i]);
    let weight = |force: Vector3<f64>| {
        let along = force.dot(down);
        let straight = (force - down * along).norm() <= tolerance::ALONG * force.norm();
        (straight && along > 0.0).then_some(along)
    };
    let mass = |block: usize, arm: Vector3<f64>, force: Vector3<f64>| {
        weight(force).map(|weight| Mass { kind: MassKind::Rests, block, arm, weight })
    };
    match (load.force, load.acceleration, load.weight) {
        (Some(force), _, _) => block
            .and_then(|i| {
                let arm = match load.at {
                    Some(At::Point(p)) => Vector3::from(p) - assembly.blocks[i].centroid,
                    _ => Vector3::zeros(),
                };
                mass(i, arm, force.into())
            })
            .into_iter()
            .collect(),
        (None, Some(a), _) => {
            let of = |i: usize| {
                mass(i, Vector3::zeros(), Vector3::from(a) * assembly.characteristic_mass(i))
            };
            on().into_iter().filter_map(of).collect()
        }
        (None, None, Some(w)) => {
            let weight = |i: usize| assembly.characteristic_mass(i) * assembly.gravity.norm();
            let of = |i: usize| mass(i, Vector3::zeros(), Vector3::from(w) * weight(i));
            on().into_iter().filter_map(of).collect()
        }
        (None, None, None) => Vec::new(),
    }
}

/// Dead loads that pull down and sideways, as places in the list: no weight, and yet there may be
/// one in them.
pub fn oblique(scene: &Scene, model: &Model) -> Vec<usize> {
    let down = model.assembly.gravity.normalize();
    let pulls = |load: &Load| {
        let force = load.force.or(load.acceleration).or(load.weight).map(Vector3::from);
        force.is_some_and(|f| {
            let along = f.dot(&down);
            along > tolerance::ALONG * f.norm()
                && (f - down * along).norm() > tolerance::ALONG * f.norm()
        })
    };
    let dead = scene.loads.dead.iter().enumerate();
    dead.filter(|(_, l)| !l.massless && pulls(l)).map(|(k, _)| k).collect()
}

/// A scene without its members: what lasts, where these are not counted on once they yield.
#[must_use]
pub fn without_members(model: &Model) -> Model {
    let mut bare = model.clone();
    bare.interfaces.members.clear();
    bare.assembly.members.clear();
    bare
}
