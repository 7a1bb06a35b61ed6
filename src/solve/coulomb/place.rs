//! Places on curves of rounded laws, and what the next curve has in common with the last.

use super::newton::dot;

/// The change of a rate, in displacements of joints under a mean load, that is as long as the same
/// of `s`. More: the curve turns too sharply for its steps. Less: more of them.
pub const LENGTH: f64 = 30.0;

/// A place on a curve, or a way along it.
#[derive(Clone)]
pub struct Place {
    pub rates: Vec<f64>,
    /// The logarithm of the rounding.
    pub s: f64,
}

impl Place {
    pub fn dot(&self, other: &Self) -> f64 {
        dot(&self.rates, &other.rates) / (LENGTH * LENGTH) + self.s * other.s
    }

    pub fn on(&self, way: &Self, by: f64) -> Self {
        Self { rates: along(&self.rates, &way.rates, by), s: self.s + by * way.s }
    }
}

/// A place with the way and the step that it was left with.
#[derive(Clone)]
pub struct Passed {
    pub place: Place,
    pub way: Place,
    pub step: f64,
}

/// The curve that was followed to an ε, up to where it depends on that ε.
#[derive(Default)]
pub struct Trunk {
    /// Drag at its start.
    pub drag: f64,
    pub places: Vec<Passed>,
}

/// The way on of length one, towards sharper corners at the start.
pub fn unit(along_s: Vec<f64>, before: Option<&Place>) -> Place {
    let way = Place { rates: along_s, s: 1.0 };
    let onwards = before.map_or(-1.0, |before| way.dot(before));
    let by = way.dot(&way).sqrt().recip().copysign(onwards);
    Place { rates: way.rates.iter().map(|r| by * r).collect(), s: by }
}

pub fn along(from: &[f64], way: &[f64], by: f64) -> Vec<f64> {
    from.iter().zip(way).map(|(from, way)| from + by * way).collect()
}
