//! Supports that move slowly: at which share of their way does a scene fall?
//!
//! The dead load is put on first. Then the supports go their ways at a pace that grows from nothing
//! and stays. What follows them in equilibrium is about as fast as they are; what falls gains speed
//! by itself, and where that began is where it fell. The slower the pace, the nearer that is to where
//! equilibrium ends: what falls needs time to gain speed, while the supports go on.

use super::{
    super::{
        Fidelity, Progress, SimulationSettings, Stop,
        bodies::{Frictions, bodies},
        rapier::World,
        units::Units,
    },
    Loads, ONSET, PATIENCE, REPORT, RunState, Stage, smooth, strengths, unknown_members,
};
use crate::clock::Instant;
use base::{
    error::{Finding, InputError, JsonPath},
    tolerance::{REST_ENERGY, REST_TIME, SKIN},
};
use model::interface::Model;
use nalgebra::{UnitQuaternion, Vector3};
use std::ops::ControlFlow;

/// A block that is faster than this × the fastest point of a support may be falling. Larger: a fall is
/// told late. Smaller: mechanisms that go faster than what drives them pass for falls.
const RUSH: f64 = 10.0;

/// Where a support goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportWay {
    /// Its index.
    pub support: usize,
    /// The way, m.
    pub way: Vector3<f64>,
    /// The turn about its centre of mass, rad about each axis.
    pub turn: Vector3<f64>,
}

/// How supports move, all in proportion.
#[derive(Clone, Copy, Debug)]
pub struct Carriage<'a> {
    /// Where to.
    pub ways: &'a [SupportWay],
    /// Speed of the fastest point of a support, in √(g L), L the median block size.
    pub pace: f64,
}

/// The answer of [`carry`].
#[derive(Clone, Debug, PartialEq)]
pub struct CarriedAlong {
    /// The share of the way at which it fell: where all blocks were last about as slow as the supports
    /// before one went on to move by its thickness. None where nothing fell.
    pub falls_at: Option<f64>,
    /// The share of the way that was gone.
    pub share: f64,
    /// Settings of the steps.
    pub fidelity: Fidelity,
    /// Steps taken.
    pub steps: usize,
    /// Time simulated, s.
    pub time: f64,
    /// Why it ended.
    pub stop: Stop,
    /// Wall clock, s.
    pub seconds: f64,
    /// What the simulation could not respect.
    pub findings: Vec<Finding>,
}

/// Moves supports slowly, by default with fine steps, until something falls or everything is at rest
/// at the end of their ways.
///
/// # Errors
/// A block that the engine cannot take; members that it does not have; nothing that moves, or a pace
/// that is none.
pub fn carry(
    model: &Model,
    carriage: Carriage,
    settings: &SimulationSettings,
    watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<CarriedAlong, InputError> {
    let refuse = |text: String| InputError::at(JsonPath::root(), text);
    if let Some(finding) = unknown_members(&model.interfaces) {
        return Err(refuse(finding.text));
    }
    if !(carriage.pace > 0.0 && carriage.pace.is_finite()) {
        return Err(refuse(format!("the pace must be > 0, got {}", carriage.pace)));
    }
    let loads = Loads::of(model);
    let units = Units::of(&model.assembly, &loads.total)
        .ok_or_else(|| refuse("nothing in this scene is free to move".into()))?;
    let bodies = bodies(model, &units, SKIN)?;
    let frictions = Frictions::new(model, &units);
    let scene =
        Stage { model, bodies: &bodies, frictions: &frictions, units, loads: &loads, settings };
    let mut along = scene.carry(carriage, watch)?;
    along.findings.extend(strengths(&model.interfaces));
    Ok(along)
}

impl Stage<'_> {
    fn carry(
        &self,
        Carriage { ways, pace }: Carriage,
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<CarriedAlong, InputError> {
        let begin = Instant::now();
        let fidelity = self.settings.fidelity.unwrap_or(Fidelity::Fine);
        let length = self.units.length;
        let speed =
            |m: &SupportWay| m.way.norm() / length + m.turn.norm() * self.bodies[m.support].reach;
        let fastest = ways.iter().map(speed).fold(0.0, f64::max);
        if fastest == 0.0 {
            return Err(InputError::at(JsonPath::root(), "no support moves"));
        }
        let (mut world, dt) = self.world(fidelity)?;
        let mut beside = self.at_rest(&mut world, dt);
        // The whole way, and time to fall or to come to rest after it.
        let way = fastest / pace + ONSET;
        let horizon = self.settings.seconds.map_or(way + self.horizon(), |s| s / self.units.time);
        let total = (horizon / dt).ceil().max(1.0) as usize;
        let (mut share, mut calm) = (0.0, (0.0, self.places(&world)));
        let (mut steps, mut resting, mut heard) = (0, 0.0, Instant::now());
        let mut state = RunState { farthest: (0, 0.0), now: 0.0, energy: 0.0, fallen: false };
        let mut falls_at = None;
        let stop = loop {
            if steps == total {
                break Stop::Horizon;
            }
            steps += 1;
            let time = steps as f64 * dt;
            if share < 1.0 {
                share = f64::min(share + dt * smooth(time / ONSET) * pace / fastest, 1.0);
                for m in ways {
                    let center = self.bodies[m.support].center + m.way * (share / length);
                    let turn = UnitQuaternion::from_scaled_axis(m.turn * share);
                    world.carry(m.support, center, turn);
                }
            }
            self.advance(&mut world, &mut beside, 1.0, dt);
            if !world.is_healthy() {
                break Stop::Broken;
            }
            self.look(&world, &mut state);
            if !self.rushes(&world, RUSH * pace) {
                calm = (share, self.places(&world));
            } else if self.is_away(&world, &calm.1) {
                falls_at = Some(calm.0);
                break Stop::Fallen;
            }
            if steps % REPORT == 0 || heard.elapsed() > PATIENCE {
                heard = Instant::now();
                let progress = Progress {
                    fidelity,
                    time: time * self.units.time,
                    horizon: horizon * self.units.time,
                    relative: state.farthest.1,
                    frame: None,
                    moment: None,
                };
                if watch(&progress).is_break() {
                    break Stop::Stopped;
                }
            }
            resting = if state.energy < REST_ENERGY { resting + dt } else { 0.0 };
            if share == 1.0 && resting >= REST_TIME {
                break Stop::Rest;
            }
        };
        Ok(CarriedAlong {
            falls_at,
            share,
            fidelity,
            steps,
            time: steps as f64 * dt * self.units.time,
            stop,
            seconds: begin.elapsed().as_secs_f64(),
            findings: Vec::new(),
        })
    }

    fn places(&self, world: &World) -> Vec<Vector3<f64>> {
        (0..self.bodies.len()).map(|i| world.pose(i).0).collect()
    }

    /// Whether some block has a point that is faster than this.
    fn rushes(&self, world: &World, limit: f64) -> bool {
        self.model.assembly.free().any(|i| {
            let (velocity, spin) = world.velocity(i);
            velocity.norm() + spin.norm() * self.bodies[i].reach > limit
        })
    }

    /// Whether some block has moved by its thickness.
    fn is_away(&self, world: &World, from: &[Vector3<f64>]) -> bool {
        let mut free = self.model.assembly.free();
        free.any(|i| (world.pose(i).0 - from[i]).norm() > self.thickness(i))
    }
}
