//! The cross-section of a joint: the area that touches and integrals over it.

use crate::interface::{Interface, Plane};
use base::plane::{
    clip::inside,
    polygon::{P2, area_and_moment},
};

/// The area that touches, in the coordinates `(t1, t2)` of the joint about its first corner.
pub(super) struct Section {
    /// Corners of the hull.
    pub corners: Vec<P2>,
    /// Convex pieces, counter-clockwise.
    pub pieces: Vec<Vec<P2>>,
}

impl Section {
    pub fn new(face: &Interface) -> Self {
        let plane = Plane { origin: face.points[0], frame: face.frame };
        let corners: Vec<P2> = face.points.iter().map(|&p| plane.flat(p)).collect();
        if face.pieces.is_empty() {
            return Self { pieces: vec![corners.clone()], corners };
        }
        let mut pieces: Vec<Vec<P2>> = face
            .pieces
            .iter()
            .map(|piece| piece.iter().map(|&p| plane.flat(p)).collect())
            .collect();
        pieces
            .iter_mut()
            .filter(|piece| area_and_moment(piece).0 < 0.0)
            .for_each(|piece| piece.reverse());
        Self { corners, pieces }
    }

    /// Area, and its first moment about the origin.
    pub fn area_and_moment(&self) -> (f64, P2) {
        self.pressed(1.0, P2::zeros())
    }

    /// Area where `value + slope · x ≥ 0`, and its first moment about the origin.
    pub fn pressed(&self, value: f64, slope: P2) -> (f64, P2) {
        let mut sum = (0.0, P2::zeros());
        for piece in &self.pieces {
            let kept = inside(piece, |p| value + slope.dot(p), 0.0);
            let (area, moment) = area_and_moment(&kept);
            let about = kept.first().map_or_else(P2::zeros, |p| p * area);
            sum = (sum.0 + area, sum.1 + moment + about);
        }
        sum
    }

    /// Area where `value + slope · x ≥ 0`, and the integral of that there.
    pub fn positive(&self, value: f64, slope: P2) -> (f64, f64) {
        let (area, moment) = self.pressed(value, slope);
        (area, value * area + slope.dot(&moment))
    }
}
