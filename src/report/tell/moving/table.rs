//! Load factors of a train against its place, as tables and charts.

use crate::{
    ReportError,
    cells::{Cell, Table},
    chart::{Axis, Chart, Series},
};
use base::number::short;
use check::proof::{ResultFile, answer::FactorStatus, moving::MovingAnswer};
use model::train::{Travel, is_symmetric};

fn said(file: &ResultFile) -> Result<Vec<&MovingAnswer>, ReportError> {
    let list: Vec<_> = file.directions.iter().filter_map(|d| d.answer.moving()).collect();
    match list.is_empty() {
        true => Err(ReportError::new("this is not a result of `limit --moving`")),
        false => Ok(list),
    }
}

/// Every position, a row each: direction of travel, place of the train's origin (m), the load factor
/// to use, its ends, the bound with joints that open as they slide, and where the axles on the spans
/// stand (m).
///
/// # Errors
/// The result is of another question.
pub fn csv(file: &ResultFile) -> Result<String, ReportError> {
    let mut table = Table::new();
    let head = ["travel", "x", "load_factor", "lower", "upper", "bound", "axles"];
    table.write_record(head)?;
    for a in said(file)? {
        let l = &a.load_factor;
        let axles: Vec<String> =
            a.axles.iter().map(|s| format!("{} at {}", s.axle + 1, short(s.x))).collect();
        let mut row: Vec<Cell> = vec![travel(a.travel).into(), a.x.into()];
        row.extend([l.value, l.lower, l.upper, l.associative.value].map(Cell::from));
        row.push(axles.join("; ").into());
        table.write_record(row)?;
    }
    Ok(table.end()?)
}

fn travel(travel: Travel) -> &'static str {
    match travel {
        Travel::Forward => "forward",
        Travel::Backward => "backward",
    }
}

/// Load factors are drawn up to so many times the least: where an axle has hardly come onto a span
/// they are without bound, and nothing could be read off the rest.
const HIGH: f64 = 6.0;

/// A direction of travel in words, and its points: place and load factor, none where the line is
/// broken, for positions without a load factor, or with one too high to be drawn, lie there.
type Line = (String, Vec<(f64, Option<f64>)>);

/// What the line of a train is called that is the same from both ends.
const BOTH: &str = "both directions of travel";

/// Whether positions were asked only whether they bear what the worst one does: then the lines are
/// those of the bounds, which all have.
fn has_bounds_only(list: &[&MovingAnswer]) -> bool {
    list.iter().any(|a| a.load_factor.status == FactorStatus::AtLeast)
}

/// The line of each direction of travel, where it is not above [`HIGH`] × the least.
fn lines(file: &ResultFile, list: &[&MovingAnswer]) -> Vec<Line> {
    let symmetric = file.scene.input.train.as_ref().is_some_and(is_symmetric);
    let bounds = has_bounds_only(list);
    let value = |a: &MovingAnswer| {
        let l = &a.load_factor;
        let value = if bounds { l.associative.value } else { l.value };
        value.filter(|v| v.is_finite())
    };
    let least = list.iter().filter_map(|a| value(a)).fold(f64::INFINITY, f64::min);
    let step = file.scene.input.train.as_ref().map_or(f64::INFINITY, |t| t.step);
    let line = |travel: Travel| {
        let mut points: Vec<(f64, Option<f64>)> = Vec::new();
        for a in list.iter().filter(|a| a.travel == travel) {
            // Steps at which no axle stands on a span are not in the list.
            if let Some(&(x, _)) = points.last()
                && a.x - x > 1.5 * step
            {
                points.push((0.5 * (a.x + x), None));
            }
            points.push((a.x, value(a).filter(|y| *y <= HIGH * least.abs())));
        }
        let words = if symmetric { BOTH } else { travel.words() };
        (if bounds { format!("{words}, upper bound") } else { words.into() }, points)
    };
    [Travel::Forward, Travel::Backward]
        .into_iter()
        .map(line)
        .filter(|l: &Line| l.1.iter().any(|p| p.1.is_some()))
        .collect()
}

/// The answer as a point, where it has a value.
fn worst(file: &ResultFile) -> Option<(f64, f64)> {
    let a = file.answer.moving()?;
    Some((a.x, a.load_factor.value?))
}

/// Positions with a value of their own, where the lines are bounds, the least among them.
fn valued(list: &[&MovingAnswer]) -> Vec<(f64, f64)> {
    let value = |a: &&&MovingAnswer| Some((a.x, a.load_factor.value?));
    list.iter().filter(|_| has_bounds_only(list)).filter_map(|a| value(&a)).collect()
}

/// What such positions are called.
const VALUED: &str = "with dry friction, where computed";

const X: &str = "position of the train's origin, m";
const Y: &str = "load factor λ";

/// The chart of a page, with a cursor that goes with the film.
pub fn chart(file: &ResultFile) -> Option<Chart> {
    let list = said(file).ok()?;
    let hint = |&(x, y): &(f64, Option<f64>)| {
        y.map_or(String::new(), |y| format!("λ = {} at x = {} m", short(y), short(x)))
    };
    let series = |name: &str, line: bool, points: &[(f64, Option<f64>)]| Series {
        name: name.into(),
        line,
        points: points.iter().map(|p| [Some(p.0), p.1]).collect(),
        hints: points.iter().map(hint).collect(),
        ..Series::default()
    };
    let mut all: Vec<Series> =
        lines(file, &list).iter().map(|(name, points)| series(name, true, points)).collect();
    if all.iter().all(|s| s.count() < 2) {
        return None;
    }
    let dry: Vec<_> = valued(&list).into_iter().map(|(x, y)| (x, Some(y))).collect();
    all.extend((!dry.is_empty()).then(|| series(VALUED, false, &dry)));
    all.extend(worst(file).map(|p| series("governing position", false, &[(p.0, Some(p.1))])));
    Some(Chart {
        title: "Load factor by position of the train".into(),
        x: Axis::new(X, false),
        y: Axis::new(Y, false),
        series: all,
        note: format!(
            "shown up to {HIGH} × the least; every point is proved, nothing between them"
        ),
        film: true,
        ..Chart::default()
    })
}
