//! Pages of studies: error against time on every scene, the performance profile, and tables to
//! sort.

use super::tables;
use crate::{
    chart::{Axis, Chart, Series},
    study::chart::{FLOOR, errors, profiles},
    text::Page,
};
use base::number::{seconds, short};
use serde_json::{Value, json};
use sweep::study::{
    Omission, StudyPoint,
    experiments::Compared,
    extreme::{CellAnswer, CellQuestion},
};

/// The page of a study.
///
/// # Errors
/// Only if memory runs out.
pub fn study(text: &Page, points: &[StudyPoint]) -> Result<String, serde_json::Error> {
    let mut scenes: Vec<&str> = Vec::new();
    for p in points {
        if !scenes.contains(&p.scene.as_str()) {
            scenes.push(&p.scene);
        }
    }
    let mut charts = vec![profiles(points)];
    charts.extend(scenes.iter().map(|s| errors(s, points)));
    charts.retain(|c| c.series.iter().any(|s| !s.points.is_empty()));
    let rows: Vec<Value> = points
        .iter()
        .map(|p| {
            let status = p.status.map(|s| format!("{s:?}"));
            let knob = if p.method.knob().is_empty() {
                Value::Null
            } else {
                json!(format!("{} {}", p.method.knob(), short(p.knob)))
            };
            json!([
                p.scene,
                p.method.label(),
                knob,
                p.value,
                p.error,
                p.bracket,
                p.seconds,
                p.iterations,
                status
            ])
        })
        .collect();
    let columns = [
        "scene",
        "method",
        "setting",
        "value",
        "relative error",
        "bracket",
        "seconds",
        "iterations",
        "solver status",
    ];
    tables(text, &charts, &[json!({ "title": "Runs", "columns": columns, "rows": rows })])
}

/// The page of predictions against experiments.
///
/// # Errors
/// Only if memory runs out.
pub fn experiments(
    text: &Page,
    chart: Chart,
    list: &[Compared],
) -> Result<String, serde_json::Error> {
    let rows: Vec<Value> = list
        .iter()
        .map(|c| {
            let [low, high] = c.band.map_or([None; 2], |b| b.map(Some));
            json!([c.group, c.test, c.at, c.measured, c.predicted, low, high, c.unit, c.ratio()])
        })
        .collect();
    let columns = [
        "group",
        "test",
        "at",
        "measured",
        "predicted",
        "least as assumed",
        "greatest as assumed",
        "unit",
        "measured/predicted",
    ];
    tables(text, &[chart], &[json!({ "title": "Tests", "columns": columns, "rows": rows })])
}

/// The page of what omissions save.
///
/// # Errors
/// Only if memory runs out.
pub fn omissions(text: &Page, list: &[Omission]) -> Result<String, serde_json::Error> {
    let rows: Vec<Value> = list
        .iter()
        .map(|o| {
            json!([
                o.scene,
                o.unknowns[0],
                o.unknowns[1],
                o.seconds[0],
                o.seconds[1],
                o.values[0],
                o.difference()
            ])
        })
        .collect();
    let columns = ["scene", "unknowns", "of", "seconds", "of", "load factor", "difference"];
    tables(text, &[], &[json!({ "title": "Scenes", "columns": columns, "rows": rows })])
}

/// The page of the extreme grid.
///
/// # Errors
/// Only if memory runs out.
pub fn extreme(text: &Page, found: &[CellAnswer]) -> Result<String, serde_json::Error> {
    let series = |family: &str| {
        let own: Vec<(&CellAnswer, f64)> = found
            .iter()
            .filter(|f| f.family == family && f.seconds > 0.0)
            .filter_map(|f| Some((f, f.error?)))
            .collect();
        Series {
            name: family.into(),
            points: own.iter().map(|(f, e)| [f.seconds, e.clamp(FLOOR, 10.0)].map(Some)).collect(),
            hints: own
                .iter()
                .map(|(f, e)| format!("{}: error {e:.1e} in {}", f.what, seconds(f.seconds)))
                .collect(),
            ..Series::default()
        }
    };
    let chart = Chart {
        title: "Load factors: error against time".into(),
        x: Axis::new("seconds", true),
        y: Axis::new("relative error", true),
        series: ["column", "wall", "arch"]
            .map(series)
            .into_iter()
            .filter(|s| !s.points.is_empty())
            .collect(),
        ..Chart::default()
    };
    let asked = |ask: CellQuestion| match ask {
        CellQuestion::LoadFactor(v) => format!("load factor {}", short(v)),
        CellQuestion::Stands(true, by) => format!("stands, {by:.0e} from critical"),
        CellQuestion::Stands(false, by) => format!("falls, {by:.0e} from critical"),
    };
    let rows: Vec<Value> = found
        .iter()
        .map(|f| {
            let grade = format!("{:?}", f.grade).to_lowercase();
            json!([
                f.family,
                f.what,
                asked(f.ask),
                grade,
                f.value,
                f.error,
                f.bracket,
                f.iterations,
                f.seconds
            ])
        })
        .collect();
    let columns = [
        "family",
        "what",
        "right answer",
        "grade",
        "value",
        "relative error",
        "bracket",
        "iterations",
        "seconds",
    ];
    let charts = if chart.series.is_empty() { Vec::new() } else { vec![chart] };
    tables(text, &charts, &[json!({ "title": "Cells", "columns": columns, "rows": rows })])
}
