//! A load factor with dry friction as an answer.

use crate::{Deciding, LoadFactor};
#[cfg(doc)]
use check::verdict::law;
use check::{
    terms::{Found, is_reached},
    verdict::{Forces, Rate},
};

/// A load factor with dry friction.
#[derive(Clone, Debug)]
pub struct DryLoadFactor {
    /// How it was found.
    pub found: Found,
    /// The value, where there is one.
    pub value: Option<f64>,
    /// The greatest load factor at which the state under dry friction was seen at rest; it rested
    /// at all smaller ones that were asked, from the dead load on. Nothing where it was not asked,
    /// or did not come out.
    pub rests_at: Option<f64>,
    /// The least load factor at which it was seen to move, if ever.
    pub moves_at: Option<f64>,
    /// The part that decides, where there are several.
    pub part: Option<Deciding>,
    /// How far forces and mechanism are from Coulomb's law ([`law::natural_map`]).
    pub natural_map: f64,
    /// The same with rates as the program has them ([`law::natural_map_in_loads`]).
    pub natural_map_in_loads: f64,
    /// Convex programs solved for the value; those of the states that were asked whether they rest
    /// are not counted.
    pub solves: usize,
    /// Forces at the value, N.
    pub forces: Forces,
    /// The mechanism.
    pub rates: Vec<Rate>,
}

impl DryLoadFactor {
    /// No answer yet.
    pub(super) fn unanswered(associative: &LoadFactor) -> Self {
        Self {
            found: Found::Undecided,
            value: None,
            rests_at: None,
            moves_at: None,
            part: None,
            natural_map: f64::INFINITY,
            natural_map_in_loads: f64::INFINITY,
            solves: 0,
            forces: associative.forces.clone(),
            rates: associative.rates.clone(),
        }
    }

    /// Whether the state was seen at rest just below the value.
    pub fn is_reached(&self) -> bool {
        self.rests_at.zip(self.value).is_some_and(|(rests_at, value)| is_reached(rests_at, value))
    }

    /// The load factor to use, beside the `bound` where that was found; nothing where there is
    /// none, or no limit.
    pub fn to_use(&self, bound: Option<f64>) -> Option<f64> {
        match self.found {
            _ if !self.is_reached() => None,
            Found::NothingSlides => bound,
            Found::FixedPoint | Found::Rests | Found::RestsBelow => self.value,
            Found::Unlimited | Found::AtLeast | Found::NotAtRest | Found::Undecided => None,
        }
    }
}
