//! Program D: the load factor with dry friction.
//!
//! Where the associative mechanism slides nowhere, it and its forces obey Coulomb's law as they stand, and the associative
//! load factor is the answer. Otherwise the fixed point on the friction limits is followed as δ falls. What is found are
//! forces that balance at λ and a mechanism that obeys Coulomb's law with them: *a* complementary solution. Load factors
//! without dilatancy are not unique (Ferris & Tin-Loi 2001; Gilbert, Casapulla & Ahmed 2006); the associative value bounds
//! them all from above. A run that does not settle is undecided and gives no number.

use super::{
    fixed_point::{FixedPoint, Stop, iterate, within_strength},
    state::{Motion, state},
};
use crate::{
    analysis::{Control, LoadFactor, Outcome},
    assembly::Assembly,
    interface::Interfaces,
    program::{
        coulomb::{Aim, Contacts, Hold},
        is_forest,
    },
    solve::Settings,
    tolerance,
    verdict::{Forces, Rate, certificate, check, law},
};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// How a load factor with dry friction was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Found {
    /// The associative mechanism slides nowhere.
    NothingSlides,
    /// A fixed point on the friction limits.
    FixedPoint,
    /// The live load alone comes to rest on forces that it produces itself: no limit. Computed, not proved.
    Unlimited,
    /// It did not settle: there is no value.
    Undecided,
}

/// A load factor with dry friction.
#[derive(Clone, Debug)]
pub struct DryLoadFactor {
    /// How it was found.
    pub found: Found,
    /// The value; NaN where undecided.
    pub value: f64,
    /// How far forces and mechanism are from Coulomb's law ([`law::natural_map`]).
    pub natural_map: f64,
    /// Convex programs solved.
    pub solves: usize,
    /// Forces at the value, N.
    pub forces: Forces,
    /// The mechanism.
    pub rates: Vec<Rate>,
}

/// δ, and the change of the friction limits (mean block loads) at which the next one is taken up.
const STAGES: [(f64, Stop); 3] =
    [(1e-4, Stop { change: 3e-2, solves: 20 }), (1e-5, Stop { change: 3e-3, solves: 20 }), (1e-7, Stop { change: 3e-5, solves: 20 })];

/// The load factor with dry friction; `associative` is the answer of [`limit`](crate::analysis::limit()) for the same model.
pub fn load_factor(assembly: &Assembly, interfaces: &Interfaces, associative: &LoadFactor, control: &Control) -> DryLoadFactor {
    let map = |forces: &Forces, rates: &[Rate]| law::natural_map(assembly, interfaces, forces, rates).unwrap_or(f64::INFINITY);
    let mut answer = DryLoadFactor {
        found: Found::Undecided,
        value: f64::NAN,
        natural_map: f64::INFINITY,
        solves: 0,
        forces: associative.forces.clone(),
        rates: associative.rates.clone(),
    };
    if associative.outcome == Outcome::Impossible {
        return answer;
    }
    if associative.outcome == Outcome::Found {
        answer.natural_map = map(&associative.forces, &associative.rates);
        if answer.natural_map <= tolerance::DRY_LAW {
            (answer.found, answer.value) = (Found::NothingSlides, associative.value);
            return answer;
        }
    }
    if associative.outcome == Outcome::Unbounded && rests_alone(assembly, interfaces, control) {
        answer.found = Found::Unlimited;
        return answer;
    }
    let start = Instant::now();
    let mut contacts = Contacts::new(assembly, interfaces, control.keep_all, true);
    let settings = Settings { tolerance: 1e-11, regularization: 1e-9, ..Settings::default() };
    let scale = check::natural_factor(assembly);
    let still = vec![0.0; contacts.discs().count()];
    let first = Stop { change: 0.0, solves: 1 };
    let mut last = iterate(&contacts, Aim::LoadFactor(STAGES[0].0, scale), Hold::SlidingRates, still, first, &settings);
    for (delta, stop) in STAGES {
        let left = control.seconds - start.elapsed().as_secs_f64();
        let Some(from) = last.take().filter(|_| left > 0.0) else { return answer };
        let settings = Settings { seconds: left, ..settings };
        answer.solves += from.solves;
        last = within_strength(&mut contacts, interfaces, |c| {
            iterate(c, Aim::LoadFactor(delta, scale), Hold::Limits, c.limits(&from.forces), stop, &settings)
        });
    }
    let Some(FixedPoint { forces, rates, lambda, solves, .. }) = last else { return answer };
    answer.solves += solves;
    answer.forces = contacts.statics.forces(interfaces, &forces);
    answer.rates =
        contacts.statics.rates(assembly.blocks.len(), &rates).into_iter().map(|(velocity, spin)| Rate { velocity, spin }).collect();
    answer.natural_map = map(&answer.forces, &answer.rates);
    let s = certificate::statics(assembly, interfaces, &answer.forces, lambda);
    if answer.natural_map <= tolerance::DRY_LAW && s.is_within_strength() && s.unbalance <= tolerance::DRY_BALANCE.max(s.resolution) {
        (answer.found, answer.value) = (Found::FixedPoint, lambda);
    }
    answer
}

/// Whether the live load alone, on joints without any strength, produces the forces that balance it.
fn rests_alone(assembly: &Assembly, interfaces: &Interfaces, control: &Control) -> bool {
    let (alone, _) = check::live_alone(assembly);
    let (unlimited, _) = interfaces.unlimited();
    is_forest(&alone, &unlimited) || state(&alone, &unlimited, control).motion == Motion::Rests
}
