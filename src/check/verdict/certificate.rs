//! Re-adding forces and powers block by block.
//!
//! *Static side.* Contact forces inside their friction cones leave each free block the wrench `r_i
//! = w_i + λ ℓ_i + Σ` contact wrenches. Its [`size`] is the norm of (force; moment over the radius
//! of gyration about its axis) over the block's load, in multiples of g. *Kinematic side.* Rates
//! `q` separate the contacts at `v`; for every admissible force `f·v ≥ −e f_n` with `e = max(0,
//! μ‖v_t‖ − v_n)`, the inadmissibility. So for any equilibrium `w·q + λ ℓ·q ≤ Σ e f_n`: a mechanism
//! with `e = 0` that gains power proves instability (Heyman 1966; Livesley 1978). Per newton of the
//! whole force the bound is the size of the projection of `−v` onto the cone, `e / √(1 + μ²)` on
//! its side (`hidden`); where friction is steep that is much less, and rounding of `v_t` is not
//! multiplied by μ.
//!
//! *Strength.* With cohesion c and tensile strength T on the corner's share a of the area, `‖f_t‖ ≤
//! μ f_n + c a`, `f_n ≥ −T a`; a mechanism then dissipates `c a ‖v_t‖ + T a (v_n − μ‖v_t‖)⁺` there.
//! With a compressive strength σ, joints may close: a joint that closes at the rate g, affine over
//! its area, dissipates at least `(σ + T) ∫ g⁺ dA` (see [`crushing`]). A rolling arm r adds couples
//! `‖m_t‖ ≤ r f_n`, `|m_n| ≤ r f_n`, which count in `e` with the rates of rolling and twisting.
//! Water in the joint is a load. Members act beside the joints ([`member`]): ties, struts and soil
//! dissipate as they yield, and one that never yields makes a mechanism inadmissible. Sources: Drucker, Prager & Greenberg 1952 (both theorems), Drucker
//! & Prager 1952 (cohesion).

use super::{
    Forces, Rate, at,
    joint::{Strength, rolling_arm, tension, water},
    member,
};
use base::tolerance;
use model::{
    assembly::{Assembly, Wrench},
    interface::{Interface, Interfaces, Model},
    strength::crushing::{Cut, closing_volume, crushes, crushing},
};
use nalgebra::Vector3;
use scene::Friction;

/// Force scale of a free block, N: the greater of its weight and its dead load, whose moment counts
/// as in [`size`].
pub fn load_scale(assembly: &Assembly, block: usize) -> f64 {
    assembly.weight(block).max(size(assembly, block, &assembly.dead[block]))
}

/// Size of a wrench on a block, N: `‖(F; G⁻¹ M)‖`, moments measured by the radii of gyration about
/// their own axes ([`Gyration`]). Over the mass it is the acceleration that the wrench gives the
/// block, as a root mean square over its mass.
///
/// [`Gyration`]: model::assembly::Gyration
pub fn size(assembly: &Assembly, block: usize, w: &Wrench) -> f64 {
    w.force.norm().hypot(assembly.blocks[block].gyration.force(&w.moment).norm())
}

/// Root mean square speed of a block's mass, m/s: `‖(v; G ω)‖`, dual to [`size`].
pub fn speed(assembly: &Assembly, block: usize, q: &Rate) -> f64 {
    q.velocity.norm().hypot(assembly.blocks[block].gyration.speed(&q.spin).norm())
}

/// Speeds of which neither squares nor products with loads under- or overflow.
const ORDINARY: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// The same motion, with its fastest block at a speed near one where it was out of the ordinary (by
/// a power of two, which rounds nothing): what is so slow that squares of speeds underflow would
/// slide without friction.
pub fn at_unit_speed(assembly: &Assembly, rates: &[Rate]) -> Vec<Rate> {
    let size =
        |(i, q): (usize, &Rate)| q.velocity.amax().max(q.spin.amax() * assembly.blocks[i].size);
    let fastest = rates.iter().enumerate().map(size).fold(0.0, f64::max);
    if fastest == 0.0 || !fastest.is_finite() || ORDINARY.contains(&fastest) {
        return rates.to_vec();
    }
    // In two steps: the inverse of the smallest numbers is none.
    let half = (-0.5 * fastest.log2()).floor().exp2();
    let rest = (fastest * half).log2().floor().exp2();
    rates
        .iter()
        .map(|q| Rate { velocity: q.velocity * half / rest, spin: q.spin * half / rest })
        .collect()
}

