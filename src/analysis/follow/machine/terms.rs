//! What a machine and its two sides have in common.

use crate::{LoadFactor, Proved};
use base::error::{InputError, JsonPath};
use check::terms::Outcome;
use nalgebra::Vector3;

/// How far a machine is the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Exactness {
    /// The law of the rigid blocks without sliding and without bouncing.
    Exact,
    /// An idealisation, and why.
    Idealised(String),
}

/// A mass that goes with a block beside the block's own.
pub(super) struct Beside {
    pub block: usize,
    /// From the block's centre of mass at the start, m.
    pub arm: Vector3<f64>,
    /// kg.
    pub mass: f64,
}

/// Whether there is a load factor above zero.
pub(super) fn found(proof: &Proved<LoadFactor>, where_: &str) -> Result<(), InputError> {
    let text = match proof.outcome {
        Outcome::Found if proof.bracket.lower > 0.0 => return Ok(()),
        Outcome::Found | Outcome::Impossible => "the scene does not stand by itself",
        Outcome::Unbounded => {
            return Err(refuse(format!("{where_}: no acceleration moves anything")));
        }
        Outcome::Undecided => "its load factor was not found",
    };
    Err(refuse(format!("{text}: there is no mechanism to follow in time"))
        .hint("run `voussoir assess` and `voussoir limit` first"))
}

pub(super) fn refuse(text: String) -> InputError {
    InputError::at(JsonPath::root(), text)
}
