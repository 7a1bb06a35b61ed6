//! Independent parts: free blocks that are joined by contacts or members. Supports do not join, for they do
//! not move and take any force: what rests on one ground slab in two places does not feel each
//! other. Loads, forces and rates of one part say nothing about another, so each is a problem of
//! its own, in units and about an origin of its own ([`Units`]).

mod units;

pub use units::Units;

use super::{Interface, Interfaces};
use crate::{
    assembly::{AppliedForce, Assembly, Block, JointLaw, JointRules, Member, Solid, Wrench},
    interface::Model,
};
use base::plane::Sets;
use nalgebra::Vector3;

/// A part of a scene, made ready to be asked by itself.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its blocks in the scene, in order: the free ones and the supports that they touch. Block `i`
    /// of the part is `blocks[i]` there.
    pub blocks: Vec<usize>,
    /// Its contacts in the scene, in order.
    pub contacts: Vec<usize>,
    /// Its members in the scene, in order.
    pub members: Vec<usize>,
    /// The places of its forces among those of the scene: its contacts, then its members.
    places: Vec<usize>,
    /// What its numbers count.
    pub units: Units,
    /// The blocks, loads and contacts, in these units. Shapes stay behind (a solid has its volume
    /// and nothing else), and so do findings and whatever contacts are detected by.
    pub model: Model,
}

/// The independent parts of a scene, in the order of their first free blocks. Each free block is in
/// one of them; a support is in as many as it touches, and in none where it touches nothing.
pub fn parts(model: &Model) -> Vec<Part> {
    let Model { assembly, interfaces, .. } = model;
    let members = members(model);
    let mut place = vec![usize::MAX; assembly.blocks.len()];
    let whole = members.len() == 1;
    members
        .into_iter()
        .map(|members| {
            let mut part = Part::new(model, members, &mut place);
            if whole {
                part.model.interfaces.support_pairs = interfaces.support_pairs;
            }
            part
        })
        .collect()
}

/// What belongs to each part, in the order of [`parts`], as it stands in the scene.
pub fn members(model: &Model) -> Vec<Members> {
    let Model { assembly, interfaces, .. } = model;
    let n = assembly.blocks.len();
    let free = |i: usize| !assembly.blocks[i].support;
    let mut sets = Sets::new(n);
    for face in interfaces.list.iter().filter(|f| free(f.a) && free(f.b)) {
        sets.join(face.a, face.b);
    }
    // What a member joins is one part; the ground does not join.
    let ends = |m: &Member| -> Vec<usize> {
        m.action.ends().into_iter().flatten().filter(|&i| free(i)).collect()
    };
    for member in &interfaces.members {
        ends(member).windows(2).for_each(|pair| {
            sets.join(pair[0], pair[1]);
        });
    }
    let mut number = vec![usize::MAX; n];
    let mut members: Vec<Members> = Vec::new();
    for i in assembly.free() {
        let first = sets.find(i);
        if first == i {
            number[i] = members.len();
            members.push(Default::default());
        }
        number[i] = number[first];
        members[number[i]].free.push(i);
    }
    for (k, face) in interfaces.list.iter().enumerate() {
        if let Some(i) = [face.a, face.b].into_iter().find(|&i| free(i)) {
            members[number[i]].contacts.push(k);
        }
    }
    for (k, member) in interfaces.members.iter().enumerate() {
        if let Some(&i) = ends(member).first() {
            members[number[i]].members.push(k);
        }
    }
    for applied in assembly.dead_forces.iter().filter(|a| free(a.block)) {
        members[number[applied.block]].dead_forces.push(*applied);
    }
    for applied in assembly.live_forces.iter().filter(|a| free(a.block)) {
        members[number[applied.block]].live_forces.push(*applied);
    }
    members
}

/// What belongs to a part, by the numbers of the scene.
#[derive(Default)]
pub struct Members {
    /// Free blocks, in order.
    pub free: Vec<usize>,
    /// Contacts, in order.
    pub contacts: Vec<usize>,
    /// Ties, struts and other members, in order.
    pub members: Vec<usize>,
    dead_forces: Vec<AppliedForce>,
    live_forces: Vec<AppliedForce>,
}

