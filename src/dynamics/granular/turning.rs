//! Grains seen from supports that turn steadily about an axis through the origin.
//!
//! Seen from there a grain of mass m at x with velocity v feels, beside gravity that turns, the
//! force `−m (ω × (ω × x) + 2 ω × v)` (centrifugal and Coriolis), and about its centre the torque
//! `−ω × (I s) − ω × (I ω) − s × (I ω) + I (s × ω)` with its inertia I and the spin s as it is seen:
//! what is left of Euler's `d(I (s + ω))/dt = 0` in a turning frame. Both are exact; they are applied
//! from step to step, which is good to the angle of a step.
//!
//! * L. D. Landau, E. M. Lifshitz, *Mechanics*, §39.

use super::Flowing;
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;

impl Flowing<'_> {
    /// Loads all grains for the next step; `omega` in 1/s.
    pub(super) fn load_turning(
        &mut self,
        omega: Vector3<f64>,
        couples: &BTreeMap<usize, Vector3<f64>>,
    ) {
        let turn = omega * self.units.time;
        for &i in self.free.iter().filter(|i| self.there[**i]) {
            let body = &self.bodies[i];
            let (velocity, spin) = self.world.velocity(i);
            // In the engine's units, about the axis.
            let at = self.center(i) / self.units.length;
            let pull = turn.cross(&turn.cross(&at)) + 2.0 * turn.cross(&velocity);
            let weight = self.gravity * (self.assembly.blocks[i].mass / self.units.force());
            let turned = self.world.pose(i).1.to_rotation_matrix();
            let inertia: Matrix3<f64> =
                turned.matrix() * body.inertia * turned.matrix().transpose();
            let torque = inertia * spin.cross(&turn)
                - turn.cross(&(inertia * (spin + turn)))
                - spin.cross(&(inertia * turn));
            let couple = couples.get(&i).copied().unwrap_or_default();
            self.world.load(i, weight - pull * body.mass, torque + couple);
        }
    }
}
