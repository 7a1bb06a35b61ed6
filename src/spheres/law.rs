//! The law of a contact: Hertz and Mindlin, viscous damping, Coulomb, rolling resistance.
//!
//! With the overlap δ, the reduced radius R* = R₁ R₂ / (R₁ + R₂), the reduced mass m*, the moduli
//! 1/E* = 2 (1 − ν²) / E and 1/G* = 4 (2 − ν)(1 + ν) / E, and the radius of contact a = √(R* δ):
//!
//! * normal force `f_n = 4/3 E* a δ − c_n u_n ≥ 0`, stiffness `S_n = 2 E* a` (Hertz 1882);
//! * tangential spring of stiffness `S_t = 8 G* a` (Mindlin 1949), as an increment `S_t u_t dt` of a
//!   force that turns with the contact and shrinks with `S_t` when the contact unloads, so that no
//!   cycle of loads gains energy (Elata & Berryman 1996; Thornton, Cummins & Cleary 2013); bounded by
//!   `μ f_n`;
//! * dashpots `c = 2 √(5/6) β √(S m*)`, which make the coefficient of restitution independent of
//!   the speed of impact (Tsuji, Tanaka & Ishida 1992; Antypov & Elliott 2011). Their β(e) lets
//!   contacts pull as they part; here they do not, and [`Law::new`] finds β by integrating an impact;
//! * rolling: an elastic–plastic spring with a dashpot, model C of Ai et al. (2011): stiffness
//!   `k_r = 2.25 k_n c²`, `k_n = f_n / δ` of the elastic force, bounded by `c f_n`, where
//!   c = μ_r R* is the rolling arm; the dashpot `2 η √(I_r k_r)` acts below the bound.
//!
//! Sources:
//!
//! * H. Hertz, *Über die Berührung fester elastischer Körper*, J. reine angew. Math. 92 (1882) 156.
//! * R. D. Mindlin, *Compliance of elastic bodies in contact*, J. Applied Mechanics 16 (1949) 259.
//! * Y. Tsuji, T. Tanaka, T. Ishida, *Lagrangian numerical simulation of plug flow of cohesionless
//!   particles in a horizontal pipe*, Powder Technology 71 (1992) 239.
//! * D. Antypov, J. A. Elliott, *On an analytical solution for the damped Hertzian spring*, EPL 94
//!   (2011) 50004.
//! * D. Elata, J. G. Berryman, *Contact force-displacement laws and the mechanical behavior of random
//!   packs of identical spheres*, Mechanics of Materials 24 (1996) 229.
//! * C. Thornton, S. J. Cummins, P. W. Cleary, *An investigation of the comparative behaviour of
//!   alternative contact force models during inelastic collisions*, Powder Technology 233 (2013) 30.
//! * J. Ai, J.-F. Chen, J. M. Rotter, J. Y. Ooi, *Assessment of rolling resistance models in discrete
//!   element simulations*, Powder Technology 206 (2011) 269.

use nalgebra::Vector3;

/// Share of critical damping of the rolling spring (Ai et al. 2011, section 4).
const ROLLING_DAMPING: f64 = 0.3;
/// Steps of an impact by which damping is found, over the time in which the speed would cross the
/// overlap. Fewer: restitution is off in its third digit.
const IMPACT: f64 = 1e-3;

/// What all grains and walls are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Coefficient of normal restitution e wanted, 0 to 1.
    pub restitution: f64,
}

/// How much two surfaces rub.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Coefficient μ.
    pub coefficient: f64,
    /// Rolling arm c, m.
    pub arm: f64,
}

/// The law, with its constants worked out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// S_n / a, Pa.
    pub(crate) normal: f64,
    /// S_t / a, Pa.
    tangential: f64,
    /// c_n / √(a m*), √Pa.
    normal_damping: f64,
    /// c_t / √(a m*), √Pa.
    tangential_damping: f64,
    /// The coefficient of restitution that is reached: the one wanted, unless that is below what
    /// critical damping leaves.
    pub restitution: f64,
}

/// What a contact remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Memory {
    /// Tangential spring, the force on the second body, N.
    pub spring: Vector3<f64>,
    /// Rolling spring, the couple on the second body, N m.
    pub couple: Vector3<f64>,
    /// Radius of contact in the last step, m; 0 where there was none.
    pub radius: f64,
}

/// Two bodies that touch.
pub(crate) struct Pair {
    /// Unit vector from the first to the second.
    pub normal: Vector3<f64>,
    /// Overlap, m.
    pub overlap: f64,
    /// R*, m.
    pub radius: f64,
    /// m*, kg.
    pub mass: f64,
    /// Velocity of the second body's surface at the contact relative to the first's, m/s.
    pub velocity: Vector3<f64>,
    /// Spin of the first relative to the second, rad/s.
    pub rolling: Vector3<f64>,
    /// Mean spin of both, rad/s.
    pub turning: Vector3<f64>,
    /// Reduced moment of inertia about the contact, kg m²; used where there is a rolling arm.
    pub inertia: f64,
}

/// Force and rolling couple on the second body; the first has the opposite ones.
pub(crate) struct Effort {
    pub force: Vector3<f64>,
    pub couple: Vector3<f64>,
    /// S_n / m*, 1/s².
    pub stiffness: f64,
}

impl Law {
    /// The law of a material.
    pub fn new(material: &Material) -> Self {
        let Material { young, poisson, restitution } = *material;
        let (beta, restitution) = damping(restitution);
        let normal = young / (1.0 - poisson * poisson);
        let tangential = 2.0 * young / ((2.0 - poisson) * (1.0 + poisson));
        let dashpot = 2.0 * (5.0 / 6.0_f64).sqrt() * beta;
        Self {
            normal,
            tangential,
            normal_damping: dashpot * normal.sqrt(),
            tangential_damping: dashpot * tangential.sqrt(),
            restitution,
        }
    }

