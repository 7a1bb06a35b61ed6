//! States of joints that yield as tables and charts.

use super::{
    cells::{Cell, Table},
    page::{Axis, Chart, Series},
    plot::CurveError,
    plot::{self, Plot},
};
use base::number::short;
use check::proof::{
    ResultFile,
    state::{CurvePoint, JointAnswer, StateAnswer},
};
use plotters::{
    prelude::{Circle, PathElement, SeriesLabelPosition},
    style::Color,
};

fn refused(e: impl std::fmt::Display) -> CurveError {
    CurveError::new(e)
}

fn said(file: &ResultFile) -> Result<&StateAnswer, CurveError> {
    file.answer.state().ok_or_else(|| CurveError::new("this is no result of one"))
}

/// The curve where there is one, a row a point: load factor, displacement of the control point (m)
/// and rotation of its block (rad). Else the joints under the dead load, a row a joint: blocks, forces
/// (N), greatest pressure (Pa), pressed area (m²), opening, closing, shear displacement and slip (m).
///
/// # Errors
/// The result is of another question.
pub fn csv(file: &ResultFile) -> Result<String, CurveError> {
    let a = said(file)?;
    let mut table = Table::new();
    if a.curve.is_empty() {
        let head = [
            "a",
            "b",
            "normal_force",
            "shear_force",
            "fx",
            "fy",
            "fz",
            "greatest_pressure",
            "pressed_area",
            "opening",
            "closing",
            "shear_displacement",
            "slip",
        ];
        table.write_record(head).map_err(refused)?;
        for j in &a.joints {
            table.write_record(row(j)).map_err(refused)?;
        }
        return table.end().map_err(refused);
    }
    let head = ["load_factor", "dx", "dy", "dz", "rx", "ry", "rz"];
    table.write_record(head).map_err(refused)?;
    for p in &a.curve {
        let mut cells: Vec<Cell> = vec![p.load_factor.into()];
        cells.extend(p.displacement.iter().chain(&p.rotation).map(|&v| Cell::from(v)));
        table.write_record(cells).map_err(refused)?;
    }
    table.end().map_err(refused)
}

fn row(j: &JointAnswer) -> Vec<Cell> {
    let mut cells: Vec<Cell> = j.between.iter().map(|id| Cell::from(id.as_str())).collect();
    cells.extend([j.normal_force, j.shear_force].map(Cell::from));
    cells.extend(j.force.map(Cell::from));
    let rest =
        [j.greatest_pressure, j.pressed_area, j.opening, j.closing, j.shear_displacement, j.slip];
    cells.extend(rest.map(Cell::from));
    cells
}

/// Points of a curve, and the direction along which ways are measured.
type Line = (Vec<(f64, f64)>, [f64; 3]);

/// Load factors against the way of the control point along the direction in which it goes farthest,
/// and that direction.
fn line(curve: &[CurvePoint]) -> Option<Line> {
    let last = curve.last().filter(|_| curve.len() > 1)?;
    let first = &curve[0];
    let way = |p: &CurvePoint| {
        let d: [f64; 3] = std::array::from_fn(|i| p.displacement[i] - first.displacement[i]);
        d
    };
    let end = way(last);
    let length = end.iter().map(|c| c * c).sum::<f64>().sqrt();
    (length > 0.0).then(|| {
        let toward = end.map(|c| c / length);
        let along = |p: &CurvePoint| way(p).iter().zip(&toward).map(|(a, b)| a * b).sum::<f64>();
        // What grows without end would hide all that comes before.
        let top = curve.iter().map(|p| p.load_factor).fold(0.0, f64::max);
        let shown = curve.iter().filter(|p| p.load_factor <= SHOWN * top);
        (shown.map(|p| (along(p), p.load_factor)).collect(), toward)
    })
}

/// A curve is drawn up to this share of its greatest load factor: beyond, ways grow a hundredfold.
const SHOWN: f64 = 0.9;

const X: &str = "way of the control point from the dead load on, m";
const Y: &str = "load factor";

/// The curve as a chart of a page.
pub fn page_chart(file: &ResultFile) -> Option<Chart> {
    let a = file.answer.state()?;
    let (points, _) = line(&a.curve)?;
    let series = Series {
        name: "states".into(),
        line: true,
        hints: points.iter().map(|p| format!("{} m, λ = {}", short(p.0), short(p.1))).collect(),
        points: points.iter().map(|p| [Some(p.0), Some(p.1)]).collect(),
        ..Series::default()
    };
    Some(Chart {
        title: "Load and displacement".into(),
        x: Axis::new(X, false),
        y: Axis::new(Y, false),
        series: vec![series],
        ..Chart::default()
    })
}

/// The curve as SVG: load factor against the way of the control point; states are dots, events upright
/// lines, the proved bound a level one.
///
/// # Errors
/// The result holds no curve, or none of two points.
pub fn chart(file: &ResultFile) -> Result<String, CurveError> {
    let a = said(file)?;
    let Some((points, _)) = line(&a.curve) else {
        return Err(CurveError::new("there are not two points to draw a line through"));
    };
    let end = points.iter().map(|p| p.0).fold(0.0, f64::max);
    let bound = a.load_factor.and_then(|l| l.associative.value);
    let high = points.iter().map(|p| p.1).chain(bound).fold(0.0, f64::max);
    if end <= 0.0 || high <= 0.0 {
        return Err(CurveError::new("there are not two points to draw a line through"));
    }
    let plot = Plot {
        name: &file.scene.name,
        axes: [X, Y],
        ends: [0.0..1.03 * end, 0.0..1.06 * high],
        left: 80,
        legend: Some(SeriesLabelPosition::LowerRight),
    };
    let at_events: Vec<f64> = a
        .events
        .iter()
        .filter_map(|e| points.iter().find(|p| p.1 == e.load_factor).map(|p| p.0))
        .collect();
    plot.svg(|chart| {
        let grey = plotters::style::RGBColor(120, 120, 120).stroke_width(1);
        let upright = |x: &f64| PathElement::new(vec![(*x, 0.0), (*x, 1.06 * high)], grey);
        if !at_events.is_empty() {
            chart
                .draw_series(at_events.iter().map(upright))
                .map_err(refused)?
                .label("a joint opens or slides, a member goes slack or yields")
                .legend(plot::sample(plotters::style::RGBColor(120, 120, 120)));
        }
        if let Some(bound) = bound {
            chart
                .draw_series([PathElement::new(
                    vec![(0.0, bound), (1.03 * end, bound)],
                    plot::RED.stroke_width(1),
                )])
                .map_err(refused)?
                .label("proved bound by limit analysis")
                .legend(plot::sample(plot::RED));
        }
        chart
            .draw_series([PathElement::new(points.clone(), plot::BLUE.stroke_width(2))])
            .map_err(refused)?
            .label("states with stiffness")
            .legend(plot::sample(plot::BLUE));
        chart
            .draw_series(points.into_iter().map(|p| Circle::new(p, 2, plot::BLUE.filled())))
            .map_err(refused)?;
        Ok(())
    })
}
