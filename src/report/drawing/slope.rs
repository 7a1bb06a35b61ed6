//! The surface of a heap, and the straight line through it.

use super::{
    legend::{Glyph, Legend},
    projection::Projection,
    sheet::Sheet,
};
use crate::view::View;
use std::fmt::Write;

/// The look of the surface and its line.
pub const STYLE: &str = ".surface{fill:none;stroke:#222222;stroke-width:2;stroke-linejoin:round}\
.fitted{fill:none;stroke:#a3230b;stroke-width:2.6;stroke-dasharray:9 5;stroke-linecap:round}\
@media (prefers-color-scheme:dark){.surface{stroke:#e6e6e6}.fitted{stroke:#ff7d5c}}";

/// Draws them, with the angle in the legend.
pub fn draw(sheet: &mut Sheet, view: &View, paper: &Projection, legend: &mut Legend) {
    let Some(slope) = &view.slope else { return };
    let mut path = String::new();
    for (k, p) in slope.surface.iter().enumerate() {
        let [x, y] = paper.at(p);
        // Writing to a string cannot fail.
        let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
    }
    let [[ax, ay], [bx, by]] = slope.line.map(|p| paper.at(&p));
    sheet.put(format_args!("<path class=\"surface\" d=\"{path}\"/>\n"));
    sheet.put(format_args!("<path class=\"fitted\" d=\"M{ax:.2} {ay:.2}L{bx:.2} {by:.2}\"/>\n"));
    legend.add(Glyph::Line("surface"), "highest grains, mean of all paths");
    legend.add(
        Glyph::Line("fitted"),
        &format!("straight line through them, {:.1}°", slope.angle_deg),
    );
}
