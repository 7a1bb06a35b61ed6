//! Newton's method for the displacements at which elastic joints balance the loads.
//!
//! The unknowns are six displacements a free block, the equations their balance; the tangent is
//! that of the laws themselves, blocks of 6 × 6, unsymmetric where something slides. Where the scene
//! has motions that no joint resists (a sphere that rolls) a small multiple of the diagonal is
//! added, which is zero at the solution. Where Newton's method does not get there from where it
//! starts, joints are glued by a share that is taken away by and by (continuation); what is found
//! with glue counts for nothing.

use super::{
    equations::{Equations, scaled},
    incomplete,
};
use crate::Control;
use check::{
    elastic::{ElasticState, System, law::Friction},
    verdict::Rate,
};
use model::assembly::Wrench;
use nalgebra::Vector3;
use solve::{Cholesky, Fronts, Lu};

/// Balance that is reached, by the measure of the joints' stiffness. Less: rounding of displacements
/// keeps tall scenes from it. More: forces have fewer digits than their check asks for.
pub(super) const BALANCED: f64 = 1e-13;
/// Balance that is good enough where rounding keeps from more. More: the check of the forces fails.
pub(super) const GOOD: f64 = 1e-9;
/// Most steps of one search. Fewer: joints that open one by one are given up. More: minutes where
/// there is nothing to find.
const STEPS: usize = 60;
/// Halvings of a step at most.
const HALVINGS: usize = 6;
/// Shares of the diagonal that are added where a motion meets no resistance, the next one where the one
/// before leads nowhere. More at first: steps are short. Less: rounding of the factors decides.
const SHIFTS: [f64; 6] = [1e-12, 1e-8, 1e-6, 1e-4, 1e-2, 1.0];
/// Differences of mirrored entries that are rounding, in multiples of the diagonal. More: steps of what
/// slides point aside. Less: everything is taken for unsymmetric, which costs time alone.
const SYMMETRIC: f64 = 1e-13;
/// A step is taken where the work that is left along it is less than this share. More: searches go
/// to and fro. Less: steps are short.
const LESS_WORK: f64 = 0.5;
/// Most steps that leave more than was left before.
const WORSE: usize = 20;
/// Shares of glue, one after the other.
pub(super) const GLUE: [f64; 9] = [0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5];

/// What solves the equations of a model.
pub struct Newton<'a> {
    pub(super) system: &'a System<'a>,
    /// For each free block the structure that it belongs to.
    part: Vec<usize>,
    lu: Option<Lu>,
    cholesky: Option<Cholesky>,
    pub(super) fronts: Option<Fronts>,
    /// Whether equations are solved with incomplete factors where that is enough.
    pub(super) heap: bool,
    /// Steps that it took so far.
    pub steps: usize,
}

impl<'a> Newton<'a> {
    /// Of these equations.
    pub fn new(system: &'a System<'a>) -> Self {
        let (lu, cholesky) = (None, None);
        Self {
            system,
            part: system.parts(),
            lu,
            cholesky,
            fronts: None,
            heap: incomplete::serve(system),
            steps: 0,
        }
    }

    /// Of these displacements those that are nearest to balance.
    pub fn nearest(
        &self,
        state: &ElasticState,
        loads: &[Wrench],
        from: Vec<Vec<Rate>>,
    ) -> Vec<Rate> {
        let size = |q: &Vec<Rate>| self.residual(state, loads, q, 0.0, Friction::Follows).1;
        let best = from.into_iter().map(|q| (size(&q), q));
        best.min_by(|a, b| a.0.total_cmp(&b.0)).map_or_else(|| state.displaced.clone(), |b| b.1)
    }

    /// The same without glue: where the last state is near.
    pub fn follow(
        &mut self,
        state: &ElasticState,
        loads: &[Wrench],
        from: &[Rate],
        control: &Control,
    ) -> Option<Vec<Rate>> {
        self.search(state, loads, from.to_vec(), 0.0, control)
    }

    /// Displacements at which the loads are balanced, from those of `from`, by joints that remember
    /// `state`; nothing where none were found.
    pub fn balance(
        &mut self,
        state: &ElasticState,
        loads: &[Wrench],
        from: &[Rate],
        control: &Control,
    ) -> Option<Vec<Rate>> {
        let first = self.search(state, loads, from.to_vec(), 0.0, control);
        if let Some(displaced) = first {
            return Some(displaced);
        }
        // Glued wholly it is one step.
        let mut displaced = self.search(state, loads, from.to_vec(), 1.0, control)?;
        for glue in GLUE {
            if let Some(next) = self.search(state, loads, displaced.clone(), glue, control) {
                displaced = next;
                let last = self.search(state, loads, displaced.clone(), 0.0, control);
                if let Some(displaced) = last {
                    return Some(displaced);
                }
            } else {
                return None;
            }
        }
        None
    }

    /// The displacements of glued joints: where a search begins.
    pub fn guess(
        &mut self,
        state: &ElasticState,
        loads: &[Wrench],
        control: &Control,
    ) -> Vec<Rate> {
        let start = vec![Rate::zero(); state.displaced.len()];
        self.search(state, loads, start.clone(), 1.0, control).unwrap_or(start)
    }

