//! Grains that flow and come to rest.
//!
//! The same engine as [`simulate`](super::simulate()), run stage by stage: walls are taken away or
//! lifted, grains are poured, gravity is turned; at the end they settle once more with finer
//! substeps. Grains that fall below the floor are discarded. Restitution is what is given and nothing else
//! damps: contacts are overdamped springs of natural frequency 0.1 / substep, friction is Coulomb's.
//! A drum is seen from itself: gravity turns about it, and what a turning frame adds is added
//! (`turning`). A stage that settles ends when the mean kinetic energy of a grain (of a sphere
//! without its spin: nothing ever stops a ball that spins between two smooth walls) stays below
//! [`GRAIN_REST_ENERGY`] × m g d for [`GRAIN_REST_TIME`] √(d/g), or for a fifth of that on the
//! way to a heap, never after a fixed time; where it does not, that is said.

mod turning;

use super::{
    bodies::{Frictions, bodies},
    rapier::{Step, World},
    rolling::Rolling,
    units::Units,
};
use crate::clock::Instant;
use base::{
    error::InputError,
    tolerance::{GRAIN_REST_ENERGY, GRAIN_REST_TIME, GRAIN_SKIN},
};
use model::{
    assembly::Assembly,
    interface::{Interfaces, Model},
};
use nalgebra::{Rotation3, Unit, UnitQuaternion, Vector3};
use std::{collections::BTreeMap, ops::ControlFlow};

/// A step is √(d/g) / this; substeps of it. Finer: time. Coarser: grains sink into each other
/// before they are seen.
const STEPS: f64 = 30.0;
const SUBSTEPS: usize = 6;
/// Contacts are prepared up to this distance, in d. Smaller: fast grains sink in before they are
/// seen. Between spheres and on walls normals do not depend on it.
const PREDICTION: f64 = 0.05;
/// The same where grains have faces. Larger: neighbours round a corner are seen at wrong normals.
const PREDICTION_FACES: f64 = 0.02;
/// While they flow, contacts of spheres are found anew when the two have moved by this × d against
/// each other. Larger: no faster (0.005, 0.02). Smaller: time. Meanwhile normals stand still, and
/// with them grains that are about to roll off others: from the look on at which they seem to rest
/// every contact is found anew in every step.
const RECYCLED: f64 = 0.001;
/// At the end substeps are finer by this, and contacts stiffer by its square, so that grains that
/// touch overlap by a sixth of what they did: the statics takes them as they lie. Smaller: contacts
/// are lost in the overlaps. Larger: time.
const FINER: f64 = 2.4;
/// Contacts become stiffer in so many parts, each after so many steps. Fewer: what the overlaps
/// hold sets the grains in motion, and a heap that rested flows on for as long as it took to form.
/// More: time (heaps of 20,000 gain little by five times as many).
const STIFFENED: (usize, usize) = (25, 4);
/// So many times substeps are made finer while statics finds no forces that hold the grains at
/// rest. More: time (each takes 2.4 times as long as the one before). Fewer: grains that creep too slowly
/// for the engine to call it motion are left so.
pub const ROUNDS: usize = 3;
/// How long grains rest before the next stage, √(d/g), on the way to a heap, which at its end rests
/// for [`GRAIN_REST_TIME`]; what is seen as it flows begins after that. Longer: time for nothing.
/// Shorter: a bed that is about to stop is not at rest yet; what flows on when contacts become
/// stiffer takes longer there.
const PAUSE: f64 = 2.0;
/// Steps between two looks at the grains.
const LOOK: usize = 10;
/// A bed flows when a hundredth of the grains moved by d.
const FLOWING: f64 = 0.01;

/// What is done to the grains in one stage.
#[derive(Clone, Debug, PartialEq)]
pub enum Disturbance {
    /// Nothing: they settle.
    Settle,
    /// These blocks are taken away.
    Remove(Vec<usize>),
    /// These blocks rise at this speed, m/s, to this height, m, and are taken away.
    Lift(Vec<usize>, f64, f64),
    /// These blocks are set free, a group every so many s, each from so far above the highest grain,
    /// m.
    Pour(Vec<Vec<usize>>, f64, f64),
    /// Gravity turns about this axis at this rate, radians per s, until the grains flow.
    Turn(Unit<Vector3<f64>>, f64),
    /// The supports turn about this axis through the origin at this rate, radians per s, by so many
    /// radians, and the grains are seen from them.
    Spin(Unit<Vector3<f64>>, f64, f64),
    /// These supports, and the lid, move along x at this speed, m/s, so far, m.
    Shear(Vec<usize>, f64, f64),
    /// Substeps become finer by this factor, and contacts stiffer by its square, by and by.
    Stiffen(f64),
}

