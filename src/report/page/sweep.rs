//! The page of a sweep: its words, charts of the value against what varies, and a table of all rows
//! to sort.

use super::{Axis, Chart, Series, tables};
use crate::{
    sweep::group::{Group, bands, cells, mark, marks},
    text::Page,
};
use base::number::short;
use serde_json::{Value, json};
use sweep::{Fragility, Header, Row, Shown, Summary};

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
    let shown: Vec<Shown> = rows.iter().map(|r| Shown::of(header, r)).collect();
    let all = All { header, rows, shown: &shown };
    if !rows.is_empty() {
        let ranked = summary.influence.iter().map(|i| i.index);
        let rest =
            (0..header.plan.vary.len()).filter(|k| summary.influence.iter().all(|i| i.index != *k));
        let order: Vec<usize> = ranked.chain(rest).collect();
        if let [a, b, ..] = order[..] {
            charts.push(heat(&all, [a.min(b), a.max(b)]));
        }
        charts.extend(order.iter().take(CHARTS).map(|&k| along(&all, k)));
    }
    tables(text, &charts, &[table(header, rows)])
}

/// All rows, with what each has to show.
struct All<'a> {
    header: &'a Header,
    rows: &'a [Row],
    shown: &'a [Shown],
}

impl All<'_> {
    fn column(&self, k: usize) -> Vec<f64> {
        self.rows.iter().map(|r| self.header.coordinate(r, k)).collect()
    }

    fn axis(&self, k: usize) -> Axis {
        let vary = self.header.plan.vary.get(k);
        let words = vary.and_then(|v| v.words()).unwrap_or_default();
        Axis {
            words: words.iter().map(ToString::to_string).collect(),
            ..Axis::new(label(self.header, k), false)
        }
    }

    fn place(&self, k: usize, at: f64) -> String {
        self.header.plan.vary.get(k).map_or_else(|| short(at), |v| v.place(at))
    }

    /// What stands for a group, in words.
    fn says(&self, group: &Group) -> String {
        let rows = base::number::count(group.rows, "row");
        match (group.shown, mark(&self.header.plan.question, group.shown)) {
            (Shown::Value(mean), _) if group.rows > 1 => format!(
                "mean {}, from {} to {} ({rows})",
                short(mean),
                short(group.ends[0]),
                short(group.ends[1])
            ),
            (Shown::Value(value), _) => short(value),
            (_, Some((word, _))) if group.without < group.rows => {
                format!(
                    "{word}: {} of {rows} without a value, so that there is no mean",
                    group.without
                )
            }
            (_, word) => format!("{} ({rows})", word.map_or("", |w| w.0)),
        }
    }

    /// A series of what is not a value, with its colour.
    fn marked(&self, kind: Shown) -> Option<Series> {
        let (word, [r, g, b]) = mark(&self.header.plan.question, kind)?;
        let colour = format!("rgb({r},{g},{b})");
        Some(Series { name: word.into(), colour: Some(colour), ..Series::default() })
    }
}

fn what(header: &Header) -> &'static str {
    header.plan.question.quantity().unwrap_or("share that stands")
}

fn label(header: &Header, k: usize) -> &str {
    header.plan.vary.get(k).map_or("", |v| v.label())
}

fn hint(header: &Header, row: &Row, value: f64) -> String {
    let numbers = row.parameters.iter().enumerate().map(|(k, v)| {
        format!("{} {}", label(header, k), v.number().map_or_else(|| v.to_string(), short))
    });
    format!(
        "row {}: {} {} at {}",
        row.row,
        what(header),
        short(value),
        numbers.collect::<Vec<_>>().join(", ")
    )
}

/// The value against one number: every row, and their mean in a band from the least to the
/// greatest where all of them have a value; where not, what they have instead, at the foot.
fn along(all: &All, k: usize) -> Chart {
    let header = all.header;
    let xs = all.column(k);
    let groups = bands(&xs, all.shown, &header.plan.sampling);
    let hints =
        |g: &Group| format!("{} {}: {}", label(header, k), all.place(k, g.at[0]), all.says(g));
    // A gap in the line is a point without a value.
    let there = |v: f64| if v.is_finite() { Some(v) } else { None };
    let mean = Series {
        name: "mean, least and greatest".into(),
        line: true,
        points: groups.iter().map(|g| [there(g.at[0]), g.shown.value()]).collect(),
        hints: groups.iter().map(hints).collect(),
        band: groups.iter().map(|g| g.ends).collect(),
        ..Series::default()
    };
    let mut series = vec![mean];
    let known: Vec<(usize, f64)> =
        all.shown.iter().enumerate().filter_map(|(i, s)| Some((i, s.value()?))).collect();
    if groups.len() < all.rows.len() && known.len() <= ROWS {
        series.push(Series {
            name: "rows".into(),
            points: known.iter().map(|&(i, v)| [there(xs[i]), Some(v)]).collect(),
            hints: known.iter().map(|&(i, v)| hint(header, &all.rows[i], v)).collect(),
            ..Series::default()
        });
    }
    let foot = known.iter().map(|k| k.1).fold(f64::INFINITY, f64::min);
    let foot = if foot.is_finite() { foot } else { 0.0 };
    for (kind, _) in marks(all.shown) {
        let own: Vec<&Group> = groups.iter().filter(|g| g.shown == kind).collect();
        series.extend(all.marked(kind).filter(|_| !own.is_empty()).map(|s| Series {
            points: own.iter().map(|g| [there(g.at[0]), Some(foot)]).collect(),
            hints: own.iter().map(|g| hints(g)).collect(),
            ..s
        }));
    }
    Chart {
        title: format!("{} against {}", what(header), label(header, k)),
        x: all.axis(k),
        y: Axis::new(what(header), false),
        series,
        ..Chart::default()
    }
}

