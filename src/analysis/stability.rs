//! The angle of maximum stability of a packing at rest: the tilt of gravity at which the first
//! grains, or enough of them, lose balance.
//!
//! A packing fails as soon as one loose grain on its surface rolls off, which says little about the
//! packing. Each direction is therefore asked in rounds: the grains that a mechanism moves are
//! taken away until a mechanism moves at least a given share of the mass of all free grains, or
//! nothing is left. Grains without a contact path to a support are no part of the packing and are
//! taken away before. What one round finds has the proof of any tilt ([`tilt`](super::tilt())), for
//! the packing that it was asked about.

use super::{Control, Outcome, Tilt, tilt};
use base::error::InputError;
use model::interface::{Model, floating};
use nalgebra::Vector3;
use scene::{Load, Scene, Template, generate};
use std::collections::HashSet;

/// A packing tipped towards several directions.
#[derive(Clone, Debug)]
pub struct Packing {
    /// The packing that was asked about: what a support holds.
    pub model: Model,
    /// Ids of the grains that nothing held.
    pub loose: Vec<String>,
    /// One answer a direction, in the order in which they were asked.
    pub directions: Vec<Stability>,
}

/// One round: a packing and the tilt at which its first grains lose balance.
#[derive(Clone, Debug)]
pub struct Round {
    /// Ids of the grains that were gone before.
    pub gone: Vec<String>,
    /// The bound; in the round with the answer with dry friction too, where that was asked for.
    pub tilt: Tilt,
    /// Ids of the grains that the mechanism moves, the fastest first.
    pub moving: Vec<String>,
    /// Their share of the mass of all free grains, with the grains of earlier rounds.
    pub moved: f64,
}

/// One direction.
#[derive(Clone, Debug)]
pub struct Stability {
    /// The rounds in order. What a later round loses at a smaller tilt has fallen by the greatest
    /// tilt before it.
    pub rounds: Vec<Round>,
    /// The round with the answer: the greatest tilt.
    pub answer: usize,
    /// Whether as much has moved by then as was asked for.
    pub reached: bool,
}

/// The packing without the grains that nothing holds, and their ids; all of it where nothing holds
/// any, for then it is the packing that falls.
pub fn held(model: &Model) -> (Model, Vec<String>) {
    let mut loose: Vec<usize> = floating(model).into_iter().flatten().collect();
    if loose.len() == model.assembly.free().count() {
        loose.clear();
    }
    (if loose.is_empty() { model.clone() } else { model.without(&loose) }, model.ids(&loose))
}

/// What is held of a packing, tipped towards each of these directions ([`stability`]).
///
/// # Errors
/// As [`stability`].
pub fn packing(
    model: &Model,
    toward: &[Vector3<f64>],
    moving_mass: f64,
    control: &Control,
) -> Result<Packing, InputError> {
    let (model, loose) = held(model);
    // All bounds before the first answer with dry friction: where time is short they are worth most.
    let bounds = toward.iter().map(|&d| bound(&model, &loose, d, moving_mass, control));
    let bounds = bounds.collect::<Result<Vec<_>, InputError>>()?;
    let directions = bounds.into_iter().map(|b| b.finish(control));
    let directions = directions.collect::<Result<Vec<_>, InputError>>()?;
    Ok(Packing { model, loose, directions })
}

/// The tilt towards `toward` at which at least `moving_mass` (a share of the mass of the free
/// grains) has moved; `loose` are the ids of the grains that are gone already. With dry friction
/// asked for, the round with the answer has the value with dry friction as well.
///
/// # Errors
/// As [`turned`](check::verdict::tilted::turned).
pub fn stability(
    model: &Model,
    loose: &[String],
    toward: Vector3<f64>,
    moving_mass: f64,
    control: &Control,
) -> Result<Stability, InputError> {
    bound(model, loose, toward, moving_mass, control)?.finish(control)
}

/// The rounds of one direction, before dry friction is asked about.
struct Bounds {
    rounds: Vec<Round>,
    /// The packing of each round when level.
    level: Vec<Model>,
    reached: bool,
}

