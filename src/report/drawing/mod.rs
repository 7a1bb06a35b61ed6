//! Drawings of structures (SVG 1.1) for papers and pages: blocks, joints, the line of thrust or the
//! chains of forces, hinges and slides, the mechanism. Legible on light and dark pages; programs
//! that know no dark pages draw the light one.
//!
//! Plane scenes are seen along the normal of their plane, others from a corner above ([`Aspect`]).
//! Forces and motion stand in panels of their own: a line of thrust belongs to the blocks where
//! they are, a mechanism to where they go.

mod aspect;
mod blocks;
mod body;
mod choice;
mod dimensions;
mod forces;
mod hull;
mod legend;
mod marks;
mod members;
mod order;
mod pressure;
mod projection;
mod road;
mod sheet;
mod sizes;
mod slope;

pub use aspect::Aspect;
pub(super) use choice::sized;
use sizes::{LINE, MANY, MARGIN, WIDTH};

use super::view::View;
use base::plain::markup;
use choice::{Choice, Movement};
use legend::{Glyph, Legend};
use nalgebra::Vector3;
use projection::Projection;
use sheet::Sheet;

/// Greatest height of a panel.
const TALL: f64 = 900.0;

/// Height of all panels of a drawing on a page that says more.
const LOW: f64 = 380.0;

/// Panels of structures flatter than this stand below each other.
const FLAT: f64 = 0.6;

/// Whether everything happens in a plane, and the direction from which one looks at it.
pub fn plane(view: &View) -> Option<Vector3<f64>> {
    let axes = Aspect::Auto.axes(view, Choice::of(view).movement.as_ref());
    (axes.level && !view.bodies.is_empty()).then_some(axes.eye)
}

/// Draws an answer.
pub fn svg(view: &View, aspect: Aspect) -> String {
    draw(view, aspect, "", None, |style| style.to_string())
}

/// Draws an answer for a place inside a page that is printed: on white paper, and what its style
/// says holds for it alone; low enough for a page that says more.
pub fn printed(view: &View, aspect: Aspect) -> String {
    draw(view, aspect, " class=\"sheet\"", Some(LOW), |style| sheet::scoped(style, ".sheet"))
}

fn draw(
    view: &View,
    aspect: Aspect,
    attributes: &str,
    most: Option<f64>,
    styled: impl Fn(&str) -> String,
) -> String {
    let choice = Choice::of(view);
    let still = body::still(view);
    let moved = choice.movement.as_ref().map(|m| (m, m.bodies(view)));
    let axes = aspect.axes(view, choice.movement.as_ref());
    let mut paper =
        Projection::new(view, axes, &still, moved.as_ref().map(|(_, bodies)| &bodies[..]));
    let forces = !choice.states.is_empty() || moved.is_none();
    let both = forces && moved.is_some();
    let width = |columns: f64| (WIDTH - MARGIN * (columns + 1.0)) / columns;
    let (beside, tall) = match most {
        None => (both && paper.aspect() > FLAT, TALL),
        // As they are larger.
        Some(most) => {
            let wide = |columns: f64, tall: f64| width(columns).min(tall / paper.aspect());
            let beside = both && wide(2.0, most) >= wide(1.0, 0.5 * most);
            (beside, if both && !beside { 0.5 * most } else { most })
        }
    };
    paper.fit(width(if beside { 2.0 } else { 1.0 }), tall);

    let mut legend = Legend::default();
    let mut panels = Vec::new();
    if forces {
        panels.push(statics(view, &choice, &paper, &still, &mut legend));
    }
    if let Some((movement, bodies)) = &moved {
        panels.push(kinematics(view, movement, &paper, [&still, bodies], &mut legend));
    }
    let (text, height) = lay_out(&panels, &paper, beside, &legend);
    let mut styles = styled(sheet::STYLE);
    styles.push_str(&styled(&thin(view, &paper)));
    for (there, style) in [
        (!view.members.is_empty(), members::STYLE),
        (view.values.is_some(), sheet::VALUES),
        (paper.glass, sheet::GLASS),
        (view.slope.is_some(), slope::STYLE),
        (!view.roads.is_empty(), road::STYLE),
        (view.is_measured, dimensions::STYLE),
        (!view.pressures.is_empty(), pressure::STYLE),
    ] {
        if there {
            styles.push_str(&styled(style));
        }
    }
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH:.0} {height:.0}\" width=\"{WIDTH:.0}\" height=\"{height:.0}\" role=\"img\"{attributes}>\n<title>{}</title>\n<desc>{}</desc>\n<style>{}</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n",
        markup(&view.name),
        markup(&panels.iter().map(|p| p.caption.as_str()).collect::<Vec<_>>().join("; ")),
        styles
    );
    out.push_str(&text);
    out.push_str("</svg>\n");
    out
}

