//! Mechanisms of one degree of freedom in time.
//!
//! Law: `m(q) q̈ + ½ m′(q) q̇² = −V′(q) − a_g(t) · L(q)` ([`law`]), in the frame of the ground. q > 0
//! is the mechanism of one sense, q < 0 that of the other, each with a law of its own; at q = 0 the
//! joints close and an impact hands the speed over: the impulses of the joints do no work on the
//! motion that follows, so that `ω⁺/ω⁻ = (v⁻ᵀ M v⁺)/(v⁺ᵀ M v⁺)` (Housner, Bull. Seism. Soc. Am. 53,
//! 1963, 403–417, for a block). At rest it is held until an acceleration passes its load factor.
//!
//! Pieces of the ground's motion are integrated one by one, and impacts, releases and turning points
//! are found as roots: nothing depends on a step.

pub mod law;
mod options;
mod run;
mod search;
mod step;

pub use law::{Circular, Law, NODES, Table, Values};
pub use options::{RockOptions, RockPoint};
pub use run::{Fate, History, Impact, RunSettings, Sample, run};
pub use search::{Bracket, Scan, Search, scan};

use nalgebra::Vector3;

/// A mechanism in one sense.
#[derive(Clone, Debug, PartialEq)]
pub struct Sense {
    /// Its law from q = 0 up.
    pub law: Law,
    /// Where its law ends: beyond it counts as overturned.
    pub end: f64,
    /// Where its dead loads no longer bring it back; none where they do up to the end.
    pub unstable: Option<f64>,
    /// Numbers at q = 0.
    at_start: Values,
    /// By cell of the range from `unstable` to `end`: the least acceleration of the ground, in any
    /// direction, that could hold it back from there on, m/s².
    holds: Vec<f64>,
}

/// A mechanism with its two senses.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Of q > 0 and of q < 0; where there is none it does not move that way.
    pub senses: [Option<Sense>; 2],
    /// What is left of the speed at an impact that ends the motion in this sense: of the rate of
    /// the other sense, or of its own where there is no other and it bounces.
    pub restitution: [f64; 2],
}

/// Cells between the unstable equilibrium and the end.
const CELLS: usize = 256;

impl Sense {
    /// A mechanism with this law.
    pub fn new(law: Law, end: f64) -> Self {
        let at_start = law.at(0.0);
        let mut sense = Self { law, end, unstable: None, at_start, holds: Vec::new() };
        sense.unstable = sense.find_unstable();
        if let Some(from) = sense.unstable {
            let mut least = f64::INFINITY;
            let width = (end - from) / CELLS as f64;
            let mut holds: Vec<f64> = (0..=CELLS)
                .rev()
                .map(|k| {
                    let v = sense.law.at(from + width * k as f64);
                    // Zero at the equilibrium itself, but for rounding.
                    let drive = if k == 0 { 0.0 } else { -v.resistance };
                    least = least.min(drive / v.grip.norm().max(f64::MIN_POSITIVE));
                    least
                })
                .collect();
            holds.reverse();
            sense.holds = holds;
        }
        sense
    }

    /// The first zero of the resistance.
    fn find_unstable(&self) -> Option<f64> {
        let value = |q: f64| self.law.at(q).resistance;
        let steps = 1000;
        let mut low = 0.0;
        for k in 1..=steps {
            let high = self.end * f64::from(k) / f64::from(steps);
            if value(high) <= 0.0 {
                let mut high = high;
                for _ in 0..200 {
                    let middle = 0.5 * (low + high);
                    if !(low < middle && middle < high) {
                        break;
                    }
                    if value(middle) > 0.0 { low = middle } else { high = middle }
                }
                return Some(high);
            }
            low = high;
        }
        None
    }

    /// The frequency parameter p, 1/s: small motions about the unstable equilibrium go with `exp(±p
    /// t)`. For a block √(3g/4R).
    pub fn frequency(&self) -> Option<f64> {
        let v = self.law.at(self.unstable?);
        Some((-v.stiffness / v.inertia).sqrt()).filter(|p| p.is_finite())
    }

    /// The acceleration of the ground against the first axis, m/s², at which it is released.
    pub fn release(&self) -> f64 {
        self.at_start.resistance / self.at_start.grip.x.abs()
    }

    /// What measures its coordinate: the unstable equilibrium, or its range.
    pub fn scale(&self) -> f64 {
        self.unstable.unwrap_or(self.end)
    }

    /// Whether no acceleration up to `peak` brings it back from here, once it does not move back.
    fn is_beyond_return(&self, q: f64, peak: f64) -> bool {
        let Some(from) = self.unstable.filter(|from| q > *from) else { return false };
        let cell = ((q - from) / (self.end - from) * CELLS as f64) as usize;
        // A cell's worst is between its own ends: the table is finer than what it holds varies.
        self.holds.get(cell).is_some_and(|&holds| holds >= peak)
    }

    /// Drive of an acceleration of the ground at q = 0, N m.
    fn drive(&self, ground: &Vector3<f64>) -> f64 {
        -self.at_start.resistance - ground.dot(&self.at_start.grip)
    }
}
