//! The page of a sweep: its words, charts of the value against what varies, and a table of all rows
//! to sort.

use super::{Axis, Chart, Series, tables};
use crate::{
    number::short,
    report::{
        sweep::group::{bands, cells},
        text::Page,
    },
    sweep::{Fragility, Header, Row, Summary, value_of},
};
use serde_json::{Value, json};

/// So many numbers have a chart of their own, those that matter most.
const CHARTS: usize = 4;
/// So many rows are in the table: 2 MB.
const ROWS: usize = 20_000;

/// The page; `text` is the summary in words.
///
/// # Errors
/// Only if memory runs out.
pub fn sweep(
    text: &Page,
    header: &Header,
    rows: &[Row],
    summary: &Summary,
) -> Result<String, serde_json::Error> {
    let mut charts = Vec::new();
    charts.extend(summary.fragility.as_ref().map(fragility));
    let known: Vec<(&Row, f64)> =
        rows.iter().filter_map(|r| Some((r, value_of(header, r)?))).collect();
    if !known.is_empty() {
        let ranked = summary.influence.iter().map(|i| i.index);
        let rest =
            (0..header.plan.vary.len()).filter(|k| summary.influence.iter().all(|i| i.index != *k));
        let order: Vec<usize> = ranked.chain(rest).collect();
        if let [a, b, ..] = order[..] {
            charts.push(heat(header, &known, [a.min(b), a.max(b)]));
        }
        charts.extend(order.iter().take(CHARTS).map(|&k| along(header, &known, k)));
    }
    tables(text, &charts, &[table(header, rows)])
}

fn what(header: &Header) -> &'static str {
    header.plan.question.quantity().unwrap_or("share that stands")
}

fn label(header: &Header, k: usize) -> &str {
    header.plan.vary.get(k).map_or("", |v| v.label())
}

fn column(known: &[(&Row, f64)], k: usize) -> Vec<f64> {
    known.iter().map(|(r, _)| r.parameters.get(k).copied().unwrap_or(f64::NAN)).collect()
}

fn hint(header: &Header, row: &Row, value: f64) -> String {
    let numbers = row
        .parameters
        .iter()
        .enumerate()
        .map(|(k, v)| format!("{} {}", label(header, k), short(*v)));
    format!(
        "row {}: {} {} at {}",
        row.row,
        what(header),
        short(value),
        numbers.collect::<Vec<_>>().join(", ")
    )
}

/// The value against one number: every row, and their mean in a band from the least to the
/// greatest.
fn along(header: &Header, known: &[(&Row, f64)], k: usize) -> Chart {
    let (xs, values) = (column(known, k), known.iter().map(|k| k.1).collect::<Vec<_>>());
    let groups = bands(&xs, &values);
    let mean = Series {
        name: "mean, least and greatest".into(),
        line: true,
        points: groups.iter().map(|g| [g[0], g[2]]).collect(),
        hints: groups
            .iter()
            .map(|g| {
                format!(
                    "{} {}: mean {}, from {} to {}",
                    label(header, k),
                    short(g[0]),
                    short(g[2]),
                    short(g[1]),
                    short(g[3])
                )
            })
            .collect(),
        band: groups.iter().map(|g| [g[1], g[3]]).collect(),
        ..Series::default()
    };
    let mut series = vec![mean];
    if groups.len() < known.len() && known.len() <= ROWS {
        series.push(Series {
            name: "rows".into(),
            points: xs.iter().zip(&values).map(|(x, v)| [*x, *v]).collect(),
            hints: known.iter().map(|(r, v)| hint(header, r, *v)).collect(),
            ..Series::default()
        });
    }
    Chart {
        title: format!("{} against {}", what(header), label(header, k)),
        x: Axis::new(label(header, k), false),
        y: Axis::new(what(header), false),
        series,
        ..Chart::default()
    }
}

