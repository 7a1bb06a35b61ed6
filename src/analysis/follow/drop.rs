//! What happens at one value of the parameter when forces cease: the joint that opens carries the
//! structure to the next equilibrium, or nowhere.

use super::{
    linkage::{Configuration, Linkage, OpenBy},
    point::End,
    program::Hold,
    root::narrow,
    tracker::Tracker,
};
use model::assembly::Pose;
use nalgebra::DVector;

/// Where it comes to rest.
pub(super) enum Landing {
    /// At once: the new joint opens as the parameter grows.
    Steady(Vec<Vec<usize>>),
    /// Somewhere else at the same value.
    Elsewhere {
        /// The poses there.
        poses: Vec<Pose>,
        /// Closed corners there.
        closed: Vec<Vec<usize>>,
    },
    /// Nowhere.
    Nowhere,
    /// It could not be followed, and why.
    Lost(String),
}

/// First and longest step of the opening, and the widest, over the size of the scene.
const FIRST: f64 = 1e-5;
const STEP: f64 = 2e-3;
const WIDEST: f64 = 0.1;

/// Opens the corners that lost their forces and follows the structure at one value.
pub(super) fn drop(
    t: &Tracker,
    closed: &[Vec<usize>],
    holds: &[Hold],
    lost: &[(usize, usize)],
    from: &Configuration,
    value: f64,
) -> Landing {
    let together = step_down(t, closed, holds, lost, from, value, MOST);
    if !matches!(together, Landing::Nowhere) {
        return together;
    }
    // A scene that is its own image need not fall as one: the first joint alone may carry it to
    // where it rests.
    let mut joints: Vec<usize> = lost.iter().map(|l| l.0).collect();
    joints.dedup();
    for joint in joints.iter().filter(|_| joints.len() > 1) {
        let mut one = closed.to_vec();
        for &(k, p) in lost.iter().filter(|l| l.0 != *joint) {
            one[k].push(p);
            one[k].sort_unstable();
        }
        let first: Vec<_> = lost.iter().copied().filter(|l| l.0 == *joint).collect();
        let alone = step_down(t, &one, holds, &first, from, value, MOST);
        if matches!(alone, Landing::Elsewhere { .. }) {
            return alone;
        }
    }
    together
}

/// So many joints may close on the way down. More: what falls down is called a jump.
const MOST: usize = 8;

fn step_down(
    t: &Tracker,
    closed: &[Vec<usize>],
    holds: &[Hold],
    lost: &[(usize, usize)],
    from: &Configuration,
    value: f64,
    more: usize,
) -> Landing {
    let linkage = t.linkage(closed, holds);
    let from = linkage.place(&from.poses);
    let demand = t.drive.demand(value);
    let free = linkage.free(&from, demand.as_ref()).ncols();
    if free == 0 {
        // Others carry what it carried: nothing moves by itself.
        return Landing::Steady(closed.to_vec());
    }
    // All corners at once where that can be, as in a symmetric scene; else the first joint.
    let open = |lost: &[(usize, usize)], gap: f64| -> Vec<OpenBy> {
        lost.iter().map(|&(interface, point)| OpenBy { interface, point, gap }).collect()
    };
    let first: Vec<(usize, usize)> = lost.iter().copied().filter(|l| l.0 == lost[0].0).collect();
    let close = |lost: &[(usize, usize)], near: &Configuration, gap: f64| {
        linkage.close(near, demand.as_ref(), &open(lost, gap))
    };
    let lost = if close(lost, &from, FIRST * t.size).is_some() { lost } else { &first[..] };
    let power = |a: &Configuration, b: &Configuration| power(t, &linkage, a, b, lost);
    // Does the motion that opens them gain power right away?
    let Some(near) = close(lost, &from, FIRST * t.size) else {
        return Landing::Lost("the joint that should open cannot open".into());
    };
    let Some(nearer) = close(lost, &near, 0.5 * FIRST * t.size) else {
        return Landing::Lost("the joint that should open cannot open".into());
    };
    if power(&nearer, &near) < 0.0 {
        return Landing::Steady(closed.to_vec());
    }
    let mut here = (FIRST, near);
    let mut step = FIRST;
    loop {
        if here.0 >= WIDEST {
            return Landing::Nowhere;
        }
        let gap = here.0 + step;
        let Some(there) = close(lost, &here.1, gap * t.size) else {
            step *= 0.25;
            if step < 1e-3 * FIRST {
                return Landing::Nowhere;
            }
            continue;
        };
        let overlap = |p: &Configuration| {
            t.open(&p.poses, closed)
                .iter()
                .filter(|c| !lost.contains(&(c.interface, c.point)))
                .map(|c| c.gap + 1e-10)
                .fold(1.0, f64::min)
        };
        let depth = overlap(&there);
        if depth < 0.0 {
            let low = (here.0, overlap(&here.1).max(0.0), here.1.clone());
            let ends = narrow(low, (gap, depth, there), 1e-13 * gap, |g, near| {
                let p = close(lost, near, g * t.size)?;
                Some((overlap(&p), p))
            });
            let Some([low, _]) = ends else {
                return Landing::Lost("the point where a joint closes was not found".into());
            };
            return landed(t, closed, holds, &low.2, value, more);
        }
        let gain = power(&here.1, &there);
        if gain < 0.0 {
            // An equilibrium on the way, both joints open.
            let Some(at) = t.at(&linkage, &there, value) else {
                return Landing::Lost("the equilibrium after a jump was not found".into());
            };
            return match t.margin(&at.place.poses, closed, holds) {
                Some(m) if m.room >= -1e-9 => {
                    Landing::Elsewhere { poses: at.place.poses, closed: closed.to_vec() }
                }
                _ => Landing::Nowhere,
            };
        }
        here = (gap, there);
        step = (2.0 * step).min(STEP);
    }
}

