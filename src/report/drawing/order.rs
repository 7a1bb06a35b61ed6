//! Which block hides which: an order in which all can be drawn one over the other.
//!
//! Of two bodies that overlap on the sheet and that a plane separates, the one on the eye's side is
//! in front. Blocks that touch on a face are separated by its plane; others are tried with the
//! planes of their facets. What no such plane separates, and circles of blocks that hide one
//! another, fall back on the depth of their centres.

use super::{
    body::{Form, Solid},
    hull::Hull,
    projection::Projection,
};
use crate::view::View;
use nalgebra::Vector3;
use std::{cmp::Ordering, collections::BinaryHeap, collections::HashMap};

/// More facets than this of one body are not tried: stones that were measured have thousands, and
/// every one costs a look at all corners.
const FACETS: usize = 64;
/// Bodies that overlap by less than this × their reach still count as separated: joints have
/// tolerances, mechanisms close up a little.
const OVERLAP: f64 = 0.02;
/// A plane is seen from its edge, and says nothing about who is in front, when its normal is this
/// close to the sheet.
const EDGE_ON: f64 = 1e-6;

/// Indices of the bodies, the far ones first.
pub fn back_to_front(view: &View, bodies: &[Solid], paper: &Projection) -> Vec<usize> {
    let eye = paper.axes.eye;
    let depth: Vec<f64> = bodies.iter().map(|b| eye.dot(&b.middle)).collect();
    let frames: Vec<[[f64; 2]; 2]> =
        bodies.iter().map(|b| [b.reach(&paper.axes.right), b.reach(&paper.axes.up)]).collect();
    // Most masonry is built along the axes: what they separate needs no look at the corners.
    let axes = [eye, Vector3::x(), Vector3::y(), Vector3::z()];
    let boxes: Vec<[[f64; 2]; 4]> = bodies.iter().map(|b| axes.map(|a| b.reach(&a))).collect();
    let hulls: Vec<Hull> = bodies.iter().map(|b| Hull::new(b, paper)).collect();
    let faces: HashMap<(usize, usize), Vector3<f64>> =
        view.joints.iter().map(|f| ((f.a.min(f.b), f.a.max(f.b)), f.normal)).collect();

    let mut by_left: Vec<usize> = (0..bodies.len()).collect();
    by_left.sort_by(|&i, &j| frames[i][0][0].total_cmp(&frames[j][0][0]));
    // Who has to wait for whom.
    let mut nearer: Vec<Vec<u32>> = vec![Vec::new(); bodies.len()];
    let mut waits = vec![0_usize; bodies.len()];
    for (k, &i) in by_left.iter().enumerate() {
        let later = by_left[k + 1..].iter().take_while(|&&j| frames[j][0][0] < frames[i][0][1]);
        for &j in later
            .filter(|&&j| overlap(&frames[i][1], &frames[j][1]) && hulls[i].overlaps(&hulls[j]))
        {
            let known = faces.get(&(i.min(j), i.max(j)));
            let quick = (0..4).find_map(|k| apart(boxes[i][k], boxes[j][k], axes[k].dot(&eye)));
            let (far, near) = match quick.unwrap_or_else(|| {
                in_front(&bodies[i], &bodies[j], known, &eye, [depth[i], depth[j]])
            }) {
                Ordering::Less => (i, j),
                Ordering::Greater => (j, i),
                Ordering::Equal => continue,
            };
            nearer[far].push(near as u32);
            waits[near] += 1;
        }
    }

    let mut by_depth: Vec<usize> = (0..bodies.len()).collect();
    by_depth.sort_by(|&i, &j| depth[i].total_cmp(&depth[j]).then(i.cmp(&j)));
    let mut ready: BinaryHeap<Far> =
        by_depth.iter().filter(|&&i| waits[i] == 0).map(|&i| Far(depth[i], i)).collect();
    let mut rest = by_depth.into_iter();
    let mut done = vec![false; bodies.len()];
    let mut order = Vec::with_capacity(bodies.len());
    loop {
        // Where all wait in a circle, the farthest breaks it.
        let Some(i) = ready.pop().map(|f| f.1).or_else(|| rest.by_ref().find(|&i| !done[i])) else {
            return order;
        };
        if std::mem::replace(&mut done[i], true) {
            continue;
        }
        order.push(i);
        for &j in &nearer[i] {
            let j = j as usize;
            waits[j] -= 1;
            if waits[j] == 0 {
                ready.push(Far(depth[j], j));
            }
        }
    }
}

fn overlap(a: &[f64; 2], b: &[f64; 2]) -> bool {
    a[0] < b[1] && b[0] < a[1]
}

/// The order of two bodies that lie apart along an axis, `towards` its cosine to the eye.
fn apart(a: [f64; 2], b: [f64; 2], towards: f64) -> Option<Ordering> {
    if towards.abs() <= EDGE_ON {
        return None;
    }
    match (a[1] <= b[0], b[1] <= a[0]) {
        (true, false) => Some(if towards > 0.0 { Ordering::Less } else { Ordering::Greater }),
        (false, true) => Some(if towards > 0.0 { Ordering::Greater } else { Ordering::Less }),
        _ => None,
    }
}

/// `Less` where `a` is behind `b`, `Equal` where neither hides the other.
fn in_front(
    a: &Solid,
    b: &Solid,
    known: Option<&Vector3<f64>>,
    eye: &Vector3<f64>,
    depth: [f64; 2],
) -> Ordering {
    let by_depth = depth[0].total_cmp(&depth[1]);
    if let (Form::Sphere(_), Form::Sphere(_)) = (&a.form, &b.form) {
        return by_depth;
    }
    let mut best: Option<(f64, f64)> = None;
    let own = a.normals().iter().take(FACETS).copied();
    let others = b.normals().iter().take(FACETS).map(|n| -n);
    for n in known.copied().into_iter().chain(own).chain(others) {
        for n in [n, -n] {
            let ([low, top], [bottom, high]) = (a.reach(&n), b.reach(&n));
            let gap = (bottom - top) / (top - low).min(high - bottom).max(f64::MIN_POSITIVE);
            if gap > -OVERLAP && best.is_none_or(|(g, _)| gap > g) {
                best = Some((gap, n.dot(eye)));
            }
        }
    }
    match best {
        // `b` lies where `n` points.
        Some((_, towards)) if towards > EDGE_ON => Ordering::Less,
        Some((_, towards)) if towards < -EDGE_ON => Ordering::Greater,
        Some(_) => Ordering::Equal,
        None => by_depth,
    }
}

/// The farthest comes first.
struct Far(f64, usize);

impl Ord for Far {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.total_cmp(&self.0).then(other.1.cmp(&self.1))
    }
}

impl PartialOrd for Far {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Far {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Far {}
