//! Where the line of thrust passes the sections: the resultant of the contact forces at every
//! interface.
//!
//! The *centre of pressure* is where the resultant of the normal forces acts. Its *eccentricity* is
//! the distance from the centroid of the contact's hull; its *use* of the section is the least
//! factor by which the section, shrunk about its centroid, still contains it (2 e / t on a
//! rectangle of depth t: 0 at the centroid, 1 at the edge, where the joint hinges). It lies in the
//! *kern* when a linear distribution of pressure with that resultant presses everywhere (e ≤ t / 6
//! on a rectangle: the middle third).

use super::Forces;
use base::plane::polygon::{self, P2, edges};
use model::interface::{Interface, Interfaces, Model};
use nalgebra::{Matrix2, Vector3};

/// The resultant at one interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionForce {
    /// Index of the interface.
    pub interface: usize,
    /// Normal force, N; compression > 0.
    pub normal: f64,
    /// Shear force, N.
    pub shear: f64,
    /// Centre of pressure, m; the centroid where the normal force is zero.
    pub at: Vector3<f64>,
    /// From the centroid of the section to the centre of pressure, m.
    pub eccentricity: Vector3<f64>,
    /// Share of the section used.
    pub used: f64,
    /// Whether it lies in the kern.
    pub in_kern: bool,
}

/// The model with its sections shrunk about their centroids.
pub fn shrunk_model(model: &Model, by: f64) -> Model {
    Model {
        assembly: model.assembly.clone(),
        interfaces: model.interfaces.shrunk(by, centroid),
        timings: model.timings,
    }
}

/// The resultants at all interfaces, in their order.
pub fn sections(interfaces: &Interfaces, forces: &Forces) -> Vec<SectionForce> {
    interfaces
        .list
        .iter()
        .zip(forces)
        .enumerate()
        .map(|(k, (face, forces))| {
            let n = face.frame.n;
            let total: Vector3<f64> = forces.iter().map(|f| f.force).sum();
            let normal = n.dot(&total);
            let outline = Outline::new(face);
            let moment: P2 = face
                .points
                .iter()
                .zip(forces)
                .map(|(p, f)| (flat(face, p) - outline.centroid) * n.dot(&f.force))
                .sum();
            let e = if normal == 0.0 { P2::zeros() } else { moment / normal };
            let shift = face.frame.t1 * e.x + face.frame.t2 * e.y;
            SectionForce {
                interface: k,
                normal,
                shear: (total - n * normal).norm(),
                at: outline.middle(face) + shift,
                eccentricity: shift,
                used: outline.used(e),
                in_kern: outline.in_kern(e),
            }
        })
        .collect()
}

/// The centroid of an interface's hull, m.
pub fn centroid(face: &Interface) -> Vector3<f64> {
    Outline::new(face).middle(face)
}

/// Coordinates `(t1, t2)` in a contact about its first corner.
fn flat(face: &Interface, p: &Vector3<f64>) -> P2 {
    let d = p - face.points[0];
    P2::new(face.frame.t1.dot(&d), face.frame.t2.dot(&d))
}

/// The hull of a contact in its plane.
struct Outline {
    corners: Vec<P2>,
    area: f64,
    centroid: P2,
}

impl Outline {
    fn new(face: &Interface) -> Self {
        Self::of(face.points.iter().map(|p| flat(face, p)).collect())
    }

    fn of(corners: Vec<P2>) -> Self {
        Self { area: polygon::area(&corners), centroid: polygon::centroid(&corners), corners }
    }

    fn middle(&self, face: &Interface) -> Vector3<f64> {
        face.points[0] + face.frame.t1 * self.centroid.x + face.frame.t2 * self.centroid.y
    }

    /// The factor by which the hull, about its centroid, reaches `e`.
    fn used(&self, e: P2) -> f64 {
        match self.corners[..] {
            [] | [_] => 0.0,
            [a, b] => e.norm() / (0.5 * (b - a).norm()),
            _ => {
                let reach = |(a, b): (P2, P2)| {
                    let out = P2::new(b.y - a.y, a.x - b.x);
                    let distance = out.dot(&(a - self.centroid));
                    if distance == 0.0 { 0.0 } else { out.dot(&e) / distance }
                };
                edges(&self.corners).map(reach).fold(0.0, f64::max)
            }
        }
    }

    /// Navier: the pressure at a corner over the mean pressure is `1 + A eᵀ I⁻¹ (p − c)`.
    fn in_kern(&self, e: P2) -> bool {
        const ROUNDING: f64 = -1e-9;
        match self.corners[..] {
            [] | [_] => true,
            [a, b] => e.norm() <= (b - a).norm() / 6.0 * (1.0 - ROUNDING),
            _ => {
                let inertia = edges(&self.corners).fold(Matrix2::zeros(), |sum, (a, b)| {
                    let (a, b) = (a - self.centroid, b - self.centroid);
                    let s = a + b;
                    sum + (a * a.transpose() + b * b.transpose() + s * s.transpose())
                        * (a.perp(&b) / 24.0)
                });
                let Some(inverse) = inertia.try_inverse() else { return false };
                let slope = inverse * e * self.area;
                self.corners.iter().all(|p| 1.0 + slope.dot(&(p - self.centroid)) >= ROUNDING)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(corners: &[[f64; 2]]) -> Outline {
        Outline::of(corners.iter().map(|&c| c.into()).collect())
    }

    #[test]
    fn the_middle_third_of_a_rectangle() {
        let o = outline(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]]);
        assert!((o.used(P2::new(0.75, 0.0)) - 0.5).abs() < 1e-15);
        assert!((o.used(P2::new(0.0, -0.5)) - 1.0).abs() < 1e-15);
        assert!(o.in_kern(P2::new(0.4999, 0.0)) && !o.in_kern(P2::new(0.5001, 0.0)));
        // The kern is a rhombus: half out along both axes.
        assert!(o.in_kern(P2::new(0.2499, 0.0833)) && !o.in_kern(P2::new(0.26, 0.0834)));
    }

    #[test]
    fn edges_and_points_have_a_line_of_thrust_too() {
        let o = outline(&[[0.0, 0.0], [0.0, 6.0]]);
        assert!((o.used(P2::new(0.0, -1.5)) - 0.5).abs() < 1e-15);
        assert!(o.in_kern(P2::new(0.0, 0.99)) && !o.in_kern(P2::new(0.0, 1.01)));
        assert!(outline(&[[1.0, 1.0]]).in_kern(P2::zeros()));
    }
}
