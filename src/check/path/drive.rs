//! What makes a structure move.

use crate::verdict::Rate;
use model::{assembly::Pose, interface::Model};
use nalgebra::{UnitQuaternion, Vector3};

/// A number that the poses must have: the way of a point.
#[derive(Clone, Copy, Debug)]
pub struct Demand {
    /// The block.
    pub block: usize,
    /// The point of it at the start, m.
    pub point: Vector3<f64>,
    /// The direction in which its way is measured.
    pub toward: Vector3<f64>,
    /// Its way, m.
    pub value: f64,
}

/// What makes a structure move.
#[derive(Clone, Debug)]
pub enum Drive {
    /// Supports move.
    Settle(Moves),
    /// A point of a block is pushed along; the load factor is what holds it.
    Push {
        /// The block.
        block: usize,
        /// The point of it at the start, m.
        point: Vector3<f64>,
        /// The unit direction in which its way is measured.
        toward: Vector3<f64>,
    },
}

/// Supports that move in proportion to the parameter, each about its centre of mass.
#[derive(Clone, Debug, Default)]
pub struct Moves(pub Vec<Move>);

/// How far a support moves while the parameter goes from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Its index.
    pub support: usize,
    /// The way, m.
    pub way: Vector3<f64>,
    /// The turn, rad about each axis.
    pub turn: Vector3<f64>,
}

impl Moves {
    fn of(&self, support: usize) -> Option<&Move> {
        self.0.iter().find(|m| m.support == support)
    }

    /// Rates of the supports per unit of the parameter; free blocks rest.
    pub fn rates(&self, model: &Model) -> Vec<Rate> {
        (0..model.assembly.blocks.len())
            .map(|i| self.of(i).map_or_else(Rate::zero, |m| Rate { velocity: m.way, spin: m.turn }))
            .collect()
    }
}

impl Drive {
    /// The pose of a support at a value of the parameter.
    pub fn pose(&self, support: usize, value: f64) -> Pose {
        let Self::Settle(moves) = self else { return Pose::start() };
        moves.of(support).map_or_else(Pose::start, |m| Pose {
            shift: m.way * value,
            turn: UnitQuaternion::from_scaled_axis(m.turn * value),
        })
    }

    /// Whether two supports move as one.
    pub fn together(&self, a: usize, b: usize) -> bool {
        let Self::Settle(moves) = self else { return true };
        match (moves.of(a), moves.of(b)) {
            (None, None) => true,
            (Some(a), Some(b)) => a.way == b.way && a.turn == b.turn && a.turn == Vector3::zeros(),
            _ => false,
        }
    }

    /// Where the control point must be.
    pub fn demand(&self, value: f64) -> Option<Demand> {
        match *self {
            Self::Settle(_) => None,
            Self::Push { block, point, toward } => Some(Demand { block, point, toward, value }),
        }
    }

    /// Whether the load factor is free.
    pub fn is_push(&self) -> bool {
        matches!(self, Self::Push { .. })
    }
}
