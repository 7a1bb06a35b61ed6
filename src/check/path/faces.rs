//! The faces that meet in a joint, carried with their blocks.

use super::side::Side;
use base::plane::{polygon, polygon::P2};
use model::{
    assembly::{Assembly, Facet, Polyhedron, Solid},
    interface::{ContactFrame, Interface},
};
use nalgebra::Vector3;

/// The faces that meet in a joint, of block `a` and of block `b`: a point in the plane of each, a
/// frame with the normal of `a` (for both), and convex pieces in its coordinates `(t1, t2)` about
/// that point, counter-clockwise around it, m.
#[derive(Clone, Debug)]
pub(super) struct Faces {
    pub middle: [Vector3<f64>; 2],
    pub frames: [ContactFrame; 2],
    pub pieces: [Vec<Vec<P2>>; 2],
}

/// A place where a joint touches, or would if its gap closed.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// Where, m.
    pub at: Vector3<f64>,
    /// How far it is open along its normal, m; < 0 where the blocks overlap.
    pub gap: f64,
    /// The unit normal, from block `a` into block `b`.
    pub normal: Vector3<f64>,
    /// Whose face has that normal.
    pub side: Side,
}

/// Facets further off the plane of a joint than this × the size of their block, or turned from it
/// by more than this, are others.
const IN_PLANE: f64 = 1e-3;

/// A piece of a facet in the coordinates of a frame about a point, counter-clockwise around it.
pub(super) fn flat(
    shape: &Polyhedron,
    piece: &[u32],
    frame: &ContactFrame,
    middle: &Vector3<f64>,
) -> Vec<P2> {
    let seen = |p: Vector3<f64>| P2::new(frame.t1.dot(&(p - middle)), frame.t2.dot(&(p - middle)));
    let mut flat: Vec<P2> = shape.points(piece).map(seen).collect();
    if polygon::area(&flat) < 0.0 {
        flat.reverse();
    }
    flat
}

impl Faces {
    /// Those of a joint that touches at the start: they lie in its plane.
    pub(super) fn of(assembly: &Assembly, face: &Interface) -> Self {
        let middle = face.points.iter().sum::<Vector3<f64>>() / face.points.len().max(1) as f64;
        let n = face.frame.n;
        let pieces = [(face.a, n), (face.b, -n)].map(|(i, outward)| {
            let block = &assembly.blocks[i];
            let Solid::Polyhedron(shape) = &block.solid else { return Vec::new() };
            let in_plane = |f: &&Facet| {
                f.normal.cross(&outward).norm() <= IN_PLANE
                    && f.normal.dot(&outward) > 0.0
                    && (f.normal.dot(&middle) - f.offset).abs() <= IN_PLANE * block.size
            };
            let pieces = shape.facets.iter().filter(in_plane).flat_map(|f| &f.pieces);
            pieces.map(|piece| flat(shape, piece, &face.frame, &middle)).collect()
        });
        Self { middle: [middle; 2], frames: [face.frame; 2], pieces }
    }

    /// Those of two facets that may come to touch.
    pub(super) fn between(shapes: [&Polyhedron; 2], facets: [&Facet; 2]) -> Self {
        let middle = [0, 1].map(|k| {
            let corners = facets[k].pieces.iter().flat_map(|p| shapes[k].points(p));
            let (sum, count) = corners.fold((Vector3::zeros(), 0.0), |(s, n), p| (s + p, n + 1.0));
            sum / f64::max(count, 1.0)
        });
        let frames = [facets[0].normal, -facets[1].normal].map(ContactFrame::around);
        let pieces = [0, 1].map(|k| {
            let pieces = facets[k].pieces.iter();
            pieces.map(|p| flat(shapes[k], p, &frames[k], &middle[k])).collect()
        });
        Self { middle, frames, pieces }
    }

    /// Whether both blocks have a face there: a joint of edges and corners has none.
    pub(super) fn are_known(&self) -> bool {
        self.pieces.iter().all(|p| !p.is_empty())
    }
}
