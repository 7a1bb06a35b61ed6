//! Assembly and interfaces → bodies with shapes, in the engine's units and without its name.

use super::{
    pieces::{self, MOST},
    units::Units,
};
use base::{
    error::InputError,
    tolerance::{SKIN, SKIN_OF_THICKNESS},
};
use model::{
    assembly::{Assembly, Block, JointLaw, Solid},
    interface::{ContactKind, Interface, Model},
    strength::rolling_arm,
};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use scene::Friction;
use std::collections::{HashMap, HashSet, hash_map::Entry};

/// A block as the engine sees it; coordinates about its own centre of mass, axes those of the scene
/// at the start.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub support: bool,
    pub center: Vector3<f64>,
    /// With what the block carries.
    pub mass: f64,
    /// About the centre of all that mass.
    pub inertia: Matrix3<f64>,
    /// The centre of all that mass; at the origin where the block carries nothing.
    pub com: Vector3<f64>,
    pub shapes: Vec<Shape>,
    /// Least distance between two parallel planes that hold the block between them, one of them a
    /// facet's.
    pub thickness: f64,
    /// Farthest point from the centre of mass; 0 for a sphere about its centre, which looks the
    /// same however it turns.
    pub reach: f64,
}

impl Body {
    /// Adds a mass at a point that goes with the block.
    pub fn carry(&mut self, mass: f64, at: Vector3<f64>) {
        let whole = self.mass + mass;
        let way = at - self.com;
        // Two masses about their common centre (Steiner).
        let reduced = self.mass * mass / whole;
        self.inertia +=
            (Matrix3::identity() * way.norm_squared() - way * way.transpose()) * reduced;
        self.com += way * (mass / whole);
        self.mass = whole;
    }
}

/// A convex shape, already smaller by its skin.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    pub form: Form,
    pub skin: f64,
    pub role: Role,
    /// Directions in which other pieces of the same block follow, and the outward normals of the
    /// others.
    pub inner: Vec<Vector3<f64>>,
    pub outer: Vec<Vector3<f64>>,
}

/// What a shape touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Part of the block: touches parts of other blocks.
    Part,
    /// One side of the interface given by hand with this index: touches the other side and nothing
    /// else.
    Given(u32),
}

/// The geometry of a shape.
#[derive(Clone, Debug)]
pub(super) enum Form {
    Ball { at: Vector3<f64>, radius: f64 },
    Cuboid { at: Vector3<f64>, turn: UnitQuaternion<f64>, half: Vector3<f64> },
    Hull { points: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]> },
}

/// Radius of the ball that stands for a contact point given by hand, and margin of the plate it
/// rests on, in block sizes.
const GIVEN_BALL: f64 = 0.02;
const GIVEN_PLATE: f64 = 0.3;

/// The bodies of a scene; polyhedra are smaller by `skin` × their size.
pub(super) fn bodies(model: &Model, units: &Units, skin: f64) -> Result<Vec<Body>, InputError> {
    let Model { assembly, interfaces, .. } = model;
    let mut bodies =
        assembly.blocks.iter().map(|b| body(b, units, skin)).collect::<Result<Vec<_>, _>>()?;
    let apart = laid_down(model);
    for (index, face) in
        interfaces.list.iter().enumerate().filter(|(_, f)| apart.contains(&pair(f)))
    {
        let size = assembly.blocks[face.a].size.min(assembly.blocks[face.b].size) / units.length;
        let points: Vec<_> = face.points.iter().map(|p| units.place(*p)).collect();
        let middle = super::cell::mean(&points);
        let (ball, skin) = (GIVEN_BALL * size, SKIN * size);
        let spread = points.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
        let half = Vector3::new(
            spread + GIVEN_PLATE * size,
            spread + GIVEN_PLATE * size,
            GIVEN_PLATE * size,
        );
        let turn =
            UnitQuaternion::from_basis_unchecked(&[face.frame.t1, face.frame.t2, face.frame.n]);
        let role = Role::Given(index as u32);
        let shape = |form| Shape { form, skin, role, inner: Vec::new(), outer: Vec::new() };
        let at = middle - face.frame.n * half.z - bodies[face.a].center;
        bodies[face.a].shapes.push(shape(Form::Cuboid { at, turn, half: half.map(|h| h - skin) }));
        let center = bodies[face.b].center;
        let balls = points.iter().map(|p| {
            shape(Form::Ball { at: p + face.frame.n * ball - center, radius: ball - skin })
        });
        bodies[face.b].shapes.extend(balls);
    }
    Ok(bodies)
}

