//! Forces of a pose near by, brought into balance where the blocks have come to: where that can be
//! done nothing has happened on the way, and no program is asked.
//!
//! Let `x` be forces inside their cones that balanced the loads before, `A` the equilibrium of the
//! blocks where they are now and `r = A x + w + λ ℓ` what is left of it. Then `x + d` balances, with
//! `d = −D Aᵀ (A D Aᵀ)⁻¹ r` for any weights `D`. These are squares of the forces, so that each
//! changes in proportion to itself (affine scaling: Dikin, Soviet Math. Dokl. 8, 1967). Where `x + d`
//! lies in the cones, forces exist; where not, nothing is said.
//!
//! A linkage has a motion that no force opposes, and `A D Aᵀ` is singular along it; at the load
//! factor of the linkage `r` has no power on that motion, so that a small shift of the diagonal
//! changes nothing but how often is corrected.

use super::program::Margin;
use cholesky::{Cholesky, Pattern};
use model::interface::Model;
use solve::program::{self, BearingCone, Statics, StaticsOptions};

/// Corrections at most. Each leaves a small part of what was there.
const ROUNDS: usize = 6;
/// What is left of the loads of a block counts as balance below this, g. Larger: what drifts from
/// step to step passes for equilibrium. Smaller: rounding is taken for none.
const BALANCED: f64 = 1e-11;
/// The shift of the diagonal, which is one. Larger: more corrections. Smaller: rounding makes a
/// singular matrix indefinite.
const SHIFT: f64 = 1e-11;

/// Forces next to those of a pose near by, which had the same contacts, that balance a scene in
/// their cones, and room that they leave at least; nothing where these do not, or where joints or
/// members have limits of their own. `load_factor`: where there is a live load.
pub(super) fn rebalanced(model: &Model, near: &Margin, load_factor: Option<f64>) -> Option<Margin> {
    let options = StaticsOptions { live: load_factor.is_some(), ..StaticsOptions::default() };
    let statics = Statics::new(model, options);
    let limited = statics.bearings.iter().any(|b| b.limits().is_some());
    if limited || !statics.members.is_empty() || near.columns.len() != statics.matrix.columns {
        return None;
    }
    let mut x = near.columns.clone();
    let weights = weights(&statics, &x);
    let lambda = load_factor.unwrap_or(0.0);
    let left = |x: &[f64]| -> Vec<f64> {
        let loads = statics.dead.iter().zip(&statics.live);
        let mut left: Vec<f64> = loads.map(|(dead, live)| dead + lambda * live).collect();
        statics.matrix.multiply_add(1.0, x, &mut left);
        left
    };
    let size = |r: &[f64]| r.iter().fold(0.0, |a: f64, v| a.max(v.abs()));
    let mut weighed = Weighed::new(&statics, &weights)?;
    let mut r = left(&x);
    for _ in 0..ROUNDS {
        if size(&r) <= 0.1 * BALANCED {
            break;
        }
        weighed.solve(&mut r);
        let mut along = vec![0.0; x.len()];
        let m = &statics.matrix;
        for k in 0..m.v.len() {
            along[m.j[k]] += m.v[k] * r[m.i[k]];
        }
        x.iter_mut().zip(along).zip(&weights).for_each(|((x, y), d)| *x -= d * y);
        r = left(&x);
    }
    // What is no number is no balance.
    let balanced = size(&r) <= BALANCED && x.iter().all(|v| v.is_finite());
    let pressed = program::pressed(&statics, &model.interfaces);
    let room = room(&statics, &x, &pressed);
    (balanced && room >= 0.0).then(|| {
        let bare: Vec<f64> = x.iter().zip(&pressed).map(|(x, p)| x - room * p).collect();
        Margin {
            room,
            forces: statics.forces(&model.interfaces, &x),
            bare: statics.forces(&model.interfaces, &bare),
            columns: x,
        }
    })
}

