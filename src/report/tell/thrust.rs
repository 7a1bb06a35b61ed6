//! Thrusts for people.

use super::telling::{PLAIN, Telling};
use crate::text::{
    options::{TextOptions, cut},
    page::{Page, Role},
};
use analysis::Outcome;
use base::{
    number::{bracketed, ends, fixed, point, rounded_down, rounded_up, short},
    tolerance,
};
use check::{
    proof::{
        result::ResultFile,
        thrust::{Line, ThrustAnswer, ThrustSection},
    },
    terms::Bound,
    verdict::Verdict,
};

pub(super) const TELLING: Telling = Telling {
    verb: "thrust",
    asked: |_| {
        [
            "How hard does it push a support (or pull a member), at least and at most?",
            "Newtons along the direction named. Statics alone leaves every value between the ends \
             possible; settlements and history decide which one acts.",
        ]
    },
    title,
    why,
    rows,
    ..PLAIN
};

/// An end of the range, rounded outwards.
fn value(v: &Bound, least: f64, rounded: fn(f64) -> String) -> Option<String> {
    let value = v.value?;
    // What the sections cannot tell from nothing is nothing.
    Some(format!("{} N", if value.abs() <= least { "0".into() } else { rounded(value) }))
}

/// Smaller thrusts beside what the sections carry are rounding, N.
fn resolution(file: &ResultFile) -> f64 {
    let lines =
        file.thrust.iter().flat_map(|t| &t.sections).flat_map(|s| [s.least, s.greatest]).flatten();
    0.5 * tolerance::THRUST_FLOOR * lines.map(|l| l.normal.abs()).fold(0.0, f64::max)
}

/// Whose force it is.
fn what(t: &ThrustAnswer) -> String {
    match (&t.support, &t.member) {
        (_, Some(id)) => match t.direction {
            Some(d) => format!("shear of {id} towards {}", point(d)),
            None => format!("force in {id}"),
        },
        (Some(id), None) => format!("thrust on {id}"),
        (None, None) => "thrust".into(),
    }
}

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let Some(t) = file.answer.thrust() else {
        return match file.answer.verdict() {
            Some(Verdict::Unstable) => ("falls: there is no thrust".into(), Role::Bad),
            _ => ("undecided".into(), Role::Unsure),
        };
    };
    let (what, unit) = (what(t), resolution(file));
    let text = match (
        value(&t.least, unit, rounded_down),
        value(&t.greatest, unit, rounded_up),
        t.least.status,
        t.greatest.status,
    ) {
        (Some(low), Some(high), ..) => format!("{what} from {low} to {high}"),
        (Some(low), None, _, Outcome::Unbounded) => {
            format!("{what} from {low}, without an upper limit")
        }
        (None, Some(high), Outcome::Unbounded, _) => {
            format!("{what} up to {high}, without a limit in the other direction")
        }
        (None, None, Outcome::Unbounded, Outcome::Unbounded) => {
            format!("{what} without a limit in either direction")
        }
        _ => return (format!("{what} undecided"), Role::Unsure),
    };
    (text, Role::Value)
}

/// The sentences below it.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(t) = file.answer.thrust() else { return super::assess::verdict(page, file) };
    match (&t.support, t.direction, &t.member) {
        (Some(id), Some(direction), None) => page.paragraph(&format!(
            "The thrust is the horizontal force of the blocks on {id} towards {}. Contact forces inside the friction cones reach its least value as the support gives way and its greatest as it is pushed in; the mechanisms of the two movements prove both ends.",
            point(direction)
        )),
        (_, Some(_), Some(id)) => page.paragraph(&format!(
            "The shear is the force of the dowel on the second block that it joins. Forces inside the friction cones and the strengths of the members balance the dead load with any shear of {id} in this direction from the least to the greatest; mechanisms of the scene without it, or its own strength, prove both ends."
        )),
        (.., Some(id)) => page.paragraph(&format!(
            "Forces inside the friction cones and the strengths of the members balance the dead load with any force in {id} from the least to the greatest (tension > 0); mechanisms of the scene without it, or its own strength, prove both ends."
        )),
        _ => {}
    }
    if [t.least.status, t.greatest.status].contains(&Outcome::Unbounded) {
        page.paragraph(if t.member.is_some() {
            "It has no limit where the member can stress blocks or members against each other at will."
        } else {
            "It has no limit where the blocks are wedged between supports and hold any push of one against the other."
        });
    }
    if t.member.is_none() {
        page.paragraph(&factor(t, file));
    }
    let text = match file.dead_load.as_ref().and_then(|d| d.answer.verdict()) {
        Some(Verdict::Conditional) => {
            "It stands only with self-stress: the loads do not produce such forces."
        }
        Some(Verdict::Undecided) => {
            "Whether the loads produce such forces with dry friction is undecided."
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
                "Geometric safety factor {}: a line of thrust still fits when every section is shrunk about its centroid by this factor (Heyman 1982).",
                fixed(v, base::number::decimals(v, f.lower, upper).min(6))
            ),
            _ => format!(
                "Geometric safety factor above {}: a line of thrust can pass through the middle of every section.",
                short(f.lower)
            ),
        },
        (None, Some(why)) => format!("No geometric safety factor: {why}."),
        (None, None) => "The geometric safety factor is undecided.".into(),
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
            (Outcome::Unbounded, ..) => "without a limit".into(),
            _ => "undecided".into(),
        };
        let proof = certificate.verified().into_iter().filter(|_| options.verbose);
        page.row(label, std::iter::once(text).chain(proof.map(|v| format!("  {v}"))));
    }
    for (label, line) in
        [("line, least", least as fn(&ThrustSection) -> Option<&Line>), ("greatest", greatest)]
    {
        let list: Vec<(&ThrustSection, &Line)> =
            proof.sections.iter().filter_map(|s| Some((s, line(s)?))).collect();
        page.row(label, cut(&table(&list), SECTIONS, options));
    }
    let legend = "normal and shear force, eccentricity (share of the distance to the edge), centre of pressure; kern: the whole section is compressed";
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
