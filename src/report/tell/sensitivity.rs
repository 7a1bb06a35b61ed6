//! How a value changes with what was assumed, for people: the numbers that matter most, with units.

use crate::text::{options::TextOptions, page::Page};
use base::number::{count, fixed};
use check::{
    proof::result::ResultFile,
    terms::{Changing, Derivative, Law, Origin, Sensitivity},
};

/// So many numbers are always shown.
const MOST: usize = 5;

/// Rows of numbers, those that matter most first; all others for who asks for everything.
pub(crate) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(s) = &file.sensitivity else { return };
    if s.numbers.is_empty() {
        return page.row("sensitivity", ["the scene gives none of the numbers that count".into()]);
    }
    let (name, unit) = match s.of {
        Changing::LoadFactor => ("λ", ""),
        Changing::TiltDeg => ("the tilt", "°"),
        Changing::Alpha0 => ("α0", ""),
    };
    let bound = match (s.law, file.question.law()) {
        (Law::Associative, Law::Coulomb) => " (of the bound)",
        _ => "",
    };
    let head = [
        format!("change of {name}{bound}"),
        "number".into(),
        "per unit, as it falls | grows".into(),
        "per 1 %".into(),
        String::new(),
    ];
    let (first, rest) = s.numbers.split_at(MOST.min(s.numbers.len()));
    let lines = |list: &[Derivative]| list.iter().map(|d| cells(d, unit)).collect::<Vec<_>>();
    let width = widths(&head, &lines(&s.numbers));
    let line = |cells: [String; 5]| joined(&cells, &width);
    page.row("sensitivity", std::iter::once(line(head)).chain(lines(first).into_iter().map(line)));
    match options.verbose {
        true => page.row("less so", lines(rest).into_iter().map(line)),
        false if rest.is_empty() => {}
        false => page
            .row("", [format!("… and {} more that matter less (--verbose for all)", rest.len())]),
    }
    page.row("", notes(s));
}

/// What is to be known about the numbers.
fn notes(s: &Sensitivity) -> Vec<String> {
    let has = |origin| s.numbers.iter().any(|d| d.origin == origin);
    let mut notes = Vec::new();
    if has(Origin::AskedAgain) {
        notes.push("computed: asked again with the number changed, not proved".to_string());
    }
    if has(Origin::NotAsked) {
        notes.push("open: forces or mechanisms that prove the value differ in it, and it was not asked again".into());
    }
    if s.omitted > 0 {
        notes.push(format!("{} more of the scene are omitted", count(s.omitted, "number")));
    }
    notes
}

fn cells(d: &Derivative, unit: &str) -> [String; 5] {
    let value = format!("{} {}", plain(d.value), d.unit).trim_end().to_string();
    let told = |v: Option<f64>| v.map_or("–".to_string(), |v| format!("{}{unit}", plain(v)));
    let slopes = match (d.one(), d.origin) {
        (_, Origin::NotAsked) => String::new(),
        (Some(one), _) => told(Some(one)),
        (None, _) => format!("{} | {}", told(d.left), told(d.right)),
    };
    let percent = d.per_percent.map_or(String::new(), |v| format!("{}{unit}", plain(v)));
    let from = match d.origin {
        Origin::Proof => "",
        Origin::AskedAgain => "computed",
        Origin::NotAsked => "open",
    };
    [d.pointer.clone(), value, slopes, percent, from.into()]
}

/// Four digits.
fn plain(v: f64) -> String {
    let exponent = v.abs().log10().floor();
    match v {
        _ if v == 0.0 => "0".into(),
        _ if (-4.0..6.0).contains(&exponent) => {
            let text = fixed(v, (3.0 - exponent).max(0.0) as usize);
            match text.contains('.') {
                true => text.trim_end_matches('0').trim_end_matches('.').into(),
                false => text,
            }
        }
        _ => format!("{v:.3e}"),
    }
}

fn widths(head: &[String; 5], lines: &[[String; 5]]) -> [usize; 5] {
    let mut width = [0; 5];
    for cells in lines.iter().chain([head]) {
        cells.iter().zip(&mut width).for_each(|(c, w)| *w = c.chars().count().max(*w));
    }
    width
}

/// Cells side by side.
fn joined(cells: &[String; 5], width: &[usize; 5]) -> String {
    let mut text = String::new();
    for (cell, width) in cells.iter().zip(width) {
        text += &format!("{cell:<width$}  ");
    }
    text.trim_end().into()
}
