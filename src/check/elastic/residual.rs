//! How far a state is from the laws that it claims to obey: balance, Signorini's three conditions
//! and Coulomb's, each measured by what is greatest at the blocks that it is about.

use super::{
    joints::{JointKind, Joints},
    law::opens,
    state::{JointState, States},
};
use crate::verdict::{Forces, certificate};
use model::interface::Model;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is left of each condition; zero is exact. What is greatest is so among the joints of the
/// same blocks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Residuals {
    /// Greatest equilibrium error of a block, in multiples of its load.
    pub balance: f64,
    /// `ḡ ≥ 0`: the deepest gap below zero beside what the joint itself closes, in multiples of the
    /// greatest closing.
    pub gap: f64,
    /// `p ≥ 0`: the greatest pull at a point, in multiples of the greatest force at one.
    pub pressure: f64,
    /// `ḡ p = 0`: the greatest product, in multiples of both.
    pub complementarity: f64,
    /// `‖t‖ ≤ μ p`: the greatest excess at a point, in multiples of the greatest force at one.
    pub cone: f64,
    /// Slip only at the limit: the greatest slip at a point below its limit times what is left to it,
    /// in multiples of the greatest slip and force.
    pub sticking: f64,
    /// Slip along the shear force's other way: the greatest difference from it, in multiples of the
    /// greatest slip.
    pub direction: f64,
}

impl Residuals {
    /// The worst of all.
    pub fn worst(&self) -> f64 {
        let Self { balance, gap, pressure, complementarity, cone, sticking, direction } = *self;
        [balance, gap, pressure, complementarity, cone, sticking, direction]
            .into_iter()
            .fold(0.0, f64::max)
    }
}

/// The residuals of a state under a load factor; `forces` are the forces at corners.
pub fn residuals(
    model: &Model,
    joints: &Joints,
    states: &States,
    forces: &Forces,
    lambda: f64,
) -> Residuals {
    let states = &states.joints;
    let greatest = |of: &dyn Fn(&JointState) -> f64| joints.greatest_near(|k| of(&states[k]));
    let forces_near = greatest(&|s| s.spots.iter().map(|s| s.normal).fold(0.0, f64::max));
    let closing_near = greatest(&|s| -s.opening[0]);
    let slid_near = greatest(&JointState::slip);
    let share = |value: f64, of: f64| if of > 0.0 { value / of } else { 0.0 };
    let mut all = Residuals {
        balance: certificate::statics(model, forces, lambda).equilibrium_error,
        gap: 0.0,
        pressure: 0.0,
        complementarity: 0.0,
        cone: 0.0,
        sticking: 0.0,
        direction: 0.0,
    };
    let worse = |worst: &mut f64, value: f64| *worst = worst.max(value);
    for (k, (joint, state)) in joints.list.iter().zip(states).enumerate() {
        let (force, closing, slid) = (forces_near[k], closing_near[k], slid_near[k]);
        for s in &state.spots {
            let (own, mu) = match &joint.kind {
                JointKind::Bed(bed) => (s.normal / (bed.normal * s.area), bed.mu),
                JointKind::Grain(grain) => (grain.approach(s.normal), grain.mu),
            };
            let gap = s.opening + own;
            worse(&mut all.gap, share(-gap, closing));
            worse(&mut all.pressure, share(-s.normal, force));
            let product = share(gap.abs(), closing) * share(s.normal, force);
            worse(&mut all.complementarity, product);
            let shear = s.shear[0].hypot(s.shear[1]);
            let slip = s.slip[0].hypot(s.slip[1]);
            if mu.is_finite() {
                worse(&mut all.cone, share(shear - mu * s.normal, force));
                // The inmost spring of spheres says nothing about the ring that slides.
                if matches!(joint.kind, JointKind::Bed(_)) {
                    let left = (mu * s.normal - shear).max(0.0);
                    worse(&mut all.sticking, share(left, force) * share(slip, slid));
                    // Shear on the second block is against the slip of the second block.
                    if shear > 0.0 {
                        let along = (s.slip[0] * s.shear[0] + s.slip[1] * s.shear[1]) / shear;
                        worse(&mut all.direction, share(slip + along, slid));
                    }
                }
            }
        }
        // Where nothing presses it is open.
        if let JointKind::Bed(bed) = &joint.kind {
            let deepest = bed
                .whole()
                .iter()
                .map(|(p, _)| opens(&state.motion, [p.x, p.y]))
                .fold(0.0, f64::min);
            if state.spots.is_empty() {
                worse(&mut all.gap, share(-deepest, closing));
            }
        }
    }
    all
}
