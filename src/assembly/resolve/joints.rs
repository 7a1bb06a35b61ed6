//! Joint specs → [`JointRules`].
//!
//! The rule: `joints.default` must say what friction acts, unless every contact is given by hand with a friction of its own
//! (then detection may still meet a pair without one, and reports it).

use super::{Names, blocks::no_material};
use crate::{
    assembly::JointRules,
    error::{InputError, JsonPath},
    scene::{Friction, Scene},
};
use std::collections::HashMap;

/// The friction rules of a scene.
pub(super) fn resolve(scene: &Scene, names: &Names) -> Result<JointRules, InputError> {
    let path = JsonPath::root().key("joints");
    let spec = &scene.joints.default;
    let default = friction(spec.friction, spec.friction_angle_deg, &path.key("default"))?;
    let by_hand = !scene.interfaces.is_empty() && scene.interfaces.iter().all(|i| i.friction.is_some());
    if default.is_none() && !by_hand {
        return Err(InputError::at(path.key("default"), "no friction is given")
            .hint("add \"joints\": { \"default\": { \"friction\": 0.7 } }, with the coefficient of your joints or \"infinite\""));
    }
    let mut rules = JointRules { default, by_material: Vec::new(), by_blocks: HashMap::new() };
    for (i, rule) in scene.joints.overrides.iter().enumerate() {
        let path = path.key("overrides").index(i);
        let friction = friction(rule.friction, rule.friction_angle_deg, &path)?
            .ok_or_else(|| InputError::at(path.clone(), "the exception says nothing").hint("add \"friction\""))?;
        match (&rule.between, &rule.blocks) {
            (Some(materials), None) => {
                for (k, name) in materials.iter().enumerate() {
                    if !scene.materials.contains_key(name) {
                        return Err(no_material(scene, name, &path.key("between").index(k)));
                    }
                }
                rules.by_material.push((materials.clone(), friction));
            }
            (None, Some(ids)) => {
                let (a, b) = names.pair(ids, &path.key("blocks"))?;
                rules.by_blocks.insert((a.min(b), a.max(b)), friction);
            }
            (Some(_), Some(_)) => {
                return Err(InputError::at(path, "both \"between\" and \"blocks\" are given")
                    .hint("make two exceptions: \"between\" names materials, \"blocks\" names blocks"));
            }
            (None, None) => {
                return Err(InputError::at(path, "it is not said where the exception holds")
                    .hint("add \"between\": [material, material] or \"blocks\": [id, id]"));
            }
        }
    }
    Ok(rules)
}

/// A friction given as a coefficient or as an angle.
pub(super) fn friction(coefficient: Option<Friction>, angle_deg: Option<f64>, path: &JsonPath) -> Result<Option<Friction>, InputError> {
    match (coefficient, angle_deg) {
        (None, None) => Ok(None),
        (Some(Friction::Infinite), None) => Ok(Some(Friction::Infinite)),
        (Some(Friction::Coefficient(mu)), None) => {
            if mu >= 0.0 && mu.is_finite() {
                return Ok(Some(Friction::Coefficient(mu)));
            }
            Err(InputError::at(path.key("friction"), format!("must be a finite number >= 0, got {mu}"))
                .hint("write \"infinite\" for no sliding"))
        }
        (None, Some(angle)) => {
            if (0.0..90.0).contains(&angle) {
                return Ok(Some(Friction::Coefficient(angle.to_radians().tan())));
            }
            Err(InputError::at(path.key("friction_angle_deg"), format!("must be >= 0 and < 90 degrees, got {angle}"))
                .hint("write \"friction\": \"infinite\" for no sliding"))
        }
        (Some(_), Some(_)) => {
            Err(InputError::at(path.key("friction_angle_deg"), "friction and friction_angle_deg are both given").hint("keep one of them"))
        }
    }
}
