//! Mechanisms on ground that moves, as results have them.

use super::page::{Page, Role};
use base::number::{bracketed, count, fixed, point, short};
use check::proof::{
    result::ResultFile,
    rocking::{RockingAnswer, RockingFate, RockingSense},
};

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let Some(a) = file.answer.rocking() else { return ("undecided".into(), Role::Unsure) };
    let far = || format!("{} of its thickness", short((a.greatest.way / a.thickness).abs()));
    match a.fate {
        RockingFate::Overturns => (
            format!("overturns: past return at {} s", fixed(a.overturned_at.unwrap_or(0.0), 4)),
            Role::Bad,
        ),
        RockingFate::Rests if a.released_at.is_none() => ("does not move".into(), Role::Good),
        RockingFate::Rests => (format!("rocks up to {}, comes to rest", far()), Role::Good),
        RockingFate::Rocks => (format!("still rocks at the end, up to {}", far()), Role::Unsure),
    }
}

/// What it rests on.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(a) = file.answer.rocking() else { return };
    page.paragraph(
        "The mechanism that limit analysis proves, integrated through the motion of the ground. Where it starts is proved; the history is computed.",
    );
    page.blank();
    page.row("load factor", [start(a, "towards", &a.towards), start(a, "against", &a.against)]);
    let end = match &a.residual {
        Some(r) => format!("at rest or at the end of its time at {} s", fixed(r.time, 4)),
        None => "overturned".into(),
    };
    page.row("history", [format!("{}, {end}", count(a.impacts.len(), "impact"))]);
    page.row(
        "scales",
        a.flips.iter().flatten().map(|f| {
            format!(
                "overturns at {}, stands at {}",
                fixed(f.overturns_at, 6),
                fixed(f.stands_at, 6)
            )
        }),
    );
    page.row("idealised", a.idealised.iter().cloned());
    page.row("note", a.notes.iter().cloned());
}

fn start(a: &RockingAnswer, word: &str, sense: &RockingSense) -> String {
    let toward = point(a.toward);
    match sense.load_factor.found() {
        Some((value, lower, upper)) => {
            format!("{word} {toward}: moves beyond {} g", bracketed(value, lower, upper))
        }
        None => format!("{word} {toward}: nothing moves"),
    }
}
