//! The tolerances of one pair of blocks, in metres.

use super::body::BoundedBlock;
use base::tolerance;
use nalgebra::Vector3;
use scene::ContactSpec;

/// What counts as touching between two given blocks. All lengths derive from the size of the
/// smaller block, and none is below the rounding of the coordinates. How far apart two blocks may be
/// that touch is no matter of how large a support was drawn: beside a free block only that one counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Size of the smaller free block, of two supports of the smaller one, m.
    pub size: f64,
    /// Gaps and overlaps up to this are closed, m.
    pub gap: f64,
    /// Gaps up to this are near misses, m.
    pub near: f64,
    /// Points closer than this in the plane of a contact are one, m.
    pub weld: f64,
    /// Gaps and overlaps up to this are rounding, m.
    pub noise: f64,
    /// Least area, m².
    pub min_area: f64,
    /// Greatest `|n_a + n_b|` of two facets that face each other.
    pub chord: f64,
    /// Greatest `|n_a + n_b|` of two facets that nearly face each other.
    pub near_chord: f64,
}

/// Reach of near misses, × size.
pub(super) fn near(spec: &ContactSpec) -> f64 {
    (spec.gap * tolerance::NEAR_MISS_FACTOR).min(tolerance::NEAR_MISS_LIMIT).max(spec.gap)
}

impl Limits {
    pub fn of(a: &BoundedBlock, b: &BoundedBlock, spec: &ContactSpec) -> Self {
        let smaller = a.block.size.min(b.block.size);
        let size = match (a.block.support, b.block.support) {
            (true, false) => b.block.size,
            (false, true) => a.block.size,
            _ => smaller,
        };
        // The greater block's corners count too: they carry the plane the smaller one lies on.
        let rounding = tolerance::COORDINATE_ROUNDING * a.bounds.reach().max(b.bounds.reach());
        let gap = (spec.gap * size).max(rounding);
        Self {
            size,
            gap,
            near: (near(spec) * smaller).max(gap),
            weld: (tolerance::CONTACT_WELD * smaller).max(rounding),
            noise: (tolerance::GAP_WORTH_TELLING * smaller).max(rounding),
            min_area: spec.min_area * smaller * smaller,
            chord: chord(spec.angle_deg) + tolerance::CONTACT_ROUNDING_ANGLE,
            near_chord: chord(spec.angle_deg.max(tolerance::NEAR_MISS_ANGLE_DEG))
                + tolerance::CONTACT_ROUNDING_ANGLE,
        }
    }

    /// How far normals `a` and `b` are from opposite, `|n_a + n_b|`, less what the twist of the
    /// facets (radians) explains.
    pub fn lean(&self, a: &Vector3<f64>, b: &Vector3<f64>, twist: f64) -> f64 {
        ((a + b).norm() - twist).max(0.0)
    }
}

/// `|n_a + n_b|` of facets this far from parallel.
fn chord(degrees: f64) -> f64 {
    2.0 * (degrees.to_radians() / 2.0).sin()
}

/// Degrees from parallel of facets with this `|n_a + n_b|`.
pub(super) fn degrees(chord: f64) -> f64 {
    (2.0 * (chord / 2.0).min(1.0).asin()).to_degrees()
}
