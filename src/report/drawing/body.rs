//! Blocks where they are drawn: in place, or moved.

use crate::view::{BlockView, Surface, View, ViewPose, ViewShape};
use nalgebra::{Matrix3, Vector3};

/// Where the points of a block go: `p ↦ p + shift + turn (p − c)`, c its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displacement {
    /// Shift of the centre of mass, m.
    pub shift: Vector3<f64>,
    /// Turn less the identity.
    pub turn: Matrix3<f64>,
}

impl Displacement {
    /// Where it is.
    pub const NONE: Self = Self {
        shift: Vector3::new(0.0, 0.0, 0.0),
        turn: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    };

    pub fn rigid(pose: &ViewPose) -> Self {
        Self {
            shift: pose.shift,
            turn: pose.turn.to_rotation_matrix().into_inner() - Matrix3::identity(),
        }
    }

    /// How far a point at this distance from the centre goes at most.
    pub fn length(&self, radius: f64) -> f64 {
        self.shift.norm() + self.turn.norm() * radius
    }
}

/// A block where it is drawn.
pub struct Solid<'a> {
    /// What it is.
    pub body: &'a BlockView,
    /// Its geometry.
    pub form: Form<'a>,
    /// Centre of mass.
    pub middle: Vector3<f64>,
}

/// Geometry where it is drawn.
pub enum Form<'a> {
    /// A surface: corners and outward unit normals of its pieces, both moved.
    Surface {
        /// As it was.
        surface: &'a Surface,
        /// Corners.
        points: Vec<Vector3<f64>>,
        /// Normals.
        normals: Vec<Vector3<f64>>,
    },
    /// A sphere about the middle.
    Sphere(f64),
}

/// All blocks in place.
pub fn still(view: &View) -> Vec<Solid<'_>> {
    view.bodies.iter().map(|b| posed(b, &Displacement::NONE)).collect()
}

/// A block where it goes.
pub fn posed<'a>(body: &'a BlockView, way: &Displacement) -> Solid<'a> {
    let form = match &body.shape {
        ViewShape::Sphere(radius) => Form::Sphere(*radius),
        ViewShape::Surface(surface) => {
            let points: Vec<Vector3<f64>> =
                surface.corners.iter().map(|p| moved(body, way, p)).collect();
            let normals = surface.pieces.iter().map(|piece| normal(&points, piece)).collect();
            Form::Surface { surface, points, normals }
        }
    };
    Solid { body, form, middle: body.center + way.shift }
}

/// Where a point of a block goes.
pub fn moved(body: &BlockView, way: &Displacement, p: &Vector3<f64>) -> Vector3<f64> {
    p + way.shift + way.turn * (p - body.center)
}

/// Newell's normal of a loop.
fn normal(points: &[Vector3<f64>], piece: &[u32]) -> Vector3<f64> {
    let Some(&first) = piece.first() else { return Vector3::zeros() };
    let origin = points[first as usize];
    let corner = |k: usize| points[piece[k % piece.len()] as usize] - origin;
    let sum: Vector3<f64> = (0..piece.len()).map(|k| corner(k).cross(&corner(k + 1))).sum();
    sum.try_normalize(0.0).unwrap_or_default()
}

impl Solid<'_> {
    /// How far it reaches along a direction, from and to.
    pub fn reach(&self, direction: &Vector3<f64>) -> [f64; 2] {
        match &self.form {
            Form::Surface { points, .. } => {
                points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
                    let at = direction.dot(p);
                    [low.min(at), high.max(at)]
                })
            }
            Form::Sphere(radius) => {
                let at = direction.dot(&self.middle);
                [at - radius, at + radius]
            }
        }
    }

    /// Normals of its pieces.
    pub fn normals(&self) -> &[Vector3<f64>] {
        match &self.form {
            Form::Surface { normals, .. } => normals,
            Form::Sphere(_) => &[],
        }
    }
}

impl BlockView {
    /// The greatest distance of a corner from the centre of mass, m.
    pub(super) fn radius(&self) -> f64 {
        match &self.shape {
            ViewShape::Sphere(radius) => *radius,
            ViewShape::Surface(s) => {
                s.corners.iter().map(|p| (p - self.center).norm()).fold(0.0, f64::max)
            }
        }
    }
}
