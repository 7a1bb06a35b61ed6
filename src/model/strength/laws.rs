//! All joints of an assembly stronger, or without limits.

use super::crushing::crushes;
use crate::{
    assembly::{JointLaw, Member},
    interface::Interfaces,
};

/// Whether every joint has dry friction and nothing else, and no member yields or is stressed
/// beforehand: then all loads and forces may be multiplied together.
pub fn are_dry(interfaces: &Interfaces) -> bool {
    interfaces.list.iter().all(|f| f.law.friction_only())
        && interfaces.members.iter().all(|m| m.is_endless() && m.prestress == 0.0)
}

/// The same joints with every stress of their laws, and every force of a member, multiplied.
pub fn with_stresses(interfaces: &Interfaces, by: f64) -> Interfaces {
    let mut other = interfaces.clone();
    for face in &mut other.list {
        face.law = face.law.with_stresses(by);
    }
    other.members.iter_mut().for_each(|m| *m = m.times(by));
    other
}

/// What is left of the joints for forces that may be multiplied without end: no cohesion, tension
/// or water, none of the joints that can crush and none of the members that yield. The second list
/// says where each of the rest stood among the forces (`verdict::Forces`).
pub fn unlimited(interfaces: &Interfaces) -> (Interfaces, Vec<usize>) {
    let joints = interfaces.list.len();
    let mut kept: Vec<usize> = (0..joints).filter(|&k| !crushes(&interfaces.list[k])).collect();
    let list = kept.iter().map(|&k| {
        let mut face = interfaces.list[k].clone();
        face.law =
            JointLaw { rolling_arm: face.law.rolling_arm, ..JointLaw::dry(face.law.friction) };
        face
    });
    let list = list.collect();
    let endless = (0..interfaces.members.len()).filter(|&m| interfaces.members[m].is_endless());
    let endless: Vec<usize> = endless.collect();
    // What was stressed beforehand is no force that grows.
    let bare = |&m: &usize| Member { prestress: 0.0, ..interfaces.members[m].clone() };
    let members = endless.iter().map(bare).collect();
    kept.extend(endless.iter().map(|m| joints + m));
    (
        Interfaces {
            list,
            support_pairs: interfaces.support_pairs,
            members,
            ..Interfaces::default()
        },
        kept,
    )
}
