//! Following the central path: predictor, corrector, step.

use super::{
    cones::Cones,
    correctors::further,
    newton::{EXACT, Iterate, Newton, ROUGH},
    reduced::Reduced,
    step::{add, kept_inside, share_of_the_way, slack, steps},
    structure::Structure,
};
use crate::{Iteration, Settings, Status, clock::Instant};

/// A point within this × the tolerance is almost a solution: rounding may allow no more. Larger:
/// poor points pass where no later attempt would be better. Smaller: sequences of programs leave
/// the engine for digits that do not matter.
const ALMOST: f64 = 1e2;

/// Equilibrium is solved to this × the tolerance. Larger: the residual stays above the tolerance
/// while the gap is closed. Smaller: corrections at the level of rounding.
const BELOW: f64 = 0.05;

/// Where the next solve of a session begins: at the first point of the last one with no more than
/// this of its error left. Larger: nearly from the start. Smaller: so near the boundary that
/// changed limits leave no room.
const LATE: f64 = 1e-5;

/// Where the solve of another program alike begins, moved inward once more: at the first point with
/// no more than this of its error left. Larger: nearly from the start. Smaller: nearer to the
/// boundary than what differs between two directions of a tilt, and more steps than without.
const EARLY: f64 = 1e-2;

/// The gap counts relative to the objective, or to this where that is smaller: an equilibrium error may be
/// zero. Larger: load factors far below the natural one lose digits. Smaller: iterations at an
/// objective of zero.
const LEAST_OBJECTIVE: f64 = 1e-2;

/// A step shorter than this leads nowhere.
const LEAST_STEP: f64 = 1e-6;

/// Iterations without a better point after which the method stops. Fewer: slow starts are given up.
/// More: time at the noise level.
const PATIENCE: usize = 8;

/// A value beyond this is far from zero ([`Settings::where_positive`]). Larger: more digits of it than
/// its sign needs. Smaller: not all of the residuals are small beside it.
const FAR_FROM_ZERO: f64 = 1e-3;

/// No point satisfies the constraints of a linear program where the dual objective passes the primal
/// one by this × its size (and one), and the dual residual is no more than that × this. Larger excess:
/// packings that fall cost more iterations. Smaller, or more residual: others are given up.
const BEYOND: f64 = 10.0;
const BEYOND_RESIDUAL: f64 = 1e-5;

/// Where the method runs on springs held by this × the mean of the cones' products, unknowns that
/// nothing limits stay where they are. Larger: more iterations. Smaller: they grow until rounding
/// of them is all that equilibrium has left.
pub(super) const HELD: f64 = 1e-3;

/// The start lies this × the greatest entry inside every cone, `s` (of forces) and `z` (of rates).
/// Only the cones that lie less far inside are moved: with all of them moved alike seven packings of
/// 4,000 and 5,000 grains take 94 iterations in place of 80, a wall of 100 × 100 blocks 33 in place
/// of 32.
/// Smaller: first steps that end at once. Larger: steps that make up for the start.
const FORCES_INSIDE: f64 = 0.25;
const RATES_INSIDE: f64 = 2.5;

/// Unknowns beyond this have grown because nothing limits them: forces of grains that are jammed
/// between others. Larger: such programs stay unsolved. Smaller: others that stall are solved twice.
const GROWN: f64 = 1e3;

/// A point inside the cones, and its slack there.
pub(super) type Inside = (Iterate, Vec<f64>);

/// Where a path led.
pub(super) struct Followed {
    /// The best point.
    pub point: Option<Iterate>,
    pub status: Status,
    /// The first point after the start with no more than [`EARLY`] of its error left, and the first of
    /// all with no more than [`LATE`].
    pub early: Option<Inside>,
    pub late: Option<Inside>,
    pub trace: Vec<Iteration>,
}

impl Followed {
    /// Whether it may have stalled because unknowns grew without bound.
    pub fn has_grown(&self) -> bool {
        matches!(self.status, Status::Stalled | Status::AlmostSolved)
            && self.point.as_ref().is_some_and(|p| greatest(&p.x) > GROWN)
    }

    /// This one, with the iterations of another before its own: the last is that of the answer.
    pub fn after(mut self, mut other: Self) -> Self {
        other.trace.append(&mut self.trace);
        Self { trace: other.trace, ..self }
    }
}