/// What is to happen.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// What is done, one after the other.
    pub stages: Vec<Disturbance>,
    /// Mean diameter d of the grains, m.
    pub diameter: f64,
    /// The longest that a stage may take to come to rest after its change, √(d/g).
    pub horizon: f64,
    /// Grains below this height are gone, m.
    pub lost: f64,
    /// Coefficient of restitution of every contact.
    pub restitution: f64,
    /// A free block that loads the grains: it moves along z alone, and with what is sheared.
    pub lid: Option<usize>,
    /// Steps are shorter by this factor: where grains bear more than their weight, contacts have to
    /// be stiffer.
    pub finer: f64,
    /// Whether grains settle once more with finer substeps at the end.
    pub settled: bool,
    /// Threads of the engine; the course is the same on any number of them.
    pub threads: usize,
}

impl Default for Course {
    fn default() -> Self {
        Self {
            stages: Vec::new(),
            diameter: 0.01,
            horizon: 400.0,
            lost: f64::NEG_INFINITY,
            restitution: 0.0,
            lid: None,
            finer: 1.0,
            settled: true,
            threads: 1,
        }
    }
}

/// What whoever watches may look at.
pub struct Moment<'a> {
    /// How far it is.
    pub flow: Flow,
    /// Angle by which gravity or the supports have turned in this stage, radians.
    pub turned: f64,
    /// Way by which supports were sheared in this stage, m.
    pub way: f64,
    /// By block: whether it is there.
    pub there: &'a [bool],
    /// Centre of mass of a block, m.
    pub center: &'a dyn Fn(usize) -> Vector3<f64>,
    /// The sum of the contact forces on these blocks by others, N.
    pub force: &'a dyn Fn(&[usize]) -> Vector3<f64>,
}

/// Where the grains came to rest.
#[derive(Clone, Debug)]
pub struct Rest {
    /// Centre of mass, and turn from the orientation at the start, by block; `None` where a grain
    /// is gone or a wall was taken away.
    pub poses: Poses,
    /// Whether every stage came to rest.
    pub rested: bool,
    /// Mean kinetic energy of a grain at the end, over m g d.
    pub energy: f64,
    /// Grains that fell over the edge.
    pub gone: usize,
    /// Angle by which gravity had turned when the grains began to flow, radians; `None` where it
    /// did not turn, or they never flowed.
    pub turned: Option<f64>,
    /// Gravity at the end, m/s², as the supports see it.
    pub gravity: Vector3<f64>,
    /// How often it settled with finer substeps.
    pub rounds: usize,
    /// Time simulated, s.
    pub time: f64,
    /// Steps taken.
    pub steps: usize,
    /// Time taken, s.
    pub seconds: f64,
}

/// How far a stage is: its index, simulated √(d/g) in it, mean kinetic energy of a grain over m g
/// d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow {
    /// Index of the stage.
    pub stage: usize,
    /// Time in the stage, √(d/g).
    pub time: f64,
    /// Mean kinetic energy of a grain over m g d.
    pub energy: f64,
}

/// Where everything is, by block ([`Rest::poses`]).
pub type Poses = Vec<Option<(Vector3<f64>, UnitQuaternion<f64>)>>;

