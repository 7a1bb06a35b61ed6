//! Verifying results of `shake`: what their words say of each other and of the scene, and what the
//! engine does when it is run again.

use super::{ShakenAnswer, ShakenBlock, ShakenWord};
use crate::{
    proof::{
        answer::Answer,
        kinematic::differs,
        recompute::Recompute,
        result::ResultFile,
        verify::{Verification, failure, require},
    },
    terms::Stop,
    verdict::claim::Findings,
};
use base::{
    error::JsonPath,
    tolerance::{OVERTURNED, SAVED, SUNK},
};
use model::interface::Model;
use nalgebra::Vector3;
use scene::Scene;

/// Steps × blocks that are run again at most. More: a file that lies keeps a check busy for hours.
/// Less: long records of walls are not run again.
const AFFORDED: usize = 30_000_000;

/// Adds the parts of a result of `shake`.
pub(in crate::proof) fn verify(
    all: &mut Verification,
    file: &ResultFile,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) {
    let Some(said) = file.answer.shaken() else {
        return all.part("answer", failure("the answer is not one to its question"));
    };
    let mut f = Findings::default();
    let alone = file.certificate.claim.is_none()
        && file.directions.is_empty()
        && file.dead_load.is_none()
        && file.dry.is_none()
        && file.simulation.is_none()
        && file.mechanism.is_none();
    require(&mut f, alone, "nothing is claimed, and nothing else is answered");
    asked(&mut f, said, model);
    blocks(&mut f, said, model);
    fate(&mut f, said);
    if let Some(beside) = &file.shaken {
        let fits = |frame: &crate::proof::simulation::FrameResult| {
            frame.blocks.len() == model.assembly.blocks.len()
                && frame.blocks.iter().flatten().all(|v| v.is_finite())
                && (0.0..=said.time * (1.0 + SAVED)).contains(&frame.time)
        };
        let ordered = beside.frames.windows(2).all(|w| w[0].time < w[1].time);
        require(
            &mut f,
            ordered && beside.frames.iter().all(fits),
            format!("{} frames hold every block, in order of time", beside.frames.len()),
        );
    }
    if f.fails.is_empty() {
        repeated(&mut f, said, scene, model, again);
    }
    all.part("history", f);
}

/// What was asked means something for this scene.
fn asked(f: &mut Findings, said: &ShakenAnswer, model: &Model) {
    let axes = said.asked.check().and_then(|()| said.asked.axes(model.assembly.gravity));
    match axes.map_err(|e| e.under(&JsonPath::root().key("asked"))) {
        Err(e) => f.fails.push(e.to_string()),
        Ok([toward, ..]) => {
            let near = (toward - Vector3::from(said.toward)).norm() <= SAVED;
            require(f, near, "the ground moves towards the direction asked for");
        }
    }
}

/// The free blocks, each with ways that one block can go.
fn blocks(f: &mut Findings, said: &ShakenAnswer, model: &Model) {
    let blocks = &model.assembly.blocks;
    let named =
        model.assembly.free().map(|i| &blocks[i].id).eq(said.blocks.iter().map(|b| &b.block));
    require(f, named, format!("all {} free blocks are told of", said.blocks.len()));
    let whole = |b: &ShakenBlock| {
        let numbers = [
            b.thickness,
            b.greatest_over_thickness,
            b.at,
            b.residual_over_thickness,
            b.greatest_turn_deg,
        ];
        numbers.iter().all(|v| v.is_finite() && *v >= 0.0)
            && b.residual_over_thickness <= b.greatest_over_thickness
            && b.at <= said.time * (1.0 + SAVED)
            && b.greatest_turn_deg <= 180.0
    };
    require(f, said.blocks.iter().all(whole), "no block went farther at the end than ever");
    let time = said.steps as f64 * said.step;
    let same = said.step > 0.0 && (time - said.time).abs() <= SAVED * said.time;
    require(f, same, format!("{} steps take the time said", said.steps));
}

/// What became of it follows from what the blocks did.
fn fate(f: &mut Findings, said: &ShakenAnswer) {
    let over = |b: &ShakenBlock| {
        b.greatest_turn_deg.to_radians() > OVERTURNED || b.greatest_over_thickness > SUNK
    };
    let turned = |b: &ShakenBlock| b.greatest_turn_deg.to_radians() > OVERTURNED * (1.0 + SAVED);
    let follows = match (said.fate, &said.overturned, said.overturned_at) {
        (ShakenWord::Overturns, Some(id), Some(at)) => {
            (0.0..=said.time * (1.0 + SAVED)).contains(&at)
                && said.blocks.iter().any(|b| b.block == *id && over(b))
        }
        (ShakenWord::Rests | ShakenWord::Moves, None, None) => {
            let ended = match said.fate {
                ShakenWord::Rests => {
                    matches!(said.stop, Stop::Rest | Stop::Horizon | Stop::Stopped)
                }
                _ => said.stop != Stop::Rest,
            };
            ended && said.stop != Stop::Fallen && !said.blocks.iter().any(turned)
        }
        _ => false,
    };
    require(f, follows, "what became of it follows from how far the blocks went and turned");
}

/// The engine does the same again. Its arithmetic is repeated bit by bit on one machine; another one
/// may round a sine differently, from which another history of rocking comes: that refutes nothing.
fn repeated(
    f: &mut Findings,
    said: &ShakenAnswer,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) {
    f.computed = true;
    let text = format!("{} steps of the engine come out again (computed, not proved)", said.steps);
    let dear = said.steps.saturating_mul(said.blocks.len()) > AFFORDED;
    let here = (!dear).then(|| again.shaken(said, scene, model)).flatten();
    let json = |a: &ShakenAnswer| serde_json::to_value(a).unwrap_or_default();
    match here {
        None => f.unchecked.push(text),
        Some(Err(e)) => f.fails.push(format!("the scene has no such history: {e}")),
        Some(Ok(here)) => match differs(&json(said), &json(&here), String::new()) {
            None => f.holds.push(text),
            Some(place) => f.unchecked.push(format!(
                "run again here the engine says otherwise at {place} (it {}): not confirmed, as another machine or build may come to another history",
                words(&here)
            )),
        },
    }
}

fn words(a: &ShakenAnswer) -> &'static str {
    match a.fate {
        ShakenWord::Rests => "comes to rest",
        ShakenWord::Moves => "still moves",
        ShakenWord::Overturns => "overturns",
    }
}

impl Answer {
    /// What it says of all blocks on ground that moves.
    pub fn shaken(&self) -> Option<&ShakenAnswer> {
        match self {
            Self::Shaken(a) => Some(a),
            _ => None,
        }
    }
}
