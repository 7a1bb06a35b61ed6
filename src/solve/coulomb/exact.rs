//! The state to the last digit: Newton's method on Coulomb's law itself ([`FrictionLimits::Law`]),
//! started where the fixed point on the friction limits ended.
//!
//! The limits of a fixed point are those of the iterate before, off by what the last step changed;
//! near the edge of friction that is as much as the acceleration that decides. Here each limit
//! follows from the normal force of the same rates, and the error falls to rounding in a few steps.
//! The derivative is not symmetric (Alart & Curnier 1991): a step costs several of those with
//! limits held, so this comes last; but where the law was solved once, its solution at the next ε is
//! near, and following it there ([`Exact::on`]) costs milliseconds where the fixed point on 164
//! blocks of a bridge takes tenths of a second.

use super::{drag::Dragged, newton::Solved};
use crate::{
    Lu, Pattern,
    deadline::Deadline,
    program::{
        coulomb::Contacts,
        response::{Answer, FrictionLimits, Response},
    },
};

/// Most steps. Fewer: states of many joints that stick and slip by turns go back to the fixed
/// point. More: time lost where it leads nowhere.
const STEPS: usize = 20;
/// Shares of a step that are looked at, each half of the one before.
const SHARES: usize = 8;
/// The greatest spring that holds a step back where none leads further (Levenberg 1944), as an ε.
const MOST_SPRING: f64 = 1.0;
/// The imbalance aimed at, in the loads that pass the blocks, over ε. Larger: digits of the
/// acceleration. Smaller: rounding keeps from it.
const EXACT: f64 = 1e-6;
/// Rounding of the imbalance for each of the rates, which are large where something moves. Larger:
/// noise in the acceleration. Smaller: motions at small ε, which rounding keeps from the imbalance
/// aimed at, go back to the fixed point.
const ROUNDING: f64 = 1e-14;
/// Where no step leads further, this many times as much is good enough.
const ENOUGH: f64 = 100.0;
/// Most rows. More: factors without symmetry of structures in space take minutes.
const MOST_ROWS: usize = 12_000;

/// The least fall of ε that is tried in one go. Nearer to one: time lost where the state turns back.
/// Farther: states that change at many joints between two ε go back to the fixed point.
const LEAST_FALL: f64 = 0.9;
/// Most pushes on the way to one ε. Fewer: such states go back. More: time lost.
const PUSHES: usize = 40;
/// Most factorisations of all of them. Fewer: states are followed as they come about, which costs more.
/// More: time lost
/// (700 of them, 17 s, on a wall of 1,600 blocks).
const MOST_PUSHED: usize = 100;

/// Coulomb's law for the states of one set of contacts.
pub struct Exact {
    pub(super) response: Response,
    lu: Lu,
    carried: Vec<f64>,
    /// How many matrices it has factored.
    pub factors: usize,
    /// Where the state came to as it came about.
    pub(super) place: Dragged,
}

impl Exact {
    /// `None` where the forces do not follow from the rates, or the factors take too much.
    pub fn new(contacts: &Contacts) -> Option<Self> {
        if contacts.statics.matrix.rows > MOST_ROWS {
            return None;
        }
        let response = Response::new(contacts)?;
        let (starts, rows) = response.pattern();
        let lu = Lu::new(&Pattern { starts: starts.to_vec(), rows: rows.to_vec() })?;
        Some(Self {
            response,
            lu,
            carried: contacts.carried(),
            factors: 0,
            place: Dragged::default(),
        })
    }

    /// The state at ε near `rates`, and the imbalance it leaves, in the loads that pass the blocks;
    /// `None` where it does not get there, or not before `end`.
    pub fn near(
        &mut self,
        contacts: &Contacts,
        epsilon: f64,
        rates: &[f64],
        end: Deadline,
    ) -> Option<(Solved, f64)> {
        let mut q = rates.to_vec();
        let (mut forces, mut imbalance) =
            self.response.forces(contacts, epsilon, FrictionLimits::Law, &q);
        let mut spring = 0.0;
        for _ in 0..STEPS {
            let size = self.size(&imbalance);
            let allowed = allowed(epsilon, &q);
            if size <= allowed {
                return Some((Solved { forces, rates: q }, size));
            }
            if !size.is_finite() || end.is_over() {
                return None;
            }
            let step = self.step(contacts, epsilon + spring, &q, &imbalance)?;
            let better = shortened(&q, &step, size, |next| {
                let seen = self.response.forces(contacts, epsilon, FrictionLimits::Law, next);
                let size = self.size(&seen.1);
                (seen, size)
            });
            match better {
                Some((next, seen, _, is_whole)) => {
                    spring *= if is_whole { 0.01 } else { 10.0 };
                    (q, (forces, imbalance)) = (next, seen);
                }
                None if size <= ENOUGH * allowed => {
                    return Some((Solved { forces, rates: q }, size));
                }
                None if spring < MOST_SPRING => spring = (100.0 * spring).max(epsilon),
                None => return None,
            }
        }
        None
    }

