//! Grains between walls or in a cell, step by step.
//!
//! Velocity Verlet (Swope et al. 1982): half a kick, a drift, forces at the new places and at the
//! velocities of the half step, half a kick. The history of a contact grows with the same velocities.
//!
//! * W. C. Swope, H. C. Andersen, P. H. Berens, K. R. Wilson, J. Chemical Physics 76 (1982) 637.

mod forces;

use crate::{
    cell::{Cell, Drive, Narrow},
    law::{Friction, Law},
    neighbours::{Bodies, Neighbours},
    wall::Wall,
};
use forces::{Half, Sums};
use nalgebra::{Matrix3, Vector3};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// Width of the skin, in mean radii. More: more pairs that do not touch. Less: lists are found more
/// often. Between 0.1 and 0.3 the time changes by a tenth.
const SKIN: f64 = 0.2;

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Centre, m.
    pub at: Vector3<f64>,
    /// Radius, m.
    pub radius: f64,
    /// Mass, kg; infinite for a grain that stays where it is.
    pub mass: f64,
    /// Velocity, m/s; in a cell that deforms the one beyond the flow.
    pub velocity: Vector3<f64>,
    /// Spin, rad/s.
    pub spin: Vector3<f64>,
}

/// What a world begins with.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The grains.
    pub grains: Vec<Grain>,
    /// The walls.
    pub walls: Vec<Wall>,
    /// The cell; in the open one that does not repeat itself.
    pub cell: Cell,
    /// The law of all contacts.
    pub law: Law,
    /// Friction of grains on grains.
    pub friction: Friction,
    /// Acceleration of free fall, m/s².
    pub gravity: Vector3<f64>,
    /// Length of a step, s.
    pub step: f64,
    /// Threads; the course is the same on any number of them.
    pub threads: usize,
}

/// Two bodies that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Index of a grain.
    pub first: usize,
    /// Index of the other grain, or of a wall after all grains.
    pub second: usize,
    /// Force on the second, N.
    pub force: Vector3<f64>,
}

/// Grains, walls and what holds between them.
pub struct World {
    x: Vec<Vector3<f64>>,
    v: Vec<Vector3<f64>>,
    spin: Vec<Vector3<f64>>,
    force: Vec<Vector3<f64>>,
    torque: Vec<Vector3<f64>>,
    radius: Vec<f64>,
    inverse_mass: Vec<f64>,
    gone: Vec<bool>,
    walls: Vec<Wall>,
    cell: Cell,
    drive: Drive,
    law: Law,
    friction: Friction,
    gravity: Vector3<f64>,
    dt: f64,
    skin: f64,
    /// Where grains were when pairs were found, how the cell has deformed and how far walls have
    /// moved since.
    since: Vec<Vector3<f64>>,
    deformed: Matrix3<f64>,
    way: f64,
    neighbours: Neighbours,
    halves: Vec<Half>,
    sums: Sums,
    motion: Matrix3<f64>,
    /// Whether pairs have to be found before anything else.
    stale: bool,
    stiffest: f64,
    pool: Option<ThreadPool>,
    threaded: bool,
}

impl World {
    /// Sets up a world.
    ///
    /// # Errors
    /// The threads cannot be started.
    pub fn new(setup: Setup) -> Result<Self, ThreadPoolBuildError> {
        let Setup { grains, walls, cell, law, friction, gravity, step, threads } = setup;
        let n = grains.len();
        let mean = grains.iter().map(|g| g.radius).sum::<f64>() / n.max(1) as f64;
        let pool = (threads > 1).then(|| ThreadPoolBuilder::new().num_threads(threads).build());
        Ok(Self {
            x: grains.iter().map(|g| g.at).collect(),
            v: grains.iter().map(|g| g.velocity).collect(),
            spin: grains.iter().map(|g| g.spin).collect(),
            force: vec![Vector3::zeros(); n],
            torque: vec![Vector3::zeros(); n],
            radius: grains.iter().map(|g| g.radius).collect(),
            inverse_mass: grains.iter().map(|g| g.mass.recip()).collect(),
            gone: vec![false; n],
            walls,
            cell,
            drive: Drive::default(),
            law,
            friction,
            gravity,
            dt: step,
            skin: SKIN * mean,
            since: vec![Vector3::zeros(); n],
            deformed: Matrix3::identity(),
            way: 0.0,
            neighbours: Neighbours::default(),
            halves: Vec::new(),
            sums: Sums::default(),
            motion: Matrix3::zeros(),
            stale: true,
            stiffest: 0.0,
            pool: pool.transpose()?,
            threaded: threads > 1,
        })
    }

