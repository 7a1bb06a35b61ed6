//! Cells that repeat themselves, and how they deform.
//!
//! Images of a place x lie at x + H s for integers s along the periodic directions. A cell deforms
//! homogeneously at the rate L = Ḣ H⁻¹; grains move with it, and their velocities v are those beyond
//! the flow L x: ẋ = v + L x, m v̇ = f − m L v (SLLOD; Evans & Morriss 1984). For simple shear at a
//! constant rate that is Newton's law with the sliding images of Lees & Edwards (1972).
//!
//! A length under a pressure follows the stress as a boundary does that lets waves of compression
//! pass: its two faces part at (σ − P) / (ρ c), ρ c the impedance, so that nothing rings.
//!
//! * A. W. Lees, S. F. Edwards, *The computer study of transport processes under extreme conditions*,
//!   J. Physics C 5 (1972) 1921.
//! * D. J. Evans, G. P. Morriss, *Nonlinear-response theory for steady planar Couette flow*, Physical
//!   Review A 30 (1984) 1528.

use nalgebra::{Matrix3, Vector3};
use std::fmt;

/// A cell may shrink or grow by at most this in a step, as a share of its length. More: grains pass
/// through each other where the pressure is far off.
const STRAIN: f64 = 1e-3;

/// A box that repeats itself: its edges along x, y and z, the third of which leans towards x as it
/// is sheared.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Lengths, m.
    pub(crate) lengths: [f64; 3],
    /// How far the top leans over the bottom along x, m; at most half a length.
    pub(crate) lean: f64,
    /// In which directions it repeats itself.
    pub(crate) periodic: [bool; 3],
    /// L without what is 0: its diagonal and ∂v_x/∂z, 1/s.
    pub(crate) stretch: Vector3<f64>,
    pub(crate) shear: f64,
}

/// What deforms a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drive {
    /// Normal stress that each length is to come under, Pa; `None` where it stays as it is.
    pub pressure: [Option<f64>; 3],
    /// ρ c of what is compressed, Pa s/m.
    pub impedance: f64,
    /// Rate of shear ∂v_x/∂z, 1/s.
    pub shear: f64,
}

/// A cell that is too narrow for its grains: one would meet another and its image at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Narrow;

impl fmt::Display for Narrow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a periodic cell must be at least three of its largest grains wide")
    }
}

impl std::error::Error for Narrow {}

impl Cell {
    /// An upright cell of these lengths, m.
    pub fn new(lengths: [f64; 3], periodic: [bool; 3]) -> Self {
        Self { lengths, lean: 0.0, periodic, stretch: Vector3::zeros(), shear: 0.0 }
    }

    /// The lengths, m.
    pub fn lengths(&self) -> [f64; 3] {
        self.lengths
    }

    /// The volume, m³.
    pub fn volume(&self) -> f64 {
        self.lengths.iter().product()
    }

    /// How far an image lies from its place.
    #[inline]
    pub(crate) fn image(&self, s: [i8; 3]) -> Vector3<f64> {
        let [x, y, z] = s.map(f64::from);
        let [a, b, c] = self.lengths;
        Vector3::new(a * x + self.lean * z, b * y, c * z)
    }

    /// How fast the flow is faster by so far.
    #[inline]
    pub(crate) fn flow(&self, r: &Vector3<f64>) -> Vector3<f64> {
        let mut v = self.stretch.component_mul(r);
        v.x += self.shear * r.z;
        v
    }

    /// A place by shares of the edges.
    pub(crate) fn shares(&self, x: &Vector3<f64>) -> [f64; 3] {
        let up = x.z / self.lengths[2];
        [(x.x - self.lean * up) / self.lengths[0], x.y / self.lengths[1], up]
    }

    /// The place among its images that lies in the cell.
    pub(crate) fn wrapped(&self, x: &Vector3<f64>) -> Vector3<f64> {
        let mut at = *x;
        // Upwards first: a step up leads along x, too.
        for k in [2, 1, 0] {
            let times = if self.periodic[k] { self.shares(&at)[k].floor() } else { 0.0 };
            at[k] -= times * self.lengths[k];
            if k == 2 {
                at.x -= times * self.lean;
            }
        }
        at
    }

    /// Distances between opposite faces, m.
    pub(crate) fn widths(&self) -> [f64; 3] {
        let [x, y, z] = self.lengths;
        [x * z / z.hypot(self.lean), y, z]
    }

    /// The gradient of the deformation over a step.
    pub(crate) fn gradient(&self, dt: f64) -> Matrix3<f64> {
        let mut f = Matrix3::from_diagonal(&(Vector3::repeat(1.0) + self.stretch * dt));
        f[(0, 2)] = self.shear * dt;
        f
    }

    /// Takes on the rates of a drive under a stress.
    pub(crate) fn follow(&mut self, drive: &Drive, stress: &Matrix3<f64>, dt: f64) {
        self.shear = drive.shear;
        for k in 0..3 {
            let most = STRAIN / dt;
            self.stretch[k] = drive.pressure[k].map_or(0.0, |pressure| {
                let speed = 2.0 * (stress[(k, k)] - pressure) / drive.impedance;
                (speed / self.lengths[k]).clamp(-most, most)
            });
        }
    }

    /// Deforms over a step; whether it was set upright, so that images have other numbers.
    pub(crate) fn deform(&mut self, dt: f64) -> bool {
        self.lean += dt * (self.stretch.x * self.lean + self.shear * self.lengths[2]);
        for k in 0..3 {
            self.lengths[k] *= 1.0 + dt * self.stretch[k];
        }
        let over = self.lean.abs() > 0.5 * self.lengths[0];
        if over {
            self.lean -= self.lengths[0] * self.lean.signum();
        }
        over
    }
}
