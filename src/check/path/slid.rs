//! Where a joint touches after it has slid, from the poses alone.
//!
//! The faces that met at the start are carried with their blocks, and cut by each other where they
//! have come to. Over what they have in common the gap is linear, so that it is least at a corner of
//! that: a corner of one block on the face of the other, with the normal of that face, or two edges
//! that cross. Where two corners are at one place the normal is half-way between the faces, as it is
//! without sliding.

use super::{Carried, faces::Spot, side::Side};
use base::{
    plane::{clip, polygon, polygon::P2},
    tolerance,
};
use model::{
    assembly::Pose,
    interface::{ContactFrame, ContactKind, Interface},
};
use nalgebra::Vector3;

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

    /// Whether the faces of a joint say how deep it has sunk: it has slid there, or no corner is
    /// where it was, so that the copies of corners say nothing.
    pub fn sinks_by_faces(&self, poses: &[Pose], interface: usize) -> bool {
        let mut points = 0..self.joints[interface].points.len();
        let stays = |p: usize| self.corner(poses, interface, p).apart <= tolerance::JOINT_CLOSED;
        self.may_slide(interface) && (self.slid(poses, interface).is_some() || !points.any(stays))
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
                    ways: Vec::new(),
                    ..face.clone()
                };
                Some((contact, own))
            })
            .collect()
    }
}

/// Faces that have turned from each other until the cosine between them is less are no joint.
const STEEP: f64 = 0.5;
