//! Coulomb's law, exactly: how far forces and rates are from obeying it together.

use super::{
    Forces, Rate,
    certificate::{Strength, at, load_scale, statics},
};
use crate::{
    assembly::{Assembly, Wrench},
    interface::{Interface, Interfaces},
    scene::Friction,
};
use nalgebra::Vector3;

/// How exactly forces and rates obey Signorini's and Coulomb's laws together: the natural map
/// `‖f − P_K(f − ρ (u + μ‖u_t‖ n))‖ / F` over all contact points (Acary, Brémond & Huber 2018), zero for an exact solution.
///
/// `u` are the rates of the joints. The law does not change when `u` is multiplied, so `ρ` brings `u` to the size `F` of the
/// forces, the greater of `‖f‖` and the norm of the dead loads: a measure without units. `None` where nothing moves.
///
/// Cohesion and tension move and cut the cone `K`; couples of a rolling arm count in the same way, over the arm, against the rates
/// of rolling and twisting. Where a joint crushes, the normal forces count by what they fall short of the greatest power on the
/// closing `g`, `√(σ ∫ g⁺ dA − Σ g f_n)`, instead: zero exactly where the pressure is σ on all that closes and nothing on what opens.
pub fn natural_map(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces, rates: &[Rate]) -> Option<f64> {
    map(assembly, interfaces, forces, rates, None)
}

/// The same with rates as the convex program has them, not brought to the size of the forces: in multiples of the mean load of a
/// block, for a mechanism on which the live load, brought to the size of the dead load, has a power of one. Less strict than
/// [`natural_map`] where rates are small beside forces; the measure of the literature.
pub fn natural_map_in_loads(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces, rates: &[Rate], power: f64) -> Option<f64> {
    let mean = mean_load(assembly);
    map(assembly, interfaces, forces, rates, Some(mean * mean / power))
}

fn mean_load(assembly: &Assembly) -> f64 {
    assembly.free().map(|i| load_scale(assembly, i)).sum::<f64>() / assembly.free().count().max(1) as f64
}

fn map(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces, rates: &[Rate], scale: Option<f64>) -> Option<f64> {
    let loads: f64 = assembly.free().map(|i| assembly.dead[i].force.norm_squared()).sum();
    let size = forces.iter().flatten().map(|f| f.force.norm_squared()).sum::<f64>().max(loads).sqrt();
    let spins = |block: usize| rates[block].spin;
    let joint = |face: &Interface, p: &Vector3<f64>| at(assembly, rates, face.b, p) - at(assembly, rates, face.a, p);
    let speed = interfaces.list.iter().flat_map(|face| face.points.iter().map(move |p| joint(face, p).norm_squared())).sum::<f64>().sqrt();
    if speed == 0.0 {
        return None;
    }
    let scale = scale.unwrap_or(size / speed);
    let mut sum = 0.0;
    for (face, forces) in interfaces.list.iter().zip(forces) {
        let strength = Strength::of(face);
        let rates: Vec<Vector3<f64>> = face.points.iter().map(|p| joint(face, p) * scale).collect();
        let (mut breach, mut tangential) = (0.0, 0.0);
        for (place, (u, Wrench { force, .. })) in rates.iter().zip(forces).enumerate() {
            let [cohesion, tension] = strength.at(place);
            breach += contact_breach(face, force, u, cohesion, tension);
            tangential += sliding_breach(face, force, u, cohesion);
        }
        if face.crushes() {
            breach = breach.min(tangential + crushing_breach(face, &strength, forces, &rates));
        }
        let (n, arm) = (face.frame.n, face.rolling_arm());
        if arm > 0.0 {
            let spin = (spins(face.b) - spins(face.a)) * scale;
            for Wrench { force, moment } in forces {
                let limit = n.dot(force).max(0.0);
                let part = |v: Vector3<f64>| (n.dot(&v), v - n * n.dot(&v));
                let ((twist, roll), (twist_rate, roll_rate)) = (part(moment / arm), part(spin * arm));
                breach += (twist - (twist - twist_rate).clamp(-limit, limit)).powi(2);
                breach += (roll - onto_disc(roll - roll_rate, limit)).norm_squared();
            }
        }
        sum += breach;
    }
    Some(sum.sqrt() / size)
}

