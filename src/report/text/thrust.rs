//! Thrusts for people.

use super::{
    TextOptions, cut,
    page::{Page, Role},
};
use crate::{
    analysis::Outcome,
    number::{bracketed, ends, fixed, point, short},
    proof::{
        result::ResultFile,
        thrust::{Line, ThrustAnswer, ThrustSection, ThrustValue},
    },
    tolerance,
    verdict::Verdict,
};

fn value(v: &ThrustValue, least: f64) -> Option<String> {
    let (value, lower, upper) = (v.value?, v.lower?, v.upper?);
    Some(format!("{} N", bracketed(value, lower.min(value - least), upper.max(value + least))))
}

/// Smaller thrusts beside what the sections carry are rounding, N.
fn resolution(file: &ResultFile) -> f64 {
    let lines =
        file.thrust.iter().flat_map(|t| &t.sections).flat_map(|s| [s.least, s.greatest]).flatten();
    0.5 * tolerance::THRUST_FLOOR * lines.map(|l| l.normal.abs()).fold(0.0, f64::max)
}

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let Some(t) = file.answer.thrust() else {
        return match file.answer.verdict() {
            Some(Verdict::Unstable) => ("falls, so there is no thrust".into(), Role::Bad),
            _ => ("undecided".into(), Role::Unsure),
        };
    };
    let (id, unit) = (&t.support, resolution(file));
    let text = match (
        value(&t.least, unit),
        value(&t.greatest, unit),
        t.least.status,
        t.greatest.status,
    ) {
        (Some(low), Some(high), ..) => format!("thrust on {id} from {low} to {high}"),
        (Some(low), None, _, Outcome::Unbounded) => {
            format!("thrust on {id} from {low} without end")
        }
        (None, Some(high), Outcome::Unbounded, _) => {
            format!("thrust on {id} up to {high}, in the other direction without end")
        }
        (None, None, Outcome::Unbounded, Outcome::Unbounded) => {
            format!("thrust on {id} without end in both directions")
        }
        _ => return (format!("thrust on {id} undecided"), Role::Unsure),
    };
    (text, Role::Value)
}

/// The sentences below it.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(t) = file.answer.thrust() else { return super::answer::verdict(page, file) };
    page.paragraph(&format!(
        "The thrust is the horizontal force of the blocks on {} towards {}. Contact forces inside the friction cones reach its least value when the support yields and its greatest when it is pushed in; the mechanisms of the two movements prove that no others go further.",
        t.support,
        point(t.direction)
    ));
    if [t.least.status, t.greatest.status].contains(&Outcome::Unbounded) {
        page.paragraph("Where it has no end, the blocks are wedged between supports: they hold any push of one against the other.");
    }
    page.paragraph(&factor(t, file));
    let text = match file.dead_load.as_ref().and_then(|d| d.answer.verdict()) {
        Some(Verdict::Conditional) => {
            "It stands only with a pre-stress that nobody applied: the loads do not produce such forces."
        }
        Some(Verdict::Undecided) => {
            "Whether the loads produce such forces with dry friction stayed undecided."
        }
        _ => return,
    };
    page.paragraph(text);
}

fn factor(t: &ThrustAnswer, file: &ResultFile) -> String {
    let why = file.thrust.as_ref().and_then(|t| t.without_factor.as_deref());
    match (t.geometric_factor, why) {
        (Some(f), _) => match (f.value, f.upper) {
            (Some(v), Some(upper)) => format!(
                "Geometric safety factor {}: all sections can be shrunk about their centroids by this and still hold a line of thrust (Heyman 1982).",
                fixed(v, crate::number::decimals(v, f.lower, upper).min(6))
            ),
            _ => format!(
                "Geometric safety factor above {}: lines of thrust pass as close to the middle of every section as one likes.",
                short(f.lower)
            ),
        },
        (None, Some(why)) => format!("No geometric safety factor: {why}."),
        (None, None) => "No geometric safety factor came out.".into(),
    }
}

/// So many sections are shown of each line.
const SECTIONS: usize = 4;

/// Both ends, their proofs and the sections.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let (Some(t), Some(proof)) = (file.answer.thrust(), &file.thrust) else { return };
    for (label, v, certificate) in
        [("least", &t.least, &proof.least), ("greatest", &t.greatest, &proof.greatest)]
    {
        let text = match (v.status, v.value, v.lower, v.upper) {
            (Outcome::Found, Some(value), Some(lower), Some(upper)) => {
                let unit = resolution(file);
                let (lower, upper) = (lower.min(value - unit), upper.max(value + unit));
                let [low, high] = ends(value, lower, upper);
                format!("{} N, between {low} and {high} N", bracketed(value, lower, upper))
            }
            (Outcome::Unbounded, ..) => "without end".into(),
            _ => "undecided".into(),
        };
        page.row(
            label,
            std::iter::once(text).chain(certificate.verified.iter().map(|v| format!("  {v}"))),
        );
    }
    for (label, line) in
        [("line, least", least as fn(&ThrustSection) -> Option<&Line>), ("greatest", greatest)]
    {
        let list: Vec<(&ThrustSection, &Line)> =
            proof.sections.iter().filter_map(|s| Some((s, line(s)?))).collect();
        page.row(label, cut(&table(&list), SECTIONS, options));
    }
    let legend = "normal and shear force, eccentricity (of the way to the edge), centre of pressure; kern: the whole section presses";
    if !proof.sections.is_empty() {
        page.row("", [legend.to_string()]);
    }
}

/// One line a section: normal and shear force, eccentricity with the share of the section used,
/// centre of pressure, where it lies.
fn table(list: &[(&ThrustSection, &Line)]) -> Vec<String> {
    let body = list.iter().map(|(s, l)| {
        let [normal, shear, e, at, place] = columns(l);
        [name(s), normal, shear, e, at, place]
    });
    let rows: Vec<[String; 6]> = body.collect();
    let width: Vec<usize> =
        (0..6).map(|k| rows.iter().map(|r| r[k].chars().count()).max().unwrap_or(0)).collect();
    let line = |r: &[String; 6]| {
        let cells: Vec<String> = r.iter().zip(&width).map(|(c, w)| format!("{c:<w$}")).collect();
        cells.join("  ").trim_end().to_string()
    };
    rows.iter().map(line).collect()
}

fn least(s: &ThrustSection) -> Option<&Line> {
    s.least.as_ref()
}

fn greatest(s: &ThrustSection) -> Option<&Line> {
    s.greatest.as_ref()
}

fn name(s: &ThrustSection) -> String {
    format!("{} | {}", s.between[0], s.between[1])
}

/// Number by number, in columns.
fn columns(l: &Line) -> [String; 5] {
    let place = match (l.inside, l.used >= 1.0 - tolerance::AT_EDGE, l.in_kern) {
        (false, ..) => "outside",
        (_, true, _) => "hinge",
        (_, _, true) => "kern",
        _ => "inside",
    };
    let share = format!("{} m ({:.1} %)", short(l.eccentricity), 100.0 * l.used);
    [
        format!("{} N", short(l.normal)),
        format!("{} N", short(l.shear)),
        share,
        point(l.at),
        place.into(),
    ]
}
