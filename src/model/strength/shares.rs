//! What a uniform stress on the area that touches amounts to at the corners of the contact's hull.
//!
//! It acts there as area shares `a_k ≥ 0` with `Σ a_k = A` and `Σ a_k p_k = A × (centroid)`: the
//! generalised barycentric coordinates of the centroid (Wachspress 1975), equal on a rectangle.
//! Resultant force and bending moment are exact; the torsion that corners carry is too large (1.848
//! × on a square).

use super::section::Section;
use crate::interface::Interface;
use base::plane::polygon::{P2, cross, edges};
use nalgebra::Vector3;

/// Share of the area at each corner, m²; zero where there is no area.
pub fn shares(face: &Interface) -> Vec<f64> {
    let n = face.points.len();
    if n < 3 || face.area <= 0.0 {
        return vec![0.0; n];
    }
    let section = Section::new(face);
    let (area, moment) = section.area_and_moment();
    coordinates(&section.corners, moment / area).into_iter().map(|w| w * area).collect()
}

/// Force of the water in the joint on block `b` at each corner, N; its opposite acts on `a`. Empty
/// where there is no water.
pub fn uplift(face: &Interface) -> Vec<Vector3<f64>> {
    if face.law.pore_pressure == 0.0 {
        return Vec::new();
    }
    shares(face).into_iter().map(|a| face.frame.n * (a * face.law.pore_pressure)).collect()
}

/// Barycentric coordinates of an inner point of a convex polygon (Wachspress 1975): positive, sum
/// 1, exact for affine functions.
pub(super) fn coordinates(corners: &[P2], x: P2) -> Vec<f64> {
    let n = corners.len();
    let twice: Vec<f64> = edges(corners).map(|(p, q)| cross(p, q, x).abs()).collect();
    // In multiples of their geometric mean: the product of hundreds of small areas underflows.
    let mean = (twice.iter().map(|t| t.max(f64::MIN_POSITIVE).ln()).sum::<f64>() / n as f64).exp();
    let weights: Vec<f64> = (0..n)
        .map(|k| {
            let before = (k + n - 1) % n;
            // The product over the other edges instead of the quotient by these two: no division
            // near an edge.
            let others: f64 =
                (0..n).filter(|&e| e != k && e != before).map(|e| twice[e] / mean).product();
            cross(corners[before], corners[k], corners[(k + 1) % n]).abs() * others
        })
        .collect();
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|w| w / sum).collect()
}
