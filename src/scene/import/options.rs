//! What the user adds to a foreign file.

use super::{Format, LayerRule};
use crate::Friction;
use base::error::{InputError, JsonPath};
use std::{collections::BTreeMap, path::PathBuf};

/// What the user adds to a foreign file.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportOptions {
    /// Ids of supports, besides those the file names.
    pub supports: Vec<String>,
    /// Blocks whose lowest corner lies below this height are supports; m, in the scene (after scale
    /// and rotation).
    pub support_below: Option<f64>,
    /// Files whose blocks are all supports.
    pub support_files: Vec<PathBuf>,
    /// Friction of every joint.
    pub friction: Option<Friction>,
    /// Density of every block, kg/m³, in place of what the file says.
    pub density: Option<f64>,
    /// Thickness of the blocks of a plane drawing (DXF), m in the scene.
    pub depth: Option<f64>,
    /// What layers of a drawing (DXF) stand for; those that are not named hold blocks.
    pub layers: BTreeMap<String, LayerRule>,
    /// Multiplies the coordinates: 0.001 for a file in millimetres. Where nothing is said, the unit that
    /// the file names, or metres.
    pub scale: Option<f64>,
    /// The axis of the file that points up. Where nothing is said, that of its format: y of glTF, z of all
    /// others.
    pub up: Option<Up>,
    /// The format, where extension and content do not tell it.
    pub format: Option<Format>,
    /// `contact.gap` of the scene: how far apart touching faces may be, relative to the smaller
    /// block's size.
    pub gap: Option<f64>,
    /// `contact.angle_deg` of the scene: how far from parallel touching faces may be, degrees.
    pub angle_deg: Option<f64>,
    /// Keep the interfaces stored in the file; contacts are then detected between the other pairs
    /// only.
    pub stored_interfaces: bool,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self {
            supports: Vec::new(),
            support_below: None,
            support_files: Vec::new(),
            friction: None,
            density: None,
            depth: None,
            layers: BTreeMap::new(),
            scale: None,
            up: None,
            format: None,
            gap: None,
            angle_deg: None,
            stored_interfaces: true,
        }
    }
}

/// The axis of a file that points up. Each brings its axis to z by a proper rotation (determinant
/// +1): nothing is mirrored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// x up: `(x, y, z) → (−z, y, x)`, −90° about y.
    X,
    /// y up: `(x, y, z) → (x, −z, y)`, +90° about x.
    Y,
    /// z up: nothing to do.
    #[default]
    Z,
    /// −x up: `(x, y, z) → (z, y, −x)`, +90° about y.
    MinusX,
    /// −y up: `(x, y, z) → (x, z, −y)`, −90° about x.
    MinusY,
    /// −z up: `(x, y, z) → (x, −y, −z)`, 180° about x.
    MinusZ,
}

impl Up {
    /// The rotated vector.
    pub fn rotate(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Up::X => [-z, y, x],
            Up::Y => [x, -z, y],
            Up::Z => [x, y, z],
            Up::MinusX => [z, y, -x],
            Up::MinusY => [x, z, -y],
            Up::MinusZ => [x, -y, -z],
        }
        // -0 → 0, so that the written scene has no "-0.0".
        .map(|c| c + 0.0)
    }
}

impl ImportOptions {
    /// Refuses values out of range before any file is read.
    pub(super) fn check(&self) -> Result<(), InputError> {
        let refuse = |what: &str, value: f64, rule: &str, hint: &str| {
            Err(InputError::at(JsonPath::root(), format!("{what}: must be {rule}, got {value}"))
                .hint(hint))
        };
        let positive = |x: f64| x.is_finite() && x > 0.0;
        if let Some(scale) = self.scale.filter(|&s| !positive(s)) {
            return refuse(
                "scale",
                scale,
                "finite and > 0",
                "0.001 for a file in millimetres; use `up` to turn the structure",
            );
        }
        if let Some(depth) = self.depth.filter(|&d| !positive(d)) {
            return refuse(
                "depth",
                depth,
                "finite and > 0",
                "the thickness of a drawing's blocks in m",
            );
        }
        for (name, rule) in &self.layers {
            rule.check_of(name)?;
        }
        if let Some(density) = self.density.filter(|&d| !positive(d)) {
            return refuse("density", density, "finite and > 0", "kg/m³; masonry is around 2000");
        }
        if let Some(gap) = self.gap.filter(|&g| !(g.is_finite() && g >= 0.0)) {
            return refuse(
                "gap",
                gap,
                "finite and >= 0",
                "relative to the smaller block's size, 1e-4 by default",
            );
        }
        if let Some(angle) = self.angle_deg.filter(|&a| !(a > 0.0 && a < 45.0)) {
            return refuse("angle", angle, "> 0 and < 45", "degrees from parallel, 1 by default");
        }
        if let Some(z) = self.support_below.filter(|z| !z.is_finite()) {
            return refuse(
                "support below",
                z,
                "finite",
                "a height in m, in the scene (after scale and rotation)",
            );
        }
        match self.friction {
            Some(Friction::Coefficient(mu)) if !(mu.is_finite() && mu >= 0.0) => refuse(
                "friction",
                mu,
                "finite and >= 0",
                "a coefficient of friction, or \"infinite\" for no sliding at all",
            ),
            _ => Ok(()),
        }
    }
}
