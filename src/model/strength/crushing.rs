//! Pressures up to a compressive strength, over the area that touches.
//!
//! Pressures `0 ≤ p ≤ σ` on the area `A` have a resultant `N` with first moment `m` exactly where
//! `α N + β·m ≤ σ ∫ (α + β·x)⁺ dA` for every affine function (the support function of a moment
//! set). On a rectangle bent about one axis this is the compressed block at the edge, `|M| ≤ N t /
//! 2 − N² / (2 σ b)`.

use super::section::Section;
use crate::interface::Interface;
use base::plane::{
    clip::{clip, inside},
    polygon::{P2, area, centroid, edges},
};
use nalgebra::Matrix2;

/// A bound on the normal forces at the corners that every admissible pressure respects: `Σ g(p_k)
/// f_k ≤ σ ∫ g⁺ dA`, `g` affine.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// `g` at each corner.
    pub weights: Vec<f64>,
    /// `∫ g⁺ dA`, in m² × the unit of `g`.
    pub capacity: f64,
}

/// Whether the joint can crush: it has a compressive strength and an area. Edges and points have no
/// stress to speak of.
pub fn crushes(face: &Interface) -> bool {
    face.law.compression.is_finite() && face.points.len() > 2 && face.area > 0.0
}

/// The bounds along the edges of the hull. For every strip along an edge `∫ (s − d)⁺ dA ≤ W s² / 2`
/// with `d` the distance from the edge and `W` the greatest width parallel to it, so `N² ≤ 2 σ W Σ
/// d_k f_k`: exact on a rectangle bent about one axis. Each entry is `W` and the distances of the
/// corners.
pub fn edge_bounds(face: &Interface) -> Vec<(f64, Vec<f64>)> {
    let corners = Section::new(face).corners;
    edges(&corners)
        .filter_map(|(p, q)| {
            let along = (q - p).try_normalize(0.0)?;
            let inward = P2::new(-along.y, along.x);
            let distances = corners.iter().map(|c| inward.dot(&(c - p)).max(0.0)).collect();
            Some((width(&corners, along, inward), distances))
        })
        .collect()
}

/// What closes of a joint whose corners close at these rates, the least `∫ g⁺ dA`, m³/s, over affine
/// functions `g` nowhere below the rates: the greatest power, over `σ`, of forces at the corners that
/// pressures up to `σ` amount to. Rates of rigid bodies are affine themselves; as they slide and
/// twist, each corner lifts by its own share of friction, and they are not.
pub fn closing_volume(face: &Interface, rates: &[f64]) -> f64 {
    if rates.iter().all(|v| *v <= 0.0) {
        return 0.0;
    }
    let section = Section::new(face);
    let n = rates.len() as f64;
    let (middle, mean) = (section.corners.iter().sum::<P2>() / n, rates.iter().sum::<f64>() / n);
    let (mut spread, mut moment) = (Matrix2::zeros(), P2::zeros());
    for (p, v) in section.corners.iter().zip(rates) {
        spread += (p - middle) * (p - middle).transpose();
        moment += (p - middle) * (v - mean);
    }
    // The least-squares fit, lifted, and then the least of a convex function of the slope: the
    // centroid of where it may be, half of which each subgradient takes away.
    let fit = spread.try_inverse().map_or_else(P2::zeros, |inverse| inverse * moment);
    let mut least = section.lifted(rates, middle, fit);
    let size = rates.iter().map(|v| v.abs()).fold(0.0, f64::max);
    if least.short <= LEAST_LIFT * size {
        return least.volume;
    }
    let stretch = stretch(spread);
    let reach = REACH * n.sqrt() * size;
    let mut region: Vec<P2> = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| P2::new(x, y) * reach)
        .to_vec();
    let mut below = 0.0_f64;
    for _ in 0..MOST_CUTS {
        let at = centroid(&region);
        let there = section.lifted(rates, middle, fit + stretch * at);
        let gradient = stretch * there.gradient;
        let depth = |y: &P2| -gradient.dot(&(y - at));
        let gain = region.iter().map(depth).fold(0.0, f64::max);
        below = below.max(there.volume - gain);
        if there.volume < least.volume {
            least = there;
        }
        region = inside(&region, depth, 0.0);
        if least.volume - below <= NEAR_ENOUGH * least.volume || region.len() < 3 {
            break;
        }
    }
    least.volume
}

/// An affine function of given slope, as low as rates at the corners allow.
struct Lifted {
    /// What it has above the fit at the middle.
    short: f64,
    /// `∫ g⁺ dA`.
    volume: f64,
    /// Of the volume by the slope.
    gradient: P2,
}

/// How much of the strength `sigma`, Pa, the normal forces `normal ≥ 0` at the corners use, and the
/// bound that they come nearest to (or break). At most 1 is admissible. Where a block of pressure
/// centred on the resultant fits, its use is returned without a bound: then the true use is no more
/// than that.
pub fn crushing(face: &Interface, normal: &[f64], sigma: f64) -> (f64, Option<Cut>) {
    let total: f64 = normal.iter().sum();
    if total <= 0.0 {
        return (0.0, None);
    }
    let section = Section::new(face);
    let resultant = section.corners.iter().zip(normal).map(|(p, f)| p * (f / total)).sum::<P2>();
    let centred = section.centred(resultant);
    if total <= sigma * centred {
        return (total / (sigma * centred), None);
    }
    if sigma <= 0.0 {
        return (f64::INFINITY, None);
    }
    let (used, value, slope) = section.worst(total / sigma, resultant);
    let weights = section.corners.iter().map(|p| value + slope.dot(p)).collect();
    (used, Some(Cut { weights, capacity: section.positive(value, slope).1 }))
}

