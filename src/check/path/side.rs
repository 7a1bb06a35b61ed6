//! Whose face goes on beyond a corner of a joint.

use model::{
    assembly::{Assembly, Facet, Polyhedron, Solid},
    interface::Interface,
};
use nalgebra::Vector3;

/// Whose face goes on beyond a corner of a joint: the other's corner stands on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The face of block `a`.
    A,
    /// The face of block `b`.
    B,
    /// Both end there.
    Neither,
}

/// How far beyond a corner is looked, over the size of the joint. Larger: what ends soon after is
/// taken to end there. Smaller: rounding of outlines goes on.
const BEYOND: f64 = 1e-4;
/// Facets further off the plane of a joint than this × the size of their block, or turned from it
/// by more than this, are others.
const IN_PLANE: f64 = 1e-3;

/// The side of every corner.
pub fn sides(assembly: &Assembly, face: &Interface) -> Vec<Side> {
    let middle = face.points.iter().sum::<Vector3<f64>>() / face.points.len().max(1) as f64;
    let reach = face.points.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
    face.points
        .iter()
        .map(|p| {
            let beyond = p + (p - middle) * BEYOND;
            let goes_on = |block: usize| {
                let size = assembly.blocks[block].size;
                match &assembly.blocks[block].solid {
                    Solid::Polyhedron(shape) => {
                        // A corner alone has no direction: any face of the plane there is one.
                        let alone = reach <= BEYOND * size;
                        covers(shape, &face.frame.n, &beyond, size, alone)
                    }
                    _ => false,
                }
            };
            match (goes_on(face.a), goes_on(face.b)) {
                (true, _) => Side::A,
                (false, true) => Side::B,
                (false, false) => Side::Neither,
            }
        })
        .collect()
}

/// Whether a facet in the plane through `p` across `n` covers `p`.
fn covers(shape: &Polyhedron, n: &Vector3<f64>, p: &Vector3<f64>, size: f64, alone: bool) -> bool {
    let slack = if alone { IN_PLANE * size } else { 0.0 };
    let in_plane = |f: &&Facet| {
        f.normal.cross(n).norm() <= IN_PLANE
            && (f.normal.dot(p) - f.offset).abs() <= IN_PLANE * size
    };
    shape.facets.iter().filter(in_plane).any(|f| {
        f.pieces.iter().any(|piece| {
            let loop_: Vec<Vector3<f64>> = shape.points(piece).collect();
            (0..loop_.len()).all(|i| {
                let (a, b) = (loop_[i], loop_[(i + 1) % loop_.len()]);
                let inward = f.normal.cross(&(b - a));
                inward.dot(&(p - a)) >= -slack * inward.norm()
            })
        })
    })
}