/// How far one force and the rate there are from Signorini's and Coulomb's laws, squared.
fn contact_breach(face: &Interface, force: &Vector3<f64>, u: &Vector3<f64>, cohesion: f64, tension: f64) -> f64 {
    let n = face.frame.n;
    let shift = match face.law.friction {
        Friction::Coefficient(mu) => mu * (u - n * n.dot(u)).norm(),
        Friction::Infinite => 0.0,
    };
    let nearest = onto_cone(force - u - n * shift, n, face.law.friction, cohesion, tension);
    (force - nearest).norm_squared()
}

/// The same for the tangential parts alone, the normal force taken as it is.
fn sliding_breach(face: &Interface, force: &Vector3<f64>, u: &Vector3<f64>, cohesion: f64) -> f64 {
    let n = face.frame.n;
    let tangential = |v: &Vector3<f64>| v - n * n.dot(v);
    let (f, to) = (tangential(force), tangential(force) - tangential(u));
    match face.law.friction {
        Friction::Coefficient(mu) => (f - onto_disc(to, (mu * n.dot(force) + cohesion).max(0.0))).norm_squared(),
        Friction::Infinite => (f - to).norm_squared(),
    }
}

/// What the normal forces of a joint that crushes fall short of the greatest power on its closing.
fn crushing_breach(face: &Interface, strength: &Strength, forces: &[Wrench], rates: &[Vector3<f64>]) -> f64 {
    let Some((normal, sigma)) = strength.pressed(face, forces) else { return f64::INFINITY };
    let closing: Vec<f64> = rates.iter().map(|u| -face.frame.n.dot(u)).collect();
    let greatest = sigma * face.integral_of_positive_part(&face.lifted(&closing));
    let power: f64 = closing.iter().zip(&normal).map(|(g, f)| g * f).sum();
    (greatest - power).abs()
}

/// The nearest vector no longer than `radius`.
fn onto_disc(v: Vector3<f64>, radius: f64) -> Vector3<f64> {
    let size = v.norm();
    if size > radius { v * (radius / size) } else { v }
}

/// The force nearest to `f` with `‖f_t‖ ≤ μ f_n + cohesion` and `f_n ≥ −tension` (N).
fn onto_cone(f: Vector3<f64>, n: Vector3<f64>, friction: Friction, cohesion: f64, tension: f64) -> Vector3<f64> {
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
    let (to_normal, to_t) = if to_normal < -tension { (-tension, t.min(radius(-tension).max(0.0))) } else { (to_normal, to_t) };
    n * to_normal + if t > 0.0 { tangential * (to_t / t) } else { Vector3::zeros() }
}

/// The motion that contact forces leave the blocks in.
#[derive(Clone, Debug)]
pub struct Released {
    /// Largest acceleration, in multiples of gravity ([`Statics::unbalance`](super::certificate::Statics::unbalance)).
    pub acceleration: f64,
    /// How far forces and motion are from Coulomb's law together ([`natural_map`]).
    pub natural_map: f64,
    /// The same with accelerations in multiples of gravity and forces in mean block loads ([`natural_map_in_loads`]).
    pub natural_map_in_loads: f64,
    /// The motion, each block's unbalance over the square of its load scale.
    pub rates: Vec<Rate>,
}

/// The motion that starts from rest under contact forces, and how exactly the two obey Coulomb's law.
///
/// Each block moves by its own unbalance; a block's mass is taken as its load scale squared, with its own radii of gyration. The law of contact does not depend on that choice, only the speeds do.
pub fn motion(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces) -> Released {
    let s = statics(assembly, interfaces, forces, 0.0);
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    for i in assembly.free() {
        let (w, gyration) = (load_scale(assembly, i), &assembly.blocks[i].gyration);
        let spin = gyration.spin(&gyration.force(&s.residuals[i].moment));
        rates[i] = Rate { velocity: s.residuals[i].force / (w * w), spin: spin / (w * w) };
    }
    let natural_map = natural_map(assembly, interfaces, forces, &rates).unwrap_or(f64::INFINITY);
    let natural_map_in_loads = natural_map_in_loads(assembly, interfaces, forces, &rates, 1.0).unwrap_or(f64::INFINITY);
    Released { acceleration: s.unbalance, natural_map, natural_map_in_loads, rates }
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
