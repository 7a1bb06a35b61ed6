//! What is known with dry friction: of a load factor, and of a state.

use base::tolerance;
use model::assembly::Assembly;
use serde::{Deserialize, Serialize};

/// How a load factor with dry friction was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Found {
    /// The associative mechanism slides nowhere.
    NothingSlides,
    /// A fixed point on the friction limits.
    FixedPoint,
    /// The live load alone comes to rest on forces that it produces itself: no limit. Computed, not
    /// proved.
    Unlimited,
    /// The state under dry friction rests up to the value, and no longer somewhat above it.
    /// Computed, not proved.
    Rests,
    /// The state under dry friction rests up to the value; what it does from there to where it
    /// moves, or else to the bound, little more
    /// ([`REST_WITHIN`](base::tolerance::REST_WITHIN)), did not come out, or was not asked of many
    /// blocks. Computed, not proved.
    RestsBelow,
    /// The state under dry friction rests at a load factor that was asked for, because another
    /// answer is no higher: there is no value, only that it is not less. Computed, not proved.
    AtLeast,
    /// Already under the dead load the state does not rest: it needs self-stress, or falls, which a
    /// bound below zero proves. There is no value.
    NotAtRest,
    /// It did not settle: there is no value.
    Undecided,
}

/// What the state does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StateMotion {
    /// It rests: the acceleration vanishes with ε.
    Rests,
    /// It moves: the acceleration stays, and obeys the law.
    Moves,
    /// Neither could be told.
    Undecided,
}

/// One ε of the continuation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct StateStep {
    /// Regularisation ε.
    pub epsilon: f64,
    /// Largest acceleration left on a block, in multiples of gravity.
    pub acceleration: f64,
    /// Last change of the friction limits, each in the load that passes there.
    pub change: f64,
    /// How far the forces and that acceleration are from Coulomb's law ([natural map](crate::verdict::law::natural_map)).
    pub natural_map: f64,
    /// The same with accelerations in multiples of gravity ([released](crate::verdict::law::Released)).
    pub natural_map_in_loads: f64,
    /// Convex programs solved.
    pub solves: usize,
    /// Seconds.
    pub seconds: f64,
}

/// Whether a state seen at rest at `rests_at` is one just below `value`.
pub fn is_reached(rests_at: f64, value: f64) -> bool {
    rests_at >= value - 1.01 * tolerance::REST_BELOW * value.abs()
}

/// States of scenes of more free blocks than this take seconds, and fewer of them are asked.
pub const MANY: usize = 300;

/// How near above a load factor up to which the state rests it does so no longer, at most, in
/// shares of one at which it moves.
pub fn resolution(assembly: &Assembly) -> f64 {
    if assembly.free().count() > MANY { 1.0 / 64.0 } else { 4.0 * tolerance::DRY_CRITICAL_WIDTH }
}
