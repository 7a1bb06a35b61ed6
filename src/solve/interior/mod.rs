//! An interior-point method for programs of contacts.
//!
//! `min ½ xᵀ P x + cᵀ x` subject to `E x = b`, `G x + s = h`, `s` in rays and second-order cones: primal–dual path following with
//! Nesterov–Todd scaling and Mehrotra's predictor and corrector (Mehrotra 1992, Vandenberghe 2010), from an infeasible start. It is
//! written for one reason: in these programs the cones are eliminated contact by contact, and what is left ([`reduced`]) is the
//! stiffness matrix of the blocks.
//!
//! Like every engine it is believed in nothing: forces and rates are recomputed from the scene.

mod cones;
mod newton;
mod reduced;
mod structure;

use self::{
    cones::Cones,
    newton::{EXACT, Newton, Point, ROUGH},
    reduced::Reduced,
    structure::Structure,
};
use super::{Iteration, Settings, Solution, Status};
use crate::program::ConicProgram;
use std::time::Instant;

/// How far a step goes towards the boundary. Nearer: the next steps are short. Farther: more steps.
const TO_THE_BOUNDARY: f64 = 0.995;

/// Further correctors towards products of one size (Gondzio 1996). Fewer: more factorisations. More: time for little.
const MOST_CORRECTORS: usize = 2;

/// They aim this much farther than the step that is possible, and are kept when both steps multiplied grow by this share.
const REACH: f64 = 0.3;
const WORTH: f64 = 0.05;

/// Products between these × the target are left as they are.
const LOW: f64 = 0.1;
const HIGH: f64 = 10.0;

/// Steps this long need no further corrector.
const FAR_ENOUGH: f64 = 0.9;

/// Equilibrium is solved to this × the tolerance. Larger: the residual stays above the tolerance while the gap is closed.
/// Smaller: corrections at the level of rounding.
const BELOW: f64 = 0.05;

/// Where the next solve of a session begins: at the first point of the last one with no more than this of its error left. Larger: nearly
/// from the start. Smaller: so near the boundary that changed limits leave no room.
const WARM: f64 = 1e-5;

/// The gap counts relative to the objective, or to this where that is smaller: an unbalance may be zero. Larger: load factors far below
/// the natural one lose digits. Smaller: iterations at an objective of zero.
const LEAST_OBJECTIVE: f64 = 1e-2;

/// A step shorter than this leads nowhere.
const LEAST_STEP: f64 = 1e-6;

/// Iterations without a better point after which the method stops. Fewer: slow starts are given up. More: time at the noise level.
const PATIENCE: usize = 8;

/// A program that is solved several times with changed right-hand sides and objectives: pattern and ordering are kept.
pub struct Session {
    structure: Structure,
    reduced: Reduced,
    rhs: Vec<f64>,
    objective: Vec<f64>,
    settings: Settings,
    start: Instant,
    /// The clock of all solves together.
    begin: Instant,
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
        Some(Self { structure, reduced, rhs: program.rhs.clone(), objective: program.objective.clone(), settings: *settings, start, begin: start, warm: None })
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
        let (mut trace, s) = (Vec::new(), &self.structure);
        let pick = |from: &[f64], at: &[usize]| at.iter().map(|&k| from[k]).collect::<Vec<f64>>();
        let data = Data {
            c: pick(&self.objective, &s.variables),
            c_border: pick(&self.objective, &s.border),
            b: pick(&self.rhs, &s.equalities),
            h: pick(&self.rhs, &s.cone_rows),
        };
        let clock = (self.start, self.begin);
        let (found, status) = iterate(s, &mut self.reduced, &data, &self.settings, clock, &mut self.warm, &mut trace);
        let (mut x, mut z) = (Vec::new(), Vec::new());
        if let Some(p) = found {
            (x, z) = (vec![0.0; self.objective.len()], vec![0.0; self.rhs.len()]);
            let put = |to: &mut [f64], at: &[usize], from: &[f64]| at.iter().zip(from).for_each(|(&k, v)| to[k] = *v);
            put(&mut x, &s.variables, &p.x);
            put(&mut x, &s.border, &p.t);
            put(&mut z, &s.equalities, &p.y);
            put(&mut z, &s.cone_rows, &p.z);
        }
        let seconds = std::mem::replace(&mut self.start, Instant::now()).elapsed().as_secs_f64();
        Solution { x, z, status, trace, seconds }
    }
}

/// Objective and right-hand sides.
struct Data {
    c: Vec<f64>,
    c_border: Vec<f64>,
    b: Vec<f64>,
    h: Vec<f64>,
}

