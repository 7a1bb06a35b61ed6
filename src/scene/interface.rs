//! Interfaces given by hand.

use super::Friction;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A contact given by hand, for joints that were discretised elsewhere. Detection skips the pair.
/// Without points: the normal across which edges or corners of the pair meet where several are
/// possible.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InterfaceSpec {
    /// The ids of the two blocks.
    pub between: [String; 2],
    /// Corners of the contact, m, in scene coordinates: a convex polygon, an edge (two points) or
    /// one point. None where only the normal of a touch is given that is found.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 3]>,
    /// Normal from the first block into the second; may be left out where three or more points span
    /// a plane, and is then turned so that it points from the first block's centre to the second's.
    /// Where a plane is spanned and a normal given, the plane gives the direction and the normal
    /// the side.
    pub normal: Option<[f64; 3]>,
    /// Friction of this interface; overrides the joint rules.
    pub friction: Option<Friction>,
}
