//! Heaps of spheres: hundreds of contacts slide at once, and steps that go straight for balance lead to
//! where less is left but nothing balances.
//!
//! They are relaxed instead, as if in something viscous: a multiple of the diagonal on the tangent is
//! one over a step in time, and grows shorter as less is left unbalanced (pseudo-transient
//! continuation, "switched evolution relaxation"; Kelley & Keyes, SIAM J. Numer. Anal. 35, 1998). At the
//! end it is Newton's method. Equations are solved with incomplete factors: complete ones of 1,000
//! spheres have millions of entries.

use super::newton::{BALANCED, Equations, GOOD, Newton, scaled};
use crate::{
    analysis::Control,
    assembly::Wrench,
    solve::{Blocks, Pattern},
    verdict::Rate,
    yielding::{JointKind, State, System},
};
use nalgebra::Vector6;

/// So many blocks that all touch as spheres do are a heap. Fewer: complete factors are faster.
const HEAP: usize = 200;
/// The first multiple of the diagonal. More: more steps. Less: what slides overshoots.
const FIRST: f64 = 0.1;
/// The least one: motions that meet no resistance. More: fewer digits a step. Less: pivots of rounding.
const LEAST: f64 = 1e-9;
/// The greatest one.
const MOST: f64 = 10.0;
/// Most steps. Those that get there take two or three dozens. More: minutes for nothing.
const STEPS: usize = 60;
/// What a solution of the equations leaves of their right side, far from balance and near it.
const ROUGHLY: f64 = 1e-2;
pub const CLOSELY: f64 = 1e-4;
/// Balance from which on equations are solved closely.
const NEAR: f64 = 1e-4;
/// Most products of a solution: where it takes more, it takes thousands.
const PRODUCTS: usize = 240;

/// Whether a model is a heap.
pub fn is_one(system: &System) -> bool {
    let round = |kind: &JointKind| matches!(kind, JointKind::Grain(_));
    system.free.len() >= HEAP && system.joints.list.iter().all(|j| round(&j.kind))
}

/// The solution to this share of the right side; nothing where incomplete factors do not get there.
pub fn solved(
    pattern: &Pattern,
    lower: &[f64],
    upper: &[f64],
    right: &[f64],
    share: f64,
) -> Option<Vec<f64>> {
    let matrix = Blocks::new(pattern, lower, upper);
    let factors = matrix.incomplete()?;
    let right: Vec<Vector6<f64>> = right.chunks_exact(6).map(Vector6::from_column_slice).collect();
    let x = matrix.solve(&factors, &right, share, PRODUCTS)?;
    Some(x.iter().flat_map(|v| v.iter().copied()).collect())
}

impl Newton<'_> {
    /// Displacements at which the loads are balanced; nothing where they are not after all steps.
    pub(super) fn relax(
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
