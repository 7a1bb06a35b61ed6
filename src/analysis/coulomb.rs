//! Coulomb's law exactly: fixed points of programs C and D.

use super::{
    anderson::Anderson,
    attempt::{Attempt, Control},
};
use crate::{
    assembly::Assembly,
    interface::Interfaces,
    program::coulomb::{Aim, Contacts, Hold},
    solve::{Session, Settings, Solution},
};

/// One fixed point: at one ε or δ, by one way of holding friction.
#[derive(Clone, Debug)]
pub(super) struct FixedPoint {
    /// Forces per column, in mean block loads, inside the friction cones.
    pub forces: Vec<f64>,
    /// The load factor (D).
    pub lambda: f64,
    /// Rates of the blocks per row.
    pub rates: Vec<f64>,
    /// Last change of the held quantity, in mean block loads.
    pub change: f64,
    /// Natural map.
    pub natural_map: f64,
    /// Convex programs solved.
    pub solves: usize,
    /// The held quantity, for the next ε or δ.
    pub held: Vec<f64>,
}

/// Iterates one program until the held quantity settles to `tolerance` (absolute, mean block loads) or `most` solves are spent.
#[allow(clippy::too_many_arguments)]
pub(super) fn fixed_point(assembly: &Assembly, interfaces: &Interfaces, contacts: &Contacts, aim: Aim, hold: Hold, start: &[f64], tolerance: f64, most: usize, settings: &Settings, log: &mut Vec<String>) -> Option<FixedPoint> {
    let mut held = start.to_vec();
    let mut program = contacts.program(aim, hold, &held);
    let mut session = Session::new(&program, settings)?;
    let mut anderson = Anderson::default();
    let mut best: Option<FixedPoint> = None;
    for k in 0..most {
        let solution = session.solve();
        if !solution.is_finite() {
            log.push(format!("{aim:?} {hold:?} {k}: {:?}", solution.status));
            return best;
        }
        let point = read(contacts, aim, &solution);
        let (forces, lambda, rates, u) = point;
        let g = match hold { Hold::Limits => contacts.limits(&forces), Hold::SlidingRates => contacts.sliding(&u) };
        let change = g.iter().zip(&held).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let cut = contacts.cut(&forces);
        let natural_map = world(contacts, assembly, interfaces, &cut, &rates);
        log.push(format!("{aim:?} {hold:?} {k}: {:?} it {} lambda {lambda:.8} change {change:.2e} map {natural_map:.2e} {:.3}s", solution.status, solution.trace.len(), solution.seconds));
        best = Some(FixedPoint { forces: cut, lambda, rates, change, natural_map, solves: k + 1, held: g.clone() });
        if change <= tolerance || natural_map <= 1e-6 {
            break;
        }
        held = anderson.next(&held, &g);
        contacts.hold(&mut program, hold, &held);
        let ok = match hold { Hold::Limits => session.set_rhs(&program.rhs), Hold::SlidingRates => session.set_objective(&program.objective) };
        if !ok { return best; }
    }
    best
}

/// Forces, load factor, block rates and joint rates of a solution.
fn read(contacts: &Contacts, aim: Aim, solution: &Solution) -> (Vec<f64>, f64, Vec<f64>, Vec<f64>) {
    let (rows, columns) = (contacts.statics.matrix.rows, contacts.statics.matrix.columns);
    let forces = solution.x[..columns].to_vec();
    let (lambda, rates, weight) = match aim {
        Aim::State(epsilon) => (0.0, contacts.residual(&forces, 0.0).iter().map(|r| r / epsilon).collect::<Vec<_>>(), 1.0),
        Aim::LoadFactor(delta, scale) => (scale * solution.x[columns], solution.z[..rows].to_vec(), delta),
    };
    let mut u = contacts.joint_rates(&rates);
    for ((u, c), f) in u.iter_mut().zip(&contacts.compliance).zip(&forces) {
        *u += weight * c * f;
    }
    (forces, lambda, rates, u)
}

