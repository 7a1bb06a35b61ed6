//! What is asked of supports that move.

use super::asked::Asked;
use crate::{path::saved::SavedPose, terms::Law};
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of `settle`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SettleOptions {
    /// Supports that move, all of them in proportion to one parameter, which goes from 0 to 1.
    pub moves: Vec<SupportMove>,
    /// Values of the parameter that become points of the curve, beside others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<f64>,
    /// Poses to begin at, as a result of the same scene has them: how much further it goes from
    /// there. The value of the parameter there is where they put the supports; empty: the start.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub from: Vec<SavedPose>,
}

/// How far supports move while the parameter goes from 0 to 1.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SupportMove {
    /// The support, or several that move alike: `*` stands for any letters of a name.
    pub support: String,
    /// The way, m.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub way: [f64; 3],
    /// Beside it the way outwards of each of several supports, m (inwards where < 0): horizontal,
    /// away from the mean of their centres of mass.
    #[serde(default, skip_serializing_if = "is_nothing")]
    pub out: f64,
    /// The turn of each about its own centre of mass: axis × angle in degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub turn_deg: [f64; 3],
}

impl SupportMove {
    /// Supports that move this way, m; `*` stands for any letters of a name.
    pub fn along(support: impl Into<String>, way: [f64; 3]) -> Self {
        Self { support: support.into(), way, ..Self::default() }
    }

    /// Supports that move outwards by this, m, each away from the middle of all that the name fits.
    pub fn outwards(support: impl Into<String>, out: f64) -> Self {
        Self { support: support.into(), out, ..Self::default() }
    }

    /// Whether nothing moves.
    fn is_at_rest(&self) -> bool {
        self.way == [0.0; 3] && self.out == 0.0 && self.turn_deg == [0.0; 3]
    }
}

impl Asked for SettleOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        let refuse = |key: &str, text: String| Err(InputError::at(path.key(key), text));
        for (k, m) in self.moves.iter().enumerate() {
            if self.moves[..k].iter().any(|other| other.support == m.support) {
                return refuse("moves", format!("{}: two movements are given", m.support));
            }
            if !m.way.iter().chain(&m.turn_deg).chain([&m.out]).all(|v| v.is_finite()) {
                return refuse("moves", format!("{}: a number is not finite", m.support));
            }
        }
        if self.moves.iter().all(SupportMove::is_at_rest) {
            return refuse("moves", "no support moves".into());
        }
        if self.at.iter().any(|v| !(0.0..=1.0).contains(v)) {
            return refuse("at", "must be shares of the movement, from 0 to 1".into());
        }
        Ok(())
    }

    /// Hinges alone are followed, which are the same for both.
    fn law(&self) -> Law {
        Law::Associative
    }

    fn quantity(&self) -> Option<&'static str> {
        Some("share of the movement up to which it stands")
    }
}

fn is_nothing(value: &f64) -> bool {
    *value == 0.0
}

fn is_zero(v: &[f64; 3]) -> bool {
    *v == [0.0; 3]
}
