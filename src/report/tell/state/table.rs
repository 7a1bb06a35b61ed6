//! States of elastic joints as tables and charts.

use crate::{
    ReportError,
    cells::{Cell, Table},
    chart::{Axis, Chart, Series},
};
use base::number::short;
use check::proof::{
    ResultFile,
    state::{CurvePoint, JointAnswer, StateAnswer},
};

fn said(file: &ResultFile) -> Result<&StateAnswer, ReportError> {
    file.answer.state().ok_or_else(|| ReportError::new("this is not a result of `state`"))
}

/// The curve where there is one, a row a point: load factor, displacement of the control point (m)
/// and rotation of its block (rad). Else the joints under the dead load, a row a joint: blocks, forces
/// (N), greatest pressure (Pa), pressed area (m²), opening, closing, shear displacement and slip (m).
///
/// # Errors
/// The result is of another question.
pub fn csv(file: &ResultFile) -> Result<String, ReportError> {
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
        table.write_record(head)?;
        for j in &a.joints {
            table.write_record(row(j))?;
        }
        return Ok(table.end()?);
    }
    let head = ["load_factor", "dx", "dy", "dz", "rx", "ry", "rz"];
    table.write_record(head)?;
    for p in &a.curve {
        let mut cells: Vec<Cell> = vec![p.load_factor.into()];
        cells.extend(p.displacement.iter().chain(&p.rotation).map(|&v| Cell::from(v)));
        table.write_record(cells)?;
    }
    Ok(table.end()?)
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

const X: &str = "displacement of the control point beyond the dead load, m";
const Y: &str = "load factor";

/// The curve as a chart of a page.
pub fn chart(file: &ResultFile) -> Option<Chart> {
    let a = file.answer.state()?;
    let (points, _) = line(&a.curve)?;
    let hint = |x: f64, y: f64| format!("{} m, λ = {}", short(x), short(y));
    let states = Series::line("with elastic joints (computed)", &points, hint);
    // A level line from the first point to the last.
    let ends = points.first().map(|p| p.0).into_iter().chain(points.last().map(|p| p.0));
    let bound = a.load_factor.and_then(|l| l.associative.value).map(|bound| {
        let level: Vec<(f64, f64)> = ends.map(|x| (x, bound)).collect();
        Series::line("bound by limit analysis (proved)", &level, |_, y| format!("λ ≤ {}", short(y)))
    });
    let at = |load_factor: f64| points.iter().find(|p| p.1 == load_factor).map(|p| p.0);
    let chart = Chart {
        title: "Load and displacement".into(),
        x: Axis::new(X, false),
        y: Axis::new(Y, false),
        series: std::iter::once(states).chain(bound).collect(),
        events: a.events.iter().filter_map(|e| at(e.load_factor)).collect(),
        note: "Vertical lines: a joint opens or slides, a member goes slack or yields.".into(),
        ..Chart::default()
    };
    chart.of_two()
}
