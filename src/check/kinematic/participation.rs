//! What of the mass takes part in a mechanism: e*, M*, and the equivalent displacement (Circolare
//! 7/2019, C8.7.1.2.1).

use super::{
    mass::{Mass, MassKind, Quake},
    tells::bodies,
};
use crate::verdict::{Rate, certificate};
use base::tolerance;
use model::{assembly::Assembly, interface::Model};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A mass that takes part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Share {
    /// What it is.
    pub kind: MassKind,
    /// The block that it moves with.
    pub block: String,
    /// Where it acts, m.
    pub at: [f64; 3],
    /// Its weight, N.
    pub weight: f64,
    /// δ: its virtual displacement towards the earthquake, the greatest of all being 1 in size.
    pub delta: f64,
}

/// A point whose δ is no more than this, beside the greatest of a mass, does not go towards the
/// earthquake. Larger: slow points measure nothing. Smaller: rounding of rates measures them.
pub const STILL: f64 = 1e-6;

/// What of the mass takes part in a mechanism.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Participation {
    /// Weight of the masses that move, Σ(P+Q), N.
    pub weight: f64,
    /// Share of it that takes part, e*.
    pub e_star: f64,
    /// Mass that takes part, M*, kg.
    pub mass: f64,
    /// Σ(P+Q)δ² / Σ(P+Q)δ: what the way of a point is multiplied by, over its own δ, to give the
    /// equivalent displacement.
    pub delta_star: f64,
    /// e* with blocks that move as one body counted as one, at their common centre of mass: never
    /// less than e*, so that its acceleration is never more.
    pub e_star_of_bodies: f64,
    /// The masses.
    pub masses: Vec<Share>,
}

/// Rates of the masses of a mechanism.
struct Moving<'a> {
    mass: &'a Mass,
    at: Vector3<f64>,
    velocity: f64,
}

/// The masses of the blocks that move, with their rates.
fn moving<'a>(quake: &'a Quake, rates: &[Rate]) -> Vec<Moving<'a>> {
    let assembly = &quake.model.assembly;
    let speed = |i: usize| certificate::speed(assembly, i, &rates[i]);
    let fastest = assembly.free().map(speed).fold(0.0, f64::max);
    quake
        .masses
        .iter()
        .filter(|m| speed(m.block) > tolerance::MECHANISM_REST * fastest)
        .map(|mass| {
            let at = assembly.blocks[mass.block].centroid + mass.arm;
            // By the arm itself: distant coordinates would round it.
            let velocity = rates[mass.block].velocity + rates[mass.block].spin.cross(&mass.arm);
            Moving { mass, at, velocity: velocity.dot(&quake.toward) }
        })
        .collect()
}

impl Participation {
    /// That of a mechanism with these rates, one a block; nothing where no mass is driven.
    pub fn of(quake: &Quake, rates: &[Rate]) -> Option<Self> {
        let assembly = &quake.model.assembly;
        let list = moving(quake, rates);
        let unit = list.iter().map(|m| m.velocity.abs()).fold(0.0, f64::max);
        let delta = |m: &Moving| m.velocity / unit;
        let sum = |f: &dyn Fn(&Moving) -> f64| list.iter().map(f).sum::<f64>();
        let weight = sum(&|m| m.mass.weight);
        let first = sum(&|m| m.mass.weight * delta(m));
        let second = sum(&|m| m.mass.weight * delta(m).powi(2));
        if !(unit > 0.0 && first > 0.0 && second.is_finite()) {
            return None;
        }
        let e_star = first * first / (weight * second);
        let masses = list.iter().map(|m| Share {
            kind: m.mass.kind,
            block: assembly.blocks[m.mass.block].id.clone(),
            at: m.at.into(),
            weight: m.mass.weight,
            delta: delta(m),
        });
        Some(Self {
            weight,
            e_star,
            mass: e_star * weight / assembly.gravity.norm(),
            delta_star: second / first,
            e_star_of_bodies: first * first / (weight * joined(quake, rates, &list, unit)),
            masses: masses.collect(),
        })
    }

    /// Whether another mechanism moves the same masses alike.
    pub fn is_same(&self, other: &Self) -> bool {
        let key = |s: &Share| (s.kind, s.block.clone(), s.at);
        self.masses.len() == other.masses.len()
            && self.masses.iter().zip(&other.masses).all(|(a, b)| {
                key(a) == key(b) && (a.delta - b.delta).abs() <= tolerance::MECHANISM_REST
            })
    }

