//! The cross-section of a joint: what stresses on the area that touches amount to at its corners.
//!
//! *Shares.* A uniform stress acts at the corners of the contact's hull as area shares `a_k ≥ 0` with `Σ a_k = A` and
//! `Σ a_k p_k = A × (centroid)`: the generalised barycentric coordinates of the centroid (Wachspress 1975), equal on a rectangle.
//! Resultant force and bending moment are exact; the torsion that corners carry is too large (1.848 × on a square).
//!
//! *Crushing.* Pressures `0 ≤ p ≤ σ` on the area `A` have a resultant `N` with first moment `m` exactly where
//! `α N + β·m ≤ σ ∫ (α + β·x)⁺ dA` for every affine function (the support function of a moment set). On a rectangle bent about
//! one axis this is the compressed block at the edge, `|M| ≤ N t / 2 − N² / (2 σ b)`.

use super::{ContactFrame, Interface};
use crate::plane::{clip::inside, polygon::P2};
use nalgebra::{Matrix2, Vector3};

/// An affine function on the plane of a joint, `value + slope · (x − at)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Where `value` holds, m.
    pub at: Vector3<f64>,
    /// The value there.
    pub value: f64,
    /// Slope along the plane, 1/m.
    pub slope: Vector3<f64>,
}

impl Affine {
    /// The value at a point.
    pub fn at(&self, x: &Vector3<f64>) -> f64 {
        self.value + self.slope.dot(&(x - self.at))
    }
}

/// A bound on the normal forces at the corners that every admissible pressure respects: `Σ g(p_k) f_k ≤ σ ∫ g⁺ dA`.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// `g` at each corner.
    pub weights: Vec<f64>,
    /// `∫ g⁺ dA`, in m² × the unit of `g`.
    pub capacity: f64,
}

impl Interface {
    /// Share of the area at each corner, m².
    pub fn shares(&self) -> Vec<f64> {
        let n = self.points.len();
        if n < 3 || self.area <= 0.0 {
            return vec![0.0; n];
        }
        let region = Region::new(self);
        let corners: Vec<P2> = self.points.iter().map(|p| region.flat(p)).collect();
        coordinates(&corners, region.centroid()).into_iter().map(|w| w * self.area).collect()
    }

    /// Tensile strength that counts, Pa: cohesion and friction end at cohesion / μ.
    pub fn tension(&self) -> f64 {
        let apex = self.law.cohesion / self.law.friction.mu();
        if self.law.friction.mu() == 0.0 || self.law.friction.mu().is_infinite() { self.law.tension } else { self.law.tension.min(apex) }
    }

    /// Rolling arm that counts, m: corners of a face carry couples by themselves.
    pub fn rolling_arm(&self) -> f64 {
        if self.points.len() < 3 { self.law.rolling_arm } else { 0.0 }
    }

    /// Whether the joint can crush: it has a compressive strength and an area. Edges and points have no stress to speak of.
    pub fn crushes(&self) -> bool {
        self.law.compression.is_finite() && self.points.len() > 2 && self.area > 0.0
    }

    /// Force of the water in the joint on block `b` at each corner, N; its opposite acts on `a`. Empty where there is no water.
    pub fn uplift(&self) -> Vec<Vector3<f64>> {
        if self.law.pore_pressure == 0.0 {
            return Vec::new();
        }
        self.shares().into_iter().map(|a| self.frame.n * (a * self.law.pore_pressure)).collect()
    }

    /// `∫ g⁺ dA` over the area that touches.
    pub fn integral_of_positive_part(&self, g: &Affine) -> f64 {
        let region = Region::new(self);
        region.positive(region.value(g), region.slope(g)).1
    }

