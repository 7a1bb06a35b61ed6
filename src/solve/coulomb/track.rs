//! The state from afar: solutions of laws with rounded corners ([`FrictionLimits::Rounded`]) are
//! followed to Coulomb's own.
//!
//! *Path.* With corners rounded by `e^s` of the load at each contact, and a drag of `e^5s` on every
//! block, the equations are smooth, and at `s = 0` drag and joints resist alike: Newton's method
//! gets there from rest. As `s` falls the solutions form a curve, which turns back where part of the
//! scene snaps from one way of being held to another; so it is followed by its length, not by `s`
//! (Keller 1977), and where corners are sharp the law itself takes over. Iterations on the friction
//! limits go round in circles there, and descents of the imbalance end in valleys that lead nowhere.
//! That the curve ends at a solution is likely (Chow, Mallet-Paret & Yorke 1978, for equations with
//! one solution at its start), not certain: it may come back, or be too long.

use super::{
    Exact,
    exact::allowed,
    newton::{Solved, dot},
};
use crate::{
    deadline::Deadline,
    program::{coulomb::Contacts, response::FrictionLimits},
};

/// The drag at the start, as an ε, of one try after the other. Less: the curve may come back. More:
/// it is longer.
const DRAGS: [f64; 2] = [1.0, 10.0];
/// How much faster than the rounding the drag falls. Slower: it goes where corners are sharp already,
/// and the curve turns back more often (two to three times the factorisations on a wall of 1,600
/// blocks with 2). Faster: the same number of them.
const FREER: f64 = 5.0;
/// Where the law itself takes over. Sooner: it does not get there from the rounded one. Later:
/// rounding.
const SHARP: f64 = -16.0;
/// A curve that comes back to where corners are this much rounder than at its start is given up.
const BACK: f64 = 2.0;
/// The change of a rate, in displacements of joints under a mean load, that is as long as the same
/// of `s`. More: the curve turns too sharply for its steps. Less: more of them.
const LENGTH: f64 = 30.0;
/// A place is on the curve when so much of the rounding is left as imbalance. More: soft blocks,
/// which little moves far, leave the curve. Less: factorisations for nothing.
const ON: f64 = 1e-4;
/// The same at the start.
const AT_START: f64 = 1e-2;
/// The first step, the longest along `s`, and the least.
const STEPS: [f64; 3] = [0.5, 4.0, 1e-10];
/// Steps after one that took few corrections, that took many, and that failed, over the one before.
const LONGER: f64 = 1.7;
const SHORTER: f64 = 0.7;
const FAILED: f64 = 0.35;
/// Few and many corrections, and the most.
const CORRECTIONS: [usize; 3] = [3, 6, 8];
/// Most factorisations of all tries: so many and one a row (the more joints, the more often a curve
/// turns back), and no more than the second number. Fewer: the Armadillo Vault pushed by a quarter of
/// its weight (560) does not get there, nor do domes of 17 blocks (with 150; to give up costs more
/// time in the next states than to get there). More: minutes where nothing is to be had.
const FACTORS: [usize; 2] = [500, 1000];
/// The most with so many rows, where each takes hundredths of a second; a wall of 1,600 blocks takes
/// 200 to 260 where it gets there. More: load factors of such walls take longer still (15 minutes
/// and more with 1,000), for states that stay open.
const FACTORS_OF_LARGE: (usize, usize) = (4_000, 400);
/// Most steps of Newton's method to the start.
const FIRST: usize = 30;
/// The difference by which the change along `s` is measured.
const DIFFERENCE: f64 = 1e-4;

/// A place on the curve, or a way along it.
#[derive(Clone)]
struct Place {
    rates: Vec<f64>,
    s: f64,
}

impl Place {
    fn dot(&self, other: &Self) -> f64 {
        dot(&self.rates, &other.rates) / (LENGTH * LENGTH) + self.s * other.s
    }

    fn on(&self, way: &Self, by: f64) -> Self {
        Self { rates: along(&self.rates, &way.rates, by), s: self.s + by * way.s }
    }
}

/// A curve as it is followed.
struct Curve<'a> {
    law: &'a mut Exact,
    contacts: &'a Contacts,
    epsilon: f64,
    drag: f64,
    end: Deadline,
    /// The number of factorisations at which it is given up.
    most: usize,
}

impl Exact {
    /// The state at ε from where blocks touch, and the imbalance it leaves, in the loads that pass
    /// the blocks; `None` where the curve does not lead there, or not before `end`.
    pub fn tracked(
        &mut self,
        contacts: &Contacts,
        epsilon: f64,
        end: Deadline,
    ) -> Option<(Solved, f64)> {
        let rows = contacts.statics.matrix.rows;
        let (large, of_large) = FACTORS_OF_LARGE;
        let most = (FACTORS[0] + rows).min(if rows > large { of_large } else { FACTORS[1] });
        let most = self.factors + most;
        DRAGS.iter().find_map(|&drag| {
            let law = &mut *self;
            let sharp = Curve { law, contacts, epsilon, drag, end, most }.followed()?;
            self.near(contacts, epsilon, &sharp, end)
        })
    }
}