fn world(contacts: &Contacts, assembly: &Assembly, interfaces: &Interfaces, forces: &[f64], rates: &[f64]) -> f64 {
    let f = contacts.statics.forces(interfaces, forces);
    let q: Vec<crate::verdict::Rate> = contacts.statics.rates(assembly.blocks.len(), rates).into_iter().map(|(velocity, spin)| crate::verdict::Rate { velocity, spin }).collect();
    crate::verdict::certificate::natural_map(assembly, interfaces, &f, &q).unwrap_or(f64::NAN)
}

/// Experimental driver.
pub fn probe(assembly: &Assembly, interfaces: &Interfaces, load: bool, _control: &Control) -> (Vec<String>, Vec<Attempt>) {
    let contacts = Contacts::new(assembly, interfaces, false, load);
    let settings = Settings { tolerance: 1e-11, regularization: 1e-9, ..Settings::default() };
    let mut log = Vec::new();
    let zero = vec![0.0; contacts.points.len()];
    if load {
        let natural = crate::verdict::check::natural_factor(assembly);
        let plans: Vec<Vec<(f64, f64, Hold)>> = vec![
            vec![(1e-5, 1e-3, Hold::Limits), (1e-9, 0.0, Hold::Limits)],
            vec![(1e-4, 1e-2, Hold::Limits), (1e-5, 1e-3, Hold::Limits), (1e-9, 0.0, Hold::Limits)],
            vec![(1e-3, 1e-1, Hold::Limits), (1e-4, 1e-2, Hold::Limits), (1e-6, 1e-3, Hold::Limits), (1e-9, 0.0, Hold::Limits)],
            vec![(1e-5, 1e-2, Hold::Limits), (1e-8, 1e-3, Hold::Limits), (1e-9, 0.0, Hold::Limits)],
            vec![(1e-4, 1e-4, Hold::SlidingRates), (1e-5, 1e-3, Hold::Limits), (1e-9, 0.0, Hold::Limits)],
            vec![(1e-5, 1e-4, Hold::SlidingRates), (1e-7, 1e-3, Hold::Limits), (1e-9, 0.0, Hold::Limits)],
            vec![(1e-5, 1e-5, Hold::SlidingRates), (1e-9, 0.0, Hold::SlidingRates)],
        ];
        for plan in plans {
            let mut l2 = Vec::new();
            let first = fixed_point(assembly, interfaces, &contacts, Aim::LoadFactor(plan[0].0, natural), Hold::SlidingRates, &zero, 0.0, 1, &settings, &mut l2);
            let mut last = first.map(|p| (p, Hold::SlidingRates));
            let mut total = 1; let mut note = String::new();
            for (delta, tol, hold) in plan {
                let Some((p, from)) = last.take() else { break };
                let start = if hold == Hold::Limits { contacts.limits(&p.forces) } else if from == hold { p.held.clone() } else { zero.clone() };
                last = fixed_point(assembly, interfaces, &contacts, Aim::LoadFactor(delta, natural), hold, &start, tol, 40, &settings, &mut l2).map(|p| { total += p.solves; note += &format!(" | {delta:.0e} {hold:?} {} solves l {:.7} ch {:.1e} map {:.1e}", p.solves, p.lambda, p.change, p.natural_map); (p, hold) });
            }
            log.push(format!("{total} solves{note}"));
        }
    } else {
        let mut start = fixed_point(assembly, interfaces, &contacts, Aim::State(1e-3), Hold::SlidingRates, &zero, 0.0, 1, &settings, &mut log).map(|s| contacts.limits(&s.forces));
        for eps in [1e-3, 1e-4, 1e-5] {
            if let Some(s) = start.clone() { let p = fixed_point(assembly, interfaces, &contacts, Aim::State(eps), Hold::Limits, &s, 1e-5, 30, &settings, &mut log);
                if let Some(p) = &p { let a = p.rates.iter().map(|r| (r * eps).abs()).fold(0.0, f64::max); log.push(format!("  eps {eps:e}: acceleration {a:.3e}")); }
                start = p.map(|p| p.held); }
        }
        fixed_point(assembly, interfaces, &contacts, Aim::State(1e-4), Hold::SlidingRates, &zero, 1e-5, 15, &settings, &mut log);
    }
    (log, Vec::new())
}
