//! Program L: the greatest load factor.
//!
//! `max λ` subject to `A x + w + λ ℓ = 0`, `x` in the cones; or its dual, `min −w·q` over
//! admissible rates with `ℓ·q = 1` (the kinematic theorem of limit analysis: Drucker, Prager &
//! Greenberg 1952; for masonry Livesley 1978).

use super::{
    Cone, ConicProgram, Positions, Statics, Unknowns,
    equilibrium_error::{copy, force_cones, rate_cones},
};

/// Builds program L with the live load multiplied by `live_scale`; the optimal value is `−λ /
/// live_scale` in forces and `λ / live_scale` in rates.
pub fn load_factor(
    statics: &Statics,
    live_scale: f64,
    unknowns: Unknowns,
) -> (ConicProgram, Positions) {
    let (rows, forces) = (statics.matrix.rows, statics.matrix.columns);
    let unknowns = statics.unknowns(unknowns);
    match unknowns {
        Unknowns::Forces => {
            let mut p = ConicProgram::new(forces + 1);
            p.objective[forces] = -1.0;
            p.cone(Cone::Zero(rows));
            copy(&mut p, statics, 0, 0);
            for row in 0..rows {
                p.matrix.push(row, forces, live_scale * statics.live[row]);
                p.rhs[row] = -statics.dead[row];
            }
            force_cones(&mut p, statics, 0);
            (p, Positions { unknowns, forces: 0, force_count: forces, rates: 0, rate_count: rows })
        }
        Unknowns::Rates => {
            let mut p = ConicProgram::new(rows);
            for (row, w) in statics.dead.iter().enumerate() {
                p.objective[row] = -w;
            }
            let power = p.cone(Cone::Zero(1));
            p.rhs[power] = 1.0;
            for (row, l) in statics.live.iter().enumerate() {
                p.matrix.push(power, row, live_scale * l);
            }
            let first = rate_cones(&mut p, statics);
            (
                p,
                Positions {
                    unknowns,
                    forces: first,
                    force_count: forces,
                    rates: 0,
                    rate_count: rows,
                },
            )
        }
    }
}
