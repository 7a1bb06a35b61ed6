//! What two blocks have to do with each other.

use super::{
    ContactFrame, ContactKind,
    faces::{Closing, FaceContact, Gap},
    features::Touch,
    limits::Limits,
    plane::Plane,
};
use nalgebra::Vector3;

/// A pair of blocks that have something to do with each other.
pub(super) struct Pair {
    pub a: usize,
    pub b: usize,
    pub limits: Limits,
    pub meeting: Meeting,
}

/// What two blocks have to do with each other.
#[derive(Clone, Default)]
pub(super) struct Meeting {
    pub contacts: Vec<Contact>,
    pub near: Option<Near>,
    pub overlap: Option<Overlap>,
    /// Whether one is the other once more.
    pub twice: bool,
    pub small: Vec<f64>,
    /// Whether rims may meet.
    pub rims: bool,
    /// Whether the blocks meet at rims alone, where nothing carries.
    pub idle: bool,
}

/// An [`Interface`] before its friction is known.
#[derive(Clone)]
pub(super) struct Contact {
    pub kind: ContactKind,
    pub frame: ContactFrame,
    pub points: Vec<Vector3<f64>>,
    pub area: f64,
    pub patches: usize,
    pub pieces: Vec<Vec<Vector3<f64>>>,
    pub ways: Vec<Vector3<f64>>,
    pub gap: Gap,
}

/// A near miss; spheres have no plane.
#[derive(Clone)]
pub(super) struct Near {
    pub gap: f64,
    pub closing: Closing,
    pub plane: Option<Plane>,
}

/// An overlap deeper than the tolerance.
#[derive(Clone)]
pub(super) struct Overlap {
    pub depth: f64,
    /// What would join the blocks, if not too far.
    pub closing: Option<Closing>,
}

impl Meeting {
    pub fn is_nothing(&self) -> bool {
        self.contacts.is_empty()
            && self.near.is_none()
            && self.overlap.is_none()
            && self.small.is_empty()
            && !self.rims
    }
}

pub(super) fn of_touch(touch: Touch, sign: f64) -> Contact {
    let n = touch.n * sign;
    let (kind, frame) = match touch.points[..] {
        [p, q] => (ContactKind::Edge, ContactFrame::along(n, q - p)),
        _ => (ContactKind::Point, ContactFrame::around(n)),
    };
    Contact {
        kind,
        frame,
        points: touch.points,
        area: 0.0,
        patches: touch.patches,
        pieces: Vec::new(),
        ways: touch.ways.iter().map(|w| w * sign).collect(),
        gap: touch.gap,
    }
}

pub(super) fn of_face(face: &FaceContact, limits: &Limits) -> Contact {
    let lift = |polygon: &Vec<_>| polygon.iter().map(|&p| face.plane.lift(p)).collect::<Vec<_>>();
    Contact {
        kind: ContactKind::Face,
        frame: face.plane.frame,
        points: lift(&face.hull),
        area: face.area,
        patches: face.patches,
        pieces: if face.fills_hull(limits) {
            Vec::new()
        } else {
            face.pieces.iter().map(lift).collect()
        },
        ways: Vec::new(),
        gap: face.gap,
    }
}
