//! Where a joint touches after it has slid, from the poses alone.
//!
//! The faces that met at the start are carried with their blocks, and cut by each other where they
//! have come to. Over what they have in common the gap is linear, so that it is least at a corner of
//! that: a corner of one block on the face of the other, with the normal of that face, or two edges
//! that cross. Where two corners are at one place the normal is half-way between the faces, as it is
//! without sliding.

use super::{Carried, Side};
use base::{
    plane::{clip, polygon, polygon::P2},
    tolerance,
};
use model::{
    assembly::{Assembly, Facet, Polyhedron, Pose, Solid},
    interface::{ContactFrame, ContactKind, Interface},
};
use nalgebra::Vector3;

/// The faces that meet in a joint, of block `a` and of block `b`: a point in the plane of each, a
/// frame with the normal of `a` (for both), and convex pieces in its coordinates `(t1, t2)` about
/// that point, counter-clockwise around it, m.
#[derive(Clone, Debug)]
pub(super) struct Faces {
    middle: [Vector3<f64>; 2],
    frames: [ContactFrame; 2],
    pieces: [Vec<Vec<P2>>; 2],
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

impl Carried<'_> {
    /// Whether it is known where a joint touches once it has slid.
    pub fn may_slide(&self, interface: usize) -> bool {
        self.faces[interface].are_known()
    }

    /// Where a joint touches, or may; none where its faces are not above each other any more.
    pub fn spots(&self, poses: &[Pose], interface: usize) -> Vec<Spot> {
        let (face, faces) = (&self.joints[interface], &self.faces[interface]);
        let places = [0, 1].map(|k| {
            let (i, middle) = ([face.a, face.b][k], &faces.middle[k]);
            poses[i].way(&self.start.assembly.blocks[i].centroid, middle)
        });
        let parted = (faces.middle[1] - faces.middle[0]) + (places[1] - places[0]);
        let turned = |k: usize, i: usize| {
            let ContactFrame { t1, t2, n } = faces.frames[k];
            [t1, t2, n].map(|e| poses[i].turn * e)
        };
        let ([u, v, up], [ub, vb, across]) = (turned(0, face.a), turned(1, face.b));
        let slope = across.dot(&up);
        if slope <= STEEP {
            return Vec::new();
        }
        let seen = |p: &P2| {
            let x = parted + ub * p.x + vb * p.y;
            P2::new(u.dot(&x), v.dot(&x))
        };
        let tol = tolerance::JOINT_CLOSED * self.size(interface);
        let below = &faces.pieces[0];
        let above: Vec<Vec<P2>> =
            faces.pieces[1].iter().map(|piece| piece.iter().map(seen).collect()).collect();
        let mut common: Vec<Vec<P2>> = Vec::new();
        for own in below {
            common.extend(
                above.iter().map(|other| clip::clip(other, own, tol)).filter(|c| !c.is_empty()),
            );
        }
        let corners = match &common[..] {
            [one] => one.clone(),
            many => polygon::hull(&many.concat(), tol),
        };
        let is_corner =
            |of: &[Vec<P2>], p: &P2| of.iter().flatten().any(|q| (p - q).norm() <= 4.0 * tol);
        let origin = faces.middle[0] + places[0];
        corners
            .into_iter()
            .map(|p| {
                let height = across.dot(&(parted - u * p.x - v * p.y)) / slope;
                let (side, share) = match (is_corner(below, &p), is_corner(&above, &p)) {
                    (false, true) => (Side::A, 1.0),
                    (true, false) => (Side::B, 0.0),
                    _ => (Side::Neither, 0.5),
                };
                let normal = match side {
                    Side::A => up,
                    Side::B => across,
                    Side::Neither => (up + across).normalize(),
                };
                let at = origin + u * p.x + v * p.y + up * (share * height);
                Spot { at, gap: height * up.dot(&normal), normal, side }
            })
            .collect()
    }

