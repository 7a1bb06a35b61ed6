//! Re-adding forces and powers block by block.
//!
//! *Static side.* Contact forces inside their friction cones leave each free block the wrench
//! `r_i = w_i + λ ℓ_i + Σ` contact wrenches. Its size is `max(‖force‖, ‖moment‖ / (size / 2))`-like: the norm of (force; moment / L)
//! over the block's load, in multiples of g. *Kinematic side.* Rates `q` separate the contacts at `v`; for every
//! admissible force `f·v ≥ −e f_n` with `e = max(0, μ‖v_t‖ − v_n)`, the inadmissibility. So for any equilibrium
//! `w·q + λ ℓ·q ≤ Σ e f_n`: a mechanism with `e = 0` that gains power proves instability (Heyman 1966; Livesley 1978).

use super::{Forces, Rate};
use crate::{
    assembly::{Assembly, Wrench},
    interface::Interfaces,
    scene::Friction,
    tolerance,
};
use nalgebra::Vector3;

/// Force scale of a free block, N: the greater of its weight and its dead load.
pub fn load_scale(assembly: &Assembly, block: usize) -> f64 {
    assembly.weight(block).max(assembly.dead[block].force.norm())
}

/// Length scale of a block's moments, m.
pub fn length_scale(assembly: &Assembly, block: usize) -> f64 {
    0.5 * assembly.blocks[block].size
}

/// What forces leave unbalanced.
#[derive(Clone, Debug)]
pub struct Statics {
    /// Wrench left on each block, N and N·m; zero on supports.
    pub residuals: Vec<Wrench>,
    /// Largest unbalance over the free blocks, in multiples of the block's load (g).
    pub unbalance: f64,
    /// The block of the largest unbalance.
    pub worst: usize,
    /// What rounding of coordinates and forces alone can amount to on any block, in multiples of its load.
    pub resolution: f64,
    /// Largest distance of a force outside its friction cone, over that very force: a large force elsewhere makes no room for
    /// a small one that pulls.
    pub cone_excess: f64,
    /// Whether every block is balanced, each up to [`tolerance::UNBALANCE`] or what rounding of its own forces amounts to.
    pub balanced: bool,
}

/// Re-adds the contact forces at load factor `lambda`.
pub fn statics(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces, lambda: f64) -> Statics {
    let n = assembly.blocks.len();
    let mut residuals: Vec<Wrench> = (0..n)
        .map(|i| Wrench {
            force: assembly.dead[i].force + assembly.live[i].force * lambda,
            moment: assembly.dead[i].moment + assembly.live[i].moment * lambda,
        })
        .collect();
    let mut rounding: Vec<f64> = residuals.iter().map(|r| r.force.norm()).collect();
    let most = tolerance::ROUNDING_FORCE * assembly.free().map(|i| load_scale(assembly, i)).sum::<f64>();
    let mut excess = 0.0_f64;
    for (face, forces) in interfaces.list.iter().zip(forces) {
        for (point, force) in face.points.iter().zip(forces) {
            let normal = face.frame.n.dot(force);
            let shear = (force - face.frame.n * normal).norm();
            let outside = match face.friction {
                Friction::Coefficient(mu) => (-normal).max((shear - mu * normal) / mu.hypot(1.0)),
                Friction::Infinite => -normal,
            };
            // A NaN is as far outside as can be.
            if outside.is_nan() {
                excess = f64::INFINITY;
            } else if outside > 0.0 {
                excess = excess.max(outside / force.norm());
            }
            for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
                let arm = point - assembly.blocks[block].centroid;
                residuals[block] += Wrench { force: force * sign, moment: arm.cross(force) * sign };
                rounding[block] += force.norm().min(most) * (1.0 + point.amax() / length_scale(assembly, block));
            }
        }
    }
    let (mut unbalance, mut worst, mut resolution, mut balanced) = (0.0, 0, 0.0_f64, true);
    for i in 0..n {
        if assembly.blocks[i].support {
            residuals[i] = Wrench::zero();
            continue;
        }
        let u = size(assembly, i, &residuals[i]) / load_scale(assembly, i);
        let rounding = (ROUNDING * rounding[i] / load_scale(assembly, i)).min(tolerance::RESOLUTION);
        resolution = resolution.max(rounding);
        balanced &= u <= tolerance::UNBALANCE.max(rounding);
        // A NaN is the worst there is, and stays.
        if (u > unbalance || u.is_nan()) && !f64::is_nan(unbalance) {
            (unbalance, worst) = (u, i);
        }
    }
    Statics { residuals, unbalance, worst, resolution, cone_excess: excess, balanced }
}

