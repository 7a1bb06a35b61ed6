//! From the columns and rows of a solved program back to the whole scene.

use super::Statics;
use model::{
    assembly::{Action, Wrench},
    interface::Interfaces,
};
use nalgebra::{DVector, Vector3};

impl Statics {
    /// What acts on block `b` at every point of every interface, N and N·m, and the amounts of every
    /// member, N, from scaled columns `x` brought into their cones.
    pub fn forces(&self, interfaces: &Interfaces, x: &[f64]) -> Vec<Vec<Wrench>> {
        let mut forces: Vec<Vec<Wrench>> =
            interfaces.list.iter().map(|f| vec![Wrench::zero(); f.points.len()]).collect();
        for bearing in &self.bearings {
            let mut c = x[bearing.column..bearing.column + bearing.basis.len()].to_vec();
            bearing.admit(&mut c);
            let mut total = Wrench::zero();
            for (basis, c) in bearing.basis.iter().zip(&c) {
                total += *basis * (c * bearing.unit);
            }
            match (&self.orbits, &bearing.orbit) {
                (Some(orbits), Some(orbit)) => {
                    let share = 0.5 * orbit.distinct as f64 / orbit.images.len() as f64;
                    for image in &orbit.images {
                        let force = orbits.wrench(image.element, &total) * (image.sign * share);
                        image.points.iter().for_each(|&(f, p)| forces[f][p] += force);
                    }
                }
                _ => {
                    bearing.points.iter().for_each(|&p| forces[bearing.interface][p] += total * 0.5)
                }
            }
        }
        let joints = forces.len();
        forces.extend(interfaces.members.iter().map(|_| vec![Wrench::zero()]));
        if !self.applied.is_empty() {
            // Fingers apply their strength.
            for (m, member) in interfaces.members.iter().enumerate() {
                if let Action::Press { .. } = member.action {
                    forces[joints + m][0].force.x = member.greatest;
                }
            }
        }
        for member in &self.members {
            let mut x = x[member.column..member.column + member.amounts.len()].to_vec();
            member.admit(&mut x);
            for (x, (axis, sign)) in x.iter().zip(&member.amounts) {
                for image in &member.images {
                    forces[joints + image][0].force[*axis] = sign * x * member.unit + 0.0;
                }
            }
        }
        forces
    }

    /// Velocity of the centre of mass and spin of every block (zero for supports) from the
    /// multipliers `y` of its rows, in units where a velocity of 1 and a spin that moves the
    /// block's mass at 1 (root mean square) weigh the same.
    pub fn rates(&self, blocks: usize, y: &[f64]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let mut rates = vec![(Vector3::zeros(), Vector3::zeros()); blocks];
        for free in &self.free {
            let own = DVector::from_column_slice(&y[free.rows.clone()]) / free.image_count() as f64;
            let y = free.directions.as_ref().map_or_else(|| own.clone(), |q| q * &own);
            let (v, gyration) = (1.0 / free.weight, &free.gyration);
            let (velocity, spin) = match self.plane {
                Some(p) => (
                    (p.e1 * y[0] + p.e2 * y[1]) * v,
                    p.axis * (y[2] * v * gyration.force(&p.axis).norm()),
                ),
                None => (
                    Vector3::new(y[0], y[1], y[2]) * v,
                    gyration.spin(&Vector3::new(y[3], y[4], y[5])) * v,
                ),
            };
            rates[free.block] = (velocity, spin);
            if let Some(orbits) = &self.orbits {
                for &(block, element) in &free.images {
                    // Velocity and spin turn as force and moment do.
                    let image = orbits.wrench(element, &Wrench { force: velocity, moment: spin });
                    rates[block] = (image.force, image.moment);
                }
            }
        }
        rates
    }
}