/// Objective and right-hand sides.
pub(super) struct Data {
    /// Objective of the local variables and of the border.
    pub c: Vec<f64>,
    pub c_border: Vec<f64>,
    /// Right-hand sides of equalities and cone rows.
    pub b: Vec<f64>,
    pub h: Vec<f64>,
}

pub(super) fn greatest(v: &[f64]) -> f64 {
    // A NaN is as great as can be.
    v.iter().fold(0.0, |m, v| if v.is_nan() { f64::INFINITY } else { f64::max(m, v.abs()) })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `P x + c + Eᵀ y + Gᵀ z`, `E x − b`, `G x + s − h`.
fn residual(st: &Structure, data: &Data, p: &Iterate, s: &[f64]) -> Iterate {
    let mut r = Iterate {
        x: data.c.clone(),
        t: data.c_border.clone(),
        y: data.b.iter().map(|v| -v).collect(),
        z: s.iter().zip(&data.h).map(|(s, h)| s - h).collect(),
    };
    for ((r, x), q) in r.x.iter_mut().zip(&p.x).zip(&st.quadratic) {
        *r += q * x;
    }
    st.e.add_transposed(1.0, &p.y, &mut r.x);
    st.g.add_transposed(1.0, &p.z, &mut r.x);
    st.e_border.add_transposed(1.0, &p.y, &mut r.t);
    st.g_border.add_transposed(1.0, &p.z, &mut r.t);
    st.e.add(1.0, &p.x, &mut r.y);
    st.e_border.add(1.0, &p.t, &mut r.y);
    st.g.add(1.0, &p.x, &mut r.z);
    st.g_border.add(1.0, &p.t, &mut r.z);
    r
}

fn minus(p: &Iterate) -> Iterate {
    let minus = |v: &[f64]| v.iter().map(|v| -v).collect();
    Iterate { x: minus(&p.x), t: minus(&p.t), y: minus(&p.y), z: minus(&p.z) }
}

/// The point that balances at least cost and the one that is admissible at least cost, brought
/// inside their cones.
fn begin(
    st: &Structure,
    reduced: &mut Reduced,
    cones: &mut Cones,
    data: &Data,
) -> Option<(Iterate, Vec<f64>)> {
    cones.reset();
    reduced.proximal = 0.0;
    let zero = Iterate::zero(st);
    let mut newton = Newton::new(st, reduced, cones)?;
    let primal =
        newton.solve(&Iterate { y: data.b.clone(), z: data.h.clone(), ..zero.clone() }, EXACT, 0.0);
    let cost = Iterate {
        x: data.c.iter().map(|v| -v).collect(),
        t: data.c_border.iter().map(|v| -v).collect(),
        ..zero
    };
    let dual = newton.solve(&cost, EXACT, 0.0);
    let inside = |mut v: Vec<f64>, share: f64| {
        let size = greatest(&v);
        cones.inward(&mut v, if size > 0.0 { share * size } else { 1.0 });
        v
    };
    let s = inside(primal.z.iter().map(|v| -v).collect(), FORCES_INSIDE);
    Some((Iterate { x: primal.x, t: primal.t, y: dual.y, z: inside(dual.z, RATES_INSIDE) }, s))
}

/// Solves the program from a point inside the cones, or from its own start. `start` is when this solve
/// began. Every step is that of the program with `½ ρ ‖x − x₀‖²` added, where `x₀` is the point that it
/// starts from and `ρ` is `held` × the mean of the cones' products (S. Pougkakiotis and J. Gondzio
/// 2021): it ends in the same places, and where the solutions are an unbounded set it ends.
pub(super) fn follow(
    st: &Structure,
    reduced: &mut Reduced,
    data: &Data,
    settings: &Settings,
    (start, held): (Instant, f64),
    from: Option<Inside>,
) -> Followed {
    let mut cones = Cones::new(&st.cones);
    let degree = cones.degree() as f64;
    let mut best: Option<(f64, Iterate)> = None;
    let (mut early, mut late, mut trace) = (None, None, Vec::new());
    let Some((mut p, mut s)) = from.or_else(|| begin(st, reduced, &mut cones, data)) else {
        return Followed { point: None, status: Status::Stalled, early, late, trace };
    };
    let mut since = 0;
    let almost = |best: &Option<(f64, Iterate)>| {
        best.as_ref().is_some_and(|b| b.0 <= ALMOST * settings.tolerance)
    };
    let mut status = 'path: {
        for step in 0..=settings.iterations {
            let r = residual(st, data, &p, &s);
            let quadratic: f64 = p.x.iter().zip(&st.quadratic).map(|(x, q)| q * x * x).sum();
            let linear = dot(&data.c, &p.x) + dot(&data.c_border, &p.t);
            let primal = 0.5 * quadratic + linear;
            let dual = -0.5 * quadratic - dot(&data.b, &p.y) - dot(&data.h, &p.z);
            let gap = dot(&s, &p.z);
            let primal_residual = greatest(&r.y).max(greatest(&r.z))
                / 1f64.max(greatest(&data.b)).max(greatest(&data.h));
            let dual_residual = greatest(&r.x).max(greatest(&r.t))
                / 1f64.max(greatest(&data.c)).max(greatest(&data.c_border));
            trace.push(Iteration {
                seconds: start.elapsed().as_secs_f64(),
                primal,
                dual,
                primal_residual,
                dual_residual,
            });
            let merit = (gap / LEAST_OBJECTIVE.max(primal.abs().min(dual.abs())))
                .max(primal_residual)
                .max(dual_residual);
            if merit.is_nan() || merit.is_infinite() {
                break 'path Status::Stalled;
            }
            if step > 0 && early.is_none() && merit <= EARLY {
                early = Some((p.clone(), s.clone()));
            }
            if late.is_none() && merit <= LATE {
                late = Some((p.clone(), s.clone()));
            }
            if best.as_ref().is_none_or(|b| merit < b.0) {
                best = Some((merit, p.clone()));
                since = 0;
            } else {
                since += 1;
            }
            let positive = merit <= settings.where_positive && dual >= FAR_FROM_ZERO;
            if positive || merit <= settings.tolerance {
                break 'path Status::Solved;
            }
            let excess = dual - primal;
            if st.quadratic.is_empty()
                && excess > BEYOND * primal.abs().max(1.0)
                && dual_residual <= BEYOND_RESIDUAL * excess
            {
                break 'path Status::PrimalInfeasible;
            }
            if since > if almost(&best) { 1 } else { PATIENCE } {
                break 'path Status::Stalled;
            }
            if settings.deadline.is_over() {
                // The point to start from is no answer: its rates are far from admissible, and a bound
                // corrected to first order would be untrue.
                best = best.filter(|_| step > 0);
                break 'path Status::Limit;
            }
            if !cones.scale(&s, &p.z) {
                break 'path Status::Stalled;
            }
            let mu = gap / degree;
            reduced.proximal = held * mu;
            let Some(mut newton) = Newton::new(st, reduced, &cones) else {
                break 'path Status::Stalled;
            };
            // Residuals that are small already stay so.
            let enough = BELOW * settings.tolerance;
            // Predictor: a_z = −r_z − W u with u = −λ, so that W u = −s.
            let mut a = minus(&r);
            add(&mut a.z, 1.0, &s);
            let predictor = newton.solve(&a, ROUGH, 0.0);
            let ds = slack(st, &predictor, &r);
            let (ap, ad) = steps(&cones, st, (&s, &ds), (&p.z, &predictor.z), 1.0);
            let after: f64 = s
                .iter()
                .zip(&ds)
                .zip(p.z.iter().zip(&predictor.z))
                .map(|((s, ds), (z, dz))| (s + ap * ds) * (z + ad * dz))
                .sum();
            let sigma = (after / gap).clamp(0.0, 1.0).powi(3);
            let share = share_of_the_way(sigma);
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
            let (mut ap, mut ad) = steps(&cones, st, (&s, &ds), (&p.z, &d.z), share);
            further(
                &mut newton,
                (&s, &p.z),
                (sigma * mu, share),
                (&mut d, &mut ds),
                (&mut ap, &mut ad),
            );
            if ap.max(ad) < LEAST_STEP || ap.is_nan() || ad.is_nan() {
                break 'path Status::Stalled;
            }
            (ap, ad) = kept_inside(&cones, st, (&s, &ds), (&p.z, &d.z), (ap, ad));
            add(&mut p.x, ap, &d.x);
            add(&mut p.t, ap, &d.t);
            add(&mut s, ap, &ds);
            add(&mut p.y, ad, &d.y);
            add(&mut p.z, ad, &d.z);
        }
        Status::Limit
    };
    if status == Status::Stalled && almost(&best) {
        status = Status::AlmostSolved;
    }
    Followed { point: best.map(|b| b.1), status, early, late, trace }
}
