//! The least motion that opens every contact.
//!
//! `min ½ ‖q‖²` subject to `Aᵀ q − e ∈ K*`, with `e` a unit of opening at every contact. Where
//! there is none, forces in the cones balance without a load (Gordan's alternative).

use super::{BearingCone, ConicProgram, Statics, unbalance::rate_cones};

/// Builds the program; `None` where joints have strengths, for which only programs in forces exist,
/// or exclude sliding.
pub fn opening(statics: &Statics) -> Option<ConicProgram> {
    if statics
        .bearings
        .iter()
        .any(|b| matches!(b.cone, BearingCone::Limited(_) | BearingCone::Rough))
    {
        return None;
    }
    let mut p = ConicProgram::new(statics.matrix.rows);
    p.quadratic = vec![1.0; statics.matrix.rows];
    let first = rate_cones(&mut p, statics);
    for bearing in &statics.bearings {
        // Columns carry a force unit, and with them the rows here.
        let row = first + bearing.column;
        let unit = bearing.unit / statics.unit;
        match bearing.cone {
            BearingCone::Circular => p.rhs[row] = -unit,
            _ => (0..bearing.basis.len()).for_each(|k| p.rhs[row + k] = -unit),
        }
    }
    Some(p)
}
