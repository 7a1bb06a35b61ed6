//! Verdicts and the evidence for them, recomputed from [`Assembly`] and
//! [`Interfaces`] alone. Nothing here knows the program or the solver. What joints carry beside
//! friction is derived here a second time ([`joint`]), all but the bound on crushing.

pub mod certificate;
pub mod claim;
pub mod evidence;
pub mod exact;
pub mod fabric;
mod findings;
pub mod joint;
pub mod law;
pub mod mechanism;
pub mod member;
pub mod section;
pub mod thrust;
pub mod tilted;

use model::{
    assembly::{Assembly, Wrench},
    interface::{Interfaces, Model},
};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Does it stand?
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Admissible contact forces balance the loads. Proof: the forces.
    Stable,
    /// Admissible forces exist, but only with self-stress that the loads do not produce: with dry
    /// friction and none applied, the scene moves. Proof: the forces, and a motion that obeys
    /// Coulomb's law.
    Conditional,
    /// No admissible contact forces balance the loads, whatever the law of sliding inside the cone.
    /// Proof: the mechanism.
    Unstable,
    /// The bracket straddles the tolerance.
    Undecided,
}

impl Verdict {
    /// As written in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Conditional => "conditional",
            Self::Unstable => "unstable",
            Self::Undecided => "undecided",
        }
    }
}

/// What acts on block `b` at each contact point of each interface: force, N, and couple about that
/// point, N·m (zero unless the joint has a rolling arm). After the interfaces one entry for each
/// member, of one wrench whose force holds its amounts, N ([`member`]).
pub type Forces = Vec<Vec<Wrench>>;

/// No forces at all.
pub fn no_forces(interfaces: &Interfaces) -> Forces {
    let contacts = interfaces.list.iter().map(|face| vec![Wrench::zero(); face.points.len()]);
    contacts.chain(interfaces.members.iter().map(|_| vec![Wrench::zero()])).collect()
}

/// The model with every way in which its flats may act, and these forces, none of them in a way:
/// forces are admissible across a flat, and a mechanism is one that closes no way. Nothing where
/// every contact has one normal.
pub fn in_every_way(model: &Model, forces: &Forces) -> Option<(Model, Forces)> {
    let wide = model.every_way()?;
    if forces.is_empty() {
        return Some((wide, Forces::new()));
    }
    let (contacts, members) = forces.split_at(model.interfaces.list.len().min(forces.len()));
    let ways = &wide.interfaces.list[model.interfaces.list.len()..];
    let none = ways.iter().map(|f| vec![Wrench::zero(); f.points.len()]);
    let forces = contacts.iter().cloned().chain(none).chain(members.iter().cloned()).collect();
    Some((wide, forces))
}

/// What a claim is proved by.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a> {
    /// Contact forces: the static side.
    pub forces: &'a Forces,
    /// Unbounded: forces at a load factor at which the scene stands, beside those of the live load
    /// alone. Conditional: the forces without the self-stress.
    pub base: Option<&'a Forces>,
    /// Rates of all blocks: the kinematic side.
    pub rates: &'a [Rate],
}

impl<'a> Evidence<'a> {
    /// Forces and rates.
    pub fn new(forces: &'a Forces, rates: &'a [Rate]) -> Self {
        Self { forces, base: None, rates }
    }
}

/// The rate of motion of a block; the scale is arbitrary, common to all blocks of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Velocity of the centre of mass.
    pub velocity: Vector3<f64>,
    /// Spin.
    pub spin: Vector3<f64>,
}

impl Rate {
    /// At rest.
    pub fn zero() -> Self {
        Self { velocity: Vector3::zeros(), spin: Vector3::zeros() }
    }
}

/// Velocity of a point moving with a block.
pub fn at(assembly: &Assembly, rates: &[Rate], block: usize, point: &Vector3<f64>) -> Vector3<f64> {
    let q = &rates[block];
    q.velocity + q.spin.cross(&(point - assembly.blocks[block].centroid))
}
