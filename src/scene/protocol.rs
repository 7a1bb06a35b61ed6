//! How a heap is made whose angle of repose is asked for.

use super::Sizes;
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
    /// How large the grains are.
    pub sizes: Sizes,
    /// Friction between grains, and of grains on the floor.
    pub friction: f64,
    /// Friction of grains on walls.
    pub wall_friction: f64,
    /// Rolling arm of grains on grains and on the floor, in mean diameters; its share of the mean
    /// radius is [`Protocol::rolling_friction`].
    pub rolling_arm: f64,
    /// Coefficient of normal restitution e of all contacts: speed apart over speed together of two
    /// grains that meet.
    pub restitution: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Length and width of the box (drain, tilt, shear), twice the diameter of the cylinder or of the
    /// stream of the funnel and nothing, diameter and length of the drum, or diameters of the bin
    /// and of its orifice (hopper), in mean diameters. Where it is not given it follows the
    /// number of grains: see [`Protocol::size`]. A cell finds its own.
    pub size: Option<[f64; 2]>,
    /// Speed at which the cylinder is lifted or the box is sheared, √(g d), or rate at which the bed
    /// is tilted or the drum turns, degrees per √(d/g), or inertial number d γ̇ √(ρ/P) at which a
    /// cell is sheared. Where it is not given it follows the kind: see [`Protocol::rate`].
    pub rate: Option<f64>,
    /// Pressure of the lid of the shear box, or in a cell, ρ g d.
    pub pressure: f64,
    /// Stiffness of the grains of a cell, κ = (E / (1 − ν²) P)^{2/3}: they overlap by 2 d / κ in the
    /// mean (Agnolin & Roux 2007).
    pub stiffness: f64,
    /// How far above the highest grain the layers of the funnel are let go, in mean diameters.
    pub drop: f64,
    /// What the grains lie on.
    pub floor: FloorKind,
}

/// The floor under the grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FloorKind {
    /// Fixed grains at random places; none on the plate of a hopper.
    #[default]
    Rough,
    /// A plane with the friction of the grains; of a drum its inside, with the friction of walls.
    Flat,
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

/// What is done with the grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProtocolKind {
    /// A box is filled, one end wall is taken away; what falls over the edge is discarded.
    #[default]
    Drain,
    /// Grains are poured in layers onto the middle of a floor, from above the heap.
    Funnel,
    /// A hollow cylinder is filled and lifted.
    Cylinder,
    /// A bed in a closed box is tilted slowly until its surface flows, and left at that tilt.
    Tilt,
    /// A drum, partly filled, turns about its level axis: the angle at which its surface flows.
    Drum,
    /// The round hole in the flat floor of a bin is opened: how much runs out in a time.
    Hopper,
    /// The upper half of a box is pushed over the lower one under a lid (direct shear): how much it
    /// resists, and how the grains rise.
    Shear,
    /// A cell that repeats itself is filled, compressed from all sides and sheared at constant
    /// pressure: internal friction, solid fraction and coordination of the steady flow.
    Cell,
}

impl ProtocolKind {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Drain,
        Self::Funnel,
        Self::Cylinder,
        Self::Tilt,
        Self::Drum,
        Self::Hopper,
        Self::Shear,
        Self::Cell,
    ];

    /// Whether it leaves a heap behind that has a slope.
    pub fn leaves_a_slope(self) -> bool {
        !matches!(self, Self::Drum | Self::Hopper | Self::Shear | Self::Cell)
    }
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
            sizes: Sizes::Even(0.2),
            friction: 0.5,
            wall_friction: 0.0,
            rolling_arm: 0.0,
            restitution: 0.0,
            density: 2500.0,
            size: None,
            rate: None,
            pressure: 10.0,
            stiffness: 1000.0,
            drop: 3.0,
            floor: FloorKind::Rough,
        }
    }
}

/// Length and width of the box of [`SIZED`] grains, mean diameters.
const SIZE: [f64; 2] = [16.0, 10.0];
/// Diameter and length of the drum that they fill to a third, diameters of bin and orifice; mean
/// diameters.
const DRUM: [f64; 2] = [28.0, 6.4];
const HOPPER: [f64; 2] = [14.0, 5.0];
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
        let size = match self.kind {
            ProtocolKind::Drum => DRUM,
            ProtocolKind::Hopper => HOPPER,
            _ => SIZE,
        };
        self.size.unwrap_or_else(|| size.map(|s| (s * scale).max(LEAST)))
    }

    /// The rate as given, or such that what is measured hardly depends on it.
    pub fn rate(&self) -> f64 {
        self.rate.unwrap_or(match self.kind {
            ProtocolKind::Drum => 1.0,
            ProtocolKind::Shear => 0.05,
            ProtocolKind::Cell => 0.01,
            _ => 0.1,
        })
    }

    /// The rolling arm over the mean radius, as the literature has it: the coefficient μ_r of a
    /// couple `μ_r R f_n` (Zhou et al. 1999). Codes that count it by the reduced radius
    /// `R₁ R₂ / (R₁ + R₂)` of two grains (Ai et al. 2011), half as large for equal ones, say twice
    /// this.
    ///
    /// * Y. C. Zhou, B. D. Wright, R. Y. Yang, B. H. Xu, A. B. Yu, *Rolling friction in the dynamic
    ///   simulation of sandpile formation*, Physica A 269 (1999) 536.
    /// * J. Ai, J.-F. Chen, J. M. Rotter, J. Y. Ooi, *Assessment of rolling resistance models in
    ///   discrete element simulations*, Powder Technology 206 (2011) 269.
    pub fn rolling_friction(&self) -> f64 {
        2.0 * self.rolling_arm
    }

    /// The same with its size and rate written out.
    pub fn sized(&self) -> Self {
        let size = if self.kind == ProtocolKind::Cell { self.size } else { Some(self.size()) };
        Self { size, rate: Some(self.rate()), ..self.clone() }
    }
}