/// What forces leave out of balance.
#[derive(Clone, Debug)]
pub struct Residuals {
    /// Wrench left on each block, N and N·m; zero on supports.
    pub residuals: Vec<Wrench>,
    /// Largest equilibrium error over the free blocks, in multiples of the block's load (g).
    pub equilibrium_error: f64,
    /// The block of the largest equilibrium error.
    pub worst: usize,
    /// Largest distance of a force outside its friction cone, over that very force: a large force
    /// elsewhere makes no room for a small one that pulls.
    pub cone_excess: f64,
    /// Greatest use of a compressive strength (at most this; above 1 it is what the forces really
    /// need).
    pub crushing: f64,
    /// The interface of that.
    pub most_pressed: usize,
    /// Whether every block is balanced up to [`tolerance::EQUILIBRIUM_ERROR`] of its own load.
    pub balanced: bool,
}

impl Residuals {
    /// Whether no joint is pressed beyond its compressive strength.
    pub fn is_within_strength(&self) -> bool {
        self.crushing <= 1.0 + tolerance::CRUSHING
    }
}

/// Re-adds the contact forces at load factor `lambda`.
pub fn statics(model: &Model, forces: &Forces, lambda: f64) -> Residuals {
    let Model { assembly, interfaces, .. } = model;
    let n = assembly.blocks.len();
    let mut residuals: Vec<Wrench> = (0..n)
        .map(|i| Wrench {
            force: assembly.dead[i].force + assembly.live[i].force * lambda,
            moment: assembly.dead[i].moment + assembly.live[i].moment * lambda,
        })
        .collect();
    let act = |residuals: &mut [Wrench],
               face: &Interface,
               point: &Vector3<f64>,
               force: &Vector3<f64>,
               couple: &Vector3<f64>| {
        for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
            let arm = point - assembly.blocks[block].centroid;
            residuals[block] +=
                Wrench { force: force * sign, moment: (arm.cross(force) + couple) * sign };
        }
    };
    let (mut excess, mut crushing, mut most_pressed) = (0.0_f64, 0.0_f64, 0);
    for (index, (face, forces)) in interfaces.list.iter().zip(forces).enumerate() {
        let strength = Strength::of(face);
        for (k, (point, Wrench { force, moment })) in face.points.iter().zip(forces).enumerate() {
            let outside = outside(face, force, moment, strength.at(k));
            // A NaN is as far outside as can be.
            if outside.is_nan() {
                excess = f64::INFINITY;
            } else if outside > 0.0 {
                excess = excess.max(outside / force.norm());
            }
            act(&mut residuals, face, point, force, moment);
        }
        if let Some(Wrench { force, moment }) = water(face) {
            act(&mut residuals, face, &face.points[0], &force, &moment);
        }
        if let Some(used) = strength.crushing(face, forces) {
            let used = if used.is_nan() { f64::INFINITY } else { used };
            if used > crushing {
                (crushing, most_pressed) = (used, index);
            }
        }
    }
    for (own, forces) in interfaces.members.iter().zip(forces.iter().skip(interfaces.list.len())) {
        let amounts = member::amounts(forces);
        let margin = member::Bounds::of(own).margin(&amounts);
        if margin.is_nan() {
            excess = f64::INFINITY;
        } else if margin < 0.0 {
            excess = excess.max(-margin / amounts.norm());
        }
        for leg in member::legs(own) {
            let force = leg.direction * amounts[leg.axis];
            for (block, sign) in [(leg.a, -1.0), (leg.b, 1.0)] {
                let Some(block) = block else { continue };
                let arm = leg.at - assembly.blocks[block].centroid;
                residuals[block] +=
                    Wrench { force: force * sign, moment: arm.cross(&force) * sign };
            }
        }
    }
    let (mut equilibrium_error, mut worst) = (0.0, 0);
    for (i, residual) in residuals.iter_mut().enumerate() {
        if assembly.blocks[i].support {
            *residual = Wrench::zero();
            continue;
        }
        let scale =
            load_scale(assembly, i).max(lambda.abs() * size(assembly, i, &assembly.live[i]));
        let u = size(assembly, i, residual) / scale;
        // A NaN is the worst there is, and stays.
        if (u > equilibrium_error || u.is_nan()) && !f64::is_nan(equilibrium_error) {
            (equilibrium_error, worst) = (u, i);
        }
    }
    Residuals {
        residuals,
        equilibrium_error,
        worst,
        cone_excess: excess,
        crushing,
        most_pressed,
        balanced: equilibrium_error <= tolerance::EQUILIBRIUM_ERROR,
    }
}

