//! Stages of construction as tables and charts.

use crate::{
    ReportError,
    cells::{Cell, Table},
    chart::{Axis, Chart, Series},
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

fn said(file: &ResultFile) -> Result<&StagesResult, ReportError> {
    file.stages.as_ref().ok_or_else(|| ReportError::new("this is not a result of `stages`"))
}

/// The stages, a row each: name, verdict, least equilibrium error (lower and upper end, g), blocks, held
/// blocks, load factor and tilt (degrees), each with its ends, and the least force (N) down on all
/// that is held, one by one.
///
/// # Errors
/// The result is of another question.
pub fn csv(file: &ResultFile) -> Result<String, ReportError> {
    let mut table = Table::new();
    let head = [
        "stage",
        "name",
        "verdict",
        "equilibrium_error_lower",
        "equilibrium_error_upper",
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
    table.write_record(head)?;
    let ends = |l: Option<&LoadFactorAnswer>| -> [Cell; 3] {
        let l = l.map_or([None; 3], |l| [l.value, l.lower, l.upper]);
        l.map(Cell::from)
    };
    for (k, s) in said(file)?.list.iter().enumerate() {
        let equilibrium_error = s.verdict.answer.as_verdict().map(|v| v.equilibrium_error);
        let mut row: Vec<Cell> =
            vec![(k + 1).into(), s.name.clone().into(), s.stands().word().into()];
        row.extend([
            equilibrium_error.map(|u| u.lower).into(),
            equilibrium_error.map(|u| u.upper).into(),
        ]);
        row.extend([s.blocks.into(), s.held.join("; ").into()]);
        row.extend(ends(s.load_factor()));
        row.extend(ends(s.tilt_deg()));
        let forces = s.least_forces.iter().map(|h| {
            let value = h.least.value.map_or("undecided".to_string(), |v| v.to_string());
            format!("{} along {:?}: {value}", h.block, h.direction)
        });
        row.push(forces.collect::<Vec<_>>().join("; ").into());
        table.write_record(row)?;
    }
    Ok(table.end()?)
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
pub fn chart(file: &ResultFile) -> Option<Chart> {
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