/// Pairs of blocks that touch where their contacts say and not where their shapes do, all contacts of a
/// pair alike: those given by hand, and those of faces that overlap, or are not plane and bulge into
/// each other, which statics closes: the engine would throw them apart.
fn laid_down(model: &Model) -> HashSet<(usize, usize)> {
    let blocks = &model.assembly.blocks;
    let is = |face: &&Interface| {
        let size = blocks[face.a].size.min(blocks[face.b].size);
        let warped = |i: usize| match &blocks[i].solid {
            Solid::Polyhedron(p) => p.facets.iter().any(|f| f.warp > SKIN * size),
            _ => false,
        };
        let presses = face.gap < -SKIN * size || warped(face.a) || warped(face.b);
        face.kind == ContactKind::Given || face.kind == ContactKind::Face && presses
    };
    model.interfaces.list.iter().filter(is).map(pair).collect()
}

/// The blocks of a contact, in ascending order.
fn pair(face: &Interface) -> (usize, usize) {
    (face.a.min(face.b), face.a.max(face.b))
}

fn body(block: &Block, units: &Units, skin: f64) -> Result<Body, InputError> {
    let center = units.place(block.centroid);
    let size = block.size / units.length;
    let body = |shapes, thickness, reach| Body {
        support: block.support,
        center,
        mass: block.mass / units.mass,
        inertia: block.inertia / units.inertia(),
        com: Vector3::zeros(),
        shapes,
        thickness,
        reach,
    };
    let part =
        |form, skin| Shape { form, skin, role: Role::Part, inner: Vec::new(), outer: Vec::new() };
    let polyhedron = match &block.solid {
        Solid::Sphere { center: at, radius } => {
            let (at, radius) = (units.place(*at) - center, radius / units.length);
            let skin = SKIN * size;
            let off = at.norm();
            let reach = if off > 1e-9 * radius { off + radius } else { 0.0 };
            return Ok(body(
                vec![part(Form::Ball { at, radius: radius - skin }, skin)],
                2.0 * radius,
                reach,
            ));
        }
        Solid::Clump { balls, .. } => {
            let placed: Vec<_> = balls
                .iter()
                .map(|(at, radius)| (units.place(*at) - center, radius / units.length))
                .collect();
            let least = placed.iter().map(|b| b.1).fold(f64::INFINITY, f64::min);
            let skin = (SKIN * size).min(SKIN_OF_THICKNESS * least);
            let reach = placed.iter().map(|(at, radius)| at.norm() + radius).fold(0.0, f64::max);
            let shapes = placed
                .into_iter()
                .map(|(at, radius)| part(Form::Ball { at, radius: radius - skin }, skin))
                .collect();
            return Ok(body(shapes, 2.0 * least, reach));
        }
        Solid::Polyhedron(polyhedron) => polyhedron,
    };
    let Some(cells) = pieces::pieces(polyhedron, block.centroid, units.length) else {
        let text = format!(
            "{:?} splits into more than {MOST} convex pieces, too many to simulate",
            block.id
        );
        return Err(InputError::at(block.path.clone(), text).hint("give the block a simpler shape"));
    };
    let corners: Vec<Vector3<f64>> =
        polyhedron.vertices.iter().map(|v| (v - block.centroid) / units.length).collect();
    let depth = |normal: &Vector3<f64>, points: &[Vector3<f64>]| {
        let height = |p: &Vector3<f64>| normal.dot(p);
        points.iter().map(height).fold(f64::NEG_INFINITY, f64::max)
            - points.iter().map(height).fold(f64::INFINITY, f64::min)
    };
    let thickness =
        polyhedron.facets.iter().map(|f| depth(&f.normal, &corners)).fold(size, f64::min);
    let reach = corners.iter().map(|c| c.norm()).fold(0.0, f64::max);
    let shapes = cells
        .iter()
        .map(|cell| {
            let own = cell.mesh().0;
            let thin = cell.faces.iter().map(|f| depth(&f.normal, &own)).fold(size, f64::min);
            let skin = (skin * size).min(SKIN_OF_THICKNESS * thin);
            if let Some((half, turn, at)) = pieces::as_box(cell) {
                return part(Form::Cuboid { at, turn, half: half.map(|h| h - skin) }, skin);
            }
            let (points, loops) = cell.eroded(skin);
            let fan = |l: &Vec<usize>| {
                (1..l.len().saturating_sub(1))
                    .map(|i| [l[0], l[i], l[i + 1]].map(|c| c as u32))
                    .collect::<Vec<_>>()
            };
            let triangles = loops.iter().flat_map(fan).collect();
            let normals = |inner: bool| {
                cell.faces.iter().filter(|f| f.inner == inner).map(|f| f.normal).collect()
            };
            Shape {
                inner: normals(true),
                outer: normals(false),
                ..part(Form::Hull { points, triangles }, skin)
            }
        })
        .collect();
    Ok(body(shapes, thickness, reach))
}

