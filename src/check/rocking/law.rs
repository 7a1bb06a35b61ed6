//! What a mechanism of one degree of freedom is at a value of its coordinate.
//!
//! With `v` and `ω` the rates of the blocks per unit of the coordinate q: its inertia `m = Σ m|v|² +
//! ω·Iω`, the slope of the potential of its dead loads `V′ = −Σ (F·v + M·ω)`, and what an
//! acceleration of the ground takes hold of, `L = Σ m v` along three axes.

use nalgebra::Vector3;

/// Numbers at one value of the coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Values {
    /// Inertia, kg m² where the coordinate is an angle.
    pub inertia: f64,
    /// Its slope.
    pub growth: f64,
    /// Slope of the potential, N m.
    pub resistance: f64,
    /// Slope of that.
    pub stiffness: f64,
    /// Mass × rate, kg m.
    pub grip: Vector3<f64>,
    /// Way of the control point, m.
    pub way: f64,
}

/// The law of a mechanism over the range of its coordinate.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Every block turns by the coordinate, or goes along on a circle: the inertia stays, the rest
    /// goes with sine and cosine.
    Circular(Circular),
    /// Anything smooth: polynomials of Chebyshev on pieces of equal width.
    Tabulated(Table),
}

/// Functions `a cos q + b sin q`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circular {
    /// The inertia.
    pub inertia: f64,
    /// Of the slope of the potential: `a` and `b`.
    pub resistance: [f64; 2],
    /// Of the grip.
    pub grip: [Vector3<f64>; 2],
    /// Of the way of the control point, `a (1 − cos q) + b sin q`.
    pub way: [f64; 2],
}

/// Polynomials on pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Width of a piece.
    pub width: f64,
    /// By piece: coefficients of inertia, resistance, grip (three) and way.
    pub pieces: Vec<[[f64; NODES]; 6]>,
}

/// Nodes of a piece. More: time. Fewer: digits of four-bar linkages near their dead points.
pub const NODES: usize = 16;

impl Law {
    /// Its numbers there.
    pub fn at(&self, q: f64) -> Values {
        match self {
            Self::Circular(c) => {
                let (s, k) = q.sin_cos();
                Values {
                    inertia: c.inertia,
                    growth: 0.0,
                    resistance: c.resistance[0] * k + c.resistance[1] * s,
                    stiffness: c.resistance[1] * k - c.resistance[0] * s,
                    grip: c.grip[0] * k + c.grip[1] * s,
                    way: c.way[0] * (1.0 - k) + c.way[1] * s,
                }
            }
            Self::Tabulated(table) => table.at(q),
        }
    }

    /// Generalised force and inertia under an acceleration of the ground at this speed: what
    /// integration needs.
    pub fn acceleration(&self, q: f64, speed: f64, ground: &Vector3<f64>) -> f64 {
        match self {
            Self::Circular(c) => {
                let (s, k) = q.sin_cos();
                let a = c.resistance[0] + ground.dot(&c.grip[0]);
                let b = c.resistance[1] + ground.dot(&c.grip[1]);
                -(a * k + b * s) / c.inertia
            }
            Self::Tabulated(table) => {
                let v = table.at(q);
                -(v.resistance + ground.dot(&v.grip) + 0.5 * v.growth * speed * speed) / v.inertia
            }
        }
    }
}

/// Where the nodes of a piece lie, from −1 to 1.
pub fn nodes() -> [f64; NODES] {
    std::array::from_fn(|k| -(std::f64::consts::PI * (k as f64 + 0.5) / NODES as f64).cos())
}

/// Coefficients of the polynomial through values at the [`nodes`].
pub fn coefficients(values: &[f64; NODES]) -> [f64; NODES] {
    std::array::from_fn(|j| {
        let sum: f64 = (0..NODES)
            .map(|k| {
                let angle = std::f64::consts::PI * (k as f64 + 0.5) / NODES as f64;
                // Nodes run from −1 to 1, angles from π to 0.
                values[NODES - 1 - k] * (j as f64 * angle).cos()
            })
            .sum();
        sum * if j == 0 { 1.0 } else { 2.0 } / NODES as f64
    })
}

impl Table {
    fn at(&self, q: f64) -> Values {
        let last = self.pieces.len().saturating_sub(1);
        let piece = ((q / self.width).max(0.0) as usize).min(last);
        let Some(f) = self.pieces.get(piece) else { return Values::default() };
        let x = 2.0 * (q / self.width - piece as f64) - 1.0;
        let per = 2.0 / self.width;
        let (inertia, growth) = value(&f[0], x);
        let (resistance, stiffness) = value(&f[1], x);
        Values {
            inertia,
            growth: growth * per,
            resistance,
            stiffness: stiffness * per,
            grip: Vector3::new(value(&f[2], x).0, value(&f[3], x).0, value(&f[4], x).0),
            way: value(&f[5], x).0,
        }
    }
}

/// A polynomial and its slope (Clenshaw).
fn value(c: &[f64; NODES], x: f64) -> (f64, f64) {
    let (mut b1, mut b2, mut d1, mut d2) = (0.0, 0.0, 0.0, 0.0);
    for k in (1..NODES).rev() {
        let d = 2.0 * b1 + 2.0 * x * d1 - d2;
        (d2, d1) = (d1, d);
        let b = c[k] + 2.0 * x * b1 - b2;
        (b2, b1) = (b1, b);
    }
    (c[0] + x * b1 - b2, b1 + x * d1 - d2)
}
