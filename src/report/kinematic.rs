//! Capacity curves of mechanisms under earthquakes, as tables and charts.

use super::{
    cells::{Cell, Table},
    page::{Axis, Chart, Series},
    plot::CurveError,
    plot::{self, Plot},
};
use base::number::short;
use check::{
    kinematic::{Capacity, States},
    proof::{ResultFile, kinematic::KinematicAnswer, path::PathResult},
    verdict::claim::Claim,
};
use plotters::{
    prelude::{Circle, PathElement, RGBColor, SeriesLabelPosition, TriangleMarker},
    style::Color,
};

fn refused(e: impl std::fmt::Display) -> CurveError {
    CurveError::new(e)
}

fn said(file: &ResultFile) -> Result<&KinematicAnswer, CurveError> {
    file.answer.kinematic().ok_or_else(|| CurveError::new("this is no result of `kinematic`"))
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
pub fn csv(file: &ResultFile) -> Result<String, CurveError> {
    let a = said(file)?;
    let mut table = Table::new();
    let head = [
        "what", "toward_x", "toward_y", "toward_z", "alpha", "lower", "upper", "a", "e_star",
        "mass", "control", "d", "period",
    ];
    table.write_record(head).map_err(refused)?;
    let mut row = |what: &str, toward: [f64; 3], rest: [Option<f64>; 9]| {
        let mut cells: Vec<Cell> = vec![what.into()];
        cells.extend(toward.map(Cell::from));
        cells.extend(rest.map(Cell::from));
        table.write_record(cells).map_err(refused)
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
    table.end().map_err(refused)
}

fn states(s: &States) -> [(f64, f64); 2] {
    [(s.slv.d, s.slv.a), (s.slc.d, s.slc.a)]
}

fn straight(c: &Capacity) -> Vec<(f64, f64)> {
    vec![(0.0, c.a0), (c.d0, 0.0)]
}

/// The curve as a chart of a page.
pub fn page_chart(file: &ResultFile) -> Option<Chart> {
    let a = file.answer.kinematic()?;
    let (list, tied) = (points(file, a), points_with_members(file, a));
    if list.len().max(tied.len()) < 2 {
        return None;
    }
    let ratio = a.numbers.capacity.map(|c| c.d_over_control);
    let hint = |x: f64, y: f64| format!("{} m, {} m/s²", short(x), short(y));
    let series = |name: &str, line: bool, points: Vec<(f64, f64)>| Series {
        name: name.into(),
        line,
        points: points.iter().map(|p| [Some(p.0), Some(p.1)]).collect(),
        hints: points.iter().map(|p| hint(p.0, p.1)).collect(),
        ..Series::default()
    };
    let drawn = |list: &[CurvePoint]| {
        list.iter().map(|p| (ratio.unwrap_or(1.0) * p.way, p.acceleration)).collect()
    };
    let mut all = Vec::new();
    for (name, list) in
        [("exact curve, every point proved", &list), ("the same with members", &tied)]
    {
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
        "way of the control point, m"
    };
    Some(Chart {
        title: "Capacity curve".into(),
        x: Axis::new(x, false),
        y: Axis::new("a = α g / (e* FC), m/s²", false),
        series: all,
        ..Chart::default()
    })
}

const EXACT: RGBColor = plot::BLUE;
const STRAIGHT: RGBColor = plot::RED;
const TIED: RGBColor = plot::GREEN;

/// The curve as SVG: acceleration against equivalent displacement, exact and straight, SLV and SLC.
///
/// # Errors
/// The result holds no curve, or none of two points.
pub fn chart(file: &ResultFile) -> Result<String, CurveError> {
    let a = said(file)?;
    let ratio = a.numbers.capacity.map(|c| c.d_over_control);
    let drawn = |list: Vec<CurvePoint>| -> Vec<(f64, f64)> {
        list.iter().map(|p| (ratio.unwrap_or(1.0) * p.way, p.acceleration)).collect()
    };
    let (exact, tied) = (drawn(points(file, a)), drawn(points_with_members(file, a)));
    let both = || exact.iter().chain(&tied);
    let end = both().map(|p| p.0).fold(0.0, f64::max);
    let high = both().map(|p| p.1).fold(0.0, f64::max);
    if end <= 0.0 || high <= 0.0 {
        return Err(CurveError::new("there are not two points to draw a line through"));
    }
    let x = if ratio.is_some() {
        "equivalent displacement d, m"
    } else {
        "way of the control point, m"
    };
    let plot = Plot {
        name: &file.scene.name,
        axes: [x, "a = α g / (e* FC), m/s²"],
        ends: [0.0..1.03 * end, 0.0..1.06 * high],
        left: 70,
        legend: Some(SeriesLabelPosition::UpperRight),
    };
    plot.svg(|chart| {
        for (name, line, colour) in
            [("exact, every point proved", exact, EXACT), ("with members", tied, TIED)]
        {
            if line.is_empty() {
                continue;
            }
            chart
                .draw_series([PathElement::new(line.clone(), colour.stroke_width(2))])
                .map_err(refused)?
                .label(name)
                .legend(plot::sample(colour));
            chart
                .draw_series(line.into_iter().map(|p| Circle::new(p, 2, colour.filled())))
                .map_err(refused)?;
        }
        if let Some(c) = &a.numbers.capacity {
            chart
                .draw_series([PathElement::new(straight(c), STRAIGHT.stroke_width(1))])
                .map_err(refused)?
                .label("straight line from a0 to d0")
                .legend(plot::sample(STRAIGHT));
            let marks = |s: &States, colour: RGBColor| {
                states(s).map(|p| TriangleMarker::new(p, 6, colour.filled()))
            };
            let all =
                c.exact.iter().flat_map(|s| marks(s, EXACT)).chain(marks(&c.straight, STRAIGHT));
            chart
                .draw_series(all)
                .map_err(refused)?
                .label("SLV at 0.4 d0, SLC at 0.6 d0")
                .legend(|(x, y)| TriangleMarker::new((x + 8, y), 6, EXACT.filled()));
        }
        Ok(())
    })
}
