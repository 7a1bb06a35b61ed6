//! A train of axles as the file gives it: loads that move over the road of a bridge.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Axles at fixed distances that drive over the road of a `bridge` template along x. `limit --moving`
/// alone asks for it: the forces of the axles, where they stand, are its live load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Train {
    /// The axles; at least one.
    pub axles: Vec<Axle>,
    /// Where the train's own origin goes: x in the scene at the start and at the end of the way, m.
    /// Both directions of travel take this way; for all axles of both to pass the whole bridge it
    /// begins a train's length before it and ends one behind it.
    pub path: [f64; 2],
    /// Distance between two positions on the way, m; the last step may be shorter.
    pub step: f64,
    /// The action that it belongs to in combinations; `live` where absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub action: Option<String>,
}

/// An axle of a train.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Axle {
    /// Where it stands in the train that travels towards +x, from the train's origin, m. Towards −x
    /// the train is turned round, so that it stands as far on the other side.
    pub at: f64,
    /// How hard it presses.
    pub force: AxleForce,
    /// Length of its patch on the road, m; 0.3 where absent.
    #[serde(default = "super::load::patch")]
    pub patch: f64,
    /// Width of its patch across the bridge, m, as of a load on the road.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub across: Option<f64>,
}

/// The force of an axle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a force along gravity in N, or a vector [0, 0, -force]")]
pub enum AxleForce {
    /// Along gravity, N.
    Down(f64),
    /// A vector, N, along gravity.
    Vector([f64; 3]),
}

impl AxleForce {
    /// How large it is, N.
    pub fn size(self) -> f64 {
        match self {
            Self::Down(force) => force,
            Self::Vector([x, y, z]) => x.hypot(y).hypot(z),
        }
    }
}
