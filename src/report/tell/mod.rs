//! How answers are told: of every question its words, its table and its charts, a value of one type
//! (`Telling`) in one file or folder. What shows them matches on no question.

mod assess;
mod charts;
mod combinations;
mod critical;
mod factor;
mod kinematic;
mod limit;
mod meet;
pub(crate) mod moving;
pub mod path;
mod rocking;
pub(crate) mod sensitivity;
mod shaken;
mod simulation;
mod stages;
pub(crate) mod state;
mod telling;
mod thrust;
mod tilt;
mod without;

pub use charts::{attempts, heaps};
pub use moving::at_an_end;

use crate::{
    ReportError,
    chart::Chart,
    text::{
        left_out::left_out,
        options::TextOptions,
        page::{Page, Role},
    },
};
use base::error::FindingCode;
use check::{
    proof::{Answer, result::ResultFile},
    question::QuestionKind,
};
use telling::{Telling, look, words_of};

/// How the answers to the question of a result are told.
pub(crate) fn telling(file: &ResultFile) -> &'static Telling {
    match file.question.kind() {
        QuestionKind::Assess => &assess::TELLING,
        QuestionKind::Limit => &limit::TELLING,
        QuestionKind::Moving => &moving::TELLING,
        QuestionKind::Tilt | QuestionKind::Repose => &tilt::TELLING,
        QuestionKind::Critical => &critical::TELLING,
        QuestionKind::Thrust => &thrust::TELLING,
        QuestionKind::Simulate => &simulation::TELLING,
        QuestionKind::Settle => &path::SETTLE,
        QuestionKind::Push => &path::PUSH,
        QuestionKind::Kinematic => &kinematic::TELLING,
        QuestionKind::Stages => &stages::TELLING,
        QuestionKind::Without => &without::TELLING,
        QuestionKind::State => &state::TELLING,
        QuestionKind::Rock => &rocking::TELLING,
        QuestionKind::Shake => &shaken::TELLING,
        QuestionKind::Combinations => &combinations::TELLING,
        QuestionKind::Meet => &meet::TELLING,
    }
}

/// The table of a result: of its curve, its stages, its positions.
///
/// # Errors
/// The answer to its question has none.
pub fn csv(file: &ResultFile) -> Result<String, ReportError> {
    match telling(file).csv {
        Some(csv) => csv(file),
        None => Err(ReportError::new("this question has no table of its own")),
    }
}

/// The charts of a result: what `--chart` writes, and pages show.
pub fn charts(file: &ResultFile) -> Vec<Chart> {
    (telling(file).charts)(file)
}

/// The first line: the answer, and what weakens it to whoever reads nothing else.
pub(crate) fn title(page: &mut Page, file: &ResultFile) {
    let (mut text, mut role) = (telling(file).title)(file);
    if let Some(words) =
        telling(file).factor.and_then(|words| factor::without_live_load(file, words))
    {
        (text, role) = (format!("{text}; {words}"), Role::Bad);
    }
    // Then that something falls is no answer.
    if let Some(open) = file.scene_warnings.iter().find(|f| f.code == FindingCode::Unjoined) {
        (text, role) = (open.text.clone(), Role::Bad);
    }
    if let Some(words) = flattened(file) {
        text = format!("{text}{words}");
    }
    if let Some(id) = file.in_balance.first() {
        let more = match file.in_balance.len() {
            1 => String::new(),
            n => format!(" ({} more alike)", n - 1),
        };
        text = format!(
            "{text}, in unstable balance: {id} stands on an edge or a point and bears no push{more}"
        );
        role = if role == Role::Good { Role::Unsure } else { role };
    }
    if let Some(words) = left_out(file) {
        role = if role == Role::Good { Role::Unsure } else { role };
        text = format!("{text}; {words}");
    }
    if let Some(words) = required(file) {
        role = match file.required.and_then(|r| r.met) {
            Some(true) => role,
            Some(false) => Role::Bad,
            None => Role::Unsure,
        };
        text = format!("{text}; {words}");
    }
    if let Some(doubt) = &file.run.doubt {
        text = format!("{text}: {}; {}", doubt.evidence, doubt.next);
    }
    page.title(&file.scene.name, under(file, text), role);
}

/// What was required, and whether it is there.
pub(crate) fn required(file: &ResultFile) -> Option<String> {
    file.required.map(words_of)
}

/// What an answer rests on where edges and corners meet with several normals. Why one is undecided
/// is said by its doubt.
fn flattened(file: &ResultFile) -> Option<String> {
    let [a, b] = file.flattened.first()?;
    match file.flattened.len() {
        _ if file.run.doubt.is_some() => None,
        1 => Some(format!(" (edge of {a} and {b} flattened)")),
        n => Some(format!(" ({n} edges and corners flattened, e.g. that of {a} and {b})")),
    }
}

/// What is said with the contact tolerances that it rests on, where the scene has widened them.
pub(crate) fn under(file: &ResultFile, text: impl std::fmt::Display) -> String {
    match file.scene.input.contact.widened() {
        Some(words) => format!("{text} (contact tolerances widened by the scene: {words})"),
        None => text.to_string(),
    }
}

/// The value with all digits that are known.
pub(crate) fn digits(page: &mut Page, file: &ResultFile, options: TextOptions) {
    factor::digits(page, file, options);
}

/// The part of the scene that decides.
pub(crate) fn part(page: &mut Page, file: &ResultFile) {
    factor::part(page, file);
}

/// Commands that may come next.
pub(crate) fn next(file: &ResultFile, scene: &str, again: &str) -> Vec<(String, &'static str)> {
    let seen = matches!(file.question.kind(), QuestionKind::Simulate | QuestionKind::Shake);
    let known = file.critical.is_some()
        || file.thrust.is_some()
        || matches!(file.answer, Answer::Meet(_))
        || file.stages.is_some()
        || file.answer.proof().is_some()
        || file.answer.path().is_some_and(|a| a.value.is_some());
    if !seen && file.certificate.claim.is_none() && !known {
        return vec![look(scene), (format!("{again} --verbose"), "every attempt")];
    }
    (telling(file).next)(file, scene, again)
}
