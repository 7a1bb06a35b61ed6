//! The least motion that opens every contact.
//!
//! `min ½ ‖q‖²` subject to `Aᵀ q − e ∈ K*`, with `e` a unit of opening at every contact. Where
//! there is none, forces in the cones balance without a load (Gordan's alternative). In forces it is
//! `min ½ ‖q‖² − eᵀ f` subject to `q = A f`, `f ∈ K`.

use super::{
    BearingCone, Cone, ConicProgram, Statics, Unknowns,
    equilibrium_error::{copy, force_cones, rate_cones},
};

/// Builds the program, and tells where its motion begins; `None` where joints have strengths or exclude
/// sliding.
pub fn opening(statics: &Statics, unknowns: Unknowns) -> Option<(ConicProgram, usize)> {
    if statics
        .bearings
        .iter()
        .any(|b| matches!(b.cone, BearingCone::Limited(_) | BearingCone::Rough))
    {
        return None;
    }
    Some(match unknowns {
        Unknowns::Forces => (in_forces(statics), statics.matrix.columns),
        Unknowns::Rates => (in_rates(statics), 0),
    })
}

/// Each row of the cones and the opening that it is asked for. Columns carry a force unit, and with
/// them the rows here.
fn asked(statics: &Statics) -> impl Iterator<Item = (usize, f64)> + '_ {
    statics.bearings.iter().flat_map(|bearing| {
        let count = if bearing.cone == BearingCone::Circular { 1 } else { bearing.basis.len() };
        (0..count).map(|k| (bearing.column + k, bearing.unit / statics.unit))
    })
}

fn in_forces(statics: &Statics) -> ConicProgram {
    let (rows, forces) = (statics.matrix.rows, statics.matrix.columns);
    let mut p = ConicProgram::new(forces + rows);
    p.quadratic = vec![0.0; forces];
    p.quadratic.resize(forces + rows, 1.0);
    p.cone(Cone::Zero(rows));
    copy(&mut p, statics, 0, 0);
    (0..rows).for_each(|row| p.matrix.push(row, forces + row, -1.0));
    force_cones(&mut p, statics, 0);
    asked(statics).for_each(|(column, opening)| p.objective[column] = -opening);
    p
}

fn in_rates(statics: &Statics) -> ConicProgram {
    let mut p = ConicProgram::new(statics.matrix.rows);
    p.quadratic = vec![1.0; statics.matrix.rows];
    let first = rate_cones(&mut p, statics);
    asked(statics).for_each(|(row, opening)| p.rhs[first + row] = -opening);
    p
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EngineSettings, Settings, program::StaticsOptions, solve};
    use model::interface::prepare;

    /// In forces, by either engine, the motion is that of the program in rates.
    #[test]
    fn forces_and_rates_give_one_motion() {
        let text = r#"{"format": "voussoir-scene/1", "joints": {"default": {"friction": 0.6}},
            "templates": [{"wall": {"size": [1, 0.5, 0.4], "courses": 3, "blocks": 3}}]}"#;
        let scene = scene::read_str("wall", text.to_string()).unwrap().0;
        let statics = Statics::new(&prepare(&scene).unwrap(), StaticsOptions::default());
        let motion = |unknowns, engine| {
            let (program, first) = opening(&statics, unknowns).unwrap();
            let settings = Settings { engine, tolerance: 1e-8, ..Settings::default() };
            solve(&program, &settings).x[first..first + statics.matrix.rows].to_vec()
        };
        let rates = motion(Unknowns::Rates, EngineSettings::default());
        let largest = rates.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        assert!(largest > 0.0);
        for engine in [EngineSettings::default(), EngineSettings::Interior] {
            for (a, b) in motion(Unknowns::Forces, engine).iter().zip(&rates) {
                assert!((a - b).abs() < 1e-5 * largest, "{engine:?}: {a} instead of {b}");
            }
        }
    }
}
