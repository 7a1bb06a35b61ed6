//! Contact interfaces: where blocks touch, with normals, corner points and the law of the joint.
//!
//! Convention: the unit normal `n` points from block `a` into block `b`; contact forces are the
//! forces **on b**; compression is `f_n ≥ 0`; the frame `(t1, t2, n)` is right-handed.

mod axes;
mod balance;
mod body;
mod detect;
mod detect_candidates;
mod detect_rims;
mod detect_twice;
mod faces;
mod features;
mod given;
mod left_out;
mod limits;
mod meeting;
mod member;
mod model;
mod overlap;
mod parts;
mod plane;
mod reach;
mod rims;
mod shrink;
mod spheres;
mod stage;
mod tally;
#[cfg(test)]
mod tests;
mod weightless;

pub use axes::on_its_side;
pub use balance::in_balance;
pub use detect::{detect, detect_until};
pub use left_out::LeftOut;
pub use model::{Model, Timings, closed, prepare, prepare_timed, prepare_until};
pub use parts::{Members, Part, Units, members, parts};
pub use plane::Plane;
pub use reach::{floating, is_forest};
pub use stage::at_stage;

use crate::assembly::{JointLaw, Member};
use base::{
    error::Finding,
    plane::{clip, polygon},
};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// All contacts of an assembly, sorted by `(a, b)`, and the members that act beside them.
#[derive(Clone, Debug, Default)]
pub struct Interfaces {
    /// The contacts. Pairs of two supports are left out.
    pub list: Vec<Interface>,
    /// Pairs of supports that touch: left out, counted.
    pub support_pairs: usize,
    /// Gaps closed, near misses, overlaps, ignored contacts.
    pub findings: Vec<Finding>,
    /// The near misses and overlaps in numbers, where there are any.
    pub left_out: Option<LeftOut>,
    /// Which pairs these are.
    pub apart: Vec<[usize; 2]>,
    /// Ties, struts, tendons, joints of strips, dowels, soil and grips.
    pub members: Vec<Member>,
}

/// One contact between two blocks on one plane.
#[derive(Clone, Debug)]
pub struct Interface {
    /// Index of the first block, `a < b` (except where given by hand).
    pub a: usize,
    /// Index of the second block.
    pub b: usize,
    /// What touches what.
    pub kind: ContactKind,
    /// Orthonormal right-handed frame, `n` from `a` into `b`.
    pub frame: ContactFrame,
    /// Contact points: the corners of the convex hull of the contact, in order around `n`, m. The
    /// hull is exact for rigid blocks with Coulomb friction: a force at an inner point is a
    /// combination of forces at the corners.
    pub points: Vec<Vector3<f64>>,
    /// Area that really touches, m² (smaller than the hull's where the contact has several patches
    /// or holes; 0 for edges and points).
    pub area: f64,
    /// Connected patches.
    pub patches: usize,
    /// Convex pieces of the contact where it is not simply the hull; empty otherwise.
    pub pieces: Vec<Vec<Vector3<f64>>>,
    /// Where edges or corners meet and several directions keep the blocks apart: the outermost of
    /// them, unit, from `a` into `b`. The contact stands for all of them, with a small flat across
    /// the one in their middle ([`Model::every_way`]). Empty where the normal is the only one.
    pub ways: Vec<Vector3<f64>>,
    /// Mean signed gap before closing, m (> 0 open, < 0 overlap).
    pub gap: f64,
    /// How it resists.
    pub law: JointLaw,
}

/// What touches what.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactKind {
    /// Face against face.
    Face,
    /// An edge on a face.
    Edge,
    /// A corner on a face, two crossing edges, or a sphere.
    Point,
    /// Given by hand.
    Given,
}

/// A right-handed orthonormal frame `(t1, t2, n)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactFrame {
    /// First tangent.
    pub t1: Vector3<f64>,
    /// Second tangent.
    pub t2: Vector3<f64>,
    /// Normal, from `a` into `b`.
    pub n: Vector3<f64>,
}

impl ContactFrame {
    /// A frame around a unit normal; `t1` lies along the coordinate axis least parallel to `n`,
    /// projected.
    pub fn around(n: Vector3<f64>) -> Self {
        let axis = Vector3::ith(n.iamin(), 1.0);
        let t1 = (axis - n * n.dot(&axis)).normalize();
        Self { t1, t2: n.cross(&t1), n }
    }

    /// A frame around a unit normal whose `t1` is along `direction`, projected; falls back to
    /// [`Self::around`] where they are parallel.
    pub fn along(n: Vector3<f64>, direction: Vector3<f64>) -> Self {
        let t = direction - n * n.dot(&direction);
        if t.norm() <= 1e-9 * direction.norm() {
            return Self::around(n);
        }
        let t1 = t.normalize();
        Self { t1, t2: n.cross(&t1), n }
    }
}