    pub(super) fn search(
        &mut self,
        state: &ElasticState,
        loads: &[Wrench],
        mut displaced: Vec<Rate>,
        glue: f64,
        control: &Control,
    ) -> Option<Vec<Rate>> {
        let (mut left, mut size) = self.residual(state, loads, &displaced, glue, Friction::Follows);
        let mut worse = 0;
        for _ in 0..STEPS {
            if control.deadline.is_over() {
                return None;
            }
            if size <= BALANCED {
                return Some(displaced);
            }
            self.steps += 1;
            let mut best: Option<(f64, Vec<Rate>, Vec<f64>)> = None;
            // Where the tangent says nothing (what slides resists no more) steps are damped.
            'damped: for shift in SHIFTS {
                let Some(way) = self.way(state, &displaced, glue, &left, shift) else { continue };
                let mut share = 1.0;
                for _ in 0..HALVINGS {
                    let next = self.moved(&displaced, &way, share);
                    let (r, new) = self.residual(state, loads, &next, glue, Friction::Follows);
                    if best.as_ref().is_none_or(|b| new < b.0) {
                        best = Some((new, next.clone(), r.clone()));
                    }
                    if best.as_ref().is_some_and(|b| b.0 < (1.0 - 1e-4 * share) * size) {
                        break 'damped;
                    }
                    // What is left does less work along the step: in a curved valley, where sizes
                    // say little, that is progress (Crisfield 1982).
                    if work(&r, &way).abs() <= LESS_WORK * work(&left, &way).abs() {
                        best = Some((new, next, r));
                        break 'damped;
                    }
                    share *= 0.5;
                }
                if size <= GOOD {
                    break;
                }
            }
            let (new, next, r) = best?;
            if new >= size && (size <= GOOD || !new.is_finite() || worse > WORSE) {
                // Rounding: what is good enough is taken.
                return (size <= GOOD).then_some(displaced);
            }
            worse += usize::from(new >= size);
            (displaced, left, size) = (next, r, new);
        }
        (size <= GOOD).then_some(displaced)
    }

    /// What is left of the loads, and its size: by the displacement that it makes, in multiples of
    /// that of all that acts, of every structure by itself. So a heavy one beside it lets no other
    /// off.
    pub(super) fn residual(
        &self,
        state: &ElasticState,
        loads: &[Wrench],
        displaced: &[Rate],
        glue: f64,
        friction: Friction,
    ) -> (Vec<f64>, f64) {
        let [left, passing] = self.system.left(state, loads, displaced, glue, friction);
        let mut sums = vec![[0.0; 2]; self.part.len()];
        for (k, d) in self.system.diagonal.iter().enumerate() {
            let sum = &mut sums[self.part[k / 6]];
            sum[0] += left[k] * left[k] / d;
            sum[1] += passing[k] * passing[k] / d;
        }
        let size = sums.iter().filter(|s| s[1] > 0.0).map(|s| s[0] / s[1]).sum::<f64>().sqrt();
        (left, size)
    }

    pub(super) fn moved(&self, displaced: &[Rate], way: &[f64], share: f64) -> Vec<Rate> {
        let mut next = displaced.to_vec();
        for (row, &i) in self.system.free.iter().enumerate() {
            let w = &way[6 * row..6 * row + 6];
            next[i].velocity += Vector3::new(w[0], w[1], w[2]) * share;
            next[i].spin += Vector3::new(w[3], w[4], w[5]) * share;
        }
        next
    }

    fn way(
        &mut self,
        state: &ElasticState,
        displaced: &[Rate],
        glue: f64,
        left: &[f64],
        shift: f64,
    ) -> Option<Vec<f64>> {
        let pattern = &self.system.pattern;
        let Equations { unit, lower, upper, right: mut x } =
            self.equations(state, displaced, glue, Friction::Follows, left, shift);
        if self.heap
            && let Some(x) = incomplete::solved(pattern, &lower, &upper, &x, incomplete::CLOSELY)
        {
            return scaled(x, &unit);
        }
        let off = |(l, u): (&f64, &f64)| (l - u).abs();
        let symmetric = lower.iter().zip(&upper).map(off).fold(0.0, f64::max) <= SYMMETRIC;
        let solved = symmetric && {
            if self.cholesky.is_none() {
                self.cholesky = Cholesky::new(pattern.clone());
            }
            self.cholesky.as_mut().is_some_and(|c| {
                let good = c.factorize(&lower);
                if good {
                    c.solve(&mut x);
                }
                good
            })
        };
        if !solved {
            if self.lu.is_none() {
                self.lu = Lu::whole(pattern);
            }
            if !self.lu.as_mut()?.solve(&lower, &upper, &mut x) {
                return None;
            }
        }
        scaled(x, &unit)
    }

    /// The tangent and what is left, in the measure of the joints' stiffness.
    pub(super) fn equations(
        &self,
        state: &ElasticState,
        displaced: &[Rate],
        glue: f64,
        friction: Friction,
        left: &[f64],
        shift: f64,
    ) -> Equations {
        let tangent = self.system.tangent(state, displaced, glue, friction);
        let unit: Vec<f64> = self.system.diagonal.iter().map(|d| d.sqrt()).collect();
        let [lower, upper] = self.system.values(&tangent, &unit, shift);
        let right = left.iter().zip(&unit).map(|(r, d)| r / d).collect();
        Equations { unit, lower, upper, right }
    }
}

/// The work of what is left along a step.
fn work(left: &[f64], way: &[f64]) -> f64 {
    left.iter().zip(way).map(|(r, w)| r * w).sum()
}
