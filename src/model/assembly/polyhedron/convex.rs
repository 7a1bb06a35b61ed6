//! Whether a polyhedron is convex.

use super::{facets::Region, plane::Frame, surface::Surface};
use base::{
    plane::polygon::{self, P2},
    tolerance,
};
use nalgebra::Vector3;

/// Corners in one cluster, roughly.
const CLUSTER: usize = 64;

/// Whether all corners lie on or below each facet plane, within [`tolerance::COPLANAR`] × size (the
/// facet's warp where that is larger), and the facets cover their hull once. To be asked about a
/// single shell.
pub(super) fn is_convex(surface: &Surface, regions: &[Region]) -> bool {
    let reach = tolerance::COPLANAR * surface.size;
    let clusters = clusters(surface);
    let below = |r: &Region| {
        let most = r.offset + reach.max(r.warp * (1.0 + 1e-9));
        clusters.iter().all(|c| {
            c.support(&r.normal) <= most || c.points.iter().all(|p| r.normal.dot(p) <= most)
        })
    };
    regions.iter().all(below) && covers_once(surface, regions)
}

/// Facets with all corners below them lie on the hull, which a closed surface may still cover
/// twice; its shadow then has twice the area of the hull's.
fn covers_once(surface: &Surface, regions: &[Region]) -> bool {
    let direction = Vector3::new(0.48, 0.6, 0.64);
    let frame = Frame::around(&direction);
    let shadow: f64 = regions.iter().map(|r| r.area * r.normal.dot(&direction).max(0.0)).sum();
    let points: Vec<P2> = surface.points.iter().map(|p| frame.project(p)).collect();
    let hull: Vec<P2> = polygon::corners(&points).into_iter().map(|i| points[i]).collect();
    shadow < 1.5 * polygon::area(&hull)
}

/// Corners near each other with their bounding box: a plane above the box is above all of them, so
/// that a convex polyhedron of n corners takes far fewer than n² comparisons.
struct Cluster {
    low: Vector3<f64>,
    high: Vector3<f64>,
    points: Vec<Vector3<f64>>,
}

impl Cluster {
    fn over(points: Vec<Vector3<f64>>) -> Self {
        let (mut low, mut high) =
            (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        for p in &points {
            low = low.inf(p);
            high = high.sup(p);
        }
        Self { low, high, points }
    }

    /// The greatest value of `normal · x` in the box.
    fn support(&self, normal: &Vector3<f64>) -> f64 {
        (0..3).map(|k| (normal[k] * self.low[k]).max(normal[k] * self.high[k])).sum()
    }
}

fn clusters(surface: &Surface) -> Vec<Cluster> {
    let points = &surface.points;
    if points.len() <= 2 * CLUSTER {
        return vec![Cluster::over(points.clone())];
    }
    // A surface fills about n² of n³ cells.
    let cells = (points.len() as f64 / CLUSTER as f64).sqrt().ceil();
    let cell =
        |p: &Vector3<f64>| [0, 1, 2].map(|k| ((p[k] / surface.size + 0.5) * cells).floor() as i64);
    let mut sorted = points.clone();
    sorted.sort_by_cached_key(cell);
    sorted.chunk_by(|a, b| cell(a) == cell(b)).map(|chunk| Cluster::over(chunk.to_vec())).collect()
}