    /// The bounds along the edges of the hull. For every strip along an edge `∫ (s − d)⁺ dA ≤ W s² / 2` with `d` the distance from
    /// the edge and `W` the greatest width parallel to it, so `N² ≤ 2 σ W Σ d_k f_k`: exact on a rectangle bent about one axis.
    /// Each entry is `W` and the distances of the corners.
    pub fn edge_bounds(&self) -> Vec<(f64, Vec<f64>)> {
        let region = Region::new(self);
        let corners: Vec<P2> = self.points.iter().map(|p| region.flat(p)).collect();
        (0..corners.len())
            .filter_map(|k| {
                let edge = corners[(k + 1) % corners.len()] - corners[k];
                let along = edge.try_normalize(0.0)?;
                let inward = P2::new(-along.y, along.x);
                let distances = corners.iter().map(|p| inward.dot(&(p - corners[k])).max(0.0)).collect();
                Some((width(&corners, along, inward), distances))
            })
            .collect()
    }

    /// The affine function that is nowhere below `values` at the corners and close to them: their least-squares fit, lifted.
    pub fn lifted(&self, values: &[f64]) -> Affine {
        let region = Region::new(self);
        let corners: Vec<P2> = self.points.iter().map(|p| region.flat(p)).collect();
        let n = corners.len() as f64;
        let (middle, mean) = (corners.iter().sum::<P2>() / n, values.iter().sum::<f64>() / n);
        let (mut spread, mut moment) = (Matrix2::zeros(), P2::zeros());
        for (p, v) in corners.iter().zip(values) {
            spread += (p - middle) * (p - middle).transpose();
            moment += (p - middle) * (v - mean);
        }
        let slope = spread.try_inverse().map_or_else(P2::zeros, |inverse| inverse * moment);
        let short = corners.iter().zip(values).map(|(p, v)| v - mean - slope.dot(&(p - middle))).fold(0.0, f64::max);
        Affine { at: region.lift(middle), value: mean + short, slope: region.frame.t1 * slope.x + region.frame.t2 * slope.y }
    }

    /// How much of the strength `sigma`, Pa, the normal forces `normal ≥ 0` at the corners use, and the bound that they come
    /// nearest to (or break). At most 1 is admissible. Where a block of pressure centred on the resultant fits, its use is
    /// returned without a bound: then the true use is no more than that.
    pub fn crushing(&self, normal: &[f64], sigma: f64) -> (f64, Option<Cut>) {
        let total: f64 = normal.iter().sum();
        if total <= 0.0 {
            return (0.0, None);
        }
        let region = Region::new(self);
        let corners: Vec<P2> = self.points.iter().map(|p| region.flat(p)).collect();
        let resultant = corners.iter().zip(normal).map(|(p, f)| p * (f / total)).sum::<P2>();
        let centred = region.centred(resultant);
        if total <= sigma * centred {
            return (total / (sigma * centred), None);
        }
        if sigma <= 0.0 {
            return (f64::INFINITY, None);
        }
        let (used, value, slope) = region.worst(total / sigma, resultant);
        let weights = corners.iter().map(|p| value + slope.dot(p)).collect();
        (used, Some(Cut { weights, capacity: region.positive(value, slope).1 }))
    }
}

/// The area that touches, as convex polygons in the coordinates `(t1, t2)` of the joint about its first corner.
struct Region {
    origin: Vector3<f64>,
    frame: ContactFrame,
    pieces: Vec<Vec<P2>>,
}

impl Region {
    fn new(face: &Interface) -> Self {
        let (origin, frame) = (face.points[0], face.frame);
        let mut region = Self { origin, frame, pieces: Vec::new() };
        let outlines = if face.pieces.is_empty() { std::slice::from_ref(&face.points) } else { &face.pieces };
        region.pieces = outlines.iter().map(|piece| piece.iter().map(|p| region.flat(p)).collect()).collect();
        for piece in &mut region.pieces {
            if area_and_moment(piece).0 < 0.0 {
                piece.reverse();
            }
        }
        region
    }

    fn flat(&self, p: &Vector3<f64>) -> P2 {
        let d = p - self.origin;
        P2::new(self.frame.t1.dot(&d), self.frame.t2.dot(&d))
    }

    fn lift(&self, p: P2) -> Vector3<f64> {
        self.origin + self.frame.t1 * p.x + self.frame.t2 * p.y
    }

    fn value(&self, g: &Affine) -> f64 {
        g.at(&self.origin)
    }

