//! Questions about scenes of several independent parts ([`model::interface::parts`]): each part is
//! asked by itself, on threads, and the answers are put together.
//!
//! A scene of one part goes the same way, so that a part is answered to the last digit alike alone
//! and among others.
//!
//! * *Stands* ([`assess`]): the worst verdict; of several, the greatest equilibrium error. The forces are
//!   those of all parts, a motion is that of the part that decides, and the others rest.
//! * *Load factor* ([`limit`]): the least. The forces of the other parts are asked for at that load
//!   factor, for one number multiplies the live load of all. Where a part needs more live load than
//!   another bears, no multiple lets the scene stand, and their two mechanisms together, each
//!   driven as much by the live load as it holds the other back, prove it.
//! * *With dry friction* ([`dry`]): the least as well.
//! * *Thrust* ([`thrust`]): the sum over the parts that touch the support.

pub(super) mod assess;
pub(super) mod dry;
pub(super) mod limit;
pub(super) mod thrust;

use super::{Attempt, Control};
use check::verdict::{Forces, Rate, no_forces};
use cholesky::parallel;
use model::{
    assembly::Assembly,
    interface::{Interfaces, Part},
};

/// Contact points from which threads are worth starting. Fewer: rows of a sweep, which are on
/// threads already, start more. More: a scene of a hundred blocks waits for one thread.
const WORTH_THREADS: usize = 400;

/// The answers of the parts `which`, in their order; all share the time.
fn each<R: Send>(
    parts: &[Part],
    which: &[usize],
    control: &Control,
    ask: impl Fn(usize, &Control) -> R + Sync,
) -> Vec<R> {
    let one = |k: usize| ask(k, control);
    let points =
        |k: usize| parts[k].model.interfaces.list.iter().map(|f| f.points.len()).sum::<usize>();
    if which.len() > 1 && which.iter().map(|&k| points(k)).sum::<usize>() >= WORTH_THREADS {
        // The largest first: it should not be begun when everything else is done.
        let mut order = which.to_vec();
        order.sort_by_key(|&k| std::cmp::Reverse(points(k)));
        if let Ok(answers) = parallel::map(0, &order, |&k| one(k)) {
            let mut answers: Vec<(usize, R)> = order.into_iter().zip(answers).collect();
            answers.sort_by_key(|a| a.0);
            return answers.into_iter().map(|a| a.1).collect();
        }
    }
    which.iter().map(|&k| one(k)).collect()
}

/// Forces of the scene from those of its parts; zero in the contacts of parts that have none.
fn scene_forces<'a>(
    interfaces: &Interfaces,
    own: impl IntoIterator<Item = (&'a Part, &'a Forces)>,
) -> Forces {
    let mut forces = no_forces(interfaces);
    own.into_iter().for_each(|(part, own)| part.put_forces(own, &mut forces));
    forces
}

/// Rates of the scene in which one part moves and the rest is still.
fn scene_rates(assembly: &Assembly, part: &Part, own: &[Rate]) -> Vec<Rate> {
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    put_rates(part, own, 1.0, &mut rates);
    rates
}

/// Puts the rates of a part, `by` times as fast, among those of the scene.
fn put_rates(part: &Part, own: &[Rate], by: f64, rates: &mut [Rate]) {
    for (&i, q) in part.blocks.iter().zip(own) {
        rates[i] = Rate { velocity: q.velocity * by, spin: part.units.spin(&q.spin) * by };
    }
}

/// What the parts left out: each line once, with how many parts it holds for where that is not all
/// of them.
fn left_out<'a>(
    interfaces: &Interfaces,
    own: impl Iterator<Item = &'a [String]>,
    count: usize,
) -> Vec<String> {
    let mut lines: Vec<(&String, usize)> = Vec::new();
    for line in own.flatten() {
        match lines.iter_mut().find(|(known, _)| *known == line) {
            Some((_, n)) => *n += 1,
            None => lines.push((line, 1)),
        }
    }
    let mut lines: Vec<String> = lines
        .into_iter()
        .map(|(line, n)| {
            if n == count {
                line.clone()
            } else {
                format!("{line} (in {n} of {count} independent parts)")
            }
        })
        .collect();
    if count > 1 && interfaces.support_pairs > 0 {
        lines.push(format!("{} contacts between supports", interfaces.support_pairs));
    }
    lines
}

/// Attempts at a load factor with their numbers as ones of the scene.
fn scene_attempts(part: &Part, own: &[Attempt]) -> Vec<Attempt> {
    let scene = |v: f64| part.units.load_factor(v);
    own.iter()
        .map(|a| {
            let load_factor = a.program.starts_with("load factor");
            let end = |v: f64| if load_factor { scene(v) } else { v };
            Attempt {
                lower: end(a.lower),
                upper: end(a.upper),
                engine_value: a.engine_value.map(scene),
                ..a.clone()
            }
        })
        .collect()
}
