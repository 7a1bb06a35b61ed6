//! All joints of an assembly stronger, or without limits.

use super::crushing::crushes;
use crate::{assembly::JointLaw, interface::Interfaces};

/// Whether every joint has dry friction and nothing else: then all loads and forces may be
/// multiplied together.
pub fn are_dry(interfaces: &Interfaces) -> bool {
    interfaces.list.iter().all(|f| f.law.friction_only())
}

/// The same joints with every stress of their laws multiplied.
pub fn with_stresses(interfaces: &Interfaces, by: f64) -> Interfaces {
    let mut other = interfaces.clone();
    for face in &mut other.list {
        face.law = face.law.with_stresses(by);
    }
    other
}

/// What is left of the joints for forces that may be multiplied without end: no cohesion, tension
/// or water, and none of the joints that can crush. The second list says where each of the rest
/// stood.
pub fn unlimited(interfaces: &Interfaces) -> (Interfaces, Vec<usize>) {
    let kept: Vec<usize> =
        (0..interfaces.list.len()).filter(|&k| !crushes(&interfaces.list[k])).collect();
    let list = kept.iter().map(|&k| {
        let mut face = interfaces.list[k].clone();
        face.law =
            JointLaw { rolling_arm: face.law.rolling_arm, ..JointLaw::dry(face.law.friction) };
        face
    });
    (
        Interfaces {
            list: list.collect(),
            support_pairs: interfaces.support_pairs,
            ..Interfaces::default()
        },
        kept,
    )
}
