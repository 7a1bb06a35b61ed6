//! Contacts that were left out, and the answer with them closed.

use super::{Law, Outcome};
use crate::verdict::Verdict;
use base::tolerance;
use model::interface::LeftOut;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Contacts that were left out, and what the answer is with them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LeftOutContacts {
    /// How many, and how far apart.
    pub contacts: LeftOut,
    /// The answer with those closed that can be closed; absent where it was not asked: the scene is
    /// large, no tolerance closes them, time was up, or the question is none that is put again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closed: Option<Closed>,
}

/// The answer with contacts closed that were left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Closed {
    /// How joints slide in it.
    pub law: Law,
    /// The answer.
    pub answer: ClosedAnswer,
    /// How it differs from that of the scene as it is.
    pub difference: Difference,
}

/// An answer in a word or a number, or few.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
    /// The range of a thrust on a support or of a force in a member.
    Thrust {
        /// Its least value.
        least: ClosedEnd,
        /// Its greatest.
        greatest: ClosedEnd,
    },
    /// The flips of a verdict over a range.
    Flips {
        /// Where they are, as the scan goes.
        values: Vec<f64>,
        /// The verdict where the scan starts.
        start: Verdict,
    },
}

/// An end of a range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClosedEnd {
    /// What became of it.
    pub status: Outcome,
    /// Its value, N, where found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
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
    /// With them closed the numbers are others, and neither are the safe ones.
    Another,
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
    pub fn height(&self) -> Option<f64> {
        match *self {
            Self::Verdict(Verdict::Stable) => Some(2.0),
            Self::Verdict(Verdict::Conditional) => Some(1.0),
            Self::Verdict(Verdict::Unstable) => Some(0.0),
            Self::LoadFactor { status: Outcome::Found, value } => value,
            Self::LoadFactor { status: Outcome::Unbounded, .. } => Some(f64::INFINITY),
            Self::LoadFactor { status: Outcome::Impossible, .. } => Some(f64::NEG_INFINITY),
            Self::Thrust { .. } => Self::Verdict(Verdict::Stable).height(),
            Self::Flips { start, .. } => Self::Verdict(start).height(),
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
    pub fn beside(&self, given: &Self) -> Difference {
        let (Some(here), Some(there)) = (self.height(), given.height()) else {
            return Difference::Unknown;
        };
        match close(here, there) {
            true => self.numbers_beside(given),
            false if here > there => Difference::Stronger,
            false => Difference::Weaker,
        }
    }

    /// How the numbers of two that are as high as each other differ; of two that are of different
    /// kinds that is not known.
    fn numbers_beside(&self, given: &Self) -> Difference {
        let same = match (self, given) {
            (Self::Thrust { least: a, greatest: b }, Self::Thrust { least: c, greatest: d }) => {
                match a.is(*c).zip(b.is(*d)) {
                    Some((least, greatest)) => least && greatest,
                    None => return Difference::Unknown,
                }
            }
            (Self::Flips { values: a, .. }, Self::Flips { values: b, .. }) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| close(*a, *b))
            }
            (Self::Verdict(_), Self::Verdict(_))
            | (Self::LoadFactor { .. }, Self::LoadFactor { .. }) => true,
            _ => return Difference::Unknown,
        };
        if same { Difference::None } else { Difference::Another }
    }
}

impl ClosedEnd {
    /// Whether it is this one; nothing where either is undecided.
    fn is(self, other: Self) -> Option<bool> {
        let decided = self.status != Outcome::Undecided && other.status != Outcome::Undecided;
        let near = self.value.zip(other.value).is_none_or(|(a, b)| close(a, b));
        decided.then_some(self.status == other.status && near)
    }
}

/// Whether two numbers are one, as far as it matters here.
fn close(a: f64, b: f64) -> bool {
    let near = || (a - b).abs() <= tolerance::CLOSED_CONTACTS * a.abs().max(b.abs());
    a == b || a.is_finite() && b.is_finite() && near()
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
        let end = |value| ClosedEnd { status: Outcome::Found, value: Some(value) };
        let thrust = |a, b| ClosedAnswer::Thrust { least: end(a), greatest: end(b) };
        let open = ClosedEnd { status: Outcome::Undecided, value: None };
        let flips = |values: &[f64], start| ClosedAnswer::Flips { values: values.to_vec(), start };
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
            (thrust(2.0, 3.0), thrust(2.0, 3.0 * (1.0 - 1e-6)), Difference::None),
            (thrust(2.0, 3.0), thrust(2.0, 3.1), Difference::Another),
            (thrust(2.0, 3.0), verdict(Unstable), Difference::Stronger),
            (verdict(Unstable), thrust(2.0, 3.0), Difference::Weaker),
            (
                ClosedAnswer::Thrust { least: end(2.0), greatest: open },
                thrust(2.0, 3.0),
                Difference::Unknown,
            ),
            // One end alone is no range, and no reason to call two answers one.
            (verdict(Stable), thrust(2.0, 3.0), Difference::Unknown),
            (flips(&[0.4], Stable), flips(&[0.4], Stable), Difference::None),
            (flips(&[0.4], Stable), flips(&[0.5], Stable), Difference::Another),
            (flips(&[0.4, 0.6], Stable), flips(&[0.4, 0.7], Stable), Difference::Another),
            (flips(&[], Stable), flips(&[0.5], Stable), Difference::Another),
            (flips(&[], Unstable), flips(&[0.5], Stable), Difference::Weaker),
            (flips(&[], Undecided), flips(&[0.5], Stable), Difference::Unknown),
        ] {
            assert_eq!(closed.beside(&given), wanted, "{closed:?} beside {given:?}");
        }
    }
}