/// Runs a course. Grains at rest are shown to `holds` with finer and finer substeps, until it says
/// that they hold or [`ROUNDS`] of them have passed.
///
/// # Errors
/// A block that the engine cannot take.
pub fn flow(
    assembly: &Assembly,
    course: &Course,
    watch: &mut dyn FnMut(&Moment) -> ControlFlow<()>,
    holds: &mut dyn FnMut(&Poses) -> bool,
) -> Result<Rest, InputError> {
    let Course { stages, diameter, horizon, .. } = course;
    let (diameter, horizon) = (*diameter, *horizon);
    let begin = Instant::now();
    let refuse = |text: &str| {
        InputError::at(Default::default(), text.to_string())
            .hint("give at least one grain, and gravity")
    };
    let units = Units::of(assembly, &assembly.dead)
        .ok_or_else(|| refuse("there are no grains that could flow"))?;
    let g = assembly.gravity.norm();
    if g == 0.0 {
        return Err(refuse("without gravity nothing flows"));
    }
    // Contacts come and go as grains flow: none is given.
    let model = Model::new(assembly.clone(), Interfaces::default());
    let bodies = bodies(&model, &units, GRAIN_SKIN)?;
    let frictions = Frictions::new(&model, &units);
    let natural = (diameter / g).sqrt();
    let dt = natural / STEPS / course.finer / units.time;
    let round = assembly.free().all(|i| assembly.blocks[i].solid.is_round());
    let prediction = if round { PREDICTION } else { PREDICTION_FACES } * diameter / units.length;
    let step = Step {
        dt,
        iterations: SUBSTEPS,
        threads: course.threads.max(1),
        prediction,
        restitution: course.restitution,
        pointed: assembly
            .free()
            .any(|i| Some(i) != course.lid && !assembly.blocks[i].solid.is_round()),
    };
    let mut world =
        World::new(&bodies, &frictions, step).map_err(|refused| refused.told(&assembly.blocks))?;
    course.lid.into_iter().for_each(|lid| world.guide(lid));
    let free: Vec<usize> = assembly.free().collect();
    let mut run =
        Flowing {
            assembly,
            units,
            world,
            there: vec![true; assembly.blocks.len()],
            free,
            gravity: assembly.gravity,
            diameter,
            lost: course.lost,
            lid: course.lid,
            steps: 0,
            elapsed: 0.0,
            resting: 0.0,
            energy: 0.0,
            recycled: RECYCLED * diameter / units.length,
            dt: natural / STEPS / course.finer,
            step,
            fineness: 1.0,
            natural,
            rolling: Rolling::default(),
            frictions: &frictions,
            bodies: &bodies,
            gyration: bodies
                .iter()
                .map(|b| {
                    if b.reach > 0.0 {
                        b.inertia.symmetric_eigenvalues().max() / b.mass
                    } else {
                        0.0
                    }
                })
                .collect(),
        };
    let (mut rested, mut turned) = (true, None);
    for (stage, change) in stages.iter().enumerate() {
        let still = if course.settled { PAUSE } else { GRAIN_REST_TIME };
        let (came, angle) = run.stage(stage, change, [still, horizon], watch);
        rested &= came;
        turned = angle.or(turned);
        if !came {
            break;
        }
    }
    let mut rounds = 0;
    while rested && course.settled && rounds < ROUNDS {
        rounds += 1;
        let stiffen = Disturbance::Stiffen(FINER);
        rested = run.stage(stages.len(), &stiffen, [GRAIN_REST_TIME, horizon], watch).0;
        if rested && holds(&run.poses()) {
            break;
        }
    }
    let gone = run.free.iter().filter(|&&i| !run.there[i] && course.lid != Some(i)).count();
    let poses = run.poses();
    let time = run.elapsed;
    Ok(Rest {
        poses,
        rested,
        energy: run.energy,
        gone,
        turned,
        gravity: run.gravity,
        rounds,
        time,
        steps: run.steps,
        seconds: begin.elapsed().as_secs_f64(),
    })
}

struct Flowing<'a> {
    assembly: &'a Assembly,
    units: Units,
    world: World<'a>,
    /// Whether a block is still in the world.
    there: Vec<bool>,
    free: Vec<usize>,
    gravity: Vector3<f64>,
    diameter: f64,
    lost: f64,
    lid: Option<usize>,
    steps: usize,
    /// s.
    elapsed: f64,
    resting: f64,
    energy: f64,
    /// [`RECYCLED`] while grains flow, in the engine's unit of length.
    recycled: f64,
    /// s.
    dt: f64,
    step: Step,
    /// How much finer substeps are than at the start.
    fineness: f64,
    /// √(d/g), s.
    natural: f64,
    rolling: Rolling,
    frictions: &'a Frictions<'a>,
    bodies: &'a [super::bodies::Body],
    /// Greatest moment of inertia over mass; 0 for spheres.
    gyration: Vec<f64>,
}

