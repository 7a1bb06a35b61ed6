//! The sentences below a verdict.

use super::page::Page;
use base::tolerance;
use check::{proof::ResultFile, terms::Law, verdict::Verdict};

/// Why it stands or falls.
pub(super) fn verdict(page: &mut Page, file: &ResultFile) {
    let answer = &file.answer;
    let (lower, upper) =
        answer.as_verdict().map_or((0.0, f64::NAN), |a| (a.unbalance.lower, a.unbalance.upper));
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
        Some(Verdict::Undecided) if file.motion.is_some() && upper <= tolerance::UNBALANCE => page.paragraph(
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