    fn slope(&self, g: &Affine) -> P2 {
        P2::new(self.frame.t1.dot(&g.slope), self.frame.t2.dot(&g.slope))
    }

    fn centroid(&self) -> P2 {
        let (area, moment) = self.pieces.iter().map(|p| area_and_moment(p)).fold((0.0, P2::zeros()), |a, b| (a.0 + b.0, a.1 + b.1));
        moment / area
    }

    /// Area where `value + slope · x > 0`, and the integral of that there.
    fn positive(&self, value: f64, slope: P2) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        for piece in &self.pieces {
            let kept = inside(piece, |p| value + slope.dot(p), 0.0);
            let (area, moment) = area_and_moment(&kept);
            sum = (sum.0 + area, sum.1 + value * area + slope.dot(&moment));
        }
        sum
    }

    /// Area of the largest part that is its own mirror image about `r`; 0 where there are several pieces.
    fn centred(&self, r: P2) -> f64 {
        let [piece] = &self.pieces[..] else { return 0.0 };
        let mirrored: Vec<P2> = piece.iter().map(|p| r * 2.0 - p).collect();
        let mut kept = piece.clone();
        for k in 0..mirrored.len() {
            let (p, q) = (mirrored[k], mirrored[(k + 1) % mirrored.len()]);
            let inward = P2::new(p.y - q.y, q.x - p.x);
            kept = inside(&kept, |x| inward.dot(&(x - p)), 0.0);
        }
        area_and_moment(&kept).0
    }

    /// The bound that a pressure resultant at `r` over at least `area` comes nearest to: its use, value at the origin and slope.
    /// Directions are searched in coordinates in which the section is as wide as deep, so that slender ones hide nothing.
    fn worst(&self, area: f64, r: P2) -> (f64, f64, P2) {
        let whole = self.positive(1.0, P2::zeros()).0;
        if area >= whole {
            return (area / whole, 1.0, P2::zeros());
        }
        let c = self.centroid();
        let mut spread = Matrix2::zeros();
        for p in self.pieces.iter().flatten() {
            spread += (p - c) * (p - c).transpose();
        }
        let root = spread.symmetric_eigen();
        let stretch = root.eigenvectors * Matrix2::from_diagonal(&root.eigenvalues.map(|l| 1.0 / l.max(f64::MIN_POSITIVE).sqrt()));
        let of = |angle: f64| -> (f64, f64, P2) {
            let slope = stretch * P2::new(angle.cos(), angle.sin());
            let value = self.offset(slope, area);
            ((value + slope.dot(&r)) * area / self.positive(value, slope).1, value, slope)
        };
        let step = std::f64::consts::TAU / DIRECTIONS as f64;
        let best = (0..DIRECTIONS).map(|k| k as f64 * step).max_by(|a, b| of(*a).0.total_cmp(&of(*b).0)).unwrap_or(0.0);
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
        let (mut low, mut high) = reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        // The area is piecewise quadratic in the value: halving takes it to the last digit.
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            if self.positive(middle, slope).0 < area { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

/// Directions looked at before the best is refined: sections have few corners, and the use is smooth between them.
const DIRECTIONS: usize = 48;
/// Steps of the refinement by thirds: (2/3)⁴⁰ = 1e-7 of a direction, and the use is flat there: its error is the square.
const REFINEMENTS: usize = 40;

/// Signed area and first moment about the origin.
fn area_and_moment(polygon: &[P2]) -> (f64, P2) {
    let Some(&o) = polygon.first() else { return (0.0, P2::zeros()) };
    let (mut area, mut moment) = (0.0, P2::zeros());
    for pair in polygon.windows(2).skip(1) {
        let twice = (pair[0] - o).perp(&(pair[1] - o));
        area += 0.5 * twice;
        moment += (o + pair[0] + pair[1]) * (twice / 6.0);
    }
    (area, moment)
}

/// The greatest width of a convex polygon along a direction; it is reached at the height of a corner.
fn width(corners: &[P2], along: P2, inward: P2) -> f64 {
    let n = corners.len();
    let at_height = |h: f64| {
        let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
        for k in 0..n {
            let (p, q) = (corners[k], corners[(k + 1) % n]);
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

/// Barycentric coordinates of an inner point of a convex polygon (Wachspress 1975): positive, sum 1, exact for affine functions.
fn coordinates(corners: &[P2], x: P2) -> Vec<f64> {
    let n = corners.len();
    let twice = |p: P2, q: P2, r: P2| (q - p).perp(&(r - p)).abs();
    let weights: Vec<f64> = (0..n)
        .map(|k| {
            let (before, here, after) = (corners[(k + n - 1) % n], corners[k], corners[(k + 1) % n]);
            // The product over the other edges instead of the quotient by these two: no division near an edge.
            let others: f64 = (0..n).filter(|&e| e != k && (e + 1) % n != k).map(|e| twice(corners[e], corners[(e + 1) % n], x)).product();
            twice(before, here, after) * others
        })
        .collect();
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|w| w / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        assembly::JointLaw,
        interface::{ContactFrame, ContactKind},
        scene::Friction,
    };
    use proptest::prelude::*;

    fn face(points: &[[f64; 2]]) -> Interface {
        let points: Vec<Vector3<f64>> = points.iter().map(|p| Vector3::new(p[0], p[1], 2.0)).collect();
        let frame = ContactFrame::around(Vector3::z());
        let law = JointLaw::dry(Friction::Coefficient(0.5));
        let mut face =
            Interface { a: 0, b: 1, kind: ContactKind::Face, frame, points, area: 0.0, patches: 1, pieces: Vec::new(), gap: 0.0, law };
        face.area = Region::new(&face).positive(1.0, P2::zeros()).0;
        face
    }

    fn rectangle(b: f64, t: f64) -> Interface {
        face(&[[0.0, 0.0], [b, 0.0], [b, t], [0.0, t]])
    }

    #[test]
    fn shares_of_a_rectangle_are_quarters() {
        assert!(rectangle(2.0, 3.0).shares().iter().all(|a| (a - 1.5).abs() < 1e-14));
    }

    #[test]
    fn a_rectangle_bent_about_one_axis_carries_the_block_at_its_edge() {
        let (b, t, sigma) = (0.5, 2.0, 3.0);
        let face = rectangle(b, t);
        // Resultant at y: the block is 2 y deep, N = 2 y b σ.
        for y in [0.05, 0.3, 0.9] {
            let n = 2.0 * y * b * sigma;
            let [low, high] = [n * (1.0 - y / t) / 2.0, n * y / t / 2.0];
            let forces = |by: f64| [low * by, low * by, high * by, high * by];
            assert!(face.crushing(&forces(1.0 - 1e-9), sigma).0 < 1.0);
            let (used, cut) = face.crushing(&forces(1.01), sigma);
            let cut = cut.unwrap();
            let at = |by: f64| cut.weights.iter().zip(forces(by)).map(|(w, f)| w * f).sum::<f64>() / (sigma * cut.capacity);
            assert!(used > 1.0 && at(1.01) > 1.0 && at(0.98) < 1.0, "{used}");
        }
    }

    #[test]
    fn a_corner_carries_a_triangle() {
        // Resultant at (c, c) near the corner of a unit square: the triangle with legs 3 c has its centroid there.
        let (face, sigma, c) = (rectangle(1.0, 1.0), 10.0, 0.1);
        let n = sigma * 4.5 * c * c;
        let at = |by: f64| [(1.0 - c) * (1.0 - c), c * (1.0 - c), c * c, c * (1.0 - c)].map(|w| w * n * by);
        assert!(face.crushing(&at(1.0 - 1e-6), sigma).0 < 1.0);
        assert!((face.crushing(&at(1.0), sigma).0 - 1.0).abs() < 1e-9);
        assert!(face.crushing(&at(1.0 + 1e-6), sigma).0 > 1.0);
        // The strips along the edges alone would allow far more: 2 σ c.
        assert!(n < 0.25 * 2.0 * sigma * c);
    }

    #[test]
    fn holes_do_not_carry() {
        let mut face = rectangle(3.0, 1.0);
        face.pieces = [0.0, 2.0]
            .map(|x| [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]].map(|p| Vector3::new(p[0], p[1], 2.0)).to_vec())
            .to_vec();
        face.area = 2.0;
        assert!((face.crushing(&[0.5; 4], 1.0).0 - 1.0).abs() < 1e-9);
        assert!(face.crushing(&[0.51; 4], 1.0).0 > 1.0);
    }

    fn polygon() -> impl Strategy<Value = Interface> {
        prop::collection::vec((0.5f64..1.0, 0.0f64..1.0), 3..8).prop_map(|rays| {
            let n = rays.len() as f64;
            // Corners on an ellipse at separate angles: always convex.
            let corner = |(k, (_, turn)): (usize, &(f64, f64))| {
                let angle = (k as f64 + 0.8 * turn) / n * std::f64::consts::TAU;
                [3.0 * angle.cos(), angle.sin()]
            };
            face(&rays.iter().enumerate().map(corner).collect::<Vec<_>>())
        })
    }

    proptest! {
        #[test]
        fn shares_have_the_area_and_its_first_moment(face in polygon()) {
            let shares = face.shares();
            let region = Region::new(&face);
            let moment = face.points.iter().zip(&shares).map(|(p, a)| region.flat(p) * *a).sum::<P2>();
            prop_assert!((shares.iter().sum::<f64>() - face.area).abs() < 1e-12);
            prop_assert!((moment - region.centroid() * face.area).norm() < 1e-11);
            prop_assert!(shares.iter().all(|a| *a > 0.0));
        }

        /// Every pressure between 0 and σ passes, and none that passes breaks a bound along an edge.
        #[test]
        fn pressures_within_the_strength_pass(face in polygon(), angle in 0.0f64..6.3, offset in -1.0f64..1.0, level in 0.1f64..1.0) {
            let sigma = 2.0;
            let slope = P2::new(angle.cos(), angle.sin());
            let region = Region::new(&face);
            let value = offset - slope.dot(&region.centroid());
            let mut resultant = (0.0, P2::zeros());
            for piece in &region.pieces {
                let (a, m) = area_and_moment(&inside(piece, |p| value + slope.dot(p), 0.0));
                resultant = (resultant.0 + a, resultant.1 + m);
            }
            prop_assume!(resultant.0 > 1e-3);
            let corners: Vec<P2> = face.points.iter().map(|p| region.flat(p)).collect();
            let total = sigma * level * resultant.0;
            let forces: Vec<f64> = coordinates(&corners, resultant.1 / resultant.0).iter().map(|w| w * total).collect();
            let used = face.crushing(&forces, sigma).0;
            prop_assert!(used <= 1.0 + 1e-9, "used {used}");
            for (width, distances) in face.edge_bounds() {
                let moment: f64 = distances.iter().zip(&forces).map(|(d, f)| d * f).sum();
                prop_assert!(total * total <= 2.0 * sigma * width * moment * (1.0 + 1e-9));
            }
        }

        #[test]
        fn a_half_plane_at_full_strength_is_the_limit(face in polygon(), angle in 0.0f64..6.3, offset in -0.5f64..0.5) {
            let slope = P2::new(angle.cos(), angle.sin());
            let region = Region::new(&face);
            let value = offset - slope.dot(&region.centroid());
            let mut resultant = (0.0, P2::zeros());
            for piece in &region.pieces {
                let (a, m) = area_and_moment(&inside(piece, |p| value + slope.dot(p), 0.0));
                resultant = (resultant.0 + a, resultant.1 + m);
            }
            prop_assume!(resultant.0 > 1e-2 && resultant.0 < 0.99 * face.area);
            let corners: Vec<P2> = face.points.iter().map(|p| region.flat(p)).collect();
            let forces: Vec<f64> = coordinates(&corners, resultant.1 / resultant.0).iter().map(|w| w * resultant.0).collect();
            prop_assert!((face.crushing(&forces, 1.0).0 - 1.0).abs() < 1e-6);
            prop_assert!(face.crushing(&forces, 0.999).0 > 1.0);
        }
    }
}
