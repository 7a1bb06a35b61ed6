//! What is marked on the blocks: joints, loads, hinges and slides.

use super::{
    MANY,
    body::moved,
    choice::Movement,
    legend::{Glyph, Legend},
    projection::Projection,
    road,
    sheet::Sheet,
};
use crate::view::{JointView, View, ViewLoad, ViewState};
use check::verdict::mechanism::JointMotion as Kind;
use nalgebra::Vector3;
use std::fmt::Write;

/// Loads on more blocks than this are told once in the legend.
const LOADED: usize = 12;
/// Length of an arrow where the fill is thin.
const SHORT: f64 = 9.0;
/// Length of the arrow of the greatest load, and of the least one, units of the sheet.
const ARROW: [f64; 2] = [46.0, 16.0];

/// The outline of every joint.
pub fn joints(sheet: &mut Sheet, view: &View, paper: &Projection) {
    let mut path = String::new();
    for joint in view.joints.iter().filter(|j| j.points.len() > 1) {
        outline(&mut path, joint, |p| paper.at(p), paper);
    }
    if !path.is_empty() {
        let class = if paper.elevation { "joint" } else { "joint far" };
        sheet.put(format_args!("<path class=\"{class}\" d=\"{path}\"/>\n"));
    }
}

/// The outline of a joint; seen from its edge, its longest line alone.
fn outline(
    path: &mut String,
    joint: &JointView,
    at: impl Fn(&Vector3<f64>) -> [f64; 2],
    paper: &Projection,
) {
    let points: Vec<[f64; 2]> = joint.points.iter().map(at).collect();
    // Writing to a string cannot fail.
    if joint.normal.dot(&paper.axes.eye).abs() < 1e-3 {
        let along = joint.normal.cross(&paper.axes.eye);
        let way = |k: &usize| along.dot(&joint.points[*k]);
        let ends = (0..points.len())
            .min_by(|a, b| way(a).total_cmp(&way(b)))
            .zip((0..points.len()).max_by(|a, b| way(a).total_cmp(&way(b))));
        if let Some((a, b)) = ends {
            let _ = write!(
                path,
                "M{:.2} {:.2}L{:.2} {:.2}",
                points[a][0], points[a][1], points[b][0], points[b][1]
            );
        }
        return;
    }
    for (k, [x, y]) in points.iter().enumerate() {
        let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
    }
    path.push('Z');
}

/// Loads beside the weight: arrows on the blocks where they are few, in the legend otherwise.
pub fn loads(
    sheet: &mut Sheet,
    view: &View,
    paper: &Projection,
    state: Option<&ViewState>,
    legend: &mut Legend,
) {
    let live = state.is_some_and(|s| s.live);
    for (of, word) in [(false, "load"), (true, "live load (× λ)")] {
        let list: Vec<&ViewLoad> =
            view.loads.iter().filter(|l| l.live == of && (!l.live || live)).collect();
        let greatest = list.iter().map(|l| l.force.norm()).fold(0.0, f64::max);
        if list.is_empty() || greatest == 0.0 {
            continue;
        }
        if list.len() > LOADED {
            let sum: Vector3<f64> = list.iter().map(|l| l.force).sum();
            let [x, y] = paper.direction(&sum.try_normalize(0.0).unwrap_or_default());
            legend.add(Glyph::Arrow("load", [x, y]), &format!("{word} on {} blocks", list.len()));
            continue;
        }
        for load in &list {
            let length = ARROW[1] + (ARROW[0] - ARROW[1]) * load.force.norm() / greatest;
            // What the fill spreads comes out of it.
            let length = road::depth(view, paper, &load.at)
                .map_or(length, |depth| length.min(depth.max(SHORT)));
            let [from, to] = paper.arrow(&load.at, &load.force.normalize(), length);
            sheet.arrow("load", from, to);
        }
        legend.add(Glyph::Arrow("load", [1.0, 0.0]), word);
    }
    let up = state.map_or(view.up, |s| s.up);
    let tilt = up.angle(&view.ground).to_degrees();
    if tilt > 1e-6 {
        let [x, y] = paper.direction(&-up);
        legend.add(Glyph::Arrow("down", [x, y]), &format!("gravity at a tilt of {tilt:.1}°"));
    }
}

/// Hinges where they go, joints that slide along their length.
pub fn mechanism(
    sheet: &mut Sheet,
    view: &View,
    paper: &Projection,
    movement: &Movement,
    legend: &mut Legend,
) {
    let hinges = movement
        .marks
        .iter()
        .filter(|m| m.kind == Kind::Hinge || m.kind == Kind::HingeAndSlide)
        .count();
    let radius = if hinges > MANY { 2.6 } else { 4.0 };
    // With the block that goes less far: joints that slide open as well.
    let at = |joint: &JointView, p: &Vector3<f64>| {
        let [a, b] =
            [joint.a, joint.b].map(|i| moved(&view.bodies[i], &movement.displacements[i], p));
        paper.at(if (a - p).norm() <= (b - p).norm() { &a } else { &b })
    };
    let mut slides = String::new();
    for mark in
        movement.marks.iter().filter(|m| matches!(m.kind, Kind::Slide | Kind::HingeAndSlide))
    {
        let joint = &view.joints[mark.joint];
        if joint.points.len() > 1 {
            outline(&mut slides, joint, |p| at(joint, p), paper);
        }
    }
    if !slides.is_empty() {
        sheet.put(format_args!("<path class=\"slide act\" d=\"{slides}\"/>\n"));
        legend.add(Glyph::Line("act"), "slides");
    }
    for mark in &movement.marks {
        let [x, y] = at(&view.joints[mark.joint], &mark.at);
        let r = match mark.kind {
            Kind::Hinge | Kind::HingeAndSlide => {
                legend.add(Glyph::Pin("act"), "hinge");
                radius
            }
            Kind::Crush => {
                legend.add(Glyph::Dot("act"), "crushes");
                let s = 0.9 * radius;
                sheet.put(format_args!(
                    "<path class=\"slide act\" d=\"M{:.2} {:.2}l{s:.1} {s:.1}m0 {:.1}l{:.1} {s:.1}\"/>\n",
                    x - 0.5 * s,
                    y - 0.5 * s,
                    -s,
                    -s
                ));
                continue;
            }
            Kind::Slide | Kind::Part => continue,
        };
        sheet.put(format_args!(
            "<circle class=\"pin act\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{r}\"/>\n"
        ));
    }
}
