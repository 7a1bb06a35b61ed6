//! Further correctors of one factorisation (Gondzio 1996; weighted as in Colombo & Gondzio 2008):
//! products of `s` and `z` that stray from the central path hold up the step, and a solve costs a
//! tenth of a factorisation.

use super::{
    newton::{Iterate, Newton, ROUGH},
    step::{add, slack, steps},
};

/// Further correctors towards products of one size (Gondzio 1996). Fewer: more factorisations.
/// More: time for little.
const MOST_CORRECTORS: usize = 2;

/// They aim this much farther than the step that is possible, and are kept when both steps
/// multiplied grow by this share.
const REACH: f64 = 0.3;
const WORTH: f64 = 0.05;

/// Products between these × the target are left as they are.
const LOW: f64 = 0.1;
const HIGH: f64 = 10.0;

/// Steps this long need no further corrector.
const FAR_ENOUGH: f64 = 0.9;

/// Improves a direction `(d, ds)` from `(s, z)` that aims at products `target`, and its steps on
/// both sides, by `share` of the way to the boundary.
pub(super) fn further(
    newton: &mut Newton,
    (s, z): (&[f64], &[f64]),
    (target, share): (f64, f64),
    (d, ds): (&mut Iterate, &mut Vec<f64>),
    (ap, ad): (&mut f64, &mut f64),
) {
    let (st, cones) = (newton.structure, newton.cones);
    let (mut s2, mut z2) = (vec![0.0; s.len()], vec![0.0; z.len()]);
    for _ in 0..MOST_CORRECTORS {
        if ap.min(*ad) > FAR_ENOUGH {
            break;
        }
        let (tp, td) = ((*ap + REACH).min(1.0), (*ad + REACH).min(1.0));
        let (mut u, mut v) = (ds.to_vec(), d.z.clone());
        cones.over(&mut u);
        cones.times(&mut v);
        u.iter_mut().zip(&cones.lambda).for_each(|(u, l)| *u = l + tp * *u);
        v.iter_mut().zip(&cones.lambda).for_each(|(v, l)| *v = l + td * *v);
        cones.product(&v, &mut u);
        cones.towards(LOW * target, HIGH * target, &mut u);
        cones.divide(&mut u);
        cones.times(&mut u);
        u.iter_mut().for_each(|u| *u = -*u);
        let more = newton.solve(&Iterate { z: u, ..Iterate::zero(st) }, ROUGH, 0.0);
        let zero = Iterate::zero(st);
        let more_s = slack(st, &more, &zero);
        // As much of it as brings us farthest.
        let mix = |to: &mut [f64], a: &[f64], weight: f64, b: &[f64]| {
            to.iter_mut().zip(a.iter().zip(b)).for_each(|(to, (a, b))| *to = a + weight * b);
        };
        let mut found: Option<Mix> = None;
        for weight in [1.0, 0.7, 0.4, 0.2, 0.1] {
            mix(&mut s2, ds, weight, &more_s);
            mix(&mut z2, &d.z, weight, &more.z);
            let (bp, bd) = steps(cones, st, (s, &s2), (z, &z2), share);
            let score = bp * bd;
            if found.as_ref().is_none_or(|best| score > best.score) {
                found = Some(Mix { score, weight, step: [bp, bd] });
            }
        }
        let Some(Mix { score, weight, step }) = found else { break };
        if score < *ap * *ad * (1.0 + WORTH) {
            break;
        }
        let Iterate { x, t, y, z } = d;
        for (to, by) in [(x, &more.x), (t, &more.t), (y, &more.y), (z, &more.z), (ds, &more_s)] {
            add(to, weight, by);
        }
        [*ap, *ad] = step;
    }
}

/// Some of a corrector, and how far one comes with it.
struct Mix {
    score: f64,
    weight: f64,
    step: [f64; 2],
}
