//! The angle of maximum stability of a packing at rest: the tilt of gravity at which the first grains, or enough of them, lose balance.
//!
//! A packing fails as soon as one loose grain on its surface rolls off, which says little about the packing. Each direction is therefore
//! asked in rounds: the grains that a mechanism moves are taken away until a mechanism moves at least a given share of the mass of all free
//! grains, or nothing is left. Grains without a contact path to a support are no part of the packing and are taken away before.
//! What one round finds has the proof of any tilt ([`tilt`](super::tilt())), for the packing that it was asked about.

use super::{
    Control, Law, Outcome, Tilt,
    coulomb::DryLoadFactor,
    tilt,
    tilt::{dry, tilted},
};
use crate::{
    error::InputError,
    generate,
    interface::{Model, floating, prepare},
    scene::Scene,
};
use nalgebra::Vector3;
use std::{collections::HashSet, time::Instant};

/// One round: a packing and the tilt at which its first grains lose balance.
#[derive(Clone, Debug)]
pub struct Round {
    /// The packing as it was asked about.
    pub scene: Scene,
    /// The model at the tilt of the bound.
    pub model: Model,
    /// The bound.
    pub tilt: Tilt,
    /// The model at the tilt with dry friction, and that, where it was asked for.
    pub dry: Option<(Model, DryLoadFactor)>,
    /// Ids of the grains that the mechanism moves, the fastest first.
    pub moving: Vec<String>,
    /// Their share of the mass of all free grains, with the grains of earlier rounds.
    pub moved: f64,
}

/// One direction.
#[derive(Clone, Debug)]
pub struct Stability {
    /// The rounds in order. What a later round loses at a smaller tilt has fallen by the greatest tilt before it.
    pub rounds: Vec<Round>,
    /// The round with the answer: the greatest tilt.
    pub answer: usize,
    /// Whether as much has moved by then as was asked for.
    pub reached: bool,
}

/// The packing without the grains that nothing holds, and their ids.
///
/// # Errors
/// The scene cannot be prepared once more without them.
pub fn held(scene: &Scene, model: Model) -> Result<(Scene, Model, Vec<String>), InputError> {
    let loose: Vec<String> = floating(&model).into_iter().flatten().map(|i| model.assembly.blocks[i].id.clone()).collect();
    if loose.is_empty() {
        return Ok((scene.clone(), model, loose));
    }
    let rest = without(scene, &loose)?;
    let again = prepare(&rest)?;
    Ok((rest, again, loose))
}

/// The tilt towards `toward` at which at least `moving_mass` (a share of the mass of the free grains) has moved. With [`Law::Coulomb`] the
/// round with the answer has the value with dry friction as well.
///
/// # Errors
/// As [`turned`](super::tilt::turned), or a packing cannot be prepared once more.
pub fn stability(scene: &Scene, model: &Model, toward: Vector3<f64>, moving_mass: f64, control: &Control) -> Result<Stability, InputError> {
    let mass = |model: &Model| model.assembly.free().map(|i| model.assembly.blocks[i].mass).sum::<f64>();
    let all = mass(model);
    let (mut scene, mut model) = (scene.clone(), model.clone());
    let (mut rounds, mut level): (Vec<Round>, Vec<Model>) = Default::default();
    let start = Instant::now();
    loop {
        // All rounds share the time.
        let control = &Control { seconds: control.seconds - start.elapsed().as_secs_f64(), ..*control };
        let tilt = tilt::tilt(&model, toward, control)?;
        let turned = tilted(&model, toward, tilt.load_factor.value)?;
        let moving: Vec<usize> = tilt.load_factor.mechanism.iter().flat_map(|m| m.moving.iter().copied()).collect();
        let ids: Vec<String> = moving.iter().map(|&i| model.assembly.blocks[i].id.clone()).collect();
        let left = mass(&model) - moving.iter().map(|&i| model.assembly.blocks[i].mass).sum::<f64>();
        let moved = if all > 0.0 { 1.0 - left / all } else { 0.0 };
        // What stood on the grains that fell may fall however it is tilted: it fell with them.
        let fell = match tilt.load_factor.outcome {
            Outcome::Found => true,
            Outcome::Impossible => !rounds.is_empty(),
            Outcome::Unbounded | Outcome::Undecided => false,
        };
        let reached = fell && moved >= moving_mass;
        let rest = if fell && !reached && !ids.is_empty() && moving.len() < model.assembly.free().count() {
            let rest = without(&scene, &ids)?;
            let (rest, next, _) = held(&rest, prepare(&rest)?)?;
            Some((rest, next)).filter(|(_, next)| next.assembly.free().next().is_some())
        } else {
            None
        };
        rounds.push(Round { scene, model: turned, tilt, dry: None, moving: ids, moved });
        level.push(model);
        match rest {
            Some(rest) => (scene, model) = rest,
            None => return finish(rounds, &level, reached, control),
        }
    }
}

/// Finds the round with the answer, and asks for dry friction there.
fn finish(mut rounds: Vec<Round>, level: &[Model], reached: bool, control: &Control) -> Result<Stability, InputError> {
    // A round that stayed open ends the search, and is the answer then; only what fell after others is none of its own.
    let height = |r: &Round| match r.tilt.load_factor.outcome {
        Outcome::Undecided => f64::INFINITY,
        Outcome::Impossible => f64::NEG_INFINITY,
        Outcome::Found | Outcome::Unbounded => r.tilt.angle_deg(),
    };
    let answer = (0..rounds.len()).max_by(|&i, &j| height(&rounds[i]).total_cmp(&height(&rounds[j])).then(j.cmp(&i))).unwrap_or(0);
    let Round { tilt, .. } = &rounds[answer];
    let bounded = matches!(tilt.load_factor.outcome, Outcome::Found | Outcome::Unbounded);
    if bounded && control.law == Law::Coulomb {
        let dry = dry(&level[answer], tilt, None, control)?;
        rounds[answer].dry = Some((tilted(&level[answer], tilt.toward, dry.value)?, dry));
    }
    Ok(Stability { rounds, answer, reached })
}

/// The scene without some blocks and all that names them; templates become blocks.
pub(super) fn without(scene: &Scene, ids: &[String]) -> Result<Scene, InputError> {
    let gone: HashSet<&str> = ids.iter().map(String::as_str).collect();
    let mut rest = scene.clone();
    for template in std::mem::take(&mut rest.templates) {
        rest.blocks.extend(generate::expand(&template)?);
    }
    let stays = |id: &String| !gone.contains(id.as_str());
    rest.blocks.retain(|b| stays(&b.id));
    rest.joints.overrides.retain(|o| o.blocks.iter().flatten().all(stays));
    rest.interfaces.retain(|f| f.between.iter().all(stays));
    for loads in [&mut rest.loads.dead, &mut rest.loads.live] {
        loads.retain(|l| l.block.iter().all(stays));
    }
    Ok(rest)
}
