//! The plane kernel for the fuzzer, which is outside the crate. Not there in any other build.

use super::{clip as clipping, polygon};
use nalgebra::Vector2;

fn points(list: &[[f64; 2]]) -> Vec<Vector2<f64>> {
    list.iter().map(|&p| p.into()).collect()
}

fn pairs(list: Vec<Vector2<f64>>) -> Vec<[f64; 2]> {
    list.into_iter().map(Into::into).collect()
}

/// The convex hull, counter-clockwise.
pub fn hull(list: &[[f64; 2]], tol: f64) -> Vec<[f64; 2]> {
    pairs(polygon::hull(&points(list), tol))
}

/// The part of one convex polygon inside another.
pub fn clip(subject: &[[f64; 2]], clip: &[[f64; 2]], tol: f64) -> Vec<[f64; 2]> {
    pairs(clipping::clip(&points(subject), &points(clip), tol))
}

/// The signed area.
pub fn area(polygon: &[[f64; 2]]) -> f64 {
    polygon::area(&points(polygon))
}
