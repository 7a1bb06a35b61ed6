//! Trains for people: where the least load factor is, and what it is elsewhere.

mod table;

use super::{
    factor, limit,
    telling::{FactorWords, PLAIN, Telling},
};
use crate::text::{
    options::{TextOptions, cut},
    page::{Page, Role},
};
use base::{
    number::{count, rounded_down, rounded_up, short},
    tolerance,
};
use check::{
    proof::{answer::FactorStatus, moving::MovingAnswer, result::ResultFile, told::Direction},
    terms::Found,
};
use model::train::{self, Position};

pub(super) const TELLING: Telling = Telling {
    verb: "limit",
    asked: |_| {
        [
            "By how much may the axle loads be multiplied, wherever the train stands?",
            "λ multiplies the axle loads of the train at its worst position; weights, fill and dead \
             loads stay as they are.",
        ]
    },
    title: |file| {
        let (text, role) = limit::title(file);
        let text = text.replace("the live load", "the axle loads");
        let (end, role) = match at_an_end(file) {
            true => ("; that is an end of its path: extend the path", Role::Unsure),
            false => ("", role),
        };
        let missed: Vec<String> = train::not_crossed(&file.scene.input)
            .iter()
            .map(|(k, _)| format!("; span {k} is not driven over: extend the path"))
            .collect();
        let role = if missed.is_empty() { role } else { Role::Unsure };
        (text + &place(file).unwrap_or_default() + end + &missed.concat(), role)
    },
    why: |page, file| {
        why(page, file);
        factor::why(page, file, LAMBDA);
    },
    rows,
    factor: Some(LAMBDA),
    csv: Some(table::csv),
    charts: |file| table::chart(file).into_iter().collect(),
    ..PLAIN
};

/// What it is called.
const LAMBDA: FactorWords = FactorWords { name: "λ", without: "without the train", tilt: false };

/// So many positions are shown.
const POSITIONS: usize = 12;

/// Where the train stands, in a few words.
pub(super) fn place(file: &ResultFile) -> Option<String> {
    let a = file.answer.moving()?;
    let way = match file.scene.input.train.as_ref().is_some_and(train::is_symmetric) {
        true => String::new(),
        false => format!(" {}", a.travel.words()),
    };
    let on = on_span(file, a).map(|words| format!(" ({words})"));
    Some(format!(" with the train at x = {}{way}{}", short(a.x), on.unwrap_or_default()))
}

/// On which span its heaviest axle stands, and where.
fn on_span(file: &ResultFile, a: &MovingAnswer) -> Option<String> {
    let spans = train::spans(&file.scene.input);
    let load = |s: &train::Standing| s.force * s.share;
    // Of axles that press alike the first.
    let heavier = |a: train::Standing, b: &train::Standing| if load(b) > load(&a) { *b } else { a };
    let (first, rest) = a.axles.split_first()?;
    let axle = rest.iter().fold(*first, heavier);
    let k = spans.iter().position(|[left, right]| *left <= axle.x && axle.x <= *right)?;
    let several = file.scene.input.train.as_ref()?.axles.len() > 1;
    let which = several.then(|| format!("axle {}", axle.axle + 1));
    let span = (spans.len() > 1).then(|| format!("span {}", k + 1));
    let place = format!("{} m from the left springing", short(axle.x - spans[k][0]));
    Some(which.into_iter().chain(span).chain([place]).collect::<Vec<_>>().join(", "))
}

/// Whether the worst position is where the path ends: then a worse one may lie beyond.
pub fn at_an_end(file: &ResultFile) -> bool {
    let (Some(a), Some(train)) = (file.answer.moving(), &file.scene.input.train) else {
        return false;
    };
    let length = (train.path[1] - train.path[0]).abs();
    train.path.iter().any(|end| (a.x - end).abs() <= 1e-9 * length)
}

