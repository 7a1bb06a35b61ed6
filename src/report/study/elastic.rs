//! The study of elastic joints as a table, a chart and a page of text.

use super::{
    super::{
        cells::{Table, row},
        chart::Chart,
        text::{Layout, Page, Role},
    },
    chart::dots,
};
use base::number::seconds;
use sweep::study::{ElasticMethod, ElasticPoint};

/// A table of every point.
///
/// # Errors
/// The writer's, which has no reason to fail in memory.
pub fn elastic_csv(points: &[ElasticPoint]) -> Result<String, csv::Error> {
    let head =
        ["case", "method", "equilibrium_error", "value", "exact", "relative_error", "seconds"];
    let mut out = Table::with_head(head)?;
    for p in points {
        let knob = (p.knob > 0.0).then_some(p.knob);
        let method = p.method.label();
        out.write_record(row![p.case.clone(), method, knob, p.value, p.truth, p.error, p.seconds])?;
    }
    out.end()
}

/// Points of a method with one setting of its knob.
fn settings(points: &[ElasticPoint]) -> Vec<(ElasticMethod, f64)> {
    let mut list: Vec<(ElasticMethod, f64)> = Vec::new();
    for p in points {
        if !list.contains(&(p.method, p.knob)) {
            list.push((p.method, p.knob));
        }
    }
    list
}

fn name(method: ElasticMethod, knob: f64) -> String {
    match knob > 0.0 {
        true => format!("{}, to {knob:.0e}", method.label()),
        false => method.label().into(),
    }
}

/// What came out by kind of value, then by method.
pub fn elastic_text(points: &[ElasticPoint], layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let missed = points.iter().filter(|p| p.value.is_none()).count();
    let title = match missed {
        0 => format!("{} values", points.len()),
        _ => format!("{} values, {missed} not found", points.len()),
    };
    page.title("Elastic joints: error against run time", title, Role::Value);
    page.blank();
    for (kind, of) in [("deflections", false), ("factors", true)] {
        let line = |&(method, knob): &(ElasticMethod, f64)| {
            let own = || {
                let all = points.iter().filter(|p| p.method == method && p.knob == knob);
                all.filter(|p| p.is_factor == of)
            };
            let mut times: Vec<f64> = own().map(|p| p.seconds).collect();
            times.sort_by(f64::total_cmp);
            let time = times.get(times.len() / 2).copied()?;
            let mut errors: Vec<f64> = own().map(|p| p.error.unwrap_or(f64::INFINITY)).collect();
            errors.sort_by(f64::total_cmp);
            let said = |e: f64| if e.is_finite() { format!("{e:.1e}") } else { "none".into() };
            Some(format!(
                "{:<43} {:>7}, at most {:>7}, {}",
                name(method, knob),
                said(errors[errors.len() / 2]),
                said(errors[errors.len() - 1]),
                if time < 1e-3 { format!("{:.0} µs", 1e6 * time) } else { seconds(time) }
            ))
        };
        page.row(kind, settings(points).iter().filter_map(line));
    }
    page.paragraph("Relative errors of displacements and load factors: median and greatest over the cases. Times are medians.");
    page
}

/// Error against run time, a colour for each method.
pub fn elastic_chart(points: &[ElasticPoint]) -> Chart {
    let series = ElasticMethod::ALL.into_iter().map(|method| {
        let own = points.iter().filter(|p| p.method == method);
        let dots = own.filter_map(|p| Some((p.seconds, p.error?)));
        (method.label().to_string(), dots.collect())
    });
    dots("elastic joints with closed forms", "seconds", series)
}
