//! What a check computes again, because no theorem says it.

use super::{rocking::RockingAnswer, shaken::ShakenAnswer, simulation::Seen};
use crate::{
    elastic::PathEnd,
    question::{Question, StateOptions},
    rocking::RockOptions,
    sensitivity::Target,
    terms::{ClosedAnswer, Law, Order, Sided, StateMotion},
    verdict::Verdict,
};
use base::error::InputError;
use model::interface::Model;
use scene::Scene;

/// Whether what is required is met, and what is obtained of it, where these are known.
pub type Obtained = (Option<bool>, Option<f64>);

/// What only a solver or an engine can do again. Who has neither ([`Nothing`]) answers `None` to
/// everything here, and what was to be known stays unchecked.
pub trait Recompute {
    /// Whether all of it was computed this moment, by who asks: nothing is done again.
    fn just_computed(&self) -> bool {
        false
    }

    /// What the scene does under its dead load with dry friction.
    fn motion(&self, _model: &Model) -> Option<StateMotion> {
        None
    }

    /// Whether the live load alone comes to rest on the forces that it produces.
    fn rests_alone(&self, _model: &Model) -> Option<bool> {
        None
    }

    /// Verdict and least equilibrium error (g) of the scene with this value at `pointer`, or that there is
    /// no such scene.
    fn with_value(
        &self,
        _scene: &Scene,
        _pointer: &str,
        _value: f64,
        _law: Law,
    ) -> Option<Result<(Verdict, f64), InputError>> {
        None
    }

    /// Whether a question meets what is required of it in a scene, and what it obtains; or that there
    /// is no such scene.
    fn met(&self, _question: &Question, _scene: &Scene) -> Option<Result<Obtained, InputError>> {
        None
    }

    /// What the engine does, run again.
    fn simulated(
        &self,
        _said: &Seen,
        _scene: &Scene,
        _model: &Model,
    ) -> Option<Result<Seen, InputError>> {
        None
    }

    /// A question asked again with contacts closed that were left out: the law by
    /// which joints slide there, and the answer, where it is asked at all.
    fn closed(
        &self,
        _question: &Question,
        _law: Law,
        _scene: &Scene,
        _model: &Model,
    ) -> Option<Option<(Law, ClosedAnswer)>> {
        None
    }

    /// What a mechanism on ground that moves does, run again.
    fn rocking(
        &self,
        _options: &RockOptions,
        _scene: &Scene,
        _model: &Model,
    ) -> Option<Result<RockingAnswer, InputError>> {
        None
    }

    /// What all blocks do on ground that moves, run again for as many steps as it is said to have
    /// taken.
    fn shaken(
        &self,
        _said: &ShakenAnswer,
        _scene: &Scene,
        _model: &Model,
    ) -> Option<Result<ShakenAnswer, InputError>> {
        None
    }

    /// How the path of states along the live load ends, and at which load factor, followed again.
    fn stated(
        &self,
        _options: &StateOptions,
        _scene: &Scene,
        _model: &Model,
    ) -> Option<Result<(PathEnd, f64), InputError>> {
        None
    }

    /// How a value changes with these numbers of the scene, by their JSON pointers, asked again with
    /// each a little less and a little more.
    fn sided(
        &self,
        _question: &Question,
        _of: (&Scene, &Model),
        _target: &Target,
        _pointers: &[&str],
    ) -> Option<Vec<Sided>> {
        None
    }

    /// The number of held blocks below which a search finds no order like this one.
    fn least_held(
        &self,
        _order: &Order,
        _scene: &Scene,
        _model: &Model,
    ) -> Option<Result<usize, InputError>> {
        None
    }
}

/// Computes nothing again: the checker by itself.
#[derive(Clone, Copy, Debug)]
pub struct Nothing;

impl Recompute for Nothing {}

/// Computes nothing again, for it was computed this moment: who asks.
#[derive(Clone, Copy, Debug)]
pub struct JustComputed;

impl Recompute for JustComputed {
    fn just_computed(&self) -> bool {
        true
    }
}
