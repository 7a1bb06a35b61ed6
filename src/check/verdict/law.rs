//! Coulomb's law, exactly: how far forces and rates are from obeying it together.

use super::{
    Forces, Rate, at,
    certificate::{load_scale, power, size, speed, statics},
    joint::{Strength, rolling_arm},
    member::{self, Bounds},
};
use base::tolerance;
use model::{
    assembly::{Assembly, Member, Wrench},
    interface::{Interface, Model},
    strength::crushing::{closing_volume, crushes},
};
use nalgebra::Vector3;
use scene::Friction;

/// How exactly forces and rates obey Signorini's and Coulomb's laws together: the natural map `‖f −
/// P_K(f − ρ (u + μ‖u_t‖ n))‖ / F` (Acary, Brémond & Huber 2018), the greatest over all joints,
/// zero for an exact solution.
///
/// `u` are the rates of the joints. The law does not change when `u` is multiplied, so `ρ` brings
/// the greatest of them to the size `F` of the forces: a measure without units. `F` is each joint's
/// own: the load or greatest contact force of its two blocks, of the lesser block. What large
/// forces or heavy blocks elsewhere do makes no room for a breach here. `None` where nothing moves.
///
/// Cohesion and tension move and cut the cone `K`; couples of a rolling arm count in the same way,
/// over the arm, against the rates of rolling and twisting. Where a joint crushes, the normal
/// forces count by what they fall short of the greatest power on the closing `g`, `√(σ ∫ g⁺ dA − Σ
/// g f_n)`, instead: zero exactly where the pressure is σ on all that closes and nothing on what
/// opens.
pub fn natural_map(model: &Model, forces: &Forces, rates: &[Rate]) -> Option<f64> {
    let Model { assembly, interfaces, .. } = model;
    let speeds = interfaces.list.iter().flat_map(|face| {
        face.points.iter().map(move |p| joint_rate(assembly, rates, face, p).norm())
    });
    let members = interfaces.members.iter().map(|m| member::power(assembly, m, rates).norm());
    let fastest = speeds.chain(members).fold(0.0, greatest);
    (fastest > 0.0).then(|| map(model, forces, rates, 1.0 / fastest))
}

/// The same with rates as the convex program has them, not brought to the size of the forces: in
/// multiples of the joint's own forces, for a mechanism on which the live load, brought to the size
/// of the dead load, has the power of one mean load; sizes, loads and means are those of the blocks
/// that the mechanism moves. Less strict than [`natural_map`] where rates are small beside forces;
/// the measure of the literature. `None` where nothing moves, or the live load does not drive it.
pub fn natural_map_in_loads(model: &Model, forces: &Forces, rates: &[Rate]) -> Option<f64> {
    let assembly = &model.assembly;
    let fastest = assembly.free().map(|i| speed(assembly, i, &rates[i])).fold(0.0, greatest);
    let moving: Vec<usize> = assembly
        .free()
        .filter(|&i| speed(assembly, i, &rates[i]) > tolerance::MECHANISM_REST * fastest)
        .collect();
    let sum = |of: &dyn Fn(usize) -> f64| moving.iter().map(|&i| of(i)).sum::<f64>();
    let (dead, live) = (
        sum(&|i| size(assembly, i, &assembly.dead[i])),
        sum(&|i| size(assembly, i, &assembly.live[i])),
    );
    let driven = sum(&|i| power(&assembly.live[i], &rates[i])) * dead / live;
    let mean = sum(&|i| load_scale(assembly, i)) / moving.len() as f64;
    (driven > 0.0).then(|| map(model, forces, rates, mean / driven))
}

