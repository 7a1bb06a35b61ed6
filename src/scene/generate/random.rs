//! Random numbers that follow from a seed, to the last bit (PCG-64 XSL RR; O'Neill 2014).
//!
//! * M. E. O'Neill, *PCG: A family of simple fast space-efficient statistically good algorithms for
//!   random number generation*, Harvey Mudd College 2014.

use rand_pcg::{Pcg64, rand_core::Rng};

/// Numbers between 0 and 1 with 53 random bits.
pub(super) struct Random(pub Pcg64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}
