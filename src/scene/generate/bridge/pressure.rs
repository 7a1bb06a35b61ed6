//! How a load on the road is distributed where it meets the extrados.

use crate::template::Distribution;

/// The vertical pressure under a patch, at one depth, cut off at a length.
pub struct Pressure {
    distribution: Distribution,
    /// Half of the patch, m.
    half: f64,
    /// Depth below the road, m.
    depth: f64,
    /// What it is spread over, m.
    length: f64,
}

impl Pressure {
    pub fn new(distribution: Distribution, patch: f64, depth: f64, length: f64) -> Self {
        Self { distribution, half: 0.5 * patch, depth, length }
    }

    /// The part of a load in the middle of `at` that presses between two places within the length:
    /// where it acts, and which share of the load it is. The parts of the length add up to the load.
    pub fn between(&self, at: f64, from: f64, to: f64) -> (f64, f64) {
        let even = (0.5 * (from + to), (to - from) / self.length);
        match self.distribution {
            Distribution::Even => even,
            Distribution::Boussinesq => {
                let end = 0.5 * self.length;
                let whole = self.sum(end)[0] - self.sum(-end)[0];
                let [a, b] = [self.sum(from - at), self.sum(to - at)];
                let part = b[0] - a[0];
                // A sliver of a chord, in which the differences are rounding alone.
                if part > f64::EPSILON.sqrt() * whole {
                    ((at + (b[1] - a[1]) / part).clamp(from, to), part / whole)
                } else {
                    even
                }
            }
        }
    }

    /// Integrals of the pressure, and of it times the place, from any fixed place to x (about the
    /// patch's middle), for a pressure of π on the road. Under a strip of half width b the pressure
    /// is atan((x + b)/z) − atan((x − b)/z) + z (x + b)/(z² + (x + b)²) − z (x − b)/(z² + (x − b)²)
    /// (J. Boussinesq 1885; H. G. Poulos and E. H. Davis, *Elastic solutions for soil and rock
    /// mechanics*, 1974, section 3.1). With u = x ± b one half of it has the integrals u atan(u/z)
    /// and (u² − z²)/2 atan(u/z) + z u/2, of it and of u times it.
    fn sum(&self, x: f64) -> [f64; 2] {
        let (b, z) = (self.half, self.depth);
        let part = |u: f64| {
            let angle = u.atan2(z);
            [u * angle, 0.5 * ((u * u - z * z) * angle + z * u)]
        };
        let (p, m) = (part(x + b), part(x - b));
        [p[0] - m[0], p[1] - b * p[0] - (m[1] + b * m[0])]
    }
}
