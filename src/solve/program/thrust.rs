//! Program T: least and greatest thrust.
//!
//! `min ± c·x` subject to `A x + w = 0`, `x` in the cones, with `c·x` the component of the force on
//! a support along a direction. Its dual moves the support along that direction at unit rate, out
//! (least) or in (greatest), and lets the blocks follow by an admissible mechanism: the two
//! limiting states of an arch whose abutments give way (Heyman 1966).

use super::{
    BearingCone, Cone, ConicProgram, Positions, Statics, Unknowns,
    equilibrium_error::{copy, force_cones, left_at_most},
};
use check::verdict::{Rate, member};
use model::interface::{Interfaces, Model};
use nalgebra::Vector3;

/// Thrust per unit of every column, N: the component along `direction` of the force on `support`.
pub fn thrust_columns(
    statics: &Statics,
    interfaces: &Interfaces,
    support: usize,
    direction: Vector3<f64>,
) -> Vec<f64> {
    let mut columns = vec![0.0; statics.matrix.columns];
    for bearing in &statics.bearings {
        let face = &interfaces.list[bearing.interface];
        let sign = f64::from(u8::from(face.b == support)) - f64::from(u8::from(face.a == support));
        for (k, basis) in bearing.basis.iter().enumerate() {
            columns[bearing.column + k] = sign * bearing.unit * direction.dot(&basis.force);
        }
    }
    for member in &statics.members {
        // Columns know free blocks only: what a member does to a support is read off itself.
        let Some(force) = member.on(&interfaces.members[member.member], support) else { continue };
        columns[member.column] = member.unit * direction.dot(&force);
    }
    columns
}

/// Force in one member per unit of every column, N: the sum of its amounts by these shares.
pub fn member_columns(statics: &Statics, member: usize, shares: &Vector3<f64>) -> Vec<f64> {
    let mut columns = vec![0.0; statics.matrix.columns];
    for own in statics.members.iter().filter(|own| own.member == member) {
        for (k, (axis, sign)) in own.amounts.iter().enumerate() {
            columns[own.column + k] = sign * own.unit * shares[*axis];
        }
    }
    columns
}

/// Power per unit of every column, W, of the forces on supports that move at these rates (of all
/// blocks; those of free blocks do not count).
pub fn reaction_columns(statics: &Statics, model: &Model, rates: &[Rate]) -> Vec<f64> {
    let Model { assembly, interfaces, .. } = model;
    let mut columns = vec![0.0; statics.matrix.columns];
    for bearing in &statics.bearings {
        let face = &interfaces.list[bearing.interface];
        let point = 0.5 * (face.points[bearing.points[0]] + face.points[bearing.points[1]]);
        for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
            if !assembly.blocks[block].support {
                continue;
            }
            let velocity = check::verdict::at(assembly, rates, block, &point);
            for (k, basis) in bearing.basis.iter().enumerate() {
                let power = basis.force.dot(&velocity) + basis.moment.dot(&rates[block].spin);
                columns[bearing.column + k] += sign * bearing.unit * power;
            }
        }
    }
    let supports: Vec<Rate> = rates
        .iter()
        .zip(&assembly.blocks)
        .map(|(rate, block)| if block.support { *rate } else { Rate::zero() })
        .collect();
    for own in &statics.members {
        let power = member::power(assembly, &interfaces.members[own.member], &supports);
        for (k, (axis, sign)) in own.amounts.iter().enumerate() {
            columns[own.column + k] = own.unit * sign * power[*axis];
        }
    }
    columns
}

/// Builds program T with the objective `objective · x`.
pub fn thrust(statics: &Statics, objective: &[f64]) -> (ConicProgram, Positions) {
    let (rows, forces) = (statics.matrix.rows, statics.matrix.columns);
    let mut p = ConicProgram::new(forces);
    p.objective.copy_from_slice(objective);
    p.cone(Cone::Zero(rows));
    copy(&mut p, statics, 0, 0);
    for (row, w) in statics.dead.iter().enumerate() {
        p.rhs[row] = -w;
    }
    force_cones(&mut p, statics, 0);
    (
        p,
        Positions {
            unknowns: Unknowns::Forces,
            forces: 0,
            force_count: forces,
            rates: 0,
            rate_count: rows,
        },
    )
}

