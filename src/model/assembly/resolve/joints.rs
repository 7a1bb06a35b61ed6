//! Joint specs → [`JointRules`].
//!
//! The rule: `joints.default` must say what friction acts, unless every contact is given by hand
//! with a friction of its own (then detection may still meet a pair without one, and reports it).

use super::{Names, blocks::no_material};
use crate::assembly::{JointLaw, JointRules};
use base::error::{InputError, JsonPath};
use scene::{Friction, JointSpec, Scene};
use std::collections::HashMap;

/// The joint rules of a scene.
pub(super) fn resolve(scene: &Scene, names: &Names) -> Result<JointRules, InputError> {
    let path = JsonPath::root().key("joints");
    let spec = &scene.joints.default;
    let default = law(spec, None, &path.key("default"))?;
    let by_hand =
        !scene.interfaces.is_empty() && scene.interfaces.iter().all(|i| i.friction.is_some());
    if default.is_none() && !(by_hand && spec.is_empty()) {
        return Err(InputError::at(path.key("default"), "no friction is given")
            .hint("add \"joints\": { \"default\": { \"friction\": 0.7 } }, with the coefficient of your joints or \"infinite\""));
    }
    let mut rules = JointRules { default, by_material: Vec::new(), by_blocks: HashMap::new() };
    for (i, rule) in scene.joints.overrides.iter().enumerate() {
        let path = path.key("overrides").index(i);
        if rule.spec().is_empty() {
            return Err(
                InputError::at(path, "the override sets no property").hint("add \"friction\"")
            );
        }
        let law = law(&rule.spec(), default.as_ref(), &path)?.ok_or_else(|| {
            InputError::at(path.clone(), "no friction is given here or by the default")
                .hint("add \"friction\"")
        })?;
        match (&rule.between, &rule.blocks) {
            (Some(materials), None) => {
                for (k, name) in materials.iter().enumerate() {
                    if !scene.materials.contains_key(name) {
                        return Err(no_material(scene, name, &path.key("between").index(k)));
                    }
                }
                rules.by_material.push((materials.clone(), law));
            }
            (None, Some(ids)) => {
                let (a, b) = names.pair(ids, &path.key("blocks"))?;
                rules.by_blocks.insert((a.min(b), a.max(b)), law);
            }
            (Some(_), Some(_)) => {
                return Err(InputError::at(path, "both \"between\" and \"blocks\" are given")
                    .hint(
                        "make two overrides: \"between\" names materials, \"blocks\" names blocks",
                    ));
            }
            (None, None) => {
                return Err(InputError::at(path, "the override names no joints")
                    .hint("add \"between\": [material, material] or \"blocks\": [id, id]"));
            }
        }
    }
    Ok(rules)
}

/// The law that a spec gives, what it leaves out taken from `base`. `None` where neither says what
/// friction acts.
fn law(
    spec: &JointSpec,
    base: Option<&JointLaw>,
    path: &JsonPath,
) -> Result<Option<JointLaw>, InputError> {
    let given = friction(spec.friction, spec.friction_angle_deg, path)?;
    let amount = |key: &str, value: Option<f64>, unit: &str| match value {
        Some(v) if !(v >= 0.0 && v.is_finite()) => {
            Err(InputError::at(path.key(key), format!("must be a finite number >= 0, got {v}"))
                .hint(unit))
        }
        _ => Ok(value),
    };
    let cohesion = amount("cohesion", spec.cohesion, "cohesion is in Pa: 0.1 MPa is 1e5")?;
    let tension = amount("tension", spec.tension, "tension is a strength in Pa: 0.1 MPa is 1e5")?;
    let compression =
        amount("compression", spec.compression, "compression is a strength in Pa: 5 MPa is 5e6")?;
    if compression == Some(0.0) {
        return Err(InputError::at(
            path.key("compression"),
            "must be > 0: nothing could press on such a joint",
        )
        .hint("leave it out where the stone does not crush"));
    }
    let pore_pressure = amount(
        "pore_pressure",
        spec.pore_pressure,
        "pore_pressure is in Pa: one metre of water is 9810",
    )?;
    let rolling_arm = amount("rolling_arm", spec.rolling_arm, "rolling_arm is a length in m")?;
    let stiffness = |key: &str, value: Option<f64>| {
        match value {
        Some(v) if !(v > 0.0 && v.is_finite()) => {
            Err(InputError::at(path.key(key), format!("must be a finite number > 0, got {v}"))
                .hint("stiffness is in Pa per metre (N/m³): 10 N/mm³ is 1e10; leave it out where the joint is rigid"))
        }
        _ => Ok(value),
    }
    };
    let normal_stiffness = stiffness("normal_stiffness", spec.normal_stiffness)?;
    let shear_stiffness = stiffness("shear_stiffness", spec.shear_stiffness)?;
    let Some(friction) = given.or(base.map(|b| b.friction)) else { return Ok(None) };
    let dry = JointLaw::dry(friction);
    let base = base.unwrap_or(&dry);
    Ok(Some(JointLaw {
        friction,
        cohesion: cohesion.unwrap_or(base.cohesion),
        tension: tension.unwrap_or(base.tension),
        compression: compression.unwrap_or(base.compression),
        pore_pressure: pore_pressure.unwrap_or(base.pore_pressure),
        rolling_arm: rolling_arm.unwrap_or(base.rolling_arm),
        normal_stiffness: normal_stiffness.or(base.normal_stiffness),
        shear_stiffness: shear_stiffness.or(base.shear_stiffness),
    }))
}

/// A friction given as a coefficient or as an angle.
pub(super) fn friction(
    coefficient: Option<Friction>,
    angle_deg: Option<f64>,
    path: &JsonPath,
) -> Result<Option<Friction>, InputError> {
    match (coefficient, angle_deg) {
        (None, None) => Ok(None),
        (Some(Friction::Infinite), None) => Ok(Some(Friction::Infinite)),
        (Some(Friction::Coefficient(mu)), None) => {
            if mu >= 0.0 && mu.is_finite() {
                return Ok(Some(Friction::Coefficient(mu)));
            }
            Err(InputError::at(
                path.key("friction"),
                format!("must be a finite number >= 0, got {mu}"),
            )
            .hint("write \"infinite\" for no sliding"))
        }
        (None, Some(angle)) => {
            if (0.0..90.0).contains(&angle) {
                return Ok(Some(Friction::Coefficient(angle.to_radians().tan())));
            }
            Err(InputError::at(
                path.key("friction_angle_deg"),
                format!("must be >= 0 and < 90 degrees, got {angle}"),
            )
            .hint("write \"friction\": \"infinite\" for no sliding"))
        }
        (Some(_), Some(_)) => Err(InputError::at(
            path.key("friction_angle_deg"),
            "friction and friction_angle_deg are both given",
        )
        .hint("keep one of them")),
    }
}
