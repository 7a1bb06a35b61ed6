//! The sentences below a verdict.

use super::{
    simulation,
    telling::{PLAIN, Telling},
};
use crate::text::page::{Page, Role};
use base::{number::rounded_down, tolerance};
use check::{proof::ResultFile, terms::Law, verdict::Verdict};

pub(super) const TELLING: Telling = Telling {
    verb: "assess",
    asked: |_| {
        [
            "Does it stand under its weight and the dead loads listed below?",
            "It stands where contact forces that press, inside the friction cones and within the \
             strengths given, balance every block, and the loads produce such forces by themselves.",
        ]
    },
    title,
    why: |page, file| {
        verdict(page, file);
        simulation::why(page, file);
    },
    rows: simulation::rows,
    next: |file, scene, again| {
        let falls = matches!(file.answer.verdict(), Some(Verdict::Unstable | Verdict::Conditional));
        let first = match (falls, file.scene.input.loads.live.is_empty()) {
            (true, _) => super::telling::look(scene),
            (false, true) => (format!("voussoir tilt {scene}"), "at what tilt it falls"),
            (false, false) => (format!("voussoir limit {scene}"), "how far the live load can grow"),
        };
        std::iter::once(first).chain(super::telling::keep(again)).collect()
    },
    ..PLAIN
};

/// The verdict.
fn title(file: &ResultFile) -> (String, Role) {
    match file.answer.verdict() {
        Some(Verdict::Stable) => ("stands".into(), Role::Good),
        Some(Verdict::Conditional) => ("stands only with self-stress".into(), Role::Bad),
        Some(Verdict::Unstable) => ("falls".into(), Role::Bad),
        Some(Verdict::Undecided) | None => ("undecided".into(), Role::Unsure),
    }
}

/// Why it stands or falls.
pub(super) fn verdict(page: &mut Page, file: &ResultFile) {
    let answer = &file.answer;
    let (lower, upper) = answer
        .as_verdict()
        .map_or((0.0, f64::NAN), |a| (a.equilibrium_error.lower, a.equilibrium_error.upper));
    match answer.verdict() {
        Some(Verdict::Stable) => {
            page.paragraph("Contact forces inside all friction cones balance every block.");
            page.paragraph(settled(file));
        }
        Some(Verdict::Conditional) => {
            page.paragraph(
                "Contact forces inside all friction cones balance every block, but the loads do not produce them: the blocks would have to be stressed against each other beforehand.",
            );
            let left = file.run.state_steps.last().map_or(f64::NAN, |s| s.acceleration);
            page.paragraph(&format!(
                "Without that self-stress the motion below starts, with {left:.2} g on some block, and obeys Coulomb's law. It is not safe."
            ));
        }
        Some(Verdict::Unstable) => page.paragraph(&format!(
            "No contact forces inside the friction cones balance the loads: at best one block stays out of balance by {} of its weight. The mechanism below moves by itself, which proves it.",
            percent(lower)
        )),
        Some(Verdict::Undecided) if file.motion.is_some() && upper <= tolerance::EQUILIBRIUM_ERROR => page.paragraph(
            "Contact forces inside all friction cones balance every block. Whether the loads produce them is undecided: the state under dry friction came neither to rest nor to a motion.",
        ),
        Some(Verdict::Undecided) | None => page.paragraph(&format!(
            "The least equilibrium error lies between {lower:.1e} and {upper:.1e} of a block's weight: too close to the line between standing and falling, or the solver failed.",
        )),
    }
}

/// A share of a weight.
fn percent(share: f64) -> String {
    match 100.0 * share {
        p if p >= 0.001 => format!("{} %", rounded_down(p)),
        _ => format!("{share:.1e}"),
    }
}

/// What makes admissible forces count.
fn settled(file: &ResultFile) -> &'static str {
    let law = file.answer.as_verdict().and_then(|a| a.law);
    match (file.motion, law) {
        (Some(_), _) => {
            "With slightly elastic joints the blocks come to rest under these loads: no self-stress is needed (computed, not proved)."
        }
        (None, Some(Law::Coulomb)) => {
            "No self-stress is possible: the contacts form no closed chain."
        }
        (None, _) => {
            "The joints can carry the load; whether that needs self-stress was not asked (--law associative)."
        }
    }
}
