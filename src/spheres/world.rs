//! Grains between walls or in a cell, step by step.
//!
//! Velocity Verlet (Swope et al. 1982): half a kick, a drift, forces at the new places and at the
//! velocities of the half step, half a kick. The history of a contact grows with the same velocities.
//!
//! The passes over grains and pairs of a step are halved down to leaves of a fixed size, and sums are made
//! along that tree, so that threads change no bit.
//!
//! * W. C. Swope, H. C. Andersen, P. H. Berens, K. R. Wilson, J. Chemical Physics 76 (1982) 637.

use crate::{
    cell::{Cell, Drive, Narrow},
    law::{Friction, Law, Memory, Pair},
    neighbours::{Bodies, Neighbours},
    wall::Wall,
};
use nalgebra::{Matrix3, Vector3};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::mem::take;

/// Width of the skin, in mean radii. More: more pairs that do not touch. Less: lists are found more
/// often. Between 0.1 and 0.3 the time changes by a tenth.
const SKIN: f64 = 0.2;

/// Grains of a leaf. More: threads wait for each other. Fewer: time to hand out work.
const LEAF: usize = 256;

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

/// What the second body of a contact gets.
#[derive(Clone, Copy, Debug, Default)]
struct Half {
    pub force: Vector3<f64>,
    torque: Vector3<f64>,
}

/// Sums over contacts.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    pub virial: Matrix3<f64>,
    pub overlap: f64,
    stiffness: f64,
}

/// Some grains from one on, as far as a pass changes them, and their pairs as the first of them.
struct Part<'a> {
    first: usize,
    grains: [&'a mut [Vector3<f64>]; 4],
    memory: &'a mut [Memory],
    touching: &'a mut [bool],
    halves: &'a mut [Half],
}

