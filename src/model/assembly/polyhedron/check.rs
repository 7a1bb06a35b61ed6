//! Refusals that need no neighbours: points in one plane, faces that cross themselves.

use super::{
    ShapeError,
    plane::{self, Frame},
    surface::{Face, Surface},
};
use base::{plane::polygon::P2, tolerance};
use nalgebra::Vector3;

/// Refuses corners that all lie within [`tolerance::FLAT`] × size of one plane. Said before
/// anything else about the surface: a flat box is closed, but its top and bottom coincide, and
/// "duplicate face" would mislead.
pub(super) fn refuse_plane(surface: &Surface) -> Result<(), ShapeError> {
    let flat = |thickness: f64| ShapeError::Flat { thickness, size: surface.size };
    let (_, across) = spread(&surface.points);
    let Some(normal) = across else { return Err(flat(0.0)) };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for p in &surface.points {
        low = low.min(normal.dot(p));
        high = high.max(normal.dot(p));
    }
    if high - low > tolerance::FLAT * surface.size { Ok(()) } else { Err(flat(high - low)) }
}

/// The largest distance of points from the line through two far ones, and the unit normal of the
/// plane through those and the farthest (none where the points lie in a line).
fn spread(points: &[Vector3<f64>]) -> (f64, Option<Vector3<f64>>) {
    let Some(first) = points.first() else { return (0.0, None) };
    let farthest = |measure: &dyn Fn(&Vector3<f64>) -> f64| {
        points.iter().max_by(|a, b| measure(a).total_cmp(&measure(b)))
    };
    let Some(second) = farthest(&|p| (p - first).norm_squared()) else { return (0.0, None) };
    let Some(way) = (second - first).try_normalize(0.0) else { return (0.0, None) };
    let Some(third) = farthest(&|p| (p - first).cross(&way).norm_squared()) else {
        return (0.0, None);
    };
    let across = way.cross(&(third - first));
    (across.norm(), across.try_normalize(0.0))
}

/// Refuses faces whose boundary crosses itself, such as a quadrilateral with two corners exchanged.
pub(super) fn refuse_crossed(surface: &Surface) -> Result<(), ShapeError> {
    surface
        .faces
        .iter()
        .filter(|f| f.corners.len() > 3)
        .try_for_each(|face| check_face(surface, face))
}

/// Refuses faces so far from plane ([`tolerance::GREATEST_WARP`]) that their corners alone do not
/// say where they run.
pub(super) fn refuse_folded(surface: &Surface) -> Result<(), ShapeError> {
    for face in surface.faces.iter().filter(|f| f.corners.len() > 3) {
        let Some(normal) = surface.area_vector(face).try_normalize(0.0) else { continue };
        let points = || face.corners.iter().map(|&c| surface.point(c));
        let heights = points().map(|p| normal.dot(&p));
        let (low, high) =
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let warp = (high - low) / 2.0;
        let corner = surface.point(face.corners[0]);
        // Between once and twice the greatest distance of two corners, which all pairs would have
        // to be looked at for.
        let across = 2.0 * points().map(|p| (p - corner).norm()).fold(0.0, f64::max);
        if warp > tolerance::GREATEST_WARP * across {
            return Err(ShapeError::Folded { face: face.source, warp });
        }
    }
    Ok(())
}

fn check_face(surface: &Surface, face: &Face) -> Result<(), ShapeError> {
    // There and back is a bridge to a hole; twice the same way is once around too often.
    let mut edges: Vec<_> = face.edges().collect();
    edges.sort_unstable();
    if let Some(twice) = edges.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(ShapeError::CrossedFace { face: face.source, at: surface.place(twice[0].0) });
    }
    let reach = tolerance::COPLANAR * surface.size;
    let points =
        || -> Vec<Vector3<f64>> { face.corners.iter().map(|&c| surface.point(c)).collect() };
    let vector = surface.area_vector(face);
    let area = vector.norm();
    let length: f64 = face.edges().map(|(a, b)| (surface.point(b) - surface.point(a)).norm()).sum();
    if area <= reach * length {
        // A needle, or two lobes that cancel.
        let points = points();
        if spread(&points).0 <= 4.0 * reach {
            return Ok(());
        }
        let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
        return Err(ShapeError::CrossedFace {
            face: face.source,
            at: (mean + surface.center).into(),
        });
    }
    let normal = vector / area;
    // Four left turns cannot go around twice: the common case needs nothing more.
    if let [a, b, c, d] = face.corners[..] {
        let [a, b, c, d] = [a, b, c, d].map(|c| surface.point(c));
        let sides = [b - a, c - b, d - c, a - d];
        if (0..4).all(|i| normal.dot(&sides[i].cross(&sides[(i + 1) % 4])) > 0.0) {
            return Ok(());
        }
    }
    let points = points();
    let frame = Frame::around(&normal);
    let flat: Vec<P2> = points.iter().map(|p| frame.project(p)).collect();
    if plane::convex_corners(&flat, reach).is_some() {
        return Ok(());
    }
    match plane::crossing(&flat, reach) {
        None => Ok(()),
        Some(at) => {
            let height = points.iter().map(|p| normal.dot(p)).sum::<f64>() / points.len() as f64;
            let place = frame.lift(at) + normal * height + surface.center;
            Err(ShapeError::CrossedFace { face: face.source, at: place.into() })
        }
    }
}
