//! Volume, centroid and inertia, exact for polyhedra.
//!
//! The surface is cut into tetrahedra over one origin, each counted with the sign of its
//! orientation (Mirtich 1996; the covariance of a tetrahedron as in Blow & Binstock 2004). The
//! origin is the centre of the bounding box: about a distant origin the signed parts are larger
//! than their sum by (distance / size)ⁿ and that many digits are lost.
//!
//! * B. Mirtich, *Fast and accurate computation of polyhedral mass properties*, J. Graphics Tools
//!   1(2), 1996.
//! * J. Blow, A. Binstock, *How to find the inertia tensor (or other mass properties) of a 3D solid
//!   body represented by a triangle mesh*, 2004.

use super::{message::ShapeError, surface::Surface};
use nalgebra::{Matrix3, Vector3};

/// Volume, centroid and inertia for unit density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Volume, m³.
    pub volume: f64,
    /// Centroid in scene coordinates, m.
    pub centroid: Vector3<f64>,
    /// ∫ (|r|² 1 − r rᵀ) dV about the centroid, m⁵; times the density it is the inertia.
    pub inertia: Matrix3<f64>,
}

/// Mass properties of a closed, oriented surface.
pub(super) fn mass_properties(surface: &Surface) -> MassProperties {
    let mut volume = 0.0;
    let mut first = Vector3::zeros();
    // Upper triangle of ∫ r rᵀ dV: xx, yy, zz, xy, yz, zx.
    let mut second = [0.0; 6];
    for face in &surface.faces {
        surface.fan(face, |a, b, c| {
            let det = a.dot(&b.cross(&c));
            let s = a + b + c;
            volume += det;
            first += det * s;
            for (k, (i, j)) in
                [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate()
            {
                second[k] += det * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + s[i] * s[j]);
            }
        });
    }
    let volume = volume / 6.0;
    let centroid = first / (24.0 * volume);
    let [xx, yy, zz, xy, yz, zx] = second.map(|x| x / 120.0);
    let about_origin = Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz);
    let covariance = about_origin - volume * centroid * centroid.transpose();
    MassProperties {
        volume,
        centroid: centroid + surface.center,
        inertia: Matrix3::identity() * covariance.trace() - covariance,
    }
}

/// Slack for rounding: of the box for the centroid and the volume, of the greatest second moment
/// for the least. Larger: tangles that enclose hardly anything pass. Smaller: thin plates, whose
/// moments across are rounding, are refused.
const SLACK: f64 = 1e-6;

/// Refuses what no body can have: more volume than its box, its centroid outside of the box, a
/// negative second moment. Such a surface winds around some places more than once and around others
/// backwards, which warped faces hide from the tests that see them as plane. `corners` are those of
/// the facets that are left, which spikes of no width do not reach.
pub(super) fn refuse_impossible(
    surface: &Surface,
    mass: &MassProperties,
    corners: &[Vector3<f64>],
) -> Result<(), ShapeError> {
    let (low, high) =
        bounds(surface.faces.iter().flat_map(|f| &f.corners).map(|&c| surface.point(c)));
    let (least, most) = bounds(corners.iter().copied());
    let slack = SLACK * surface.size;
    let inside = (0..3).all(|k| (least[k] - slack..=most[k] + slack).contains(&mass.centroid[k]));
    // Per volume and size², so that nothing leaves the range of numbers.
    let scale = mass.volume * surface.size * surface.size;
    let inertia = mass.inertia / scale;
    let moments = (Matrix3::identity() * (0.5 * inertia.trace()) - inertia).symmetric_eigenvalues();
    let possible = mass.volume <= (high - low).product() * (1.0 + SLACK)
        && moments.min() >= -SLACK * moments.max().max(0.0);
    if inside && possible { Ok(()) } else { Err(ShapeError::Tangled) }
}

/// The bounding box of some points.
fn bounds(points: impl Iterator<Item = Vector3<f64>>) -> (Vector3<f64>, Vector3<f64>) {
    points
        .fold((Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)), |(l, h), p| {
            (l.inf(&p), h.sup(&p))
        })
}