/// The mean value against two numbers.
fn heat(all: &All, [a, b]: [usize; 2]) -> Chart {
    let header = all.header;
    let cells = cells(&all.column(a), &all.column(b), all.shown);
    let filled = |base: Series, own: Vec<&Group>| Series {
        points: own.iter().map(|c| c.at.map(Some)).collect(),
        hints: own
            .iter()
            .map(|c| {
                let (x, y) = (all.place(a, c.at[0]), all.place(b, c.at[1]));
                let says = all.says(c);
                format!("{} {x}, {} {y}: {says}", label(header, a), label(header, b))
            })
            .collect(),
        band: own.iter().map(|c| c.half).collect(),
        values: own.iter().filter_map(|c| c.shown.value()).collect(),
        ..base
    };
    let known = cells.iter().filter(|c| c.shown.value().is_some()).collect();
    let mut series = vec![filled(Series { name: what(header).into(), ..Series::default() }, known)];
    for (kind, _) in marks(all.shown) {
        let own: Vec<&Group> = cells.iter().filter(|c| c.shown == kind).collect();
        series.extend(all.marked(kind).map(|s| filled(s, own)));
    }
    Chart {
        title: format!("{} against {} and {}", what(header), label(header, a), label(header, b)),
        x: all.axis(a),
        y: all.axis(b),
        series,
        cells: Some(what(header).into()),
        ..Chart::default()
    }
}

fn fragility(f: &Fragility) -> Chart {
    let percent = |share: f64| short(100.0 * share);
    let series = Series {
        name: "share that fails, with its 95 % interval".into(),
        line: true,
        points: f.points.iter().map(|(at, p)| [Some(*at), Some(p.share)]).collect(),
        hints: f
            .points
            .iter()
            .map(|(at, p)| {
                let (low, high) = (percent(p.lower), percent(p.upper));
                format!(
                    "{} {}: {} of {} fail, {} % ({low} to {high} %)",
                    f.along,
                    f.vary.as_ref().map_or_else(|| short(*at), |v| v.place(*at)),
                    p.failed,
                    p.of,
                    percent(p.share)
                )
            })
            .collect(),
        band: f.points.iter().map(|(_, p)| [p.lower, p.upper]).collect(),
        ..Series::default()
    };
    let fitted = f.lognormal.as_ref().map(|fit| Series {
        name: "lognormal, by maximum likelihood, with its 95 % band".into(),
        line: true,
        points: fit.curve.iter().map(|(at, p)| [Some(*at), Some(p[1])]).collect(),
        hints: fit
            .curve
            .iter()
            .map(|(at, p)| format!("{} {}: {} %", f.along, short(*at), percent(p[1])))
            .collect(),
        band: fit.curve.iter().map(|(_, p)| [p[0], p[2]]).collect(),
        ..Series::default()
    });
    Chart {
        title: "Share that fails".into(),
        x: Axis {
            words: f
                .vary
                .iter()
                .flat_map(|v| v.words().unwrap_or_default())
                .map(ToString::to_string)
                .collect(),
            ..Axis::new(&f.along, false)
        },
        y: Axis::new("share that fails", false),
        series: std::iter::once(series).chain(fitted).collect(),
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
        cells.extend(directions.then(|| json!(a.toward.map(base::number::point))));
        cells.extend(errors.then(|| json!(r.error)));
        cells.push(json!(r.seconds));
        cells
    };
    let left = rows.len().saturating_sub(ROWS);
    let note =
        if left > 0 { format!("{left} more rows are in the file of rows.") } else { String::new() };
    json!({ "title": "Rows", "columns": columns, "rows": rows.iter().take(ROWS).map(line).collect::<Vec<_>>(), "note": note })
}
