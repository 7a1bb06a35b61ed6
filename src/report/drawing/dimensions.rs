//! Dimensions: overall width and height of what is free; span, rise and thickness of the spans of a
//! bridge.

use super::{body::Solid, projection::Projection, sheet::Sheet};
use crate::view::View;
use base::number::short;
use nalgebra::Vector3;

/// The look of dimensions; only drawings with dimensions have it.
pub const STYLE: &str = ".measure{fill:none;stroke:#222222;stroke-width:.9}.size{font-size:12px;text-anchor:middle}\
@media (prefers-color-scheme:dark){.measure{stroke:#e6e6e6}}";

/// From the rim of the panel to the overall dimensions, units of the sheet.
const RIM: f64 = 6.0;
/// Length of a number.
const NUMBER: f64 = 40.0;
/// Half a tick.
const TICK: f64 = 4.0;

/// Draws them; seen at an angle nothing has its length.
pub fn draw(sheet: &mut Sheet, view: &View, paper: &Projection, still: &[Solid]) {
    if !(view.is_measured && paper.elevation) {
        return;
    }
    let axes = paper.axes;
    let ends = [axes.right, axes.up].map(|axis| {
        let free = still.iter().filter(|b| !b.body.support).map(|b| b.reach(&axis));
        free.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], [low, high]| {
            [l.min(low), h.max(high)]
        })
    });
    if ends.iter().flatten().all(|v| v.is_finite()) {
        let [[left, right], [low, high]] = ends;
        let corner = |x: f64, y: f64| paper.at(&(axes.right * x + axes.up * y));
        let ([x0, y0], [x1, y1]) = (corner(left, low), corner(right, high));
        let bottom = paper.size()[1] - RIM;
        line(sheet, [x0, bottom], [x1, bottom], right - left);
        line(sheet, [RIM, y0], [RIM, y1], high - low);
    }
    for [left, right, crown, over] in view.roads.iter().flat_map(|r| &r.openings) {
        let foot = Vector3::new(crown.x, crown.y, left.z);
        for [a, b] in [[left, right], [&foot, crown], [crown, over]] {
            line(sheet, paper.at(a), paper.at(b), (b - a).norm());
        }
    }
}

/// A line with ticks at its ends and its length in m: above a level one, right of an upright one.
fn line(sheet: &mut Sheet, [ax, ay]: [f64; 2], [bx, by]: [f64; 2], length: f64) {
    let [x, y] = [0.5 * (ax + bx), 0.5 * (ay + by)];
    let turned = (by - ay).abs() > (bx - ax).abs();
    let tick = |x: f64, y: f64| {
        format!("M{:.1} {:.1}l{:.1} {:.1}", x - TICK, y + TICK, 2.0 * TICK, -2.0 * TICK)
    };
    // Beside the line; over its end where that has no room for a number.
    let place = if !turned {
        // That of a rise crosses it in the middle.
        format!("x=\"{:.1}\" y=\"{:.1}\"", 0.5 * (ax + x), y - 4.0)
    } else if (by - ay).abs() < NUMBER {
        format!("x=\"{:.1}\" y=\"{:.1}\"", x + 0.7 * NUMBER, ay.min(by) - 3.0)
    } else {
        let x = x + 12.0;
        format!("x=\"{x:.1}\" y=\"{y:.1}\" transform=\"rotate(-90 {x:.1} {y:.1})\"")
    };
    sheet.put(format_args!(
        "<path class=\"measure\" d=\"M{ax:.1} {ay:.1}L{bx:.1} {by:.1}{}{}\"/>\n<text class=\"size\" {place}>{} m</text>\n",
        tick(ax, ay),
        tick(bx, by),
        short(length)
    ));
}
