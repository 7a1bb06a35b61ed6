//! The random numbers of studies: number *i* of a scene depends on (seed, scene, *i*) alone.

use nalgebra::Vector3;
use rand_pcg::{
    Pcg64,
    rand_core::{Rng, SeedableRng},
};

/// Random numbers of one scene.
pub(crate) struct Random(Pcg64);

impl Random {
    /// The numbers of scene `index` of the stream `seed`.
    pub fn of(seed: u64, index: usize) -> Self {
        let mut stream = Pcg64::seed_from_u64(seed);
        // A stretch of the stream for every scene, longer than any needs.
        stream.advance(index as u128 * (1 << 32));
        Self(stream)
    }

    /// The same for a second use of the same scene, which the first one does not change.
    pub fn apart(seed: u64, index: usize) -> Self {
        let mut stream = Self::of(seed, index);
        stream.0.advance(1 << 31);
        stream
    }

    /// Between 0 and 1, with 53 random bits.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Evenly over decades.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low, high))
    }

    /// A whole number, both ends included.
    pub fn count(&mut self, low: usize, high: usize) -> usize {
        low + ((high - low + 1) as f64 * self.unit()) as usize
    }

    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-1.0, 1.0))
    }
}
