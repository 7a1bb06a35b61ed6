//! Dry friction exactly: what the fixed points of [`solve::program::coulomb`] say about state and
//! load factor.

use super::{Control, LoadFactor, Proved};
use check::{
    terms::{Law, Outcome},
    verdict::{Rate, Verdict, no_forces},
};
use model::interface::Model;

mod answer;
mod crushing;
mod distance;
mod load_factor;
mod rest;
mod state;

pub use super::parts::{
    assess::motion,
    dry::{load_factor, load_factor_from, rests_alone},
};
pub use answer::DryLoadFactor;
pub use check::terms::{Found, StateMotion, StateStep, is_reached, resolution};
pub(super) use load_factor::{complementary, of_part, part_rests_alone};
pub(super) use rest::up_to_rest;
pub use state::{DryState, refined, state};

/// The load factor with dry friction beside its bound, where that is asked for and leaves something
/// to ask; `level` is the verdict without the live load, where it is known.
pub(super) fn beside(
    model: &Model,
    bound: &Proved<LoadFactor>,
    level: Option<Verdict>,
    control: &Control,
) -> Option<Proved<DryLoadFactor>> {
    is_asked(bound, level, control).then(|| load_factor_from(model, bound, level, control))
}

/// Whether a load factor with dry friction is asked for, and its bound leaves something to ask.
pub(super) fn is_asked(bound: &LoadFactor, level: Option<Verdict>, control: &Control) -> bool {
    let leaves_something = match bound.outcome {
        Outcome::Found | Outcome::Unbounded => true,
        // What falls by itself has none, whatever the bound.
        Outcome::Undecided => level == Some(Verdict::Unstable),
        Outcome::Impossible => false,
    };
    control.law == Law::Coulomb && leaves_something
}

/// That the load factor is not less than `floor`, where the state rests there and that leaves
/// something to ask: one state in place of a value. Whether it rests on the way there is not asked.
pub(super) fn at_least(
    model: &Model,
    bound: &Proved<LoadFactor>,
    floor: f64,
    control: &Control,
) -> Option<Proved<DryLoadFactor>> {
    let bears = match bound.outcome {
        Outcome::Found => bound.bracket.lower >= floor,
        Outcome::Unbounded => true,
        Outcome::Impossible | Outcome::Undecided => false,
    };
    let rests = || motion(&model.at_load_factor(floor), control) == StateMotion::Rests;
    (bears && rests()).then(|| {
        let answer = DryLoadFactor {
            found: Found::AtLeast,
            value: None,
            rests_at: Some(floor),
            moves_at: None,
            part: None,
            natural_map: f64::INFINITY,
            natural_map_in_loads: f64::INFINITY,
            solves: 0,
            forces: no_forces(&model.interfaces),
            rates: vec![Rate::zero(); model.assembly.blocks.len()],
        };
        Proved::new(model, answer)
    })
}
