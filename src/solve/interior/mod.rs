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

use self::{newton::Point, path::Data, reduced::Reduced, structure::Structure};
use super::{Settings, Solution, Status};
use crate::program::ConicProgram;
use std::time::Instant;

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
    /// A point well inside that the last solve passed, where the next may begin.
    warm: Option<(Point, Vec<f64>)>,
}

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
        })
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
        let s = &self.structure;
        let pick = |from: &[f64], at: &[usize]| at.iter().map(|&k| from[k]).collect::<Vec<f64>>();
        let data = Data {
            c: pick(&self.objective, &s.variables),
            c_border: pick(&self.objective, &s.border),
            b: pick(&self.rhs, &s.equalities),
            h: pick(&self.rhs, &s.cone_rows),
        };
        let mut follow = |held, warm: &mut _| {
            let (reduced, settings, mut trace) = (&mut self.reduced, &self.settings, Vec::new());
            let (found, status) =
                path::follow(s, reduced, &data, settings, (self.start, held), warm, &mut trace);
            (found, status, trace)
        };
        let (mut found, mut status, mut trace) = follow(self.held.unwrap_or(0.0), &mut self.warm);
        if self.held.is_none() && path::has_grown(&found, status) {
            let mut warm = None;
            let (other, word, mut more) = follow(path::HELD, &mut warm);
            let better = word == Status::Solved
                || (word == Status::AlmostSolved && status == Status::Stalled);
            // The last iteration is that of the answer; what does not help is not tried again.
            if better {
                trace.append(&mut more);
                (found, status, self.held, self.warm) = (other, word, Some(path::HELD), warm);
            } else {
                more.append(&mut trace);
                (trace, self.held) = (more, Some(0.0));
            }
        }
        let (mut x, mut z) = (Vec::new(), Vec::new());
        if let Some(p) = found {
            (x, z) = (vec![0.0; self.objective.len()], vec![0.0; self.rhs.len()]);
            let put = |to: &mut [f64], at: &[usize], from: &[f64]| {
                at.iter().zip(from).for_each(|(&k, v)| to[k] = *v)
            };
            put(&mut x, &s.variables, &p.x);
            put(&mut x, &s.border, &p.t);
            put(&mut z, &s.equalities, &p.y);
            put(&mut z, &s.cone_rows, &p.z);
        }
        let seconds = std::mem::replace(&mut self.start, Instant::now()).elapsed().as_secs_f64();
        Solution { x, z, status, trace, seconds }
    }
}

#[cfg(test)]
mod tests;
