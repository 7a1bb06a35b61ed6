//! Running the engine until the outcome is clear.

mod carried;
mod shaken;

pub use carried::{Carriage, CarriedAlong, SupportWay, carry};
pub use shaken::{BlockMotion, Burden, Shaken, ShakenFate, Shaking, shake};

use super::{
    FIRST_MOTION, Fate, Fidelity, FirstMotion, Frame, MeanContact, Pose, Progress, Run,
    SimulationOutcome, SimulationSettings, Stop,
    bodies::{Body, Frictions, bodies},
    members::{self, Pulls, Springs},
    rapier::{PREDICTION, Step, World},
    rolling::Rolling,
    units::Units,
};
use crate::clock::Instant;
use base::{
    error::{Finding, FindingCode, InputError},
    tolerance::{FALLEN, MOVING_ENERGY, REST_ENERGY, REST_TIME, SETTLED, SETTLED_FINE, SKIN},
};
use model::{
    assembly::Wrench,
    interface::{Interface, Interfaces, Model},
    strength::{crushing::crushes, uplift},
};
use nalgebra::Vector3;
use std::{collections::BTreeMap, ops::ControlFlow, time::Duration};

/// Steps between two reports to the caller, and the time after which one is due all the same: the
/// caller may want to stop.
const REPORT: usize = 50;
const PATIENCE: Duration = Duration::from_millis(100);
/// Loads grow from nothing over this many √(L/g), all in proportion. Shorter: chains of blocks fall
/// a little before their contact forces have built up, which is 1 % of the thickness in an arch.
/// Longer: time is lost.
const ONSET: f64 = 1.0;
/// Before anything but blocks moves the dead load is put on and comes to rest, √(L/g).
const BEFORE: f64 = 4.0;
/// Contact forces are those of a scene at rest when reactions and loads add up to this × the loads.
const BALANCED: f64 = 1e-6;
/// The horizon in √(H/g) and in √(L/g), H the height of the scene, L the median block size.
const HORIZON: f64 = 10.0;
/// Near the margin the horizon is this many times as long.
const LONGER: f64 = 2.0;
/// A scene that has settled farther than [`SETTLED`] may keep less than this × [`MOVING_ENERGY`] at
/// the horizon.
const QUIET: f64 = 1e-3;
/// A displacement is measured against a thickness of at least this × the block's reach.
const THINNEST: f64 = 0.01;

/// Steps in one √(L/g), and substeps of each.
fn fineness(fidelity: Fidelity) -> (f64, usize) {
    match fidelity {
        Fidelity::Fast => (100.0, 20),
        Fidelity::Fine => (400.0, 20),
    }
}

