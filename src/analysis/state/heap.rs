//! Heaps of spheres: hundreds of contacts slide at once, and steps that go straight for balance lead to
//! where less is left but nothing balances.
//!
//! They are relaxed instead, as if in something viscous: a multiple of the diagonal on the tangent is
//! one over a step in time, and grows shorter as less is left out of balance (pseudo-transient
//! continuation, "switched evolution relaxation"; Kelley & Keyes, SIAM J. Numer. Anal. 35, 1998). At the
//! end it is Newton's method.
//!
//! Where that does not get there, friction is rounded: what slides resists a little, what sticks gives a
//! little, and no contact does the one and the other by turns. The corner is made sharper by and by, each
//! state guessed from the two before, until Newton's method gets there without it (smoothing, as of
//! complementarity: Chen & Mangasarian, Comput. Optim. Appl. 5, 1996).

use super::{
    equations::{Equations, scaled},
    incomplete::{CLOSELY, completed, solved},
    newton::{BALANCED, GLUE, GOOD, Newton},
};
use crate::Control;
use check::{
    elastic::{ElasticState, law::Friction},
    verdict::Rate,
};
use model::assembly::Wrench;

/// The first multiple of the diagonal. More: more steps. Less: what slides overshoots.
const FIRST: f64 = 0.1;
/// The least one: motions that meet no resistance. More: fewer digits a step. Less: pivots of rounding.
const LEAST: f64 = 1e-9;
/// The greatest one.
const MOST: f64 = 10.0;
/// Most steps. Those that get there take about two dozens. More: minutes for nothing.
const STEPS: usize = 30;
/// What a solution of the equations leaves of their right side, far from balance. More: steps astray.
/// Less: time.
const ROUGHLY: f64 = 1e-2;
/// Balance from which on equations are solved closely.
const NEAR: f64 = 1e-4;
/// Friction is rounded by powers up to the inverse of this. Less: rounding of the powers.
const SOFTEST: f64 = 1e-5;
/// From this one on what is found is tried without rounding.
const SHARP: f64 = 1e-2;
/// What is left of balance with rounded friction, in multiples of one over its power: well below what
/// rounding it changes. More: guesses astray. Less: time.
const ENOUGH: f64 = 5e-3;
/// Most steps of Newton's method from one power to the next, and most halvings of a step.
const TRIES: usize = 10;
const HALVINGS: i32 = 8;
/// A step is taken where what is left falls by this share of it. More: none is taken where short ones
/// lead on.
const LESS: f64 = 1e-3;
/// Powers grow by this much at most from one to the next, and the search is given up where it would take
/// less than that. More at most: guesses astray.
const MOST_FACTOR: f64 = 2.0;
const LEAST_FACTOR: f64 = 1.02;

/// What Newton's method is after.
#[derive(Clone, Copy)]
struct Goal {
    friction: Friction,
    /// What may be left of balance.
    enough: f64,
    /// Most steps.
    most: usize,
}

