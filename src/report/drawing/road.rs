//! The road of a bridge, the fill as one band, and what stands on it; seen from the side alone.

use super::{
    legend::{Glyph, Legend},
    projection::Projection,
    sheet::Sheet,
};
use crate::view::{View, ViewMember, ViewRoad, WHEEL};
use model::assembly::MemberKind;
use nalgebra::Vector3;
use std::fmt::Write;

/// The look of roads; only drawings with a bridge have it.
pub const STYLE: &str = ".fill .f1{fill:#e9dcb8}.fill .edge{stroke:none}.road{fill:none;stroke:#55524b;stroke-width:1.6}\
.wheel{fill:#ffffff;stroke:#222222;stroke-width:2.2}\
@media (prefers-color-scheme:dark){.fill .f1{fill:#4d442c}.road{stroke:#b0aca3}.wheel{fill:#16181c;stroke:#e6e6e6}}";

/// The least and the greatest radius of a wheel on the sheet.
const LIMITS: [f64; 2] = [3.0, 9.0];

/// Whether one looks across the road.
fn is_seen(paper: &Projection) -> bool {
    paper.elevation && paper.axes.eye.y.abs() > 0.999
}

/// Whether the band of fill stands for this member.
pub fn covers(view: &View, paper: &Projection, member: &ViewMember) -> bool {
    let over = |road: &ViewRoad| {
        let [Some(a), Some(b)] = [road.line.first(), road.line.last()] else { return false };
        member.points.iter().all(|p| a.x <= p.x && p.x <= b.x)
    };
    member.kind == MemberKind::Soil && is_seen(paper) && view.roads.iter().any(over)
}

/// Draws them.
pub fn draw(sheet: &mut Sheet, view: &View, paper: &Projection, legend: &mut Legend) {
    if !is_seen(paper) {
        return;
    }
    for road in &view.roads {
        if !road.line.is_empty() {
            let around = path(paper, road.below.iter().chain(road.line.iter().rev()));
            let line = path(paper, road.line.iter());
            sheet.put(format_args!(
                "<g class=\"fill\"><path class=\"f1\" d=\"{around}Z\"/></g>\n<path class=\"road\" d=\"{line}\"/>\n"
            ));
            let soil = view.members.iter().any(|m| covers(view, paper, m));
            legend.add(
                Glyph::Swatch("fill"),
                if soil { "fill, with its passive pressure" } else { "fill" },
            );
        }
    }
}

/// How far below a road a point lies, on the sheet.
pub fn depth(view: &View, paper: &Projection, p: &Vector3<f64>) -> Option<f64> {
    let over = |road: &ViewRoad| {
        let [a, b] = [road.line.first()?, road.line.last()?];
        let share = (p.x - a.x) / (b.x - a.x);
        (0.0..=1.0).contains(&share).then(|| (a.z + share * (b.z - a.z) - p.z) * paper.scale)
    };
    view.roads.iter().filter(|_| is_seen(paper)).find_map(over)
}

/// Draws what stands on them.
pub fn wheels(sheet: &mut Sheet, view: &View, paper: &Projection, legend: &mut Legend) {
    if !is_seen(paper) {
        return;
    }
    for road in &view.roads {
        let radius = (WHEEL * paper.scale).clamp(LIMITS[0], LIMITS[1]);
        for wheel in &road.wheels {
            let [x, y] = paper.at(&wheel.at);
            sheet.put(format_args!(
                "<circle class=\"wheel\" cx=\"{x:.2}\" cy=\"{:.2}\" r=\"{radius:.1}\"><title>{}</title></circle>\n",
                y - radius,
                wheel.name
            ));
            legend.add(Glyph::Wheel, "axle or load on the road");
        }
    }
}

fn path<'a>(paper: &Projection, points: impl Iterator<Item = &'a Vector3<f64>>) -> String {
    let mut path = String::new();
    for (k, p) in points.enumerate() {
        let [x, y] = paper.at(p);
        // Writing to a string cannot fail.
        let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
    }
    path
}
