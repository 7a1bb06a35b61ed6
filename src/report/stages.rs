//! Stages of construction as tables and charts.

use super::{
    cells::{Cell, Table},
    page::{Axis, Chart, Series},
    plot::CurveError,
    plot::{self, Plot},
};
use base::number::short;
use check::{
    proof::{
        ResultFile,
        answer::LoadFactorAnswer,
        stages::{StageResult, StagesResult},
    },
    verdict::Verdict,
};
use plotters::{
    prelude::{Circle, PathElement, RGBColor, TriangleMarker},
    style::Color,
};

fn refused(e: impl std::fmt::Display) -> CurveError {
    CurveError::new(e)
}

fn said(file: &ResultFile) -> Result<&StagesResult, CurveError> {
    file.stages.as_ref().ok_or_else(|| CurveError::new("this is no result of `stages`"))
}

/// The stages, a row each: name, verdict, least unbalance (lower and upper end, g), blocks, held
/// blocks, load factor and tilt (degrees), each with its ends, and the least force (N) down on all
/// that is held, one by one.
///
/// # Errors
/// The result is of another question.
pub fn csv(file: &ResultFile) -> Result<String, CurveError> {
    let mut table = Table::new();
    let head = [
        "stage",
        "name",
        "verdict",
        "unbalance_lower",
        "unbalance_upper",
        "blocks",
        "held",
        "load_factor",
        "load_factor_lower",
        "load_factor_upper",
        "tilt_deg",
        "tilt_lower",
        "tilt_upper",
        "least_forces",
    ];
    table.write_record(head).map_err(refused)?;
    let ends = |l: Option<&LoadFactorAnswer>| -> [Cell; 3] {
        let l = l.map_or([None; 3], |l| [l.value, l.lower, l.upper]);
        l.map(Cell::from)
    };
    for (k, s) in said(file)?.list.iter().enumerate() {
        let unbalance = s.verdict.answer.as_verdict().map(|v| v.unbalance);
        let mut row: Vec<Cell> =
            vec![(k + 1).into(), s.name.clone().into(), s.stands().word().into()];
        row.extend([unbalance.map(|u| u.lower).into(), unbalance.map(|u| u.upper).into()]);
        row.extend([s.blocks.into(), s.held.join("; ").into()]);
        row.extend(ends(s.load_factor()));
        row.extend(ends(s.tilt_deg()));
        let forces = s.least_forces.iter().map(|h| {
            let value = h.least.value.map_or("open".to_string(), |v| v.to_string());
            format!("{} along {:?}: {value}", h.block, h.direction)
        });
        row.push(forces.collect::<Vec<_>>().join("; ").into());
        table.write_record(row).map_err(refused)?;
    }
    table.end().map_err(refused)
}

/// A number of a stage, where it has one.
type OfStage = fn(&StageResult) -> Option<f64>;

/// What the chart shows of stages, with its name.
fn quantity(result: &StagesResult) -> Option<(&'static str, OfStage)> {
    let factor = |s: &StageResult| s.load_factor().and_then(|l| l.value);
    let tilt = |s: &StageResult| s.tilt_deg().and_then(|l| l.value);
    if result.list.iter().any(|s| tilt(s).is_some()) {
        return Some(("tilt at which it falls, degrees", tilt));
    }
    result.list.iter().any(|s| factor(s).is_some()).then_some(("load factor", factor))
}

/// The margins stage by stage, zero where it does not stand; for the page, with its film.
pub fn page_chart(file: &ResultFile) -> Option<Chart> {
    let result = file.stages.as_ref()?;
    let (name, value) = quantity(result)?;
    let numbered = || result.list.iter().enumerate();
    let hint = |(k, s): (usize, &StageResult)| {
        let margin = value(s).map_or(String::new(), |v| format!(", {}", short(v)));
        format!("{}. {}: {}{margin}", k + 1, s.name, s.stands().word())
    };
    let stands = Series {
        name: name.into(),
        line: true,
        points: numbered().map(|(k, s)| [Some((k + 1) as f64), value(s)]).collect(),
        hints: numbered().map(hint).collect(),
        ..Series::default()
    };
    let fallen = || numbered().filter(|(_, s)| s.stands() != Verdict::Stable);
    let falls = Series {
        name: "does not stand".into(),
        points: fallen().map(|(k, _)| [Some((k + 1) as f64), Some(0.0)]).collect(),
        hints: fallen().map(hint).collect(),
        ..Series::default()
    };
    let series = [stands, falls].into_iter().filter(|s| !s.points.is_empty());
    Some(Chart {
        title: "Margin at every stage".into(),
        x: Axis::new("stage", false),
        y: Axis::new(name, false),
        series: series.collect(),
        film: true,
        ..Chart::default()
    })
}

/// The margins stage by stage as SVG; triangles at zero where a stage does not stand.
///
/// # Errors
/// The result is of another question, or no stage has a margin.
pub fn chart(file: &ResultFile) -> Result<String, CurveError> {
    let result = said(file)?;
    let (name, value) =
        quantity(result).ok_or_else(|| CurveError::new("no stage has a margin to draw"))?;
    let numbered = || result.list.iter().enumerate().map(|(k, s)| ((k + 1) as f64, s));
    let points: Vec<(f64, f64)> = numbered().filter_map(|(k, s)| Some((k, value(s)?))).collect();
    let high = points.iter().map(|p| p.1).fold(0.0, f64::max);
    let low = points.iter().map(|p| p.1).fold(0.0, f64::min);
    let margin = 0.06 * (high - low).max(f64::MIN_POSITIVE);
    let end = result.list.len() as f64 + 0.5;
    let plot = Plot {
        name: &file.scene.name,
        axes: ["stage", name],
        ends: [0.5..end, low - margin..high + margin],
        left: 80,
        legend: None,
    };
    plot.svg(|chart| {
        // A line has a gap where a stage has no margin.
        let mut run: Vec<(f64, f64)> = Vec::new();
        for (k, s) in numbered() {
            match value(s) {
                Some(v) => run.push((k, v)),
                None => draw(chart, std::mem::take(&mut run), plot::BLUE)?,
            }
        }
        draw(chart, run, plot::BLUE)?;
        chart
            .draw_series(points.into_iter().map(|p| Circle::new(p, 3, plot::BLUE.filled())))
            .map_err(refused)?;
        let falls = numbered().filter(|(_, s)| s.stands() != Verdict::Stable);
        chart
            .draw_series(falls.map(|(k, _)| TriangleMarker::new((k, 0.0), 6, plot::RED.filled())))
            .map_err(refused)?;
        Ok(())
    })
}

fn draw(chart: &mut plot::Drawn, run: Vec<(f64, f64)>, colour: RGBColor) -> Result<(), CurveError> {
    if run.len() > 1 {
        chart.draw_series([PathElement::new(run, colour.stroke_width(2))]).map_err(refused)?;
    }
    Ok(())
}
