//! Evidence made exact: what an engine leaves outside by rounding is brought inside.
//!
//! *Forces* that lie outside their cones by rounding are cut to them; what that leaves out of balance
//! is rounding, and the proof that forces which balance exactly exist nearby covers it
//! ([`existence`](check::verdict::exact::existence)).
//!
//! *Mechanisms* close joints by rounding where these should turn or slide. A little of a motion
//! that opens every joint makes up for that: how far a joint closes is a sublinear function of the
//! motion, so that `e(q + ε p) ≤ e(q) + ε e(p)`. A structure that rises and spreads as a whole
//! opens its joints; where it is held between supports, one that opens those that need it is sought
//! ([`opening`]). Where sliding is excluded at any force there is none, and the mechanism stays as
//! it is.

use super::ladder::is_large;
use base::tolerance;
use check::verdict::{
    Forces, Rate, at, certificate,
    exact::motion::{MotionProof, motion},
    joint::{Strength, rolling_arm},
    member::{self, Bounds},
    no_forces,
};
use model::{
    assembly::{Assembly, Wrench},
    interface::{Interface, Interfaces, Model},
};
use nalgebra::Vector3;
use scene::Friction;
use solve::{
    EngineSettings, Settings,
    deadline::Deadline,
    program::{Statics, StaticsOptions, Unknowns, opening},
};

/// Forces without those of joints that carry no more than this share of the greatest of all.
pub(super) fn without(forces: &Forces, share: f64) -> Forces {
    let most = |joint: &[Wrench]| {
        joint.iter().map(|w| w.force.amax().max(w.moment.amax())).fold(0.0, f64::max)
    };
    let least = share * forces.iter().map(|joint| most(joint)).fold(0.0, f64::max);
    let kept = |joint: &Vec<Wrench>| {
        if most(joint) > least { joint.clone() } else { vec![Wrench::zero(); joint.len()] }
    };
    forces.iter().map(kept).collect()
}

/// Forces cut to their cones, and further inside by this share. Larger: equilibrium errors above rounding.
/// Smaller: rounding of the cut itself.
const CUT: f64 = 1e-14;

/// Forces with every one that lies outside its friction cone cut to it.
pub(super) fn cut(interfaces: &Interfaces, forces: &mut Forces) {
    for (own, forces) in
        interfaces.members.iter().zip(forces.iter_mut().skip(interfaces.list.len()))
    {
        for w in forces {
            if Bounds::of(own).margin(&w.force) < 0.0 {
                w.force = Bounds::of(own).cut(&w.force, CUT);
            }
        }
    }
    for (face, forces) in interfaces.list.iter().zip(forces) {
        let strength = Strength::of(face);
        let n = face.frame.n;
        for (k, wrench) in forces.iter_mut().enumerate() {
            let [cohesion, tension] = strength.at(k);
            let along = n.dot(&wrench.force);
            let normal = along.max(-tension * (1.0 - CUT));
            let mut shear = wrench.force - n * along;
            if let Friction::Coefficient(mu) = face.law.friction {
                let limit = (mu * normal + cohesion).max(0.0) * (1.0 - CUT);
                let size = shear.norm();
                if size > limit {
                    shear *= limit / size;
                }
            }
            if normal != along || shear != wrench.force - n * along {
                wrench.force = if normal == 0.0 && shear.norm() == 0.0 {
                    Vector3::zeros()
                } else {
                    n * normal + shear
                };
            }
            let arm = rolling_arm(face);
            let (most, twist) = (normal.max(0.0) * arm * (1.0 - CUT), n.dot(&wrench.moment));
            let roll = wrench.moment - n * twist;
            if roll.norm() > most || twist.abs() > most {
                let by = if roll.norm() > most { most / roll.norm() } else { 1.0 };
                wrench.moment = roll * by + n * twist.clamp(-most, most);
            }
        }
    }
}

/// Scenes of more free blocks have no opening motion sought. More: a program as large as the one
/// that was answered.
const MOST_BLOCKS: usize = 1500;

/// How far inside the motion is left, over the speeds there. Larger: power lost. Smaller: rounding
/// of the sum.
const INSIDE: f64 = 1e-14;

