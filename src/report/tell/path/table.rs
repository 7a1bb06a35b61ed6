//! Paths as tables and charts: what holds the structure against how far it has moved.

use crate::{
    ReportError,
    cells::{Cell, Table},
    chart::{Axis, Chart, Series},
};
use base::number::short;
use check::{
    proof::{
        ResultFile,
        path::{DrivenBy, PathEvent, PathEventKind, PathPoint, PathResult},
    },
    verdict::claim::Claim,
};

/// The unit of the parameter, in words.
pub fn parameter(path: &PathResult) -> &'static str {
    match path.driven_by {
        DrivenBy::Supports(_) => "share of the imposed movement",
        DrivenBy::Control { .. } => "displacement of the control point, m",
    }
}

/// Of every moving support the name and its force along its own way, N; nothing for one that only
/// turns.
pub fn along(path: &PathResult, point: &PathPoint) -> Vec<(String, f64)> {
    let DrivenBy::Supports(list) = &path.driven_by else { return Vec::new() };
    let component = |way: &[f64; 3], force: &[f64; 3]| {
        let length = way.iter().map(|c| c * c).sum::<f64>().sqrt();
        (length > 0.0).then(|| way.iter().zip(force).map(|(w, f)| w * f).sum::<f64>() / length)
    };
    list.iter()
        .zip(&point.reactions)
        .filter_map(|(m, r)| Some((m.support.clone(), component(&m.way, &r.force)?)))
        .collect()
}

/// The least way of a block up to a point: how far any has come, m.
fn farthest(point: &PathPoint) -> f64 {
    let way = |s: &[f64; 3]| s.iter().map(|c| c * c).sum::<f64>().sqrt();
    point.poses.iter().map(|p| way(&p.shift)).fold(0.0, f64::max)
}

/// The curve, a row a point: parameter, what is proved there, load factor with its bracket, the
/// longest way of a block (m), the force (N) and moment (N·m about its centre of mass) on every
/// support that moves, and the hinges.
///
/// # Errors
/// The result holds no curve.
pub fn csv(file: &ResultFile) -> Result<String, ReportError> {
    let path = file.path.as_ref().ok_or_else(|| ReportError::new("this result holds no path"))?;
    let mut head: Vec<String> =
        ["value", "proved", "load_factor", "lower", "upper", "farthest"].map(String::from).into();
    if let DrivenBy::Supports(list) = &path.driven_by {
        for m in list {
            head.extend(["fx", "fy", "fz", "mx", "my", "mz"].map(|c| format!("{} {c}", m.support)));
        }
    }
    head.push("hinges".into());
    let mut table = Table::new();
    table.write_record(head)?;
    for p in path.points.iter().chain(&path.ends) {
        let (proved, factor) = match p.certificate.claim {
            Some(Claim::Stable) => ("stands", [None; 3]),
            Some(Claim::Unstable) => ("falls", [None; 3]),
            Some(Claim::LoadFactor { upper, .. }) if p.load_factor.is_none() => {
                ("bound", [None, None, Some(upper)])
            }
            Some(Claim::LoadFactor { value, lower, upper }) => {
                ("load factor", [value, lower, upper].map(Some))
            }
            Some(Claim::DryLoadFactor { value }) => {
                ("dry load factor", [Some(value), Some(value), bound(p)])
            }
            _ => ("", [None; 3]),
        };
        let mut row: Vec<Cell> = vec![p.value.into(), proved.into()];
        row.extend(factor.map(Cell::from));
        row.push(farthest(p).into());
        for r in &p.reactions {
            row.extend(r.force.iter().chain(&r.moment).map(|&v| Cell::from(v)));
        }
        let hinges: Vec<String> =
            p.hinges.iter().map(|h| format!("{} | {}", h.between[0], h.between[1])).collect();
        row.push(hinges.join("; ").into());
        table.write_record(row)?;
    }
    Ok(table.end()?)
}

/// What bounds a load factor with dry friction from above, where that was found.
pub fn bound(point: &PathPoint) -> Option<f64> {
    point.most
}

/// What holds the structure, in words with its unit.
pub fn held_by(path: &PathResult) -> &'static str {
    if path.points.iter().any(|p| p.load_factor.is_some()) {
        "load factor"
    } else {
        "reaction along the movement of the support, N"
    }
}

/// That against the parameter, a name and its points each.
pub fn curves(path: &PathResult) -> Vec<(String, Vec<(f64, f64)>)> {
    let mut lines: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for p in &path.points {
        let values = match p.load_factor {
            Some(l) => vec![("load factor".to_string(), l)],
            None => along(path, p),
        };
        for (name, y) in values {
            match lines.iter_mut().find(|l| l.0 == name) {
                Some(line) => line.1.push((p.value, y)),
                None => lines.push((name, vec![(p.value, y)])),
            }
        }
    }
    lines
}

/// An event in words.
pub fn happens(e: &PathEvent) -> String {
    let names = |list: &[[String; 2]]| -> String {
        list.iter().map(|[a, b]| format!("{a} | {b}")).collect::<Vec<_>>().join(", ")
    };
    match e.kind {
        PathEventKind::Opens => format!("{} also opens", names(&e.opens)),
        PathEventKind::Closes => format!("{} closes", names(&e.closes)),
        PathEventKind::Jumps => {
            let closes = if e.closes.is_empty() {
                String::new()
            } else {
                format!(" and {} closes", names(&e.closes))
            };
            format!(
                "{} opens{closes} in a jump of {} m: the motion turns back and continues from another configuration",
                names(&e.opens),
                short(e.jump.unwrap_or(0.0))
            )
        }
        PathEventKind::Falls if !e.yields.is_empty() => {
            format!("it falls as {} can carry no more", e.yields.join(", "))
        }
        PathEventKind::Falls if e.opens.is_empty() && e.slides.is_empty() => {
            "it falls: beyond, no forces inside the friction cones balance it".into()
        }
        PathEventKind::Falls if e.opens.is_empty() => {
            format!("it falls as {} slides", names(&e.slides))
        }
        PathEventKind::Falls => format!("it falls as {} opens", names(&e.opens)),
        PathEventKind::Slides => format!("{} slides, with dry friction", names(&e.slides)),
        PathEventKind::Sticks => format!("{} sticks again", names(&e.slides)),
        PathEventKind::Yields => {
            format!("{} reaches its strength and yields", e.yields.join(", "))
        }
    }
}

/// The curve: load factor, or the force on each moving support along its way, against the parameter;
/// it goes with the film.
pub fn chart(file: &ResultFile) -> Option<Chart> {
    let path = file.path.as_ref()?;
    let series = curves(path).into_iter().map(|(name, points)| {
        let hint = |x: f64, y: f64| format!("{name}: {} at {}", short(y), short(x));
        Series::line(name.clone(), &points, hint)
    });
    let note: Vec<String> =
        path.events.iter().map(|e| format!("{}: {}", short(e.value), happens(e))).collect();
    let chart = Chart {
        title: "Load factor or reaction along the path".into(),
        x: Axis::new(parameter(path), false),
        y: Axis::new(held_by(path), false),
        series: series.collect(),
        events: path.events.iter().map(|e| e.value).collect(),
        note: note.join("; "),
        film: true,
        ..Chart::default()
    };
    chart.of_two()
}
