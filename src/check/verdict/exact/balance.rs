//! What contact forces leave on each block, without rounding, and how far inside its cone each of
//! them lies.
//!
//! All numbers of a resolved scene are doubles: centres of mass, contact points, normals, loads,
//! shares of the area. What is said here is true of exactly these numbers. A normal `n` need not
//! have a length of one to the last digit: a force lies in the cone of its contact where `‖f × n‖ ≤
//! μ n·f + c` and `n·f ≥ −T`, which does not depend on that length but for cohesion and tension.

use super::interval::{Interval, Sum, difference, two_product};
use crate::verdict::{
    Forces,
    joint::{Strength, rolling_arm, water},
    member::{Bounds, amounts, legs},
};
use model::{
    assembly::{Assembly, Block, Member, Wrench},
    interface::{Interface, Model},
};
use nalgebra::Vector3;
use scene::Friction;

/// A vector of which each component is the sum of two doubles.
pub type Pair = [(f64, f64); 3];

/// A vector of doubles as it is.
pub fn exactly(v: &Vector3<f64>) -> Pair {
    [0, 1, 2].map(|k| (v[k], 0.0))
}

/// The multiple of a vector.
pub fn multiple(by: f64, v: &Vector3<f64>) -> Pair {
    [0, 1, 2].map(|k| two_product(by, v[k]))
}

/// From a centre of mass to a point.
pub fn arm(point: &Vector3<f64>, centroid: &Vector3<f64>) -> Pair {
    [0, 1, 2].map(|k| difference(point[k], centroid[k]))
}

/// Adds `by × x × y` of two numbers that are sums of two doubles each; `by` is 1 or −1.
fn add_product(sum: &mut Sum, by: f64, x: (f64, f64), y: (f64, f64)) {
    sum.add_scaled(by * x.0, y);
    if x.1 != 0.0 {
        sum.add_scaled(by * x.1, y);
    }
}

/// The wrench left on each block: force, then moment about its centre of mass.
#[derive(Clone)]
pub struct Balance<'a> {
    assembly: &'a Assembly,
    totals: Vec<[Sum; 6]>,
}

impl<'a> Balance<'a> {
    /// Loads alone: the dead load, `lambda` × the live load and the water in the joints.
    pub fn loads(model: &'a Model, lambda: f64) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let mut totals = vec![[Sum::ZERO; 6]; assembly.blocks.len()];
        for i in assembly.free() {
            let (dead, live) = (&assembly.dead[i], &assembly.live[i]);
            let parts =
                dead.force.iter().zip(&live.force).chain(dead.moment.iter().zip(&live.moment));
            for (sum, (w, l)) in totals[i].iter_mut().zip(parts) {
                sum.add(*w);
                sum.add_product(lambda, *l);
            }
        }
        let mut this = Self { assembly, totals };
        for face in &interfaces.list {
            if let Some(Wrench { force, moment }) = water(face) {
                this.add(face, &face.points[0], &exactly(&force));
                this.add_couple(face, &moment);
            }
        }
        this
    }

    /// Adds a force on block `b` of a contact at one of its points; its opposite acts on `a`.
    pub fn add(&mut self, face: &Interface, point: &Vector3<f64>, force: &Pair) {
        self.add_pair([Some(face.a), Some(face.b)], point, force);
    }

    /// Adds a force on the second block at a point; its opposite acts on the first. The ground
    /// where there is no block.
    pub fn add_pair(&mut self, blocks: [Option<usize>; 2], point: &Vector3<f64>, force: &Pair) {
        for (block, sign) in blocks.into_iter().zip([-1.0, 1.0]) {
            let Some(block) = block else { continue };
            if self.assembly.blocks[block].support {
                continue;
            }
            let r = arm(point, &self.assembly.blocks[block].centroid);
            let total = &mut self.totals[block];
            for k in 0..3 {
                total[k].add(sign * force[k].0);
                total[k].add(sign * force[k].1);
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                add_product(&mut total[3 + k], sign, r[i], force[j]);
                add_product(&mut total[3 + k], -sign, r[j], force[i]);
            }
        }
    }

