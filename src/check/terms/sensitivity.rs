//! How a value changes with the numbers that were assumed.

use super::law::Law;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// How a value changes with every number that was assumed.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Sensitivity {
    /// What changes.
    pub of: Changing,
    /// For which law of sliding: `associative` means the bound.
    pub law: Law,
    /// One a number, the one that matters most first.
    pub numbers: Vec<Derivative>,
    /// Numbers of the scene that are left out, beyond so many.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub omitted: usize,
}

/// The value whose changes are told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Changing {
    /// The load factor λ.
    LoadFactor,
    /// The tilt, degrees.
    TiltDeg,
    /// The load factor α0 of an earthquake.
    Alpha0,
}

/// How a value changes with one number.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Derivative {
    /// Where the number stands: its JSON pointer into the scene.
    pub pointer: String,
    /// The number.
    pub value: f64,
    /// Its unit; empty where it has none.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub unit: &'static str,
    /// Change of the value per unit of the number as that falls.
    pub left: Option<f64>,
    /// The same as it grows.
    pub right: Option<f64>,
    /// Change of the value where the number changes by 1 % (of a place: by 1 % of the size of the
    /// block), the greater of both sides in size.
    pub per_percent: Option<f64>,
    /// How it is known.
    pub origin: Origin,
}

impl Derivative {
    /// The derivative, where it is the same on both sides.
    pub fn one(&self) -> Option<f64> {
        let (left, right) = self.left.zip(self.right)?;
        (left == right).then_some(left)
    }
}

/// How a derivative is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// From the forces and the mechanism that prove the value: what of them counts is the same in
    /// all that prove it.
    Proof,
    /// Asked again with the number a little less and a little more. Computed, not proved.
    AskedAgain,
    /// It has two sides, or slides with dry friction, and was not asked again.
    NotAsked,
}

/// Both derivatives of a value with one number, asked again with the number changed. Computed.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sided {
    /// JSON pointer of the number.
    pub pointer: String,
    /// As it falls; absent where there is no scene with less of it, or no value.
    pub left: Option<f64>,
    /// As it grows.
    pub right: Option<f64>,
}

fn is_zero(n: &usize) -> bool {
    *n == 0
}