/// The bounds on crushing that forces break, with their interfaces.
pub fn crushed(interfaces: &Interfaces, forces: &Forces) -> Vec<(usize, Cut)> {
    let mut broken = Vec::new();
    for (k, (face, forces)) in interfaces.list.iter().zip(forces).enumerate() {
        let Some((normal, sigma)) = Strength::of(face).pressed(face, forces) else { continue };
        if let (used, Some(cut)) = crushing(face, &normal, sigma)
            && used > 1.0 + 0.5 * tolerance::CRUSHING
        {
            broken.push((k, cut));
        }
    }
    broken
}

/// How far a force and couple lie outside their cones, N.
fn outside(
    face: &Interface,
    force: &Vector3<f64>,
    couple: &Vector3<f64>,
    [cohesion, tension]: [f64; 2],
) -> f64 {
    let n = face.frame.n;
    let normal = n.dot(force);
    let shear = (force - n * normal).norm();
    let mut outside = match face.law.friction {
        Friction::Coefficient(mu) => {
            (-normal - tension).max((shear - mu * normal - cohesion) / mu.hypot(1.0))
        }
        Friction::Infinite => -normal - tension,
    };
    if *couple != Vector3::zeros() {
        let twist = n.dot(couple);
        let rolling = (couple - n * twist).norm().max(twist.abs());
        // Without an arm any couple is infinitely far outside.
        outside = outside.max(rolling / rolling_arm(face) - normal);
    }
    outside
}

/// What a set of rates gains and where it is inadmissible.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// Power of the dead load and of the water in the joints, `w·q`.
    pub dead_power: f64,
    /// Power of the live load, `ℓ·q`.
    pub live_power: f64,
    /// What cohesion, tension, crushing and members dissipate.
    pub dissipation: f64,
    /// `Σ` load scale × [`speed`] over the free blocks: the power that an equilibrium error of 1 g
    /// everywhere would have.
    pub norm: f64,
    /// `Σ e f_n` with the given forces: the power that the inadmissibility may hide.
    pub slack: f64,
    /// Largest inadmissibility, per newton of the whole force, over the fastest speed at a contact.
    pub inadmissibility: f64,
    /// `Σ` inadmissibility per newton: with contact forces of at most `F` each, the mechanism hides
    /// at most `F` × this.
    pub excess: f64,
    /// The part of `excess` from contacts where that is more than rounding of the speeds of the two
    /// blocks ([`tolerance::ADMISSIBLE`]): blocks that should rest, or joints that are made to
    /// close.
    pub coarse: f64,
}

impl Kinematics {
    /// Unless some contact force exceeds this many times the total load, the gain of the dead load
    /// cannot be balanced: what makes a mechanism that is admissible only up to rounding a proof.
    pub fn force_cap(&self, assembly: &Assembly) -> f64 {
        let total: f64 = assembly.free().map(|i| load_scale(assembly, i)).sum();
        self.gain() / (self.excess * total)
    }

    /// Power of the dead load that nothing dissipates.
    pub fn gain(&self) -> f64 {
        self.dead_power - self.dissipation
    }

    /// The load factor above which the mechanism gains power; only where the live load drives it.
    pub fn upper(&self) -> f64 {
        (self.slack - self.gain()) / self.live_power
    }

    /// What the inadmissibility of the mechanism could hide of the load factor if every contact
    /// carried the largest of the forces: where they vanish, `slack` sees none.
    pub fn behind(&self, forces: &Forces) -> f64 {
        let largest = forces.iter().flatten().map(|v| v.force.norm()).fold(0.0, f64::max);
        self.excess * largest / self.live_power
    }

    /// Whether the mechanism is admissible up to rounding: small against its gain for contact
    /// forces of the size of the total load, and, where it is not small against the speeds of the
    /// very blocks that touch, for much larger ones. A block squeezed at low friction needs large
    /// forces; falling straight down closes none of its joints by much.
    pub fn is_admissible(&self, assembly: &Assembly) -> bool {
        let coarse = Self { excess: self.coarse, ..self.clone() };
        self.force_cap(assembly) >= tolerance::FORCE_CAP
            && (self.coarse == 0.0 || coarse.force_cap(assembly) >= tolerance::COARSE_FORCE_CAP)
    }
}