    /// Adds amounts of a member.
    pub fn add_member(&mut self, own: &Member, amounts: &Vector3<f64>) {
        for leg in legs(own) {
            self.add_pair([leg.a, leg.b], &leg.at, &multiple(amounts[leg.axis], &leg.direction));
        }
    }

    /// Adds a couple on block `b`.
    pub fn add_couple(&mut self, face: &Interface, couple: &Vector3<f64>) {
        for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
            for k in 0..3 {
                self.totals[block][3 + k].add(sign * couple[k]);
            }
        }
    }

    /// What is left on a block.
    pub fn left(&self, block: usize) -> [Interval; 6] {
        self.totals[block].map(Sum::total)
    }

    /// The size of what is left on a block, N, at the most: moments over the radii of gyration.
    pub fn size(&self, block: usize) -> f64 {
        let left = self.left(block);
        let at = |from: usize| Vector3::from_fn(|k, _| left[from + k].magnitude());
        let weigh = self.assembly.blocks[block].gyration.bound(&at(3));
        let size = at(0).norm().hypot(weigh.norm());
        // Where a norm under- or overflows, the sum of the parts does not underflow with it.
        let size = if size == 0.0 { at(0).sum() + weigh.sum() } else { size };
        if size.is_nan() { f64::INFINITY } else { size * ENLARGED }
    }
}

/// What forces leave out of balance, at the most, the distance from their cones included.
#[derive(Clone, Copy, Debug)]
pub struct EquilibriumError {
    /// On the block of the greatest, over its scale; infinite where a number is none.
    pub greatest: f64,
    /// That block.
    pub block: usize,
}

impl EquilibriumError {
    /// Of forces at load factor `lambda`, each block by its own `scale`, N.
    pub fn of(model: &Model, forces: &Forces, lambda: f64, scale: &dyn Fn(usize) -> f64) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let mut balance = Balance::loads(model, lambda);
        let mut outside = vec![0.0_f64; assembly.blocks.len()];
        for (face, forces) in interfaces.list.iter().zip(forces) {
            let strength = Strength::of(face);
            for (k, (point, wrench)) in face.points.iter().zip(forces).enumerate() {
                let room = room(face, k, wrench, &strength);
                balance.add(face, point, &room.force);
                balance.add_couple(face, &wrench.moment);
                if room.margin < 0.0 {
                    for i in [face.a, face.b] {
                        let Block { centroid, gyration, .. } = &assembly.blocks[i];
                        // The force in the cone next to this one leaves as much more.
                        outside[i] -= room.margin
                            * (1.0 + (point - centroid).norm() / gyration.least())
                            * ENLARGED;
                    }
                }
            }
        }
        let joints = interfaces.list.len();
        for (own, forces) in interfaces.members.iter().zip(forces.iter().skip(joints)) {
            let a = amounts(forces);
            balance.add_member(own, &a);
            let margin = shy(Bounds::of(own).margin(&a));
            if margin < 0.0 || margin.is_nan() {
                for i in own.action.ends().into_iter().flatten() {
                    let Block { centroid, gyration, .. } = &assembly.blocks[i];
                    let far = own.action.points().into_iter().map(|p| (p - centroid).norm());
                    let arm = far.fold(0.0, f64::max);
                    // A block that deviates a line is pulled from both sides.
                    outside[i] -= 2.0 * margin * (1.0 + arm / gyration.least()) * ENLARGED;
                }
            }
        }
        let mut worst = Self { greatest: 0.0, block: 0 };
        for i in assembly.free() {
            let all = balance.size(i) + outside[i];
            let equilibrium_error = if all == 0.0 { 0.0 } else { all / scale(i) };
            let equilibrium_error =
                if equilibrium_error.is_nan() { f64::INFINITY } else { equilibrium_error };
            if equilibrium_error > worst.greatest {
                worst = Self { greatest: equilibrium_error, block: i };
            }
        }
        worst
    }
}

/// What only measures may be rounded: an upper bound computed in doubles is multiplied by this.
pub const ENLARGED: f64 = 1.0 + 1e-10;
/// The same for what must not be overestimated.
pub const REDUCED: f64 = 1.0 - 1e-10;