impl Newton<'_> {
    /// Displacements at which the loads are balanced, from those of `from`: of heaps relaxed, where that
    /// gets there.
    pub fn rest(
        &mut self,
        state: &ElasticState,
        loads: &[Wrench],
        from: &[Rate],
        control: &Control,
    ) -> Option<Vec<Rate>> {
        if self.heap {
            let glued = self.search(state, loads, from.to_vec(), GLUE[0], control);
            let found = glued.and_then(|glued| {
                let relaxed = self.relax(state, loads, glued.clone(), control);
                relaxed.or_else(|| self.sharpen(state, loads, glued, control))
            });
            if found.is_some() {
                return found;
            }
        }
        self.balance(state, loads, from, control)
    }

    /// The same; nothing where they are not balanced after all steps.
    fn relax(
        &mut self,
        state: &ElasticState,
        loads: &[Wrench],
        mut displaced: Vec<Rate>,
        control: &Control,
    ) -> Option<Vec<Rate>> {
        let (mut left, mut size) = self.residual(state, loads, &displaced, 0.0, Friction::Follows);
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
                self.equations(state, &displaced, 0.0, Friction::Follows, &left, shift);
            let share = if size > NEAR { ROUGHLY } else { CLOSELY };
            let pattern = &self.system.pattern;
            let way = solved(pattern, &lower, &upper, &right, share).and_then(|x| scaled(x, &unit));
            let Some(way) = way else {
                shift = MOST.min(10.0 * shift);
                continue;
            };
            let next = self.moved(&displaced, &way, 1.0);
            let (r, new) = self.residual(state, loads, &next, 0.0, Friction::Follows);
            if !new.is_finite() || (size <= GOOD && new >= size) {
                break;
            }
            shift = (shift * new / size).clamp(LEAST, MOST);
            (displaced, left, size) = (next, r, new);
        }
        (size <= GOOD).then_some(displaced)
    }

    /// The same with friction that is rounded less and less.
    fn sharpen(
        &mut self,
        state: &ElasticState,
        loads: &[Wrench],
        mut displaced: Vec<Rate>,
        control: &Control,
    ) -> Option<Vec<Rate>> {
        let (mut soft, mut factor) = (1.0, 2.0_f64);
        let mut reached: Vec<(f64, Vec<Rate>)> = Vec::new();
        while soft > SOFTEST && !control.deadline.is_over() {
            let friction = Friction::Rounded(1.0 / soft);
            let size = |all: &Self, q: &[Rate]| all.residual(state, loads, q, 0.0, friction).1;
            let from = match &reached[..] {
                [.., (x, p), (y, q)] => Some(ahead(p, q, (soft - y) / (y - x))),
                _ => None,
            };
            let from = from.filter(|q| size(self, q) < size(self, &displaced));
            let from = from.unwrap_or_else(|| displaced.clone());
            let most = if reached.is_empty() { STEPS } else { TRIES };
            let goal = Goal { friction, enough: ENOUGH * soft, most };
            let (next, left, steps) = self.approach(state, loads, from, goal, control);
            if left > goal.enough {
                factor = factor.sqrt();
                if reached.is_empty() || factor < LEAST_FACTOR {
                    return None;
                }
                soft = reached.last()?.0 / factor;
                continue;
            }
            displaced.clone_from(&next);
            reached.push((soft, next));
            if soft <= SHARP {
                let goal = Goal { friction: Friction::Follows, enough: BALANCED, most: TRIES };
                let (sharp, left, _) =
                    self.approach(state, loads, displaced.clone(), goal, control);
                if left <= GOOD {
                    return Some(sharp);
                }
            }
            if steps <= 3 {
                factor = (factor * factor).min(MOST_FACTOR);
            }
            soft /= factor;
        }
        None
    }

    /// Newton's method until no more than this is left: where it gets, what is left there, and the steps
    /// it took.
    fn approach(
        &mut self,
        state: &ElasticState,
        loads: &[Wrench],
        mut displaced: Vec<Rate>,
        Goal { friction, enough, most }: Goal,
        control: &Control,
    ) -> (Vec<Rate>, f64, usize) {
        let (mut left, mut size) = self.residual(state, loads, &displaced, 0.0, friction);
        for step in 0..most {
            if size <= enough || control.deadline.is_over() {
                return (displaced, size, step);
            }
            self.steps += 1;
            let equations = self.equations(state, &displaced, 0.0, friction, &left, 0.0);
            let share = if size > NEAR { ROUGHLY } else { CLOSELY };
            let pattern = &self.system.pattern;
            let way = completed(pattern, &mut self.fronts, &equations, share)
                .and_then(|x| scaled(x, &equations.unit));
            let Some(way) = way else { return (displaced, size, step) };
            let found = (0..HALVINGS).find_map(|k| {
                let share = 0.5_f64.powi(k);
                let next = self.moved(&displaced, &way, share);
                let (r, new) = self.residual(state, loads, &next, 0.0, friction);
                (new < (1.0 - LESS * share) * size).then_some((next, r, new))
            });
            let Some(found) = found else { return (displaced, size, step) };
            (displaced, left, size) = found;
        }
        (displaced, size, most)
    }
}

/// On from two displacements, by this multiple of the way from the first to the second.
fn ahead(first: &[Rate], second: &[Rate], share: f64) -> Vec<Rate> {
    let pairs = first.iter().zip(second);
    pairs
        .map(|(a, b)| {
            let mut next = *b;
            next.velocity += (b.velocity - a.velocity) * share;
            next.spin += (b.spin - a.spin) * share;
            next
        })
        .collect()
}
