//! Newton's method on Coulomb's law itself, for the load factor: no friction limit is held, each
//! follows from the normal force of the same rates.
//!
//! *Law.* With the displacements `z = y / δ` of the blocks on compliant joints, forces follow from
//! them ([`Response`], [`FrictionLimits::Law`]), and program D at its fixed point is `g(z, λ) = −(A
//! f(z) + w + λ ℓ) = 0` with `ℓ·z = 1 / δ`, the way of the live load. A smaller δ is a longer way:
//! what the blocks then move by is the mechanism. The derivative is not symmetric (Alart & Curnier
//! 1991), and the law need not be the gradient of anything: steps count by the imbalance they
//! leave, and where one leaves more, a spring on each block holds the next one back (Levenberg
//! 1944). It settles where the iteration on the limits goes round in circles, and gains all digits
//! at once; from afar it does not get there, and is tried only beside that iteration.

use super::{newton::dot, point::FixedPoint};
use crate::{
    Lu, Pattern,
    deadline::Deadline,
    program::{
        coulomb::Contacts,
        response::{Answer, FrictionLimits, Response},
    },
};

/// Most steps to one way. Fewer: walls go back to the limits. More: time lost from afar.
const STEPS: usize = 12;
/// Shares of a step that are looked at, each half of the one before. Fewer: too much spring. More:
/// steps that hardly move.
const SHARES: usize = 6;
/// Springs held against: least, first after a step that leads nowhere, and greatest, in mean block
/// loads per displacement. A larger least: it resists the mechanism itself on long ways. Smaller:
/// rounding. A larger greatest: steps that hardly move.
const SPRINGS: [f64; 3] = [1e-12, 1e-5, 1.0];
/// The imbalance aimed at, in block loads, and that of rounding, for each displacement. Larger:
/// digits of the load factor. Smaller: rounding keeps from it.
const EXACT: f64 = 1e-8;
const ROUNDING: f64 = 1e-14;
/// The least growth of a way that is tried in one go. Larger: walls go back to the limits. Smaller:
/// time lost where the way turns back.
const LEAST_GROWTH: f64 = 1.01;
/// Most pushes on the way to one δ. Fewer: walls go back to the limits. More: time lost.
const PUSHES: usize = 200;

/// Coulomb's law for one set of contacts, and where it was last obeyed.
pub struct CoulombLaw {
    response: Response,
    lu: Lu,
    /// The live load as program D has it.
    live: Vec<f64>,
    last: Option<PathPoint>,
}

/// Displacements, load factor (over the scale) and way.
#[derive(Clone)]
struct PathPoint {
    z: Vec<f64>,
    lambda: f64,
    way: f64,
}

impl CoulombLaw {
    /// `None` where the forces do not follow from the rates, or the factors do not fit into memory;
    /// `scale` multiplies the live load.
    pub fn new(contacts: &Contacts, scale: f64) -> Option<Self> {
        let response = Response::new(contacts)?;
        let (starts, rows) = response.pattern();
        let lu = Lu::new(&Pattern { starts: starts.to_vec(), rows: rows.to_vec() })?;
        let live = contacts.statics.live.iter().map(|l| scale * l).collect();
        Some(Self { response, lu, live, last: None })
    }

    /// The fixed point at δ near rates and load factor (over the scale) of one of its programs.
    pub fn near(
        &mut self,
        contacts: &Contacts,
        delta: f64,
        rates: &[f64],
        lambda: f64,
        end: Deadline,
    ) -> Option<FixedPoint> {
        let start =
            PathPoint { z: rates.iter().map(|y| y / delta).collect(), lambda, way: 1.0 / delta };
        let way = start.way;
        self.to(contacts, start, way, end)
    }

