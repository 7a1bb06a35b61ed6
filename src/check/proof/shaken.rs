//! Results of `shake`: nothing is claimed. The history of all blocks is observed in the engine, and
//! observed again by who checks.

use super::{
    answer::Answer,
    compare,
    derive::{Derivation, require},
    told::Told,
};
use crate::{
    ground::ShakeOptions,
    terms::{Fidelity, Stop},
    verdict::claim::Findings,
};
use base::{
    error::JsonPath,
    tolerance::{OVERTURNED, SAVED, SUNK},
};
use model::interface::Model;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::sync::Arc;

/// Steps × blocks that are run again at most. More: a file that lies keeps a check busy for hours.
/// Less: long records of walls are not run again.
const AFFORDED: usize = 30_000_000;

/// The answer about all blocks on ground that moves.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShakenAnswer {
    /// What was asked, with the record itself.
    pub asked: ShakeOptions,
    /// Unit direction of the motion, horizontal.
    pub toward: [f64; 3],
    /// What became of it.
    pub fate: ShakenWord,
    /// The first block that overturned or fell.
    pub overturned: Option<String>,
    /// When, s.
    pub overturned_at: Option<f64>,
    /// Free blocks in scene order.
    pub blocks: Vec<ShakenBlock>,
    /// Settings of the steps.
    pub fidelity: Fidelity,
    /// A step, s.
    pub step: f64,
    /// Substeps of it.
    pub substeps: usize,
    /// Steps taken.
    pub steps: usize,
    /// Time simulated, s.
    pub time: f64,
    /// Why it ended.
    pub stop: Stop,
}

/// What became of a scene on ground that moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ShakenWord {
    /// Everything came to rest.
    Rests,
    /// Something still moved when the time was over.
    Moves,
    /// A block overturned or fell.
    Overturns,
}

/// What a block did, ways in its own thickness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShakenBlock {
    /// The block.
    pub block: String,
    /// Its thickness, m.
    pub thickness: f64,
    /// The greatest way of its centre of mass over its thickness.
    pub greatest_over_thickness: f64,
    /// When, s.
    pub at: f64,
    /// Its way at the end over its thickness.
    pub residual_over_thickness: f64,
    /// The greatest angle by which it had turned, degrees.
    pub greatest_turn_deg: f64,
}

impl ShakenAnswer {
    /// The blocks that went farthest for their thickness first.
    pub fn by_way(&self) -> Vec<&ShakenBlock> {
        let mut order: Vec<&ShakenBlock> = self.blocks.iter().collect();
        order.sort_by(|a, b| b.greatest_over_thickness.total_cmp(&a.greatest_over_thickness));
        order
    }

    /// The greatest way over thickness that is left.
    pub fn residual(&self) -> f64 {
        self.blocks.iter().map(|b| b.residual_over_thickness).fold(0.0, f64::max)
    }
}

/// The history of all blocks is computed; what is said of it fits itself and the scene.
pub(super) fn derive(
    d: &mut Derivation,
    o: &ShakeOptions,
    said: &ShakenAnswer,
) -> Result<Told, String> {
    if said.asked != *o {
        return Err("the history is not the one that was asked for".into());
    }
    let mut f = Findings::default();
    asked(&mut f, said, d.model);
    blocks(&mut f, said, d.model);
    fate(&mut f, said);
    repeated(d, &mut f, said);
    d.part("history", f);
    d.check.claimed = true;
    Ok(Told::new(d.model, Answer::Shaken(Box::new(said.clone())), &Arc::default()))
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
    require(f, named, format!("all {} free blocks are listed", said.blocks.len()));
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
    require(
        f,
        said.blocks.iter().all(whole),
        "the displacements are consistent: none is greater at the end than its maximum",
    );
    let time = said.steps as f64 * said.step;
    let same = said.step > 0.0 && (time - said.time).abs() <= SAVED * said.time;
    require(f, same, format!("{} steps add up to the time given", said.steps));
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
    require(f, follows, "the outcome follows from the displacements and rotations of the blocks");
}

/// The engine does the same again. Its arithmetic is repeated bit by bit on one machine; another one
/// may round a sine differently, from which another history of rocking comes: that refutes nothing.
fn repeated(d: &Derivation, f: &mut Findings, said: &ShakenAnswer) {
    f.computed = true;
    if !d.asks_again() || !f.fails.is_empty() {
        return;
    }
    let text = format!(
        "{} steps of the simulation are the same when run again (computed, not proved)",
        said.steps
    );
    let dear = said.steps.saturating_mul(said.blocks.len()) > AFFORDED;
    match (!dear).then(|| d.again.shaken(said, d.scene, d.model)).flatten() {
        None => f.unchecked.push(text),
        Some(Err(e)) => f.fails.push(format!("the history cannot be computed for this scene: {e}")),
        Some(Ok(here)) => match compare::first_difference(said, &here) {
            None => f.holds.push(text),
            Some(place) => f.unchecked.push(format!(
                "run again here, the simulation differs at {place} (it {}): not confirmed; another machine or build may give another history",
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