fn bound(
    model: &Model,
    loose: &[String],
    toward: Vector3<f64>,
    moving_mass: f64,
    control: &Control,
) -> Result<Bounds, InputError> {
    let mass =
        |model: &Model| model.assembly.free().map(|i| model.assembly.blocks[i].mass).sum::<f64>();
    let all = mass(model);
    let (mut model, mut gone) = (model.clone(), loose.to_vec());
    let (mut rounds, mut level): (Vec<Round>, Vec<Model>) = Default::default();
    loop {
        let tilt = tilt(&model, toward, control)?;
        let moving: Vec<usize> =
            tilt.load_factor.mechanism.iter().flat_map(|m| m.moving.iter().copied()).collect();
        let ids = model.ids(&moving);
        let left =
            mass(&model) - moving.iter().map(|&i| model.assembly.blocks[i].mass).sum::<f64>();
        let moved = if all > 0.0 { 1.0 - left / all } else { 0.0 };
        // What stood on the grains that fell may fall however it is tilted: it fell with them.
        let fell = match tilt.load_factor.outcome {
            Outcome::Found => true,
            Outcome::Impossible => !rounds.is_empty(),
            Outcome::Unbounded | Outcome::Undecided => false,
        };
        let reached = fell && moved >= moving_mass;
        let rest = (fell && !reached && !ids.is_empty()).then(|| held(&model.without(&moving)));
        rounds.push(Round { gone: gone.clone(), tilt, moving: ids.clone(), moved });
        level.push(model);
        match rest.filter(|(rest, _)| rest.assembly.free().next().is_some()) {
            Some((rest, fallen)) => {
                gone.extend(ids.into_iter().chain(fallen));
                model = rest;
            }
            None => return Ok(Bounds { rounds, level, reached }),
        }
    }
}

impl Bounds {
    /// Finds the round with the answer, and asks for dry friction there.
    fn finish(self, control: &Control) -> Result<Stability, InputError> {
        let Self { mut rounds, level, reached } = self;
        // A round that stayed open ends the search, and is the answer then; only what fell after
        // others is none of its own.
        let height = |r: &Round| match r.tilt.load_factor.outcome {
            Outcome::Impossible => f64::NEG_INFINITY,
            _ => r.tilt.angle_deg().unwrap_or(f64::INFINITY),
        };
        let answer = (0..rounds.len())
            .max_by(|&i, &j| height(&rounds[i]).total_cmp(&height(&rounds[j])).then(j.cmp(&i)))
            .unwrap_or(0);
        rounds[answer].tilt.add_dry(&level[answer], None, control)?;
        Ok(Stability { rounds, answer, reached })
    }
}

/// A load as it comes to a template, where it lies on its road; itself elsewhere.
fn spread(template: &Template, load: Load) -> Vec<Load> {
    let there = load.road.zip(load.force).and_then(|(on, f)| generate::on_road(template, on, f));
    there.map_or_else(|| vec![load], |spread| spread.loads)
}

/// The scene without some blocks and all that names them; templates become blocks. Nothing changes
/// where there are none.
///
/// # Errors
/// A template cannot be expanded.
pub fn without(scene: &Scene, ids: &[String]) -> Result<Scene, InputError> {
    if ids.is_empty() {
        return Ok(scene.clone());
    }
    let gone: HashSet<&str> = ids.iter().map(String::as_str).collect();
    let mut rest = scene.clone();
    for template in std::mem::take(&mut rest.templates) {
        rest.blocks.extend(generate::expand(&template)?);
        rest.members.extend(generate::members(&template));
        rest.loads.dead.extend(generate::loads(&template));
        for loads in [&mut rest.loads.dead, &mut rest.loads.live] {
            *loads = std::mem::take(loads).into_iter().flat_map(|l| spread(&template, l)).collect();
        }
    }
    let stays = |id: &String| !gone.contains(id.as_str());
    rest.blocks.retain(|b| stays(&b.id));
    rest.joints.overrides.retain(|o| o.blocks.iter().flatten().all(stays));
    rest.interfaces.retain(|f| f.between.iter().all(stays));
    rest.members.retain(|m| m.blocks().iter().all(stays));
    for loads in [&mut rest.loads.dead, &mut rest.loads.live] {
        loads.retain(|l| l.block.iter().all(stays));
    }
    Ok(rest)
}
