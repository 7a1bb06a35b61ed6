//! What is asked of a mechanism in time.

use crate::ground::Given;
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Options of `rock`: the mechanism of a scene on ground that moves.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RockOptions {
    /// The direction of the mechanism, made horizontal; (1, 0, 0) where nothing is said.
    pub toward: [f64; 3],
    /// How the ground moves.
    pub ground: Given,
    /// The block whose way is told; the one that moves fastest where nothing is said.
    pub control: Option<RockPoint>,
    /// What is left of the speed at every impact; what conserves momentum where nothing is said.
    pub restitution: Option<f64>,
    /// Where it begins, at rest, as a part of the unstable equilibrium.
    #[serde(skip_serializing_if = "is_zero")]
    pub from: f64,
    /// It is followed for so many seconds; until it is at rest or has overturned where nothing is
    /// said.
    pub seconds: Option<f64>,
    /// The scales of the motion between these two at which it begins or ceases to overturn are
    /// looked for. In rows of a sweep the value is then the least at which it overturns.
    pub scan: Option<[f64; 2]>,
    /// End as soon as it is known whether it overturns. Rows of a sweep do that by themselves: a
    /// plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fate_only: bool,
}

/// A point of a block.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RockPoint {
    /// The block.
    pub block: String,
    /// Where it is at the start, m; the centre of mass where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<[f64; 3]>,
}

fn is_zero(v: &f64) -> bool {
    *v == 0.0
}

impl Default for RockOptions {
    fn default() -> Self {
        Self {
            toward: [1.0, 0.0, 0.0],
            ground: Given::default(),
            control: None,
            restitution: None,
            from: 0.0,
            seconds: None,
            scan: None,
            fate_only: false,
        }
    }
}

impl RockOptions {
    /// Refuses options that mean nothing, whatever the scene; a record that is only named is not
    /// looked into.
    ///
    /// # Errors
    /// The first option that means nothing, with its place.
    pub fn check(&self) -> Result<(), InputError> {
        let refuse = |key: &str, text: &str| Err(InputError::at(JsonPath::root().key(key), text));
        if !self.toward.iter().all(|v| v.is_finite()) || self.toward == [0.0; 3] {
            return refuse("toward", "the direction must not be zero");
        }
        if !self.ground.moves() && self.from == 0.0 {
            return refuse("ground", "nothing moves: give a pulse, a record or \"from\"");
        }
        self.ground.check().map_err(|e| e.under(&JsonPath::root().key("ground")))?;
        if self.restitution.is_some_and(|e| !(0.0..=1.0).contains(&e)) {
            return refuse("restitution", "must be between 0 and 1");
        }
        if !self.from.is_finite() {
            return refuse("from", "must be finite");
        }
        if self.seconds.is_some_and(|s| !(s > 0.0 && s.is_finite())) {
            return refuse("seconds", "must be > 0");
        }
        if self.scan.is_some() && !self.ground.moves() {
            return refuse("scan", "the ground does not move: there is nothing to scale");
        }
        let rises = |[from, to]: [f64; 2]| from >= 0.0 && from < to && to.is_finite();
        if self.scan.is_some_and(|s| !rises(s)) {
            return refuse("scan", "must be two scales >= 0, the smaller one first");
        }
        Ok(())
    }
}
