//! The joints of a model, each with its stiffness.

use super::{
    bed::{Bed, Domain},
    grain::Grain,
    law::{Friction, Resultant},
    member::Line,
    number::{Dual, Number},
};
use crate::verdict::Rate;
use base::{
    error::{Finding, FindingCode, InputError, JsonPath},
    plane::{Sets, polygon::P2},
};
use model::{
    assembly::{Assembly, Block, Solid, Wrench},
    interface::{ContactFrame, Interface, Model},
    strength,
};
use nalgebra::{Matrix6, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// What a joint remembers of the step before.
#[derive(Clone, Debug)]
pub enum Past {
    /// Of a bed.
    Bed(super::bed::Past),
    /// Of spheres.
    Grain(super::grain::Past),
}

/// Where joints with an area are integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Quadrature {
    /// Exactly, over the part that is pressed.
    #[default]
    Area,
    /// At the corners of each joint, with an even share of its area: the compliance of the state under
    /// dry friction of the other questions, three times too stiff against turning.
    Corners,
}

/// All joints of a model, in the order of its interfaces, and its members.
#[derive(Clone, Debug)]
pub struct Joints {
    /// The joints.
    pub list: Vec<ElasticJoint>,
    /// Ties, struts, bars and tendons, in the order of the scene's members.
    pub lines: Vec<Line>,
    /// The free blocks of the structures that a live load acts on; others do not take part in what
    /// happens along it.
    pub reached: BTreeSet<usize>,
    /// What was assumed.
    pub findings: Vec<Finding>,
}

/// A joint that yields.
#[derive(Clone, Debug)]
pub struct ElasticJoint {
    /// Index of the first block.
    pub a: usize,
    /// Index of the second block.
    pub b: usize,
    /// Those of both that may move.
    pub free: Vec<usize>,
    /// Where relative displacements are measured, m.
    pub at: Vector3<f64>,
    /// Its frame.
    pub frame: ContactFrame,
    /// Its law.
    pub kind: JointKind,
}

/// How a joint yields.
#[derive(Clone, Debug)]
pub enum JointKind {
    /// A bed of springs.
    Bed(Bed),
    /// Hertz and Mindlin.
    Grain(Grain),
}

/// What a scene needs for the question, in words for errors.
const STIFFNESS: &str = "add \"normal_stiffness\" (Pa/m; 10 N/mm³ is 1e10) to joints.default, or to an override for this joint";
const MODULI: &str =
    "add \"young\" (Pa) and \"poisson\" to its material: spheres deform by Hertz's law";

/// Refuses models that the question has no answer for.
///
/// # Errors
/// Strengths or pressures that it does not know.
pub fn needs(model: &Model) -> Result<(), InputError> {
    let root = JsonPath::root();
    for face in &model.interfaces.list {
        let law = &face.law;
        let unknown = [
            (strength::tension(face) > 0.0, "tension"),
            (law.cohesion > 0.0, "cohesion"),
            (law.compression.is_finite(), "compression"),
            (law.pore_pressure > 0.0, "pore_pressure"),
            (strength::rolling_arm(face) > 0.0, "rolling_arm"),
        ];
        if let Some((_, word)) = unknown.iter().find(|u| u.0) {
            let (a, b) = names(&model.assembly, face);
            let text = format!(
                "the joint between {a} and {b} has a {word}: the state with elastic joints handles dry joints only"
            );
            return Err(InputError::at(root.key("joints"), text)
                .hint(format!("leave {word} out, or ask `assess`")));
        }
    }
    Ok(())
}

fn names(assembly: &Assembly, face: &Interface) -> (String, String) {
    let name = |i: usize| assembly.blocks[i].id.clone();
    (name(face.a), name(face.b))
}