/// A joint closed on the way: does it rest there?
fn landed(
    t: &Tracker,
    closed: &[Vec<usize>],
    holds: &[Hold],
    place: &Configuration,
    value: f64,
    more: usize,
) -> Landing {
    let now = match t.with_closed(&place.poses, closed) {
        Ok(found) => found,
        Err(End::Stuck(text)) => return Landing::Lost(text),
        Err(_) => return Landing::Nowhere,
    };
    match t.margin(&place.poses, &now, holds) {
        Some(m) if m.room >= -1e-9 => {
            Landing::Elsewhere { poses: place.poses.clone(), closed: now }
        }
        Some(m) if more > 0 => {
            // Not yet: the next joint opens at once.
            let lost = t.lost(&place.poses, &now, &m);
            let mut open = now;
            lost.iter().for_each(|&(k, p)| open[k].retain(|&q| q != p));
            if lost.is_empty() {
                return Landing::Nowhere;
            }
            match step_down(t, &open, holds, &lost, place, value, more - 1) {
                Landing::Steady(closed) => {
                    Landing::Elsewhere { poses: place.poses.clone(), closed }
                }
                other => other,
            }
        }
        Some(_) => Landing::Nowhere,
        // Nothing balances it there, whatever the room: it goes on.
        None if t.falls_there(&place.poses, &now) => Landing::Nowhere,
        None => Landing::Lost("no balanced forces were found after a jump".into()),
    }
}

/// Power of the loads on the way from one place to the next; with a free load factor at what holds
/// the linkage whose new joint keeps still.
fn power(
    t: &Tracker,
    linkage: &Linkage,
    a: &Configuration,
    b: &Configuration,
    lost: &[(usize, usize)],
) -> f64 {
    let [dead, live] = t.loads(linkage, &a.poses);
    let by = linkage.between(a, b);
    let motions = nalgebra::DMatrix::from_columns(&[by]);
    let of = |loads: &[_], m: &nalgebra::DMatrix<f64>| linkage.power(a, loads, m)[0];
    let gain = of(&dead, &motions);
    if !t.drive.is_push() {
        return gain;
    }
    let still = still(linkage, a, lost);
    let Some(still) = still else { return f64::NAN };
    let still = nalgebra::DMatrix::from_columns(&[still]);
    let load_factor = -of(&dead, &still) / of(&live, &still);
    gain + load_factor * of(&live, &motions)
}

/// The motion of the linkage in which the new joint does not open any further.
fn still(
    linkage: &Linkage,
    place: &Configuration,
    lost: &[(usize, usize)],
) -> Option<DVector<f64>> {
    let list: Vec<OpenBy> =
        lost.iter().map(|&(interface, point)| OpenBy { interface, point, gap: 0.0 }).collect();
    let free = linkage.free_with(place, &list);
    (free.ncols() >= 1).then(|| free.column(0).into_owned())
}
