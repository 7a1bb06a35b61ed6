//! How far forces and a mechanism are from Coulomb's law.

use super::answer::DryLoadFactor;
use crate::LoadFactor;
use base::tolerance;
use check::verdict::{Forces, Rate, claim, law};
use model::interface::Model;

/// The natural map, and the same in the loads that pass the blocks.
#[derive(Clone, Copy)]
pub struct Distance {
    natural_map: f64,
    in_loads: f64,
}

impl Distance {
    pub fn of(model: &Model, forces: &Forces, rates: &[Rate]) -> Self {
        Self {
            natural_map: law::natural_map(model, forces, rates).unwrap_or(f64::INFINITY),
            in_loads: claim::dry_map(model, forces, rates),
        }
    }

    pub fn is_obeyed(self) -> bool {
        self.natural_map <= tolerance::DRY_LAW && self.in_loads <= tolerance::NATURAL_MAP
    }

    pub fn told(self, answer: &mut DryLoadFactor) {
        (answer.natural_map, answer.natural_map_in_loads) = (self.natural_map, self.in_loads);
    }
}

/// Whether the associative mechanism slides nowhere, so that it and its forces obey the law.
pub fn slides_nowhere(model: &Model, associative: &LoadFactor) -> bool {
    Distance::of(model, &associative.forces, &associative.rates).is_obeyed()
}
