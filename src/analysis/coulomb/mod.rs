//! Dry friction exactly: what the fixed points of [`crate::program::coulomb`] say about state and
//! load factor.

use super::{Control, LoadFactor, Proved};
use crate::{
    interface::Model,
    terms::{Law, Outcome},
    verdict::Verdict,
};

mod answer;
mod crushing;
mod load_factor;
mod rest;
mod state;

pub use super::parts::{
    assess::motion,
    dry::{load_factor, load_factor_from, rests_alone},
};
pub use crate::terms::{Found, StateMotion, StateStep, is_reached, resolution};
pub use answer::DryLoadFactor;
pub(super) use load_factor::{complementary, of_part, part_rests_alone};
pub(super) use rest::up_to_rest;
pub use state::{State, refined, state};

/// The load factor with dry friction beside its bound, where that is asked for and leaves something
/// to ask; `level` is the verdict without the live load, where it is known.
pub(super) fn beside(
    model: &Model,
    bound: &Proved<LoadFactor>,
    level: Option<Verdict>,
    control: &Control,
) -> Option<Proved<DryLoadFactor>> {
    let leaves_something = matches!(bound.outcome, Outcome::Found | Outcome::Unbounded);
    (control.law == Law::Coulomb && leaves_something)
        .then(|| load_factor_from(model, bound, level, control))
}