impl Joints {
    /// The joints of a model.
    ///
    /// # Errors
    /// As [`needs`]; a member of a kind that it does not know; a joint or a member whose stiffness is
    /// not known.
    pub fn new(model: &Model, quadrature: Quadrature) -> Result<Self, InputError> {
        needs(model)?;
        let faces = &model.interfaces.list;
        let corners = Corners::new(model);
        let mut told = Told::default();
        let list: Vec<ElasticJoint> = faces
            .iter()
            .map(|face| joint(&model.assembly, face, quadrature, &corners, &mut told))
            .collect::<Result<_, _>>()?;
        let members = model.interfaces.members.iter();
        let lines: Vec<Line> =
            members.map(|m| Line::new(&model.assembly, m)).collect::<Result<_, _>>()?;
        let mut joints = Self { list, lines, reached: BTreeSet::new(), findings: told.findings() };
        joints.reached = joints.reached(model);
        Ok(joints)
    }

    /// The free blocks of each joint, then those of each member: what is joined by one moves together.
    pub fn groups(&self) -> impl Iterator<Item = Vec<usize>> {
        let lines = self.lines.iter().map(|l| l.on.iter().map(|w| w.0).collect());
        self.list.iter().map(|j| j.free.clone()).chain(lines)
    }

    fn reached(&self, model: &Model) -> BTreeSet<usize> {
        let mut sets = Sets::new(model.assembly.blocks.len());
        for group in self.groups() {
            for pair in group.windows(2) {
                sets.join(pair[0], pair[1]);
            }
        }
        let live = model.assembly.free().filter(|&i| model.assembly.live[i] != Wrench::zero());
        let live: BTreeSet<usize> = live.map(|i| sets.find(i)).collect();
        model.assembly.free().filter(|&i| live.contains(&sets.find(i))).collect()
    }

    /// For every joint the greatest of a number (>= 0, one a joint) among the joints of its free
    /// blocks: what is small beside it is small there. What acts on other blocks excuses nothing.
    pub fn greatest_near(&self, of: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut most: BTreeMap<usize, f64> = BTreeMap::new();
        for (k, joint) in self.list.iter().enumerate() {
            for &i in &joint.free {
                let here = most.entry(i).or_insert(0.0);
                *here = here.max(of(k));
            }
        }
        let near = |j: &ElasticJoint| j.free.iter().map(|i| most[i]).fold(0.0, f64::max);
        self.list.iter().map(near).collect()
    }
}

/// Area and corners of the joints of each free block, for contacts that have no area.
struct Corners(Vec<(f64, usize)>);

impl Corners {
    fn new(model: &Model) -> Self {
        let blocks = &model.assembly.blocks;
        let mut of = vec![(0.0, 0); blocks.len()];
        for face in model.interfaces.list.iter().filter(|f| f.area > 0.0) {
            for i in [face.a, face.b].into_iter().filter(|&i| !blocks[i].support) {
                of[i] = (of[i].0 + face.area, of[i].1 + face.points.len());
            }
        }
        Self(of)
    }

    /// The share of the average corner of the joints of two blocks.
    fn share(&self, blocks: [usize; 2]) -> Option<f64> {
        let [a, b] = blocks.map(|i| self.0[i]);
        let (area, count) = (a.0 + b.0, a.1 + b.1);
        (count > 0).then(|| area / count as f64)
    }
}

/// What was assumed, and for how many joints or blocks.
#[derive(Default)]
struct Told {
    shear: usize,
    edges: usize,
    rigid: BTreeSet<String>,
}

impl Told {
    fn findings(&self) -> Vec<Finding> {
        let mut texts = Vec::new();
        if self.shear > 0 {
            texts.push(format!(
                "{} joints have no shear_stiffness: their normal_stiffness is used",
                self.shear
            ));
        }
        if self.edges > 0 {
            texts.push(format!(
                "{} contacts at edges or points have no area: each of their points gets the mean stiffness of a corner of the other joints of its blocks",
                self.edges
            ));
        }
        let mut rigid = self.rigid.iter();
        if let Some(first) = rigid.next() {
            let more = match rigid.count() {
                0 => String::new(),
                n => format!(" and {n} more"),
            };
            texts.push(format!(
                "block {first:?}{more} without young and poisson: rigid in contact with spheres"
            ));
        }
        texts.into_iter().map(|t| Finding::new(FindingCode::Assumed, t)).collect()
    }
}

