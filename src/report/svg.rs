//! Drawings of structures (SVG 1.1), legible on light and dark pages.

use crate::{
    analysis::{
        Model, Outcome,
        thrust::{Thrust, ThrustEnd},
    },
    assembly::{Block, Solid},
    tolerance,
    verdict::section::{SectionForce, sections},
};
use nalgebra::Vector3;
use std::fmt::Write;

/// Width of the drawing, in user units.
const WIDTH: f64 = 800.0;
const MARGIN: f64 = 24.0;
/// Greatest height of a drawing over its width.
const TALL: f64 = 1.5;

const STYLE: &str = "\
.page{fill:#ffffff}.block{fill:#e7e2d8;stroke:#6b6558}.support{fill:#c9c9c9;stroke:#6b6558}.block,.support{stroke-width:1;stroke-linejoin:round}\
.least{stroke:#0b62a8}.greatest{stroke:#b5430c}.line{fill:none;stroke-width:2.5;stroke-linecap:round}.hinge{fill:#ffffff;stroke-width:2}\
text{font:15px sans-serif;fill:#222222}\
@media (prefers-color-scheme:dark){.page{fill:#16181c}.block{fill:#3a3a36;stroke:#a8a294}.support{fill:#55585e;stroke:#a8a294}\
.least{stroke:#6cb8ff}.greatest{stroke:#ff9a5c}.hinge{fill:#16181c}text{fill:#e6e6e6}}";

/// The plane that is looked at: right, up, and towards the eye.
struct View {
    right: Vector3<f64>,
    up: Vector3<f64>,
    eye: Vector3<f64>,
    low: [f64; 2],
    high: [f64; 2],
    scale: f64,
}

impl View {
    /// The thrust lies in the plane that is seen. Towards left or right: as the axes run.
    fn new(model: &Model, direction: Vector3<f64>) -> Self {
        let up = -model.assembly.gravity.normalize();
        let right = if direction.iter().sum::<f64>() < 0.0 { -direction } else { direction };
        let mut view = Self { right, up, eye: right.cross(&up), low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2], scale: 1.0 };
        for block in &model.assembly.blocks {
            // A ground slab as wide as one likes would leave no room for what stands on it.
            if block.support && model.assembly.free().next().is_some() {
                continue;
            }
            view.include(block);
        }
        let [dx, dy] = [view.high[0] - view.low[0], view.high[1] - view.low[1]];
        // Room for the supports.
        let rim = 0.06 * dx.max(dy);
        for k in 0..2 {
            (view.low[k], view.high[k]) = (view.low[k] - rim, view.high[k] + rim);
        }
        let size = (dx + 2.0 * rim).max((dy + 2.0 * rim) / TALL);
        if size.is_finite() && size > 0.0 {
            view.scale = (WIDTH - 2.0 * MARGIN) / size;
        } else {
            (view.low, view.high) = ([0.0; 2], [1.0; 2]);
        }
        view
    }

    fn include(&mut self, block: &Block) {
        let mut add = |p: &Vector3<f64>, r: f64| {
            for (k, axis) in [self.right, self.up].iter().enumerate() {
                let at = axis.dot(p);
                (self.low[k], self.high[k]) = (self.low[k].min(at - r), self.high[k].max(at + r));
            }
        };
        match &block.solid {
            Solid::Polyhedron(p) => p.vertices.iter().for_each(|v| add(v, 0.0)),
            Solid::Sphere { center, radius } => add(center, *radius),
            Solid::Clump { balls, .. } => balls.iter().for_each(|(c, r)| add(c, *r)),
        }
    }

    fn at(&self, p: &Vector3<f64>) -> [f64; 2] {
        [MARGIN + (self.right.dot(p) - self.low[0]) * self.scale, MARGIN + (self.high[1] - self.up.dot(p)) * self.scale]
    }

    fn height(&self) -> f64 {
        2.0 * MARGIN + (self.high[1] - self.low[1]) * self.scale
    }
}

