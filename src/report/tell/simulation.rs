//! What happened in time, for people.

use super::telling::{PLAIN, Telling};
use crate::text::{
    options::{TextOptions, cut},
    page::{Page, Role},
};
use analysis::Agreement;
use base::{
    error::FindingCode,
    number::{count, point, seconds, short},
};
use check::{
    proof::{Simulation, result::ResultFile},
    verdict::Verdict,
};
use dynamics::{Fate, Fidelity, Run, Stop};

pub(super) const TELLING: Telling = Telling {
    verb: "simulate",
    asked: |_| {
        [
            "What happens in time?",
            "Computed by a rigid-body simulation, not proved; the verdict reported with it is proved.",
        ]
    },
    title,
    why,
    rows,
    next,
    ..PLAIN
};

/// So many blocks of a first motion are shown.
const SHOWN: usize = 4;

/// Turns below this, in degrees, are rounding.
const NO_TURN: f64 = 1e-6;

/// The answer in a line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let said = file.simulation.as_ref().and_then(|s| s.agreement.as_ref()).map(|a| a.verdict);
    match (&file.simulation, file.answer.fate()) {
        // A proof outweighs what was seen, to whoever reads this line alone too.
        (_, Some(Fate::Stands)) if said == Some(Verdict::Conditional) => {
            ("stands in the simulation, but by proof only with self-stress".into(), Role::Bad)
        }
        (_, Some(Fate::Stands)) if said == Some(Verdict::Unstable) => {
            ("stands in the simulation, but is proved to fall".into(), Role::Bad)
        }
        (Some(s), Some(Fate::Falls)) => (
            format!(
                "falls: the first block has fallen after {}",
                seconds(s.collapse.unwrap_or(f64::NAN))
            ),
            Role::Bad,
        ),
        (_, Some(Fate::Falls)) => ("falls".into(), Role::Bad),
        (_, Some(Fate::Stands)) => ("stands".into(), Role::Good),
        (Some(s), _) if not_run(s).is_some() => {
            ("undecided: not simulated, because it has dowels or grips".into(), Role::Unsure)
        }
        _ => ("undecided".into(), Role::Unsure),
    }
}

/// Why a scene was not run.
fn not_run(s: &Simulation) -> Option<&str> {
    let said = s.findings.iter().find(|f| f.code == FindingCode::LeftOut);
    said.filter(|_| s.runs.is_empty()).map(|f| f.text.as_str())
}

/// What was seen, and whether the verdict says the same.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(s) = &file.simulation else { return };
    let Some(run) = s.runs.last() else {
        return match not_run(s) {
            Some(why) => page.paragraph(&format!("Not simulated: {why}.")),
            None => page.paragraph("Simulated in time: no block is free, so nothing moves."),
        };
    };
    page.paragraph(&format!(
        "Simulated in time, with the loads applied without self-stress: {}",
        seen(s, run)
    ));
    if let Some(a) = &s.agreement {
        page.paragraph(&beside(a, s));
    }
}

fn seen(s: &Simulation, run: &Run) -> String {
    let far =
        format!("{} m, {} of its thickness", rounded(run.displacement), percent(run.relative));
    match (s.fate, run.stop) {
        (Fate::Falls, _) => format!("{} moved by {far}, and keeps moving.", run.farthest),
        (Fate::Stands, Stop::Rest) => {
            format!(
                "it came to rest within {}; no block moved farther than {} ({far}).",
                seconds(run.time),
                run.farthest
            )
        }
        (Fate::Stands, _) => format!(
            "it hardly moved in {}; {} moved farthest ({far}).",
            seconds(run.time),
            run.farthest
        ),
        (Fate::Undecided, Stop::Stopped) => {
            format!(
                "stopped after {} of {}; until then {} moved farthest ({far}).",
                seconds(run.time),
                seconds(run.horizon),
                run.farthest
            )
        }
        (Fate::Undecided, Stop::Broken) => {
            format!("the simulation diverged after {}.", seconds(run.time))
        }
        (Fate::Undecided, Stop::Rest) => {
            format!(
                "it came to rest after {}, but only after {} had moved by {far}.",
                seconds(run.time),
                run.farthest
            )
        }
        (Fate::Undecided, _) => {
            format!(
                "after {} it has neither come to rest nor fallen; {} moved farthest ({far}).",
                seconds(run.horizon),
                run.farthest
            )
        }
    }
}