/// One contact force as it counts, and its room.
pub struct Room {
    /// The force on block `b`.
    pub force: Pair,
    /// Every force within this distance, N, lies in the cone too (along `direction` only, where
    /// there is one); negative where the force itself lies outside, then by no more than this.
    pub margin: f64,
    /// The only direction in which the force may change: the normal, where there is no friction.
    pub direction: Option<Vector3<f64>>,
}

/// How far inside its cone a force with its couple lies. Without friction a force counts with its
/// part along the normal.
pub fn room(
    face: &Interface,
    point: usize,
    Wrench { force, moment }: &Wrench,
    strength: &Strength,
) -> Room {
    let n = &face.frame.n;
    let [cohesion, tension] = strength.at(point);
    let length = n.norm();
    if face.law.friction == Friction::Coefficient(0.0) && cohesion == 0.0 {
        let by = n.dot(force) / (length * length);
        let margin = couples(face, moment, Interval::exactly(by))
            .map_or(by + tension, |c| c.min(by + tension));
        return Room { force: multiple(by, n), margin: shy(margin), direction: Some(*n) };
    }
    let normal = dot(n, force);
    let pressed = normal + Interval::exactly(tension);
    let mut margin = shy(pressed.lower / length);
    if let Friction::Coefficient(mu) = face.law.friction {
        let shear = cross_size(force, n);
        let left = Interval::exactly(mu) * normal + Interval::exactly(cohesion) - shear;
        let by_shear = shy(left.lower / (length * mu.hypot(1.0)));
        // With neither cohesion nor tension the cone has its apex at zero, and the other bound
        // follows.
        let apex = cohesion == 0.0 && tension == 0.0 && mu > 0.0;
        margin = if apex { by_shear } else { margin.min(by_shear) };
    }
    if let Some(by_couple) = couples(face, moment, normal) {
        margin = margin.min(by_couple / length);
    }
    Room {
        force: exactly(force),
        margin: if margin.is_nan() { f64::NEG_INFINITY } else { margin },
        direction: None,
    }
}

/// What the normal force exceeds a couple by, at the least; `None` where there is no couple.
fn couples(face: &Interface, moment: &Vector3<f64>, normal: Interval) -> Option<f64> {
    if *moment == Vector3::zeros() {
        return None;
    }
    let n = &face.frame.n;
    let arm = Interval::exactly(rolling_arm(face));
    let most = cross_size(moment, n).max(Interval::exactly(dot(n, moment).magnitude()));
    Some(shy((normal - most.over(arm)).lower))
}

/// A lower bound computed in doubles, made smaller by more than their rounding; one that is
/// negative, larger in size.
fn shy(margin: f64) -> f64 {
    margin * if margin > 0.0 { REDUCED } else { ENLARGED }
}

/// The product of two vectors of doubles.
pub fn dot(a: &Vector3<f64>, b: &Vector3<f64>) -> Interval {
    let mut sum = Sum::ZERO;
    (0..3).for_each(|k| sum.add_product(a[k], b[k]));
    sum.total()
}

/// The size of the vector product of two vectors of doubles.
fn cross_size(a: &Vector3<f64>, b: &Vector3<f64>) -> Interval {
    norm([0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let mut sum = Sum::ZERO;
        sum.add_product(a[i], b[j]);
        sum.add_product(-a[j], b[i]);
        sum.total()
    }))
}

/// The size of a vector.
pub fn norm(v: [Interval; 3]) -> Interval {
    if v.iter().filter(|c| **c == Interval::ZERO).count() == 2 {
        // One component is its own size, without a root.
        return v
            .into_iter()
            .fold(Interval::ZERO, |all, c| if c == Interval::ZERO { all } else { size(c) });
    }
    (v[0].square() + v[1].square() + v[2].square()).sqrt()
}

/// The distance of a number from zero.
fn size(c: Interval) -> Interval {
    if c.lower >= 0.0 {
        c
    } else if c.upper <= 0.0 {
        -c
    } else {
        Interval { lower: 0.0, upper: c.magnitude() }
    }
}
