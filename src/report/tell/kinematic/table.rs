//! Capacity curves of mechanisms under earthquakes, as tables and charts.

use crate::{
    ReportError,
    cells::{Cell, Table},
    chart::{Axis, Chart, Series},
};
use base::number::short;
use check::{
    kinematic::{Capacity, States},
    proof::{ResultFile, kinematic::KinematicAnswer, path::PathResult},
    verdict::claim::Claim,
};

fn said(file: &ResultFile) -> Result<&KinematicAnswer, ReportError> {
    file.answer.kinematic().ok_or_else(|| ReportError::new("this is not a result of `kinematic`"))
}

/// A point of the curve: way of the control point, m, acceleration, m/s², load factor with its
/// ends.
struct CurvePoint {
    way: f64,
    acceleration: f64,
    factor: [f64; 3],
}

/// Of the curve from which limit states are read.
fn points(file: &ResultFile, a: &KinematicAnswer) -> Vec<CurvePoint> {
    points_of(file, a, file.path.as_ref())
}

/// Of the curve with members, as long as they hold.
fn points_with_members(file: &ResultFile, a: &KinematicAnswer) -> Vec<CurvePoint> {
    points_of(file, a, file.path_with_members.as_ref())
}

fn points_of(file: &ResultFile, a: &KinematicAnswer, path: Option<&PathResult>) -> Vec<CurvePoint> {
    let gravity = file.scene.input.gravity.iter().map(|c| c * c).sum::<f64>().sqrt();
    let (Some(path), Some(p)) = (path, &a.numbers.participation) else { return Vec::new() };
    let point = |point: &check::proof::path::PathPoint| match point.certificate.claim {
        Some(Claim::LoadFactor { value, lower, upper }) => Some(CurvePoint {
            way: point.value,
            acceleration: p.acceleration(value, gravity, a.fc),
            factor: [value, lower, upper],
        }),
        _ => None,
    };
    path.points.iter().filter_map(point).collect()
}

/// Directions and points of the curve, a row each: what it is, the direction, α0 or the load factor
/// of the point with its ends, a0 or a (m/s²), e*, M* (kg), the way of the control point and the
/// equivalent displacement (m), the secant period of limit states (s).
///
/// # Errors
/// The result is of another question.
pub fn csv(file: &ResultFile) -> Result<String, ReportError> {
    let a = said(file)?;
    let mut table = Table::new();
    let head = [
        "what", "toward_x", "toward_y", "toward_z", "alpha", "lower", "upper", "a", "e_star",
        "mass", "control", "d", "period",
    ];
    table.write_record(head)?;
    let mut row = |what: &str, toward: [f64; 3], rest: [Option<f64>; 9]| {
        let mut cells: Vec<Cell> = vec![what.into()];
        cells.extend(toward.map(Cell::from));
        cells.extend(rest.map(Cell::from));
        table.write_record(cells)
    };
    let main = [&file.answer];
    let listed: Vec<_> = file.directions.iter().map(|d| &d.answer).collect();
    let list = if listed.is_empty() { &main[..] } else { &listed[..] };
    for k in list.iter().filter_map(|d| d.kinematic()) {
        let (l, p) = (&k.alpha0, &k.numbers.participation);
        row(
            "direction",
            k.toward,
            [
                l.value,
                l.lower,
                l.upper,
                k.numbers.a0,
                p.as_ref().map(|p| p.e_star),
                p.as_ref().map(|p| p.mass),
                None,
                None,
                None,
            ],
        )?;
    }
    let ratio = a.numbers.capacity.map(|c| c.d_over_control);
    let own = points(file, a).into_iter().map(|p| ("curve", p));
    let tied = points_with_members(file, a).into_iter().map(|p| ("curve with members", p));
    for (what, p) in own.chain(tied) {
        let [value, lower, upper] = p.factor.map(Some);
        let d = ratio.map(|r| r * p.way);
        row(
            what,
            a.toward,
            [value, lower, upper, Some(p.acceleration), None, None, Some(p.way), d, None],
        )?;
    }
    if let Some(c) = &a.numbers.capacity {
        for (name, s) in c.exact.map(|s| ("exact", s)).into_iter().chain([("straight", c.straight)])
        {
            for (word, s) in [("SLV", s.slv), ("SLC", s.slc)] {
                let way = Some(s.d / c.d_over_control);
                row(
                    &format!("{name} {word}"),
                    a.toward,
                    [None, None, None, Some(s.a), None, None, way, Some(s.d), Some(s.period)],
                )?;
            }
        }
    }
    Ok(table.end()?)
}

fn states(s: &States) -> [(f64, f64); 2] {
    [(s.slv.d, s.slv.a), (s.slc.d, s.slc.a)]
}

fn straight(c: &Capacity) -> Vec<(f64, f64)> {
    vec![(0.0, c.a0), (c.d0, 0.0)]
}

/// The curve as a chart of a page.
pub fn chart(file: &ResultFile) -> Option<Chart> {
    let a = file.answer.kinematic()?;
    let (list, tied) = (points(file, a), points_with_members(file, a));
    if list.len().max(tied.len()) < 2 {
        return None;
    }
    let ratio = a.numbers.capacity.map(|c| c.d_over_control);
    let hint = |x: f64, y: f64| format!("{} m, {} m/s²", short(x), short(y));
    let series = |name: &str, line: bool, points: Vec<(f64, f64)>| Series {
        line,
        ..Series::line(name, &points, hint)
    };
    let drawn = |list: &[CurvePoint]| {
        list.iter().map(|p| (ratio.unwrap_or(1.0) * p.way, p.acceleration)).collect()
    };
    let mut all = Vec::new();
    for (name, list) in [
        ("exact curve, every point proved", &list),
        ("exact curve with members, every point proved", &tied),
    ] {
        if list.len() > 1 {
            all.push(series(name, true, drawn(list)));
        }
    }
    if let Some(c) = &a.numbers.capacity {
        all.push(series("straight line from a0 to d0", true, straight(c)));
        let marks = c.exact.iter().flat_map(states).chain(states(&c.straight)).collect();
        all.push(series("SLV and SLC", false, marks));
    }
    let x = if ratio.is_some() {
        "equivalent displacement d, m"
    } else {
        "displacement of the control point, m"
    };
    Some(Chart {
        title: "Capacity curve".into(),
        x: Axis::new(x, false),
        y: Axis::new("a = α g / (e* FC), m/s²", false),
        series: all,
        ..Chart::default()
    })
}
