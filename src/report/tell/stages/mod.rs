//! Stages of construction for people: the worst first.

mod table;

use super::telling::{PLAIN, Telling};
use crate::text::{
    options::{TextOptions, cut},
    page::{Page, Role},
};
use base::number::{count, point, rounded_down, short};
use check::{
    proof::{
        answer::{FactorStatus, LoadFactorAnswer},
        result::ResultFile,
        stages::{LeastMargin, StageResult, StagesAnswer, StagesResult},
    },
    terms::Order,
    verdict::Verdict,
};

pub(super) const TELLING: Telling = Telling {
    verb: "stages",
    asked: |file| match file.stages.as_ref().and_then(|s| s.order.as_ref()) {
        Some(order) => asked_of_order(order.given),
        None => [
            "Does every stage of the construction stand?",
            "Every stage is a separate scene, with its own verdict and proof.",
        ],
    },
    title,
    why,
    rows,
    csv: Some(table::csv),
    charts: |file| table::chart(file).into_iter().collect(),
    ..PLAIN
};

/// Of an order in which blocks are placed.
fn asked_of_order(given: bool) -> [&'static str; 2] {
    let question = match given {
        true => "How many blocks must be held at once to build it in the order given?",
        false => "In which order can it be built with the fewest blocks held at once?",
    };
    let meaning = "Every stage is a separate scene, with its own verdict and proof. That fewer held blocks are \
         not enough comes from a search, not from a proof.";
    [question, meaning]
}

/// So many stages are listed, and so many names.
const STAGES: usize = 24;
const NAMES: usize = 12;

fn said(file: &ResultFile) -> Option<(&StagesAnswer, &StagesResult)> {
    file.answer.stages().zip(file.stages.as_ref())
}

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let Some((a, result)) = said(file) else { return ("undecided".into(), Role::Unsure) };
    if let Some(order) = &result.order {
        return ordered(a, order);
    }
    let before = match a.stand_first {
        0 => "no stage before it stands".to_string(),
        n => format!("the first {n} of {} stand", a.stages),
    };
    match a.verdict {
        Verdict::Unstable => (format!("falls at {}; {before}", a.worst), Role::Bad),
        Verdict::Conditional => {
            (format!("stands only with self-stress at {}; {before}", a.worst), Role::Bad)
        }
        Verdict::Undecided => (format!("undecided at {}; {before}", a.worst), Role::Unsure),
        Verdict::Stable => {
            let least = [
                a.least_load_factor
                    .as_ref()
                    .map(|l| least(l, "the least load factor", ["λ = ", ""])),
                a.least_tilt_deg.as_ref().map(|l| least(l, "the least tilt", ["", "°"])),
            ];
            let least: Vec<String> = least.into_iter().flatten().collect();
            let all = match a.stages {
                1 => "stands at its only stage".to_string(),
                n => format!("stands at all {n} stages"),
            };
            (std::iter::once(all).chain(least).collect::<Vec<_>>().join("; "), Role::Good)
        }
    }
}

/// The first line about an order.
fn ordered(a: &StagesAnswer, order: &Order) -> (String, Role) {
    let least = order.least_held;
    let open = match (a.most_held, least) {
        (Some(_), _) if a.verdict == Verdict::Stable => None,
        (Some(_), _) => Some(format!("undecided at {}", a.worst)),
        (None, 0) => Some("no order was found".into()),
        (None, n) => Some(format!("no order was found; with fewer than {n} held none exists")),
    };
    if let Some(open) = open {
        return match a.hands_do() {
            Some(false) => (hands(a, open), Role::Bad),
            _ => (open, Role::Unsure),
        };
    }
    let most = a.most_held.unwrap_or_default();
    let this = if order.given { "in the order given" } else { "in the order below" };
    let with = match most {
        0 => "with no block held".into(),
        n => format!("with {} held at once", count(n, "block")),
    };
    let fewer = match (most, order.given) {
        (0, _) => "",
        (n, true) if n == least => "; fewer are not enough",
        (n, false) if n == least => "; no order needs fewer",
        (_, true) => "; undecided whether fewer are enough",
        (_, false) => "; undecided whether another order needs fewer",
    };
    let text = format!("stands at every stage {this} {with}{fewer}");
    match a.hands_do() {
        Some(true) => (text, Role::Good),
        Some(false) => (hands(a, text), Role::Bad),
        None => (hands(a, text), Role::Unsure),
    }
}

/// What can be held, and what has to be.
fn hands(a: &StagesAnswer, text: String) -> String {
    match (a.hands, a.hands_do()) {
        (Some(n), Some(false)) => format!("cannot be built with {n} held at once: {text}"),
        (Some(n), _) => format!("undecided whether {n} held at once are enough: {text}"),
        (None, _) => text,
    }
}

/// A least margin in words.
fn least(l: &LeastMargin, what: &str, [sign, unit]: [&str; 2]) -> String {
    match (l.status, l.value) {
        (FactorStatus::Found, Some(v)) => {
            format!("{what} {sign}{}{unit} at {}", rounded_down(v), l.stage)
        }
        (FactorStatus::Unbounded, _) => format!("{what}: without a limit"),
        _ => format!("{what} undecided at {}", l.stage),
    }
}

