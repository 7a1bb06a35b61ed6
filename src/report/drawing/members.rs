//! Members: lines between their ends, as thick as their force; dashed where they carry nothing.

use super::{
    legend::{Glyph, Legend},
    projection::Projection,
    road,
    sheet::Sheet,
};
use crate::view::{View, ViewMember};
use nalgebra::Vector3;

/// The look of members; only drawings with members have it.
pub const STYLE: &str = ".member{fill:none;stroke:#7a2a8c;stroke-linecap:round;stroke-linejoin:round}\
path.push{stroke:#7a2a8c;fill:#7a2a8c;stroke-width:1.8}.slack{stroke-dasharray:4 4}\
@media (prefers-color-scheme:dark){.member,path.push{stroke:#d79be6}path.push{fill:#d79be6}}";

/// Thickness where next to no force passes, and of the greatest, units of the sheet.
const THICKNESS: [f64; 2] = [1.2, 4.2];
/// Length of the arrow of a push, units of the sheet.
const ARROW: f64 = 30.0;

/// Draws them.
pub fn draw(sheet: &mut Sheet, view: &View, paper: &Projection, legend: &mut Legend) {
    let list = || view.members.iter().filter(|m| !road::covers(view, paper, m));
    let greatest = view.members.iter().filter_map(|m| m.force).map(f64::abs).fold(0.0, f64::max);
    for member in list() {
        let share = |force: f64| if greatest > 0.0 { force.abs() / greatest } else { 0.0 };
        let slack = member.slack;
        let width = THICKNESS[0]
            + (THICKNESS[1] - THICKNESS[0]) * member.force.filter(|_| !slack).map_or(0.0, share);
        let class = if slack { "member slack" } else { "member" };
        match (&member.points[..], member.direction) {
            ([at], Some(direction)) => arrow(sheet, paper, at, &direction, member),
            ([at], None) => {
                let [x, y] = paper.at(at);
                sheet.put(format_args!(
                    "<path class=\"{class}\" stroke-width=\"{width:.2}\" d=\"M{:.2} {:.2}l8 8m0 -8l-8 8\"/>\n",
                    x - 4.0,
                    y - 4.0
                ));
            }
            (points, _) => {
                let mut path = String::new();
                for (k, p) in points.iter().enumerate() {
                    let [x, y] = paper.at(p);
                    path.push_str(&format!("{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' }));
                }
                sheet.put(format_args!(
                    "<path class=\"{class}\" stroke-width=\"{width:.2}\" d=\"{path}\"/>\n"
                ));
            }
        }
    }
    if list().next().is_some() {
        let words = "tie, strut, soil or other member (width: force; dashed: slack)";
        legend.add(Glyph::Line("member"), words);
    }
}

fn arrow(
    sheet: &mut Sheet,
    paper: &Projection,
    at: &Vector3<f64>,
    direction: &Vector3<f64>,
    member: &ViewMember,
) {
    let class = if member.slack { "push slack" } else { "push" };
    let [from, to] = paper.arrow(at, direction, ARROW);
    sheet.arrow(class, from, to);
}
