//! What `check` found, for people.

use super::page::{Layout, Page, Role};
use analysis::Law;
use base::{
    error::Finding,
    number::{count, short},
};
use check::proof::{Verification, result::ResultFile};
use model::{assembly::Member, interface::Model, train};
use scene::Train;

/// The verification of a result: what holds and what fails, part by part.
pub fn verification(
    name: &str,
    file: Option<&ResultFile>,
    verification: &Verification,
    layout: Layout,
) -> Page {
    let mut page = Page::new(layout);
    let answer = file.map(|f| &f.answer);
    let in_time =
        answer.is_some_and(|a| a.shaken().is_some() || a.fate().is_some() && a.verdict().is_none());
    let again = verification.unchecked().next().is_none();
    let (text, role) = match (verification.refuted(), verification.claimed) {
        (true, _) => ("refuted", Role::Bad),
        (false, _) if in_time => {
            let words = [
                "not confirmed: a second run of the engine differs, or was not made",
                "confirmed, not proved: a second run of the engine gives the same",
            ];
            (words[usize::from(again)], if again { Role::Good } else { Role::Unsure })
        }
        (false, true) => ("proved", if again { Role::Good } else { Role::Unsure }),
        (false, false) => ("claims nothing", Role::Unsure),
    };
    let bare = verification.refuted() || !verification.claimed || in_time;
    let text = if bare { text.into() } else { format!("{text}, {}", verification.grade()) };
    let law = answer.and_then(|a| a.as_verdict()).and_then(|a| a.law);
    let computed = verification.computed() && !in_time;
    let text = match law {
        Some(Law::Associative) if !verification.refuted() => {
            format!("{text}; whether self-stress is needed was not asked")
        }
        _ if computed && answer.is_some_and(|a| a.rocking().is_some()) => {
            format!("its start is {text}; its history is computed, not proved")
        }
        _ if computed && answer.is_some_and(|a| a.path().is_some()) => {
            format!("{text}, point by point; the motion between points is computed, not proved")
        }
        _ if computed => {
            format!(
                "{text}; whether states under dry friction rest or move is computed, not proved"
            )
        }
        _ => text,
    };
    let text = match file {
        Some(file) => crate::tell::under(file, text),
        None => text,
    };
    page.title(name, text, role);
    for (title, findings) in &verification.parts {
        page.blank();
        page.paragraph(title);
        page.row("fails", findings.fails.iter().cloned());
        page.row("holds", findings.holds.iter().cloned());
        page.row("undecided", findings.unchecked.iter().cloned());
    }
    if !verification.scene.is_empty() {
        page.blank();
        page.paragraph("about the scene");
        page.row("note", verification.scene.iter().map(|f| f.text.clone()));
    }
    page
}

/// A scene's likely mistakes, and what else is worth knowing about it.
pub fn inspection(
    model: &Model,
    train: Option<&Train>,
    [mistakes, notes]: [&[Finding]; 2],
    layout: Layout,
) -> Page {
    let mut page = Page::new(layout);
    match mistakes.len() {
        0 => page.title(&model.assembly.name, "nothing suspicious", Role::Good),
        n => page.title(&model.assembly.name, count(n, "finding"), Role::Bad),
    }
    page.blank();
    page.row("findings", mistakes.iter().map(|f| f.text.clone()));
    page.row("note", notes.iter().map(|f| f.text.clone()));
    let words = |m: &Member| {
        let strength = m.greatest.max(-m.least);
        let most = if strength.is_finite() {
            format!("at most {} N", short(strength))
        } else {
            "without a limit".into()
        };
        format!("{} ({}): {most}", m.id, m.kind.word())
    };
    page.row("members", model.interfaces.members.iter().map(words));
    page.row(
        "train",
        train.map(|t| {
            format!(
                "{}, {} from x = {} to {} m in steps of {} m{}: `limit` with --moving",
                count(t.axles.len(), "axle"),
                count(train::positions(t).len(), "position"),
                short(t.path[0]),
                short(t.path[1]),
                short(t.step),
                if train::is_symmetric(t) { "" } else { ", both directions of travel" }
            )
        }),
    );
    let supports = model.assembly.blocks.iter().filter(|b| b.support).count();
    let interfaces = &model.interfaces.list;
    page.row(
        "scene",
        [format!(
            "{} ({}), {}, {}{}",
            count(model.assembly.blocks.len(), "block"),
            count(supports, "support"),
            count(interfaces.len(), "interface"),
            count(model.contact_points(), "contact point"),
            super::with_members(model.interfaces.members.len())
        )],
    );
    page
}
