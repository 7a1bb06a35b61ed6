//! Charts of studies as SVG: error against time on logarithmic axes, and the performance profile.

use plotters::{
    coord::Shift,
    prelude::{
        ChartBuilder, Circle, DrawingArea, IntoDrawingArea, IntoLogRange, PathElement, RGBColor,
        SVGBackend, Text, WHITE,
    },
    style::{Color, IntoFont},
};
use sweep::study::{StudyMethod, StudyPoint, profile};

/// A chart that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[error("no chart: {0}")]
pub struct StudyChartError(String);

const SIZE: (u32, u32) = (920, 420);
/// Room on the right for the legend, pixels: over the drawing it would cover points.
const LEGEND: u32 = 250;
/// Colours that stay apart for people who do not see all of them (Okabe & Ito 2008), and two more.
const COLOURS: [RGBColor; 10] = [
    RGBColor(0, 0, 0),
    RGBColor(0, 114, 178),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(148, 103, 189),
    RGBColor(204, 121, 167),
    RGBColor(120, 120, 120),
    RGBColor(140, 86, 75),
];
/// Errors below this are drawn here: rounding.
const FLOOR: f64 = 1e-15;

fn refused(e: impl std::fmt::Display) -> StudyChartError {
    StudyChartError(e.to_string())
}

/// Error against run time on one scene, a line per method.
///
/// # Errors
/// No point has an error.
pub fn errors(scene: &str, points: &[StudyPoint]) -> Result<String, StudyChartError> {
    let own: Vec<&StudyPoint> =
        points.iter().filter(|p| p.scene == scene && p.error.is_some()).collect();
    let times = own
        .iter()
        .map(|p| p.seconds)
        .fold((f64::INFINITY, 0.0_f64), |(l, h), t| (l.min(t), h.max(t)));
    if own.is_empty() || times.0 <= 0.0 {
        return Err(StudyChartError(format!("no run on {scene} gave a value")));
    }
    let y = |p: &StudyPoint| p.error.unwrap_or(1.0).clamp(FLOOR, 10.0);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(refused)?;
        let mut chart = ChartBuilder::on(&area)
            .margin(12)
            .margin_right(LEGEND)
            .caption(scene, ("sans-serif", 18))
            .x_label_area_size(42)
            .y_label_area_size(70)
            .build_cartesian_2d(
                (0.7 * times.0..1.4 * times.1).log_scale(),
                (FLOOR..10.0).log_scale(),
            )
            .map_err(refused)?;
        chart
            .configure_mesh()
            .label_style(("sans-serif", 14))
            .x_desc("seconds")
            .y_desc("relative error of the load factor")
            .x_label_formatter(&|v| format!("{v:.0e}"))
            .y_label_formatter(&|v| format!("{v:.0e}"))
            .light_line_style(WHITE.mix(0.0))
            .draw()
            .map_err(refused)?;
        let mut names = Vec::new();
        for (k, method) in StudyMethod::ALL.into_iter().enumerate() {
            let mut line: Vec<(f64, f64)> =
                own.iter().filter(|p| p.method == method).map(|p| (p.seconds, y(p))).collect();
            if line.is_empty() {
                continue;
            }
            line.sort_by(|a, b| a.0.total_cmp(&b.0));
            let colour = COLOURS[k % COLOURS.len()];
            chart
                .draw_series([PathElement::new(line.clone(), colour.stroke_width(2))])
                .map_err(refused)?;
            names.push((method.label().to_string(), colour));
            chart
                .draw_series(line.into_iter().map(|p| Circle::new(p, 3, colour.filled())))
                .map_err(refused)?;
        }
        legend(&area, &names)?;
        area.present().map_err(refused)?;
    }
    Ok(text)
}

/// Errors of dots below this are drawn here.
const DOT_FLOOR: f64 = 1e-12;

