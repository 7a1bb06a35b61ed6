//! Critical values for people.

use super::telling::{PLAIN, Telling};
use crate::text::{
    options::{SHOWN, TextOptions, cut},
    page::{Page, Role},
};
use analysis::critical::Method;
use base::{
    number::{count, ends, rounded_down, rounded_up, short},
    tolerance,
};
use check::{
    proof::{
        critical::{CriticalResult, CriticalValue},
        result::ResultFile,
    },
    verdict::Verdict,
};

pub(super) const TELLING: Telling = Telling {
    verb: "critical",
    asked: |_| {
        [
            "At what value of a number of the scene does the verdict flip?",
            "On either side of each value the verdict is proved for a scene with that number.",
        ]
    },
    title,
    why,
    rows,
    ..PLAIN
};

/// A verdict as a verb.
fn verb(v: Verdict) -> &'static str {
    match v {
        Verdict::Stable => "stands",
        Verdict::Conditional => "stands only with self-stress",
        Verdict::Unstable => "falls",
        Verdict::Undecided => "is undecided",
    }
}

/// The last word of a pointer that is no number.
pub(super) fn name(pointer: &str) -> &str {
    let mut words = pointer.rsplit('/');
    words.find(|w| w.parse::<usize>().is_err()).filter(|w| !w.is_empty()).unwrap_or(pointer)
}

/// The ends of a flip, four digits rounded outwards where that tells them apart, else all.
fn sides(v: &CriticalValue, method: Method) -> [String; 2] {
    let near = match method {
        Method::Margin => 0.5 * tolerance::CRITICAL_WIDTH * v.value.abs(),
        Method::Halving | Method::Scan => 0.0,
    };
    let [low, high] = match method {
        Method::Scan => return [v.lower, v.upper].map(|v| v.to_string()),
        Method::Margin => [v.value - near, v.value + near],
        Method::Halving => [v.lower, v.upper],
    };
    [rounded_down(low), rounded_up(high)]
}

fn flips(file: &ResultFile) -> Vec<(CriticalValue, Method)> {
    let list = file.critical.iter().flat_map(|c| &c.flips);
    list.filter_map(|f| Some((f.proved()?, f.method))).collect()
}

fn flip(name: &str, (v, method): &(CriticalValue, Method)) -> String {
    let [low, high] = sides(v, *method);
    format!("{} up to {name} = {low}, {} from {high} on", verb(v.below), verb(v.above))
}

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let Some(c) = &file.critical else { return ("undecided".into(), Role::Unsure) };
    match (&flips(file)[..], file.critical.as_ref().and_then(CriticalResult::exhausted)) {
        ([one], _) => (flip(name(&c.vary), one), Role::Value),
        ([], Some(verdict)) => {
            (format!("{} throughout: the verdict does not flip", verb(verdict)), Role::Bad)
        }
        ([], None) => ("undecided".into(), Role::Unsure),
        (several, _) => (format!("the verdict flips {} times", several.len()), Role::Value),
    }
}

/// The sentences below it.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(c) = &file.critical else { return };
    let list = flips(file);
    if list.len() > 1 {
        list.iter().for_each(|f| page.paragraph(&format!("It {}.", flip(name(&c.vary), f))));
    }
    if list.iter().any(|(_, m)| *m == Method::Margin) {
        page.paragraph(&format!(
            "At each value the least equilibrium error reaches zero; the value is known to {:.0e} of itself. On both sides the verdict is proved as close to it as an equilibrium error of {:.0e} g can be told from zero.",
            tolerance::CRITICAL_WIDTH,
            tolerance::EQUILIBRIUM_ERROR
        ));
    }
    match file.critical.as_ref().and_then(CriticalResult::exhausted) {
        Some(verdict) => page.paragraph(&format!(
            "It {} at every value of the scan; at both ends of the range that is proved.",
            verb(verdict)
        )),
        None if list.is_empty() => page.paragraph(
            "The verdict is not the same throughout, but no flip was found with both sides proved.",
        ),
        None => {}
    }
    page.paragraph(&unseen(c));
}

/// What a scan cannot see.
fn unseen(c: &CriticalResult) -> String {
    let [a, b] = c.between;
    if c.whole && c.scan.len() as f64 > (a - b).abs() {
        return "Every whole number of the range was computed.".into();
    }
    let step = (b - a).abs() / (c.scan.len().max(2) - 1) as f64;
    format!(
        "Two flips closer together than {}, the step of the scan, may be missed; --scan and --step refine it.",
        short(step)
    )
}

/// The flips with their ends, and the scan.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(c) = &file.critical else { return };
    let sides = flips(file).into_iter().flat_map(|(v, method)| {
        let [low, high] = if method == Method::Scan {
            [v.lower.to_string(), v.upper.to_string()]
        } else {
            ends(v.value, v.lower, v.upper)
        };
        [format!("{} at {low}", verb(v.below)), format!("{} at {high}", verb(v.above))]
    });
    page.row("proved", sides);
    let tally = |wanted: Option<Verdict>| c.scan.iter().filter(|s| s.verdict == wanted).count();
    let mut words: Vec<String> =
        [Verdict::Unstable, Verdict::Conditional, Verdict::Stable, Verdict::Undecided]
            .into_iter()
            .filter(|v| tally(Some(*v)) > 0)
            .map(|v| format!("{} at {}", verb(v), tally(Some(v))))
            .collect();
    if tally(None) > 0 {
        words.push(format!("no scene at {}", tally(None)));
    }
    let [a, b] = c.between;
    page.row(
        "scan",
        [format!(
            "{} of {} from {a} to {b}: {}; {} in all",
            count(c.scan.len(), "value"),
            c.vary,
            words.join(", "),
            count(file.run.scenes, "scene")
        )],
    );
    let why = &file.run.why;
    let errors = why.no_scene.iter().map(|(value, error)| format!("{value}: {error}"));
    let open = c
        .scan
        .iter()
        .filter(|s| s.verdict == Some(Verdict::Undecided))
        .map(|s| format!("{}: undecided", s.value));
    let lines: Vec<String> = errors.chain(open).chain(why.range.iter().cloned()).collect();
    page.row("of these", cut(&lines, SHOWN, options));
    if options.verbose {
        let all = c.scan.iter().filter_map(|s| {
            Some(format!(
                "{}: {}, equilibrium error {:.3e} g",
                s.value,
                verb(s.verdict?),
                s.equilibrium_error?
            ))
        });
        page.row("values", all);
    }
}
