//! Studies as text and tables.

pub(crate) mod chart;
mod elastic;
mod experiments;
mod rocking;

pub use chart::{errors, profiles};
pub use elastic::{elastic_chart, elastic_csv, elastic_text};
pub use experiments::{experiments_chart, experiments_csv, experiments_text};
pub use rocking::{rocking_chart, rocking_csv, rocking_text};

use super::{
    cells::{Table, row},
    text::{Layout, Page, Role},
};
use sweep::study::{
    Omission, StudyMethod, StudyPoint,
    extreme::{CellAnswer, CellCount, CellGrade, count},
};

/// The relative error that is called an answer, in the summary and the performance profile.
pub const ANSWER: f64 = 1e-6;

/// A table of every point, comma-separated.
///
/// # Errors
/// The writer's, which has no reason to fail in memory.
pub fn csv(points: &[StudyPoint]) -> Result<String, csv::Error> {
    let mut out = Table::with_head([
        "scene",
        "method",
        "knob",
        "setting",
        "value",
        "relative_error",
        "bracket",
        "seconds",
        "iterations",
        "engine_status",
    ])?;
    for p in points {
        let status = p.status.map_or(String::new(), |s| format!("{s:?}"));
        out.write_record(row![
            p.scene.clone(),
            p.method.label(),
            p.method.knob(),
            p.knob,
            p.value,
            p.error,
            p.bracket,
            p.seconds,
            p.iterations,
            status,
        ])?;
    }
    out.end()
}

/// A table of every cell of the extreme grid.
///
/// # Errors
/// As [`csv()`].
pub fn extreme_csv(found: &[CellAnswer]) -> Result<String, csv::Error> {
    let mut out = Table::with_head([
        "family",
        "what",
        "asked",
        "grade",
        "value",
        "relative_error",
        "bracket",
        "iterations",
        "seconds",
    ])?;
    for f in found {
        out.write_record(row![
            f.family.clone(),
            f.what.clone(),
            format!("{:?}", f.ask),
            format!("{:?}", f.grade).to_lowercase(),
            f.value,
            f.error,
            f.bracket,
            f.iterations,
            f.seconds,
        ])?;
    }
    out.end()
}

/// A study as a page: per scene each method at its best, then what was silently wrong.
pub fn text(points: &[StudyPoint], layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let mut scenes: Vec<&str> = Vec::new();
    for p in points {
        if !scenes.contains(&p.scene.as_str()) {
            scenes.push(&p.scene);
        }
    }
    let wrong: Vec<&StudyPoint> = points.iter().filter(|p| p.is_silently_wrong()).collect();
    let title = format!(
        "{} runs on {} scenes, {} wrong although the engine reported success",
        points.len(),
        scenes.len(),
        wrong.len()
    );
    page.title(
        "Error against run time",
        title,
        if wrong.is_empty() { Role::Good } else { Role::Value },
    );
    page.blank();
    for scene in &scenes {
        let lines: Vec<String> = StudyMethod::ALL
            .into_iter()
            .filter_map(|method| {
                let mut own: Vec<&StudyPoint> =
                    points.iter().filter(|p| p.scene == *scene && p.method == method).collect();
                own.sort_by(|a, b| {
                    error(a).total_cmp(&error(b)).then(a.seconds.total_cmp(&b.seconds))
                });
                let best = own.first()?;
                let at = if method.knob().is_empty() {
                    String::new()
                } else {
                    format!(", {} {}", method.knob(), base::number::short(best.knob))
                };
                Some(format!(
                    "{:<28} {:>8}  {}{at}",
                    method.label(),
                    shown(best.error),
                    base::number::seconds(best.seconds)
                ))
            })
            .collect();
        page.row(scene, lines);
    }
    page.row(
        "wrong",
        wrong.iter().map(|p| {
            format!(
                "{}: {}, {} {}: error {}",
                p.scene,
                p.method.label(),
                p.method.knob(),
                base::number::short(p.knob),
                shown(p.error)
            )
        }),
    );
    page
}

/// Time saved by reductions, as a page.
pub fn omissions_text(list: &[Omission], layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let worst = list.iter().filter_map(Omission::difference).fold(0.0, f64::max);
    let compared = list.iter().filter(|o| o.difference().is_some()).count();
    let title =
        format!("{compared} of {} load factors compared, equal within {worst:.0e}", list.len());
    page.title("Time saved by reductions", title, Role::Value);
    page.blank();
    for o in list {
        let seconds = o.seconds.map(base::number::seconds);
        let same = o
            .difference()
            .map_or("one of them was not found".into(), |d| format!("answers differ by {d:.0e}"));
        let line = format!(
            "{} unknowns in {} instead of {} in {}; {same}",
            o.unknowns[0], seconds[0], o.unknowns[1], seconds[1]
        );
        page.row(&o.scene, std::iter::once(line).chain(o.left_out.iter().cloned()));
    }
    page
}

fn error(p: &StudyPoint) -> f64 {
    p.error.unwrap_or(f64::INFINITY)
}

fn shown(error: Option<f64>) -> String {
    error.map_or("none".into(), |e| format!("{e:.1e}"))
}

/// The extreme grid as a page: sums per family, then every cell without a right answer.
pub fn extreme_text(found: &[CellAnswer], verbose: bool, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let all = count(found, None);
    let role = if all.wrong > 0 { Role::Bad } else { Role::Good };
    let title = format!("{} cells, {} wrong, {} undecided", all.cells, all.wrong, all.undecided);
    page.title("Stiff and extreme scenes", title, role);
    page.blank();
    for family in ["column", "wall", "arch"] {
        page.row(family, [sums(&count(found, Some(family)))]);
    }
    page.row("all", [sums(&all)]);
    let others = |grade: CellGrade| -> Vec<String> {
        found
            .iter()
            .filter(|f| f.grade == grade)
            .map(|f| format!("{}: {}: {:?}", f.family, f.what, f.ask))
            .collect()
    };
    page.row("wrong", others(CellGrade::Wrong));
    let undecided = others(CellGrade::Undecided);
    let shown = if verbose { undecided.len() } else { undecided.len().min(6) };
    let more = (shown < undecided.len())
        .then(|| format!("… and {} more (--verbose for all)", undecided.len() - shown));
    page.row("undecided", undecided[..shown].iter().cloned().chain(more));
    page
}

fn sums(c: &CellCount) -> String {
    let share = 100.0 * c.undecided as f64 / c.cells.max(1) as f64;
    let verdicts = format!(
        "{} cells: {} right, {} undecided ({share:.1} %), {} wrong",
        c.cells, c.right, c.undecided, c.wrong
    );
    if c.load_factors == 0 {
        return format!("{verdicts}; at most {} iterations", c.iterations);
    }
    format!(
        "{verdicts}; {} of {} brackets within 1e-6, greatest error {:.1e}, at most {} iterations",
        c.narrow, c.load_factors, c.error, c.iterations
    )
}
