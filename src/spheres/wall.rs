//! Walls: boxes that grains meet at their faces, edges and corners.

use crate::law::Friction;
use nalgebra::{Isometry3, Vector3};

/// A rigid box.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Centre, and turn from the axes.
    pub pose: Isometry3<f64>,
    /// Half its edges, m.
    pub half: Vector3<f64>,
    /// Velocity, m/s.
    pub velocity: Vector3<f64>,
    /// Friction of grains on it.
    pub friction: Friction,
}

impl Wall {
    /// Signed distance of a place from its surface, m (less than 0 inside), and the unit vector from
    /// the place to the nearest point of the surface.
    pub(crate) fn nearest(&self, x: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let local = self.pose.inverse_transform_point(&(*x).into()).coords;
        let outside = local - local.sup(&-self.half).inf(&self.half);
        let distance = outside.norm();
        if distance > 0.0 {
            return (distance, self.pose.rotation * (-outside / distance));
        }
        // Inside: out through the nearest face.
        let depth = self.half - local.abs();
        let k = depth.imin();
        let mut way = Vector3::zeros();
        way[k] = -local[k].signum();
        (-depth[k], self.pose.rotation * way)
    }
}
