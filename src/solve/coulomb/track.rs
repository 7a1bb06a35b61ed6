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
    place::{LENGTH, Passed, Place, Trunk, along, unit},
};
use crate::{
    deadline::Deadline,
    program::{
        coulomb::Contacts,
        response::{Answer, FrictionLimits},
    },
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
/// Places are remembered as `s` falls by this. Less: memory. More: more of the curve is followed
/// again.
const REMEMBERED: f64 = 0.25;
/// The curve of a smaller ε branches off where the drag is this × the larger one, for up to there the
/// two are nearly the same. Less: it does not get from one to the other. More: more is followed twice.
const BRANCH: f64 = 3.0;

/// With more rows than this a curve that was too long to one ε is not begun again to another. More:
/// half a minute longer for states that stay open (Armadillo Vault). Fewer: small domes that move are
/// not told, and cost little.
const AGAIN: usize = 1_000;

/// The drag that falls from this one at the start, where corners are rounded by `e^s`.
fn drag_at(start: f64, s: f64) -> f64 {
    start * (FREER * s).exp()
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
    /// The sharpest corners it came to, as `s`.
    least: f64,
    /// What is remembered of it.
    places: Vec<Passed>,
}

impl Exact {
    /// The state at the first of these ε (ascending) to which a curve leads from where blocks touch,
    /// with that ε, and the imbalance it leaves, in the loads that pass the blocks; `None` where none
    /// leads to any of them, or not before `end`. A curve that was lost on the way that all ε have in
    /// common is not begun again. No more than `most` matrices are factored in all.
    pub fn tracked(
        &mut self,
        contacts: &Contacts,
        epsilons: &[f64],
        most: usize,
        end: Deadline,
    ) -> Option<(f64, (Solved, f64))> {
        let rows = contacts.statics.matrix.rows;
        let (large, of_large) = FACTORS_OF_LARGE;
        let budget = (FACTORS[0] + rows).min(if rows > large { of_large } else { FACTORS[1] });
        let all = self.factors.saturating_add(most);
        let trunk = std::mem::take(&mut self.trunk);
        let branch = (!trunk.places.is_empty()).then_some(trunk);
        let starts = || DRAGS.map(|drag| Trunk { drag, places: Vec::new() });
        let mut tries: Vec<Trunk> = branch.into_iter().chain(starts()).collect();
        for &epsilon in epsilons {
            let most = all.min(self.factors + budget);
            let mut again = Vec::new();
            for Trunk { drag, places } in tries {
                let law = &mut *self;
                let least = f64::INFINITY;
                let mut curve = Curve { law, contacts, epsilon, drag, end, most, least, places };
                let sharp = curve.followed();
                let (least, places) = (curve.least, curve.places);
                let reached = sharp.and_then(|sharp| self.near(contacts, epsilon, &sharp, end));
                if let Some(reached) = reached {
                    self.trunk = Trunk { drag, places };
                    return Some((epsilon, reached));
                }
                let is_apart = drag_at(drag, least) < BRANCH * epsilons[epsilons.len() - 1];
                let is_long = self.factors >= most && rows > AGAIN;
                if is_apart && !is_long {
                    again.push(Trunk { drag, places: Vec::new() });
                }
            }
            tries = again;
        }
        None
    }
}

impl Curve<'_> {
    /// The rates where corners are sharp.
    fn followed(&mut self) -> Option<Vec<f64>> {
        let from = if self.places.is_empty() { self.start() } else { self.branch() };
        let (mut place, mut way, mut step) = from?;
        while self.law.factors < self.most && place.s < BACK {
            let before = self.law.factors;
            match self.corrected(place.on(&way, step), &way) {
                Some((next, along_s)) => {
                    way = unit(along_s, Some(&way));
                    place = next;
                    self.least = self.least.min(place.s);
                    if place.s < SHARP {
                        return Some(place.rates);
                    }
                    self.remember(&place, &way, step);
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

    /// Keeps a place that the curve of a smaller ε has nearly in common with this one.
    fn remember(&mut self, place: &Place, way: &Place, step: f64) {
        let is_further = self.places.last().is_none_or(|last| place.s <= last.place.s - REMEMBERED);
        if is_further && drag_at(self.drag, place.s) >= BRANCH * self.epsilon {
            self.places.push(Passed { place: place.clone(), way: way.clone(), step });
        }
    }

    /// The last place that is remembered, moved over to this curve.
    fn branch(&mut self) -> Option<(Place, Place, f64)> {
        let Passed { place, way, step } = self.places.last().cloned()?;
        let (place, along_s) = self.corrected(place, &way)?;
        Some((place, unit(along_s, Some(&way)), step))
    }

    /// The start of the curve, from rest, with the way on and the first step.
    fn start(&mut self) -> Option<(Place, Place, f64)> {
        let mut at = Place { rates: vec![0.0; self.contacts.statics.matrix.rows], s: 0.0 };
        for _ in 0..FIRST {
            let slopes = self.slopes(&at);
            let size = self.law.size(&slopes.imbalance);
            let (step, along_s) = self.step(&at, &slopes)?;
            if size <= AT_START {
                return Some((at, unit(along_s, None), STEPS[0]));
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
            // The first place is never near enough: it needs its slopes.
            let slopes = (k == 0).then(|| self.slopes(&at));
            let size = match &slopes {
                Some(slopes) => self.law.size(&slopes.imbalance),
                None => self.law.size(&self.imbalance(&at)),
            };
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
            let slopes = slopes.unwrap_or_else(|| self.slopes(&at));
            let (step, along_s) = self.step(&at, &slopes)?;
            let across = |rates: &[f64]| dot(&way.rates, rates) / (LENGTH * LENGTH);
            let by = -across(&step) / (way.s + across(&along_s));
            at.rates = along(&along(&at.rates, &step, 1.0), &along_s, by);
            at.s += by;
            last = Some(along_s);
        }
        None
    }

    fn law(&self, s: f64) -> (f64, FrictionLimits<'static>) {
        (self.epsilon + drag_at(self.drag, s), FrictionLimits::Rounded(s.exp()))
    }

    fn imbalance(&self, at: &Place) -> Vec<f64> {
        let (resists, law) = self.law(at.s);
        self.law.response.forces(self.contacts, resists, law, &at.rates).1
    }

    fn slopes(&self, at: &Place) -> Answer<2> {
        let (resists, law) = self.law(at.s);
        self.law.response.answer(self.contacts, resists, law, &at.rates)
    }

    /// The step of Newton's method at the same `s`, and how the rates change with `s`.
    fn step(&mut self, at: &Place, slopes: &Answer<2>) -> Option<(Vec<f64>, Vec<f64>)> {
        let mut both: Vec<f64> = slopes.imbalance.iter().map(|g| -g).collect();
        let drag = FREER * drag_at(self.drag, at.s);
        let by_drag = at.rates.iter().zip(&self.contacts.row_images).map(|(q, n)| drag * q / n);
        both.extend(slopes.by_rounding.iter().zip(by_drag).map(|(g, d)| -g - d));
        let mut both = self.law.solve(&slopes.triangles, both)?;
        let along_s = both.split_off(slopes.imbalance.len());
        Some((both, along_s))
    }
}
