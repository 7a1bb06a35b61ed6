//! Two panels: what moves, and the ground below it.

use super::{GroundError, refused};
use base::number::short;
use plotters::{
    prelude::{
        ChartBuilder, DrawingArea, IntoDrawingArea, PathElement, RGBColor, SVGBackend, WHITE,
    },
    style::Color,
};

const SIZE: (u32, u32) = (760, 520);
/// Height of the upper panel.
const UPPER: u32 = 330;
/// Colours that stay apart for people who do not see all of them (Okabe & Ito 2008).
const COLOURS: [RGBColor; 5] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(230, 159, 0),
    RGBColor(204, 121, 167),
];
/// So many points of a line are drawn at most.
const POINTS: usize = 4000;

/// A panel: its axis and its lines.
pub(super) struct Panel<'a> {
    pub y: &'a str,
    pub lines: &'a [Vec<(f64, f64)>],
}

/// A chart of two panels against time, as SVG.
pub(super) fn chart(title: &str, upper: Panel, lower: Panel) -> Result<String, GroundError> {
    let all = || upper.lines.iter().chain(lower.lines).flatten();
    let end = all().map(|p| p.0).fold(0.0, f64::max);
    if end <= 0.0 {
        return Err(GroundError("there are not two points to draw a line through".into()));
    }
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(refused)?;
        let (top, bottom) = area.split_vertically(UPPER);
        panel(&top, Some(title), &upper, end)?;
        panel(&bottom, None, &lower, end)?;
        area.present().map_err(refused)?;
    }
    Ok(text)
}

fn panel(
    area: &DrawingArea<SVGBackend, plotters::coord::Shift>,
    title: Option<&str>,
    panel: &Panel,
    end: f64,
) -> Result<(), GroundError> {
    let values = || panel.lines.iter().flatten().map(|p| p.1);
    let (low, high) = values().fold((0.0_f64, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
    let room = if high > low { 0.06 * (high - low) } else { 1.0 };
    let mut builder = ChartBuilder::on(area);
    builder.margin(10).x_label_area_size(38).y_label_area_size(76);
    if let Some(title) = title {
        builder.caption(base::plain::cell(title), ("sans-serif", 18));
    }
    // What is left of stepping to zero is zero.
    let tick = |v: f64| if v.abs() < 1e-9 * (high - low) { "0".into() } else { short(v) };
    let mut chart =
        builder.build_cartesian_2d(0.0..end, low - room..high + room).map_err(refused)?;
    chart
        .configure_mesh()
        .label_style(("sans-serif", 13))
        .x_desc("time, s")
        .y_desc(panel.y)
        .x_label_formatter(&|v| short(*v))
        .y_label_formatter(&|v| tick(*v))
        .light_line_style(WHITE.mix(0.0))
        .draw()
        .map_err(refused)?;
    for (k, line) in panel.lines.iter().enumerate() {
        let every = line.len().div_ceil(POINTS).max(1);
        let last = line.len().saturating_sub(1);
        let shown = line.iter().enumerate().filter(|(i, _)| i % every == 0 || *i == last);
        let points: Vec<(f64, f64)> = shown.map(|(_, p)| *p).collect();
        let style =
            COLOURS[k % COLOURS.len()].stroke_width(if panel.lines.len() > 5 { 1 } else { 2 });
        chart.draw_series([PathElement::new(points, style)]).map_err(refused)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_is_no_rounding() {
        let line: Vec<(f64, f64)> =
            (0..100).map(|k| (f64::from(k), 0.33 * (0.3 * f64::from(k)).sin() - 0.02)).collect();
        let panel = || Panel { y: "way", lines: std::slice::from_ref(&line) };
        let Ok(svg) = chart("t", panel(), panel()) else { panic!("no chart") };
        assert!(!svg.contains("e-1"), "{svg}");
    }
}