/// What was asked, and what was not.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(train) = &file.scene.input.train else { return };
    let steps = train::positions(train);
    let asked = |p: &Position| {
        let at = |d: &Direction| d.answer.moving().is_some_and(|a| a.position() == *p);
        file.directions.iter().any(at)
    };
    let taken = steps.iter().filter(|p| asked(p)).count();
    let more = file.directions.len() - taken.min(file.directions.len());
    let off = match steps.len() - taken {
        0 => String::new(),
        n => format!(" At {} no axle stands on a span.", count(n, "other step")),
    };
    let ways = match train::travels(train) {
        [_] => "The train is symmetric, so both directions of travel give the same answer.",
        _ => "Both directions of travel were computed, with the train reversed.",
    };
    page.paragraph(&format!(
        "The axles of the train at its position are the live load. The answer is the least of {}: {} of {} m{}, each with its own proof.{off} Nothing is proved between them. {ways}",
        count(file.directions.len(), "position"),
        count(taken, "step"),
        short(train.step),
        if more > 0 { format!(", and {more} around the least by golden section") } else { String::new() },
    ));
    let only = |d: &&Direction| d.dry.as_ref().is_some_and(|dry| dry.found == Found::AtLeast);
    let at_least = file.directions.iter().filter(only).count();
    if at_least > 0 {
        page.paragraph(&format!(
            "With dry friction, the load factor was computed for {} where the bound is least. For the {at_least} others, the blocks were only shown to come to rest at {} × the answer (computed, not proved). --every-value computes all.",
            if file.directions.len() - at_least == 1 { "one position".into() } else { format!("{} positions", file.directions.len() - at_least) },
            1.0 - tolerance::REST_BELOW,
        ));
    }
}

/// The axles where the answer is, and the load factors of other positions.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(a) = file.answer.moving() else { return };
    let all = file.scene.input.train.as_ref().map_or(0, |t| t.axles.len());
    let axle = |s: &train::Standing| {
        let beside = match 1.0 - s.share {
            b if b > 1e-9 => {
                format!(", {:.1} % of it outside the spans and neglected", 100.0 * b)
            }
            _ => String::new(),
        };
        format!("axle {} at x = {}: {} N{beside}", s.axle + 1, short(s.x), short(s.force))
    };
    let off = (0..all).filter(|k| a.axles.iter().all(|s| s.axle != *k));
    let off = off.map(|k| format!("axle {}: not on a span", k + 1));
    page.row("train", a.axles.iter().map(axle).chain(off));
    let said: Vec<&MovingAnswer> =
        file.directions.iter().filter_map(|d| d.answer.moving()).collect();
    let both = file.scene.input.train.as_ref().is_some_and(train::is_symmetric);
    let line = |a: &&MovingAnswer| {
        let way = if both { String::new() } else { format!(" {}", a.travel.words()) };
        format!("x = {}{way}: {}", short(a.x), value(a))
    };
    // All where there is room for them, else as many, evenly spread.
    let shown: Vec<&&MovingAnswer> = match options.verbose || said.len() <= POSITIONS {
        true => said.iter().collect(),
        false => (0..POSITIONS).map(|k| &said[k * (said.len() - 1) / (POSITIONS - 1)]).collect(),
    };
    let mut lines: Vec<String> = shown.into_iter().map(line).collect();
    if lines.len() < said.len() {
        lines.push(format!("… of {} (--verbose for all)", said.len()));
    }
    page.row("positions", cut(&lines, usize::MAX - 1, options));
}

/// The load factor at a position, in words.
pub(crate) fn value(a: &MovingAnswer) -> String {
    let l = &a.load_factor;
    match (l.status, l.value, l.associative.found()) {
        (FactorStatus::Found, Some(v), Some((bound, ..))) if v == bound => {
            format!("λ = {}", rounded_down(v))
        }
        (FactorStatus::Found, Some(v), _) => {
            format!("λ = {} with dry friction", rounded_down(v))
        }
        (FactorStatus::Unbounded, ..) => "without a limit".into(),
        (FactorStatus::Impossible, ..) => "falls, whatever the train".into(),
        (FactorStatus::AtLeast, _, bound) => {
            let most = bound.map(|(.., upper)| format!(", at most {}", rounded_up(upper)));
            let least = l.lower.map(rounded_down).unwrap_or_default();
            format!("λ at least {least} with dry friction{}", most.unwrap_or_default())
        }
        (FactorStatus::NotAtRest, ..) => "moves without the train".into(),
        (_, _, Some((.., upper))) => {
            format!("λ at most {}, with dry friction undecided", rounded_up(upper))
        }
        _ => "undecided".into(),
    }
}
