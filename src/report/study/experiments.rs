//! Predictions held against experiments: a table, a chart and a page of text.

use super::super::{
    cells::{Table, row},
    chart::{Axis, Chart, Series},
    text::{Layout, Page, Role},
};
use base::number::{count, short};
use sweep::study::experiments::{Compared, Group, Ratios, ratios};

/// A table of every measurement.
///
/// # Errors
/// The writer's, which has no reason to fail in memory.
pub fn experiments_csv(list: &[Compared]) -> Result<String, csv::Error> {
    let mut out = Table::with_head([
        "group",
        "test",
        "at",
        "measured",
        "measured_least",
        "measured_greatest",
        "predicted",
        "predicted_least",
        "predicted_greatest",
        "unit",
        "measured_over_predicted",
        "unknown_parameter",
        "no_prediction",
        "seconds",
    ])?;
    for c in list {
        out.write_record(row![
            c.group.clone(),
            c.test.clone(),
            c.at,
            c.measured,
            c.scatter[0],
            c.scatter[1],
            c.predicted,
            c.band.map(|b| b[0]),
            c.band.map(|b| b[1]),
            c.unit.clone(),
            c.ratio(),
            if c.unknown { "yes" } else { "no" },
            c.why.clone().unwrap_or_default(),
            c.seconds,
        ])?;
    }
    out.end()
}

fn name(c: &Compared) -> String {
    c.at.map_or_else(|| c.test.clone(), |at| format!("{} at {}", c.test, short(at)))
}

fn with_unit(value: f64, unit: &str) -> String {
    if unit.is_empty() { short(value) } else { format!("{} {unit}", short(value)) }
}

/// Measured against predicted, with the band of what was assumed; on the diagonal both are the same.
pub fn experiments_chart(list: &[Compared]) -> Chart {
    let mut groups: Vec<&str> = list.iter().map(|c| c.group.as_str()).collect();
    groups.dedup();
    let known: Vec<&Compared> =
        list.iter().filter(|c| c.predicted.is_some_and(|p| p > 0.0)).collect();
    let ends = known.iter().flat_map(|c| [Some(c.measured), c.predicted]).flatten();
    let (low, high) = ends.fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), v| (l.min(v), h.max(v)));
    let diagonal =
        Series::line("measured = predicted", &[(low, low), (high, high)], |_, _| String::new());
    let of = |group: &&str| {
        let own: Vec<&&Compared> = known.iter().filter(|c| c.group == **group).collect();
        Series {
            name: (*group).to_string(),
            points: own.iter().map(|c| [c.predicted, Some(c.measured)]).collect(),
            hints: own
                .iter()
                .map(|c| {
                    let band = c.band.map_or(String::new(), |[low, high]| {
                        format!(" (from {} to {} as assumed)", short(low), short(high))
                    });
                    format!(
                        "{}: measured {}, predicted {}{band}",
                        name(c),
                        with_unit(c.measured, &c.unit),
                        with_unit(c.predicted.unwrap_or(f64::NAN), &c.unit)
                    )
                })
                .collect(),
            band: match own.iter().any(|c| c.scatter[0] < c.scatter[1]) {
                true => own.iter().map(|c| c.scatter).collect(),
                false => Vec::new(),
            },
            ..Series::default()
        }
    };
    let series: Vec<Series> = groups.iter().map(of).filter(|s| s.count() > 0).collect();
    Chart {
        title: "Measured against predicted".into(),
        x: Axis::new("predicted (in the unit of each test)", true),
        y: Axis::new("measured", true),
        series: std::iter::once(diagonal).chain(series).collect(),
        note: "Points above the line carried more than predicted.".into(),
        ..Chart::default()
    }
}

fn words(r: Ratios) -> String {
    match r.count {
        1 => format!("measured/predicted {:.3}", r.mean),
        n => format!(
            "measured/predicted {:.3}, CoV {:.1} %, from {:.2} to {:.2} ({n} values)",
            r.mean,
            100.0 * r.cov,
            r.range[0],
            r.range[1]
        ),
    }
}

/// Every group with its tests.
pub fn experiments_text(groups: &[Group], list: &[Compared], layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let tests: usize = groups.iter().map(|g| g.experiment.tests.len()).sum();
    let published = ratios(list.iter().filter(|c| !c.unknown && c.at.is_none()));
    let title = match published {
        Some(r) => format!(
            "{} in {}; without an unknown parameter {}",
            count(tests, "test"),
            count(groups.len(), "group"),
            words(r)
        ),
        None => format!("{} in {}", count(tests, "test"), count(groups.len(), "group")),
    };
    page.title("Held against experiments", title, Role::Value);
    for g in groups {
        let own: Vec<&Compared> = list.iter().filter(|c| c.group == g.name).collect();
        let e = &g.experiment;
        page.blank();
        page.paragraph(&format!("{}: {}", g.name, e.name));
        page.row("ratio", ratios(own.iter().copied()).map(words));
        page.row(
            "measured",
            [format!("{}, {}", e.quantity, if e.unit.is_empty() { "a ratio" } else { &e.unit })],
        );
        page.row("tests", own.iter().map(|c| line(c)));
        let assumed = e.assumed.iter().map(|a| {
            format!("{} from {} to {}: {}", a.what, short(a.between[0]), short(a.between[1]), a.why)
        });
        page.row("assumed", assumed);
        page.row("left out", [e.left_out.clone()]);
        if e.unknown {
            page.row("note", ["a number that governs is not published".to_string()]);
        }
        page.row("source", [e.source.clone()]);
    }
    page
}

fn line(c: &Compared) -> String {
    let Some(predicted) = c.predicted else {
        return format!(
            "{:<12} measured {:<9} no prediction: {}",
            name(c),
            short(c.measured),
            c.why.as_deref().unwrap_or("undecided")
        );
    };
    let band = c.band.map_or(String::new(), |[low, high]| {
        format!("   as assumed {} to {}", short(low), short(high))
    });
    let ratio = c.ratio().map_or(String::new(), |r| format!("{r:.3}"));
    format!(
        "{:<12} measured {:<9} predicted {:<9} ratio {ratio}{band}",
        name(c),
        short(c.measured),
        short(predicted)
    )
}