/// Rounding counted per addition: one unit in the last place.
const ROUNDING: f64 = f64::EPSILON;

fn size(assembly: &Assembly, block: usize, w: &Wrench) -> f64 {
    w.force.norm().hypot(w.moment.norm() / length_scale(assembly, block))
}

/// What a set of rates gains and where it is inadmissible.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// Power of the dead load, `w·q`.
    pub dead_power: f64,
    /// Power of the live load, `ℓ·q`.
    pub live_power: f64,
    /// `Σ` load scale × ‖(velocity; spin × L)‖ over the free blocks: the power that an unbalance of 1 g everywhere would have.
    pub norm: f64,
    /// `Σ e f_n` with the given forces: the power that the inadmissibility may hide.
    pub slack: f64,
    /// Largest inadmissibility `e` over the fastest speed at a contact.
    pub inadmissibility: f64,
    /// `Σ e`: with contact forces of at most `F` each, the inadmissibility hides at most `F` × this.
    pub excess: f64,
    /// The part of `excess` from contacts where `e` is more than rounding of the speeds of the two blocks
    /// ([`tolerance::ADMISSIBLE`]): blocks that should rest, or joints that are made to close.
    pub coarse: f64,
}

impl Kinematics {
    /// Unless some contact force exceeds this many times the total load, the gain of the dead load cannot be balanced:
    /// what makes a mechanism that is admissible only up to rounding a proof.
    pub fn force_cap(&self, assembly: &Assembly) -> f64 {
        let total: f64 = assembly.free().map(|i| load_scale(assembly, i)).sum();
        self.dead_power / (self.excess * total)
    }

    /// Whether the mechanism is admissible up to rounding: small against its gain for contact forces of the size of the total
    /// load, and, where it is not small against the speeds of the very blocks that touch, for much larger ones. A block
    /// squeezed at low friction needs large forces; falling straight down closes none of its joints by much.
    pub fn is_admissible(&self, assembly: &Assembly) -> bool {
        let coarse = Self { excess: self.coarse, ..self.clone() };
        self.force_cap(assembly) >= tolerance::FORCE_CAP
            && (self.coarse == 0.0 || coarse.force_cap(assembly) >= tolerance::COARSE_FORCE_CAP)
    }
}

/// Re-adds powers; `forces` weigh the inadmissibility.
pub fn kinematics(assembly: &Assembly, interfaces: &Interfaces, rates: &[Rate], forces: &Forces) -> Kinematics {
    let mut k = Kinematics { dead_power: 0.0, live_power: 0.0, norm: 0.0, slack: 0.0, inadmissibility: 0.0, excess: 0.0, coarse: 0.0 };
    for i in assembly.free() {
        let (q, w, l) = (&rates[i], &assembly.dead[i], &assembly.live[i]);
        k.dead_power += power(w, q);
        k.live_power += power(l, q);
        k.norm += load_scale(assembly, i) * q.velocity.norm().hypot(q.spin.norm() * length_scale(assembly, i));
    }
    let speed = |i: usize, p: &Vector3<f64>| at(assembly, rates, i, p).norm();
    let (mut worst, mut fastest) = (0.0_f64, 0.0_f64);
    for (face, forces) in interfaces.list.iter().zip(forces) {
        for (point, force) in face.points.iter().zip(forces) {
            let v = at(assembly, rates, face.b, point) - at(assembly, rates, face.a, point);
            let (vn, fn_) = (face.frame.n.dot(&v), face.frame.n.dot(force).max(0.0));
            let vt = (v - face.frame.n * vn).norm();
            let (e, cost) = match face.friction {
                Friction::Coefficient(mu) => {
                    let e = (mu * vt - vn).max(0.0);
                    k.excess += e;
                    (e / mu.hypot(1.0), e * fn_)
                }
                Friction::Infinite => {
                    let closing = (-vn).max(0.0);
                    k.excess += closing + vt;
                    (closing.hypot(vt), closing * fn_ + vt * (force - face.frame.n * fn_).norm())
                }
            };
            let local = speed(face.a, point).max(speed(face.b, point));
            if e > tolerance::ADMISSIBLE * local || e.is_nan() {
                k.coarse += e;
            }
            k.slack += cost;
            worst = worst.max(e);
            fastest = fastest.max(local);
        }
    }
    k.inadmissibility = if fastest > 0.0 { worst / fastest } else { 0.0 };
    k
}