fn joint(
    assembly: &Assembly,
    face: &Interface,
    quadrature: Quadrature,
    others: &Corners,
    told: &mut Told,
) -> Result<ElasticJoint, InputError> {
    let (one, two) = (&assembly.blocks[face.a], &assembly.blocks[face.b]);
    let count = face.points.len().max(1) as f64;
    let at = face.points.iter().sum::<Vector3<f64>>() / count;
    let frame = face.frame;
    let flat = |p: &Vector3<f64>| {
        let d = p - at;
        P2::new(d.dot(&frame.t1), d.dot(&frame.t2))
    };
    let mu = face.law.friction.mu();
    let free = [face.a, face.b].into_iter().filter(|&i| !assembly.blocks[i].support).collect();
    let new = |kind| ElasticJoint { a: face.a, b: face.b, free, at, frame, kind };
    if one.solid.is_round() || two.solid.is_round() {
        return Ok(new(JointKind::Grain(grain([one, two], &at, mu, told)?)));
    }
    let Some(normal) = face.law.normal_stiffness else {
        let (a, b) = names(assembly, face);
        let text = format!("the joint between {a} and {b} has no normal_stiffness");
        return Err(InputError::at(JsonPath::root().key("joints"), text).hint(STIFFNESS));
    };
    let shear = face.law.shear_stiffness.unwrap_or_else(|| {
        told.shear += 1;
        normal
    });
    let corners: Vec<P2> = face.points.iter().map(flat).collect();
    let place = if corners.len() < 3 || face.area <= 0.0 {
        told.edges += 1;
        let Some(share) = others.share([face.a, face.b]) else {
            let (a, b) = names(assembly, face);
            let text = format!(
                "the contact between {a} and {b} has no area, nor has any other joint of theirs: a stiffness in Pa/m cannot be applied"
            );
            return Err(InputError::at(JsonPath::root().key("joints"), text)
                .hint("cut off the edge to make a face, or ask `assess`"));
        };
        Domain::Points(corners.into_iter().map(|p| (p, share)).collect())
    } else {
        match quadrature {
            Quadrature::Corners => {
                let share = face.area / count;
                Domain::Points(corners.into_iter().map(|p| (p, share)).collect())
            }
            Quadrature::Area if face.pieces.is_empty() => {
                Domain::Triangles(Bed::triangles(&[corners]))
            }
            Quadrature::Area => {
                let pieces: Vec<Vec<P2>> =
                    face.pieces.iter().map(|p| p.iter().map(flat).collect()).collect();
                Domain::Triangles(Bed::triangles(&pieces))
            }
        }
    };
    Ok(new(JointKind::Bed(Bed { normal, shear, mu, place })))
}

fn grain(
    blocks: [&Block; 2],
    at: &Vector3<f64>,
    mu: f64,
    told: &mut Told,
) -> Result<Grain, InputError> {
    let curvature: f64 = blocks.iter().filter_map(|b| radius(b, at)).map(|r| 1.0 / r).sum();
    let known = || blocks.iter().filter_map(|b| b.elastic);
    let normal: f64 = known().map(|e| (1.0 - e.poisson * e.poisson) / e.young).sum();
    let shear: f64 = known().map(|e| (2.0 - e.poisson) / e.shear()).sum();
    if normal <= 0.0 || shear <= 0.0 {
        let [a, b] = blocks.map(|b| &b.id);
        let text = format!("neither {a} nor {b}, which touch at a point, has young and poisson");
        return Err(InputError::at(JsonPath::root().key("materials"), text).hint(MODULI));
    }
    for block in blocks.iter().filter(|b| b.elastic.is_none()) {
        told.rigid.insert(block.id.clone());
    }
    Ok(Grain { radius: 1.0 / curvature, modulus: 1.0 / normal, shear: 1.0 / shear, mu })
}