/// Error against time, a colour for each named series of dots (seconds, relative error).
///
/// # Errors
/// There is no dot.
pub(super) fn dots(
    caption: &str,
    x: &str,
    series: &[(String, Vec<(f64, f64)>)],
) -> Result<String, StudyChartError> {
    let all = || series.iter().flat_map(|s| &s.1).filter(|d| d.0 > 0.0);
    let (low, high) = all().fold((f64::INFINITY, 0.0_f64), |(l, h), d| (l.min(d.0), h.max(d.0)));
    if all().next().is_none() {
        return Err(refused("no method gave a value"));
    }
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(refused)?;
        let mut chart = ChartBuilder::on(&area)
            .margin(12)
            .margin_right(LEGEND)
            .caption(caption, ("sans-serif", 18))
            .x_label_area_size(42)
            .y_label_area_size(70)
            .build_cartesian_2d((0.5 * low..2.0 * high).log_scale(), (DOT_FLOOR..1.0).log_scale())
            .map_err(refused)?;
        chart
            .configure_mesh()
            .label_style(("sans-serif", 14))
            .x_desc(x)
            .y_desc("relative error")
            .x_label_formatter(&|v| format!("{v:.0e}"))
            .y_label_formatter(&|v| format!("{v:.0e}"))
            .light_line_style(WHITE.mix(0.0))
            .draw()
            .map_err(refused)?;
        let mut names = Vec::new();
        for (k, (name, dots)) in series.iter().enumerate() {
            let colour = COLOURS[k % COLOURS.len()];
            let dots = dots.iter().filter(|d| d.0 > 0.0).map(|&(seconds, error)| {
                Circle::new((seconds, error.clamp(DOT_FLOOR, 1.0)), 3, colour.filled())
            });
            chart.draw_series(dots).map_err(refused)?;
            names.push((name.clone(), colour));
        }
        legend(&area, &names)?;
        area.present().map_err(refused)?;
    }
    Ok(text)
}

/// The performance profile: which share of the scenes a method answers to `error` within a multiple
/// of the fastest method's time.
///
/// # Errors
/// There is nothing to draw.
pub fn profiles(points: &[StudyPoint], error: f64) -> Result<String, StudyChartError> {
    let ratios: Vec<f64> = (0..=120).map(|k| 10f64.powf(f64::from(k) / 40.0)).collect();
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(refused)?;
        let mut chart = ChartBuilder::on(&area)
            .margin(12)
            .margin_right(LEGEND)
            .caption(format!("scenes answered to {error:.0e}"), ("sans-serif", 18))
            .x_label_area_size(42)
            .y_label_area_size(60)
            .build_cartesian_2d((1.0..1000.0_f64).log_scale(), 0.0..1.05)
            .map_err(refused)?;
        chart
            .configure_mesh()
            .label_style(("sans-serif", 14))
            .x_desc("time over that of the fastest method")
            .y_desc("share of the scenes")
            .x_label_formatter(&|v| format!("{v:.0}"))
            .light_line_style(WHITE.mix(0.0))
            .draw()
            .map_err(refused)?;
        let mut names = Vec::new();
        for (k, (method, shares)) in profile(points, error, &ratios).into_iter().enumerate() {
            let colour = COLOURS[k % COLOURS.len()];
            let line: Vec<(f64, f64)> = ratios.iter().copied().zip(shares).collect();
            chart.draw_series([PathElement::new(line, colour.stroke_width(2))]).map_err(refused)?;
            names.push((method.label().to_string(), colour));
        }
        legend(&area, &names)?;
        area.present().map_err(refused)?;
    }
    Ok(text)
}

/// Names with their colours, to the right of a chart.
fn legend(
    area: &DrawingArea<SVGBackend, Shift>,
    names: &[(String, RGBColor)],
) -> Result<(), StudyChartError> {
    let left = i32::try_from(SIZE.0 - LEGEND).map_err(refused)? + 20;
    let mut y = 50;
    for (name, colour) in names {
        let font = ("sans-serif", 13).into_font();
        area.draw(&Circle::new((left, y + 6), 4, colour.filled())).map_err(refused)?;
        area.draw(&Text::new(name.clone(), (left + 14, y), font)).map_err(refused)?;
        y += 20;
    }
    Ok(())
}
