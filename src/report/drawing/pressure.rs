//! Pressure in elastic joints: on the pressed part of each its diagram, as high as the pressure.

use super::{
    hull,
    legend::{Glyph, Legend},
    projection::Projection,
    sheet::Sheet,
};
use crate::view::View;
use base::number::short;
use std::fmt::Write;

/// Height of the greatest pressure, units of the sheet.
const HIGH: f64 = 36.0;

/// How diagrams look.
pub const STYLE: &str = "\
.pressure .f1{fill:#0b62a8;fill-opacity:.3;stroke:#0b62a8;stroke-width:.8}.pressure .edge{stroke:none}\
@media (prefers-color-scheme:dark){.pressure .f1{fill:#6cb8ff;stroke:#6cb8ff}}";

/// Draws the diagrams.
pub fn draw(sheet: &mut Sheet, view: &View, paper: &Projection, legend: &mut Legend) {
    let all = || view.pressures.iter().flat_map(|p| &p.pressure);
    let greatest = all().copied().fold(0.0, f64::max);
    if greatest <= 0.0 {
        return;
    }
    let by = HIGH / (greatest * paper.scale);
    let mut path = String::new();
    for patch in &view.pressures {
        let normal = view.joints[patch.joint].normal;
        let top = patch.points.iter().zip(&patch.pressure).map(|(p, v)| p + normal * (v * by));
        let points: Vec<[f64; 2]> =
            patch.points.iter().copied().chain(top).map(|p| paper.at(&p)).collect();
        for (k, [x, y]) in hull::outline(&points).iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
        }
        path.push('Z');
    }
    sheet.put(format_args!("<g class=\"pressure\"><path class=\"f1\" d=\"{path}\"/></g>\n"));
    legend.add(Glyph::Swatch("pressure"), &format!("pressure, up to {} Pa", short(greatest)));
}
