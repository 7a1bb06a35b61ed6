//! The study of rocking as a table, a chart and a page of text.

use super::{
    super::{
        cells::{Table, row},
        chart::Chart,
        text::{Layout, Page, Role},
    },
    chart::dots,
};
use base::number::seconds;
use sweep::study::{RockingMethod, RockingPoint};

/// A table of every point.
///
/// # Errors
/// The writer's, which has no reason to fail in memory.
pub fn rocking_csv(points: &[RockingPoint]) -> Result<String, csv::Error> {
    let mut out = Table::with_head([
        "case",
        "method",
        "step_error",
        "value",
        "exact",
        "relative_error",
        "histories",
        "seconds_a_history",
    ])?;
    for p in points {
        let knob = (p.knob > 0.0).then_some(p.knob);
        out.write_record(row![
            p.case.clone(),
            p.method.label(),
            knob,
            p.value,
            p.truth,
            p.error,
            p.histories,
            p.seconds,
        ])?;
    }
    out.end()
}

/// Points of a method with one setting of its knob.
fn settings(points: &[RockingPoint]) -> Vec<(RockingMethod, f64)> {
    let mut list: Vec<(RockingMethod, f64)> = Vec::new();
    for p in points {
        if !list.contains(&(p.method, p.knob)) {
            list.push((p.method, p.knob));
        }
    }
    list
}

fn name(method: RockingMethod, knob: f64) -> String {
    match knob > 0.0 {
        true => format!("{}, steps to {knob:.0e}", method.label()),
        false => method.label().into(),
    }
}

/// What came out by method, then by case.
pub fn rocking_text(points: &[RockingPoint], layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let missed = points.iter().filter(|p| p.value.is_none()).count();
    let title = format!("{} values, {missed} more than 10 % from the exact one", points.len());
    page.title("Rocking: error against run time", title, Role::Value);
    page.blank();
    let impact = |p: &RockingPoint| p.case.starts_with("impact");
    for (kind, of) in [("amplitudes", false), ("impacts", true)] {
        let line = |&(method, knob): &(RockingMethod, f64)| {
            let own: Vec<&RockingPoint> = points
                .iter()
                .filter(|p| p.method == method && p.knob == knob && impact(p) == of)
                .collect();
            let mut times: Vec<f64> = own.iter().map(|p| p.seconds).collect();
            times.sort_by(f64::total_cmp);
            let time = times.get(times.len() / 2).copied()?;
            let worst = own.iter().map(|p| p.error.unwrap_or(f64::INFINITY)).fold(0.0, f64::max);
            let error = if worst.is_finite() { format!("{worst:.1e}") } else { "over 10 %".into() };
            Some(format!(
                "{:<44} greatest error {error:>9}, {} per history",
                name(method, knob),
                if time < 1e-3 { format!("{:.0} µs", 1e6 * time) } else { seconds(time) }
            ))
        };
        page.row(kind, settings(points).iter().filter_map(line));
    }
    page
}

/// Error against the time of a history, a colour for each method.
pub fn rocking_chart(points: &[RockingPoint]) -> Chart {
    let series = settings(points).into_iter().map(|(method, knob)| {
        let own = points.iter().filter(|p| p.method == method && p.knob == knob);
        let dots = own.filter_map(|p| Some((p.seconds, p.error?)));
        (name(method, knob), dots.collect())
    });
    dots("rocking blocks with exact values", "seconds per history", series)
}
