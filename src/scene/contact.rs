//! When faces touch.

use base::tolerance;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Contact tolerances, relative to the size (bounding-box diagonal) of the smaller block of a pair; a gap
/// beside a support to that of the free block, for a support is as large as it was drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ContactSpec {
    /// Faces closer than this × size touch; 1 to 100 times it is reported as a near miss.
    pub gap: f64,
    /// Faces touch only if their normals are opposite within this angle, degrees; faces that are
    /// not plane may lean by their twist besides.
    pub angle_deg: f64,
    /// Contacts smaller than this × size² are ignored and counted.
    pub min_area: f64,
}

impl Default for ContactSpec {
    fn default() -> Self {
        Self {
            gap: tolerance::CONTACT_GAP,
            angle_deg: tolerance::CONTACT_ANGLE_DEG,
            min_area: tolerance::CONTACT_MIN_AREA,
        }
    }
}

impl ContactSpec {
    /// Which tolerances are wider than usual, in words; `None` where none is.
    pub fn widened(&self) -> Option<String> {
        let usual = Self::default();
        let mut words = Vec::new();
        if self.gap > usual.gap {
            words.push(format!("gap {}", self.gap));
        }
        if self.angle_deg > usual.angle_deg {
            words.push(format!("angle {}°", self.angle_deg));
        }
        if self.min_area > usual.min_area {
            words.push(format!("least area {}", self.min_area));
        }
        (!words.is_empty()).then(|| words.join(", "))
    }

    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}