    /// Where a joint that has slid touches; nothing for one that is closed, or turns about corners
    /// that are still where they were, or is open.
    pub fn slid(&self, poses: &[Pose], interface: usize) -> Option<Vec<Spot>> {
        if !self.may_slide(interface) {
            return None;
        }
        let points = 0..self.joints[interface].points.len();
        let mut beside = false;
        let mut together = false;
        for c in points.map(|p| self.corner(poses, interface, p)) {
            together |= c.apart <= tolerance::JOINT_CLOSED;
            beside |= c.apart > tolerance::JOINT_CLOSED && c.gap.abs() <= tolerance::JOINT_CLOSED;
        }
        if together && !beside {
            return None;
        }
        let spots = self.spots(poses, interface);
        let closed = |s: &Spot| s.gap.abs() <= tolerance::JOINT_CLOSED * self.size(interface);
        spots.iter().any(closed).then_some(spots)
    }

    /// How deep a joint has sunk, over the size of its smaller block, < 0 where the blocks overlap:
    /// by its carried corners, or where it may have slid by its faces.
    pub fn depth(&self, poses: &[Pose], interface: usize, by_faces: bool) -> Option<f64> {
        let size = self.size(interface);
        if by_faces {
            let spots = self.spots(poses, interface);
            return spots.iter().map(|s| s.gap / size).min_by(f64::total_cmp);
        }
        let points = 0..self.joints[interface].points.len();
        let gaps = points.map(|p| self.corner(poses, interface, p));
        gaps.filter(|c| c.apart > tolerance::JOINT_CLOSED).map(|c| c.gap).min_by(f64::total_cmp)
    }

    /// How far the two blocks of a joint have slid at a place where they touch, m: the way between
    /// the points of them that were there at the start.
    pub fn slip(&self, poses: &[Pose], interface: usize, at: &Vector3<f64>) -> f64 {
        let face = &self.joints[interface];
        let [a, b] = [face.a, face.b].map(|i| self.before(poses, i, at));
        (b - a).norm()
    }

    /// Where the point of a block that has come to `at` was at the start, m.
    pub fn before(&self, poses: &[Pose], block: usize, at: &Vector3<f64>) -> Vector3<f64> {
        let c = self.start.assembly.blocks[block].centroid;
        let arm = at - c - poses[block].shift;
        c + poses[block].turn.inverse() * arm
    }

    /// Contacts at some places of a joint, those with the normal of one face together; with each the
    /// places.
    pub fn contacts(
        &self,
        poses: &[Pose],
        interface: usize,
        spots: &[Spot],
    ) -> Vec<(Interface, Vec<Spot>)> {
        let face = &self.joints[interface];
        [Side::A, Side::B, Side::Neither]
            .into_iter()
            .filter_map(|side| {
                let own: Vec<Spot> = spots.iter().filter(|s| s.side == side).copied().collect();
                let n = own.first()?.normal;
                let points: Vec<Vector3<f64>> = own.iter().map(|s| s.at).collect();
                let (kind, frame) = match points[..] {
                    [_] => (ContactKind::Point, ContactFrame::around(n)),
                    [p, q] => (ContactKind::Edge, ContactFrame::along(n, q - p)),
                    _ => {
                        let along = poses[face.a].turn * face.frame.t1;
                        (ContactKind::Face, ContactFrame::along(n, along))
                    }
                };
                let flat: Vec<P2> =
                    points.iter().map(|p| P2::new(frame.t1.dot(p), frame.t2.dot(p))).collect();
                let area = polygon::area(&flat).abs();
                let contact = Interface {
                    kind,
                    frame,
                    points,
                    area,
                    patches: 1,
                    pieces: Vec::new(),
                    ..face.clone()
                };
                Some((contact, own))
            })
            .collect()
    }
}

/// Faces that have turned from each other until the cosine between them is less are no joint.
const STEEP: f64 = 0.5;
