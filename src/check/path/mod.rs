//! Scenes after large displacements: every pose is a scene of its own, whose contacts follow from
//! the poses alone.
//!
//! Without sliding, a contact keeps the material points in which it touched at the start: each
//! joint carries its outline twice, once with each of its blocks. Where the two copies of a corner
//! coincide the joint is closed there; where they part it has opened. Joints that have slid touch
//! where their faces have come to. Found anew from the shapes, an
//! edge that has become a hinge would be lost: it has no area. The normal is that of the face that
//! goes on beyond the corner of the other, and half-way between the two faces where both end there.

pub mod drive;
mod faces;
pub mod member;
mod near;
pub mod reaction;
pub mod saved;
mod side;
mod slid;
mod supports;

use base::tolerance;
pub use drive::{Demand, Drive, Move, Moves};
pub use faces::Spot;
use model::{
    assembly::Pose,
    interface::{ContactFrame, ContactKind, Interface, Interfaces, Model},
};
use nalgebra::Vector3;
pub use side::Side;

/// The joints of a scene at its start, carried along with their blocks.
#[derive(Clone, Debug)]
pub struct Carried<'a> {
    /// The scene at its start.
    pub start: &'a Model,
    /// Whose face goes on beyond each corner.
    sides: Vec<Vec<Side>>,
    /// The joints at the start, and behind them those of faces that may come to touch, without
    /// points.
    pub joints: Vec<Interface>,
    /// The faces that meet in each joint.
    faces: Vec<faces::Faces>,
}

/// A displaced scene.
#[derive(Clone, Debug)]
pub struct Displaced {
    /// The blocks at their poses, with the contacts that are closed.
    pub model: Model,
    /// The interface at the start that each contact comes from.
    pub from: Vec<usize>,
    /// The corner that has sunk deepest into its neighbour; of a joint that has slid any one.
    pub deepest: Option<Corner>,
}

/// A corner of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Index of the interface at the start.
    pub interface: usize,
    /// Index of its point.
    pub point: usize,
    /// How far it is open, over the size of the smaller block; < 0 where the blocks overlap.
    pub gap: f64,
    /// The same as the way between its two copies.
    pub apart: f64,
}

impl<'a> Carried<'a> {
    /// The joints of a scene.
    pub fn new(start: &'a Model) -> Self {
        let list = || start.interfaces.list.iter();
        let sides = list().map(|f| side::sides(&start.assembly, f)).collect();
        let mut faces: Vec<faces::Faces> =
            list().map(|f| faces::Faces::of(&start.assembly, f)).collect();
        let mut joints = start.interfaces.list.clone();
        for (joint, own) in near::joints(&start.assembly, &start.interfaces.list) {
            joints.push(joint);
            faces.push(own);
        }
        Self { start, sides, joints, faces }
    }

    /// The size of the smaller block of a joint, m.
    pub fn size(&self, interface: usize) -> f64 {
        let face = &self.joints[interface];
        let blocks = &self.start.assembly.blocks;
        blocks[face.a].size.min(blocks[face.b].size)
    }

    /// The two copies of a corner: as it moves with block `a` and with block `b`, m.
    pub fn copies(&self, poses: &[Pose], interface: usize, point: usize) -> [Vector3<f64>; 2] {
        let face = &self.start.interfaces.list[interface];
        [face.a, face.b]
            .map(|i| poses[i].apply(&self.start.assembly.blocks[i].centroid, &face.points[point]))
    }

    /// The way from the copy with block `a` to that with block `b`, m.
    pub fn parted(&self, poses: &[Pose], interface: usize, point: usize) -> Vector3<f64> {
        let face = &self.start.interfaces.list[interface];
        let [a, b] = [face.a, face.b]
            .map(|i| poses[i].way(&self.start.assembly.blocks[i].centroid, &face.points[point]));
        b - a
    }

    /// The normal at a corner, from block `a` into block `b`.
    pub fn normal(&self, poses: &[Pose], interface: usize, point: usize) -> Vector3<f64> {
        let face = &self.start.interfaces.list[interface];
        let [a, b] = [face.a, face.b].map(|i| poses[i].turn * face.frame.n);
        match self.sides[interface][point] {
            Side::A => a,
            Side::B => b,
            Side::Neither => (a + b).normalize(),
        }
    }

    /// One corner.
    pub fn corner(&self, poses: &[Pose], interface: usize, point: usize) -> Corner {
        let (way, size) = (self.parted(poses, interface, point), self.size(interface));
        let gap = self.normal(poses, interface, point).dot(&way) / size;
        Corner { interface, point, gap, apart: way.norm() / size }
    }

    /// All corners, joint by joint.
    pub fn corners(&self, poses: &[Pose]) -> Vec<Vec<Corner>> {
        let list = &self.start.interfaces.list;
        (0..list.len())
            .map(|k| (0..list[k].points.len()).map(|p| self.corner(poses, k, p)).collect())
            .collect()
    }

    /// The corners that are closed at these poses, joint by joint.
    pub fn closed(&self, poses: &[Pose]) -> Vec<Vec<usize>> {
        let closed = |c: &&Corner| c.apart <= tolerance::JOINT_CLOSED;
        let corners = self.corners(poses).into_iter();
        corners.map(|list| list.iter().filter(closed).map(|c| c.point).collect()).collect()
    }