fn beside(a: &Agreement, s: &Simulation) -> String {
    let verdict = match a.verdict {
        Verdict::Stable => "it stands",
        Verdict::Conditional => {
            "it stands only with self-stress that the loads do not produce, so it falls"
        }
        Verdict::Unstable => "it falls",
        Verdict::Undecided => "nothing",
    };
    let mut text = match a.agrees {
        Some(true) => format!("The verdict agrees: {verdict}."),
        Some(false) if a.verdict == Verdict::Conditional => format!(
            "The verdict disagrees: {verdict}. Both are solutions with dry friction: forces that hold the blocks exist, and so does a motion without them. Which one occurs depends on how tight the joints are; in the simulation they touched exactly and were squeezed as the blocks settled. Do not rely on it."
        ),
        Some(false) if a.verdict == Verdict::Stable => format!(
            "The verdict disagrees: {verdict}. That forces hold it is proved. That the loads produce them is computed, like this simulation, and dry friction may allow both answers. Do not rely on it; look for joints near their limit, thin blocks or large ratios of mass and size."
        ),
        Some(false) => format!(
            "The verdict disagrees: {verdict}. The proof takes precedence over the simulation; look for joints near their limit, thin blocks or large ratios of mass and size."
        ),
        None if a.verdict == Verdict::Undecided => {
            "The verdict is undecided, so there is nothing to compare with.".into()
        }
        None => format!("The verdict is that {verdict}."),
    };
    if let Some(motion) = a.motion {
        text.push_str(&format!(
            " The correlation of the first motion with the mechanism is {motion:.3}."
        ));
    }
    if let Some(f) = &a.forces {
        let why = if f.determinate { "" } else { "; equilibrium alone does not determine them" };
        text.push_str(&format!(
            " The forces between {} of blocks differ from the computed ones by {} of their size on average, and by at most {} of the largest, at {} | {}{why}.",
            count(f.pairs, "pair"),
            percent(f.mean),
            percent(f.largest),
            f.between[0],
            f.between[1]
        ));
    }
    if s.fate == Fate::Stands && s.reaction_error.is_finite() {
        let left = if s.reaction_error < 1e-6 {
            "less than 1e-6".into()
        } else {
            format!("{:.0e}", s.reaction_error)
        };
        text.push_str(&format!(" Reactions balance the loads to within {left} of the loads."));
    }
    text
}

/// First motion and runs.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(s) = &file.simulation else { return };
    let width =
        s.first_motion.iter().take(SHOWN).map(|m| m.block.chars().count()).max().unwrap_or(0);
    let moved = s.first_motion.iter().filter(|_| s.fate != Fate::Stands).map(|m| {
        let turn = m.turn.iter().map(|c| c * c).sum::<f64>().sqrt().to_degrees();
        format!(
            "{:<width$}  by {} m, rotated by {}°",
            m.block,
            point(clean(m.way)),
            if turn > NO_TURN { rounded(turn) } else { "0".into() }
        )
    });
    page.row("moves first", cut(&moved.collect::<Vec<_>>(), SHOWN, options));
    page.row("runs", s.runs.iter().map(run));
}

fn run(r: &Run) -> String {
    let fidelity = match r.fidelity {
        Fidelity::Fast => "fast",
        Fidelity::Fine => "fine",
    };
    let fate = match r.fate {
        Fate::Stands => "stands",
        Fate::Falls => "falls",
        Fate::Undecided => "undecided",
    };
    let steps =
        format!("{} of {} and {} substeps", count(r.steps, "step"), seconds(r.step), r.substeps);
    format!("{fidelity}: {steps}, {} of {}: {fate}", seconds(r.time), seconds(r.horizon))
}

/// What may come next.
pub(super) fn next(file: &ResultFile, scene: &str, again: &str) -> Vec<(String, &'static str)> {
    let mut list = Vec::new();
    if file.answer.fate() == Some(Fate::Undecided) {
        list.push((format!("{again} --fine --seconds T"), "with fine steps, for T seconds"));
    }
    if !again.contains("--load-factor") {
        list.push((format!("voussoir assess {scene}"), "the verdict, with its proof"));
    }
    list.push((format!("{again} --csv motion.csv"), "the position of every block over time"));
    list
}

fn percent(part: f64) -> String {
    format!("{} %", rounded(100.0 * part))
}

/// Without what is rounding beside the largest component.
fn clean(way: [f64; 3]) -> [f64; 3] {
    let largest = way.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    way.map(|c| if c.abs() < 1e-4 * largest { 0.0 } else { c })
}

/// Two digits: the engine knows no more.
fn rounded(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return short(value);
    }
    let digits = (1 - value.abs().log10().floor() as i32).max(0) as usize;
    if value.abs() < 1e-3 { format!("{value:.1e}") } else { format!("{value:.digits$}") }
}