    /// The fixed point at a smaller δ than the last, pushed there from it.
    pub fn on(&mut self, contacts: &Contacts, delta: f64, end: Deadline) -> Option<FixedPoint> {
        let goal = 1.0 / delta;
        let mut growth = goal / self.last.as_ref()?.way;
        if growth <= 1.0 {
            return None;
        }
        for _ in 0..PUSHES {
            let last = self.last.clone()?;
            let way = if last.way * growth > 0.99 * goal { goal } else { last.way * growth };
            match self.to(contacts, last, way, end) {
                Some(point) if way == goal => return Some(point),
                Some(_) => growth *= growth.sqrt(),
                None => growth = growth.sqrt(),
            }
            if growth < LEAST_GROWTH {
                return None;
            }
        }
        None
    }

    /// Newton's method from a place to a way.
    fn to(
        &mut self,
        contacts: &Contacts,
        start: PathPoint,
        way: f64,
        end: Deadline,
    ) -> Option<FixedPoint> {
        let PathPoint { mut z, mut lambda, .. } = start;
        let (mut forces, mut imbalance) = self.look(contacts, &z, lambda);
        // The first step goes all the way, whatever it leaves.
        let mut size = f64::INFINITY;
        let mut spring = SPRINGS[0];
        for _ in 0..STEPS {
            if end.is_over() {
                return None;
            }
            let step = self.step(contacts, &z, &imbalance, way, spring);
            let mut best = None;
            let mut share = 1.0;
            if let Some((dz, dl)) = &step {
                for _ in 0..if size.is_finite() { SHARES } else { 1 } {
                    let q: Vec<f64> = z.iter().zip(dz).map(|(z, d)| z + share * d).collect();
                    let l = lambda + share * dl;
                    let (f, g) = self.look(contacts, &q, l);
                    let left = norm(&g);
                    if left < (1.0 - 0.1 * share) * size {
                        best = Some((q, l, f, g, left));
                        break;
                    }
                    share *= 0.5;
                }
            }
            match best {
                Some((q, l, f, g, left)) => {
                    (z, lambda, forces, imbalance, size) = (q, l, f, g, left);
                    spring =
                        if share == 1.0 { (0.01 * spring).max(SPRINGS[0]) } else { 10.0 * spring };
                }
                None if spring < SPRINGS[2] => spring = (100.0 * spring).max(SPRINGS[1]),
                None => return None,
            }
            if size <= EXACT + ROUNDING * norm(&z) {
                let rates = z.iter().map(|z| z / way).collect();
                self.last = Some(PathPoint { z, lambda, way });
                return Some(FixedPoint {
                    forces,
                    rates,
                    lambda,
                    change: 0.0,
                    noise: 0.0,
                    solves: 0,
                });
            }
        }
        None
    }

    /// Forces, and the imbalance of the blocks.
    fn look(&self, contacts: &Contacts, z: &[f64], lambda: f64) -> (Vec<f64>, Vec<f64>) {
        let (forces, mut imbalance) = self.response.forces(contacts, 0.0, FrictionLimits::Law, z);
        imbalance.iter_mut().zip(&self.live).for_each(|(g, l)| *g -= lambda * l);
        (forces, imbalance)
    }

    /// Newton's step in the displacements and the load factor: what balances, and what the live
    /// load adds, one factorisation for both.
    fn step(
        &mut self,
        contacts: &Contacts,
        z: &[f64],
        imbalance: &[f64],
        way: f64,
        spring: f64,
    ) -> Option<(Vec<f64>, f64)> {
        let Answer { triangles: [lower, upper], .. } =
            self.response.answer(contacts, spring, FrictionLimits::Law, z);
        let mut both: Vec<f64> =
            imbalance.iter().map(|g| -g).chain(self.live.iter().copied()).collect();
        if !self.lu.solve(&lower, &upper, &mut both) {
            return None;
        }
        let (own, by_load) = both.split_at(z.len());
        let more = (way - dot(&self.live, z) - dot(&self.live, own)) / dot(&self.live, by_load);
        let step: Vec<f64> = own.iter().zip(by_load).map(|(a, b)| a + more * b).collect();
        (more.is_finite() && step.iter().all(|v| v.is_finite())).then_some((step, more))
    }
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
