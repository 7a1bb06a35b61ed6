//! Sections shrunk about a point of theirs.

use super::{Interface, Interfaces};
use nalgebra::Vector3;

impl Interfaces {
    /// The same contacts, each shrunk by a factor about its own `centre`; laws and normals stay.
    pub fn shrunk(&self, by: f64, centre: impl Fn(&Interface) -> Vector3<f64>) -> Self {
        let mut shrunk = self.clone();
        for face in &mut shrunk.list {
            let middle = centre(face);
            for p in face.points.iter_mut().chain(face.pieces.iter_mut().flatten()) {
                *p = middle + (*p - middle) * by;
            }
            face.area *= by * by;
        }
        shrunk
    }
}