fn greatest(v: &[f64]) -> f64 {
    // A NaN is as great as can be.
    v.iter().fold(0.0, |m, v| if v.is_nan() { f64::INFINITY } else { f64::max(m, v.abs()) })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `P x + c + Eᵀ y + Gᵀ z`, `E x − b`, `G x + s − h`.
fn residual(st: &Structure, data: &Data, p: &Point, s: &[f64]) -> Point {
    let mut r = Point { x: data.c.clone(), t: data.c_border.clone(), y: data.b.iter().map(|v| -v).collect(), z: s.iter().zip(&data.h).map(|(s, h)| s - h).collect() };
    for ((r, x), q) in r.x.iter_mut().zip(&p.x).zip(&st.quadratic) {
        *r += q * x;
    }
    st.e.add_transposed(&p.y, &mut r.x);
    st.g.add_transposed(&p.z, &mut r.x);
    st.e_border.add_transposed(&p.y, &mut r.t);
    st.g_border.add_transposed(&p.z, &mut r.t);
    st.e.add(&p.x, &mut r.y);
    st.e_border.add(&p.t, &mut r.y);
    st.g.add(&p.x, &mut r.z);
    st.g_border.add(&p.t, &mut r.z);
    r
}

fn minus(p: &Point) -> Point {
    let minus = |v: &[f64]| v.iter().map(|v| -v).collect();
    Point { x: minus(&p.x), t: minus(&p.t), y: minus(&p.y), z: minus(&p.z) }
}

fn add(to: &mut [f64], by: f64, d: &[f64]) {
    to.iter_mut().zip(d).for_each(|(t, d)| *t += by * d);
}

/// The point that balances at least cost and the one that is admissible at least cost, brought inside their cones.
fn begin(st: &Structure, reduced: &mut Reduced, cones: &mut Cones, data: &Data) -> Option<(Point, Vec<f64>)> {
    cones.reset();
    let zero = Point::zero(st);
    let mut newton = Newton::new(st, reduced, cones)?;
    let primal = newton.solve(&Point { y: data.b.clone(), z: data.h.clone(), ..zero.clone() }, EXACT, 0.0);
    let cost = Point { x: data.c.iter().map(|v| -v).collect(), t: data.c_border.iter().map(|v| -v).collect(), ..zero };
    let dual = newton.solve(&cost, EXACT, 0.0);
    let inside = |mut v: Vec<f64>| {
        let t = cones.outside(&v);
        // A little inside already is not inside enough.
        let size = greatest(&v).max(f64::MIN_POSITIVE);
        if t > -1e-3 * size {
            cones.add_unit(&mut v, t + if size > f64::MIN_POSITIVE { size } else { 1.0 });
        }
        v
    };
    let s = inside(primal.z.iter().map(|v| -v).collect());
    Some((Point { x: primal.x, t: primal.t, y: dual.y, z: inside(dual.z) }, s))
}

fn iterate(
    st: &Structure,
    reduced: &mut Reduced,
    data: &Data,
    settings: &Settings,
    (start, clock): (Instant, Instant),
    warm: &mut Option<(Point, Vec<f64>)>,
    trace: &mut Vec<Iteration>,
) -> (Option<Point>, Status) {
    let mut cones = Cones::new(st.cones.clone());
    let degree = cones.degree() as f64;
    let Some((mut p, mut s)) = warm.take().or_else(|| begin(st, reduced, &mut cones, data)) else { return (None, Status::Stalled) };
    let mut best: Option<(f64, Point)> = None;
    let mut since = 0;
    let give = |best: Option<(f64, Point)>, status| (best.map(|b| b.1), status);
    for _ in 0..=settings.iterations {
        let r = residual(st, data, &p, &s);
        let quadratic: f64 = p.x.iter().zip(&st.quadratic).map(|(x, q)| q * x * x).sum();
        let linear = dot(&data.c, &p.x) + dot(&data.c_border, &p.t);
        let primal = 0.5 * quadratic + linear;
        let dual = -0.5 * quadratic - dot(&data.b, &p.y) - dot(&data.h, &p.z);
        let gap = dot(&s, &p.z);
        let primal_residual = greatest(&r.y).max(greatest(&r.z)) / 1f64.max(greatest(&data.b)).max(greatest(&data.h));
        let dual_residual = greatest(&r.x).max(greatest(&r.t)) / 1f64.max(greatest(&data.c)).max(greatest(&data.c_border));
        trace.push(Iteration { seconds: start.elapsed().as_secs_f64(), primal, dual, primal_residual, dual_residual });
        let merit = (gap / LEAST_OBJECTIVE.max(primal.abs().min(dual.abs()))).max(primal_residual).max(dual_residual);
        if merit.is_nan() || merit.is_infinite() {
            return give(best, Status::Stalled);
        }
        if warm.is_none() && merit <= WARM {
            *warm = Some((p.clone(), s.clone()));
        }
        if best.as_ref().is_none_or(|b| merit < b.0) {
            best = Some((merit, p.clone()));
            since = 0;
        } else {
            since += 1;
        }
        if merit <= settings.tolerance {
            return give(best, Status::Solved);
        }
        if since > PATIENCE {
            return give(best, Status::Stalled);
        }
        if clock.elapsed().as_secs_f64() >= settings.seconds {
            return give(best, Status::Limit);
        }
        if !cones.scale(&s, &p.z) {
            return give(best, Status::Stalled);
        }
        let mu = gap / degree;
        let Some(mut newton) = Newton::new(st, reduced, &cones) else { return give(best, Status::Stalled) };
        // Residuals that are small already stay so.
        let enough = BELOW * settings.tolerance;
        // Predictor: a_z = −r_z − W u with u = −λ, so that W u = −s.
        let mut a = minus(&r);
        add(&mut a.z, 1.0, &s);
        let predictor = newton.solve(&a, ROUGH, 0.0);
        let ds = slack(st, &predictor, &r);
        let (ap, ad) = steps(&cones, st, (&s, &ds), (&p.z, &predictor.z), 1.0);
        let after: f64 = s.iter().zip(&ds).zip(p.z.iter().zip(&predictor.z)).map(|((s, ds), (z, dz))| (s + ap * ds) * (z + ad * dz)).sum();
        let sigma = (after / gap).clamp(0.0, 1.0).powi(3);
        // Corrector: λ ∘ u = −λ∘λ − (W⁻¹ ds) ∘ (W dz) + σ μ e.
        let mut u = ds;
        cones.over(&mut u);
        let mut w_dz = predictor.z;
        cones.times(&mut w_dz);
        cones.product(&w_dz, &mut u);
        let mut square = cones.lambda.clone();
        cones.product(&cones.lambda, &mut square);
        u.iter_mut().zip(&square).for_each(|(u, l)| *u = -*u - l);
        cones.add_unit(&mut u, sigma * mu);
        cones.divide(&mut u);
        cones.times(&mut u);
        let mut a = minus(&r);
        add(&mut a.z, -1.0, &u);
        let mut d = newton.solve(&a, EXACT, enough);
        let mut ds = slack(st, &d, &r);
        let (mut ap, mut ad) = steps(&cones, st, (&s, &ds), (&p.z, &d.z), TO_THE_BOUNDARY);
        for _ in 0..MOST_CORRECTORS {
            if ap.min(ad) > FAR_ENOUGH {
                break;
            }
            let (tp, td) = ((ap + REACH).min(1.0), (ad + REACH).min(1.0));
            let (mut u, mut v) = (ds.clone(), d.z.clone());
            cones.over(&mut u);
            cones.times(&mut v);
            u.iter_mut().zip(&cones.lambda).for_each(|(u, l)| *u = l + tp * *u);
            v.iter_mut().zip(&cones.lambda).for_each(|(v, l)| *v = l + td * *v);
            cones.product(&v, &mut u);
            cones.towards(LOW * sigma * mu, HIGH * sigma * mu, &mut u);
            cones.divide(&mut u);
            cones.times(&mut u);
            u.iter_mut().for_each(|u| *u = -*u);
            let more = newton.solve(&Point { z: u, ..Point::zero(st) }, ROUGH, 0.0);
            let zero = Point::zero(st);
            let more_s = slack(st, &more, &zero);
            // As much of it as brings us farthest.
            let mut found: Option<(f64, f64, [f64; 2], [Vec<f64>; 2])> = None;
            for weight in [1.0, 0.7, 0.4, 0.2, 0.1] {
                let mix = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + weight * b).collect::<Vec<f64>>();
                let (s2, z2) = (mix(&ds, &more_s), mix(&d.z, &more.z));
                let (bp, bd) = steps(&cones, st, (&s, &s2), (&p.z, &z2), TO_THE_BOUNDARY);
                let score = bp * bd;
                if found.as_ref().is_none_or(|(best, ..)| score > *best) {
                    found = Some((score, weight, [bp, bd], [s2, z2]));
                }
            }
            let Some((score, weight, step, [s2, z2])) = found else { break };
            if score < ap * ad * (1.0 + WORTH) {
                break;
            }
            add(&mut d.x, weight, &more.x);
            add(&mut d.t, weight, &more.t);
            add(&mut d.y, weight, &more.y);
            (ds, d.z, [ap, ad]) = (s2, z2, step);
        }
        if ap.max(ad) < LEAST_STEP || ap.is_nan() || ad.is_nan() {
            return give(best, Status::Stalled);
        }
        add(&mut p.x, ap, &d.x);
        add(&mut p.t, ap, &d.t);
        add(&mut s, ap, &ds);
        add(&mut p.y, ad, &d.y);
        add(&mut p.z, ad, &d.z);
    }
    give(best, Status::Limit)
}

/// `ds = −r_z − G dx`.
fn slack(st: &Structure, d: &Point, r: &Point) -> Vec<f64> {
    let mut ds: Vec<f64> = r.z.clone();
    st.g.add(&d.x, &mut ds);
    st.g_border.add(&d.t, &mut ds);
    ds.iter_mut().for_each(|v| *v = -*v);
    ds
}

/// How far both sides may go; equally far where a quadratic part ties them together.
fn steps(cones: &Cones, st: &Structure, (s, ds): (&[f64], &[f64]), (z, dz): (&[f64], &[f64]), share: f64) -> (f64, f64) {
    let (ap, ad) = ((share * cones.step(s, ds)).min(1.0), (share * cones.step(z, dz)).min(1.0));
    if st.quadratic.is_empty() { (ap, ad) } else { (ap.min(ad), ap.min(ad)) }
}

#[cfg(test)]
mod tests;