/// The sentences below it.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some((_, result)) = said(file) else { return };
    if let Some(order) = &result.order {
        page.paragraph(&format!("Blocks are placed one after the other in their final positions, and held blocks do not move; every stage has its proof. How a block reaches its place, and what is held between two stages, is not analysed. That fewer held blocks are not enough comes from a search (up to {} sets of blocks), not from a proof: a mechanism persists until one of its moving blocks is held.", order.tries));
    }
    page.paragraph(
        "Every stage is a separate scene with its own proof: its blocks, its loads and what is held. Blocks are rigid and stand where the scene places them; settlements during earlier stages are not included.",
    );
    if result.list.iter().any(|s| s.margin.is_some()) {
        page.paragraph("Margins are load factors where a stage has live loads, otherwise the least tilt at which it falls.");
    }
    if result.list.iter().any(|s| !s.least_forces.is_empty()) {
        page.paragraph("The holding forces listed are minima, each found by itself: with less, no contact forces balance the held block and all that leans on it.");
    }
}

/// The stages, what is held, and the worst in full.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some((a, result)) = said(file) else { return };
    if let Some(worst) = result.list.iter().find(|s| s.name == a.worst) {
        let known = a.verdict != Verdict::Stable || worst.margin.is_some();
        if known {
            page.row("worst", [line(worst)]);
        }
        if let Some(m) = &worst.verdict.mechanism {
            let moving = match m.moving.len() {
                n if n > NAMES => format!("{}, … ({n} in all)", m.moving[..NAMES].join(", ")),
                _ => m.moving.join(", "),
            };
            page.row("moves", [moving]);
        }
    }
    if let Some(order) = &result.order {
        let placed: Vec<&str> = order.placed.iter().map(|p| p.block.as_str()).collect();
        page.row("order", [placed.join(", ")]);
    }
    let lines: Vec<String> = result.list.iter().map(line).collect();
    page.row("stages", cut(&lines, STAGES, options));
    let held = result.list.iter().flat_map(|s| {
        let touching = |id: &&String| s.least_forces.iter().any(|h| h.block == **id);
        s.held.iter().filter(touching).map(move |id| (s, id))
    });
    let held: Vec<String> = held.map(|(s, id)| holds(s, id)).collect();
    page.row("held with", cut(&held, NAMES, options));
    let proved = result.list.iter().filter(|s| s.verdict.certificate.claim.is_some()).count();
    let grade = a.proof.map_or(String::new(), |g| format!("; the weakest: {g}"));
    let text = format!(
        "{proved} of {} proved, each from its own blocks{grade}",
        count(a.stages, "verdict")
    );
    page.row("proof", [text]);
}

/// A stage in one line.
fn line(s: &StageResult) -> String {
    let verdict = match s.stands() {
        Verdict::Stable => "stands",
        Verdict::Conditional => "stands only with self-stress",
        Verdict::Unstable => "falls",
        Verdict::Undecided => "undecided",
    };
    let margin = s.load_factor().map(|l| margin(l, "λ =", ""));
    let margin =
        margin.or_else(|| s.tilt_deg().map(|l| self::margin(l, "falls at a tilt of", "°")));
    let held = match s.held.len() {
        0 => String::new(),
        n if n > NAMES => format!(", {n} blocks held"),
        _ => format!(", {} held", s.held.join(", ")),
    };
    let why = || s.no_margin.as_ref().map(|why| format!("no margin: {why}"));
    let margin = margin.or_else(why).map_or(String::new(), |m| format!(", {m}"));
    format!("{}: {verdict}{margin} ({}{held})", s.name, count(s.blocks, "block"))
}

fn margin(l: &LoadFactorAnswer, what: &str, unit: &str) -> String {
    match (l.status, l.value, l.lower, l.upper) {
        (FactorStatus::Found, Some(v), Some(low), Some(high))
            if low <= v && v <= high && high - low < 1e-5 * v.abs() =>
        {
            format!("{what} {}{unit}", rounded_down(v))
        }
        (FactorStatus::Found, Some(v), ..) => format!("{what} {}{unit}", rounded_down(v)),
        (FactorStatus::Unbounded, ..) => "margin without a limit".into(),
        (FactorStatus::NotAtRest, ..) => "moves under the dead load with dry friction".into(),
        (FactorStatus::Impossible, ..) => "falls whatever the load".into(),
        (_, _, Some(low), _) if low > 0.0 => {
            format!("margin undecided, stands up to {}{unit} at least", rounded_down(low))
        }
        _ => "margin undecided".into(),
    }
}

/// What holds a block at least, in words.
fn holds(s: &StageResult, id: &str) -> String {
    let forces = s.least_forces.iter().filter(|h| h.block == id).map(|h| {
        let against =
            if h.weight > 0.0 { "up".into() } else { format!("against {}", point(h.direction)) };
        match h.needed {
            Some(v) => format!("{against} with {} N", short(v)),
            None => format!("{against} undecided"),
        }
    });
    format!("{}: {id} {}", s.name, forces.collect::<Vec<_>>().join(", "))
}