/// Edges are thinner where blocks are small on the sheet: a wall of thousands would be black.
fn thin(view: &View, paper: &Projection) -> String {
    /// Over the size of a block on the sheet.
    const THIN: f64 = 0.05;
    let mut sizes: Vec<f64> = view.bodies.iter().map(|b| 2.0 * b.radius() * paper.scale).collect();
    sizes.sort_by(f64::total_cmp);
    match sizes.get(sizes.len() / 2).map(|size| THIN * size) {
        Some(edge) if edge < sheet::EDGE => {
            let edge = edge.max(0.1);
            format!(
                ".edge,circle.f1{{stroke-width:{edge:.2}}}.joint{{stroke-width:{:.2}}}",
                1.5 * edge
            )
        }
        _ => String::new(),
    }
}

/// A part of the drawing with its caption.
struct Panel {
    caption: String,
    content: String,
}

/// The blocks where they are, with the forces.
fn statics(
    view: &View,
    choice: &Choice,
    paper: &Projection,
    still: &[body::Solid],
    legend: &mut Legend,
) -> Panel {
    let mut sheet = Sheet::default();
    let order = order::back_to_front(view, still, paper);
    road::draw(&mut sheet, view, paper, legend);
    blocks::draw(&mut sheet, view, paper, still, &order, &|i| view.class(i).0);
    for i in 0..view.bodies.len() {
        let (class, words) = view.class(i);
        if !words.is_empty() && !view.bodies[i].support {
            legend.add(Glyph::Swatch(class), words);
        }
    }
    marks::joints(&mut sheet, view, paper);
    pressure::draw(&mut sheet, view, paper, legend);
    for (class, state) in ["one", "two"].into_iter().zip(&choice.states) {
        forces::line(&mut sheet, paper, state, class);
    }
    let caption = match choice.states[..] {
        [] => String::new(),
        [state] => {
            if !state.line.is_empty() {
                legend.add(Glyph::Line("one"), "line of thrust (width: force)");
            }
            state.name.clone()
        }
        [one, two, ..] => {
            legend.add(Glyph::Line("one"), &one.name);
            legend.add(Glyph::Line("two"), &two.name);
            "lines of thrust (width: force)".into()
        }
    };
    for (class, state) in ["one", "two"].into_iter().zip(&choice.states) {
        forces::edges(&mut sheet, paper, state, class, legend);
    }
    members::draw(&mut sheet, view, paper, legend);
    marks::loads(&mut sheet, view, paper, choice.states.first().copied(), legend);
    road::wheels(&mut sheet, view, paper, legend);
    slope::draw(&mut sheet, view, paper, legend);
    dimensions::draw(&mut sheet, view, paper, still);
    Panel { caption, content: sheet.text }
}

/// The blocks where they go.
fn kinematics(
    view: &View,
    movement: &Movement,
    paper: &Projection,
    [still, moved]: [&[body::Solid]; 2],
    legend: &mut Legend,
) -> Panel {
    let mut sheet = Sheet::default();
    let order = order::back_to_front(view, moved, paper);
    road::draw(&mut sheet, view, paper, legend);
    blocks::draw(&mut sheet, view, paper, moved, &order, &|i| {
        if movement.moves[i] { "moved" } else { "block" }
    });
    blocks::ghosts(
        &mut sheet,
        paper,
        still.iter().enumerate().filter(|(i, _)| movement.moves[*i]).map(|(_, b)| b),
    );
    road::wheels(&mut sheet, view, paper, legend);
    legend.add(Glyph::Swatch("moved"), "moves");
    legend.add(Glyph::Ghost, "initial position");
    marks::mechanism(&mut sheet, view, paper, movement, legend);
    Panel { caption: movement.name.clone(), content: sheet.text }
}

/// Panels with captions, the legend and the scale below. Returns the text and its height.
fn lay_out(panels: &[Panel], paper: &Projection, beside: bool, legend: &Legend) -> (String, f64) {
    let mut sheet = Sheet::default();
    let [w, h] = paper.size();
    let mut bottom = MARGIN;
    for (k, (panel, letter)) in panels.iter().zip(["(a) ", "(b) "]).enumerate() {
        let column = if beside { k as f64 } else { 0.0 };
        let room = (WIDTH - MARGIN) / if beside { 2.0 } else { 1.0 };
        let x = MARGIN + column * room + 0.5 * (room - MARGIN - w);
        let y = if beside || k == 0 { MARGIN } else { bottom + 0.5 * MARGIN };
        sheet.put(format_args!(
            "<svg x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" viewBox=\"0 0 {w:.1} {h:.1}\">\n{}</svg>\n",
            panel.content
        ));
        bottom = y + h;
        if !panel.caption.is_empty() {
            let letter = if panels.len() > 1 { letter } else { "" };
            let x = MARGIN + (column + 0.5) * room - 0.5 * MARGIN;
            sheet.put(format_args!(
                "<text class=\"caption\" x=\"{x:.1}\" y=\"{:.1}\">{letter}{}</text>\n",
                bottom + 0.8 * LINE,
                markup(&panel.caption)
            ));
            bottom += LINE;
        }
    }
    bottom = legend.draw(&mut sheet, bottom + 0.5 * LINE, paper);
    (sheet.text, bottom + 0.5 * MARGIN)
}