/// How any two blocks resist each other, also those that meet only on the way.
pub(super) struct Frictions<'a> {
    assembly: &'a Assembly,
    /// The engine's unit of length, m.
    length: f64,
    known: HashMap<(usize, usize), Resistance>,
    given: HashMap<u32, f64>,
    /// Pairs of blocks whose contacts are laid down.
    apart: HashSet<(usize, usize)>,
    rules: Table,
}

/// What rules for materials say, by two small numbers in place of four names: the engine asks for
/// every pair in every step.
struct Table {
    /// By block: 0 where no rule names its material.
    kinds: Vec<usize>,
    /// Number of kinds.
    count: usize,
    /// By two kinds; empty where there are too many of them.
    laws: Vec<Option<JointLaw>>,
}

/// More kinds than this are looked up by name.
const KINDS: usize = 64;

impl Table {
    fn of(assembly: &Assembly) -> Self {
        let rules = &assembly.joints;
        let mut names: Vec<&String> = rules.by_material.iter().flat_map(|(pair, _)| pair).collect();
        names.sort_unstable();
        names.dedup();
        let kind = |b: &Block| {
            b.material.as_ref().and_then(|m| names.binary_search(&m).ok()).map_or(0, |k| k + 1)
        };
        let kinds: Vec<usize> = assembly.blocks.iter().map(kind).collect();
        let count = names.len() + 1;
        let law =
            |a: Option<&&String>, b: Option<&&String>| rules.of_materials(a.copied(), b.copied());
        let name = |kind: usize| kind.checked_sub(1).and_then(|k| names.get(k));
        let pairs = (0..count).flat_map(|a| (0..count).map(move |b| (a, b)));
        let laws = if count <= KINDS {
            pairs.map(|(a, b)| law(name(a), name(b))).collect()
        } else {
            Vec::new()
        };
        Self { kinds, count, laws }
    }

    fn law(&self, a: usize, b: usize, assembly: &Assembly) -> Option<JointLaw> {
        let rules = &assembly.joints;
        if self.laws.is_empty() || !rules.by_blocks.is_empty() {
            return rules.law(a, b, &assembly.blocks);
        }
        self.laws.get(self.kinds.get(a)? * self.count + self.kinds.get(b)?).copied().flatten()
    }
}

/// What the simulation knows of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Resistance {
    /// Friction coefficient.
    pub friction: f64,
    /// Rolling arm, in the engine's unit of length.
    pub arm: f64,
    /// Gap (> 0) or overlap (< 0) that was closed between round blocks that touch in one point, in
    /// the engine's unit of length: what counts as touching in the verdict does so here.
    pub closed: f64,
}

/// How the friction of a pair follows from its two bodies, one of which is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Combined {
    /// A free body: this against its like.
    Own(f64),
    /// A support: this against whatever is free, no more than that has itself.
    AtMost(f64),
    /// A support: this against whatever is free, more than that has itself.
    AtLeast(f64),
}

/// Stands for friction without limit. Larger: friction impulses of resting contacts overflow their
/// float error. Smaller: steep joints without sliding could slide.
const UNLIMITED: f64 = 1e4;

