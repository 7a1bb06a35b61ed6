//! Does a motion close no joint, and what power does it gain?
//!
//! The rates are doubles and are taken as they are. A contact is not closed where `n·v ≥ μ ‖v × n‖`
//! (plus rolling), `v` the velocity of block `b` against `a` there, enclosed by intervals; then no
//! admissible force has positive power, `f·v ≥ 0`, and power gained by the loads is power that
//! nothing takes away.

use super::{
    balance::{ENLARGED, arm, norm},
    interval::{Interval, Sum, two_product},
};
use crate::verdict::{
    Rate,
    joint::{Strength, rolling_arm, water},
    member::{Bounds, legs},
};
use model::{
    assembly::{Assembly, Member, Wrench},
    interface::{Interface, Model},
    strength::crushing::crushes,
};
use nalgebra::Vector3;
use scene::Friction;

/// What a motion proves.
#[derive(Clone, Copy, Debug)]
pub struct MotionProof {
    /// Power of the dead load and of the water in the joints.
    pub dead: Interval,
    /// Power of the live load.
    pub live: Interval,
    /// At most what cohesion, tension and members dissipate.
    pub dissipation: f64,
    /// At most `Σ` inadmissibility per newton of the whole force: 0 where no joint closes.
    pub excess: f64,
    /// At most the greatest inadmissibility.
    pub greatest: f64,
}

impl MotionProof {
    /// At least the power of the dead load that nothing dissipates.
    pub fn gain(&self) -> Interval {
        self.dead - Interval { lower: 0.0, upper: self.dissipation }
    }

    /// Whether no joint closes.
    pub fn is_admissible(&self) -> bool {
        self.excess == 0.0
    }
}

/// Velocity of block `b` against `a` at a point.
pub fn velocity(
    assembly: &Assembly,
    face: &Interface,
    rates: &[Rate],
    point: &Vector3<f64>,
) -> [Interval; 3] {
    let mut sums = [Sum::ZERO; 3];
    for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
        let Rate { velocity, spin } = &rates[block];
        let still = spin.iter().all(|w| *w == 0.0);
        let r = arm(point, &assembly.blocks[block].centroid);
        for (k, sum) in sums.iter_mut().enumerate() {
            sum.add(sign * velocity[k]);
            if !still {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                sum.add_scaled(sign * spin[i], r[j]);
                sum.add_scaled(-sign * spin[j], r[i]);
            }
        }
    }
    sums.map(Sum::total)
}

/// Normal and sliding speed of a relative velocity.
pub fn split(n: &Vector3<f64>, v: &[Interval; 3]) -> (Interval, Interval) {
    let along = |k: usize| v[k] * Interval::exactly(n[k]);
    let across = |k: usize| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        v[i] * Interval::exactly(n[j]) - v[j] * Interval::exactly(n[i])
    };
    (along(0) + along(1) + along(2), norm([across(0), across(1), across(2)]))
}

/// What a motion proves; joints that can crush are no matter of this
/// ([`certificate`](crate::verdict::certificate)): `None` where one closes.
pub fn motion(model: &Model, rates: &[Rate]) -> Option<MotionProof> {
    let Model { assembly, interfaces, .. } = model;
    let mut m = MotionProof {
        dead: Interval::ZERO,
        live: Interval::ZERO,
        dissipation: 0.0,
        excess: 0.0,
        greatest: 0.0,
    };
    let (mut dead, mut live) = (Sum::ZERO, Sum::ZERO);
    for i in assembly.free() {
        add_power(&mut dead, &assembly.dead[i], &rates[i]);
        add_power(&mut live, &assembly.live[i], &rates[i]);
    }
    m.dead = dead.total();
    m.live = live.total();
    for face in &interfaces.list {
        let is_still = |i: usize| rates[i] == Rate::zero();
        if is_still(face.a) && is_still(face.b) {
            continue;
        }
        let strength = Strength::of(face);
        let n = &face.frame.n;
        let rolling = rolling(face, rates);
        for (place, point) in face.points.iter().enumerate() {
            let v = velocity(assembly, face, rates, point);
            let (normal, sliding) = split(n, &v);
            let [cohesion, tension] = strength.at(place);
            let (mu, slips) = match face.law.friction {
                Friction::Coefficient(mu) => (mu, 0.0),
                Friction::Infinite => (0.0, sliding.upper),
            };
            let closing = Interval::exactly(mu) * sliding + rolling - normal;
            if closing.upper > 0.0 && crushes(face) {
                return None;
            }
            if cohesion > 0.0 {
                m.dissipation = (Interval::exactly(m.dissipation)
                    + Interval::exactly(cohesion) * sliding)
                    .upper;
            }
            if tension > 0.0 {
                m.dissipation = (Interval::exactly(m.dissipation)
                    + Interval::exactly(tension) * (-closing).positive())
                .upper;
            }
            let mut inadmissible = closing.upper.max(0.0);
            if cohesion == 0.0 && tension == 0.0 && inadmissible > 0.0 {
                inadmissible = inadmissible
                    .min((hidden(mu, normal.lower, sliding.upper) + rolling.upper) * ENLARGED);
            }
            let all = if closing.upper.is_nan() || slips.is_nan() {
                f64::INFINITY
            } else {
                inadmissible + slips
            };
            m.excess += all;
            m.greatest = m.greatest.max(all);
        }
        if let Some(Wrench { force, moment }) = water(face) {
            let (v, spin) = (velocity(assembly, face, rates, &face.points[0]), spin(face, rates));
            (0..3).for_each(|k| {
                m.dead +=
                    Interval::exactly(force[k]) * v[k] + Interval::exactly(moment[k]) * spin[k]
            });
        }
    }
    for own in &interfaces.members {
        let still = |i: usize| rates[i] == Rate::zero();
        if own.action.ends().into_iter().flatten().all(still) {
            continue;
        }
        let (bounded, endless) = loss(Bounds::of(own), &power(assembly, own, rates));
        m.dissipation = (Interval::exactly(m.dissipation) + bounded).upper;
        let endless = if endless.is_nan() { f64::INFINITY } else { endless };
        m.excess += endless;
        m.greatest = m.greatest.max(endless);
    }
    m.excess *= ENLARGED;
    Some(m)
}

