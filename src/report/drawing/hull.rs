//! What a body covers on the sheet: the convex hull of its corners, and whether two of them
//! overlap.

use super::{
    body::{Form, Solid},
    projection::Projection,
};
use base::plane::polygon::{self, P2};

/// Hulls that overlap by less than this × their reach only touch.
const TOUCH: f64 = 1e-6;

/// A convex polygon on the sheet, or a circle.
pub enum Hull {
    /// Corners in order.
    Polygon(Vec<[f64; 2]>),
    /// Centre and radius.
    Circle([f64; 2], f64),
}

impl Hull {
    /// The hull of what is seen of a body.
    pub fn new(body: &Solid, paper: &Projection) -> Self {
        match &body.form {
            Form::Sphere(radius) => Self::Circle(paper.at(&body.middle), radius * paper.scale),
            Form::Surface { points, .. } => {
                Self::Polygon(outline(&points.iter().map(|p| paper.at(p)).collect::<Vec<_>>()))
            }
        }
    }

    fn reach(&self, axis: [f64; 2]) -> [f64; 2] {
        let along = |p: &[f64; 2]| axis[0] * p[0] + axis[1] * p[1];
        match self {
            Self::Circle(c, r) => {
                [along(c) - r * axis[0].hypot(axis[1]), along(c) + r * axis[0].hypot(axis[1])]
            }
            Self::Polygon(points) => points
                .iter()
                .map(along)
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]),
        }
    }

    /// Normals of its sides.
    fn axes(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Circle(..) => Vec::new(),
            Self::Polygon(p) => (0..p.len())
                .map(|k| (p[k], p[(k + 1) % p.len()]))
                .map(|(a, b)| [a[1] - b[1], b[0] - a[0]])
                .collect(),
        }
    }

    /// Whether two of them overlap: no line separates them (theorem of separating axes). Of
    /// circles, the corners of the other are left out: at worst two that only nearly overlap count
    /// as overlapping.
    pub fn overlaps(&self, other: &Self) -> bool {
        if let (Self::Circle(a, r), Self::Circle(b, s)) = (self, other) {
            return (a[0] - b[0]).hypot(a[1] - b[1]) < (r + s) * (1.0 - TOUCH);
        }
        let apart = |axis: &[f64; 2]| {
            let ([low, top], [bottom, high]) = (self.reach(*axis), other.reach(*axis));
            top.min(high) - low.max(bottom) <= TOUCH * (top - low).min(high - bottom)
        };
        !self.axes().iter().chain(&other.axes()).any(apart)
    }
}

/// Corners of the convex hull.
pub(super) fn outline(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let flat: Vec<P2> = points.iter().map(|&p| p.into()).collect();
    polygon::corners(&flat).into_iter().map(|i| points[i]).collect()
}
