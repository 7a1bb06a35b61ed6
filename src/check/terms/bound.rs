//! A value that is proved on both sides.

use super::{Bracket, Outcome};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A value that is proved on both sides: the bound on a load factor, an end of the range of a thrust
/// or of a member's force, N.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// What became of it.
    pub status: Outcome,
    /// The value, where found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Lower end of its bracket.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lower: Option<f64>,
    /// Upper end of its bracket.
    #[serde(default, skip_serializing_if = "Option::is_none")]
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