impl Part {
    /// `place` is room for the number that each block has in the part.
    fn new(model: &Model, members: Members, place: &mut [usize]) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let Members { free, contacts, members, dead_forces, live_forces } = members;
        let faces = || contacts.iter().map(|&k| &interfaces.list[k]);
        let units = Units::of(assembly, &free, faces().flat_map(|f| f.points.iter().copied()));
        let own = || members.iter().map(|&k| &interfaces.members[k]);
        let mut blocks: Vec<usize> = free
            .iter()
            .copied()
            .chain(faces().flat_map(|f| [f.a, f.b]))
            .chain(own().flat_map(|m| m.action.ends()).flatten())
            .collect();
        blocks.sort_unstable();
        blocks.dedup();
        blocks.iter().enumerate().for_each(|(own, &i)| place[i] = own);
        let list = faces().map(|f| contact(f, &units, place)).collect();
        let joined = own().map(|m| member(m, &units, place)).collect();
        let places = contacts.iter().copied();
        let places = places.chain(members.iter().map(|k| interfaces.list.len() + k)).collect();
        let applied = |list: &[AppliedForce], unit: f64| {
            list.iter()
                .map(|a| AppliedForce {
                    block: place[a.block],
                    force: a.force / unit,
                    arm: a.arm / units.length,
                })
                .collect()
        };
        let assembly = Assembly {
            name: assembly.name.clone(),
            gravity: assembly.gravity / units.acceleration,
            blocks: blocks.iter().map(|&i| block(&assembly.blocks[i], &units)).collect(),
            joints: JointRules {
                default: None,
                by_material: Vec::new(),
                by_blocks: Default::default(),
            },
            dead: blocks.iter().map(|&i| units.inward(&assembly.dead[i])).collect(),
            live: blocks.iter().map(|&i| units.live(&assembly.live[i])).collect(),
            dead_forces: applied(&dead_forces, units.force),
            live_forces: applied(&live_forces, units.live),
            given: Vec::new(),
            members: Vec::new(),
            contact: assembly.contact.clone(),
            said: Vec::new(),
            findings: Vec::new(),
        };
        let interfaces = Interfaces { list, members: joined, ..Interfaces::default() };
        Self { blocks, contacts, members, places, units, model: Model::new(assembly, interfaces) }
    }

    /// The name of the part: that of its first free block.
    pub fn name(&self) -> &str {
        self.model.assembly.free().next().map_or("", |i| &self.model.assembly.blocks[i].id)
    }

    /// How many free blocks it has.
    pub fn free_count(&self) -> usize {
        self.model.assembly.free().count()
    }

    /// Whether a live load acts on it.
    pub fn is_driven(&self) -> bool {
        self.model.assembly.live.iter().any(|w| *w != Wrench::zero())
    }

    /// The number that a block of the scene has in the part.
    pub fn find(&self, block: usize) -> Option<usize> {
        self.blocks.binary_search(&block).ok()
    }

    /// The number that a member of the scene has in the part.
    pub fn find_member(&self, member: usize) -> Option<usize> {
        self.members.binary_search(&member).ok()
    }

    /// Its forces, per contact and point and per member, from those of the scene (N, N·m).
    pub fn take_forces(&self, scene: &[Vec<Wrench>]) -> Vec<Vec<Wrench>> {
        self.places
            .iter()
            .map(|&k| scene[k].iter().map(|w| self.units.inward(w)).collect())
            .collect()
    }

    /// Puts its forces among those of the scene (N, N·m).
    pub fn put_forces(&self, own: &[Vec<Wrench>], scene: &mut [Vec<Wrench>]) {
        for (&k, forces) in self.places.iter().zip(own) {
            scene[k] = forces.iter().map(|w| self.units.outward(w)).collect();
        }
    }
}

fn block(block: &Block, units: &Units) -> Block {
    let Units { length, .. } = *units;
    let density = units.acceleration / units.force;
    Block {
        id: block.id.clone(),
        path: Default::default(),
        support: block.support,
        material: None,
        elastic: None,
        mass: block.mass * density,
        factor: block.factor,
        centroid: units.place(&block.centroid),
        inertia: block.inertia * density / length / length,
        gyration: block.gyration.in_units(length),
        solid: Solid::Clump {
            balls: Vec::new(),
            volume: block.solid.volume() / length / length / length,
        },
        size: block.size / length,
    }
}

fn member(member: &Member, units: &Units, place: &[usize]) -> Member {
    let stiffness = member.stiffness.map(|k| k * units.length);
    Member { stiffness, ..member.renumbered(place) }
        .placed(|p| units.place(p))
        .times(1.0 / units.force)
}

fn contact(face: &Interface, units: &Units, place: &[usize]) -> Interface {
    let points = |list: &[Vector3<f64>]| list.iter().map(|p| units.place(p)).collect::<Vec<_>>();
    let law = face.law.with_stresses(units.stress());
    Interface {
        a: place[face.a],
        b: place[face.b],
        kind: face.kind,
        frame: face.frame,
        points: points(&face.points),
        area: face.area / units.length / units.length,
        patches: face.patches,
        pieces: face.pieces.iter().map(|piece| points(piece)).collect(),
        ways: face.ways.clone(),
        gap: face.gap / units.length,
        law: JointLaw { rolling_arm: face.law.rolling_arm / units.length, ..law },
    }
}
