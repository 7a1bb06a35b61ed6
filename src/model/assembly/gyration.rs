//! How far from its centre of mass the mass of a block lies, direction by direction.
//!
//! With `G = √(I/m)` (the symmetric root, m) a spin ω moves the mass at the root mean square speed
//! `‖G ω‖`, and a moment M weighs as much as a force of the size `‖G⁻¹ M‖`: the two are dual, `M·ω
//! = (G⁻¹M)·(Gω)`. Every direction has its own length: turning about the long axis of a beam is
//! measured by its cross-section, however long it is. The eigenvalues of G are the radii of
//! gyration.

use base::tolerance;
use nalgebra::{Matrix3, Rotation3, Vector3};

/// The root of a block's inertia over its mass, and its inverse.
#[derive(Clone, Debug, PartialEq)]
pub struct Gyration {
    /// G, m.
    root: Matrix3<f64>,
    /// G⁻¹, 1/m.
    inverse: Matrix3<f64>,
    /// The least radius of gyration, m.
    least: f64,
}

impl Gyration {
    /// From the inertia about the centre of mass (kg·m²) and the mass (kg).
    pub fn new(inertia: &Matrix3<f64>, mass: f64) -> Self {
        let eigen = tidy(inertia / mass).symmetric_eigen();
        let greatest = eigen.eigenvalues.max().sqrt();
        let radii =
            eigen.eigenvalues.map(|i| i.max(0.0).sqrt().max(tolerance::LEAST_GYRATION * greatest));
        let v = &eigen.eigenvectors;
        let with = |d: Vector3<f64>| tidy(v * Matrix3::from_diagonal(&d) * v.transpose());
        Self { root: with(radii), inverse: with(radii.map(f64::recip)), least: radii.min() }
    }

    /// Of the same block after a turn.
    pub fn turned(&self, by: &Rotation3<f64>) -> Self {
        let with = |m: &Matrix3<f64>| tidy(by.matrix() * m * by.matrix().transpose());
        Self { root: with(&self.root), inverse: with(&self.inverse), least: self.least }
    }

    /// The same in units of `length`, m.
    pub fn in_units(&self, length: f64) -> Self {
        Self {
            root: self.root / length,
            inverse: self.inverse * length,
            least: self.least / length,
        }
    }

    /// Root mean square speed, as a vector, of a spin (rad/s): m/s.
    pub fn speed(&self, spin: &Vector3<f64>) -> Vector3<f64> {
        self.root * spin
    }

    /// The force (N) that weighs as much as a moment (N·m).
    pub fn force(&self, moment: &Vector3<f64>) -> Vector3<f64> {
        self.inverse * moment
    }

    /// At least the force, component by component, that weighs as much as a moment whose components
    /// are at most these (N·m).
    pub fn bound(&self, moment: &Vector3<f64>) -> Vector3<f64> {
        // A component that is zero counts for nothing, whatever the size of the others.
        Vector3::from_fn(|i, _| {
            (0..3)
                .filter(|&j| moment[j] != 0.0)
                .map(|j| self.inverse[(i, j)].abs() * moment[j])
                .sum()
        })
    }

    /// The spin (rad/s) of a speed: the inverse of [`Self::speed`].
    pub fn spin(&self, speed: &Vector3<f64>) -> Vector3<f64> {
        self.inverse * speed
    }

    /// The least radius of gyration, m.
    pub fn least(&self) -> f64 {
        self.least
    }
}

/// Symmetric, without the rounding beside the diagonal that would fill sparse matrices with noise.
fn tidy(m: Matrix3<f64>) -> Matrix3<f64> {
    let mut m = (m + m.transpose()) * 0.5;
    for i in 0..3 {
        for j in 0..3 {
            if i != j && m[(i, j)].abs() <= NOISE * (m[(i, i)] * m[(j, j)]).abs().sqrt() {
                m[(i, j)] = 0.0;
            }
        }
    }
    m
}

/// Off-diagonal entries below this × the geometric mean of their diagonal entries are rounding.
const NOISE: f64 = 64.0 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn a_turned_slab_has_the_radii_of_its_sides() {
        let sides = Vector3::new(1.0, 2000.0, 0.2);
        let square = |k: usize| sides[k] * sides[k] / 12.0;
        let still = Matrix3::from_diagonal(&Vector3::new(
            square(1) + square(2),
            square(0) + square(2),
            square(0) + square(1),
        ));
        let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
        let mass = 7.0;
        let g = Gyration::new(&(turn * still * turn.inverse() * mass), mass);
        for k in 0..3 {
            let axis = turn * Vector3::ith(k, 1.0);
            let radius = still[(k, k)].sqrt();
            assert!((g.speed(&axis).norm() - radius).abs() < 1e-9 * radius, "{k}");
            assert!((g.force(&axis).norm() * radius - 1.0).abs() < 1e-7, "{k}");
            assert!((g.spin(&g.speed(&axis)) - axis).norm() < 1e-7);
        }
    }

    #[test]
    fn a_sphere_and_a_box_along_the_axes_leave_no_noise() {
        for inertia in [
            Matrix3::identity() * 0.4,
            Matrix3::new(2.0, 1e-17, 0.0, 1e-17, 3.0, 1e-16, 0.0, 1e-16, 4.0),
        ] {
            let g = Gyration::new(&inertia, 1.0);
            assert_eq!(g.root - Matrix3::from_diagonal(&g.root.diagonal()), Matrix3::zeros());
        }
    }
}
