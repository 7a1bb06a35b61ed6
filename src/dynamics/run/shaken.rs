//! A scene on ground that moves: in the frame of the ground every block gets −m a.
//!
//! Full dead load acts from the start, at rest: it is put on before the ground moves, and
//! displacements count from there. Masses of loads go with their blocks, as in `kinematic`: they
//! add to the block's own mass and inertia, and move its centre of mass. An impulse of the ground enters a step with its mean over the
//! step, so that records may be finer or coarser than steps. Impacts lose what contacts without
//! restitution lose: of a block 5 times as high as wide 0.9404 to 0.9411 of the speed is left with
//! fine steps, where conservation of angular momentum says 0.9423.

use super::{
    super::{
        Fidelity, Frame, Progress, SimulationSettings, Stop,
        bodies::{Frictions, bodies},
        rapier::World,
        units::Units,
    },
    Beside, Loads, PATIENCE, Pulls, REPORT, RunState, Stage, strengths, unknown_members,
};
use crate::clock::Instant;
use base::{
    error::{Finding, FindingCode, InputError, JsonPath},
    tolerance::{ALONG, OVERTURNED, REST_ENERGY, REST_TIME, SKIN, SUNK},
};
use check::ground::{Motion, When};
use model::interface::Model;
use nalgebra::Vector3;
use std::{collections::BTreeMap, ops::ControlFlow};

/// After the ground has come to rest the scene is watched this many times as long as a fall takes.
const AFTER: f64 = 4.0;
/// What became of a scene on ground that moves.
#[derive(Clone, Debug, PartialEq)]
pub enum ShakenFate {
    /// A block overturned or fell.
    Overturned {
        /// The first one.
        block: usize,
        /// When, s.
        time: f64,
    },
    /// Everything came to rest.
    Rests,
    /// Something still moved when the time was over.
    Moves,
}

/// What a block did, in its own thickness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BlockMotion {
    /// The greatest way of its centre of mass.
    pub greatest: f64,
    /// When, s.
    pub at: f64,
    /// Its way at the end.
    pub residual: f64,
    /// The greatest angle by which it had turned, rad.
    pub turn: f64,
    /// Its thickness, m.
    pub thickness: f64,
}

/// The answer of [`shake`].
#[derive(Clone, Debug, PartialEq)]
pub struct Shaken {
    /// What became of it.
    pub fate: ShakenFate,
    /// By block, supports among them.
    pub blocks: Vec<BlockMotion>,
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
    /// Wall clock, s.
    pub seconds: f64,
    /// Frames that were asked for.
    pub frames: Vec<Frame>,
    /// What the simulation could not respect.
    pub findings: Vec<Finding>,
}

/// How the ground moves.
#[derive(Clone, Copy, Debug)]
pub struct Shaking<'a> {
    /// The motion along its axes.
    pub motion: &'a Motion,
    /// Unit axes: the direction of the motion, the horizontal one to its left, up.
    pub axes: &'a [Vector3<f64>; 3],
    /// Masses that it pushes beside those of the blocks, with which they go.
    pub burdens: &'a [Burden],
}

/// A mass that goes with a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Burden {
    /// The block.
    pub block: usize,
    /// From the block's centre of mass to where it acts, m.
    pub arm: Vector3<f64>,
    /// kg.
    pub mass: f64,
    /// Its weight, N, where that is among the dead loads; 0 where it rests elsewhere.
    pub rests: f64,
}

