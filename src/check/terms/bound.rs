//! A value that is proved on both sides.

use super::{Bracket, Outcome};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A value that is proved on both sides: the bound on a load factor, an end of the range of a thrust
/// or of a member's force, N.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// What became of it.
    pub status: Outcome,
    /// The value, where found.
    pub value: Option<f64>,
    /// Lower end of its bracket.
    pub lower: Option<f64>,
    /// Upper end of its bracket.
    pub upper: Option<f64>,
}

impl Bound {
    /// The value, where it was found, with the ends that are known.
    pub fn new(status: Outcome, value: Option<f64>, bracket: Bracket) -> Self {
        let finite = |v: f64| v.is_finite().then_some(v);
        Self {
            status,
            value: value.filter(|_| status == Outcome::Found),
            lower: finite(bracket.lower),
            upper: finite(bracket.upper),
        }
    }

    /// Value and bracket, where found.
    pub fn found(&self) -> Option<(f64, f64, f64)> {
        match *self {
            Self { status: Outcome::Found, value: Some(v), lower: Some(l), upper: Some(u) } => {
                Some((v, l, u))
            }
            _ => None,
        }
    }
}
