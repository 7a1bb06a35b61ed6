//! An interior-point method for programs of contacts.
//!
//! `min ½ xᵀ P x + cᵀ x` subject to `E x = b`, `G x + s = h`, `s` in rays and second-order cones:
//! primal–dual path following with Nesterov–Todd scaling and Mehrotra's predictor and corrector
//! (Mehrotra 1992, Vandenberghe 2010), from an infeasible start. It is written for one reason: in
//! these programs the cones are eliminated contact by contact, and what is left ([`reduced`]) is
//! the stiffness matrix of the blocks.
//!
//! Like every engine it is believed in nothing: forces and rates are recomputed from the scene.

mod columns;
mod cones;
mod correctors;
mod newton;
mod panels;
mod path;
mod reduced;
mod step;
mod structure;

use self::{
    cones::Cones,
    newton::Iterate,
    path::{Data, Inside, greatest},
    reduced::Reduced,
    structure::Structure,
};
use super::{Passed, Settings, Solution, Status};
use crate::{clock::Instant, program::ConicProgram};

/// A program that is solved several times with changed right-hand sides and objectives: pattern and
/// ordering are kept.
pub struct Session {
    structure: Structure,
    reduced: Reduced,
    rhs: Vec<f64>,
    objective: Vec<f64>,
    settings: Settings,
    start: Instant,
    /// How the unknowns are held ([`path::HELD`] or zero), once those of a solve grew without bound.
    held: Option<f64>,
    /// Where the next solve begins: a point that the last solve passed.
    warm: Option<Inside>,
    /// The same for the next solve alone, of another program; what does not lead to an answer from
    /// there is solved from its own start.
    near: Option<Inside>,
}

/// A point of another program is moved this × the greatest entry inside every cone. Larger: a start as
/// poor as without. Smaller: first steps that end at once; eight tilts of 4,000 grains take 47
/// iterations with this, 49 with ten times, 97 with a hundred times as much, 161 without, and 85 each
/// from its own start.
const ROOM: f64 = 1e-3;

impl Session {
    /// Sets a program up; `None` where it is not one of contacts.
    pub fn new(program: &ConicProgram, settings: &Settings) -> Option<Self> {
        let start = Instant::now();
        let structure = Structure::new(program)?;
        if structure.equalities.is_empty() {
            return None;
        }
        let reduced = Reduced::new(&structure)?;
        Some(Self {
            structure,
            reduced,
            rhs: program.rhs.clone(),
            objective: program.objective.clone(),
            settings: *settings,
            start,
            held: None,
            warm: None,
            near: None,
        })
    }

    /// Where the next solve begins: near a point that a program alike passed; false where that has other
    /// sizes.
    pub fn begin_near(&mut self, passed: &Passed) -> bool {
        let st = &self.structure;
        let [x, slack, z] = [&passed.x, &passed.slack, &passed.z].map(Vec::len);
        let fits = x == self.objective.len() && slack == self.rhs.len() && z == slack;
        if fits {
            let cones = Cones::new(&st.cones);
            let inside = |mut v: Vec<f64>| {
                let room = ROOM * greatest(&v);
                cones.inward(&mut v, room);
                v
            };
            let point = Iterate {
                x: pick(&passed.x, &st.variables),
                t: pick(&passed.x, &st.border),
                y: pick(&passed.z, &st.equalities),
                z: inside(pick(&passed.z, &st.cone_rows)),
            };
            self.near = Some((point, inside(pick(&passed.slack, &st.cone_rows))));
        }
        fits
    }

    /// Changes the right-hand side; false where it has another length.
    pub fn set_rhs(&mut self, rhs: &[f64]) -> bool {
        let fits = rhs.len() == self.rhs.len();
        if fits {
            self.rhs.copy_from_slice(rhs);
        }
        fits
    }

    /// Changes the objective; false where it has another length.
    pub fn set_objective(&mut self, objective: &[f64]) -> bool {
        let fits = objective.len() == self.objective.len();
        if fits {
            self.objective.copy_from_slice(objective);
        }
        fits
    }

    /// Solves the program as it stands.
    pub fn solve(&mut self) -> Solution {
        let st = &self.structure;
        let data = Data {
            c: pick(&self.objective, &st.variables),
            c_border: pick(&self.objective, &st.border),
            b: pick(&self.rhs, &st.equalities),
            h: pick(&self.rhs, &st.cone_rows),
        };
        let mut follow = |held, from| {
            path::follow(st, &mut self.reduced, &data, &self.settings, (self.start, held), from)
        };
        let held = self.held.unwrap_or(0.0);
        let near = self.near.take();
        let is_near = near.is_some();
        let mut done = follow(held, near.or_else(|| self.warm.take()));
        if is_near && done.status == Status::Stalled {
            let other = follow(held, None);
            // Where time ends before the first step, there is no other.
            done = if other.point.is_some() { other.after(done) } else { done.after(other) };
        }
        if self.held.is_none() && done.has_grown() {
            let other = follow(path::HELD, None);
            let better = other.status == Status::Solved
                || (other.status == Status::AlmostSolved && done.status == Status::Stalled);
            // What does not help is not tried again.
            self.held = Some(if better { path::HELD } else { 0.0 });
            done = if better { other.after(done) } else { done.after(other) };
        }
        let (mut x, mut z) = (Vec::new(), Vec::new());
        if let Some(p) = done.point {
            (x, z) = self.spread(&p);
        }
        let passed = done.early.map(|(p, s)| {
            let (x, z) = self.spread(&p);
            let mut slack = vec![0.0; z.len()];
            put(&mut slack, &self.structure.cone_rows, &s);
            Passed { x, slack, z }
        });
        self.warm = done.late;
        let seconds = std::mem::replace(&mut self.start, Instant::now()).elapsed().as_secs_f64();
        Solution { x, z, status: done.status, trace: done.trace, seconds, passed }
    }

    /// Variables and multipliers of a point, in the order of the program.
    fn spread(&self, p: &Iterate) -> (Vec<f64>, Vec<f64>) {
        let st = &self.structure;
        let (mut x, mut z) = (vec![0.0; self.objective.len()], vec![0.0; self.rhs.len()]);
        put(&mut x, &st.variables, &p.x);
        put(&mut x, &st.border, &p.t);
        put(&mut z, &st.equalities, &p.y);
        put(&mut z, &st.cone_rows, &p.z);
        (x, z)
    }
}

fn pick(from: &[f64], at: &[usize]) -> Vec<f64> {
    at.iter().map(|&k| from[k]).collect()
}

fn put(to: &mut [f64], at: &[usize], from: &[f64]) {
    at.iter().zip(from).for_each(|(&k, v)| to[k] = *v);
}

#[cfg(test)]
mod tests;
