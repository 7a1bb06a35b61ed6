//! Contacts that were left out, and the answer with them closed.

use super::{Law, Outcome};
use crate::{interface::LeftOut, tolerance, verdict::Verdict};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Contacts that were left out, and what the answer is with them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LeftOutContacts {
    /// How many, and how far apart.
    pub contacts: LeftOut,
    /// The answer with those closed that can be closed; absent where it was not asked: the scene is
    /// large, no tolerance closes them, time was up, or the question is another than `assess`,
    /// `limit` and `tilt`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closed: Option<Closed>,
}

/// The answer with contacts closed that were left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Closed {
    /// How joints slide in it.
    pub law: Law,
    /// The answer.
    pub answer: ClosedAnswer,
    /// How it differs from that of the scene as it is.
    pub difference: Difference,
}

/// An answer in a word or a number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ClosedAnswer {
    /// Does it stand?
    Verdict(Verdict),
    /// The load factor; of a tilt its tangent, the least of all directions.
    LoadFactor {
        /// What became of it.
        status: Outcome,
        /// Its value, where found.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        value: Option<f64>,
    },
}

/// How an answer with contacts closed differs from that of the scene as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Difference {
    /// It does not.
    None,
    /// With them closed it stands, or carries more.
    Stronger,
    /// With them closed it does not stand, or carries less.
    Weaker,
    /// One of the two is undecided.
    Unknown,
}

impl ClosedAnswer {
    /// A verdict as far as the law was asked for.
    pub fn verdict(verdict: Verdict, law: Law) -> Self {
        Self::Verdict(match (verdict, law) {
            (Verdict::Conditional, Law::Associative) => Verdict::Stable,
            (other, _) => other,
        })
    }

    /// The higher, the safer; nothing where it is undecided.
    pub fn height(self) -> Option<f64> {
        match self {
            Self::Verdict(Verdict::Stable) => Some(2.0),
            Self::Verdict(Verdict::Conditional) => Some(1.0),
            Self::Verdict(Verdict::Unstable) => Some(0.0),
            Self::LoadFactor { status: Outcome::Found, value } => value,
            Self::LoadFactor { status: Outcome::Unbounded, .. } => Some(f64::INFINITY),
            Self::LoadFactor { status: Outcome::Impossible, .. } => Some(f64::NEG_INFINITY),
            Self::Verdict(Verdict::Undecided)
            | Self::LoadFactor { status: Outcome::Undecided, .. } => None,
        }
    }

    /// The lowest of those that are decided; an undecided one where none is.
    pub fn least(answers: impl Iterator<Item = Self>) -> Option<Self> {
        let key = |a: &Self| (a.height().is_none(), a.height().unwrap_or_default());
        let order = |a: (bool, f64), b: (bool, f64)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
        answers.min_by(|a, b| order(key(a), key(b)))
    }

    /// How this one differs from that of the scene as it is.
    pub fn beside(self, given: Self) -> Difference {
        let (Some(here), Some(there)) = (self.height(), given.height()) else {
            return Difference::Unknown;
        };
        let close = here == there
            || here.is_finite()
                && there.is_finite()
                && (here - there).abs() <= tolerance::CLOSED_CONTACTS * here.abs().max(there.abs());
        match close {
            true => Difference::None,
            false if here > there => Difference::Stronger,
            false => Difference::Weaker,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_side_of_a_difference_is_told_and_rounding_is_none() {
        use Verdict::{Conditional, Stable, Undecided, Unstable};
        let verdict = ClosedAnswer::Verdict;
        let factor = |v: f64| ClosedAnswer::LoadFactor { status: Outcome::Found, value: Some(v) };
        let word = |status| ClosedAnswer::LoadFactor { status, value: None };
        for (closed, given, wanted) in [
            (verdict(Stable), verdict(Stable), Difference::None),
            (verdict(Stable), verdict(Unstable), Difference::Stronger),
            (verdict(Conditional), verdict(Stable), Difference::Weaker),
            (verdict(Undecided), verdict(Stable), Difference::Unknown),
            (factor(0.3), factor(0.3 * (1.0 + 1e-6)), Difference::None),
            (factor(0.3), factor(0.2), Difference::Stronger),
            (factor(-0.3), factor(-0.2), Difference::Weaker),
            (factor(0.3), word(Outcome::Unbounded), Difference::Weaker),
            (word(Outcome::Unbounded), word(Outcome::Unbounded), Difference::None),
            (factor(0.3), word(Outcome::Impossible), Difference::Stronger),
            (word(Outcome::Undecided), factor(0.3), Difference::Unknown),
        ] {
            assert_eq!(closed.beside(given), wanted, "{closed:?} beside {given:?}");
        }
    }
}
