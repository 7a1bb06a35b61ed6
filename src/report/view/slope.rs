//! The surface of a heap, and supports that stand before what they hold.

use super::{View, ViewShape};
use analysis::repose::Profile;
use nalgebra::Vector3;

/// The surface of a heap as its slope was read from it.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewSlope {
    /// The highest grains, step by step down the slope, m.
    pub surface: Vec<Vector3<f64>>,
    /// The straight line through them, m.
    pub line: [Vector3<f64>; 2],
    /// Its inclination, degrees.
    pub angle_deg: f64,
}

impl From<Profile> for ViewSlope {
    fn from(profile: Profile) -> Self {
        let Profile { surface, line, slope } = profile;
        Self { surface, line, angle_deg: slope.angle_deg }
    }
}

/// Supports are drawn as glass where they hide more than this share of the free blocks. More: a
/// heap in a box of which the top looks over the wall shows the wall. Less: a wall on a kerb has a
/// kerb of glass.
const HIDDEN: f64 = 0.2;
/// So many free blocks are asked whether one sees them.
const ASKED: usize = 400;

impl View {
    /// Whether supports hide so much, seen from a direction, that they have to be seen through.
    pub fn walled(&self, eye: &Vector3<f64>) -> bool {
        let free: Vec<usize> =
            (0..self.bodies.len()).filter(|&i| !self.bodies[i].support).collect();
        // With balls around them: of measured stones most rays miss all of the thousands of facets.
        let ball = |k: usize| {
            let (low, high) = self.bodies[k].extent();
            (k, (low + high) * 0.5, (high - low).norm_squared() * 0.25)
        };
        let supports = (0..self.bodies.len()).filter(|&i| self.bodies[i].support);
        let held: Vec<(usize, Vector3<f64>, f64)> = supports.map(ball).collect();
        if self.hides_supports || free.is_empty() || held.is_empty() {
            return false;
        }
        let asked: Vec<usize> = free.iter().copied().step_by(free.len().div_ceil(ASKED)).collect();
        let eye = eye.normalize();
        let hidden = |&&i: &&usize| {
            let from = &self.bodies[i].center;
            held.iter().any(|(k, middle, squared)| {
                let to = middle - from;
                to.norm_squared() - to.dot(&eye).powi(2) <= *squared * (1.0 + 1e-9)
                    && self.bodies[*k].stops(from, &eye)
            })
        };
        asked.iter().filter(hidden).count() as f64 > HIDDEN * asked.len() as f64
    }
}

impl super::BlockView {
    /// Whether a ray from a point meets the body.
    fn stops(&self, from: &Vector3<f64>, way: &Vector3<f64>) -> bool {
        match &self.shape {
            ViewShape::Sphere(radius) => {
                let to = self.center - from;
                let along = to.dot(way);
                along > 0.0 && to.norm_squared() - along * along < radius * radius
            }
            ViewShape::Surface(surface) => surface.pieces.iter().any(|piece| {
                let corner = |k: usize| surface.corners[piece[k % piece.len()] as usize];
                let n: Vector3<f64> = (1..piece.len().saturating_sub(1))
                    .map(|k| (corner(k) - corner(0)).cross(&(corner(k + 1) - corner(0))))
                    .sum();
                let towards = n.dot(way);
                // Faces that look at the eye are as many as those that look away.
                if towards <= 0.0 {
                    return false;
                }
                let t = n.dot(&(corner(0) - from)) / towards;
                let p = from + way * t;
                t > 0.0
                    && (0..piece.len())
                        .all(|k| n.dot(&(corner(k + 1) - corner(k)).cross(&(p - corner(k)))) >= 0.0)
            }),
        }
    }
}
