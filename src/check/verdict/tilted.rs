//! A model at a tilt.
//!
//! Tilting the ground by θ towards a horizontal direction `d` turns gravity to `g (cos θ ẑ↓ + sin θ
//! d)`; forces scale, so `tan θ` is the load factor of the live load "own weight along d", the
//! vertical load kept. Dead loads on blocks are taken as hanging weights: they must act along
//! gravity, and turn with it. Stresses do not turn: all forces are divided by cos θ, and joints are
//! `√(1 + tan² θ)` times as strong.

use base::{error::InputError, tolerance};
use model::{
    assembly::{AppliedForce, Assembly, Wrench},
    interface::{Interfaces, Model},
    strength::laws::{are_dry, with_stresses},
};
use nalgebra::Vector3;

/// A direction is of unit length and across gravity up to this. Smaller: less than rounding leaves
/// of one. Larger: an angle is read with fewer digits than it was given.
const UNIT: f64 = 16.0 * f64::EPSILON;

/// The assembly with "own weight (and hanging dead loads) towards `toward`" as its only live load.
///
/// # Errors
/// `toward` is parallel to gravity, or a dead load does not act along gravity.
pub fn turned(
    assembly: &Assembly,
    toward: Vector3<f64>,
) -> Result<(Assembly, Vector3<f64>), InputError> {
    let down = assembly.gravity.normalize();
    let horizontal = toward - down * down.dot(&toward);
    let across = horizontal.norm() / toward.norm();
    if across.is_nan() || across <= tolerance::ALONG {
        return Err(InputError::at(
            Default::default(),
            format!("cannot tilt towards {:?}: it is parallel to gravity", toward.as_slice()),
        )
        .hint("give a direction across gravity, such as 1,0,0"));
    }
    let d = direction(down, toward);
    let mut turned = assembly.clone();
    let mut moments: Vec<Vector3<f64>> = assembly.dead.iter().map(|w| w.moment).collect();
    for applied in &assembly.dead_forces {
        moments[applied.block] -= applied.arm.cross(&applied.force);
    }
    for i in assembly.free() {
        let Wrench { force, moment } = assembly.dead[i];
        let along = down.dot(&force);
        let across = (force - down * along).norm();
        if across > tolerance::ALONG * force.norm()
            || moments[i].norm()
                > tolerance::ALONG * (moment.norm() + force.norm() * assembly.blocks[i].size)
        {
            return Err(InputError::at(
                Default::default(),
                format!("tilting rotates dead loads with gravity, but the dead load on {:?} is not a weight along gravity", assembly.blocks[i].id),
            )
            .hint("give it as a force along gravity, or ask `limit` with the tilting force as a live load"));
        }
        turned.live[i] = Wrench { force: d * along, moment: Vector3::zeros() };
    }
    let level =
        |applied: &AppliedForce| AppliedForce { force: d * down.dot(&applied.force), ..*applied };
    turned.live_forces = assembly.dead_forces.iter().map(level).collect();
    for applied in &turned.live_forces {
        turned.live[applied.block].moment += applied.arm.cross(&applied.force);
    }
    Ok((turned, d))
}

/// The unit direction across `down` that `toward` points to; what comes out of this comes out of it
/// unchanged, so that an answer and its check speak of the same loads to the last digit.
pub fn direction(down: Vector3<f64>, toward: Vector3<f64>) -> Vector3<f64> {
    let across = |d: Vector3<f64>| unit(d - down * down.dot(&d));
    // The first leaves rounding of what `toward` has along gravity.
    if down.dot(&unit(toward)).abs() <= UNIT { unit(toward) } else { across(across(toward)) }
}

/// The unit vector along another one; what is of unit length already stays as it is.
pub fn unit(v: Vector3<f64>) -> Vector3<f64> {
    if (v.norm_squared() - 1.0).abs() <= UNIT { v } else { v.normalize() }
}

/// The model as it is at the tilt `tan θ = load_factor` (level where there is none): its live load
/// turns it further, and its forces are divided by cos θ.
///
/// # Errors
/// As [`turned`].
pub fn tilted(
    model: &Model,
    toward: Vector3<f64>,
    load_factor: Option<f64>,
) -> Result<Model, InputError> {
    let (assembly, _) = turned(&model.assembly, toward)?;
    Ok(Model {
        assembly,
        interfaces: stressed(&model.interfaces, load_factor.unwrap_or(0.0)),
        timings: model.timings,
    })
}

/// The joints where all forces are divided by cos θ.
pub fn stressed(interfaces: &Interfaces, load_factor: f64) -> Interfaces {
    let by = 1f64.hypot(load_factor);
    if are_dry(interfaces) { interfaces.clone() } else { with_stresses(interfaces, by) }
}

/// Why a scene without a live load has no tilt at which it falls; nothing where it has one, or has
/// a live load.
pub fn no_tilt(model: &Model) -> Option<String> {
    let assembly = &model.assembly;
    if assembly.live.iter().any(|w| *w != Wrench::zero()) {
        return None;
    }
    let down = assembly.gravity.normalize();
    let across = [Vector3::x(), Vector3::y()].map(|axis| axis - down * down.dot(&axis));
    let [x, y] = across;
    let toward = if x.norm() > y.norm() { x } else { y };
    tilted(model, toward.normalize(), None).err().map(|e| e.message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Along any gravity: across it, of unit length, and itself when it is given again.
        #[test]
        fn a_direction_is_its_own(
            [a, b, c] in prop::array::uniform3(-1.0_f64..1.0),
            [x, y, z] in prop::array::uniform3(-1e3_f64..1e3),
            lean in 0.0_f64..1.0,
        ) {
            let down = Vector3::new(a, b, c);
            prop_assume!(down.norm() > 0.1);
            let down = down.normalize();
            let toward = down * (x.hypot(y) + z) + lean * Vector3::new(x, y, z);
            let across = (toward - down * down.dot(&toward)).norm() / toward.norm();
            prop_assume!(across > tolerance::ALONG);
            let d = direction(down, toward);
            prop_assert!(down.dot(&d).abs() <= UNIT && (d.norm() - 1.0).abs() <= UNIT);
            prop_assert_eq!(direction(down, d), d);
        }
    }
}