    /// Overlap of two equal spheres of diameter d, m, that are pressed together by a force, N.
    pub fn overlap(&self, diameter: f64, force: f64) -> f64 {
        (force / (2.0 / 3.0 * self.normal * (0.25 * diameter).sqrt())).powf(2.0 / 3.0)
    }

    /// Period of two equal spheres of mass m, kg, that oscillate about that overlap, s.
    pub fn period(&self, diameter: f64, mass: f64, force: f64) -> f64 {
        let stiffness =
            self.normal * (0.25 * diameter * self.overlap(diameter, force)).sqrt() / (0.5 * mass);
        std::f64::consts::TAU / stiffness.sqrt()
    }

    /// One step of a contact.
    #[inline]
    pub(crate) fn step(
        &self,
        pair: &Pair,
        friction: &Friction,
        dt: f64,
        memory: &mut Memory,
    ) -> Effort {
        let n = pair.normal;
        let a = (pair.radius * pair.overlap).sqrt();
        let dashpot = (a * pair.mass).sqrt();
        let approach = pair.velocity.dot(&n);
        let tangential = pair.velocity - n * approach;
        let elastic = 2.0 / 3.0 * self.normal * a * pair.overlap;
        let normal_force = (elastic - self.normal_damping * dashpot * approach).max(0.0);
        let bound = friction.coefficient * normal_force;
        let mut force = Vector3::zeros();
        if bound > 0.0 {
            turn(&mut memory.spring, &n, pair, dt);
            if a < memory.radius {
                memory.spring *= a / memory.radius;
            }
            memory.spring -= tangential * (self.tangential * a * dt);
            if !bounded(&mut memory.spring, bound) {
                force = memory.spring - tangential * (self.tangential_damping * dashpot);
                bounded(&mut force, bound);
            } else {
                force = memory.spring;
            }
        } else {
            memory.spring = Vector3::zeros();
        }
        memory.radius = a;
        let mut couple = Vector3::zeros();
        if friction.arm > 0.0 {
            couple = self.roll(pair, friction.arm, [elastic, normal_force], dt, memory);
        }
        Effort { force: force + n * normal_force, couple, stiffness: self.normal * a / pair.mass }
    }

    fn roll(
        &self,
        pair: &Pair,
        arm: f64,
        [elastic, normal_force]: [f64; 2],
        dt: f64,
        memory: &mut Memory,
    ) -> Vector3<f64> {
        let n = pair.normal;
        let rate = pair.rolling - n * pair.rolling.dot(&n);
        let stiffness = 2.25 * elastic / pair.overlap * arm * arm;
        turn(&mut memory.couple, &n, pair, dt);
        memory.couple += rate * (stiffness * dt);
        if bounded(&mut memory.couple, arm * normal_force) {
            return memory.couple;
        }
        let dashpot = 2.0 * ROLLING_DAMPING * (pair.inertia * stiffness).sqrt();
        memory.couple + rate * dashpot
    }
}

/// Turns what lies in the plane of contact with the plane and with the mean spin about its normal.
#[inline]
fn turn(vector: &mut Vector3<f64>, n: &Vector3<f64>, pair: &Pair, dt: f64) {
    let before = vector.norm_squared();
    if before == 0.0 {
        return;
    }
    *vector += n.cross(vector) * (pair.turning.dot(n) * dt);
    *vector -= n * vector.dot(n);
    let after = vector.norm_squared();
    if after > 0.0 {
        *vector *= (before / after).sqrt();
    }
}

/// Shortens a vector to a bound; whether it was longer.
#[inline]
fn bounded(vector: &mut Vector3<f64>, bound: f64) -> bool {
    let norm = vector.norm_squared();
    let longer = norm > bound * bound;
    if longer {
        *vector *= bound / norm.sqrt();
    }
    longer
}

/// Share β of critical damping that gives a coefficient of restitution, and the one that it gives:
/// more than the one wanted where that asks for more than critical damping, which no step in time
/// would follow.
fn damping(wanted: f64) -> (f64, f64) {
    let (mut low, mut high) = (0.0, 1.0);
    let least = rebound(high);
    if wanted <= least {
        return (high, least);
    }
    if wanted >= 1.0 {
        return (low, 1.0);
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if rebound(middle) > wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low, wanted)
}

/// Speed after an impact over that before: x″ = −x^{3/2} − √5 β x^{1/4} x′ from x = 0, x′ = 1, until
/// the force vanishes (Antypov & Elliott 2011, equation 5, without their attraction).
fn rebound(beta: f64) -> f64 {
    let force = |x: f64, v: f64| {
        let x = x.max(0.0);
        x * x.sqrt() + 5.0_f64.sqrt() * beta * x.sqrt().sqrt() * v
    };
    let (mut x, mut v) = (0.0, 1.0);
    loop {
        let h = IMPACT;
        let (v1, a1) = (v, -force(x, v));
        let (v2, a2) = (v + 0.5 * h * a1, -force(x + 0.5 * h * v1, v + 0.5 * h * a1));
        let (v3, a3) = (v + 0.5 * h * a2, -force(x + 0.5 * h * v2, v + 0.5 * h * a2));
        let (v4, a4) = (v + h * a3, -force(x + h * v3, v + h * a3));
        x += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        if v < 0.0 && force(x, v) <= 0.0 || x <= 0.0 {
            return -v;
        }
    }
}
