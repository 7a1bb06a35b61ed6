//! The motion of the ground: pieces in which its acceleration is a line or a sine, and jumps of its
//! velocity.

use nalgebra::Vector3;

/// A stretch of time with one formula for the acceleration, m/s² along three axes: the direction
/// asked about, the horizontal one to its left, and up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// When it begins, s.
    pub start: f64,
    /// When it ends, s.
    pub end: f64,
    /// The formula.
    pub shape: Shape,
}

/// How the acceleration goes in a piece; `t` counts from its start, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// `from + slope t`.
    Line {
        /// At the start, m/s².
        from: Vector3<f64>,
        /// Its growth, m/s³.
        slope: Vector3<f64>,
    },
    /// `amplitude sin(omega t + phase)`.
    Sine {
        /// m/s².
        amplitude: Vector3<f64>,
        /// rad/s.
        omega: f64,
        /// rad.
        phase: f64,
    },
}

/// When the velocity of the ground jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// At this time, s.
    At(f64),
    /// Just after the first landing (the critical double impulse of Nabeshima, Taniguchi, Kojima &
    /// Takewaki, Front. Built Environ. 2:9, 2016).
    FirstLanding,
}

/// A jump of the velocity of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// When.
    pub when: When,
    /// By how much, m/s, along the axes of [`Piece`].
    pub by: Vector3<f64>,
}

/// A motion of the ground, at rest outside of its pieces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// In order of time, without overlap.
    pub pieces: Vec<Piece>,
    /// In order of time, what waits for a landing last.
    pub jumps: Vec<Jump>,
}

/// Samples at even times, linear between them.
pub(super) fn lines(step: f64, samples: &[Vector3<f64>]) -> Motion {
    let pieces = samples
        .windows(2)
        .enumerate()
        .map(|(k, pair)| Piece {
            start: step * k as f64,
            end: step * (k + 1) as f64,
            shape: Shape::Line { from: pair[0], slope: (pair[1] - pair[0]) / step },
        })
        .collect();
    Motion { pieces, jumps: Vec::new() }
}

impl Piece {
    /// The acceleration at a time from its start, m/s².
    pub fn at(&self, t: f64) -> Vector3<f64> {
        match self.shape {
            Shape::Line { from, slope } => from + slope * t,
            Shape::Sine { amplitude, omega, phase } => amplitude * (omega * t + phase).sin(),
        }
    }

    /// What the velocity gains between two times from its start, m/s.
    fn velocity(&self, from: f64, to: f64) -> Vector3<f64> {
        match self.shape {
            Shape::Line { from: a, slope } => (a + slope * (0.5 * (from + to))) * (to - from),
            Shape::Sine { amplitude, omega, phase } => {
                // cos a − cos b without cancellation.
                let (half, middle) = (0.5 * omega * (to - from), 0.5 * omega * (to + from) + phase);
                amplitude * (2.0 * half.sin() * middle.sin() / omega)
            }
        }
    }

    /// A bound of the acceleration in it, m/s².
    pub fn peak(&self) -> f64 {
        match self.shape {
            Shape::Line { from, .. } => from.norm().max(self.at(self.end - self.start).norm()),
            Shape::Sine { amplitude, .. } => amplitude.norm(),
        }
    }

    /// The earliest time from its start, not before `after`, at which `limit + by · a` is above
    /// zero; none where it never is. Where it crosses zero it is the crossing.
    pub fn exceeds(&self, after: f64, limit: f64, by: &Vector3<f64>) -> Option<f64> {
        let last = self.end - self.start;
        let value = |t: f64| limit + by.dot(&self.at(t));
        if after >= last {
            return None;
        }
        if value(after) > 0.0 {
            return Some(after);
        }
        match self.shape {
            Shape::Line { from, slope } => {
                let growth = by.dot(&slope);
                let at = -(limit + by.dot(&from)) / growth;
                (growth > 0.0 && at < last).then(|| at.max(after))
            }
            Shape::Sine { amplitude, omega, phase: first } => {
                // limit + c sin φ = 0, on the way up.
                let c = by.dot(&amplitude);
                let ratio = -limit / c;
                if ratio.is_nan() || ratio.abs() >= 1.0 {
                    return None;
                }
                let turn = std::f64::consts::TAU;
                let phase =
                    if c > 0.0 { ratio.asin() } else { std::f64::consts::PI - ratio.asin() };
                let rounds = ((omega * after + first - phase) / turn).ceil();
                let at = (phase - first + turn * rounds) / omega;
                let at = if at < after { at + turn / omega } else { at };
                (at < last).then_some(at)
            }
        }
    }
}

impl Motion {
    /// When the last piece or jump is over, s.
    pub fn end(&self) -> f64 {
        let jumps = self.jumps.iter().map(|j| if let When::At(t) = j.when { t } else { 0.0 });
        self.pieces.iter().map(|p| p.end).chain(jumps).fold(0.0, f64::max)
    }

    /// What the velocity of the ground gains from one time to a later one, m/s; a jump counts with
    /// the stretch that begins with it.
    pub fn velocity(&self, from: f64, to: f64) -> Vector3<f64> {
        let first = self.pieces.partition_point(|p| p.end <= from);
        let own = self.pieces[first..].iter().take_while(|p| p.start < to);
        let gained = own.map(|p| p.velocity(from.max(p.start) - p.start, to.min(p.end) - p.start));
        let jumps = self.jumps.iter().filter_map(|j| match j.when {
            When::At(t) if from <= t && t < to => Some(j.by),
            _ => None,
        });
        gained.chain(jumps).sum()
    }

    /// The greatest acceleration, m/s².
    pub fn peak(&self) -> f64 {
        self.pieces.iter().map(Piece::peak).fold(0.0, f64::max)
    }

    /// The acceleration at a time, m/s².
    pub fn at(&self, time: f64) -> Vector3<f64> {
        let k = self.pieces.partition_point(|p| p.end <= time);
        match self.pieces.get(k) {
            Some(p) if time >= p.start => p.at(time - p.start),
            _ => Vector3::zeros(),
        }
    }

    /// The same motion, this many times as strong.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        let shape = |s: Shape| match s {
            Shape::Line { from, slope } => Shape::Line { from: from * by, slope: slope * by },
            Shape::Sine { amplitude, omega, phase } => {
                Shape::Sine { amplitude: amplitude * by, omega, phase }
            }
        };
        let pieces = self.pieces.iter().map(|p| Piece { shape: shape(p.shape), ..*p }).collect();
        let jumps = self.jumps.iter().map(|j| Jump { by: j.by * by, ..*j }).collect();
        Self { pieces, jumps }
    }
}
