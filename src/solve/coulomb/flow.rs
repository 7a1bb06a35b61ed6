//! The state as it comes about: blocks yield to their equilibrium error against a drag, from where they touch
//! without any load, and friction holds on wherever they have slid to.
//!
//! *Law.* With a drag as each block's mass, `M q̇ = A f + w`; forces press by how far the blocks have
//! come, and friction opposes what slides now, not how far it has slid in all: each step of time
//! begins from the forces of the one before ([`FrictionLimits::Since`]; the return mapping of
//! plasticity, Simo & Hughes 1998). The end of a step of length Δt solves `q / Δt − A f − w = 0`, the
//! equation of the state at ε = 1 / Δt ([`Exact`]), so that after the time `1 / ε` stands what the
//! state at ε asks for, reached in many small steps instead of one. Blocks that balance come to rest;
//! what moves goes on at the rates of a motion that obeys Coulomb's law, for drag and mass are alike.
//!
//! One step alone takes friction to oppose how far blocks have slid in all. That law gives energy
//! away: blocks slide out under little pressure, and are pulled back under much, for ever (some voussoirs
//! of the Armadillo Vault pushed by a quarter of its weight), and its solutions are hard to
//! find where there are any. Here nothing is given away, and steps lead on.

use super::{Exact, Solved, drag::Dragged, exact::allowed};
use crate::{
    deadline::Deadline,
    program::{
        coulomb::Contacts,
        response::{Answer, FrictionLimits},
    },
};

/// The first step of time. Longer: Newton's method does not get to its end. Shorter: more steps.
const FIRST: f64 = 1e-2;
/// Steps are given up below this. Longer: where much happens at once there is no way on. Shorter: time
/// lost where there is none.
const LEAST: f64 = 1e-7;
/// Steps of Newton's method: few, many, and the most; where it gets near the end, some more to the last
/// digit. Fewer: shorter steps of time. More: time lost where it does not get there.
const CORRECTIONS: [usize; 3] = [1, 3, 5];
const TO_THE_LAST_DIGIT: usize = 3;
/// Steps of time after few and after many of them, and where it did not get there, over the last one.
/// Longer or shorter: a tenth more factorisations, either way.
const LONGER: [f64; 2] = [2.5, 1.4];
const FAILED: f64 = 0.25;
/// A step is good enough when so much of the drag is left as imbalance, and no more than the second
/// number, in the loads that pass the blocks. More: blocks that are not where drag takes them. Less:
/// digits on the way, which no one asks for.
const ON_THE_WAY: [f64; 2] = [0.1, 1e-3];
/// Between two looks time grows by this. More: motions are told later. Less: time lost.
const LOOK: f64 = 1.1;

impl Exact {
    /// The state at ε: where blocks come to in the time `1 / ε`, with the imbalance that is left beside
    /// the drag, in the loads that pass the blocks. It goes on from the last one that was asked. From
    /// the time `1 / looked` on, whatever is there is shown to `is_seen`, which may end it; with the ε of
    /// its end. `None` where it does not get there with `most` factorisations, or not before `end`.
    pub fn flowed(
        &mut self,
        contacts: &Contacts,
        (epsilon, looked): (f64, f64),
        mut is_seen: impl FnMut(f64, &(Solved, f64)) -> bool,
        most: usize,
        end: Deadline,
    ) -> Option<(f64, (Solved, f64))> {
        let mut at = std::mem::take(&mut self.place);
        if at.time == 0.0 {
            let still = vec![0.0; contacts.statics.matrix.rows];
            let memory = vec![0.0; contacts.compliance.len()];
            at = Dragged { rates: still.clone(), speeds: still, memory, step: FIRST, ..at };
        }
        let goal = 1.0 / epsilon;
        let mut look = 1.0 / looked;
        let all = self.factors.saturating_add(most);
        while self.factors < all && at.step > LEAST && !end.is_over() {
            let step = at.step.min(goal - at.time);
            let is_last = step >= goal - at.time;
            let is_looked_at = is_last || at.time + step >= look;
            let Some((passed, left, corrections)) = self.pass(contacts, &at, step, is_looked_at)
            else {
                at.step = FAILED * step;
                continue;
            };
            at.time += step;
            at.memory = self.response.memory(contacts, &at.memory, &passed.rates, &passed.forces);
            at.rates.iter_mut().zip(&passed.rates).for_each(|(q, by)| *q += by);
            at.speeds = passed.rates.iter().map(|by| by / step).collect();
            at.step = match corrections {
                few if few <= CORRECTIONS[0] => at.step.max(LONGER[0] * step),
                some if some <= CORRECTIONS[1] => at.step.max(LONGER[1] * step),
                _ => step,
            };
            if is_looked_at {
                look = look.max(LOOK * at.time);
                let reached = if is_last { epsilon } else { 1.0 / at.time };
                let state = (Solved { rates: at.rates.clone(), ..passed }, left);
                if is_seen(reached, &state) || is_last {
                    self.place = at;
                    return Some((reached, state));
                }
            }
        }
        None
    }

    /// What a step of time leads to: the rates are those of the step alone, with the imbalance that is
    /// left and how many corrections it took; to the last digit where that is asked.
    fn pass(
        &mut self,
        contacts: &Contacts,
        at: &Dragged,
        time: f64,
        exactly: bool,
    ) -> Option<(Solved, f64, usize)> {
        let drag = 1.0 / time;
        let law = FrictionLimits::Since(&at.memory);
        let look = |exact: &Self, q: &[f64]| {
            let seen = exact.response.forces(contacts, drag, law, q);
            let size = exact.size(&seen.1);
            (seen, size)
        };
        let mut q = vec![0.0; at.rates.len()];
        let (mut seen, equilibrium_error) = look(self, &q);
        let mut size = equilibrium_error;
        let goes_on: Vec<f64> = at.speeds.iter().map(|v| time * v).collect();
        let (seen_on, size_on) = look(self, &goes_on);
        if size_on <= size {
            (q, seen, size) = (goes_on, seen_on, size_on);
        }
        let rounding = allowed(drag, &at.rates);
        for corrections in 0.. {
            let dragged: Vec<f64> =
                q.iter().zip(&contacts.row_images).map(|(q, n)| drag * q / n).collect();
            let last_digit = rounding.max(allowed(drag, &q));
            let near = last_digit.max(ON_THE_WAY[1].min(ON_THE_WAY[0] * self.size(&dragged)));
            if size <= if exactly { last_digit } else { near } {
                return Some((Solved { forces: seen.0, rates: q }, size, corrections));
            }
            let more = if exactly && size <= near { TO_THE_LAST_DIGIT } else { 0 };
            let leads_away = corrections > CORRECTIONS[1] && size > equilibrium_error;
            if !size.is_finite() || leads_away || corrections >= CORRECTIONS[2] + more {
                break;
            }
            let Answer { triangles, .. } = self.response.answer(contacts, drag, law, &q);
            let step = self.solve(&triangles, seen.1.iter().map(|g| -g).collect())?;
            q.iter_mut().zip(&step).for_each(|(q, step)| *q += step);
            (seen, size) = look(self, &q);
        }
        None
    }
}
