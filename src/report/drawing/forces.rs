//! The line of thrust: through every block from one centre of pressure to the other, or to the
//! centre of mass where more than two joints press; as thick as the force that passes. In walls and
//! heaps it shows the chains of forces.

use super::{
    MANY,
    legend::{Glyph, Legend},
    projection::Projection,
    sheet::Sheet,
};
use crate::view::ViewState;
use base::tolerance;
use std::fmt::Write;

/// Thickness of the line where no force passes, and of the greatest force, units of the sheet.
const THICKNESS: [f64; 2] = [0.4, 4.2];
/// So many thicknesses are told apart.
const STEPS: usize = 12;
/// Forces below this × the greatest are left out. Larger: chains lose their ends. Smaller: what the
/// solver leaves in joints that are open (1e-8 of the greatest) is drawn as if it carried.
const LEAST: f64 = 1e-5;

/// Draws the line of thrust.
pub fn line(sheet: &mut Sheet, paper: &Projection, state: &ViewState, class: &str) {
    let greatest = state.line.iter().map(|s| s.force).fold(0.0, f64::max);
    let mut paths = vec![String::new(); STEPS];
    for part in state.line.iter().filter(|s| s.force > LEAST * greatest) {
        let step = ((part.force / greatest * STEPS as f64).ceil() as usize).clamp(1, STEPS) - 1;
        let ([ax, ay], [bx, by]) = (paper.at(&part.from), paper.at(&part.to));
        // Writing to a string cannot fail.
        let _ = write!(paths[step], "M{ax:.2} {ay:.2}L{bx:.2} {by:.2}");
    }
    for (k, path) in paths.iter().enumerate().filter(|(_, p)| !p.is_empty()) {
        let width = THICKNESS[0] + (THICKNESS[1] - THICKNESS[0]) * (k as f64 + 1.0) / STEPS as f64;
        sheet.put(format_args!(
            "<path class=\"line {class}\" stroke-width=\"{width:.2}\" d=\"{path}\"/>\n"
        ));
    }
}

/// Marks joints that press at their edge alone.
pub fn edges(
    sheet: &mut Sheet,
    paper: &Projection,
    state: &ViewState,
    class: &str,
    legend: &mut Legend,
) {
    let pressed = || state.resultants.iter().flatten();
    let greatest = pressed().map(|r| r.normal).fold(0.0, f64::max);
    let list =
        || pressed().filter(|r| r.normal > LEAST * greatest && r.used >= 1.0 - tolerance::AT_EDGE);
    let radius = if list().count() > MANY { 2.6 } else { 4.0 };
    for r in list() {
        let [x, y] = paper.at(&r.at);
        sheet.put(format_args!(
            "<circle class=\"pin {class}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\"/>\n"
        ));
        legend.add(Glyph::Pin("one"), "resultant at the edge");
    }
}