    /// What an acceleration of the mechanism is with blocks that move as one counted as one, over
    /// that block by block: less than 1 where a body is drawn as several blocks. Equivalent
    /// displacements go along, so that periods stay, and ratios of a site fall by as much, but for
    /// what finite rotations make of another control point.
    pub fn share_of_bodies(&self) -> Option<f64> {
        /// Rounding of rates makes no other body.
        const SAME: f64 = 1e-6;
        let share = self.e_star / self.e_star_of_bodies;
        (share < 1.0 - SAME).then_some(share)
    }

    /// The acceleration of a load factor, m/s².
    pub fn acceleration(&self, alpha: f64, gravity: f64, confidence: f64) -> f64 {
        alpha * gravity / (self.e_star * confidence)
    }
}

/// Σ(P+Q)δ² with the blocks of a body at their common centre of mass.
fn joined(quake: &Quake, rates: &[Rate], list: &[Moving], unit: f64) -> f64 {
    let (of, leads) = bodies(&quake.model, rates);
    let mut sums = vec![(0.0, 0.0); leads.len()];
    let mut second = 0.0;
    for m in list {
        let (weight, delta) = (m.mass.weight, m.velocity / unit);
        match of[m.mass.block].filter(|_| m.mass.kind == MassKind::Block) {
            Some(body) => sums[body] = (sums[body].0 + weight, sums[body].1 + weight * delta),
            None => second += weight * delta * delta,
        }
    }
    let bodies = sums.iter().filter(|s| s.0 > 0.0).map(|(weight, first)| first * first / weight);
    second + bodies.sum::<f64>()
}

/// δ of a point of a block, in the measure of [`Share::delta`]; nothing where no mass is driven.
pub fn way_of(quake: &Quake, rates: &[Rate], block: usize, point: &Vector3<f64>) -> Option<f64> {
    let unit = moving(quake, rates).iter().map(|m| m.velocity.abs()).fold(0.0, f64::max);
    let arm = point - quake.model.assembly.blocks[block].centroid;
    let velocity = rates[block].velocity + rates[block].spin.cross(&arm);
    (unit > 0.0).then(|| velocity.dot(&quake.toward) / unit)
}

/// The control point where nothing is said: the centre of mass of the block that moves and lies
/// nearest to the centre of all masses that move, among those that go towards the earthquake.
pub fn control_point(quake: &Quake, rates: &[Rate]) -> Option<(usize, Vector3<f64>)> {
    /// Blocks that hardly go towards the earthquake would measure it badly.
    const GOES: f64 = 0.1;
    /// Blocks this much nearer, over the size of one, are nearer: rounding decides nothing.
    const NEARER: f64 = 1e-6;
    let assembly: &Assembly = &quake.model.assembly;
    let list = moving(quake, rates);
    let weight: f64 = list.iter().map(|m| m.mass.weight).sum();
    let origin = list.first()?.at;
    let center = origin
        + list.iter().map(|m| (m.at - origin) * m.mass.weight).sum::<Vector3<f64>>() / weight;
    let fastest = list.iter().map(|m| m.velocity).fold(0.0, f64::max);
    let mut best: Option<(usize, f64)> = None;
    for m in list.iter().filter(|m| m.mass.kind == MassKind::Block) {
        let distance = (m.at - center).norm();
        let nearer = best.is_none_or(|(i, d)| distance < d - NEARER * assembly.blocks[i].size);
        if m.velocity > GOES * fastest && nearer {
            best = Some((m.mass.block, distance));
        }
    }
    best.map(|(i, _)| (i, assembly.blocks[i].centroid))
}
/// Mechanisms whose rates differ by less than this, relative to the fastest, are one. Larger: a wall
/// that slides counts as one that turns. Smaller: the last digits of two programs make two of one.
const ONE_MOTION: f64 = 1e-3;

/// Whether the blocks that one mechanism moves are moved alike by another, spins included: masses may
/// go the same way where one slides and the other turns.
pub fn same_motion(model: &Model, one: &[Rate], other: &[Rate]) -> bool {
    let size = |i: usize| model.assembly.blocks[i].size;
    let speed = |(i, r): (usize, &Rate)| r.velocity.norm().max(r.spin.norm() * size(i));
    let fastest = |rates: &[Rate]| rates.iter().enumerate().map(speed).fold(0.0, f64::max);
    let (a, b) = (fastest(one), fastest(other));
    if !(a > 0.0 && b > 0.0) {
        return false;
    }
    one.iter().zip(other).enumerate().all(|(i, (p, q))| {
        let velocity = p.velocity / a - q.velocity / b;
        let spin = p.spin / a - q.spin / b;
        velocity.norm().max(spin.norm() * size(i)) <= ONE_MOTION
    })
}