/// Re-adds powers; `forces` weigh the inadmissibility.
pub fn kinematics(model: &Model, rates: &[Rate], forces: &Forces) -> Kinematics {
    let Model { assembly, interfaces, .. } = model;
    let mut k = Kinematics {
        dead_power: 0.0,
        live_power: 0.0,
        dissipation: 0.0,
        norm: 0.0,
        slack: 0.0,
        inadmissibility: 0.0,
        excess: 0.0,
        coarse: 0.0,
    };
    for i in assembly.free() {
        let (q, w, l) = (&rates[i], &assembly.dead[i], &assembly.live[i]);
        k.dead_power += power(w, q);
        k.live_power += power(l, q);
        k.norm += load_scale(assembly, i) * speed(assembly, i, q);
    }
    let local_speed = |i: usize, p: &Vector3<f64>| at(assembly, rates, i, p).norm();
    let local =
        |face: &Interface, p: &Vector3<f64>| local_speed(face.a, p).max(local_speed(face.b, p));
    let fastest = interfaces
        .list
        .iter()
        .flat_map(|face| face.points.iter().map(|p| local(face, p)))
        .chain(interfaces.members.iter().map(|m| member::fastest(assembly, m, rates)))
        .fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for (face, forces) in interfaces.list.iter().zip(forces) {
        let strength = Strength::of(face);
        let n = face.frame.n;
        let (arm, spin) = (rolling_arm(face), rates[face.b].spin - rates[face.a].spin);
        let twist = n.dot(&spin);
        // Of the couples, per newton of normal force.
        let rolling = if arm > 0.0 { arm * ((spin - n * twist).norm() + twist.abs()) } else { 0.0 };
        let (mu, rough) = match face.law.friction {
            Friction::Coefficient(mu) => (mu, false),
            Friction::Infinite => (0.0, true),
        };
        let joint: Vec<Vector3<f64>> = face
            .points
            .iter()
            .map(|p| at(assembly, rates, face.b, p) - at(assembly, rates, face.a, p))
            .collect();
        let sliding: Vec<f64> = joint.iter().map(|v| (v - n * n.dot(v)).norm()).collect();
        let closing: Vec<f64> =
            joint.iter().zip(&sliding).map(|(v, vt)| mu * vt + rolling - n.dot(v)).collect();
        // Joints that close by rounding alone do not crush: a large strength would make much of
        // nothing.
        let crushes = crushes(face) && closing.iter().any(|&e| e > tolerance::ADMISSIBLE * fastest);
        if crushes {
            k.dissipation +=
                (face.law.compression + tension(face)) * closing_volume(face, &closing);
        }
        for (place, (point, Wrench { force, .. })) in face.points.iter().zip(forces).enumerate() {
            let [cohesion, tension] = strength.at(place);
            let (e, vt) = (closing[place], sliding[place]);
            k.dissipation += cohesion * vt;
            let mut inadmissible = 0.0;
            if crushes {
                k.dissipation -= tension * e;
            } else {
                let hides = e.max(0.0) * n.dot(force).max(0.0);
                k.dissipation += tension * (-e).max(0.0);
                if cohesion == 0.0 && tension == 0.0 {
                    inadmissible = e.max(0.0).min(hidden(mu, n.dot(&joint[place]), vt) + rolling);
                    k.slack += hides.min(inadmissible * force.norm());
                } else {
                    inadmissible = e.max(0.0);
                    k.slack += hides;
                }
            }
            // What must not slide costs as much as the shear force that it has.
            let slips = if rough { vt } else { 0.0 };
            k.slack += slips * (force - n * n.dot(force)).norm();
            k.excess += inadmissible + slips;
            let size = inadmissible.hypot(slips);
            if size > tolerance::ADMISSIBLE * local(face, point) || e.is_nan() {
                k.coarse += inadmissible + slips;
            }
            worst = worst.max(size);
        }
        if let Some(push) = water(face) {
            k.dead_power += power(&push, &Rate { velocity: joint[0], spin });
        }
    }
    for (own, forces) in interfaces.members.iter().zip(forces.iter().skip(interfaces.list.len())) {
        let u = member::power(assembly, own, rates);
        let loss = member::Bounds::of(own).loss(&u);
        k.dissipation += loss.bounded;
        k.slack += loss.endless * member::amounts(forces).norm();
        k.excess += loss.endless;
        if loss.endless > tolerance::ADMISSIBLE * member::fastest(assembly, own, rates)
            || loss.endless.is_nan()
        {
            k.coarse += loss.endless;
        }
        worst = worst.max(loss.endless);
    }
    k.inadmissibility = if fastest > 0.0 { worst / fastest } else { 0.0 };
    k
}

/// The power that a force of 1 N inside the friction cone can have at most against a joint that
/// separates at `normal` and slides at `sliding`, m/s: the size of the projection of the closing
/// velocity onto the cone.
fn hidden(mu: f64, normal: f64, sliding: f64) -> f64 {
    if sliding <= -mu * normal {
        normal.hypot(sliding)
    } else {
        (mu * sliding - normal).max(0.0) / mu.hypot(1.0)
    }
}

/// Power of a wrench on a rate.
pub fn power(w: &Wrench, q: &Rate) -> f64 {
    w.force.dot(&q.velocity) + w.moment.dot(&q.spin)
}
