//! Points and cells of a view.

use super::{VtkPart, ball::ball};
use crate::view::{View, ViewShape};
use nalgebra::Vector3;

/// Up to so many balls have 512 triangles, more have 128: a heap of 5,000 grains stays below 50 MB.
const FINE: usize = 300;

/// A point.
pub struct MeshPoint {
    /// Where, m.
    pub at: Vector3<f64>,
    /// The block it moves with.
    pub block: Option<usize>,
    /// The joint and the corner of it whose force it carries.
    pub contact: Option<(usize, usize)>,
    /// The load that acts there.
    pub load: Option<usize>,
}

/// A cell.
pub struct Cell {
    /// What it is.
    pub part: VtkPart,
    /// The block it belongs to; of a joint and its forces the second block, on which they act.
    pub block: Option<usize>,
    /// Of a joint and its forces: the first block.
    pub other: Option<usize>,
    /// The joint it belongs to.
    pub joint: Option<usize>,
    /// Of a line of thrust: the system of forces, and the force that passes, N.
    pub segment: Option<(usize, f64)>,
    /// The member that it is.
    pub member: Option<usize>,
    /// Its points.
    pub points: Vec<u32>,
}

/// All points and cells; cells in the order in which VTK counts them: vertices, lines, polygons.
#[derive(Default)]
pub struct Mesh {
    /// Points.
    pub points: Vec<MeshPoint>,
    /// Contact points that carry forces, contacts at points, places of loads, and members that act at
    /// a point.
    pub verts: Vec<Cell>,
    /// Lines of thrust, contacts along edges, and members.
    pub lines: Vec<Cell>,
    /// Faces of blocks, and joints.
    pub polys: Vec<Cell>,
}

impl Mesh {
    /// The mesh of a view.
    pub fn of(view: &View) -> Self {
        let mut mesh = Self::blocks_of(view);
        mesh.joints(view);
        mesh.thrust(view);
        mesh.loads(view);
        mesh.members(view);
        mesh
    }

    /// The mesh of its blocks alone.
    pub fn blocks_of(view: &View) -> Self {
        let mut mesh = Self::default();
        mesh.blocks(view);
        mesh
    }

    fn point(
        &mut self,
        at: Vector3<f64>,
        block: Option<usize>,
        contact: Option<(usize, usize)>,
    ) -> u32 {
        self.points.push(MeshPoint { at, block, contact, load: None });
        self.points.len() as u32 - 1
    }

    fn blocks(&mut self, view: &View) {
        let balls = view.bodies.iter().filter(|b| matches!(b.shape, ViewShape::Sphere(_))).count();
        let (corners, faces) = ball(if balls > FINE { 2 } else { 3 });
        for (i, body) in view.bodies.iter().enumerate() {
            let part = if body.support { VtkPart::Support } else { VtkPart::Block };
            let first = self.points.len() as u32;
            let mut face = |points: Vec<u32>| {
                self.polys.push(Cell {
                    part,
                    block: Some(i),
                    other: None,
                    joint: None,
                    segment: None,
                    member: None,
                    points,
                })
            };
            match &body.shape {
                ViewShape::Surface(s) => {
                    s.pieces
                        .iter()
                        .for_each(|piece| face(piece.iter().map(|v| first + v).collect()));
                    self.points.extend(s.corners.iter().map(|&at| MeshPoint {
                        at,
                        block: Some(i),
                        contact: None,
                        load: None,
                    }));
                }
                ViewShape::Sphere(radius) => {
                    faces.iter().for_each(|f| face(f.iter().map(|v| first + v).collect()));
                    let at = |c: &Vector3<f64>| body.center + c * *radius;
                    self.points.extend(corners.iter().map(|c| MeshPoint {
                        at: at(c),
                        block: Some(i),
                        contact: None,
                        load: None,
                    }));
                }
            }
        }
    }

    fn joints(&mut self, view: &View) {
        for (k, joint) in view.joints.iter().enumerate() {
            let points: Vec<u32> = joint
                .points
                .iter()
                .enumerate()
                .map(|(c, &at)| self.point(at, None, Some((k, c))))
                .collect();
            let cell = |part, points| Cell {
                part,
                block: Some(joint.b),
                other: Some(joint.a),
                joint: Some(k),
                segment: None,
                member: None,
                points,
            };
            for &p in &points {
                self.verts.push(cell(VtkPart::Force, vec![p]));
            }
            let cell = cell(VtkPart::Joint, points);
            match cell.points.len() {
                0 => {}
                1 => self.verts.push(cell),
                2 => self.lines.push(cell),
                _ => self.polys.push(cell),
            }
        }
    }

    fn loads(&mut self, view: &View) {
        for (k, load) in view.loads.iter().enumerate() {
            let point = self.points.len() as u32;
            self.points.push(MeshPoint { at: load.at, block: None, contact: None, load: Some(k) });
            let part = if load.live { VtkPart::LiveLoad } else { VtkPart::Load };
            self.verts.push(Cell {
                part,
                block: Some(load.body),
                other: None,
                joint: None,
                segment: None,
                member: None,
                points: vec![point],
            });
        }
    }

    fn members(&mut self, view: &View) {
        for (k, member) in view.members.iter().enumerate() {
            let points: Vec<u32> =
                member.points.iter().map(|&at| self.point(at, None, None)).collect();
            let cells = if points.len() > 1 { &mut self.lines } else { &mut self.verts };
            cells.push(Cell {
                part: VtkPart::Member,
                block: None,
                other: None,
                joint: None,
                segment: None,
                member: Some(k),
                points,
            });
        }
    }

    fn thrust(&mut self, view: &View) {
        for (k, state) in view.states.iter().enumerate() {
            for part in &state.line {
                let points = [part.from, part.to].map(|at| self.point(at, None, None)).to_vec();
                let (block, segment) = (Some(part.body), Some((k, part.force)));
                self.lines.push(Cell {
                    part: VtkPart::Thrust,
                    block,
                    other: None,
                    joint: None,
                    segment,
                    member: None,
                    points,
                });
            }
        }
    }
}