/// The squares of how far forces may change.
fn weights(statics: &Statics, x: &[f64]) -> Vec<f64> {
    let mut weights = vec![0.0; x.len()];
    for b in &statics.bearings {
        let own = b.column..b.column + b.basis.len();
        let (x, d) = (&x[own.clone()], &mut weights[own]);
        let across = x[1..].iter().map(|t| t * t).sum::<f64>();
        match b.cone {
            BearingCone::Rays => d.iter_mut().zip(x).for_each(|(d, x)| *d = x.max(0.0).powi(2)),
            BearingCone::Rough => {
                d.fill(x[0].max(0.0).powi(2) + across);
                d[0] = x[0].max(0.0).powi(2);
            }
            BearingCone::Circular => d.fill((x[0] - across.sqrt()).max(0.0).powi(2)),
            BearingCone::Limited(_) => {}
        }
    }
    weights
}

/// By how much of the mean load of a point every point may be pressed less; < 0 outside the cones.
fn room(statics: &Statics, x: &[f64], pressed: &[f64]) -> f64 {
    let of = |b: &program::Bearing| {
        let own = b.column..b.column + b.basis.len();
        let (x, p) = (&x[own.clone()], &pressed[own]);
        match b.cone {
            BearingCone::Rays => x.iter().zip(p).map(|(x, p)| x / p).fold(f64::INFINITY, f64::min),
            BearingCone::Rough => x[0] / p[0],
            BearingCone::Circular => (x[0] - x[1].hypot(x[2])) / p[0],
            BearingCone::Limited(_) => f64::NEG_INFINITY,
        }
    };
    statics.bearings.iter().map(of).fold(f64::INFINITY, f64::min)
}

/// `A D Aᵀ` with its diagonal brought to one, and its factors.
struct Weighed {
    scale: Vec<f64>,
    factors: Cholesky,
}

impl Weighed {
    fn new(statics: &Statics, weights: &[f64]) -> Option<Self> {
        let m = &statics.matrix;
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); m.columns];
        (0..m.v.len()).for_each(|k| columns[m.j[k]].push((m.i[k], m.v[k])));
        let mut entries: Vec<(usize, usize, f64)> = Vec::new();
        let mut scale = vec![0.0; m.rows];
        for (column, weight) in columns.iter().zip(weights) {
            for &(i, a) in column {
                scale[i] += weight * a * a;
                let below = column.iter().filter(|(j, _)| *j >= i);
                entries.extend(below.map(|&(j, b)| (i, j, weight * a * b)));
            }
        }
        scale.iter_mut().for_each(|d| *d = 1.0 / d.sqrt());
        if scale.iter().any(|t| !t.is_finite()) {
            return None;
        }
        entries.sort_unstable_by_key(|e| (e.0, e.1));
        let mut pattern = Pattern { starts: vec![0], rows: Vec::new() };
        let mut values: Vec<f64> = Vec::new();
        let mut last = None;
        for (i, j, v) in entries {
            if last != Some((i, j)) {
                // Every row has a diagonal entry: no column is empty.
                if last.is_none_or(|(before, _)| before != i) && i > 0 {
                    pattern.starts.push(pattern.rows.len());
                }
                pattern.rows.push(j);
                values.push(if i == j { SHIFT } else { 0.0 });
                last = Some((i, j));
            }
            if let Some(value) = values.last_mut() {
                *value += v * scale[i] * scale[j];
            }
        }
        pattern.starts.push(pattern.rows.len());
        let mut factors = Cholesky::new(pattern)?;
        factors.factorize(&values).then_some(Self { scale, factors })
    }

    /// `(A D Aᵀ)⁻¹ r` in place of `r`.
    fn solve(&mut self, r: &mut [f64]) {
        r.iter_mut().zip(&self.scale).for_each(|(r, t)| *r *= t);
        self.factors.solve(r);
        r.iter_mut().zip(&self.scale).for_each(|(r, t)| *r *= t);
    }
}
