//! Which blocks may be taken out, for people.

use super::telling::{PLAIN, Telling};
use crate::{
    ReportError,
    cells::{Cell, Table},
    text::{
        options::TextOptions,
        page::{Page, Role},
    },
};
use base::number::count;
use check::{
    proof::{Answer, result::ResultFile, without::WithoutAnswer},
    verdict::Verdict,
};

pub(super) const TELLING: Telling = Telling {
    verb: "without",
    asked: |_| {
        [
            "Which blocks can be taken out, one at a time, while the rest still stands?",
            "Each block is taken out by itself; the rest has its own verdict and proof.",
        ]
    },
    title: |file| said(file).map_or(("undecided".into(), Role::Unsure), title),
    why: |page, _| {
        page.paragraph("Each block is taken out by itself, and whether the rest stands is proved. Two blocks that can each be taken out cannot always be taken out together.");
    },
    rows,
    csv: Some(csv),
    ..PLAIN
};

/// So many blocks are named in the first line, and so many that one of them carries.
const NAMES: usize = 12;

fn said(file: &ResultFile) -> Option<&WithoutAnswer> {
    match &file.answer {
        Answer::Without(a) => Some(a),
        _ => None,
    }
}

/// The first line.
fn title(a: &WithoutAnswer) -> (String, Role) {
    let all = count(a.each.len(), "block");
    let open = a.with(Verdict::Undecided).count();
    let undecided = match open {
        0 => String::new(),
        n => format!("; {n} undecided"),
    };
    match (a.removable.len(), open) {
        (0, 0) => (format!("none of {all} can be taken out"), Role::Bad),
        (0, _) => {
            (format!("for no block is it proved that it can be taken out{undecided}"), Role::Unsure)
        }
        (n, _) => {
            let names = first(&a.removable, NAMES);
            let text = format!("{n} of {all} can be taken out one at a time: {names}{undecided}");
            (text, if open > 0 { Role::Unsure } else { Role::Value })
        }
    }
}

/// Names, the first of them where they are many.
fn first(names: &[String], most: usize) -> String {
    match names.len() {
        n if n > most => format!("{}, …", names[..most].join(", ")),
        _ => names.join(", "),
    }
}

fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(a) = said(file) else { return };
    for (label, verdict) in [
        ("taken out", Verdict::Stable),
        ("falls", Verdict::Unstable),
        ("self-stress", Verdict::Conditional),
        ("undecided", Verdict::Undecided),
    ] {
        let list: Vec<&str> = a.with(verdict).map(|w| w.block.as_str()).collect();
        if !list.is_empty() {
            page.row(label, [list.join(", ")]);
        }
    }
    let carries = a.each.iter().filter(|w| !w.moving.is_empty());
    let carries: Vec<String> =
        carries.map(|w| format!("without {}: {}", w.block, first(&w.moving, NAMES))).collect();
    page.row("moves", crate::text::options::cut(&carries, NAMES, options));
    let proved = a.each.iter().filter(|w| w.left.proof.is_some()).count();
    let grade = a.proof.map_or(String::new(), |g| format!("; the weakest: {g}"));
    let all = count(a.each.len(), "verdict");
    page.row("proof", [format!("{proved} of {all} proved, each from its own blocks{grade}")]);
}

/// The blocks, a row each: the verdict on what is left, its least equilibrium error (lower and upper end,
/// g), and the blocks that move.
fn csv(file: &ResultFile) -> Result<String, ReportError> {
    let a = said(file).ok_or_else(|| ReportError::new("this is not a result of `without`"))?;
    let mut table = Table::new();
    table.write_record([
        "block",
        "verdict",
        "equilibrium_error_lower",
        "equilibrium_error_upper",
        "moving",
    ])?;
    for w in &a.each {
        let row: [Cell; 5] = [
            w.block.clone().into(),
            w.left.verdict.word().into(),
            w.left.equilibrium_error.lower.into(),
            w.left.equilibrium_error.upper.into(),
            w.moving.join("; ").into(),
        ];
        table.write_record(row)?;
    }
    Ok(table.end()?)
}