    /// The step of Newton's method that leaves no imbalance, where blocks resist their rates.
    fn step(
        &mut self,
        contacts: &Contacts,
        resists: f64,
        rates: &[f64],
        imbalance: &[f64],
    ) -> Option<Vec<f64>> {
        let Answer { triangles, .. } =
            self.response.answer(contacts, resists, FrictionLimits::Law, rates);
        self.solve(&triangles, imbalance.iter().map(|g| -g).collect())
    }

    /// Solves with a derivative of the imbalance.
    pub(super) fn solve(
        &mut self,
        [lower, upper]: &[Vec<f64>; 2],
        mut sides: Vec<f64>,
    ) -> Option<Vec<f64>> {
        self.factors += 1;
        self.lu.solve(lower, upper, &mut sides).then_some(sides)
    }

    /// The state at a smaller ε than that of the last of `trail` (ε and rates, the last improved),
    /// followed there from it in as many steps as it takes, each started where the two before lead
    /// to: displacements of what rests fall with ε, those of what moves stay. `None` where it does
    /// not get there, or not before `end`.
    pub fn on(
        &mut self,
        contacts: &Contacts,
        trail: &mut [(f64, Vec<f64>)],
        epsilon: f64,
        end: Deadline,
    ) -> Option<(Solved, f64)> {
        let (at, rates) = trail.last_mut()?;
        if let Some((solved, _)) = self.near(contacts, *at, rates, end) {
            *rates = solved.rates;
        }
        let mut trail = trail.to_vec();
        let mut fall = epsilon / trail.last()?.0;
        let before = self.factors;
        for _ in 0..PUSHES {
            if self.factors - before > MOST_PUSHED {
                return None;
            }
            let last = trail.last()?.0;
            let next = if last * fall < epsilon / LEAST_FALL { epsilon } else { last * fall };
            match self.near(contacts, next, &predicted(&trail, next), end) {
                Some(point) if next == epsilon => return Some(point),
                Some((point, _)) => {
                    trail.push((next, point.rates));
                    fall *= fall.sqrt();
                }
                None => fall = fall.sqrt(),
            }
            if fall > LEAST_FALL {
                return None;
            }
        }
        None
    }

    pub(super) fn size(&self, imbalance: &[f64]) -> f64 {
        imbalance.iter().zip(&self.carried).map(|(g, c)| (g / c).powi(2)).sum::<f64>().sqrt()
    }
}

/// The longest of ever shorter steps that lowers the size of the imbalance; with what `look` saw
/// there, that size, and whether it is the whole step.
fn shortened<T>(
    from: &[f64],
    step: &[f64],
    size: f64,
    look: impl Fn(&[f64]) -> (T, f64),
) -> Option<(Vec<f64>, T, f64, bool)> {
    let mut share = 1.0;
    (0..SHARES).find_map(|_| {
        let next: Vec<f64> = from.iter().zip(step).map(|(q, s)| q + share * s).collect();
        let (seen, left) = look(&next);
        let (falls, is_whole) = (left < (1.0 - 0.1 * share) * size, share == 1.0);
        share *= 0.5;
        falls.then_some((next, seen, left, is_whole))
    })
}

/// The imbalance that is none.
pub(super) fn allowed(epsilon: f64, rates: &[f64]) -> f64 {
    EXACT * epsilon + ROUNDING * rates.iter().map(|q| q * q).sum::<f64>().sqrt()
}

/// The rates at ε on the line through the last two, by ε; with one before, that one in proportion.
fn predicted(trail: &[(f64, Vec<f64>)], epsilon: f64) -> Vec<f64> {
    match trail {
        [.., (a, before), (b, last)] => {
            let share = (epsilon - b) / (a - b);
            last.iter().zip(before).map(|(last, before)| last + share * (before - last)).collect()
        }
        [(only, rates)] => rates.iter().map(|q| q * epsilon / only).collect(),
        [] => Vec::new(),
    }
}
