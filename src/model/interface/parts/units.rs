//! The units that a part is computed in: powers of two, so that changing to them and back changes
//! no digit.
//!
//! With them the greatest load, the greatest block and the strength of gravity are numbers near
//! one, so that no square of a force or of a length under- or overflows, whatever the density; and
//! a part alone is the same numbers as a part among others.

use crate::assembly::{Assembly, Wrench};
use nalgebra::Vector3;

/// What one unit of a part is, in SI, and where its origin lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// N, of contact forces and dead loads.
    pub force: f64,
    /// N, of live loads: a load factor of the part is `force / live` in the scene.
    pub live: f64,
    /// m.
    pub length: f64,
    /// m/s², of gravity.
    pub acceleration: f64,
    /// Scene coordinates of the part's origin, m.
    pub origin: Vector3<f64>,
}

/// A part is moved to an origin of its own along an axis where it is this many times as far from
/// zero as it is wide. Larger: forces at survey coordinates are excused by the rounding of the
/// coordinates. Smaller: nothing is gained.
const FAR: f64 = 64.0;

impl Units {
    /// Units for these free blocks, whose contacts have these points.
    pub(super) fn of(
        assembly: &Assembly,
        free: &[usize],
        points: impl Iterator<Item = Vector3<f64>>,
    ) -> Self {
        let weight = |i: usize| assembly.blocks[i].mass * assembly.gravity.amax();
        let greatest = |loads: &[Wrench]| {
            free.iter().map(|&i| amount(assembly, i, &loads[i])).fold(0.0, f64::max)
        };
        let own = free.iter().map(|&i| weight(i)).fold(greatest(&assembly.dead), f64::max);
        let live = greatest(&assembly.live);
        let force = power_of_two(if own > 0.0 { own } else { live });
        let length =
            power_of_two(free.iter().map(|&i| assembly.blocks[i].size).fold(0.0, f64::max));
        let places: Vec<Vector3<f64>> =
            free.iter().map(|&i| assembly.blocks[i].centroid).chain(points).collect();
        Self {
            force,
            live: if live > 0.0 { power_of_two(live) } else { force },
            length,
            acceleration: power_of_two(assembly.gravity.amax()),
            origin: Vector3::from_fn(|axis, _| origin(places.iter().map(|p| p[axis]))),
        }
    }

    /// A place, from scene coordinates.
    pub fn place(&self, p: &Vector3<f64>) -> Vector3<f64> {
        (p - self.origin) / self.length
    }

    /// A contact force or a dead load, from SI.
    pub fn inward(&self, w: &Wrench) -> Wrench {
        Wrench { force: w.force / self.force, moment: w.moment / self.force / self.length }
    }

    /// A contact force or a dead load, into SI.
    pub fn outward(&self, w: &Wrench) -> Wrench {
        Wrench { force: w.force * self.force, moment: w.moment * self.force * self.length }
    }

    /// A live load, from SI.
    pub(super) fn live(&self, w: &Wrench) -> Wrench {
        Wrench { force: w.force / self.live, moment: w.moment / self.live / self.length }
    }

    /// A load factor of the part as one of the scene.
    pub fn load_factor(&self, own: f64) -> f64 {
        own * (self.force / self.live)
    }

    /// A load factor of the scene as one of the part.
    pub fn own_load_factor(&self, lambda: f64) -> f64 {
        lambda / (self.force / self.live)
    }

    /// A spin of the part, whose speeds are those of the scene, as one of the scene.
    pub fn spin(&self, own: &Vector3<f64>) -> Vector3<f64> {
        own / self.length
    }

    /// A spin of the scene as one of the part.
    pub fn own_spin(&self, spin: &Vector3<f64>) -> Vector3<f64> {
        spin * self.length
    }

    /// Pascals in one unit of stress are `force / length²`: a stress from SI.
    pub(super) fn stress(&self) -> f64 {
        self.length / self.force * self.length
    }
}

/// The size of a load, N, up to a small factor, without squares that could under- or overflow.
fn amount(assembly: &Assembly, block: usize, w: &Wrench) -> f64 {
    w.force.amax().max(assembly.blocks[block].gyration.force(&w.moment).amax())
}

/// The power of two at or below a number; one where there is none.
fn power_of_two(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    let power = f64::from_bits(x.abs().to_bits() & EXPONENT);
    if power.is_normal() { power } else { 1.0 }
}

/// The coordinate nearest to zero where all are far from it beside their spread, else zero. With `y
/// / 2 ≤ x ≤ 2 y` for all of them `x − y` is exact (Sterbenz 1974): moving a part rounds nothing.
fn origin(coordinates: impl Iterator<Item = f64>) -> f64 {
    let (low, high) =
        coordinates.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    let nearest = if low > 0.0 { low } else { high };
    let far = low.is_finite()
        && high.is_finite()
        && low * high > 0.0
        && nearest.abs() > FAR * (high - low);
    if far { nearest } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_and_origins() {
        for (x, power) in [
            (1.0, 1.0),
            (1.5, 1.0),
            (-3.0, 2.0),
            (0.3, 0.25),
            (1e-300, 2f64.powi(-997)),
            (0.0, 1.0),
            (f64::NAN, 1.0),
        ] {
            assert_eq!(power_of_two(x), power, "{x}");
        }
        assert_eq!(origin([5e6, 5e6 + 3.0].into_iter()), 5e6);
        assert_eq!(origin([-5e6, -5e6 - 3.0].into_iter()), -5e6);
        assert_eq!(origin([1.0, 2.0].into_iter()), 0.0);
        assert_eq!(origin([-1.0, 1e-3].into_iter()), 0.0);
        assert_eq!(origin([].into_iter()), 0.0);
    }
}