    /// The scene at these poses, one a block.
    pub fn displaced(&self, poses: &[Pose]) -> Displaced {
        let slid: Vec<Option<Vec<Spot>>> =
            (0..self.joints.len()).map(|k| self.slid(poses, k)).collect();
        let mut closed = self.closed(poses);
        closed.resize(self.joints.len(), Vec::new());
        let mut displaced = self.assembled(poses, |k| match &slid[k] {
            None if closed[k].is_empty() => Vec::new(),
            None => vec![self.contact(poses, k, &closed[k])],
            Some(spots) => {
                let reach = tolerance::JOINT_CLOSED * self.size(k);
                let touch: Vec<Spot> =
                    spots.iter().filter(|s| s.gap.abs() <= reach).copied().collect();
                self.contacts(poses, k, &touch).into_iter().map(|(contact, _)| contact).collect()
            }
        });
        displaced.deepest = (0..slid.len())
            .filter_map(|k| {
                let gap = self.depth(poses, k, self.sinks_by_faces(poses, k))?;
                Some(Corner { interface: k, point: 0, gap, apart: gap.abs() })
            })
            .min_by(|a, b| a.gap.total_cmp(&b.gap));
        displaced
    }

    /// The scene at these poses with these corners of each joint closed.
    pub fn touching(&self, poses: &[Pose], closed: &[Vec<usize>]) -> Displaced {
        self.assembled(poses, |k| {
            let points = closed.get(k).map_or(&[][..], |c| &c[..]);
            if points.is_empty() { Vec::new() } else { vec![self.contact(poses, k, points)] }
        })
    }

    /// The scene at these poses with these contacts of each joint.
    pub fn assembled(
        &self,
        poses: &[Pose],
        contacts: impl Fn(usize) -> Vec<Interface>,
    ) -> Displaced {
        let (mut list, mut from) = (Vec::new(), Vec::new());
        for k in 0..self.joints.len() {
            let own = contacts(k);
            from.extend(std::iter::repeat_n(k, own.len()));
            list.extend(own);
        }
        let own = &self.start.interfaces.members;
        let members =
            own.iter().map(|m| member::displaced(&self.start.assembly, poses, m)).collect();
        let interfaces = Interfaces { list, members, ..Interfaces::default() };
        let model = Model::new(self.start.assembly.at(poses), interfaces);
        Displaced { model, from, deepest: None }
    }

    /// What is left of a joint.
    fn contact(&self, poses: &[Pose], k: usize, closed: &[usize]) -> Interface {
        let face = &self.start.interfaces.list[k];
        let at = |p: usize| self.copies(poses, k, p)[0];
        let ways = face.ways.iter().map(|w| poses[face.a].turn * w).collect();
        if closed.len() == face.points.len() {
            let turn = poses[face.a].turn;
            let center = self.start.assembly.blocks[face.a].centroid;
            let ContactFrame { t1, t2, n } = face.frame;
            let moved = |p: &Vector3<f64>| poses[face.a].apply(&center, p);
            return Interface {
                frame: ContactFrame { t1: turn * t1, t2: turn * t2, n: turn * n },
                points: face.points.iter().map(moved).collect(),
                pieces: face.pieces.iter().map(|p| p.iter().map(moved).collect()).collect(),
                ways,
                ..face.clone()
            };
        }
        let n = closed.iter().map(|&p| self.normal(poses, k, p)).sum::<Vector3<f64>>().normalize();
        let flat = Interface { area: 0.0, patches: 1, pieces: Vec::new(), ways, ..face.clone() };
        if self.spans(k, closed) {
            let points = closed.iter().map(|&p| at(p)).collect();
            return Interface { frame: ContactFrame::around(n), points, ..flat };
        }
        let start = |p: usize| face.points[p];
        // The ends of an edge; inner points of it carry nothing that the ends do not.
        let along = closed
            .iter()
            .map(|&p| start(p) - start(closed[0]))
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))
            .unwrap_or_default();
        let by = |p: &&usize, q: &&usize| along.dot(&start(**p)).total_cmp(&along.dot(&start(**q)));
        let ends = closed.iter().min_by(by).zip(closed.iter().max_by(by));
        match ends {
            Some((&p, &q)) if along.norm() > tolerance::JOINT_CLOSED * self.size(k) => Interface {
                kind: ContactKind::Edge,
                frame: ContactFrame::along(n, at(q) - at(p)),
                points: vec![at(p), at(q)],
                ..flat
            },
            _ => Interface {
                kind: ContactKind::Point,
                frame: ContactFrame::around(n),
                points: vec![at(closed[0])],
                ..flat
            },
        }
    }

    /// Whether corners of a joint span an area: then they fix one block to the other.
    pub fn spans(&self, k: usize, points: &[usize]) -> bool {
        let face = &self.start.interfaces.list[k];
        let least = SPANS * self.size(k).powi(2);
        let first = points.first().map(|&p| face.points[p]);
        first.is_some_and(|o| {
            points.iter().any(|&p| {
                points
                    .iter()
                    .any(|&q| (face.points[p] - o).cross(&(face.points[q] - o)).norm() > least)
            })
        })
    }
}

/// Corners whose triangle is smaller than this × the size of the smaller block squared lie on a
/// line. Larger: thin joints turn about a line that is none. Smaller: rounding fixes hinges.
const SPANS: f64 = 1e-9;