impl<'a> Frictions<'a> {
    pub fn new(model: &'a Model, units: &Units) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let mut new = Self {
            assembly,
            length: units.length,
            known: HashMap::new(),
            given: HashMap::new(),
            apart: laid_down(model),
            rules: Table::of(assembly),
        };
        for (index, face) in interfaces.list.iter().enumerate() {
            let pair = pair(face);
            let friction = coefficient(face.law.friction);
            if new.apart.contains(&pair) {
                new.given.insert(index as u32, friction);
            }
            let arm = rolling_arm(face) / units.length;
            let is_round = new.is_round(face.a) || new.is_round(face.b);
            let closed = if is_round { face.gap / units.length } else { 0.0 };
            match new.known.entry(pair) {
                Entry::Vacant(place) => {
                    place.insert(Resistance { friction, arm, closed });
                }
                Entry::Occupied(mut known) => {
                    let known = known.get_mut();
                    (known.arm, known.closed) = (known.arm.max(arm), 0.0);
                }
            }
        }
        new
    }

    /// Between two blocks; nothing where no rule says any. Of blocks that meet on the way only
    /// spheres and clumps resist rolling: for others it depends on how they meet.
    pub fn between(&self, a: usize, b: usize) -> Resistance {
        let pair = (a.min(b), a.max(b));
        let rule = || self.rules.law(pair.0, pair.1, self.assembly);
        let met = || {
            rule().map_or(Resistance::default(), |law| Resistance {
                friction: coefficient(law.friction),
                arm: if self.is_round(pair.0) || self.is_round(pair.1) {
                    law.rolling_arm / self.length
                } else {
                    0.0
                },
                closed: 0.0,
            })
        };
        self.known.get(&pair).copied().unwrap_or_else(met)
    }

    /// By body: what says the friction of every pair that may meet without a look at the pair.
    /// `None` unless all that is free are loose spheres of one kind, of which no contact is known,
    /// and nothing has seams.
    pub fn combined(&self, bodies: &[Body]) -> Option<Vec<Combined>> {
        let one_ball = |b: &Body| {
            matches!(b.shapes.as_slice(), [Shape { form: Form::Ball { .. }, role: Role::Part, .. }])
        };
        let free: Vec<usize> = (0..bodies.len()).filter(|&i| !bodies[i].support).collect();
        let &first = free.first()?;
        let alike = |&i: &usize| {
            one_ball(&bodies[i]) && self.rules.kinds.get(i) == self.rules.kinds.get(first)
        };
        let known = !(self.known.is_empty() && self.apart.is_empty());
        let seams = bodies.iter().flat_map(|b| &b.shapes).any(|s| !s.inner.is_empty());
        if known || seams || !self.assembly.joints.by_blocks.is_empty() || !free.iter().all(alike) {
            return None;
        }
        let own = self.between(first, first).friction;
        let one = |i: usize| match self.between(first, i).friction {
            _ if !bodies[i].support => Combined::Own(own),
            friction if friction <= own => Combined::AtMost(friction),
            friction => Combined::AtLeast(friction),
        };
        Some((0..bodies.len()).map(one).collect())
    }

    /// Whether any joint resists rolling.
    pub fn resist_rolling(&self) -> bool {
        let rules = &self.assembly.joints;
        let laws = || {
            rules
                .default
                .iter()
                .chain(rules.by_material.iter().map(|(_, law)| law))
                .chain(rules.by_blocks.values())
        };
        self.known.values().any(|r| r.arm > 0.0)
            || (laws().any(|law| law.rolling_arm > 0.0)
                && (0..self.assembly.blocks.len()).any(|i| self.is_round(i)))
    }

    fn is_round(&self, block: usize) -> bool {
        self.assembly.blocks.get(block).is_some_and(|b| b.solid.is_round())
    }

    /// Of an interface given by hand.
    pub fn given(&self, interface: u32) -> f64 {
        self.given.get(&interface).copied().unwrap_or(0.0)
    }

    /// Whether the contact between two blocks is given by hand, so that their shapes do not matter.
    pub fn is_given(&self, a: usize, b: usize) -> bool {
        self.apart.contains(&(a.min(b), a.max(b)))
    }
}

fn coefficient(friction: Friction) -> f64 {
    friction.mu().min(UNLIMITED)
}

#[cfg(test)]
mod tests;
