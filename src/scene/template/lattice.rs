//! Piles of equal spheres on a lattice.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Equal touching spheres `g000`, `g001`, … on a fixed layer `bed00`, …, layer by layer from below.
/// The centres of the bed lie at z = 0.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lattice {
    /// Put before the ids of the blocks.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub prefix: String,
    /// Where the origin of the template lies, m.
    #[serde(default, skip_serializing_if = "super::is_origin")]
    pub at: [f64; 3],
    /// Name of the material of all blocks.
    pub material: Option<String>,
    /// Members that join its blocks, named without the prefix, with points about its origin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<crate::Member>,
    /// How the spheres lie.
    #[serde(default)]
    pub packing: Packing,
    /// Radius of every sphere, m.
    pub radius: f64,
    /// Free layers above the bed.
    pub layers: usize,
    /// Spheres along a side of the bed; by default one more than there are layers, so that a pile
    /// ends in one sphere.
    pub side: Option<usize>,
}

/// How the spheres of a lattice lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Packing {
    /// A tetrahedral pile of close-packed triangular layers (face-centred cubic); two edges of the
    /// bed point along x and 60° from it.
    #[default]
    Fcc,
    /// A pyramid of square layers, each in the pockets of the one below (the same lattice, seen
    /// along a cube's side).
    Square,
    /// A triangular pile of discs: one row above the other in the x–z plane.
    Triangular,
    /// One square layer of spheres in the pockets of the bed and nothing above, whatever `layers`.
    Bed,
}
