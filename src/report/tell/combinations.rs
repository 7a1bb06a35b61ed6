//! Answers in every combination of actions, for people.

use super::telling::{PLAIN, Telling, words_of};
use crate::{
    ReportError,
    cells::{Cell, Table},
    text::{
        options::{TextOptions, cut},
        page::{Page, Role},
    },
};
use base::number::{count, rounded_down};
use check::{
    proof::{
        Answer,
        answer::{FactorStatus, LoadFactorAnswer},
        combinations::{CombinationsAnswer, InCombination},
        result::ResultFile,
    },
    question::Question,
    verdict::Verdict,
};

pub(super) const TELLING: Telling = Telling {
    verb: "combinations",
    asked: |_| {
        [
            "What is the answer in every combination of actions, with its partial factors?",
            "Loads are multiplied and strengths divided by the factors of each combination; λ \
             multiplies the factored live load.",
        ]
    },
    title: |file| said(file).map_or(("undecided".into(), Role::Unsure), title),
    why: |page, _| {
        page.paragraph("Each combination is a scene of its own with its own proof. The worst governs: what is not met before what is undecided, then the least value.");
    },
    rows,
    csv: Some(csv),
    ..PLAIN
};

fn said(file: &ResultFile) -> Option<&CombinationsAnswer> {
    match &file.answer {
        Answer::Combinations(a) => Some(a),
        _ => None,
    }
}

/// The first line.
fn title(a: &CombinationsAnswer) -> (String, Role) {
    let Some(worst) = a.worst() else { return ("undecided".into(), Role::Unsure) };
    let of = match a.list.len() {
        1 => String::new(),
        n => format!(", the worst of {}", count(n, "combination")),
    };
    let role = match a.holds() {
        Some(true) => Role::Good,
        Some(false) => Role::Bad,
        None => Role::Unsure,
    };
    (format!("{}: {}{of}", worst.name, words(worst)), role)
}

/// An answer in a few words, with what is required of it.
fn words(c: &InCombination) -> String {
    let own = match &c.own.answer {
        Answer::Tilt(t) => format!("tilt {}°", value(&t.tilt_deg)),
        Answer::Kinematic(k) => format!("α0 = {}", value(&k.alpha0)),
        answer => match (answer.load_factor(), answer.verdict()) {
            (Some(l), _) => format!("λ = {}", value(l)),
            (None, Some(verdict)) => verdict_words(verdict).to_string(),
            (None, None) => "undecided".into(),
        },
    };
    let place = c
        .own
        .answer
        .moving()
        .map(|m| format!(" with the train at x = {}", base::number::short(m.x)));
    let falls = c.own.answer.load_factor().and(c.own.answer.verdict());
    let falls = match falls {
        Some(Verdict::Unstable) => "; without that load it falls",
        Some(Verdict::Conditional) => "; without that load it stands only with self-stress",
        _ => "",
    };
    let required = c.own.required.map(|r| format!(", {}", words_of(r)));
    format!("{own}{}{falls}{}", place.unwrap_or_default(), required.unwrap_or_default())
}

fn verdict_words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stands",
        Verdict::Unstable => "falls",
        Verdict::Conditional => "stands only with self-stress",
        Verdict::Undecided => "undecided",
    }
}

/// A load factor or a tilt, on the safe side.
fn value(l: &LoadFactorAnswer) -> String {
    match (l.status, l.value) {
        (_, Some(value)) => rounded_down(value),
        (FactorStatus::Unbounded, _) => "no limit".into(),
        (FactorStatus::Impossible | FactorStatus::NotAtRest, _) => "none".into(),
        _ => match l.lower.filter(|v| *v > 0.0) {
            Some(lower) => format!("{} at least, undecided beyond", rounded_down(lower)),
            None => "undecided".into(),
        },
    }
}

fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(a) = said(file) else { return };
    let line = |c: &&InCombination| format!("{}: {}", c.name, words(c));
    let lines: Vec<String> = a.ordered().iter().map(line).collect();
    page.row("combination", cut(&lines, MOST, options));
    let factors = |c: &&InCombination| {
        let source = if c.source.is_empty() { String::new() } else { format!(" ({})", c.source) };
        let own = scene::Factors {
            actions: c.factors.clone(),
            materials: c.materials.clone(),
            source: String::new(),
        };
        format!("{}: {}{source}", c.name, own.words())
    };
    let lines: Vec<String> = a.ordered().iter().map(factors).collect();
    page.row("factors", cut(&lines, MOST, options));
    let proved = a.list.iter().filter(|c| c.own.answer.proof().is_some()).count();
    let grade = a.proof.map_or(String::new(), |g| format!("; the weakest: {g}"));
    page.row(
        "proof",
        [format!(
            "{proved} of {} proved, each from its own scene{grade}",
            count(a.list.len(), "answer")
        )],
    );
}

/// So many combinations are listed.
const MOST: usize = 12;

/// The combinations, the worst first: values with their ends, what is required, factors.
fn csv(file: &ResultFile) -> Result<String, ReportError> {
    let a = said(file).ok_or_else(|| ReportError::new("this is not a result of `combinations`"))?;
    let mut table = Table::new();
    table.write_record([
        "combination",
        "value",
        "lower",
        "upper",
        "bound",
        "verdict",
        "required",
        "met",
        "x",
        "factors",
        "source",
    ])?;
    let tilt =
        matches!(&file.question, Question::Combinations(o) if matches!(*o.ask, Question::Tilt(_)));
    for c in a.ordered() {
        let l = match &c.own.answer {
            Answer::Tilt(t) if tilt => Some(&t.tilt_deg),
            answer => answer.load_factor(),
        };
        let met = c.own.holds().map_or("undecided", |met| if met { "yes" } else { "no" });
        let own = scene::Factors {
            actions: c.factors.clone(),
            materials: c.materials.clone(),
            source: String::new(),
        };
        let row: [Cell; 11] = [
            c.name.clone().into(),
            l.and_then(|l| l.value).into(),
            l.and_then(|l| l.lower).into(),
            l.and_then(|l| l.upper).into(),
            l.and_then(|l| l.associative.value).into(),
            c.own.answer.verdict().map_or("", Verdict::word).into(),
            c.own.required.map(|r| r.least).into(),
            met.into(),
            c.own.answer.moving().map(|m| m.x).into(),
            own.words().into(),
            c.source.clone().into(),
        ];
        table.write_record(row)?;
    }
    Ok(table.end()?)
}
