//! Proofs without rounding.
//!
//! A double is a rational number, and sums and products of a few doubles can be enclosed by
//! intervals narrower than anything that matters ([`interval`]). What is claimed about a scene
//! becomes a theorem about its resolved numbers: forces that balance exist ([`existence`]); a
//! motion closes no joint and gains power ([`motion`]). Where the cones leave no room for that
//! (sliding excluded at any force, no friction at all), the claim holds to rounding, with the
//! number that it rests on ([`Grade`]).

pub mod balance;
pub mod existence;
pub mod interval;
pub mod motion;

use serde::{Deserialize, Serialize};

/// How exactly a claim is proved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Grade {
    /// A theorem about the resolved numbers of the scene: no rounding is excused.
    #[default]
    Exact,
    /// The claim rests on this number, the greater the weaker: of forces, the largest equilibrium error of
    /// a block in multiples of its load; of a motion, the share that closing joints can take of its
    /// power for a contact force of the size of the whole load; of Coulomb's law, the natural map.
    ToRounding(f64),
}

impl Grade {
    /// The weaker of two grades.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::ToRounding(a), Self::ToRounding(b)) => {
                Self::ToRounding(if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
            }
            (Self::Exact, weaker) => weaker,
            (weaker, Self::Exact) => weaker,
        }
    }
}

impl std::fmt::Display for Grade {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exact => f.write_str("exact"),
            Self::ToRounding(number) => write!(f, "to rounding, {number:.1e}"),
        }
    }
}
