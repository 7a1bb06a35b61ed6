//! All joints of an assembly stronger, or without limits.

use super::Interfaces;
use crate::assembly::JointLaw;

impl Interfaces {
    /// Whether every joint has dry friction and nothing else: then all loads and forces may be multiplied together.
    pub fn are_dry(&self) -> bool {
        self.list.iter().all(|f| f.law.friction_only())
    }

    /// The same joints with every stress of their laws multiplied.
    pub fn with_stresses(&self, by: f64) -> Self {
        let mut other = self.clone();
        for face in &mut other.list {
            face.law = face.law.with_stresses(by);
        }
        other
    }

    /// What is left of the joints for forces that may be multiplied without end: no cohesion, tension or water, and none of the
    /// joints that can crush. The second list says where each of the rest stood.
    pub fn unlimited(&self) -> (Self, Vec<usize>) {
        let kept: Vec<usize> = (0..self.list.len()).filter(|&k| !self.list[k].crushes()).collect();
        let list = kept.iter().map(|&k| {
            let mut face = self.list[k].clone();
            face.law = JointLaw { rolling_arm: face.law.rolling_arm, ..JointLaw::dry(face.law.friction) };
            face
        });
        (Self { list: list.collect(), support_pairs: self.support_pairs, findings: Vec::new() }, kept)
    }
}
