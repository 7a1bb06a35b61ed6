//! Mechanisms on ground that moves, as results have them.

use super::telling::{PLAIN, Telling};
use crate::ground;
use crate::text::{
    options::TextOptions,
    page::{Page, Role},
};
use base::number::{count, fixed, point, rounded_down, short};
use check::proof::{
    result::ResultFile,
    rocking::{RockingAnswer, RockingFate, RockingFlip, RockingPlace, RockingSense},
};

pub(super) const TELLING: Telling = Telling {
    verb: "kinematic",
    asked: |_| {
        [
            "How does the mechanism respond to ground motion?",
            "The proved mechanism is integrated in time as a system with one degree of freedom.",
        ]
    },
    title,
    why,
    rows,
    ..PLAIN
};

/// So many impacts are listed.
const FEW: usize = 8;

/// The part of the way to the unstable equilibrium.
fn part(a: &RockingAnswer, turn: f64) -> Option<f64> {
    let sense = if turn < 0.0 { &a.against } else { &a.towards };
    Some((turn / sense.unstable?).abs())
}

/// The first line.
fn title(file: &ResultFile) -> (String, Role) {
    let Some(a) = file.answer.rocking() else { return ("undecided".into(), Role::Unsure) };
    let far = || {
        let over = short((a.greatest.way / a.thickness).abs());
        match part(a, a.greatest.turn) {
            Some(part) => {
                format!("{} of its unstable equilibrium ({over} of its thickness)", short(part))
            }
            None => format!("{over} of its thickness"),
        }
    };
    match a.fate {
        RockingFate::Overturns => (
            format!(
                "overturns: past the point of no return at {} s",
                fixed(a.overturned_at.unwrap_or(0.0), 4)
            ),
            Role::Bad,
        ),
        RockingFate::Rests if a.released_at.is_none() => ("does not move".into(), Role::Good),
        RockingFate::Rests => (format!("rocks up to {}, then comes to rest", far()), Role::Good),
        RockingFate::Rocks => (format!("still rocking at the end, up to {}", far()), Role::Unsure),
    }
}

/// What it is.
fn why(page: &mut Page, _: &ResultFile) {
    page.paragraph(
        "The mechanism proved by limit analysis is integrated through the ground motion as a system with one degree of freedom. Impacts, releases and reversals are found as roots. Motion starts where the acceleration exceeds the proved load factor.",
    );
}

/// The ground, the machine, its history.
fn rows(page: &mut Page, file: &ResultFile, _: TextOptions) {
    let Some(a) = file.answer.rocking() else { return };
    page.row("ground", [ground::words(&a.asked.ground)]);
    page.row("load factor", [start(a, "towards", &a.towards), start(a, "against", &a.against)]);
    page.row("system", [machine(a)]);
    page.row("restitution", [restitution(a)]);
    page.row("history", history(a));
    page.row("scales", a.flips.iter().flat_map(|flips| scales(a, flips)));
    page.row(
        "computed",
        [match &a.idealised {
            None => "computed, not proved: exact for rigid blocks that neither slide nor bounce".into(),
            Some(why) => format!(
                "computed, not proved, and an idealisation: {why}; `voussoir simulate --ground` simulates all blocks"
            ),
        }],
    );
    page.row("note", a.notes.iter().cloned());
}

fn start(a: &RockingAnswer, word: &str, sense: &RockingSense) -> String {
    let toward = point(a.toward);
    match sense.load_factor.found() {
        Some((value, ..)) => {
            format!("{word} {toward}: moves beyond {} g (proved)", rounded_down(value))
        }
        None => format!("{word} {toward}: nothing moves (proved)"),
    }
}

fn machine(a: &RockingAnswer) -> String {
    let frequency = a.towards.frequency.map(|p| format!("p = {} 1/s; ", short(p)));
    let unstable = a.towards.unstable.map(|q| format!("unstable at {} rad; ", short(q)));
    format!(
        "{}{}control point {} of {}, {} m thick",
        frequency.unwrap_or_default(),
        unstable.unwrap_or_default(),
        point(a.point),
        a.control,
        short(a.thickness)
    )
}

fn restitution(a: &RockingAnswer) -> String {
    let said = |a: f64, b: f64| match (a - b).abs() <= 1e-9 * a.abs() {
        true => fixed(a, 6),
        false => format!("{} and {}", fixed(a, 6), fixed(b, 6)),
    };
    let own = said(a.towards.restitution, a.against.restitution);
    match a.asked.restitution {
        Some(_) => format!(
            "{own} of the speed, as given; conservation of momentum would give {}",
            said(a.towards.conserving, a.against.conserving)
        ),
        None => format!("{own} of the speed, by conservation of momentum (no bounce)"),
    }
}

fn history(a: &RockingAnswer) -> Vec<String> {
    let mut rows = Vec::new();
    if a.asked.from != 0.0 {
        rows.push(format!("begins at {} of the unstable equilibrium", short(a.asked.from)));
    }
    rows.extend(a.released_at.map(|t| format!("released at {} s", fixed(t, 4))));
    let place = |word: &str, p: &RockingPlace| {
        let part = part(a, p.turn)
            .map_or(String::new(), |p| format!(", {} of the unstable equilibrium", short(p)));
        format!(
            "{word} at {} s: {} m, {} of the thickness{part}",
            fixed(p.time, 4),
            short(p.way),
            short(p.way / a.thickness)
        )
    };
    rows.extend((a.greatest.turn != 0.0).then(|| place("greatest", &a.greatest)));
    rows.extend(a.residual.as_ref().map(|p| place("residual", p)));
    if !a.impacts.is_empty() {
        let first = a.impacts.iter().take(FEW).map(|i| fixed(i.time, 4));
        let more = if a.impacts.len() > FEW { ", …" } else { "" };
        let times = first.collect::<Vec<_>>().join(", ");
        rows.push(format!("{} at {times}{more} s", count(a.impacts.len(), "impact")));
    }
    rows
}

fn scales(a: &RockingAnswer, flips: &[RockingFlip]) -> Vec<String> {
    let flip = |f: &RockingFlip| {
        let [over, stands] = [f.overturns_at, f.stands_at].map(|v| fixed(v, 6));
        format!("overturns at {over}, stands at {stands}")
    };
    let [from, to] = a.asked.scan.unwrap_or_default().map(short);
    let said = format!(
        "scales between {from} and {to}: stronger shaking may be less harmful, and changes closer together than the step of the scan may be missed"
    );
    flips.iter().map(flip).chain([said]).collect()
}