    /// Goes on by so many steps.
    ///
    /// # Errors
    /// The cell has become too narrow.
    pub fn run(&mut self, steps: usize) -> Result<(), Narrow> {
        let go = |world: &mut Self| (0..steps).try_for_each(|_| world.advance());
        match self.pool.take() {
            None => go(self),
            Some(pool) => {
                let done = pool.install(|| go(self));
                self.pool = Some(pool);
                done
            }
        }
    }

    fn advance(&mut self) -> Result<(), Narrow> {
        if self.stale {
            self.find()?;
            self.press();
            self.kick(0.0);
        }
        let moved = self.drift();
        self.walls.iter_mut().for_each(|w| w.pose.translation.vector += w.velocity * self.dt);
        let speed = self.walls.iter().map(|w| w.velocity.norm()).fold(0.0, f64::max);
        self.way += speed * self.dt;
        self.deformed = self.cell.gradient(self.dt) * self.deformed;
        let strained = (self.deformed - Matrix3::identity()).norm() * self.reach();
        let upright = self.cell.deform(self.dt);
        if upright || 2.0 * moved.max(self.way) + strained > self.skin {
            self.find()?;
        }
        self.press();
        self.kick(0.5 * self.dt);
        self.cell.follow(&self.drive, &self.stress(), self.dt);
        Ok(())
    }

    /// The widest pair of which a list knows, m.
    fn reach(&self) -> f64 {
        2.0 * self.radius.iter().copied().fold(0.0, f64::max) + self.skin
    }

    fn find(&mut self) -> Result<(), Narrow> {
        for x in &mut self.x {
            *x = self.cell.wrapped(x);
        }
        self.neighbours.find(&Bodies {
            x: &self.x,
            radius: &self.radius,
            inverse_mass: &self.inverse_mass,
            gone: &self.gone,
            walls: &self.walls,
            cell: &self.cell,
            skin: self.skin,
        })?;
        self.halves.resize(self.neighbours.second.len(), Half::default());
        self.since.copy_from_slice(&self.x);
        self.deformed = Matrix3::identity();
        self.way = 0.0;
        self.stale = false;
        Ok(())
    }

    /// Normal and shear stresses, compression positive, Pa: (Σ m v ⊗ v + Σ r ⊗ f) / V (Love 1927,
    /// article 83 note; Christoffersen, Mehrabadi & Nemat-Nasser 1981).
    pub fn stress(&self) -> Matrix3<f64> {
        (self.motion + self.sums.virial) / self.cell.volume()
    }

    /// Deforms the cell from now on.
    pub fn drive(&mut self, drive: Drive) {
        self.drive = drive;
    }

    /// The cell as it is.
    pub fn cell(&self) -> &Cell {
        &self.cell
    }

    /// Pairs of bodies that touch, in the order of the first.
    pub fn contacts(&self) -> impl Iterator<Item = Contact> + '_ {
        let list = &self.neighbours;
        let of = |i: usize| list.start[i] as usize..list.start[i + 1] as usize;
        (0..list.start.len().saturating_sub(1)).flat_map(move |first| {
            of(first).filter(|p| list.touching[*p]).map(move |p| Contact {
                first,
                second: list.second[p] as usize,
                force: self.halves[p].force,
            })
        })
    }

    /// Centres of the grains, m.
    pub fn places(&self) -> &[Vector3<f64>] {
        &self.x
    }

    /// Their velocities, m/s; in a cell those beyond the flow.
    pub fn velocities(&self) -> &[Vector3<f64>] {
        &self.v
    }

    /// Their spins, rad/s.
    pub fn spins(&self) -> &[Vector3<f64>] {
        &self.spin
    }

    /// Their radii, m.
    pub fn radii(&self) -> &[f64] {
        &self.radius
    }

    /// Kinetic energy of all grains without their spin, J.
    pub fn energy(&self) -> f64 {
        0.5 * self.motion.trace()
    }

    /// Shortest period of a contact so far over the length of a step; infinite before there was one.
    pub fn steps_in_shortest_period(&self) -> f64 {
        std::f64::consts::TAU / self.stiffest.sqrt() / self.dt
    }

    /// Greatest overlap of two bodies in the last step, m.
    pub fn overlap(&self) -> f64 {
        self.sums.overlap
    }
}
