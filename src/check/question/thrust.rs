//! What is asked of a thrust, or of a force in a member.

use super::asked::{Asked, Idle, chosen};
use crate::terms::Law;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Options of `thrust`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ThrustOptions {
    /// Whether there must be forces only, or such as the loads produce.
    pub law: Law,
    /// The support; the first that touches a free block where nothing is said.
    pub support: Option<String>,
    /// Direction of the thrust, outwards where nothing is said; of a dowel's shear.
    pub direction: Option<[f64; 3]>,
    /// The force in this member in place of a thrust.
    pub member: Option<String>,
    /// The greatest thrust instead of the least.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub greatest: bool,
    /// Both ends, and the geometric safety factor. Rows of a sweep ask one end only: a plan has no
    /// such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub range: bool,
    /// Geometric safety factor below which the answer counts as failure; asked with `range`.
    pub require: Option<f64>,
}

impl Asked for ThrustOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        if self.member.is_some() && self.support.is_some() {
            return Err(InputError::at(
                path.key("member"),
                "a member and a support are both given",
            ));
        }
        if self.require.is_some() && !self.range {
            let text = "what is required of a thrust is its geometric safety factor";
            return Err(InputError::at(path.key("require"), text)
                .hint("remove it, or ask for the factor as well by \"range\": true"));
        }
        Ok(())
    }

    chosen!(law, require);

    fn quantity(&self) -> Option<&'static str> {
        Some(match (self.member.is_some(), self.greatest) {
            (true, true) => "greatest force in N",
            (true, false) => "least force in N",
            (false, true) => "greatest thrust in N",
            (false, false) => "least thrust in N",
        })
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        let hint = "remove it: a row has one number, the least thrust, or the greatest with \"greatest\": true; two plans give both";
        self.range.then_some(("range", hint))
    }

    fn for_one_number(self) -> Self {
        Self { range: false, require: None, ..self }
    }
}