impl Section {
    /// The affine function of this slope that lies as low as it may above the rates at the corners.
    fn lifted(&self, rates: &[f64], middle: P2, slope: P2) -> Lifted {
        let mean = rates.iter().sum::<f64>() / rates.len() as f64;
        let (mut short, mut touched) = (0.0, middle);
        for (p, v) in self.corners.iter().zip(rates) {
            let above = v - mean - slope.dot(&(p - middle));
            if above > short {
                (short, touched) = (above, *p);
            }
        }
        let value = mean + short - slope.dot(&middle);
        let (area, moment) = self.pressed(value, slope);
        let volume = value * area + slope.dot(&moment);
        Lifted { short, volume, gradient: moment - touched * area }
    }

    /// Area of the largest part that is its own mirror image about `r`; 0 where there are several
    /// pieces.
    fn centred(&self, r: P2) -> f64 {
        let [piece] = &self.pieces[..] else { return 0.0 };
        let mirrored: Vec<P2> = piece.iter().map(|p| r * 2.0 - p).collect();
        area(&clip(piece, &mirrored, 0.0))
    }

    /// The bound that a pressure resultant at `r` over at least `area` comes nearest to: its use,
    /// value at the origin and slope. Directions are searched in coordinates in which the section
    /// is as wide as deep, so that slender ones hide nothing.
    fn worst(&self, area: f64, r: P2) -> (f64, f64, P2) {
        let (whole, moment) = self.area_and_moment();
        if area >= whole {
            return (area / whole, 1.0, P2::zeros());
        }
        let c = moment / whole;
        let mut spread = Matrix2::zeros();
        for p in self.pieces.iter().flatten() {
            spread += (p - c) * (p - c).transpose();
        }
        let stretch = stretch(spread);
        let of = |angle: f64| -> (f64, f64, P2) {
            let slope = stretch * P2::new(angle.cos(), angle.sin());
            let value = self.offset(slope, area);
            ((value + slope.dot(&r)) * area / self.positive(value, slope).1, value, slope)
        };
        let step = std::f64::consts::TAU / DIRECTIONS as f64;
        let best = (0..DIRECTIONS)
            .map(|k| k as f64 * step)
            .max_by(|a, b| of(*a).0.total_cmp(&of(*b).0))
            .unwrap_or(0.0);
        let (mut low, mut high) = (best - step, best + step);
        for _ in 0..REFINEMENTS {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if of(a).0 < of(b).0 { low = a } else { high = b }
        }
        of(0.5 * (low + high))
    }

    /// The value at the origin with which `value + slope · x` is positive on `area`.
    fn offset(&self, slope: P2, area: f64) -> f64 {
        let reach = self.pieces.iter().flatten().map(|p| -slope.dot(p));
        let (mut low, mut high) =
            reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        // The area is piecewise quadratic in the value: halving takes it to the last digit.
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            if self.positive(middle, slope).0 < area { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

/// Slopes with which a section of this spread is as wide as deep.
fn stretch(spread: Matrix2<f64>) -> Matrix2<f64> {
    let root = spread.symmetric_eigen();
    let scale = root.eigenvalues.map(|l| 1.0 / l.max(f64::MIN_POSITIVE).sqrt());
    root.eigenvectors * Matrix2::from_diagonal(&scale) * root.eigenvectors.transpose()
}

/// Rates that are affine up to this × the greatest are so by rounding. Larger: looser upper ends of
/// load factors. Smaller: time.
const LEAST_LIFT: f64 = 1e-12;
/// Slopes are sought up to this × √corners × the greatest rate, across a section as wide as deep.
/// Larger: a cut or two more. Smaller: the least is missed, and upper ends are looser.
const REACH: f64 = 8.0;
/// The volume is found to this share of it. Larger: it shows in brackets of load factors. Smaller:
/// rounding.
const NEAR_ENOUGH: f64 = 1e-11;
/// Each cut leaves at most 63 % of the region (Grünbaum 1960): more than enough for that.
const MOST_CUTS: usize = 200;

/// Directions looked at before the best is refined: sections have few corners, and the use is
/// smooth between them.
const DIRECTIONS: usize = 48;
/// Steps of the refinement by thirds: (2/3)⁴⁰ = 1e-7 of a direction, and the use is flat there: its
/// error is the square.
const REFINEMENTS: usize = 40;

/// The greatest width of a convex polygon along a direction; it is reached at the height of a
/// corner.
fn width(corners: &[P2], along: P2, inward: P2) -> f64 {
    let at_height = |h: f64| {
        let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
        for (p, q) in edges(corners) {
            let (a, b) = (inward.dot(&p) - h, inward.dot(&q) - h);
            let mut add = |x: P2| ends = (ends.0.min(along.dot(&x)), ends.1.max(along.dot(&x)));
            if a == 0.0 {
                add(p);
            }
            if a * b < 0.0 {
                add(p + (q - p) * (a / (a - b)));
            }
        }
        ends.1 - ends.0
    };
    corners.iter().map(|p| at_height(inward.dot(p))).fold(0.0, f64::max)
}
