//! What the supports bear.

use super::{Part, Section, joints::ROUNDING, joints::told, listed, quantity};
use crate::view::{View, ViewState};
use nalgebra::Vector3;

/// Supports that are listed.
const MOST: usize = 16;

/// A table for each system of forces that is told.
pub(super) fn sections(view: &View) -> Vec<Section> {
    let parts: Vec<Part> = told(view).into_iter().filter_map(|s| table(view, s)).collect();
    if parts.is_empty() { Vec::new() } else { vec![Section::new("Reactions", parts)] }
}

/// The force of each support on what it holds, through its joints.
fn table(view: &View, state: &ViewState) -> Option<Part> {
    let mut sums: Vec<(usize, Vector3<f64>)> = Vec::new();
    for (joint, at) in view.joints.iter().zip(&state.resultants) {
        let (Some(at), [a, b]) = (at, [joint.a, joint.b]) else { continue };
        let (support, force) = match [a, b].map(|k| view.bodies[k].support) {
            [true, false] => (a, at.force),
            [false, true] => (b, -at.force),
            _ => continue,
        };
        match sums.iter_mut().find(|(k, _)| *k == support) {
            Some((_, sum)) => *sum += force,
            None => sums.push((support, force)),
        }
    }
    sums.sort_by_key(|(k, _)| *k);
    let row = |(k, force): &(usize, Vector3<f64>)| {
        let size = force.norm();
        let part = |v: &f64| if v.abs() > ROUNDING * size { *v } else { 0.0 };
        let mut cells = vec![view.bodies[*k].id.clone()];
        cells.extend(force.iter().map(|v| quantity(part(v), "N")));
        cells.push(quantity(size, "N"));
        cells
    };
    let note = format!(
        "For {}. Force of the support on the structure through its joints; members that are held by \
         supports are not in it.",
        state.name
    );
    let columns = ["reaction of", "#along x", "#along y", "#along z", "#resultant"];
    let rows: Vec<Vec<String>> = sums.iter().map(row).collect();
    (!rows.is_empty()).then(|| Part::table(&columns, listed(rows, MOST), &note))
}