/// Velocity of a point moving with a block.
pub fn at(assembly: &Assembly, rates: &[Rate], block: usize, point: &Vector3<f64>) -> Vector3<f64> {
    let q = &rates[block];
    q.velocity + q.spin.cross(&(point - assembly.blocks[block].centroid))
}

/// Power of a wrench on a rate.
pub fn power(w: &Wrench, q: &Rate) -> f64 {
    w.force.dot(&q.velocity) + w.moment.dot(&q.spin)
}

/// How exactly forces and rates obey Signorini's and Coulomb's laws together: the natural map
/// `‖f − P_K(f − ρ (u + μ‖u_t‖ n))‖ / F` over all contact points (Acary, Brémond & Huber 2018), zero for an exact solution.
///
/// `u` are the rates of the joints. The law does not change when `u` is multiplied, so `ρ` brings `u` to the size `F` of the
/// forces, the greater of `‖f‖` and the norm of the dead loads: a measure without units. `None` where nothing moves.
pub fn natural_map(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces, rates: &[Rate]) -> Option<f64> {
    let loads: f64 = assembly.free().map(|i| assembly.dead[i].force.norm_squared()).sum();
    let size = forces.iter().flatten().map(Vector3::norm_squared).sum::<f64>().max(loads).sqrt();
    let joint = |face: &crate::interface::Interface, p: &Vector3<f64>| at(assembly, rates, face.b, p) - at(assembly, rates, face.a, p);
    let speed = interfaces.list.iter().flat_map(|face| face.points.iter().map(move |p| joint(face, p).norm_squared())).sum::<f64>().sqrt();
    if speed == 0.0 {
        return None;
    }
    let mut sum = 0.0;
    for (face, forces) in interfaces.list.iter().zip(forces) {
        for (point, force) in face.points.iter().zip(forces) {
            let u = joint(face, point) * (size / speed);
            let n = face.frame.n;
            let slide = (u - n * n.dot(&u)).norm();
            let shift = match face.friction {
                Friction::Coefficient(mu) => mu * slide,
                Friction::Infinite => 0.0,
            };
            sum += (force - onto_cone(force - u - n * shift, n, face.friction)).norm_squared();
        }
    }
    Some(sum.sqrt() / size)
}

/// The point of the friction cone about `n` nearest to `f`.
pub fn onto_cone(f: Vector3<f64>, n: Vector3<f64>, friction: Friction) -> Vector3<f64> {
    let normal = n.dot(&f);
    let tangential = f - n * normal;
    let Friction::Coefficient(mu) = friction else { return tangential + n * normal.max(0.0) };
    let t = tangential.norm();
    if t <= mu * normal {
        return f;
    }
    if mu * t <= -normal {
        return Vector3::zeros();
    }
    let on = (normal + mu * t) / (1.0 + mu * mu);
    n * on + tangential * (mu * on / t)
}

/// The motion that contact forces leave the blocks in.
#[derive(Clone, Debug)]
pub struct Released {
    /// Largest acceleration, in multiples of gravity ([`Statics::unbalance`]).
    pub acceleration: f64,
    /// How far forces and motion are from Coulomb's law together ([`natural_map`]).
    pub natural_map: f64,
    /// The motion, each block's unbalance over the square of its load scale.
    pub rates: Vec<Rate>,
}

/// The motion that starts from rest under contact forces, and how exactly the two obey Coulomb's law.
///
/// Each block moves by its own unbalance; a block's inertia is taken as its load scale squared, in force and, with its length
/// scale, in moment. The law of contact does not depend on that choice, only the speeds do.
pub fn motion(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces) -> Released {
    let s = statics(assembly, interfaces, forces, 0.0);
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    for i in assembly.free() {
        let (w, l) = (load_scale(assembly, i), length_scale(assembly, i));
        rates[i] = Rate { velocity: s.residuals[i].force / (w * w), spin: s.residuals[i].moment / (w * l * w * l) };
    }
    let natural_map = natural_map(assembly, interfaces, forces, &rates).unwrap_or(f64::INFINITY);
    Released { acceleration: s.unbalance, natural_map, rates }
}