/// The greater of two; a NaN stays.
fn greatest(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// Rate of a joint at one of its points, m/s.
fn joint_rate(
    assembly: &Assembly,
    rates: &[Rate],
    face: &Interface,
    p: &Vector3<f64>,
) -> Vector3<f64> {
    at(assembly, rates, face.b, p) - at(assembly, rates, face.a, p)
}

/// What breaches at each joint are measured by, N: of its two blocks (supports do not count) the
/// lesser, each by the greatest of its load and of the forces of its contacts.
fn measures(model: &Model, forces: &Forces) -> Vec<f64> {
    let Model { assembly, interfaces, .. } = model;
    let mut own: Vec<f64> = (0..assembly.blocks.len()).map(|i| load_scale(assembly, i)).collect();
    for (face, forces) in interfaces.list.iter().zip(forces) {
        for block in [face.a, face.b] {
            own[block] = forces.iter().map(|f| f.force.norm()).fold(own[block], f64::max);
        }
    }
    for (member, forces) in interfaces.members.iter().zip(forces.iter().skip(interfaces.list.len()))
    {
        for block in member.action.ends().into_iter().flatten() {
            own[block] = forces.iter().map(|f| f.force.norm()).fold(own[block], f64::max);
        }
    }
    let of = |block: usize| if assembly.blocks[block].support { f64::INFINITY } else { own[block] };
    let joints = interfaces.list.iter().map(|face| of(face.a).min(of(face.b)));
    let members = interfaces
        .members
        .iter()
        .map(|m| m.action.ends().into_iter().flatten().map(of).fold(f64::INFINITY, f64::min));
    joints.chain(members).map(|size| if size > 0.0 { size } else { 1.0 }).collect()
}

/// The greatest breach of a joint over its own forces; rates of `1 / scale` count as much as these.
fn map(model: &Model, forces: &Forces, rates: &[Rate], scale: f64) -> f64 {
    let Model { assembly, interfaces, .. } = model;
    let spins = |block: usize| rates[block].spin;
    let mut worst = 0.0;
    let measures = measures(model, forces);
    let joints = interfaces.list.len();
    for ((own, forces), size) in interfaces
        .members
        .iter()
        .zip(forces.iter().skip(joints))
        .zip(measures.iter().skip(joints))
        .filter(|(_, size)| size.is_finite())
    {
        let u = member::power(assembly, own, rates) * scale;
        worst = greatest(worst, member_breach(own, &(member::amounts(forces) / *size), &u, *size));
    }
    for ((face, forces), size) in interfaces.list.iter().zip(forces).zip(measures) {
        if !size.is_finite() {
            continue;
        }
        let strength = Strength::of(face);
        let rates: Vec<Vector3<f64>> =
            face.points.iter().map(|p| joint_rate(assembly, rates, face, p) * scale).collect();
        let own: Vec<Wrench> = forces.iter().map(|&w| w * (1.0 / size)).collect();
        let (mut breach, mut tangential) = (0.0, 0.0);
        for (place, (u, Wrench { force, .. })) in rates.iter().zip(&own).enumerate() {
            let [cohesion, tension] = strength.at(place).map(|s| s / size);
            breach += contact_breach(face, force, u, cohesion, tension);
            tangential += sliding_breach(face, force, u, cohesion);
        }
        if crushes(face) {
            breach =
                breach.min(tangential + crushing_breach(face, &strength, forces, &rates) / size);
        }
        let (n, arm) = (face.frame.n, rolling_arm(face));
        if arm > 0.0 {
            let spin = (spins(face.b) - spins(face.a)) * scale;
            for Wrench { force, moment } in &own {
                let limit = n.dot(force).max(0.0);
                let part = |v: Vector3<f64>| (n.dot(&v), v - n * n.dot(&v));
                let ((twist, roll), (twist_rate, roll_rate)) =
                    (part(moment / arm), part(spin * arm));
                breach += (twist - (twist - twist_rate).clamp(-limit, limit)).powi(2);
                breach += (roll - onto_disc(roll - roll_rate, limit)).norm_squared();
            }
        }
        worst = greatest(worst, breach.sqrt());
    }
    worst
}

/// How far one force and the rate there are from Signorini's and Coulomb's laws, squared.
fn contact_breach(
    face: &Interface,
    force: &Vector3<f64>,
    u: &Vector3<f64>,
    cohesion: f64,
    tension: f64,
) -> f64 {
    let n = face.frame.n;
    let shift = match face.law.friction {
        Friction::Coefficient(mu) => mu * (u - n * n.dot(u)).norm(),
        Friction::Infinite => 0.0,
    };
    let nearest = onto_cone(force - u - n * shift, n, face.law.friction, cohesion, tension);
    (force - nearest).norm_squared()
}

/// How far the amounts of a member and the rates there, in its own measure, are from yielding by the
/// greatest dissipation. A finger applies its force: the normal one is its strength, and only its
/// friction reacts.
fn member_breach(own: &Member, amounts: &Vector3<f64>, u: &Vector3<f64>, size: f64) -> f64 {
    let applied = own.times(1.0 / size);
    if let Bounds::Cone { mu, most } = Bounds::of(&applied) {
        let by_friction = |a: &Vector3<f64>| onto_disc(Vector3::new(0.0, a.y, a.z), mu * most);
        let tangential = Vector3::new(0.0, amounts.y, amounts.z);
        return (amounts.x - most).hypot((tangential - by_friction(&(amounts - u))).norm());
    }
    (amounts - Bounds::of(&applied).nearest(&(amounts - u))).norm()
}

/// The same for the tangential parts alone, the normal force taken as it is.
fn sliding_breach(face: &Interface, force: &Vector3<f64>, u: &Vector3<f64>, cohesion: f64) -> f64 {
    let n = face.frame.n;
    let tangential = |v: &Vector3<f64>| v - n * n.dot(v);
    let (f, to) = (tangential(force), tangential(force) - tangential(u));
    match face.law.friction {
        Friction::Coefficient(mu) => {
            (f - onto_disc(to, (mu * n.dot(force) + cohesion).max(0.0))).norm_squared()
        }
        Friction::Infinite => (f - to).norm_squared(),
    }
}

/// What the normal forces of a joint that crushes fall short of the greatest power on its closing.
fn crushing_breach(
    face: &Interface,
    strength: &Strength,
    forces: &[Wrench],
    rates: &[Vector3<f64>],
) -> f64 {
    let Some((normal, sigma)) = strength.pressed(face, forces) else { return f64::INFINITY };
    let closing: Vec<f64> = rates.iter().map(|u| -face.frame.n.dot(u)).collect();
    let greatest = sigma * closing_volume(face, &closing);
    let power: f64 = closing.iter().zip(&normal).map(|(g, f)| g * f).sum();
    (greatest - power).abs()
}

/// The nearest vector no longer than `radius`.
fn onto_disc(v: Vector3<f64>, radius: f64) -> Vector3<f64> {
    let size = v.norm();
    if size > radius { v * (radius / size) } else { v }
}

/// The force nearest to `f` with `‖f_t‖ ≤ μ f_n + cohesion` and `f_n ≥ −tension` (N).
fn onto_cone(
    f: Vector3<f64>,
    n: Vector3<f64>,
    friction: Friction,
    cohesion: f64,
    tension: f64,
) -> Vector3<f64> {
    let normal = n.dot(&f);
    let tangential = f - n * normal;
    let Friction::Coefficient(mu) = friction else { return tangential + n * normal.max(-tension) };
    let t = tangential.norm();
    let radius = |normal: f64| mu * normal + cohesion;
    // On the cone, wherever that lies; then the cut-off of tension, on which the cone is a disc.
    let (to_normal, to_t) = if t <= radius(normal) {
        (normal, t)
    } else {
        let on = (normal + mu * (t - cohesion)) / (1.0 + mu * mu);
        (on, radius(on))
    };
    let (to_normal, to_t) = if to_normal < -tension {
        (-tension, t.min(radius(-tension).max(0.0)))
    } else {
        (to_normal, to_t)
    };
    n * to_normal + if t > 0.0 { tangential * (to_t / t) } else { Vector3::zeros() }
}

/// The motion that contact forces leave the blocks in.
#[derive(Clone, Debug)]
pub struct Released {
    /// Largest acceleration, in multiples of gravity
    /// ([`Residuals::equilibrium_error`](super::certificate::Residuals::equilibrium_error)).
    pub acceleration: f64,
    /// Acceleration of each block, in multiples of gravity; zero for supports.
    pub accelerations: Vec<f64>,
    /// How far forces and motion are from Coulomb's law together ([`natural_map`]).
    pub natural_map: f64,
    /// The same with accelerations in multiples of gravity, not brought to the size of the forces:
    /// what breaches of the law could make of the accelerations.
    pub natural_map_in_loads: f64,
    /// The motion, each block's equilibrium error over its load scale: accelerations in multiples of
    /// gravity.
    pub rates: Vec<Rate>,
}

impl Released {
    /// Whether some block moves off, by forces and a motion that obey the law to far less than that
    /// motion: what still creeps, and forces that are not yet those of the law, are none.
    pub fn is_motion(&self) -> bool {
        self.acceleration >= tolerance::LEAST_MOTION
            && self.natural_map <= tolerance::MOTION_LAW
            && self.natural_map_in_loads <= tolerance::MOTION_BREACH * self.acceleration
    }
}

/// The motion that starts from rest under contact forces, and how exactly the two obey Coulomb's
/// law.
///
/// Each block moves by its own equilibrium error; a block's mass is taken as its load scale, with its own
/// radii of gyration. The law of contact does not depend on that choice, only the speeds do.
pub fn motion(model: &Model, forces: &Forces) -> Released {
    let assembly = &model.assembly;
    let s = statics(model, forces, 0.0);
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    let mut accelerations = vec![0.0; assembly.blocks.len()];
    for i in assembly.free() {
        let (w, gyration) = (load_scale(assembly, i), &assembly.blocks[i].gyration);
        let spin = gyration.spin(&gyration.force(&s.residuals[i].moment));
        rates[i] = Rate { velocity: s.residuals[i].force / w, spin: spin / w };
        accelerations[i] = size(assembly, i, &s.residuals[i]) / w;
    }
    let natural_map = natural_map(model, forces, &rates).unwrap_or(f64::INFINITY);
    let natural_map_in_loads = map(model, forces, &rates, 1.0);
    Released {
        acceleration: s.equilibrium_error,
        accelerations,
        natural_map,
        natural_map_in_loads,
        rates,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The nearest point is in the set and no point of the set near it is nearer.
        #[test]
        fn the_nearest_force(f in prop::array::uniform3(-2.0f64..2.0), mu in 0.0f64..2.0, cohesion in 0.0f64..1.0, cut in 0.0f64..1.0) {
            let n = Vector3::z();
            // Tension beyond cohesion / μ does not count.
            let tension = if mu > 0.0 { cut * (cohesion / mu).min(1.0) } else { cut };
            let f = Vector3::from(f);
            let inside = |x: &Vector3<f64>, by: f64| x.xy().norm() <= mu * x.z + cohesion + by && x.z >= -tension - by;
            let p = onto_cone(f, n, Friction::Coefficient(mu), cohesion, tension);
            prop_assert!(inside(&p, 1e-12));
            for k in 0..200 {
                let a = f64::from(k);
                let x = p + Vector3::new(a.sin(), (1.7 * a).cos(), (2.3 * a).sin()) * 0.05;
                prop_assert!(!inside(&x, 0.0) || (x - f).norm() >= (p - f).norm() - 1e-12);
            }
        }
    }
}
