//! Couples of joints with a rolling arm c: `‖m_t‖ ≤ c f_n` against rolling, `|m_n| ≤ c f_n` against
//! twisting.
//!
//! The engine knows no such couples; they are applied as torques that follow the contact. A couple
//! grows against the relative spin until that vanishes (an integral and a proportional part, so
//! that a block at rest is held without creeping), and yields at its limit, as friction does.

use super::{
    bodies::{Body, Frictions},
    rapier::World,
};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Share of the spin that a couple takes out in one step, and share of it that stays in the couple.
/// Larger: couples overshoot where a block has many contacts. Smaller: blocks creep while loads
/// grow.
const TAKEN: f64 = 0.5;
const KEPT: f64 = 0.25;

/// The couples of a scene.
#[derive(Default)]
pub(super) struct Rolling {
    /// What stays, on the block with the larger index, by pairs.
    kept: BTreeMap<(usize, usize), Vector3<f64>>,
}

impl Rolling {
    /// The torques on each block for the next step of length `dt`.
    pub fn torques(
        &mut self,
        bodies: &[Body],
        frictions: &Frictions,
        world: &World,
        dt: f64,
    ) -> BTreeMap<usize, Vector3<f64>> {
        // Normal force and its sum along the normals, on the block with the larger index.
        let mut pairs: BTreeMap<(usize, usize), (f64, Vector3<f64>)> = BTreeMap::new();
        for patch in world.patches() {
            let sign = if patch.a < patch.b { 1.0 } else { -1.0 };
            let sum = pairs
                .entry((patch.a.min(patch.b), patch.a.max(patch.b)))
                .or_insert((0.0, Vector3::zeros()));
            sum.0 += patch.normal_force;
            sum.1 += patch.normal * (sign * patch.normal_force);
        }
        pairs.retain(|pair, _| frictions.between(pair.0, pair.1).arm > 0.0);
        let mut contacts: BTreeMap<usize, f64> = BTreeMap::new();
        for (a, b) in pairs.keys() {
            *contacts.entry(*a).or_default() += 1.0;
            *contacts.entry(*b).or_default() += 1.0;
        }
        let mut torques: BTreeMap<usize, Vector3<f64>> = BTreeMap::new();
        self.kept.retain(|pair, _| pairs.contains_key(pair));
        for (&(a, b), &(normal_force, normal)) in &pairs {
            let limit = frictions.between(a, b).arm * normal_force;
            let Some(normal) = normal.try_normalize(0.0) else { continue };
            let ease = |i: usize| {
                if bodies[i].support {
                    0.0
                } else {
                    contacts[&i] / bodies[i].inertia.symmetric_eigenvalues().max()
                }
            };
            let weight = 1.0 / (ease(a) + ease(b)).max(f64::MIN_POSITIVE);
            let spin = world.velocity(b).1 - world.velocity(a).1;
            let kept = self.kept.entry((a, b)).or_default();
            *kept = within(*kept - spin * (KEPT * weight / dt), normal, limit);
            let couple = within(*kept - spin * (TAKEN * weight / dt), normal, limit);
            *torques.entry(b).or_default() += couple;
            *torques.entry(a).or_default() -= couple;
        }
        torques.retain(|i, _| !bodies[*i].support);
        torques
    }
}

/// A couple cut to its limits: the twisting part and the rolling part, each by itself.
fn within(couple: Vector3<f64>, normal: Vector3<f64>, limit: f64) -> Vector3<f64> {
    let twist = normal.dot(&couple);
    let roll = couple - normal * twist;
    normal * twist.clamp(-limit, limit) + roll.cap_magnitude(limit)
}
