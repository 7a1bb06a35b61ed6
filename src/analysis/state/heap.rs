//! Heaps of spheres: hundreds of contacts slide at once, and steps that go straight for balance lead to
//! where less is left but nothing balances.
//!
//! They are relaxed instead, as if in something viscous: a multiple of the diagonal on the tangent is
//! one over a step in time, and grows shorter as less is left unbalanced (pseudo-transient
//! continuation, "switched evolution relaxation"; Kelley & Keyes, SIAM J. Numer. Anal. 35, 1998). At the
//! end it is Newton's method.

use super::{
    incomplete::{CLOSELY, solved},
    newton::{BALANCED, Equations, GLUE, GOOD, Newton, scaled},
};
use crate::{analysis::Control, assembly::Wrench, verdict::Rate, yielding::State};

/// The first multiple of the diagonal. More: more steps. Less: what slides overshoots.
const FIRST: f64 = 0.1;
/// The least one: motions that meet no resistance. More: fewer digits a step. Less: pivots of rounding.
const LEAST: f64 = 1e-9;
/// The greatest one.
const MOST: f64 = 10.0;
/// Most steps. Those that get there take two or three dozens. More: minutes for nothing.
const STEPS: usize = 60;
/// What a solution of the equations leaves of their right side, far from balance. More: steps astray.
/// Less: time.
const ROUGHLY: f64 = 1e-2;
/// Balance from which on equations are solved closely.
const NEAR: f64 = 1e-4;

impl Newton<'_> {
    /// Displacements at which the loads are balanced, from those of `from`: of heaps relaxed, where that
    /// gets there.
    pub fn rest(
        &mut self,
        state: &State,
        loads: &[Wrench],
        from: &[Rate],
        control: &Control,
    ) -> Option<Vec<Rate>> {
        if self.heap {
            let glued = self.search(state, loads, from.to_vec(), GLUE[0], control);
            let found = glued.and_then(|glued| self.relax(state, loads, glued, control));
            if found.is_some() {
                return found;
            }
        }
        self.balance(state, loads, from, control)
    }

    /// The same; nothing where they are not balanced after all steps.
    fn relax(
        &mut self,
        state: &State,
        loads: &[Wrench],
        mut displaced: Vec<Rate>,
        control: &Control,
    ) -> Option<Vec<Rate>> {
        let (mut left, mut size) = self.residual(state, loads, &displaced, 0.0);
        let mut shift = FIRST;
        for _ in 0..STEPS {
            if size <= BALANCED {
                return Some(displaced);
            }
            if control.deadline.is_over() {
                return None;
            }
            self.steps += 1;
            let Equations { unit, lower, upper, right } =
                self.equations(state, &displaced, 0.0, &left, shift);
            let share = if size > NEAR { ROUGHLY } else { CLOSELY };
            let pattern = &self.system.pattern;
            let way = solved(pattern, &lower, &upper, &right, share).and_then(|x| scaled(x, &unit));
            let Some(way) = way else {
                shift = MOST.min(10.0 * shift);
                continue;
            };
            let next = self.moved(&displaced, &way, 1.0);
            let (r, new) = self.residual(state, loads, &next, 0.0);
            if !new.is_finite() || (size <= GOOD && new >= size) {
                break;
            }
            shift = (shift * new / size).clamp(LEAST, MOST);
            (displaced, left, size) = (next, r, new);
        }
        (size <= GOOD).then_some(displaced)
    }
}