impl Curve<'_> {
    /// The rates where corners are sharp.
    fn followed(&mut self) -> Option<Vec<f64>> {
        let (mut place, along_s) = self.start()?;
        let mut way = unit(along_s, None);
        let mut step = STEPS[0];
        while self.law.factors < self.most && place.s < BACK {
            let before = self.law.factors;
            match self.corrected(place.on(&way, step), &way) {
                Some((next, along_s)) => {
                    way = unit(along_s, Some(&way));
                    place = next;
                    if place.s < SHARP {
                        return Some(place.rates);
                    }
                    match self.law.factors - before {
                        few if few <= CORRECTIONS[0] => step *= LONGER,
                        many if many >= CORRECTIONS[1] => step *= SHORTER,
                        _ => {}
                    }
                    step = step.min(STEPS[1] / way.s.abs());
                }
                None if self.end.is_over() || step < STEPS[2] => return None,
                None => step *= FAILED,
            }
        }
        None
    }

    /// The start of the curve, from rest, and how rates change with `s` there.
    fn start(&mut self) -> Option<(Place, Vec<f64>)> {
        let mut at = Place { rates: vec![0.0; self.contacts.statics.matrix.rows], s: 0.0 };
        for _ in 0..FIRST {
            let imbalance = self.imbalance(&at);
            let size = self.law.size(&imbalance);
            let (step, along_s) = self.step(&at, &imbalance)?;
            if size <= AT_START {
                return Some((at, along_s));
            }
            let shares = (0..CORRECTIONS[2] as i32).map(|k| 0.5_f64.powi(k));
            at.rates = shares
                .map(|share| (share, along(&at.rates, &step, share)))
                .find(|(share, rates)| {
                    let next = Place { rates: rates.clone(), s: at.s };
                    self.law.size(&self.imbalance(&next)) < (1.0 - 0.1 * share) * size
                })?
                .1;
        }
        None
    }

    /// The place on the curve straight across `way` from `at`, and how rates change with `s` there.
    fn corrected(&mut self, mut at: Place, way: &Place) -> Option<(Place, Vec<f64>)> {
        let predicted = at.s;
        let mut last = None;
        let mut first = f64::INFINITY;
        for k in 0..=CORRECTIONS[2] {
            let imbalance = self.imbalance(&at);
            let size = self.law.size(&imbalance);
            let enough = (ON * at.s.exp()).max(allowed(self.epsilon, &at.rates));
            // What is allowed of huge rates, far off, is no place on the curve.
            let strays = (at.s - predicted).abs() > STEPS[1];
            if let Some(along_s) = last.take_if(|_| size <= enough && !strays) {
                return Some((at, along_s));
            }
            if k == 0 {
                first = size;
            }
            let leads_away = strays || (k > CORRECTIONS[0] && size > first);
            if !size.is_finite() || leads_away || k == CORRECTIONS[2] || self.end.is_over() {
                return None;
            }
            let (step, along_s) = self.step(&at, &imbalance)?;
            let across = |rates: &[f64]| dot(&way.rates, rates) / (LENGTH * LENGTH);
            let by = -across(&step) / (way.s + across(&along_s));
            at.rates = along(&along(&at.rates, &step, 1.0), &along_s, by);
            at.s += by;
            last = Some(along_s);
        }
        None
    }

    fn law(&self, s: f64) -> (f64, FrictionLimits<'static>) {
        (self.epsilon + self.drag * (FREER * s).exp(), FrictionLimits::Rounded(s.exp()))
    }

    fn imbalance(&self, at: &Place) -> Vec<f64> {
        let (resists, law) = self.law(at.s);
        self.law.response.forces(self.contacts, resists, law, &at.rates).1
    }

    /// The step of Newton's method at the same `s`, and how the rates change with `s`.
    fn step(&mut self, at: &Place, imbalance: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let further = self.imbalance(&Place { rates: at.rates.clone(), s: at.s + DIFFERENCE });
        let mut both: Vec<f64> = imbalance.iter().map(|g| -g).collect();
        both.extend(imbalance.iter().zip(&further).map(|(g, next)| (g - next) / DIFFERENCE));
        let mut both = self.law.solve(self.contacts, self.law(at.s), &at.rates, both)?;
        let along_s = both.split_off(imbalance.len());
        Some((both, along_s))
    }
}

/// The way on of length one, towards sharper corners at the start.
fn unit(along_s: Vec<f64>, before: Option<&Place>) -> Place {
    let way = Place { rates: along_s, s: 1.0 };
    let onwards = before.map_or(-1.0, |before| way.dot(before));
    let by = way.dot(&way).sqrt().recip().copysign(onwards);
    Place { rates: way.rates.iter().map(|r| by * r).collect(), s: by }
}

fn along(from: &[f64], way: &[f64], by: f64) -> Vec<f64> {
    from.iter().zip(way).map(|(from, way)| from + by * way).collect()
}
