//! All blocks on ground that moved, as results have them.

use super::telling::{PLAIN, Telling};
use crate::ground;
use crate::text::{
    options::TextOptions,
    page::{Page, Role},
};
use base::number::{count, fixed, seconds, short};
use check::{
    proof::{
        result::ResultFile,
        shaken::{ShakenAnswer, ShakenWord},
    },
    terms::Stop,
};

pub(super) const TELLING: Telling = Telling {
    verb: "simulate",
    asked: |_| {
        [
            "How do all blocks respond to ground motion?",
            "One rigid-body simulation, computed, not proved. Displacements are those of the centres \
             of mass, divided by the thickness of their blocks.",
        ]
    },
    title,
    why,
    rows,
    next: |_, _, again| next(again),
    ..PLAIN
};

/// So many blocks are listed.
const FEW: usize = 5;

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let Some(a) = file.answer.shaken() else { return ("undecided".into(), Role::Unsure) };
    let greatest = a.by_way().first().map_or(0.0, |b| b.greatest_over_thickness);
    match a.fate {
        ShakenWord::Overturns => {
            let id = a.overturned.as_deref().unwrap_or("a block");
            let at = a.overturned_at.unwrap_or(f64::NAN);
            (format!("{id} overturns at {} s", fixed(at, 3)), Role::Bad)
        }
        ShakenWord::Rests => (
            format!(
                "moves by up to {} of a thickness, comes to rest with a residual displacement of {}",
                short(greatest),
                short(a.residual())
            ),
            Role::Good,
        ),
        ShakenWord::Moves => (
            format!("still moving at the end, by up to {} of a thickness", short(greatest)),
            Role::Unsure,
        ),
    }
}

/// What it is.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    if file.answer.shaken().is_some() {
        page.paragraph(
            "One simulation, computed, not proved. Blocks start at rest under the full dead load; in the frame of the ground, each is accelerated by minus the ground acceleration. A single rocking history is hardly repeatable: a share over many records is more reliable.",
        );
    }
}

/// The ground, the blocks that went farthest, the steps.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(a) = file.answer.shaken() else { return };
    page.row("ground", [ground::words(&a.asked.ground)]);
    let order = a.by_way();
    let shown = if options.verbose { order.len() } else { FEW };
    page.row(
        "farthest",
        order.iter().take(shown).map(|b| {
            format!(
                "{}: {} of its thickness of {} m at {} s, residual {}; rotated by up to {}°",
                b.block,
                short(b.greatest_over_thickness),
                short(b.thickness),
                fixed(b.at, 3),
                short(b.residual_over_thickness),
                short(b.greatest_turn_deg)
            )
        }),
    );
    page.row("steps", [steps(a)]);
}

fn steps(a: &ShakenAnswer) -> String {
    let stop = match a.stop {
        Stop::Horizon => "to the end of the time span",
        Stop::Rest => "until all blocks were at rest",
        Stop::Fallen => "until a block overturned",
        Stop::Stopped => "until it was stopped",
        Stop::Broken => "until the simulation diverged",
    };
    format!(
        "{} of {}, {:?}, {} substeps each, {stop} ({} s)",
        count(a.steps, "step"),
        seconds(a.step),
        a.fidelity,
        a.substeps,
        short(a.time)
    )
    .to_lowercase()
}

/// What may come next.
pub(super) fn next(again: &str) -> Vec<(String, &'static str)> {
    vec![
        (format!("{again} --save result.json"), "save the answer with its record"),
        ("voussoir check result.json".into(), "run it again"),
        (
            format!("{again} --chart displacements.svg"),
            "displacements of the blocks relative to the ground",
        ),
    ]
}
