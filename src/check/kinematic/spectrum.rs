//! Elastic spectra of NTC 2018: on the ground (3.2.3.2) and on a floor
//! (Circolare 7/2019, C7.2.3, eqs. C7.2.5 to C7.2.10).

use scene::site::{Building, Spectrum};
use std::f64::consts::TAU;

/// Damping of the ground's spectrum, and of buildings and mechanisms where nothing is said,
/// percent.
pub const DAMPING: f64 = 5.0;

/// By how much damping, in percent, lowers a spectrum: `η = √(10 / (5 + ξ)) ≥ 0.55`.
fn eta(damping: f64) -> f64 {
    (10.0 / (5.0 + damping)).sqrt().max(0.55)
}

/// An elastic spectrum on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// a_g S, m/s²: the acceleration of the ground.
    pub ground: f64,
    /// F0.
    amplification: f64,
    /// T_B, s.
    pub t_b: f64,
    /// T_C, s.
    pub t_c: f64,
    /// T_D, s.
    pub t_d: f64,
}

impl Elastic {
    /// The spectrum with the periods that nobody gave; `gravity` is the scene's, m/s².
    pub fn new(s: &Spectrum, gravity: f64) -> Self {
        let t_c = s.t_c.or_else(|| Some(s.t_c_star? * s.c_c?)).unwrap_or(f64::NAN);
        Self {
            ground: s.a_g * s.s,
            amplification: s.f_0,
            t_b: s.t_b.unwrap_or(t_c / 3.0),
            t_c,
            t_d: s.t_d.unwrap_or(4.0 * s.a_g / gravity + 1.6).max(t_c),
        }
    }

    /// S_e, m/s², at a period, s, and a damping, percent.
    pub fn acceleration(&self, period: f64, damping: f64) -> f64 {
        let eta = eta(damping);
        let top = self.ground * eta * self.amplification;
        let Self { t_b, t_c, t_d, .. } = *self;
        if period < t_b {
            let share = period / t_b;
            top * (share + (1.0 - share) / (eta * self.amplification))
        } else if period < t_c {
            top
        } else if period < t_d {
            top * t_c / period
        } else {
            top * t_c * t_d / (period * period)
        }
    }

    /// S_De, m: `S_e (T / 2π)²`.
    pub fn displacement(&self, period: f64, damping: f64) -> f64 {
        self.acceleration(period, damping) * (period / TAU).powi(2)
    }
}

/// The spectrum at a height of a building, of its first mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// γ1 = 3 n / (2 n + 1), n storeys.
    pub gamma: f64,
    /// ψ1 = z / H.
    pub psi: f64,
    /// a_Z, m/s²: `S_e(T1, ξ1) γ1 ψ1 √(1 + 0.0004 ξ1²)`, ξ1 in percent.
    pub a_z: f64,
    t_1: f64,
    /// Greatest amplification before damping, where it is given.
    amplification: Option<f64>,
}

impl Floor {
    /// The spectrum at the height that the building is asked about.
    pub fn new(b: &Building, ground: &Elastic) -> Self {
        let xi = b.damping_percent.unwrap_or(DAMPING);
        let n = f64::from(b.storeys);
        let (gamma, psi) = (3.0 * n / (2.0 * n + 1.0), b.z / b.height);
        let a_z = ground.acceleration(b.t_1, xi) * gamma * psi * (1.0 + 0.0004 * xi * xi).sqrt();
        Self { gamma, psi, a_z, t_1: b.t_1, amplification: b.amplification }
    }

    /// S_eZ, m/s², at a period, s, and a damping of the mechanism, percent (a = 0.8 and b = 1.1
    /// of C7.2.3); nothing without the amplification. Below T1 it is at least the ground's own
    /// spectrum.
    pub fn acceleration(&self, period: f64, damping: f64, ground: &Elastic) -> Option<f64> {
        const A: f64 = 0.8;
        const B: f64 = 1.1;
        let top = self.amplification? * eta(damping);
        let ratio = period / self.t_1;
        let share = if ratio < A {
            top / (1.0 + (top - 1.0) * (1.0 - ratio / A).max(0.0).powf(1.6))
        } else if ratio < B {
            top
        } else {
            top / (1.0 + (top - 1.0) * (ratio / B - 1.0).powf(1.2))
        };
        let floor = self.a_z * share;
        Some(if period <= self.t_1 {
            floor.max(ground.acceleration(period, damping))
        } else {
            floor
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spectrum() -> Spectrum {
        Spectrum {
            a_g: 3.0,
            f_0: 2.4,
            s: 1.2,
            t_c_star: None,
            c_c: None,
            t_c: Some(0.45),
            t_b: None,
            t_d: None,
        }
    }

    #[test]
    fn branches_meet() {
        let e = Elastic::new(&spectrum(), 9.81);
        assert!((e.acceleration(0.0, 5.0) - 3.6).abs() < 1e-12);
        for t in [e.t_b, e.t_c, e.t_d] {
            let [a, b] = [t * (1.0 - 1e-12), t].map(|t| e.acceleration(t, 8.0));
            assert!((a - b).abs() < 1e-9 * a);
        }
        assert!((e.t_d - (4.0 * 3.0 / 9.81 + 1.6)).abs() < 1e-12);
    }

    /// Circolare 7/2019, eqs. C7.2.5 to C7.2.10, by hand: three storeys, two thirds up, S_e(T1) =
    /// 0.72 g.
    #[test]
    fn accelerations_of_floors() {
        let g = 9.81;
        let ground = Elastic::new(&Spectrum { a_g: 0.3 * g, s: 1.0, ..spectrum() }, g);
        let mut b = Building {
            t_1: 0.3,
            storeys: 3,
            height: 9.0,
            z: 6.0,
            damping_percent: None,
            amplification: None,
        };
        let floor = Floor::new(&b, &ground);
        assert!((floor.gamma - 9.0 / 7.0).abs() < 1e-15);
        assert!((floor.a_z / g - 0.620_220_9).abs() < 1e-7);
        assert_eq!(floor.acceleration(0.3, 8.0, &ground), None);
        b.amplification = Some(1.1 / 0.05_f64.sqrt());
        let top = Floor::new(&b, &ground).acceleration(0.3, 8.0, &ground);
        assert!(top.is_some_and(|a| (a / g - 2.6758).abs() < 1e-3));
    }
}