/// Runs a scene in time under its dead loads. `watch` hears of the progress and may stop it.
///
/// # Errors
/// A block that the engine cannot take.
pub fn simulate(
    model: &Model,
    settings: &SimulationSettings,
    watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<SimulationOutcome, InputError> {
    let Model { assembly, interfaces, .. } = model;
    let loads = Loads::of(model);
    let mut outcome = SimulationOutcome {
        fate: Fate::Stands,
        collapse: None,
        runs: Vec::new(),
        first_motion: Vec::new(),
        contacts: Vec::new(),
        reaction_error: 0.0,
        frames: Vec::new(),
        findings: Vec::new(),
    };
    if let Some(finding) = unknown_members(interfaces) {
        // Without its members it is another scene, and what becomes of that answers nothing.
        outcome.fate = Fate::Undecided;
        outcome.findings.push(finding);
        return Ok(outcome);
    }
    let Some(units) = Units::of(assembly, &loads.total) else { return Ok(outcome) };
    let bodies = bodies(model, &units, SKIN)?;
    let frictions = Frictions::new(model, &units);
    let scene =
        Stage { model, bodies: &bodies, frictions: &frictions, units, loads: &loads, settings };
    let ladder = match settings.fidelity {
        Some(one) => vec![one],
        None => vec![Fidelity::Fast, Fidelity::Fine],
    };
    for (index, &fidelity) in ladder.iter().enumerate() {
        let horizon = settings.seconds.map_or_else(
            || scene.horizon() * if index > 0 { LONGER } else { 1.0 },
            |s| s / units.time,
        );
        let show = scene.run(fidelity, horizon, watch)?;
        outcome.frames.extend(show.frames);
        let run = show.run;
        // Fast steps make some scenes fall that stand, and confirming a fall takes little.
        let clear = run.fate == Fate::Stands;
        let stopped = matches!(run.stop, Stop::Stopped);
        outcome.fate = run.fate;
        outcome.collapse = (run.fate == Fate::Falls).then_some(run.time);
        outcome.first_motion = show.first_motion;
        outcome.contacts = show.contacts;
        outcome.reaction_error = show.reaction_error;
        outcome.runs.push(run);
        if clear || stopped {
            break;
        }
    }
    outcome.findings.extend(beyond(model));
    outcome.findings.extend(broken(&outcome.runs));
    outcome.findings.extend(strengths(interfaces));
    Ok(outcome)
}

fn broken(runs: &[Run]) -> Option<Finding> {
    let run = runs.iter().find(|r| r.stop == Stop::Broken)?;
    Some(Finding::new(
        FindingCode::Numerics,
        format!("the numbers of the simulation were no longer finite after {:.3e} s", run.time),
    ))
}

/// Dowels and fingers that can take a force: the simulation has none of them.
fn unknown_members(interfaces: &Interfaces) -> Option<Finding> {
    let first = members::left_out(interfaces).next()?;
    let text = format!(
        "the simulation cannot model dowels and grips, and the scene has {}, such as {} {:?}: it was not run",
        members::left_out(interfaces).count(),
        first.kind.word(),
        first.id
    );
    Some(Finding::new(FindingCode::LeftOut, text))
}

/// Ratio of the masses of two free blocks that touch from which it is told. Larger: columns with a heavy
/// block on top fall that stand (of two blocks at 1e5), or come to no rest (of five at 1e4). Smaller:
/// scenes are warned of that it runs (both stand at 1e3).
const MOST_UNEQUAL: f64 = 1e4;

/// Says what the engine cannot hold, before it runs.
pub fn beyond(model: &Model) -> Option<Finding> {
    let blocks = &model.assembly.blocks;
    let free =
        model.interfaces.list.iter().filter(|f| !blocks[f.a].support && !blocks[f.b].support);
    let ratio = |f: &Interface| {
        let [a, b] = [f.a, f.b].map(|i| blocks[i].mass);
        (a / b).max(b / a)
    };
    let (ratio, worst) = free
        .map(|f| (ratio(f), f))
        .max_by(|x, y| x.0.total_cmp(&y.0))
        .filter(|w| w.0 >= MOST_UNEQUAL)?;
    let [a, b] = [worst.a, worst.b].map(|i| &blocks[i].id);
    let text = format!(
        "{a} and {b} touch, with a mass ratio of 1 to {ratio:.0e}: the simulation is reliable only below {MOST_UNEQUAL:.0e}, and beyond it stable blocks may fall; the verdict (`voussoir assess`) holds at any ratio"
    );
    Some(Finding::new(FindingCode::Numerics, text))
}

fn strengths(interfaces: &Interfaces) -> Option<Finding> {
    let strong = |f: &&Interface| f.law.cohesion > 0.0 || f.law.tension > 0.0 || crushes(f);
    let count = interfaces.list.iter().filter(strong).count();
    let text = format!(
        "{count} joints have cohesion, tensile or compressive strength: the simulation ignores it and uses friction only"
    );
    (count > 0).then(|| Finding::new(FindingCode::LeftOut, text))
}

/// Loads in the way they move with the blocks.
struct Loads {
    /// Force and moment about the centre of mass at the start, N and N·m.
    total: Vec<Wrench>,
    /// Off-centre forces by block: force and arm at the start.
    turning: Vec<(usize, Vector3<f64>, Vector3<f64>)>,
}

impl Loads {
    fn of(model: &Model) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let turning = assembly.dead_forces.iter().map(|f| (f.block, f.force, f.arm)).collect();
        let mut total = assembly.dead.clone();
        for face in &interfaces.list {
            for (point, force) in face.points.iter().zip(uplift(face)) {
                for (block, force) in [(face.a, -force), (face.b, force)] {
                    let moment = (point - assembly.blocks[block].centroid).cross(&force);
                    total[block] += Wrench { force, moment };
                }
            }
        }
        Self { total, turning }
    }
}

/// What acts on blocks beside loads and contacts.
struct Beside {
    rolling: Rolling,
    couples: BTreeMap<usize, Vector3<f64>>,
    springs: Springs,
}

/// What stays the same from run to run.
struct Stage<'a> {
    model: &'a Model,
    bodies: &'a [Body],
    frictions: &'a Frictions<'a>,
    units: Units,
    loads: &'a Loads,
    settings: &'a SimulationSettings,
}

