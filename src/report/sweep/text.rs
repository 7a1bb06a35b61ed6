//! The summary of a sweep as a page.

use crate::text::{Layout, Page, Role};
use base::number::{count, rounded_down, seconds, short};
use sweep::{Header, LognormalFit, Proportion, Sampling, Summary};

/// So many numbers are listed by their influence.
const SHOWN: usize = 5;

/// The page; `brief` leaves the first line alone.
pub fn summary(header: &Header, summary: &Summary, brief: bool, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let counts: Vec<String> =
        summary.counts.iter().map(|(word, n)| format!("{n} {word}")).collect();
    let missing = header.rows.saturating_sub(summary.rows);
    let of = if missing > 0 { format!(" of {}", header.rows) } else { String::new() };
    let ended = if counts.is_empty() { String::new() } else { format!(": {}", counts.join(", ")) };
    let answer = format!("{}{of}{ended}", count(summary.rows, "row"));
    page.title(&header.plan.name, answer, if missing > 0 { Role::Unsure } else { Role::Value });
    if brief {
        return page;
    }
    page.blank();
    // Numbers about some of the rows say of which.
    let valued = summary.valued;
    let part = if header.plan.question.quantity().is_some() && valued < summary.rows {
        format!(", of the {} with a value", count(valued, "row"))
    } else {
        String::new()
    };
    if let (Some(q), Some(quantity)) = (&summary.quantiles, header.plan.question.quantity()) {
        page.row(
            quantity,
            [
                format!(
                    "least {} (row {}), greatest {} (row {}){part}",
                    rounded_down(q.least.0),
                    q.least.1,
                    short(q.greatest.0),
                    q.greatest.1
                ),
                format!(
                    "quantiles 5 % {}, 25 % {}, median {}, 75 % {}, 95 % {}",
                    short(q.p05),
                    short(q.p25),
                    short(q.median),
                    short(q.p75),
                    short(q.p95)
                ),
            ],
        );
    }
    if let Some(failed) = summary.failed {
        let what = match header.plan.question.require() {
            Some(require) => format!(" (below {require}, or not standing)"),
            None => String::new(),
        };
        // Rows that are open neither failed nor stood.
        let what = match summary.open {
            0 => what,
            n => format!("{what}; {} without an answer not counted", count(n, "row")),
        };
        // A grid is no sample: its share has no interval.
        let grid = matches!(header.plan.sampling, Sampling::Grid {});
        let share = if summary.fragility.is_some() && !grid {
            share(failed)
        } else {
            format!("{} of {}", failed.failed, failed.of)
        };
        page.row("failed", [format!("{share}{what}")]);
    }
    // Where one number varies there is nothing to compare.
    if header.plan.vary.len() > 1 && !summary.influence.is_empty() {
        page.row(
            "influence",
            summary
                .influence
                .iter()
                .take(SHOWN)
                .map(|i| format!("{}: {:.0} % of the variance", i.parameter, 100.0 * i.share)),
        );
        page.row(
            "",
            [format!(
                "correlation ratio{}: the variance between groups of rows with similar values of one number, relative to the total; the rest comes from interactions",
                part.replace(',', "")
            )],
        );
    }
    if let Some(f) = &summary.fragility {
        // A few points of the curve; all of them are in --json and the chart.
        let every = (f.points.len() - 1).div_ceil(4).max(1);
        let points = f
            .points
            .iter()
            .step_by(every)
            .map(|(at, p)| format!("{} {}: {}", f.along, short(*at), share(*p)));
        page.row("fragility", points);
        page.row("lognormal", f.lognormal.iter().map(fit));
        page.row("lognormal", f.no_lognormal.iter().map(|why| format!("none: {why}")));
    }
    if let Some((row, error)) = &summary.first_error {
        let first = format!("the first in row {row}: {error}");
        page.row("errors", [first]);
    }
    page.row("time", [format!("{} of computation", seconds(summary.seconds))]);
    page
}

fn fit(fit: &LognormalFit) -> String {
    format!(
        "half fail at {} (95 % interval {} to {}), dispersion {}; by maximum likelihood from the single rows",
        short(fit.median),
        short(fit.median_95[0]),
        short(fit.median_95[1]),
        short(fit.dispersion)
    )
}

fn share(p: Proportion) -> String {
    format!(
        "{} of {}, {:.1} % (95 % interval {:.1} to {:.1} %)",
        p.failed,
        p.of,
        100.0 * p.share,
        100.0 * p.lower,
        100.0 * p.upper
    )
}