/// The mean value against two numbers.
fn heat(header: &Header, known: &[(&Row, f64)], [a, b]: [usize; 2]) -> Chart {
    let (xs, ys) = (column(known, a), column(known, b));
    let values: Vec<f64> = known.iter().map(|k| k.1).collect();
    let cells = cells(&xs, &ys, &values);
    let middle = |e: [f64; 2]| 0.5 * (e[0] + e[1]);
    let half = |e: [f64; 2]| 0.5 * (e[1] - e[0]);
    let series = Series {
        name: what(header).into(),
        points: cells.iter().map(|c| [middle(c.x), middle(c.y)]).collect(),
        hints: cells
            .iter()
            .map(|c| {
                let (x, y) = (short(middle(c.x)), short(middle(c.y)));
                let rows = crate::number::count(c.rows, "row");
                format!(
                    "{} {x}, {} {y}: {} {} ({rows})",
                    label(header, a),
                    label(header, b),
                    what(header),
                    short(c.mean)
                )
            })
            .collect(),
        band: cells.iter().map(|c| [half(c.x), half(c.y)]).collect(),
        values: cells.iter().map(|c| c.mean).collect(),
        ..Series::default()
    };
    Chart {
        title: format!("{} against {} and {}", what(header), label(header, a), label(header, b)),
        x: Axis::new(label(header, a), false),
        y: Axis::new(label(header, b), false),
        series: vec![series],
        cells: Some(what(header).into()),
        ..Chart::default()
    }
}

fn fragility(f: &Fragility) -> Chart {
    let percent = |share: f64| short(100.0 * share);
    let series = Series {
        name: "share that fails, with its 95 % interval".into(),
        line: true,
        points: f.points.iter().map(|(at, p)| [*at, p.share]).collect(),
        hints: f
            .points
            .iter()
            .map(|(at, p)| {
                let (low, high) = (percent(p.lower), percent(p.upper));
                format!(
                    "{} {}: {} of {} fail, {} % ({low} to {high} %)",
                    f.along,
                    short(*at),
                    p.failed,
                    p.of,
                    percent(p.share)
                )
            })
            .collect(),
        band: f.points.iter().map(|(_, p)| [p.lower, p.upper]).collect(),
        ..Series::default()
    };
    Chart {
        title: "Share that fails".into(),
        x: Axis::new(&f.along, false),
        y: Axis::new("share that fails", false),
        series: vec![series],
        note: "95 % interval after Wilson (1927).".into(),
        ..Chart::default()
    }
}

fn table(header: &Header, rows: &[Row]) -> Value {
    let directions = rows.iter().any(|r| r.answer.toward.is_some());
    let errors = rows.iter().any(|r| r.error.is_some());
    let mut columns: Vec<&str> = vec!["row"];
    columns.extend((0..header.plan.vary.len()).map(|k| label(header, k)));
    columns.extend([
        "status",
        header.plan.question.quantity().unwrap_or("value"),
        "lower",
        "upper",
    ]);
    columns.extend(directions.then_some("towards"));
    columns.extend(errors.then_some("error"));
    columns.push("seconds");
    let line = |r: &Row| {
        let a = &r.answer;
        let mut cells: Vec<Value> = vec![json!(r.row)];
        cells.extend(r.parameters.iter().map(|v| json!(v)));
        cells.extend([json!(a.status.word()), json!(a.value), json!(a.lower), json!(a.upper)]);
        cells.extend(directions.then(|| json!(a.toward.map(crate::number::point))));
        cells.extend(errors.then(|| json!(r.error)));
        cells.push(json!(r.seconds));
        cells
    };
    let left = rows.len().saturating_sub(ROWS);
    let note =
        if left > 0 { format!("{left} more rows are in the file of rows.") } else { String::new() };
    json!({ "title": "Rows", "columns": columns, "rows": rows.iter().take(ROWS).map(line).collect::<Vec<_>>(), "note": note })
}
