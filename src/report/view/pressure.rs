//! What presses in elastic joints, and where their blocks go: of a state under its dead load.

use base::plane::clip::inside;
use check::{
    elastic::{JointKind, Joints, law::opens},
    proof::state::StateAnswer,
    verdict::Rate,
};
use model::interface::Model;
use nalgebra::Vector3;

/// A pressed part of a joint: a convex polygon, over which pressure is linear.
#[derive(Clone, Debug)]
pub struct ViewPressure {
    /// Index of the joint.
    pub joint: usize,
    /// Its corners in order, m.
    pub points: Vec<Vector3<f64>>,
    /// Pressure at each, Pa.
    pub pressure: Vec<f64>,
}

/// Displacements of all blocks under the dead load.
pub(super) fn displaced(model: &Model, answer: &StateAnswer) -> Vec<Rate> {
    let mut all = vec![Rate::zero(); model.assembly.blocks.len()];
    for d in &answer.displacements {
        if let Some(i) = model.assembly.find(&d.block) {
            all[i] = Rate { velocity: d.displacement.into(), spin: d.rotation.into() };
        }
    }
    all
}

/// The pressed parts of all joints with an area.
pub(super) fn of(model: &Model, answer: &StateAnswer) -> Vec<ViewPressure> {
    // A scene without stiffness has no such answer.
    let Ok(joints) = Joints::new(model, answer.quadrature) else { return Vec::new() };
    let displaced = displaced(model, answer);
    let mut list = Vec::new();
    for (k, (joint, face)) in joints.list.iter().zip(&model.interfaces.list).enumerate() {
        let JointKind::Bed(bed) = &joint.kind else { continue };
        let motion = joint.motion(&model.assembly, &displaced);
        let pressure = |p: &Vector3<f64>| {
            let d = p - joint.at;
            -opens(&motion, [d.dot(&joint.frame.t1), d.dot(&joint.frame.t2)]) * bed.normal
        };
        let whole = [face.points.clone()];
        let pieces = if face.pieces.is_empty() { &whole[..] } else { &face.pieces[..] };
        for piece in pieces.iter().filter(|p| p.len() > 2) {
            let points = inside(piece, pressure, 0.0);
            if points.len() > 2 {
                let pressure = points.iter().map(|p| pressure(p).max(0.0)).collect();
                list.push(ViewPressure { joint: k, points, pressure });
            }
        }
    }
    list
}