/// Power of each amount of a member.
fn power(assembly: &Assembly, own: &Member, rates: &[Rate]) -> [Interval; 3] {
    let mut sums = [Sum::ZERO; 3];
    for leg in legs(own) {
        for (block, sign) in [(leg.a, -1.0), (leg.b, 1.0)] {
            let Some(block) = block else { continue };
            let Rate { velocity, spin } = &rates[block];
            let r = arm(&leg.at, &assembly.blocks[block].centroid);
            let sum = &mut sums[leg.axis];
            for k in 0..3 {
                let d = sign * leg.direction[k];
                sum.add_product(d, velocity[k]);
                if spin.iter().any(|w| *w != 0.0) {
                    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                    // A product of three doubles, of which the first two make two.
                    for (by, r) in [(spin[i], r[j]), (-spin[j], r[i])] {
                        let (product, rest) = two_product(d, by);
                        sum.add_scaled(product, r);
                        sum.add_scaled(rest, r);
                    }
                }
            }
        }
    }
    sums.map(Sum::total)
}

/// What a member takes up at most: power where its bounds end it, and the speed against which it
/// takes up any force.
fn loss(bounds: Bounds, u: &[Interval; 3]) -> (Interval, f64) {
    let bounded = |most: f64, rate: Interval| {
        let rate = rate.positive();
        if rate.upper.is_nan() {
            (Interval::ZERO, f64::NAN)
        } else if most == f64::INFINITY {
            (Interval::ZERO, rate.upper)
        } else {
            (Interval::exactly(most) * rate, 0.0)
        }
    };
    match bounds {
        Bounds::Range(least, greatest) => {
            let (pulled, pushed) = (bounded(greatest, -u[0]), bounded(-least, u[0]));
            // Of a rate whose sign is not known both count: more than either.
            (pulled.0 + pushed.0, pulled.1 + pushed.1)
        }
        Bounds::Disc(most) => bounded(most, norm([u[0], u[1], Interval::ZERO])),
        Bounds::Cone { mu, most } => {
            bounded(most, Interval::exactly(mu) * norm([u[1], u[2], Interval::ZERO]) - u[0])
        }
    }
}

/// The power that a force of 1 N inside the friction cone can have at most against a joint that
/// separates at `normal` and slides at `sliding`: the size of the projection of the closing
/// velocity onto the cone.
fn hidden(mu: f64, normal: f64, sliding: f64) -> f64 {
    if sliding <= -mu * normal {
        normal.hypot(sliding)
    } else {
        (mu * sliding - normal).max(0.0) / mu.hypot(1.0)
    }
}

/// Spin of block `b` against `a`.
fn spin(face: &Interface, rates: &[Rate]) -> [Interval; 3] {
    [0, 1, 2].map(|k| {
        Interval::exactly(rates[face.b].spin[k]) - Interval::exactly(rates[face.a].spin[k])
    })
}

/// What couples can take up per newton of normal force.
fn rolling(face: &Interface, rates: &[Rate]) -> Interval {
    let arm = rolling_arm(face);
    if arm == 0.0 {
        return Interval::ZERO;
    }
    let (twist, roll) = split(&face.frame.n, &spin(face, rates));
    Interval::exactly(arm) * (roll + twist.max(-twist))
}

fn add_power(sum: &mut Sum, w: &Wrench, q: &Rate) {
    for k in 0..3 {
        sum.add_product(w.force[k], q.velocity[k]);
        sum.add_product(w.moment[k], q.spin[k]);
    }
}