/// A motion next to `rates` that closes no joint; `None` where none is found, or where it loses
/// more than `most` of the power of the loads (the dead load's and `lambda` × the live load's), or
/// none before the `deadline`.
pub(super) fn admissible(
    model: &Model,
    rates: &[Rate],
    (lambda, most): (f64, f64),
    deadline: Deadline,
) -> Option<Vec<Rate>> {
    let assembly = &model.assembly;
    let is_proof = |m: &MotionProof| m.is_admissible() && m.gain().lower.is_finite();
    if motion(model, rates).as_ref().is_some_and(is_proof) {
        return Some(rates.to_vec());
    }
    let closing = closing(model, rates);
    let power = |q: &[Rate]| -> f64 {
        let of = |i: usize| {
            let (w, l) = (&assembly.dead[i], &assembly.live[i]);
            (w.force + l.force * lambda).dot(&q[i].velocity)
                + (w.moment + l.moment * lambda).dot(&q[i].spin)
        };
        assembly.free().map(of).sum()
    };
    let own = power(rates);
    // How much of a motion is added, and the power that it takes.
    let added = |p: &[Rate]| -> Option<(f64, f64)> {
        let share = share(&closing, &self::closing(model, p))?;
        Some((share, -share * power(p)))
    };
    let mended = |p: &[Rate], share: f64| -> Option<Vec<Rate>> {
        let mended: Vec<Rate> = rates
            .iter()
            .zip(p)
            .map(|(q, p)| Rate {
                velocity: q.velocity + p.velocity * share,
                spin: q.spin + p.spin * share,
            })
            .collect();
        let holds =
            own - power(&mended) <= most && motion(model, &mended).as_ref().is_some_and(is_proof);
        holds.then_some(mended)
    };
    let mut rising: Vec<(f64, f64, Vec<Rate>)> = fields(assembly)
        .filter_map(|p| added(&p).map(|(share, loss)| (loss, share, p)))
        .filter(|(loss, ..)| *loss <= most)
        .collect();
    rising.sort_by(|a, b| a.0.total_cmp(&b.0));
    if let Some(mended) = rising.iter().find_map(|(_, share, p)| mended(p, *share)) {
        return Some(mended);
    }
    if assembly.free().count() > MOST_BLOCKS || deadline.is_over() {
        return None;
    }
    let p = sought(model, deadline)?;
    added(&p).and_then(|(share, _)| mended(&p, share))
}

/// The same motion without the blocks that all but rest in it, where it proves as much: what an
/// engine leaves of a zero has power on large loads.
pub(super) fn at_rest(model: &Model, rates: &[Rate]) -> Vec<Rate> {
    let Model { assembly, interfaces, .. } = model;
    let speed = |i: usize| certificate::speed(assembly, i, &rates[i]);
    let fastest = assembly.free().map(speed).fold(0.0, f64::max);
    let rest = |(i, q): (usize, &Rate)| {
        if speed(i) <= tolerance::MECHANISM_REST * fastest { Rate::zero() } else { *q }
    };
    let still: Vec<Rate> = rates.iter().enumerate().map(rest).collect();
    let k = certificate::kinematics(model, &still, &no_forces(interfaces));
    if k.is_admissible(assembly) && k.gain() > tolerance::EQUILIBRIUM_ERROR * k.norm {
        still
    } else {
        rates.to_vec()
    }
}

/// How far each point of each contact closes, and the rounding of that, m/s.
fn closing(model: &Model, rates: &[Rate]) -> Vec<(f64, f64)> {
    let Model { assembly, interfaces, .. } = model;
    let mut list = Vec::new();
    // Of members only those close that take any force; the others dissipate.
    for own in &interfaces.members {
        let u = member::power(assembly, own, rates);
        let endless = match Bounds::of(own) {
            Bounds::Range(f64::NEG_INFINITY, f64::INFINITY) => u.x.abs(),
            Bounds::Range(_, f64::INFINITY) => -u.x,
            Bounds::Range(f64::NEG_INFINITY, _) => u.x,
            Bounds::Disc(f64::INFINITY) => u.norm(),
            _ => continue,
        };
        list.push((endless, 2.0 * member::fastest(assembly, own, rates)));
    }
    for face in &interfaces.list {
        let mu = if let Friction::Coefficient(mu) = face.law.friction { mu } else { 0.0 };
        let rolling = rolling(face, rates);
        for p in &face.points {
            let (a, b) = (at(assembly, rates, face.a, p), at(assembly, rates, face.b, p));
            let v = b - a;
            let normal = face.frame.n.dot(&v);
            let sliding = (v - face.frame.n * normal).norm();
            let speed = |i: usize| {
                let Rate { velocity, spin } = &rates[i];
                velocity.norm() + spin.norm() * (p - assembly.blocks[i].centroid).norm()
            };
            list.push((
                mu * sliding + rolling - normal,
                (1.0 + mu) * (speed(face.a) + speed(face.b)),
            ));
        }
    }
    list
}