/// The blocks with the lines of the least and the greatest thrust; hinges are marked.
pub fn thrust(model: &Model, thrust: &Thrust) -> String {
    let view = View::new(model, thrust.at.direction.into());
    let legend = 30.0;
    let (width, height) = (WIDTH, view.height() + legend);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\">\n<title>{}</title>\n<style>{STYLE}</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n",
        escape(&format!("{}: thrust on {}", model.assembly.name, model.assembly.blocks[thrust.at.support].id))
    );
    blocks(&mut svg, model, &view);
    let mut at = MARGIN;
    for (k, end) in thrust.ends.iter().flatten().enumerate().filter(|(_, e)| e.outcome == Outcome::Found) {
        let class = ["least", "greatest"][k.min(1)];
        line(&mut svg, model, &view, end, class);
        let y = height - 0.5 * legend;
        let text = format!("{class} thrust {:.6e} N", end.value);
        put(
            &mut svg,
            format_args!(
                "<path class=\"line {class}\" d=\"M{at:.1} {y:.1}h36\"/><text x=\"{:.1}\" y=\"{:.1}\">{text}</text>\n",
                at + 44.0,
                y + 5.0
            ),
        );
        at += 0.5 * (WIDTH - 2.0 * MARGIN);
    }
    svg.push_str("</svg>\n");
    svg
}

fn put(svg: &mut String, text: std::fmt::Arguments) {
    // Writing to a string cannot fail.
    let _ = svg.write_fmt(text);
}

/// The far ones first.
fn blocks(svg: &mut String, model: &Model, view: &View) {
    let mut order: Vec<&Block> = model.assembly.blocks.iter().collect();
    order.sort_by(|a, b| view.eye.dot(&a.centroid).total_cmp(&view.eye.dot(&b.centroid)));
    for block in order {
        let class = if block.support { "support" } else { "block" };
        put(svg, format_args!("<g class=\"{class}\"><title>{}</title>", escape(&block.id)));
        match &block.solid {
            Solid::Sphere { center, radius } => circle(svg, view, center, *radius),
            Solid::Clump { balls, .. } => balls.iter().for_each(|(c, r)| circle(svg, view, c, *r)),
            Solid::Polyhedron(p) => {
                for facet in p.facets.iter().filter(|f| f.normal.dot(&view.eye) > 1e-6) {
                    for piece in &facet.pieces {
                        let corners: Vec<String> = p.points(piece).map(|v| view.at(&v)).map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
                        put(svg, format_args!("<polygon points=\"{}\"/>", corners.join(" ")));
                    }
                }
            }
        }
        svg.push_str("</g>\n");
    }
}

fn circle(svg: &mut String, view: &View, center: &Vector3<f64>, radius: f64) {
    let [x, y] = view.at(center);
    put(svg, format_args!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\"/>", radius * view.scale));
}

/// Through every block from one centre of pressure to the other; where more than two joints press, to the centre of mass.
fn line(svg: &mut String, model: &Model, view: &View, end: &ThrustEnd, class: &str) {
    let list = sections(&model.interfaces, &end.forces);
    let largest = list.iter().map(|s| s.normal).fold(0.0, f64::max);
    let pressed: Vec<&SectionForce> = list.iter().filter(|s| s.normal > 1e-9 * largest).collect();
    let mut joints: Vec<Vec<[f64; 2]>> = vec![Vec::new(); model.assembly.blocks.len()];
    for s in &pressed {
        let face = &model.interfaces.list[s.interface];
        joints[face.a].push(view.at(&s.at));
        joints[face.b].push(view.at(&s.at));
    }
    let mut path = String::new();
    for i in model.assembly.free() {
        match joints[i][..] {
            [[ax, ay], [bx, by]] => put(&mut path, format_args!("M{ax:.2} {ay:.2}L{bx:.2} {by:.2}")),
            _ => {
                let [x, y] = view.at(&model.assembly.blocks[i].centroid);
                joints[i].iter().for_each(|[ax, ay]| put(&mut path, format_args!("M{ax:.2} {ay:.2}L{x:.2} {y:.2}")));
            }
        }
    }
    put(svg, format_args!("<path class=\"line {class}\" d=\"{path}\"/>\n"));
    for s in pressed.iter().filter(|s| s.used >= 1.0 - tolerance::AT_EDGE) {
        let [x, y] = view.at(&s.at);
        put(svg, format_args!("<circle class=\"hinge {class}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4.5\"/>\n"));
    }
}

fn escape(text: &str) -> String {
    let legal = |c: &char| !c.is_control() || matches!(c, '\t' | '\n');
    text.chars().filter(legal).collect::<String>().replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
