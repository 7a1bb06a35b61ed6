//! Interfaces given by hand.

use super::{ContactFrame, ContactKind, Interface, limits::Limits, plane::Plane, polygon};
use crate::assembly::GivenInterface;
use nalgebra::Vector3;

/// The interface somebody gave: its points as they are, turned counter-clockwise around the normal,
/// repeated points left out.
pub(super) fn interface(given: &GivenInterface, limits: &Limits) -> Interface {
    let mut points: Vec<Vector3<f64>> = Vec::with_capacity(given.points.len());
    for p in &given.points {
        if !points.iter().any(|q| (p - q).norm() <= limits.weld) {
            points.push(*p);
        }
    }
    let center = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let plane = Plane::new(center, given.normal);
    let flat: Vec<_> = points.iter().map(|&p| plane.flat(p)).collect();
    let area = polygon::area(&flat);
    if area < 0.0 {
        points.reverse();
    }
    let frame = match points[..] {
        [p, q] => ContactFrame::along(given.normal, q - p),
        _ => plane.frame,
    };
    Interface {
        a: given.a,
        b: given.b,
        kind: ContactKind::Given,
        frame,
        points,
        area: area.abs(),
        patches: 1,
        pieces: Vec::new(),
        ways: Vec::new(),
        gap: 0.0,
        law: given.law,
    }
}
