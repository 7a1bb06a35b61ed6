//! Program V: least equilibrium error.
//!
//! `min t` subject to `‖(A x + w)_i‖ ≤ t` for every free block `i`, `x` in the cones. `t` is the
//! largest out-of-balance acceleration in multiples of gravity. The program is always feasible and
//! bounded, and so is its dual, `max w·q` over admissible rates with `Σ ‖q_i‖ ≤ 1`, so it answers
//! clearly where a feasibility problem fails: near the limit.

use super::{BearingCone, Cone, ConicProgram, Positions, Statics, Unknowns};

/// What is done with the live load in program V.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LiveLoad {
    /// Left out: does the scene stand under its dead load?
    Absent,
    /// Free multiplier: does it stand under its dead load with *any* multiple of the live load?
    AnyMultiple,
    /// The live load alone, no dead load: can contact forces balance it by themselves (wedging)?
    Alone,
}

/// Builds program V; the optimal value is `t`. With [`LiveLoad::AnyMultiple`] in forces, λ is the
/// last variable.
pub fn equilibrium_error(
    statics: &Statics,
    live: LiveLoad,
    unknowns: Unknowns,
) -> (ConicProgram, Positions) {
    match statics.unknowns(unknowns) {
        Unknowns::Forces => in_forces(statics, live),
        Unknowns::Rates => in_rates(statics, live),
    }
}

fn loads(statics: &Statics, live: LiveLoad) -> &[f64] {
    if live == LiveLoad::Alone { &statics.live } else { &statics.dead }
}

fn in_forces(statics: &Statics, live: LiveLoad) -> (ConicProgram, Positions) {
    let (rows, forces) = (statics.matrix.rows, statics.matrix.columns);
    // Variables: forces, residuals r, t [, λ].
    let lambda = usize::from(live == LiveLoad::AnyMultiple);
    let mut p = ConicProgram::new(forces + rows + 1 + lambda);
    let t = forces + rows;
    p.objective[t] = 1.0;
    p.cone(Cone::Zero(rows));
    copy(&mut p, statics, 0, 0);
    for (row, w) in loads(statics, live).iter().enumerate() {
        p.matrix.push(row, forces + row, 1.0);
        p.rhs[row] = -w;
        if lambda == 1 {
            p.matrix.push(row, t + 1, statics.live[row]);
        }
    }
    left_at_most(p, statics, [forces, t])
}

/// The program with forces in their cones and what is left of every block, which stands behind the
/// `forces`, at most the unknown `t`.
pub(super) fn left_at_most(
    mut p: ConicProgram,
    statics: &Statics,
    [forces, t]: [usize; 2],
) -> (ConicProgram, Positions) {
    force_cones(&mut p, statics, 0);
    for block in &statics.free {
        let first = p.cone(Cone::SecondOrder(block.rows.len() + 1));
        p.matrix.push(first, t, -1.0);
        for (k, row) in block.rows.clone().enumerate() {
            p.matrix.push(first + 1 + k, forces + row, -1.0);
        }
    }
    let positions = Positions {
        unknowns: Unknowns::Forces,
        forces: 0,
        force_count: forces,
        rates: 0,
        rate_count: statics.matrix.rows,
    };
    (p, positions)
}

fn in_rates(statics: &Statics, live: LiveLoad) -> (ConicProgram, Positions) {
    let (rows, blocks) = (statics.matrix.rows, statics.free.len());
    // Variables: rates q, bounds τ_i ≥ ‖q_i‖.
    let mut p = ConicProgram::new(rows + blocks);
    for (row, w) in loads(statics, live).iter().enumerate() {
        p.objective[row] = -w;
    }
    if live == LiveLoad::AnyMultiple {
        let first = p.cone(Cone::Zero(1));
        for (row, l) in statics.live.iter().enumerate() {
            p.matrix.push(first, row, *l);
        }
    }
    let forces = rate_cones(&mut p, statics);
    for (block, free) in statics.free.iter().enumerate() {
        let first = p.cone(Cone::SecondOrder(free.rows.len() + 1));
        p.matrix.push(first, rows + block, -1.0);
        for (k, row) in free.rows.clone().enumerate() {
            p.matrix.push(first + 1 + k, row, -1.0);
        }
    }
    let sum = p.cone(Cone::NonNegative(1));
    for block in 0..blocks {
        p.matrix.push(sum, rows + block, 1.0);
    }
    p.rhs[sum] = 1.0;
    (
        p,
        Positions {
            unknowns: Unknowns::Rates,
            forces,
            force_count: statics.matrix.columns,
            rates: 0,
            rate_count: rows,
        },
    )
}

/// Copies the equilibrium operator to (`row`, `column`).
pub(super) fn copy(p: &mut ConicProgram, statics: &Statics, row: usize, column: usize) {
    let m = &statics.matrix;
    for k in 0..m.v.len() {
        p.matrix.push(row + m.i[k], column + m.j[k], m.v[k]);
    }
}

/// `x` in its cones, forces starting at variable `column`.
pub(super) fn force_cones(p: &mut ConicProgram, statics: &Statics, column: usize) {
    for bearing in &statics.bearings {
        bearing.rows(p, column);
    }
    for member in &statics.members {
        member.rows(p, column);
    }
    statics.section_rows(p, column);
}

/// `Aᵀ q` in the dual cones, rates starting at variable 0; row order = column order of the forces,
/// so that the multipliers are the forces. Returns the first row.
pub(super) fn rate_cones(p: &mut ConicProgram, statics: &Statics) -> usize {
    let first = p.matrix.rows;
    for bearing in &statics.bearings {
        match bearing.cone {
            BearingCone::Rays => {
                p.cone(Cone::NonNegative(bearing.basis.len()));
            }
            BearingCone::Rough => {
                p.cone(Cone::NonNegative(1));
                p.cone(Cone::Zero(bearing.basis.len() - 1));
            }
            BearingCone::Circular => {
                p.cone(Cone::SecondOrder(3));
            }
            // Programs in rates are not built where there are limits ([`Statics::unknowns`]).
            BearingCone::Limited(_) => {}
        }
    }
    let m = &statics.matrix;
    for k in 0..m.v.len() {
        p.matrix.push(first + m.j[k], m.i[k], -m.v[k]);
    }
    first
}
