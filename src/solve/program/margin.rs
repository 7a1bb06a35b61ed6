//! How much the least pressed contact may lose: a number that goes through zero where forces cease
//! to exist, not one that stops there.

use super::{
    Bearing, BearingCone, Cone, ConicProgram, Positions, Statics, Unknowns,
    equilibrium_error::{copy, force_cones},
};
use model::interface::Interfaces;

/// Builds `max t ≤ 1` subject to `A (x + t p) + w + λ ℓ = 0`, `x` in the cones, where `p` presses
/// every contact point with the mean load of one; with `live`, λ is any number, else it is zero.
/// Variables: `x`, `t`, λ. Forces exist where `t ≥ 0`; they are `x + t p`, and the second value is
/// `p`. Where an edge of a joint is about to open, or a joint to slide, `t` goes through zero with a
/// slope of its own, so that the place is found by few solves.
pub fn margin(
    statics: &Statics,
    interfaces: &Interfaces,
    live: bool,
) -> (ConicProgram, Positions, Vec<f64>) {
    let (rows, forces) = (statics.matrix.rows, statics.matrix.columns);
    let pressed = pressed(statics, interfaces);
    let mut p = ConicProgram::new(forces + 1 + usize::from(live));
    p.objective[forces] = -1.0;
    p.cone(Cone::Zero(rows));
    copy(&mut p, statics, 0, 0);
    let mut press = vec![0.0; rows];
    let m = &statics.matrix;
    for k in 0..m.v.len() {
        press[m.i[k]] += m.v[k] * pressed[m.j[k]];
    }
    for (row, press) in press.into_iter().enumerate() {
        p.matrix.push(row, forces, press);
        p.rhs[row] = -statics.dead[row];
        if live {
            p.matrix.push(row, forces + 1, statics.live[row]);
        }
    }
    force_cones(&mut p, statics, 0);
    let cap = p.cone(Cone::NonNegative(1));
    p.matrix.push(cap, forces, 1.0);
    p.rhs[cap] = 1.0;
    let layout = Positions {
        unknowns: Unknowns::Forces,
        forces: 0,
        force_count: forces,
        rates: 0,
        rate_count: rows,
    };
    (p, layout, pressed)
}

/// The columns that press every contact point with the mean load of one.
pub fn pressed(statics: &Statics, interfaces: &Interfaces) -> Vec<f64> {
    let mean = statics.total_load() / statics.bearings.len().max(1) as f64;
    let mut columns = vec![0.0; statics.matrix.columns];
    for bearing in &statics.bearings {
        let Bearing { column, basis, cone, unit, .. } = bearing;
        let n = interfaces.list[bearing.interface].frame.n;
        // Edges of a cone press together; otherwise the first column is the normal force.
        let edges = if *cone == BearingCone::Rays { basis.len() } else { 1 };
        let normal: f64 = basis[..edges].iter().map(|b| b.force.dot(&n)).sum();
        columns[*column..column + edges].fill(mean / (unit * normal));
    }
    columns
}
