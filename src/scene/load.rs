//! Loads as the file gives them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Loads besides the blocks' own weight.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Loads {
    /// Always there, like the weight.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dead: Vec<Load>,
    /// Multiplied by the load factor λ.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub live: Vec<Load>,
    /// Masses that an earthquake pushes against a block without resting on it, such as a floor that
    /// spans along a wall. `kinematic` alone counts them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub masses: Vec<PushingMass>,
}

/// A mass that an earthquake pushes against a block, and that rests elsewhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PushingMass {
    /// The block that it pushes.
    pub block: String,
    /// Where: a point of the scene, m.
    pub at: [f64; 3],
    /// Mass, kg.
    pub mass: f64,
}

/// One load: a `force` and/or `moment` on a `block`, or an `acceleration` or `weight` on one block
/// or all free blocks.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// A name by which stages add and remove it.
    pub id: Option<String>,
    /// The action that it belongs to in combinations; `dead` or `live`, as its list, where absent.
    pub action: Option<String>,
    /// The loaded block; every free block where absent (`acceleration` and `weight` only).
    pub block: Option<String>,
    /// Force, N.
    pub force: Option<[f64; 3]>,
    /// Moment, N·m.
    pub moment: Option<[f64; 3]>,
    /// Where the force acts: a point of the scene, m, or `"centroid"` (the default).
    pub at: Option<At>,
    /// Where on the road of a `bridge` template the force presses, in place of `block` and `at`: the
    /// fill spreads it.
    pub road: Option<OnRoad>,
    /// An arm of no weight carries the force from the block to `at`, however far off that lies.
    /// Without it such a force is taken for a mistake.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub arm: bool,
    /// Of a dead load along gravity: no mass stands behind it (the thrust of a vault, the pull of a
    /// cable), so that an earthquake does not push it. `kinematic` takes other loads along gravity
    /// for weights.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub massless: bool,
    /// Body force: mass × this acceleration, m/s².
    pub acceleration: Option<[f64; 3]>,
    /// Body force as multiples of the block's own weight.
    pub weight: Option<[f64; 3]>,
}

/// A stretch of the road of a bridge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnRoad {
    /// Where its middle lies, x in the scene, m.
    pub x: f64,
    /// Its length, m; 0.3 where absent.
    #[serde(default = "patch")]
    pub patch: f64,
    /// Its width across the bridge, m. The width that carries it is this with the spread to either
    /// side, at most that of the bridge; all of the bridge where absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub across: Option<f64>,
}

/// The usual length of the patch of an axle, m.
pub(super) fn patch() -> f64 {
    0.3
}

/// Where a force acts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a point [x, y, z] or \"centroid\"")]
pub enum At {
    /// A point of the scene, m.
    Point([f64; 3]),
    /// The block's centre of mass.
    Centroid(Centroid),
}

/// The word `"centroid"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Centroid {
    /// The block's centre of mass.
    Centroid,
}

impl Load {
    /// The load times a factor.
    pub(super) fn times(&self, factor: f64) -> Self {
        let scaled = |v: Option<[f64; 3]>| v.map(|v| v.map(|c| c * factor));
        let (force, moment) = (scaled(self.force), scaled(self.moment));
        let (acceleration, weight) = (scaled(self.acceleration), scaled(self.weight));
        Self { force, moment, acceleration, weight, ..self.clone() }
    }
}

impl Loads {
    /// `factor` × the live loads as dead loads, beside the dead ones; no live load is left.
    #[must_use]
    pub fn fixed(&self, factor: f64) -> Self {
        let as_live = |l: &Load| l.action.clone().or_else(|| Some(super::LIVE.into()));
        let added = self.live.iter().filter(|_| factor != 0.0);
        let added = added.map(|l| Load { action: as_live(l), ..l.times(factor) });
        let dead = self.dead.iter().cloned().chain(added).collect();
        Self { dead, live: Vec::new(), masses: self.masses.clone() }
    }

    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