impl Flowing<'_> {
    fn poses(&self) -> Poses {
        let pose = |i: usize| self.there[i].then(|| (self.center(i), self.world.pose(i).1));
        (0..self.there.len()).map(pose).collect()
    }

    fn center(&self, i: usize) -> Vector3<f64> {
        self.world.pose(i).0 * self.units.length + self.units.origin
    }

    /// One stage, until grains have been at rest for so long, or never came to rest in so long,
    /// √(d/g); whether it came to its end, and by how much gravity had turned when the grains began
    /// to flow.
    fn stage(
        &mut self,
        index: usize,
        change: &Disturbance,
        [still, horizon]: [f64; 2],
        watch: &mut dyn FnMut(&Moment) -> ControlFlow<()>,
    ) -> (bool, Option<f64>) {
        let start: Vec<Vector3<f64>> = (0..self.there.len()).map(|i| self.center(i)).collect();
        let (mut lifted, mut waiting) = (Vec::new(), Vec::new());
        match change {
            Disturbance::Remove(blocks) => blocks.iter().for_each(|&i| self.remove(i)),
            Disturbance::Lift(blocks, ..) => lifted.clone_from(blocks),
            Disturbance::Pour(groups, ..) => {
                waiting.clone_from(groups);
                // Far away and without load until their turn comes.
                for (k, &i) in groups.iter().flatten().enumerate() {
                    self.park(i, k);
                }
            }
            Disturbance::Shear(blocks, speed, _) => {
                let velocity = Vector3::x() * (speed * self.units.time / self.units.length);
                blocks.iter().chain(&self.lid).for_each(|&i| self.world.push(i, velocity));
            }
            Disturbance::Settle
            | Disturbance::Turn(..)
            | Disturbance::Spin(..)
            | Disturbance::Stiffen(_) => {}
        }
        waiting.reverse();
        let mut parked: std::collections::BTreeSet<usize> =
            waiting.iter().flatten().copied().collect();
        let (mut time, mut poured, mut angle, mut way, mut flowing) =
            (0.0, f64::NEG_INFINITY, 0.0, 0.0, !matches!(change, Disturbance::Turn(..)));
        let (mut still_since, mut steps) = (0.0, 0);
        self.resting = 0.0;
        self.load(&BTreeMap::new(), &parked);
        loop {
            let mut loads = false;
            if let Disturbance::Lift(_, speed, height) = change {
                if speed * time > *height {
                    lifted.drain(..).for_each(|i| self.remove(i));
                } else {
                    for &i in &lifted {
                        let at = (start[i] + Vector3::z() * (speed * time) - self.units.origin)
                            / self.units.length;
                        self.world.place(i, at);
                    }
                }
            }
            if let Disturbance::Pour(_, every, drop) = change
                && !waiting.is_empty()
                && time - poured >= *every
            {
                let top = self
                    .free
                    .iter()
                    .filter(|i| self.there[**i] && !parked.contains(i))
                    .map(|&i| self.center(i).z)
                    .fold(0.0, f64::max);
                for i in waiting.pop().into_iter().flatten() {
                    parked.remove(&i);
                    let base = self.assembly.blocks[i].centroid;
                    let at = Vector3::new(base.x, base.y, top + drop);
                    self.world.place(i, (at - self.units.origin) / self.units.length);
                    self.world.stop(i);
                }
                (poured, loads) = (time, true);
            }
            if let (Disturbance::Turn(axis, rate), false) = (change, flowing) {
                angle += rate * self.dt;
                self.gravity = Rotation3::from_axis_angle(axis, angle) * self.assembly.gravity;
                loads = true;
            }
            if let Disturbance::Spin(axis, rate, _) = change {
                // Seen from the supports everything else turns the other way.
                angle += rate * self.dt;
                let back = Rotation3::from_axis_angle(axis, -angle);
                self.gravity = back * self.assembly.gravity;
            }
            let couples = if self.frictions.resist_rolling() {
                self.rolling.torques(
                    self.bodies,
                    self.frictions,
                    &self.world,
                    self.dt / self.units.time,
                )
            } else {
                BTreeMap::new()
            };
            if loads || self.frictions.resist_rolling() {
                self.load(&couples, &parked);
            }
            if let Disturbance::Spin(axis, rate, _) = change {
                self.load_turning(axis.into_inner() * *rate, &couples);
            }
            if let Disturbance::Shear(_, speed, _) = change {
                way += speed * self.dt;
                let velocity = Vector3::x() * (speed * self.units.time / self.units.length);
                self.lid.into_iter().for_each(|i| self.world.push(i, velocity));
            }
            let stiffening = steps < STIFFENED.0 * STIFFENED.1;
            if let Disturbance::Stiffen(by) = change
                && stiffening
                && steps.is_multiple_of(STIFFENED.1)
            {
                self.refine(by.powf(1.0 / STIFFENED.0 as f64));
            }
            steps += 1;
            self.world.step();
            self.steps += 1;
            self.elapsed += self.dt;
            time += self.dt;
            if !self.world.is_healthy() {
                return (false, None);
            }
            if !self.steps.is_multiple_of(LOOK) {
                continue;
            }
            self.look(&parked);
            if !flowing {
                let moved = self
                    .free
                    .iter()
                    .filter(|&&i| {
                        !self.there[i] || (self.center(i) - start[i]).norm() > self.diameter
                    })
                    .count();
                flowing = moved as f64 >= FLOWING * self.free.len() as f64;
                // Steeper than a cliff, or stuck.
                if !flowing && angle > std::f64::consts::FRAC_PI_2 {
                    return (false, None);
                }
            }
            let stiffening = stiffening && matches!(change, Disturbance::Stiffen(_));
            let changing = !lifted.is_empty() || !waiting.is_empty() || !flowing || stiffening;
            if changing {
                still_since = time;
                self.resting = 0.0;
            }
            let flow = Flow { stage: index, time: time / self.natural, energy: self.energy };
            let moment = Moment {
                flow,
                turned: angle,
                way,
                there: &self.there,
                center: &|i| self.center(i),
                force: &|blocks| self.force(blocks),
            };
            if watch(&moment).is_break() {
                return (false, None);
            }
            match change {
                Disturbance::Spin(_, _, most) if angle >= *most => return (true, None),
                Disturbance::Shear(_, _, most) if way >= *most => return (true, None),
                Disturbance::Spin(..) | Disturbance::Shear(..) => continue,
                _ => {}
            }
            let turned = matches!(change, Disturbance::Turn(..)).then_some(angle);
            if self.resting >= still * self.natural && !changing {
                return (true, turned);
            }
            if time - still_since > horizon * self.natural {
                return (false, turned);
            }
        }
    }

    /// Goes on with substeps that are finer by this: at first more of them in about the same step,
    /// for grains that settle hardly move from one to the next, and to find their contacts takes as
    /// long as to solve for them; from the second round on, for grains that roll off others too
    /// slowly to be told, in shorter steps.
    fn refine(&mut self, by: f64) {
        let share = |fineness: f64| {
            let substeps = (SUBSTEPS as f64 * fineness.min(FINER)).round();
            (substeps, substeps / (SUBSTEPS as f64 * fineness))
        };
        let ((_, before), (substeps, now)) = (share(self.fineness), share(self.fineness * by));
        self.fineness *= by;
        self.dt *= now / before;
        self.step.dt *= now / before;
        self.step.iterations = substeps as usize;
        self.world.refine(self.step);
    }

    fn force(&self, blocks: &[usize]) -> Vector3<f64> {
        let patches = self.world.patches();
        let on = |i: usize| f64::from(u8::from(blocks.contains(&i)));
        let sum: Vector3<f64> = patches.iter().map(|p| p.force * (on(p.b) - on(p.a))).sum();
        sum * self.units.force()
    }

    fn remove(&mut self, i: usize) {
        self.world.remove(i);
        self.there[i] = false;
    }

    /// Puts a grain where it meets nothing.
    fn park(&mut self, i: usize, k: usize) {
        let side = 64;
        let (x, y, z) = ((k % side) as f64, (k / side % side) as f64, (k / side / side) as f64);
        let at = Vector3::new(1e3 + 2.0 * x, 2.0 * y, 1e3 + 2.0 * z) * self.diameter;
        self.world.place(i, (at - self.units.origin) / self.units.length);
        self.world.stop(i);
    }

    fn load(
        &mut self,
        couples: &BTreeMap<usize, Vector3<f64>>,
        parked: &std::collections::BTreeSet<usize>,
    ) {
        for &i in self.free.iter().filter(|i| self.there[**i]) {
            let weight = if parked.contains(&i) {
                Vector3::zeros()
            } else {
                self.gravity * self.assembly.blocks[i].mass
            };
            self.world.load(
                i,
                weight / self.units.force(),
                couples.get(&i).copied().unwrap_or_default(),
            );
        }
    }

    /// Discards what fell, and sees whether the rest rests.
    fn look(&mut self, parked: &std::collections::BTreeSet<usize>) {
        for k in 0..self.free.len() {
            let i = self.free[k];
            if self.there[i] && self.center(i).z < self.lost {
                self.remove(i);
            }
        }
        let (mut energy, mut count) = (0.0, 0.0_f64);
        for &i in self.free.iter().filter(|i| self.there[**i] && !parked.contains(i)) {
            let (velocity, spin) = self.world.velocity(i);
            energy += 0.5 * (velocity.norm_squared() + self.gyration[i] * spin.norm_squared());
            count += 1.0;
        }
        // Gravity is one in the engine's units.
        self.energy = energy / count.max(1.0) / (self.diameter / self.units.length);
        self.resting = if self.energy < GRAIN_REST_ENERGY {
            self.resting + LOOK as f64 * self.dt
        } else {
            0.0
        };
        self.world.recycle(if self.resting > 0.0 { 0.0 } else { self.recycled });
    }
}