fn rolling(face: &Interface, rates: &[Rate]) -> f64 {
    let arm = rolling_arm(face);
    if arm == 0.0 {
        return 0.0;
    }
    let spin = rates[face.b].spin - rates[face.a].spin;
    let twist = face.frame.n.dot(&spin);
    arm * ((spin - face.frame.n * twist).norm() + twist.abs())
}

/// How much of an opening motion makes up for what closes; `None` where a joint that closes is not
/// opened.
fn share(closing: &[(f64, f64)], opening: &[(f64, f64)]) -> Option<f64> {
    let mut share = 0.0_f64;
    for ((e, speed), (p, p_speed)) in closing.iter().zip(opening) {
        let inside = INSIDE * (speed + p_speed * share);
        if e + inside > 0.0 {
            if *p >= 0.0 {
                return None;
            }
            share = share.max((e + inside) / -p);
        }
    }
    // The rounding of the sum itself, and of the share.
    Some(share * (1.0 + 1e-3))
}

/// Rises along and spreads across gravity that are tried: a lift in sizes of the scene, and the
/// spread over the rise.
const FIELDS: [(f64, f64); 9] = [
    (0.0, 1.0),
    (0.0, 0.1),
    (0.0, 0.01),
    (1.0, 1.0),
    (1.0, 0.1),
    (1.0, 0.01),
    (10.0, 1.0),
    (10.0, 0.1),
    (100.0, 1.0),
];

/// Motions in which every free block rises with its height and moves outwards with its distance
/// from the middle.
fn fields(assembly: &Assembly) -> impl Iterator<Item = Vec<Rate>> + '_ {
    let up = -assembly.gravity.normalize();
    let count = assembly.free().count().max(1) as f64;
    let middle = assembly.free().map(|i| assembly.blocks[i].centroid).sum::<Vector3<f64>>() / count;
    let lowest =
        assembly.free().map(|i| up.dot(&assembly.blocks[i].centroid)).fold(f64::INFINITY, f64::min);
    let size = assembly
        .free()
        .map(|i| (assembly.blocks[i].centroid - middle).norm().max(assembly.blocks[i].size))
        .fold(0.0, f64::max);
    FIELDS.into_iter().map(move |(lift, spread)| {
        let mut rates = vec![Rate::zero(); assembly.blocks.len()];
        for i in assembly.free() {
            let from = assembly.blocks[i].centroid - middle;
            let across = from - up * up.dot(&from);
            let height = up.dot(&assembly.blocks[i].centroid) - lowest + assembly.blocks[i].size;
            rates[i].velocity =
                (up * (lift + height / size) + across * (spread / size)).map(|c| c + 0.0);
        }
        rates
    })
}

/// The least motion that opens every contact by one, of the whole scene; `None` where there is none
/// (forces that balance without a load hold some contact closed) or where joints have strengths.
fn sought(model: &Model, deadline: Deadline) -> Option<Vec<Rate>> {
    let assembly = &model.assembly;
    // Whether it strains members is seen where it is added.
    let contacts = Interfaces { members: Vec::new(), ..model.interfaces.clone() };
    let bare = model.with_interfaces(contacts);
    let statics = Statics::new(&bare, StaticsOptions::default());
    let (engine, unknowns) = match is_large(&statics) {
        true => (EngineSettings::Interior, Unknowns::Forces),
        false => (EngineSettings::default(), Unknowns::Rates),
    };
    let (program, first) = opening(&statics, unknowns)?;
    let settings = Settings { engine, deadline, tolerance: 1e-6, ..Settings::default() };
    let solution = solve::solve(&program, &settings);
    if !solution.is_finite() {
        return None;
    }
    let rates = statics.rates(assembly.blocks.len(), &solution.x[first..]);
    Some(rates.into_iter().map(|(velocity, spin)| Rate { velocity, spin }).collect())
}