/// A run with what it showed.
struct Show {
    run: Run,
    first_motion: Vec<FirstMotion>,
    contacts: Vec<MeanContact>,
    reaction_error: f64,
    frames: Vec<Frame>,
}

/// The state of one run.
struct RunState {
    /// The block that moved farthest for its thickness, and how far relative to it.
    farthest: (usize, f64),
    /// Largest displacement over thickness at this time.
    now: f64,
    /// Largest kinetic energy of a block over its m g L.
    energy: f64,
    /// Whether a block moved far and still moves.
    fallen: bool,
}

impl Stage<'_> {
    /// The engine with the scene in it, and the length of its steps.
    ///
    /// # Errors
    /// A block that it does not take.
    fn world(&self, fidelity: Fidelity) -> Result<(World<'_>, f64), InputError> {
        let (per_unit, iterations) = fineness(fidelity);
        let dt = 1.0 / per_unit;
        let threads = self.settings.threads.max(1);
        let step = Step {
            dt,
            iterations,
            threads,
            prediction: PREDICTION,
            restitution: 0.0,
            pointed: false,
        };
        let world = World::new(self.bodies, self.frictions, step)
            .map_err(|refused| refused.told(&self.model.assembly.blocks))?;
        Ok((world, dt))
    }

    /// In the engine's units.
    fn horizon(&self) -> f64 {
        let up = -self.model.assembly.gravity.try_normalize(0.0).unwrap_or(-Vector3::z());
        let heights =
            || self.bodies.iter().filter(|b| !b.support).map(|b| (up.dot(&b.center), b.reach));
        let top = heights().map(|(h, r)| h + r).fold(f64::NEG_INFINITY, f64::max);
        let foot = heights().map(|(h, r)| h - r).fold(f64::INFINITY, f64::min);
        HORIZON * (top - foot).max(1.0).sqrt()
    }

    fn run(
        &self,
        fidelity: Fidelity,
        horizon: f64,
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<Show, InputError> {
        let begin = Instant::now();
        let (mut world, dt) = self.world(fidelity)?;
        let total = (horizon / dt).ceil().max(1.0) as usize;
        let every = total.checked_div(self.settings.frames).map_or(usize::MAX, |n| n.max(1));
        let (mut rolling, mut couples) = (Rolling::default(), BTreeMap::new());
        let mut springs = Springs::new(&self.model.interfaces, self.bodies, &self.units, dt);
        let mut pulls = Pulls::new();
        let (mut steps, mut resting) = (0, 0.0);
        let mut state = RunState {
            farthest: (self.model.assembly.free().next().unwrap_or(0), 0.0),
            now: 0.0,
            energy: 0.0,
            fallen: false,
        };
        let (mut first_motion, mut frames, mut fell_at) = (Vec::new(), Vec::new(), None);
        let moment = |world: &World, time, state: &RunState| {
            self.settings.every_step.then(|| self.frame(world, fidelity, time, state))
        };
        if self.settings.frames > 0 || self.settings.every_step {
            if self.settings.frames > 0 {
                frames.push(self.frame(&world, fidelity, 0.0, &state));
            }
            let (time, horizon, now) =
                (0.0, horizon * self.units.time, moment(&world, 0.0, &state));
            // Stopping is heard at the first step.
            let _ = watch(&Progress {
                fidelity,
                time,
                horizon,
                relative: 0.0,
                frame: frames.last(),
                moment: now.as_ref(),
            });
        }
        let mut heard = Instant::now();
        let stop = loop {
            if steps == total {
                break Stop::Horizon;
            }
            let time = (steps + 1) as f64 * dt;
            let part = smooth(time / ONSET);
            pulls = springs.pulls(&world, self.bodies, part);
            self.load(&mut world, part, time - dt < ONSET, &couples, &pulls);
            world.step();
            steps += 1;
            if self.frictions.resist_rolling() {
                couples = rolling.torques(self.bodies, self.frictions, &world, dt);
            }
            if !world.is_healthy() {
                break Stop::Broken;
            }
            let before = state.now;
            self.look(&world, &mut state);
            if before <= FIRST_MOTION && state.now > FIRST_MOTION && fell_at.is_none() {
                first_motion = self.motions(&world);
            }
            resting = if state.energy < REST_ENERGY { resting + dt } else { 0.0 };
            let framed = steps % every == 0;
            if framed {
                frames.push(self.frame(&world, fidelity, time, &state));
            }
            let now = moment(&world, time, &state);
            if framed || now.is_some() || steps % REPORT == 0 || heard.elapsed() > PATIENCE {
                heard = Instant::now();
                let (frame, moment) = (frames.last().filter(|_| framed), now.as_ref());
                let (time, horizon) = (time * self.units.time, horizon * self.units.time);
                if watch(&Progress {
                    fidelity,
                    time,
                    horizon,
                    relative: state.farthest.1,
                    frame,
                    moment,
                })
                .is_break()
                {
                    break Stop::Stopped;
                }
            }
            if !self.settings.keep_frames {
                frames.clear();
            }
            if state.fallen && fell_at.is_none() {
                fell_at = Some(time);
            }
            if fell_at.is_some() && !self.settings.to_the_end {
                break Stop::Fallen;
            }
            let rested = resting >= REST_TIME && steps % REPORT == 0 && !self.settings.to_the_end;
            if rested && self.reaction_error(&self.contacts(&world), &pulls) < BALANCED {
                break Stop::Rest;
            }
        };
        let fate = match stop {
            _ if fell_at.is_some() => Fate::Falls,
            Stop::Rest if stayed(fidelity, state.farthest.1, state.energy) => Fate::Stands,
            // A shorter time shows nothing.
            Stop::Horizon
                if horizon >= HORIZON && stayed(fidelity, state.farthest.1, state.energy) =>
            {
                Fate::Stands
            }
            _ => Fate::Undecided,
        };
        let (block, relative) = state.farthest;
        let contacts = self.contacts(&world);
        Ok(Show {
            run: Run {
                fidelity,
                fate,
                stop,
                step: dt * self.units.time,
                substeps: fineness(fidelity).1,
                steps,
                time: fell_at.unwrap_or(steps as f64 * dt) * self.units.time,
                horizon: horizon * self.units.time,
                farthest: self
                    .model
                    .assembly
                    .blocks
                    .get(block)
                    .map(|b| b.id.clone())
                    .unwrap_or_default(),
                displacement: relative * self.thickness(block) * self.units.length,
                relative,
                energy: state.energy,
                seconds: begin.elapsed().as_secs_f64(),
            },
            first_motion,
            reaction_error: self.reaction_error(&contacts, &pulls),
            contacts,
            frames,
        })
    }

    /// Puts the dead load on, and lets it come to rest.
    fn at_rest(&self, world: &mut World, dt: f64) -> Beside {
        let springs = Springs::new(&self.model.interfaces, self.bodies, &self.units, dt);
        let (rolling, couples) = Default::default();
        let mut beside = Beside { rolling, couples, springs };
        for k in 1..=(BEFORE / dt).ceil() as usize {
            self.advance(world, &mut beside, smooth(k as f64 * dt / ONSET), dt);
        }
        beside
    }

    /// One step under this part of the dead load.
    fn advance(&self, world: &mut World, beside: &mut Beside, part: f64, dt: f64) {
        let pulls = beside.springs.pulls(world, self.bodies, part);
        self.load(world, part, true, &beside.couples, &pulls);
        world.step();
        if self.frictions.resist_rolling() {
            beside.couples = beside.rolling.torques(self.bodies, self.frictions, world, dt);
        }
    }

    fn thickness(&self, block: usize) -> f64 {
        let body = &self.bodies[block];
        body.thickness.max(THINNEST * body.reach)
    }

    /// Sets this part of the loads, the couples of rolling joints and the pulls of members (in the
    /// engine's units), on every block or only where they change. Forces that act at a point of a block keep their
    /// direction while the point moves with the block.
    fn load(
        &self,
        world: &mut World,
        part: f64,
        every: bool,
        couples: &BTreeMap<usize, Vector3<f64>>,
        pulls: &Pulls,
    ) {
        let mut moments: BTreeMap<usize, Vector3<f64>> = BTreeMap::new();
        for &(block, force, arm) in &self.loads.turning {
            let turned = world.pose(block).1 * arm;
            *moments.entry(block).or_default() += (turned - arm).cross(&force);
        }
        // A block whose joints have parted loses its couple.
        let changes = |i: &usize| {
            every
                || moments.contains_key(i)
                || pulls.contains_key(i)
                || self.frictions.resist_rolling()
        };
        for i in self.model.assembly.free().filter(changes) {
            let Wrench { force, moment } = self.loads.total[i];
            let moment = moment + moments.get(&i).copied().unwrap_or_default();
            let couple = couples.get(&i).copied().unwrap_or_default();
            let (pull, torque) = pulls.get(&i).copied().unwrap_or_default();
            world.load(
                i,
                force * part / self.units.force() + pull,
                moment * part / self.units.moment() + couple + torque,
            );
        }
    }

    fn look(&self, world: &World, state: &mut RunState) {
        (state.now, state.energy) = (0.0, 0.0);
        for i in self.model.assembly.free() {
            let body = &self.bodies[i];
            let (center, turn) = world.pose(i);
            let (velocity, spin) = world.velocity(i);
            let relative =
                ((center - body.center).norm() + turn.angle() * body.reach) / self.thickness(i);
            let local = turn.inverse() * spin;
            // Per mass; lengths, gravity and so m g L are one in these units up to the block's own
            // size.
            let energy = 0.5
                * (velocity.norm_squared() + local.dot(&(body.inertia * local)) / body.mass)
                / self.size(i);
            state.now = state.now.max(relative);
            if relative > state.farthest.1 {
                state.farthest = (i, relative);
            }
            state.energy = state.energy.max(energy);
            state.fallen |= relative > FALLEN && energy > MOVING_ENERGY;
        }
    }

    fn size(&self, block: usize) -> f64 {
        self.model.assembly.blocks[block].size / self.units.length
    }

    fn motions(&self, world: &World) -> Vec<FirstMotion> {
        let motion = |(i, body): (usize, &Body)| {
            let (center, turn) = world.pose(i);
            FirstMotion {
                way: (center - body.center) * self.units.length,
                turn: turn.scaled_axis(),
            }
        };
        self.bodies.iter().enumerate().map(motion).collect()
    }

    fn frame(&self, world: &World, fidelity: Fidelity, time: f64, state: &RunState) -> Frame {
        let Units { origin, length, time: unit, mass } = self.units;
        let speed = length / unit;
        let mut energy = 0.0;
        let blocks = (0..self.bodies.len())
            .map(|i| {
                let (center, turn) = world.pose(i);
                let (velocity, spin) = world.velocity(i);
                let local = turn.inverse() * spin;
                if !self.bodies[i].support {
                    energy += 0.5
                        * (self.bodies[i].mass * velocity.norm_squared()
                            + local.dot(&(self.bodies[i].inertia * local)));
                }
                Pose {
                    center: center * length + origin,
                    turn,
                    velocity: velocity * speed,
                    spin: spin / unit,
                }
            })
            .collect();
        Frame {
            time: time * unit,
            fidelity,
            relative: state.farthest.1,
            energy: energy * mass * speed * speed,
            blocks,
        }
    }

    /// Contact forces by pairs of blocks, N.
    fn contacts(&self, world: &World) -> Vec<MeanContact> {
        let mut sums: BTreeMap<(usize, usize), (Vector3<f64>, f64)> = BTreeMap::new();
        for patch in world.patches() {
            let (pair, force) = if patch.a < patch.b {
                ((patch.a, patch.b), patch.force)
            } else {
                ((patch.b, patch.a), -patch.force)
            };
            let sum = sums.entry(pair).or_insert((Vector3::zeros(), 0.0));
            sum.0 += force * self.units.force();
            sum.1 += patch.normal_force * self.units.force();
        }
        sums.into_iter()
            .map(|((a, b), (force, normal_force))| MeanContact { a, b, force, normal_force })
            .collect()
    }

    fn reaction_error(&self, contacts: &[MeanContact], pulls: &Pulls) -> f64 {
        let held = |i: usize| self.bodies[i].support;
        let mut left: Vector3<f64> =
            self.model.assembly.free().map(|i| self.loads.total[i].force).sum();
        left += pulls.values().map(|(pull, _)| pull).sum::<Vector3<f64>>() * self.units.force();
        for c in contacts {
            match (held(c.a), held(c.b)) {
                (true, false) => left += c.force,
                (false, true) => left -= c.force,
                _ => {}
            }
        }
        let size: f64 = self.model.assembly.free().map(|i| self.loads.total[i].force.norm()).sum();
        if size > 0.0 { left.norm() / size } else { 0.0 }
    }
}

/// Whether a scene that moved this far at most, with this energy left, stands. Contacts sink in by
/// the square of the step: what fine steps leave is settling. What hardly moved over the whole
/// horizon may shake a little.
fn stayed(fidelity: Fidelity, relative: f64, energy: f64) -> bool {
    let still = relative < SETTLED && energy < MOVING_ENERGY;
    still
        || (fidelity == Fidelity::Fine && relative < SETTLED_FINE && energy < QUIET * MOVING_ENERGY)
}

/// From 0 to 1 and then 1, with continuous slope.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}
