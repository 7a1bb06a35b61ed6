//! How a heap is made whose angle of repose is asked for.

use serde::{Deserialize, Serialize};

/// A protocol and its numbers. The defaults make the box drain of 2,000 grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Protocol {
    /// What is done.
    pub kind: ProtocolKind,
    /// Shape of the free grains; the fixed ones on the floor are spheres.
    pub grain: GrainKind,
    /// Length over width of clumps (1 to 2), longest over shortest axis of hulls (1 to 4).
    pub elongation: f64,
    /// Corners of hulls.
    pub corners: usize,
    /// Number of free grains.
    pub grains: usize,
    /// Mean diameter d, m: of the spheres, and of spheres of the same volume as the clumps or
    /// hulls.
    pub diameter: f64,
    /// Radii are spread evenly over the mean × (1 ± this).
    pub sizes: f64,
    /// Friction between grains, and of grains on the floor.
    pub friction: f64,
    /// Friction of grains on walls.
    pub wall_friction: f64,
    /// Rolling arm of grains on grains and on the floor, in mean diameters.
    pub rolling_arm: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Length and width of the box (drain, tilt), or twice the diameter of the cylinder or of the
    /// stream of the funnel and nothing, in mean diameters. Where it is not given it follows the
    /// number of grains: see [`Protocol::size`].
    pub size: Option<[f64; 2]>,
    /// Speed at which the cylinder is lifted, √(g d), or rate at which the bed is tilted, degrees
    /// per √(d/g).
    pub rate: f64,
}

/// The shape of the grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GrainKind {
    /// Spheres.
    #[default]
    Sphere,
    /// Two equal spheres rigidly joined.
    Clump,
    /// Convex hulls of random points on an ellipsoid, no two alike.
    Hull,
}

impl GrainKind {
    /// What many of them are called.
    pub fn plural(self) -> &'static str {
        match self {
            Self::Sphere => "grains",
            Self::Clump => "clumps",
            Self::Hull => "hulls",
        }
    }
}

/// What is done with the grains. The floor is rough: fixed grains at random places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProtocolKind {
    /// A box is filled, one end wall is taken away; what falls over the edge is discarded.
    #[default]
    Drain,
    /// Grains are poured in layers onto the middle of a floor, from close above the heap.
    Funnel,
    /// A hollow cylinder is filled and lifted.
    Cylinder,
    /// A bed in a closed box is tilted slowly until its surface flows, and left at that tilt.
    Tilt,
}

impl Default for Protocol {
    fn default() -> Self {
        Self {
            kind: ProtocolKind::Drain,
            grain: GrainKind::Sphere,
            elongation: 1.5,
            corners: 16,
            grains: 2000,
            diameter: 0.01,
            sizes: 0.2,
            friction: 0.5,
            wall_friction: 0.0,
            rolling_arm: 0.0,
            density: 2500.0,
            size: None,
            rate: 0.1,
        }
    }
}

/// Length and width of the box of [`SIZED`] grains, mean diameters.
const SIZE: [f64; 2] = [16.0, 10.0];
/// Grains of the box of [`SIZE`].
const SIZED: f64 = 2000.0;
/// Least length and width of a box, mean diameters: less, and grains bridge it.
const LEAST: f64 = 4.0;

impl Protocol {
    /// Length and width as given, or such that boxes of all numbers of grains are alike: 16 × 10
    /// diameters for 2,000 grains, by the cube root of the number for others. In a box of one size
    /// for all, few grains cover the floor and many fill a tower.
    pub fn size(&self) -> [f64; 2] {
        let scale = (self.grains as f64 / SIZED).cbrt();
        self.size.unwrap_or_else(|| SIZE.map(|s| (s * scale).max(LEAST)))
    }

    /// The same with its size written out.
    pub fn sized(&self) -> Self {
        Self { size: Some(self.size()), ..self.clone() }
    }
}