/// Runs a scene on ground that moves. By default with fine steps, until something overturns or
/// everything is at rest after the ground is.
///
/// # Errors
/// A block that the engine cannot take; members that it does not have; a jump that waits for a
/// landing.
pub fn shake(
    model: &Model,
    ground: Shaking,
    settings: &SimulationSettings,
    watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Shaken, InputError> {
    let Model { assembly, interfaces, .. } = model;
    let refuse = |text: String| InputError::at(JsonPath::root(), text);
    if let Some(finding) = unknown_members(interfaces) {
        return Err(refuse(finding.text));
    }
    if ground.motion.jumps.iter().any(|j| j.when == When::FirstLanding) {
        return Err(refuse("a jump that waits for a landing is for mechanisms only".into())
            .hint("use `voussoir kinematic`"));
    }
    let loads = Loads::of(model);
    let units = Units::of(assembly, &loads.total)
        .ok_or_else(|| refuse("nothing in this scene is free to move".into()))?;
    let mut bodies = bodies(model, &units, SKIN)?;
    for b in ground.burdens {
        bodies[b.block].carry(b.mass / units.mass, b.arm / units.length);
    }
    let frictions = Frictions::new(model, &units);
    let scene =
        Stage { model, bodies: &bodies, frictions: &frictions, units, loads: &loads, settings };
    let mut shaken = scene.shake(&ground, watch)?;
    shaken.findings.extend(strengths(interfaces));
    shaken.findings.extend(super::beyond(model));
    shaken.findings.extend(massless(model, ground.burdens));
    Ok(shaken)
}

/// Dead loads that are no weights, or are said to have no mass: forces, which nothing pushes.
fn massless(model: &Model, burdens: &[Burden]) -> Option<Finding> {
    let assembly = &model.assembly;
    let down = assembly.gravity.try_normalize(0.0).unwrap_or_default();
    let mut rests: BTreeMap<usize, f64> = BTreeMap::new();
    for b in burdens {
        *rests.entry(b.block).or_default() += b.rests;
    }
    let loaded = |&i: &usize| {
        let own = assembly.self_weight(i).force;
        let weighs = down * rests.get(&i).copied().unwrap_or_default();
        let left = (assembly.dead[i].force - own - weighs).norm();
        left > ALONG * (own.norm() + weighs.norm())
    };
    let count = assembly.free().filter(loaded).count();
    let text = format!(
        "{count} blocks carry dead loads that are not weights: they act as forces without mass"
    );
    (count > 0).then(|| Finding::new(FindingCode::LeftOut, text))
}

impl Stage<'_> {
    fn shake(
        &self,
        &Shaking { motion, axes, .. }: &Shaking,
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<Shaken, InputError> {
        let begin = Instant::now();
        let fidelity = self.settings.fidelity.unwrap_or(Fidelity::Fine);
        let unit = self.units.time;
        let (mut world, dt) = self.world(fidelity)?;
        let Beside { mut rolling, mut couples, mut springs } = self.at_rest(&mut world, dt);
        let start: Vec<_> = (0..self.bodies.len()).map(|i| world.pose(i)).collect();
        let down = self.model.assembly.gravity.try_normalize(0.0).unwrap_or(-Vector3::z());
        let horizon = match self.settings.seconds {
            Some(s) => s / unit,
            None => motion.end() / unit + AFTER * self.horizon(),
        };
        let total = (horizon / dt).ceil().max(1.0) as usize;
        let every = total.checked_div(self.settings.frames).map_or(usize::MAX, |n| n.max(1));
        let mut blocks: Vec<BlockMotion> = (0..self.bodies.len())
            .map(|i| BlockMotion {
                thickness: self.thickness(i) * self.units.length,
                ..BlockMotion::default()
            })
            .collect();
        let mut state = RunState {
            farthest: (self.model.assembly.free().next().unwrap_or(0), 0.0),
            now: 0.0,
            energy: 0.0,
            fallen: false,
        };
        let (mut frames, mut overturned) = (Vec::new(), None);
        let (mut steps, mut resting, mut heard) = (0, 0.0, Instant::now());
        let stop = loop {
            if steps == total {
                break Stop::Horizon;
            }
            let (from, to) = (steps as f64 * dt, (steps + 1) as f64 * dt);
            let velocity = motion.velocity(from * unit, to * unit);
            let mean = (0..3).map(|k| axes[k] * velocity[k]).sum::<Vector3<f64>>() / (dt * unit);
            let pulls = springs.pulls(&world, self.bodies, 1.0);
            self.load_shaken(&mut world, &mean, &couples, &pulls);
            world.step();
            steps += 1;
            if self.frictions.resist_rolling() {
                couples = rolling.torques(self.bodies, self.frictions, &world, dt);
            }
            if !world.is_healthy() {
                break Stop::Broken;
            }
            self.look(&world, &mut state);
            let time = to * unit;
            for i in self.model.assembly.free() {
                let (center, turn) = world.pose(i);
                let way = center - start[i].0;
                let block = &mut blocks[i];
                let relative = way.norm() / self.thickness(i);
                if relative > block.greatest {
                    (block.greatest, block.at) = (relative, time);
                }
                block.residual = relative;
                block.turn = block.turn.max((turn * start[i].1.inverse()).angle());
                let sunk = way.dot(&down) > SUNK * self.thickness(i);
                if overturned.is_none() && (block.turn > OVERTURNED || sunk) {
                    overturned = Some((i, time));
                }
            }
            let framed = steps % every == 0;
            if framed {
                frames.push(self.frame(&world, fidelity, to, &state));
            }
            let moment = self.settings.every_step.then(|| self.frame(&world, fidelity, to, &state));
            if framed || moment.is_some() || steps % REPORT == 0 || heard.elapsed() > PATIENCE {
                heard = Instant::now();
                let progress = Progress {
                    fidelity,
                    time,
                    horizon: horizon * unit,
                    relative: state.farthest.1,
                    frame: frames.last().filter(|_| framed),
                    moment: moment.as_ref(),
                };
                if watch(&progress).is_break() {
                    break Stop::Stopped;
                }
            }
            if !self.settings.keep_frames {
                frames.clear();
            }
            if overturned.is_some() && !self.settings.to_the_end {
                break Stop::Fallen;
            }
            resting = if state.energy < REST_ENERGY { resting + dt } else { 0.0 };
            let over = time >= motion.end() && !self.settings.to_the_end;
            if over && resting >= REST_TIME {
                break Stop::Rest;
            }
        };
        let fate = match (overturned, stop) {
            (Some((block, time)), _) => ShakenFate::Overturned { block, time },
            (None, Stop::Rest) => ShakenFate::Rests,
            _ if resting >= REST_TIME => ShakenFate::Rests,
            _ => ShakenFate::Moves,
        };
        Ok(Shaken {
            fate,
            blocks,
            fidelity,
            step: dt * unit,
            substeps: super::fineness(fidelity).1,
            steps,
            time: steps as f64 * dt * unit,
            stop,
            seconds: begin.elapsed().as_secs_f64(),
            frames,
            findings: Vec::new(),
        })
    }

    /// The whole dead load, and what the acceleration of the ground (m/s²) makes of the masses.
    fn load_shaken(
        &self,
        world: &mut World,
        ground: &Vector3<f64>,
        couples: &BTreeMap<usize, Vector3<f64>>,
        pulls: &Pulls,
    ) {
        let mut moments: BTreeMap<usize, Vector3<f64>> = BTreeMap::new();
        for &(block, force, arm) in &self.loads.turning {
            let turned = world.pose(block).1 * arm;
            *moments.entry(block).or_default() += (turned - arm).cross(&force);
        }
        for i in self.model.assembly.free() {
            let model::assembly::Wrench { force, moment } = self.loads.total[i];
            let moment = moment + moments.get(&i).copied().unwrap_or_default();
            let couple = couples.get(&i).copied().unwrap_or_default();
            let body = &self.bodies[i];
            let pushed = ground * (body.mass * self.units.mass);
            let arm = world.pose(i).1 * body.com * self.units.length;
            let (force, moment) = (force - pushed, moment - arm.cross(&pushed));
            let (pull, torque) = pulls.get(&i).copied().unwrap_or_default();
            world.load(
                i,
                force / self.units.force() + pull,
                moment / self.units.moment() + couple + torque,
            );
        }
    }
}