impl<'a> Part<'a> {
    fn of_grains(grains: [&'a mut [Vector3<f64>]; 4]) -> Self {
        Self { first: 0, grains, memory: &mut [], touching: &mut [], halves: &mut [] }
    }

    fn len(&self) -> usize {
        self.grains[0].len()
    }

    fn split(self, start: &[u32]) -> (Self, Self) {
        let half = self.len() / 2;
        let pairs = if self.memory.is_empty() {
            0
        } else {
            (start[self.first + half] - start[self.first]) as usize
        };
        let [a, b, c, d] = self.grains.map(|all| all.split_at_mut(half.min(all.len())));
        let (memory, memory_b) = self.memory.split_at_mut(pairs);
        let (touching, touching_b) = self.touching.split_at_mut(pairs);
        let (halves, halves_b) = self.halves.split_at_mut(pairs);
        let (grains, grains_b) = ([a.0, b.0, c.0, d.0], [a.1, b.1, c.1, d.1]);
        let second = Part {
            first: self.first + half,
            grains: grains_b,
            memory: memory_b,
            touching: touching_b,
            halves: halves_b,
        };
        (Part { first: self.first, grains, memory, touching, halves }, second)
    }
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

impl World {
    /// Half a kick and the drift of a step; how far the farthest grain has moved beyond the flow
    /// since pairs were found, m.
    fn drift(&mut self) -> f64 {
        let (mut x, mut v, mut spin) = (take(&mut self.x), take(&mut self.v), take(&mut self.spin));
        let part = Part::of_grains([&mut x, &mut v, &mut spin, &mut []]);
        let moved = self.over(part, &|part| self.drift_leaf(part), f64::max);
        (self.x, self.v, self.spin) = (x, v, spin);
        moved.sqrt()
    }

    fn drift_leaf(&self, part: Part) -> f64 {
        let Part { first, grains: [x, v, spin, _], .. } = part;
        let deformed = self.cell.gradient(self.dt) * self.deformed;
        let mut moved = 0.0_f64;
        for k in 0..x.len() {
            let i = first + k;
            let efforts = [&self.force[i], &self.torque[i]];
            self.push(i, 0.5 * self.dt, efforts, &mut v[k], &mut spin[k]);
            x[k] += (v[k] + self.cell.flow(&x[k])) * self.dt;
            moved = moved.max((x[k] - deformed * self.since[i]).norm_squared());
        }
        moved
    }

    #[inline]
    fn push(
        &self,
        i: usize,
        time: f64,
        [force, torque]: [&Vector3<f64>; 2],
        v: &mut Vector3<f64>,
        spin: &mut Vector3<f64>,
    ) {
        let inverse_mass = self.inverse_mass[i];
        if inverse_mass == 0.0 {
            return;
        }
        *v += (force * inverse_mass + self.gravity - self.cell.flow(v)) * time;
        let r = self.radius[i];
        *spin += torque * (time * 2.5 * inverse_mass / (r * r));
    }

    /// Contact forces at the places and velocities as they are; every grain has those of its pairs
    /// as the first of them.
    fn press(&mut self) {
        let (mut force, mut torque) = (take(&mut self.force), take(&mut self.torque));
        let mut memory = take(&mut self.neighbours.memory);
        let mut touching = take(&mut self.neighbours.touching);
        let mut halves = take(&mut self.halves);
        let part = Part {
            first: 0,
            grains: [&mut force, &mut torque, &mut [], &mut []],
            memory: &mut memory,
            touching: &mut touching,
            halves: &mut halves,
        };
        self.sums = self.over(part, &|part| self.press_leaf(part), |a, b| Sums {
            virial: a.virial + b.virial,
            overlap: a.overlap.max(b.overlap),
            stiffness: a.stiffness.max(b.stiffness),
        });
        (self.force, self.torque, self.halves) = (force, torque, halves);
        (self.neighbours.memory, self.neighbours.touching) = (memory, touching);
        self.stiffest = self.stiffest.max(self.sums.stiffness);
    }

    fn press_leaf(&self, part: Part) -> Sums {
        let Part { first, grains: [force, torque, ..], memory, touching, halves } = part;
        let list = &self.neighbours;
        let (mut sums, base) = (Sums::default(), list.start[first] as usize);
        for k in 0..force.len() {
            let i = first + k;
            let (mut f, mut t) = (Vector3::zeros(), Vector3::zeros());
            for p in list.start[i] as usize..list.start[i + 1] as usize {
                let at = p - base;
                let Some((pair, arms, friction)) = self.pair(i, p) else {
                    if touching[at] {
                        (touching[at], memory[at]) = (false, Memory::default());
                    }
                    continue;
                };
                touching[at] = true;
                let effort = self.law.step(&pair, friction, self.dt, &mut memory[at]);
                let twist = pair.normal.cross(&effort.force);
                f -= effort.force;
                t -= twist * arms[0] + effort.couple;
                halves[at] = Half { force: effort.force, torque: effort.couple - twist * arms[1] };
                let reach = arms[0] + arms[1];
                sums.virial += pair.normal * effort.force.transpose() * reach;
                sums.overlap = sums.overlap.max(pair.overlap);
                sums.stiffness = sums.stiffness.max(effort.stiffness);
            }
            (force[k], torque[k]) = (f, t);
        }
        sums
    }

    /// The bodies of a pair where they touch, how far the contact is from their centres, and their
    /// friction.
    #[inline]
    fn pair(&self, i: usize, p: usize) -> Option<(Pair, [f64; 2], &Friction)> {
        let j = self.neighbours.second[p] as usize;
        let radius = self.radius[i];
        if j >= self.x.len() {
            return self.on_wall(i, &self.walls[j - self.x.len()]);
        }
        let way = self.x[j] - self.x[i] + self.cell.image(self.neighbours.image[p]);
        let (squared, sum) = (way.norm_squared(), radius + self.radius[j]);
        if squared >= sum * sum {
            return None;
        }
        let distance = squared.sqrt();
        let normal = way / distance;
        let overlap = sum - distance;
        let arms = [radius - 0.5 * overlap, self.radius[j] - 0.5 * overlap];
        let masses = [self.inverse_mass[i], self.inverse_mass[j]];
        let spins = [self.spin[i], self.spin[j]];
        let turned = (spins[0] * arms[0] + spins[1] * arms[1]).cross(&normal);
        let inertia = |r: f64, inverse_mass: f64| inverse_mass / (1.4 * r * r);
        let pair = Pair {
            normal,
            overlap,
            radius: radius * self.radius[j] / sum,
            mass: (masses[0] + masses[1]).recip(),
            velocity: self.v[j] - self.v[i] + self.cell.flow(&way) - turned,
            rolling: spins[0] - spins[1],
            turning: (spins[0] + spins[1]) * 0.5,
            inertia: (inertia(radius, masses[0]) + inertia(self.radius[j], masses[1])).recip(),
        };
        Some((pair, arms, &self.friction))
    }

    fn on_wall<'a>(
        &'a self,
        i: usize,
        wall: &'a crate::wall::Wall,
    ) -> Option<(Pair, [f64; 2], &'a Friction)> {
        let (distance, normal) = wall.nearest(&self.x[i]);
        let radius = self.radius[i];
        if distance >= radius {
            return None;
        }
        let mass = self.inverse_mass[i].recip();
        let pair = Pair {
            normal,
            overlap: radius - distance,
            radius,
            mass,
            velocity: wall.velocity - self.v[i] - self.spin[i].cross(&normal) * distance,
            rolling: self.spin[i],
            turning: self.spin[i] * 0.5,
            inertia: 1.4 * mass * radius * radius,
        };
        Some((pair, [distance, 0.0], &wall.friction))
    }

    /// Adds to every grain what it gets as the second of pairs, and the kick of so much time, s.
    fn kick(&mut self, time: f64) {
        let (mut v, mut spin) = (take(&mut self.v), take(&mut self.spin));
        let (mut force, mut torque) = (take(&mut self.force), take(&mut self.torque));
        let part = Part::of_grains([&mut v, &mut spin, &mut force, &mut torque]);
        self.motion = self.over(part, &|part| self.kick_leaf(part, time), |a, b| a + b);
        (self.v, self.spin, self.force, self.torque) = (v, spin, force, torque);
    }

    fn kick_leaf(&self, part: Part, time: f64) -> Matrix3<f64> {
        let Part { first, grains: [v, spin, force, torque], .. } = part;
        let (list, mut motion) = (&self.neighbours, Matrix3::zeros());
        for k in 0..v.len() {
            let i = first + k;
            let (mut f, mut t) = (Vector3::zeros(), Vector3::zeros());
            let range = list.incoming_start[i] as usize..list.incoming_start[i + 1] as usize;
            for &p in &list.incoming[range] {
                if list.touching[p as usize] {
                    let half = &self.halves[p as usize];
                    f += half.force;
                    t += half.torque;
                }
            }
            force[k] += f;
            torque[k] += t;
            self.push(i, time, [&force[k], &torque[k]], &mut v[k], &mut spin[k]);
            if self.inverse_mass[i] > 0.0 {
                motion += v[k] * v[k].transpose() / self.inverse_mass[i];
            }
        }
        motion
    }

    /// Does a part leaf by leaf.
    fn over<'a, R: Send>(
        &self,
        part: Part<'a>,
        leaf: &(impl Fn(Part) -> R + Sync),
        sum: fn(R, R) -> R,
    ) -> R {
        if part.len() <= LEAF {
            return leaf(part);
        }
        let (a, b) = part.split(&self.neighbours.start);
        let (first, second) = if self.threaded {
            rayon::join(|| self.over(a, leaf, sum), || self.over(b, leaf, sum))
        } else {
            (self.over(a, leaf, sum), self.over(b, leaf, sum))
        };
        sum(first, second)
    }
}
