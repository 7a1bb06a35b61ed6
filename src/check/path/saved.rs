//! Poses in a form that can be saved and read back: names instead of indices.

use model::assembly::{Assembly, Pose};
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// The pose of one block; blocks that are where they were are left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SavedPose {
    /// The block.
    pub block: String,
    /// The way of its centre of mass, m.
    pub shift: [f64; 3],
    /// How it has turned since the start: axis × angle, rad.
    pub turn: [f64; 3],
}

/// Poses as they are saved.
pub fn write_poses(assembly: &Assembly, poses: &[Pose]) -> Vec<SavedPose> {
    assembly
        .blocks
        .iter()
        .zip(poses)
        .filter(|(_, pose)| **pose != Pose::start())
        .map(|(block, pose)| SavedPose {
            block: block.id.clone(),
            shift: pose.shift.into(),
            turn: pose.turn.scaled_axis().into(),
        })
        .collect()
}

/// Saved poses, one for every block.
///
/// # Errors
/// A block that the scene does not have; numbers that are not finite.
pub fn read_poses(assembly: &Assembly, saved: &[SavedPose]) -> Result<Vec<Pose>, String> {
    let mut poses = vec![Pose::start(); assembly.blocks.len()];
    let index: std::collections::HashMap<&str, usize> =
        assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    for saved in saved {
        let Some(&i) = index.get(saved.block.as_str()) else {
            return Err(format!("the scene has no block {}", saved.block));
        };
        if !saved.shift.iter().chain(&saved.turn).all(|v| v.is_finite()) {
            return Err(format!("pose of {}: a number is not finite", saved.block));
        }
        poses[i] = Pose {
            shift: saved.shift.into(),
            turn: UnitQuaternion::from_scaled_axis(Vector3::from(saved.turn)),
        };
    }
    Ok(poses)
}
