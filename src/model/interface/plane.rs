//! A contact plane with coordinates in it.

use super::{ContactFrame, polygon::P2};
use nalgebra::Vector3;

/// A plane with an origin near the contact, so that coordinates in it are small, and axes `t1`,
/// `t2` with `t1 × t2 = n`.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// Where its coordinates are zero.
    pub origin: Vector3<f64>,
    /// Its axes and its normal.
    pub frame: ContactFrame,
}

impl Plane {
    /// The plane through `origin` with unit normal `n`.
    pub fn new(origin: Vector3<f64>, n: Vector3<f64>) -> Self {
        Self { origin, frame: ContactFrame::around(n) }
    }

    /// Coordinates of a point, projected along the normal.
    pub fn flat(&self, p: Vector3<f64>) -> P2 {
        let r = p - self.origin;
        P2::new(r.dot(&self.frame.t1), r.dot(&self.frame.t2))
    }

    /// The point of the plane with these coordinates.
    pub fn lift(&self, p: P2) -> Vector3<f64> {
        self.origin + self.frame.t1 * p.x + self.frame.t2 * p.y
    }

    /// Signed distance along the normal.
    pub fn height(&self, p: Vector3<f64>) -> f64 {
        (p - self.origin).dot(&self.frame.n)
    }
}
