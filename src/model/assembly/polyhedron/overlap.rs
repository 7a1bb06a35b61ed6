//! Facets that cut through or cover each other.
//!
//! Two plane facets cut through each other where each has points on both sides of the other's plane
//! and their sections with the line common to both planes overlap. To tell cutting from touching,
//! each section is taken twice, a tolerance above and a tolerance below the other's plane, and only
//! what is in both counts: an edge that rests on a face has a section on one side only. Facets are
//! tested as wholes, not triangles, so that a cut along a diagonal of the triangulation is seen.

use super::{ShapeError, facets::Region, plane::Frame, surface::Surface};
use base::{
    plane::polygon::{P2, area, cross, edges},
    tolerance,
};
use nalgebra::Vector3;

/// Refuses a surface that cuts through or covers itself. Convex ones need not be asked.
pub(super) fn refuse_overlap(surface: &Surface, regions: &[Region]) -> Result<(), ShapeError> {
    let reach = tolerance::COPLANAR * surface.size;
    let mut sheets: Vec<Sheet> = regions.iter().map(|r| Sheet::new(surface, r, reach)).collect();
    let size =
        sheets.iter().fold(Vector3::zeros(), |size: Vector3<f64>, s| size.sup(&s.high.abs()));
    let axis = size.imax();
    sheets.sort_by(|a, b| a.low[axis].total_cmp(&b.low[axis]));
    for (i, a) in sheets.iter().enumerate() {
        for b in sheets[i + 1..].iter().take_while(|b| b.low[axis] <= a.high[axis]) {
            if (0..3).any(|k| a.low[k] > b.high[k] || b.low[k] > a.high[k]) {
                continue;
            }
            if let Some(at) = a.cuts(b).or_else(|| a.covers(b)) {
                let source = |s: &Sheet| surface.faces[s.region.faces[0] as usize].source;
                let (first, second) = (source(a).min(source(b)), source(a).max(source(b)));
                return Err(ShapeError::Overlap {
                    first,
                    second,
                    at: (at + surface.center).into(),
                });
            }
        }
    }
    Ok(())
}

/// A facet ready for comparisons.
struct Sheet<'a> {
    surface: &'a Surface,
    region: &'a Region,
    low: Vector3<f64>,
    high: Vector3<f64>,
    /// How far points may lie off its plane and still be in it.
    slack: f64,
}

impl<'a> Sheet<'a> {
    fn new(surface: &'a Surface, region: &'a Region, reach: f64) -> Self {
        let (mut low, mut high) =
            (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        for &(c, _) in &region.boundary {
            low = low.inf(&surface.point(c));
            high = high.sup(&surface.point(c));
        }
        Self { surface, region, low, high, slack: reach + region.warp }
    }

    fn height(&self, p: &Vector3<f64>) -> f64 {
        self.region.normal.dot(p) - self.region.offset
    }

    /// Least and greatest height of `other` over this facet's plane.
    fn heights(&self, other: &Sheet) -> (f64, f64) {
        other
            .region
            .boundary
            .iter()
            .map(|&(c, _)| self.height(&other.surface.point(c)))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)))
    }

    fn straddled_by(&self, other: &Sheet) -> bool {
        let (low, high) = self.heights(other);
        low < -self.slack && high > self.slack
    }

    /// A point where two facets cut through each other.
    fn cuts(&self, other: &Sheet) -> Option<Vector3<f64>> {
        if !self.straddled_by(other) || !other.straddled_by(self) {
            return None;
        }
        let (n, m) = (self.region.normal, other.region.normal);
        let along = n.cross(&m);
        let sine = along.norm();
        let along = along.try_normalize(0.0)?;
        let common = common(&self.sections(other, &along), &other.sections(self, &along));
        let (from, to) = common.into_iter().max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)))?;
        if to - from <= 8.0 * (self.slack + other.slack) / sine {
            return None;
        }
        // The point of both planes nearest the origin, then along the line.
        let (c, d) = (self.region.offset, other.region.offset);
        let k = n.dot(&m);
        let base = (n * (c - d * k) + m * (d - c * k)) / (sine * sine);
        Some(base + along * (from + to) / 2.0)
    }

    /// Where `other` passes through this facet's plane, as intervals along the common line.
    fn sections(&self, other: &Sheet, along: &Vector3<f64>) -> Vec<(f64, f64)> {
        common(&self.section(other, along, self.slack), &self.section(other, along, -self.slack))
    }

    /// The section of `other` at one height over this facet's plane (even-odd rule).
    fn section(&self, other: &Sheet, along: &Vector3<f64>, height: f64) -> Vec<(f64, f64)> {
        let mut crossings: Vec<f64> = Vec::new();
        for &(a, b) in &other.region.boundary {
            let (p, q) = (other.surface.point(a), other.surface.point(b));
            let (hp, hq) = (self.height(&p) - height, self.height(&q) - height);
            if (hp > 0.0) != (hq > 0.0) {
                crossings.push(along.dot(&(p + (q - p) * (hp / (hp - hq)))));
            }
        }
        crossings.sort_unstable_by(f64::total_cmp);
        crossings.chunks_exact(2).map(|c| (c[0], c[1])).collect()
    }

    /// A point where two facets lie on each other: facing the same way, or folded over a common
    /// edge. Facets that face each other without a common edge merely touch.
    fn covers(&self, other: &Sheet) -> Option<Vector3<f64>> {
        let slack = self.slack + other.slack;
        let (low, high) = self.heights(other);
        if low < -slack || high > slack {
            return None;
        }
        let folded = || {
            self.region
                .boundary
                .iter()
                .any(|&(a, b)| other.region.boundary.binary_search(&(b, a)).is_ok())
        };
        if self.region.normal.dot(&other.region.normal) < 0.0 && !folded() {
            return None;
        }
        let frame = Frame::around(&self.region.normal);
        let flat = |sheet: &Sheet| -> Vec<Vec<P2>> {
            let points = |p: &Vec<u32>| {
                let mut points: Vec<P2> =
                    p.iter().map(|&c| frame.project(&sheet.surface.point(c))).collect();
                if area(&points) < 0.0 {
                    points.reverse();
                }
                points
            };
            sheet.region.pieces.iter().map(points).collect()
        };
        let others = flat(other);
        for (piece, own) in self.region.pieces.iter().zip(flat(self)) {
            if others.iter().any(|o| !apart(&own, o, slack) && !apart(o, &own, slack)) {
                let corners = piece.iter().map(|&c| self.surface.point(c));
                return Some(corners.sum::<Vector3<f64>>() / piece.len() as f64);
            }
        }
        None
    }
}

/// Whether an edge of the convex polygon `a`, which runs counter-clockwise, has all of `b` beyond
/// it, but for `slack`.
fn apart(a: &[P2], b: &[P2], slack: f64) -> bool {
    edges(a).any(|(p, q)| b.iter().all(|&c| cross(p, q, c) <= slack * (q - p).norm()))
}

/// What two sorted lists of intervals have in common.
fn common(a: &[(f64, f64)], b: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let (mut i, mut j) = (0, 0);
    let mut both = Vec::new();
    while i < a.len() && j < b.len() {
        let (from, to) = (a[i].0.max(b[j].0), a[i].1.min(b[j].1));
        if from < to {
            both.push((from, to));
        }
        if a[i].1 < b[j].1 { i += 1 } else { j += 1 }
    }
    both
}
