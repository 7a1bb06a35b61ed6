//! Blocks somewhere else: rigid motions of any size, and what they make of blocks and loads.

use super::{AppliedForce, Assembly, Block, Polyhedron, Solid, Wrench};
use nalgebra::{UnitQuaternion, Vector3};

/// Where a block has come since the start: `x ↦ c + shift + R (x − c)` with `c` its centre of mass
/// at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The way of its centre of mass, m.
    pub shift: Vector3<f64>,
    /// How it has turned.
    pub turn: UnitQuaternion<f64>,
}

impl Pose {
    /// Where it was at the start.
    pub fn start() -> Self {
        Self { shift: Vector3::zeros(), turn: UnitQuaternion::identity() }
    }

    /// The way of a point of a block with this centre of mass, m: without the rounding of distant
    /// coordinates.
    pub fn way(&self, center: &Vector3<f64>, point: &Vector3<f64>) -> Vector3<f64> {
        let arm = point - center;
        (self.turn * arm - arm) + self.shift
    }

    /// Where such a point has come, m.
    pub fn apply(&self, center: &Vector3<f64>, point: &Vector3<f64>) -> Vector3<f64> {
        point + self.way(center, point)
    }
}

impl Block {
    /// The block after a rigid motion.
    #[must_use]
    pub fn at(&self, pose: &Pose) -> Self {
        let moved = |p: &Vector3<f64>| pose.apply(&self.centroid, p);
        let r = pose.turn.to_rotation_matrix();
        let inertia = r.matrix() * self.inertia * r.matrix().transpose();
        let solid = match &self.solid {
            Solid::Polyhedron(p) => Solid::Polyhedron(p.moved(&moved, &r)),
            Solid::Sphere { center, radius } => {
                Solid::Sphere { center: moved(center), radius: *radius }
            }
            Solid::Clump { balls, volume } => Solid::Clump {
                balls: balls.iter().map(|(c, r)| (moved(c), *r)).collect(),
                volume: *volume,
            },
        };
        let gyration = self.gyration.turned(&r);
        Self { centroid: self.centroid + pose.shift, inertia, gyration, solid, ..self.clone() }
    }
}

impl Polyhedron {
    fn moved(
        &self,
        moved: &dyn Fn(&Vector3<f64>) -> Vector3<f64>,
        turn: &nalgebra::Rotation3<f64>,
    ) -> Self {
        let mut other = self.clone();
        other.vertices.iter_mut().for_each(|v| *v = moved(v));
        for facet in &mut other.facets {
            let on = facet.normal * facet.offset;
            facet.normal = turn * facet.normal;
            facet.offset = facet.normal.dot(&moved(&on));
        }
        other.mass.centroid = moved(&self.mass.centroid);
        other.mass.inertia = turn.matrix() * self.mass.inertia * turn.matrix().transpose();
        other
    }
}

impl Assembly {
    /// The blocks at these poses. Loads keep their direction and follow the points where they act;
    /// moments given as such stay as they are.
    #[must_use]
    pub fn at(&self, poses: &[Pose]) -> Self {
        let mut moved = self.clone();
        for (block, pose) in moved.blocks.iter_mut().zip(poses) {
            *block = block.at(pose);
        }
        [moved.dead, moved.live] = self.loads_at(poses);
        let follow = |forces: &mut [AppliedForce]| {
            forces.iter_mut().for_each(|f| f.arm = poses[f.block].turn * f.arm);
        };
        follow(&mut moved.dead_forces);
        follow(&mut moved.live_forces);
        moved
    }

    /// Dead and live loads of the blocks at these poses.
    pub fn loads_at(&self, poses: &[Pose]) -> [Vec<Wrench>; 2] {
        let follow = |forces: &[AppliedForce], sums: &[Wrench]| {
            let mut sums = sums.to_vec();
            for f in forces {
                let arm = poses[f.block].turn * f.arm;
                sums[f.block].moment += (arm - f.arm).cross(&f.force);
            }
            sums
        };
        [follow(&self.dead_forces, &self.dead), follow(&self.live_forces, &self.live)]
    }
}
