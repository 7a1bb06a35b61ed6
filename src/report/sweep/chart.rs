//! Charts of sweeps: the value against one number, against two, and the fragility curve.

use super::group::{Group, bands, cells, mark, marks};
use crate::{
    ReportError,
    chart::{self, Axis, Chart, Series},
};
use base::number::short;
use sweep::{Fragility, Header, Plan, Row, Shown, Summary, is_sample};

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The value against the number that matters most: mean, and the band from the least to the
    /// greatest; where a row has none, a mark at the foot.
    Line,
    /// The mean value against the two numbers that matter most, in colours; where a row has none,
    /// what it has instead.
    Heat,
    /// The share that fails, with its 95 % interval.
    Fragility,
}

impl Kind {
    /// What suits a sweep: a grid shows its values, a sample its fragility.
    pub fn suited(header: &Header, summary: &Summary) -> Self {
        let grid = !is_sample(&header.plan);
        match (grid, header.plan.vary.len()) {
            (true, 1) => Self::Line,
            (true, _) => Self::Heat,
            (false, _) if summary.fragility.is_some() => Self::Fragility,
            (false, _) => Self::Line,
        }
    }

    /// Whether it can be drawn of the rows of a plan at all.
    ///
    /// # Errors
    /// It needs more numbers, or a sample.
    pub fn fits(self, plan: &Plan) -> Result<(), ReportError> {
        match self {
            Self::Heat if plan.vary.len() < 2 => {
                Err(ReportError::new("no chart: a heat map needs two numbers that vary"))
            }
            Self::Fragility if !is_sample(plan) => Err(ReportError::new(
                "no chart: a fragility curve needs a sample, and the plan is a grid",
            )),
            _ => Ok(()),
        }
    }
}

/// So many numbers have a chart of their own, those that matter most.
const CHARTS: usize = 4;
/// So many rows are in the table of a page, and as dots in charts: 2 MB.
pub(crate) const ROWS: usize = 20_000;

/// The chart as SVG.
///
/// # Errors
/// The plan does not fit this kind, or there are no rows.
pub fn chart(
    header: &Header,
    rows: &[Row],
    summary: &Summary,
    kind: Kind,
) -> Result<String, ReportError> {
    kind.fits(&header.plan)?;
    let none = |why: &str| ReportError::new(format!("no chart: {why}"));
    let shown: Vec<Shown> = rows.iter().map(|r| Shown::of(header, r)).collect();
    let all = All { header, rows, shown: &shown };
    let own = match (kind, &order(header, summary)[..], rows.is_empty()) {
        (Kind::Fragility, ..) => {
            let f = summary.fragility.as_ref();
            fragility(f.ok_or_else(|| none("too few rows show whether they fail"))?, &all)
        }
        (_, _, true) => return Err(none("there are no rows")),
        // The plan's first number runs along x.
        (Kind::Heat, [a, b, ..], _) => heat(&all, [*a.min(b), *a.max(b)]),
        (Kind::Line, [a, ..], _) => along(&all, *a),
        _ => return Err(none("nothing varies")),
    };
    chart::file(&header.plan.name, &[own])
}

/// The numbers that vary, those that matter most first.
fn order(header: &Header, summary: &Summary) -> Vec<usize> {
    let known = summary.influence.iter().map(|i| i.index);
    let rest =
        (0..header.plan.vary.len()).filter(|k| summary.influence.iter().all(|i| i.index != *k));
    known.chain(rest).collect()
}

/// All of them, for a page.
pub(crate) fn charts(header: &Header, rows: &[Row], summary: &Summary) -> Vec<Chart> {
    let shown: Vec<Shown> = rows.iter().map(|r| Shown::of(header, r)).collect();
    let all = All { header, rows, shown: &shown };
    let mut charts: Vec<Chart> = summary.fragility.iter().map(|f| fragility(f, &all)).collect();
    let order = order(header, summary);
    let asked = order.iter().filter(|_| !rows.is_empty());
    if let ([a, b, ..], false) = (&order[..], rows.is_empty()) {
        charts.push(heat(&all, [*a.min(b), *a.max(b)]));
    }
    charts.extend(asked.take(CHARTS).map(|&k| along(&all, k)));
    charts
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
                format!("{word}: {} of {rows} without a value, so there is no mean", group.without)
            }
            (_, word) => format!("{} ({rows})", word.map_or("", |w| w.0)),
        }
    }

    /// A series of what is not a value, with its colour and how many rows show it.
    fn marked(&self, (kind, rows): (Shown, usize)) -> Option<Series> {
        let (word, colour) = mark(&self.header.plan.question, kind)?;
        let name = format!("{word}: {}", base::number::count(rows, "row"));
        Some(Series { name, colour: Some(colour), ..Series::default() })
    }
}

fn what(header: &Header) -> &'static str {
    header.plan.question.quantity().unwrap_or("share that stands")
}

pub(crate) fn label(header: &Header, k: usize) -> &str {
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
    for (kind, rows) in marks(all.shown) {
        let own: Vec<&Group> = groups.iter().filter(|g| g.shown == kind).collect();
        series.extend(all.marked((kind, rows)).map(|s| Series {
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
    for (kind, rows) in marks(all.shown) {
        let own: Vec<&Group> = cells.iter().filter(|c| c.shown == kind).collect();
        series.extend(all.marked((kind, rows)).map(|s| filled(s, own)));
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

fn fragility(f: &Fragility, all: &All) -> Chart {
    let percent = |share: f64| short(100.0 * share);
    // What neither fails nor stands is in no share.
    let is_out = |m: &(Shown, usize)| matches!(m.0, Shown::Error | Shown::Undecided);
    let left_out = marks(all.shown).into_iter().filter(is_out).filter_map(|m| all.marked(m));
    let left_out = left_out.map(|s| format!("Not included ({}).", s.name));
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
        note: std::iter::once("95 % interval after Wilson (1927).".to_string())
            .chain(left_out)
            .collect::<Vec<_>>()
            .join(" "),
        ..Chart::default()
    }
}