/// The radius of a round block where it is touched; nothing of faces.
fn radius(block: &Block, at: &Vector3<f64>) -> Option<f64> {
    match &block.solid {
        Solid::Polyhedron(_) => None,
        Solid::Sphere { radius, .. } => Some(*radius),
        Solid::Clump { balls, .. } => {
            let off = |(c, r): &(Vector3<f64>, f64)| ((at - c).norm() - r).abs();
            balls.iter().min_by(|x, y| off(x).total_cmp(&off(y))).map(|b| b.1)
        }
    }
}

impl ElasticJoint {
    /// The relative displacement at given displacements of all blocks.
    pub fn motion(&self, assembly: &Assembly, displaced: &[Rate]) -> [f64; 6] {
        let of = |i: usize| {
            let q = &displaced[i];
            q.velocity + q.spin.cross(&(self.at - assembly.blocks[i].centroid))
        };
        let way = of(self.b) - of(self.a);
        let turn = displaced[self.b].spin - displaced[self.a].spin;
        let [x, y] = [self.local(&way), self.local(&turn)];
        [x[0], x[1], x[2], y[0], y[1], y[2]]
    }

    fn local(&self, v: &Vector3<f64>) -> [f64; 3] {
        [self.frame.t1, self.frame.t2, self.frame.n].map(|axis| axis.dot(v))
    }

    /// From its frame to that of the scene.
    pub fn outward(&self, [x, y, z]: [f64; 3]) -> Vector3<f64> {
        self.frame.t1 * x + self.frame.t2 * y + self.frame.n * z
    }

    /// A point of its plane in the scene.
    pub fn place(&self, [x, y]: [f64; 2]) -> Vector3<f64> {
        self.at + self.frame.t1 * x + self.frame.t2 * y
    }

    /// How the relative displacement depends on the displacement of one of its blocks: rows as
    /// [`Self::motion`], columns as a displacement; the first block with the other sign.
    pub fn lever(&self, assembly: &Assembly, block: usize) -> Matrix6<f64> {
        let arm = self.at - assembly.blocks[block].centroid;
        let mut lever = Matrix6::zeros();
        for (i, axis) in [self.frame.t1, self.frame.t2, self.frame.n].iter().enumerate() {
            // axis · (v + θ × arm) = axis · v + θ · (arm × axis)
            let turn = arm.cross(axis);
            for k in 0..3 {
                lever[(i, k)] = axis[k];
                lever[(i, k + 3)] = turn[k];
                lever[(i + 3, k + 3)] = axis[k];
            }
        }
        if block == self.a { -lever } else { lever }
    }

    /// The response on the second block.
    pub fn respond<S: Number>(
        &self,
        past: &Past,
        motion: &[S; 6],
        friction: Friction,
    ) -> Resultant<S> {
        match (&self.kind, past) {
            (JointKind::Bed(bed), Past::Bed(past)) => bed.respond(past, motion, friction, |_| {}),
            (JointKind::Grain(grain), Past::Grain(past)) => grain.respond(past, motion, friction).0,
            _ => Resultant::zero(),
        }
    }

    /// The response as six numbers, and its slopes by the relative displacement.
    pub fn tangent(
        &self,
        past: &Past,
        motion: &[f64; 6],
        friction: Friction,
    ) -> ([f64; 6], Matrix6<f64>) {
        let all = self.respond(past, &Dual::variables(motion), friction);
        let mut slopes = Matrix6::zeros();
        let mut values = [0.0; 6];
        for (i, part) in all.force.iter().chain(&all.moment).enumerate() {
            values[i] = part.value;
            for k in 0..6 {
                slopes[(i, k)] = part.slopes[k];
            }
        }
        (values, slopes)
    }
}