/// Program T under a live load: `min c·x − ω λ'` subject to `A x + w + s λ' ℓ = 0`, `x` in the cones,
/// with `λ = s λ'` the last variable. Its multipliers are rates with a live power of `ω / s`: where
/// `ω > 0` is small beside `c` the live load drives them.
pub fn pushed(
    statics: &Statics,
    objective: &[f64],
    live_scale: f64,
    omega: f64,
) -> (ConicProgram, Positions) {
    let (p, layout) = thrust(statics, objective);
    (with_live(p, statics, live_scale, omega), layout)
}

/// The program with a multiple of the live load, free, as its last variable.
fn with_live(mut p: ConicProgram, statics: &Statics, scale: f64, omega: f64) -> ConicProgram {
    let column = p.objective.len();
    p.objective.push(-omega);
    if !p.quadratic.is_empty() {
        p.quadratic.push(0.0);
    }
    p.matrix.columns += 1;
    for (row, l) in statics.live.iter().enumerate() {
        p.matrix.push(row, column, scale * l);
    }
    p
}

/// `min c·x + ½ δ x·x` subject to `A x + w = 0` with `x` free where contact points are `active`, no
/// shear where they are `sliding`, and zero elsewhere: its multipliers close the gaps `c` of the
/// active contacts as least squares do, whatever their signs. With a `drive` (scale `s` and `ω`) a
/// free multiple of the live load is among the forces, as in [`pushed`].
pub fn closing(
    statics: &Statics,
    objective: &[f64],
    active: &[bool],
    sliding: &[bool],
    drive: Option<(f64, f64)>,
) -> (ConicProgram, Positions) {
    /// Larger: gaps stay open by this × the way of a step. Smaller: where contacts say the same twice
    /// the engine finds no solution.
    const DELTA: f64 = 1e-9;
    let (rows, forces) = (statics.matrix.rows, statics.matrix.columns);
    let mut p = ConicProgram::new(forces);
    p.objective.copy_from_slice(objective);
    p.quadratic = vec![DELTA; forces];
    p.cone(Cone::Zero(rows));
    copy(&mut p, statics, 0, 0);
    for (row, w) in statics.dead.iter().enumerate() {
        p.rhs[row] = -w;
    }
    for (bearing, (active, sliding)) in statics.bearings.iter().zip(active.iter().zip(sliding)) {
        let columns = bearing.column..bearing.column + bearing.basis.len();
        if !active {
            let first = p.cone(Cone::Zero(columns.len()));
            for (k, column) in columns.enumerate() {
                p.objective[column] = 0.0;
                p.matrix.push(first + k, column, 1.0);
            }
        } else if *sliding && bearing.cone == BearingCone::Rays && columns.len() == 2 {
            // Both edges alike: a normal force.
            let first = p.cone(Cone::Zero(1));
            p.matrix.push(first, columns.start, 1.0);
            p.matrix.push(first, columns.start + 1, -1.0);
        } else if *sliding {
            let first = p.cone(Cone::Zero(columns.len() - 1));
            for (k, column) in columns.skip(1).enumerate() {
                p.matrix.push(first + k, column, 1.0);
            }
        }
    }
    let layout = Positions {
        unknowns: Unknowns::Forces,
        forces: 0,
        force_count: forces,
        rates: 0,
        rate_count: rows,
    };
    match drive {
        Some((scale, omega)) => (with_live(p, statics, scale, omega), layout),
        None => (p, layout),
    }
}

/// Can the thrust grow without end? Forces that balance by themselves with `objective · x = −1`, or
/// what they leave: `min t`, `‖(A x)_i‖ ≤ t` per block.
pub fn endless_thrust(statics: &Statics, objective: &[f64]) -> (ConicProgram, Positions) {
    let (rows, forces) = (statics.matrix.rows, statics.matrix.columns);
    let t = forces + rows;
    let mut p = ConicProgram::new(t + 1);
    p.objective[t] = 1.0;
    p.cone(Cone::Zero(rows));
    copy(&mut p, statics, 0, 0);
    for row in 0..rows {
        p.matrix.push(row, forces + row, 1.0);
    }
    let grows = p.cone(Cone::Zero(1));
    for (j, c) in objective.iter().enumerate() {
        p.matrix.push(grows, j, *c);
    }
    p.rhs[grows] = -1.0;
    left_at_most(p, statics, [forces, t])
}
