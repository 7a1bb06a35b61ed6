//! Units of acceleration, as files write them.

use std::fmt;

/// Standard gravity, m/s²: what records in g count in.
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// A unit of acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// m/s².
    MetrePerSecondSquared,
    /// cm/s², Gal.
    Gal,
    /// mm/s².
    MillimetrePerSecondSquared,
    /// Standard gravity.
    Gravity,
    /// Hundredths of standard gravity.
    PercentGravity,
}

/// How units are written.
pub const UNITS: &str = "m/s2, cm/s2 (Gal), mm/s2, g or %g";

impl Unit {
    /// One of it, m/s².
    pub fn value(self) -> f64 {
        match self {
            Self::MetrePerSecondSquared => 1.0,
            Self::Gal => 1e-2,
            Self::MillimetrePerSecondSquared => 1e-3,
            Self::Gravity => STANDARD_GRAVITY,
            Self::PercentGravity => 0.01 * STANDARD_GRAVITY,
        }
    }

    /// A unit by one of its names.
    pub fn read(text: &str) -> Option<Self> {
        let plain: String = text
            .trim()
            .to_lowercase()
            .replace('²', "2")
            .replace("sec", "s")
            .chars()
            .filter(|c| !c.is_whitespace() && !matches!(c, '^' | '*' | '·' | '"' | '\''))
            .collect();
        Some(match plain.trim_end_matches('.') {
            "m/s2" | "m/s/s" | "ms-2" | "m.s-2" | "mps2" => Self::MetrePerSecondSquared,
            "cm/s2" | "cm/s/s" | "cms-2" | "cm.s-2" | "gal" | "gals" => Self::Gal,
            "mm/s2" | "mm/s/s" | "mms-2" | "mm.s-2" => Self::MillimetrePerSecondSquared,
            "g" => Self::Gravity,
            "%g" => Self::PercentGravity,
            _ => return None,
        })
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::MetrePerSecondSquared => "m/s²",
            Self::Gal => "cm/s²",
            Self::MillimetrePerSecondSquared => "mm/s²",
            Self::Gravity => "g",
            Self::PercentGravity => "% of g",
        })
    }
}

impl std::str::FromStr for Unit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::read(text)
            .ok_or_else(|| format!("{text:?} is not a unit of acceleration; hint: {UNITS}"))
    }
}
