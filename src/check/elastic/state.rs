//! The state of all joints: what they remember, and what they do at the next displacements.

use super::{
    bed, grain,
    joints::{JointKind, Joints, Past},
    law::{Friction, Spot},
    member::{Pull, amount},
};
use crate::verdict::{Forces, Rate, no_forces};
use model::interface::Model;
use nalgebra::{Matrix2, Vector2, Vector3};

/// Displacements of all blocks, and what their joints remember.
#[derive(Clone, Debug)]
pub struct ElasticState {
    /// Displacement of the centre of mass (m) and small rotation (rad) of every block.
    pub displaced: Vec<Rate>,
    /// One a joint.
    pub past: Vec<Past>,
    /// For each member how much longer it is for good, m.
    pub eases: Vec<f64>,
}

/// What all joints and members do.
#[derive(Clone, Debug)]
pub struct States {
    /// One a joint.
    pub joints: Vec<JointState>,
    /// One a member.
    pub members: Vec<Pull>,
}

/// What a joint does.
#[derive(Clone, Debug)]
pub struct JointState {
    /// Relative displacement of its second block, in its frame.
    pub motion: [f64; 6],
    /// Its pressed points.
    pub spots: Vec<Spot>,
    /// Force on its second block, N.
    pub force: Vector3<f64>,
    /// Moment of it about the joint's place, N·m.
    pub moment: Vector3<f64>,
    /// Least and greatest opening of its corners, m.
    pub opening: [f64; 2],
}

impl ElasticState {
    /// Nothing has moved, nothing presses.
    pub fn start(model: &Model, joints: &Joints) -> Self {
        let past = joints.list.iter().map(|j| match j.kind {
            JointKind::Bed(_) => Past::Bed(bed::Past::default()),
            JointKind::Grain(_) => Past::Grain(grain::Past::default()),
        });
        Self {
            displaced: vec![Rate::zero(); model.assembly.blocks.len()],
            past: past.collect(),
            eases: vec![0.0; joints.lines.len()],
        }
    }

    /// What every member does at these displacements.
    pub fn pulls(&self, joints: &Joints, displaced: &[Rate]) -> Vec<Pull> {
        let lines = joints.lines.iter().zip(&self.eases);
        lines.map(|(line, ease)| line.pull(*ease, displaced)).collect()
    }

    /// One step on, to these displacements: what every joint and member does there.
    pub fn step(&self, model: &Model, joints: &Joints, displaced: Vec<Rate>) -> (Self, States) {
        let mut pasts = Vec::with_capacity(self.past.len());
        let mut states = Vec::with_capacity(self.past.len());
        for (joint, past) in joints.list.iter().zip(&self.past) {
            let motion = joint.motion(&model.assembly, &displaced);
            let mut spots = Vec::new();
            let (all, next, opening) = match (&joint.kind, past) {
                (JointKind::Bed(bed), Past::Bed(past)) => {
                    let all = bed.respond(past, &motion, Friction::Follows, |s| spots.push(s));
                    let next = bed::Past { motion, spots: spots.clone() };
                    let opening = bed.corners().iter().fold(
                        [f64::INFINITY, f64::NEG_INFINITY],
                        |[low, high], p| {
                            let g = super::law::opens(&motion, [p.x, p.y]);
                            [low.min(g), high.max(g)]
                        },
                    );
                    (all, Past::Bed(next), opening)
                }
                (JointKind::Grain(grain), Past::Grain(past)) => {
                    let all = grain.respond(past, &motion, Friction::Follows).0;
                    let (spot, next) = grain.spot(past, &motion);
                    if spot.normal > 0.0 {
                        spots.push(spot);
                    }
                    (all, Past::Grain(next), [motion[2]; 2])
                }
                _ => (super::law::Resultant::zero(), past.clone(), [0.0; 2]),
            };
            pasts.push(next);
            states.push(JointState {
                motion,
                spots,
                force: joint.outward(all.force),
                moment: joint.outward(all.moment),
                opening,
            });
        }
        let members = self.pulls(joints, &displaced);
        let eases = members.iter().map(|p| p.ease).collect();
        (Self { displaced, past: pasts, eases }, States { joints: states, members })
    }
}

impl JointState {
    /// Normal force, N.
    pub fn normal(&self) -> f64 {
        self.spots.iter().map(|s| s.normal).sum()
    }

    /// Area that is pressed, m².
    pub fn area(&self) -> f64 {
        self.spots.iter().map(|s| s.area).sum()
    }

    /// The longest slip of a point in this step, m.
    pub fn slip(&self) -> f64 {
        self.spots.iter().map(|s| s.slip[0].hypot(s.slip[1])).fold(0.0, f64::max)
    }
}

/// The forces of all joints as forces at the corners of their hulls, and those of members: every
/// point's force is shared among the corners of the triangle that it lies in, so that what was in the
/// friction cone stays in it and no resultant changes.
pub fn corner_forces(model: &Model, joints: &Joints, states: &States) -> Forces {
    let mut forces = no_forces(&model.interfaces);
    for (m, pull) in states.members.iter().enumerate() {
        forces[joints.list.len() + m] = amount(pull.tension);
    }
    for (k, (joint, state)) in joints.list.iter().zip(&states.joints).enumerate() {
        let corners: Vec<Vector2<f64>> = model.interfaces.list[k]
            .points
            .iter()
            .map(|p| {
                let d = p - joint.at;
                Vector2::new(d.dot(&joint.frame.t1), d.dot(&joint.frame.t2))
            })
            .collect();
        for spot in &state.spots {
            let force = joint.outward([spot.shear[0], spot.shear[1], spot.normal]);
            for (corner, share) in shares(&corners, Vector2::from(spot.at)) {
                forces[k][corner].force += force * share;
            }
        }
    }
    forces
}

/// Shares below this are rounding of the corners. Larger: moments change. Smaller: a corner carries
/// what is left of rounding, in any direction, and is refused for it.
const NO_SHARE: f64 = 1e-12;

/// Corners of a convex polygon that carry a force at an inner point, with shares that add up to 1.
fn shares(corners: &[Vector2<f64>], at: Vector2<f64>) -> Vec<(usize, f64)> {
    match corners {
        [] => Vec::new(),
        [_] => vec![(0, 1.0)],
        [a, b] => {
            let along = b - a;
            let square = along.norm_squared();
            let s =
                if square > 0.0 { ((at - a).dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
            vec![(0, 1.0 - s), (1, s)]
        }
        _ => {
            let of = |i: usize| {
                let m =
                    Matrix2::from_columns(&[corners[i] - corners[0], corners[i + 1] - corners[0]]);
                let inverse = m.try_inverse()?;
                let s = inverse * (at - corners[0]);
                let least = s.x.min(s.y).min(1.0 - s.x - s.y);
                Some((i, s, least))
            };
            let best = (1..corners.len() - 1).filter_map(of).max_by(|a, b| a.2.total_cmp(&b.2));
            let Some((i, s, _)) = best else { return vec![(0, 1.0)] };
            let all = [(0, 1.0 - s.x - s.y), (i, s.x), (i + 1, s.y)];
            let own = all.into_iter().filter(|(_, share)| *share > NO_SHARE);
            let sum: f64 = own.clone().map(|(_, share)| share).sum();
            own.map(|(corner, share)| (corner, share / sum)).collect()
        }
    }
}
