//! The passes over grains and pairs of one step. Work is halved down to leaves of a fixed size, and
//! sums are made along that tree, so that threads change no bit.

use super::World;
use crate::law::{Friction, Memory, Pair};
use nalgebra::{Matrix3, Vector3};
use std::mem::take;

/// Grains of a leaf. More: threads wait for each other. Fewer: time to hand out work.
const LEAF: usize = 256;

/// What the second body of a contact gets.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Half {
    pub force: Vector3<f64>,
    torque: Vector3<f64>,
}

/// Sums over contacts.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
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

impl World {
    /// Half a kick and the drift of a step; how far the farthest grain has moved beyond the flow
    /// since pairs were found, m.
    pub(super) fn drift(&mut self) -> f64 {
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
    pub(super) fn press(&mut self) {
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
    pub(super) fn kick(&mut self, time: f64) {
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
