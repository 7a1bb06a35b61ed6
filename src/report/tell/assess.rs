//! The sentences below a verdict.

use super::{
    simulation,
    telling::{PLAIN, Telling},
};
use crate::text::page::{Page, Role};
use base::tolerance;
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
        Some(Verdict::Conditional) => ("stands only with a pre-stress".into(), Role::Bad),
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
            page.paragraph(&format!(
                "Contact forces inside every friction cone balance every block, up to {upper:.1e} of its weight."
            ));
            page.paragraph(&settled(file));
        }
        Some(Verdict::Conditional) => {
            page.paragraph(&format!(
                "Contact forces inside every friction cone balance every block, up to {upper:.1e} of its weight, but the loads do not produce them: they need a pre-stress that nobody applied."
            ));
            let left = file.run.state_steps.last().map_or(f64::NAN, |s| s.acceleration);
            page.paragraph(&format!(
                "Without it the motion below starts, with {left:.2} g on some block, and obeys Coulomb's law. It is not safe."
            ));
        }
        Some(Verdict::Unstable) => page.paragraph(&format!(
            "No contact forces inside the friction cones balance the loads: whatever they are, some block is left with at least {lower:.1e} of its weight. The mechanism below moves by itself, which proves it."
        )),
        Some(Verdict::Undecided) if file.motion.is_some() && upper <= tolerance::EQUILIBRIUM_ERROR => page.paragraph(
            "Admissible contact forces exist, but whether the loads produce them did not come out: the state under dry friction neither came to rest nor to a motion.",
        ),
        Some(Verdict::Undecided) | None => page.paragraph(&format!(
            "The least part of its weight with which some block is left lies between {lower:.1e} and {upper:.1e}; it is too close to the line between standing and falling, or the solver lost its way."
        )),
    }
}

/// What makes admissible forces count.
fn settled(file: &ResultFile) -> String {
    let law = file.answer.as_verdict().and_then(|a| a.law);
    match (file.motion, law) {
        (Some(_), _) => {
            let step = file.run.state_steps.last();
            format!(
                "The loads produce such forces by themselves: with dry friction, on contacts that yield a little, the blocks come to rest (what is left, {:.0e} g, falls with the compliance).",
                step.map_or(f64::NAN, |s| s.acceleration)
            )
        }
        (None, Some(Law::Coulomb)) => {
            "No pre-stress is possible: contacts form no closed chain.".into()
        }
        (None, _) => {
            "This says that the joints can carry the load; it does not exclude that they need a pre-stress which nobody applied.".into()
        }
    }
}
