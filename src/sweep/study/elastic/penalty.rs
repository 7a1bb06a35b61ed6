//! The penalty method: springs at points of the joints, stepped in time with made-up masses and
//! Cundall's damping until what is left out of balance is small (Cundall 1987; distinct elements).
//!
//! Written as such codes are, apart from the laws of the state with stiffness: joints are springs at
//! points with a share of the area each; spheres press by Hertz, and along by increments of Mindlin's
//! stiffness `8 a G*` that Coulomb's law cuts off as a whole (the "no-slip" law of Hertz and Mindlin).
//! Friction follows every step in time, overshoots included.

use base::{error::InputError, plane::polygon::P2};
use check::{
    elastic::{
        JointKind, Joints, Quadrature, System,
        bed::{Bed, Domain},
        law::{Resultant, along, opens},
        number::Number,
    },
    verdict::Rate,
};
use model::{assembly::Wrench, interface::Model};
use nalgebra::Vector6;

/// Share of each force that opposes the motion.
const DAMPING: f64 = 0.8;
/// Masses over the stiffness of the glued joints, steps of time being 1: half of what is stable.
/// Less: steps that blow up. More: more of them.
const MASS: f64 = 2.0;
/// Most steps of a relaxation.
const STEPS: usize = 400_000;
/// A block that goes farther than this share of its size does not come to rest.
const GONE: f64 = 0.02;

/// Springs and dampers of a model.
#[derive(Clone)]
pub struct Penalty<'a> {
    model: &'a Model,
    joints: Joints,
    free: Vec<usize>,
    masses: Vec<f64>,
    rest: f64,
    springs: Vec<Springs>,
    eases: Vec<f64>,
    /// Where all blocks are.
    pub displaced: Vec<Rate>,
}

/// Those of a joint: points with their share of the area, and what each is stretched, m (of spheres
/// the shear force, N); the relative displacements of the step before.
#[derive(Clone)]
struct Springs {
    points: Vec<(P2, f64)>,
    shear: Vec<[f64; 2]>,
    before: [f64; 6],
}

impl<'a> Penalty<'a> {
    /// At the corners of joints, or at points of their triangles cut in four so many times more; what
    /// is left out of balance at rest, in multiples of all that acts.
    ///
    /// # Errors
    /// Joints without a stiffness.
    pub fn new(model: &'a Model, finer: Option<usize>, rest: f64) -> Result<Self, InputError> {
        let place = if finer.is_some() { Quadrature::Area } else { Quadrature::Corners };
        let joints = Joints::new(model, place)?;
        let springs = joints.list.iter().map(|joint| {
            let points = match &joint.kind {
                JointKind::Bed(bed) => points(bed, finer.unwrap_or_default()),
                JointKind::Grain(_) => vec![(P2::zeros(), 0.0)],
            };
            Springs { shear: vec![[0.0; 2]; points.len()], points, before: [0.0; 6] }
        });
        let springs = springs.collect();
        let system = System::new(model, &joints);
        let masses = system.diagonal.iter().map(|d| MASS * d).collect();
        let free = system.free.clone();
        drop(system);
        Ok(Self {
            model,
            free,
            masses,
            rest,
            springs,
            eases: vec![0.0; joints.lines.len()],
            displaced: vec![Rate::zero(); model.assembly.blocks.len()],
            joints,
        })
    }

    /// Steps until rest under a load factor; false where it does not come to rest.
    pub fn relax(&mut self, lambda: f64) -> bool {
        let model = self.model;
        let assembly = &model.assembly;
        let loads: Vec<Vector6<f64>> = (self.free.iter())
            .map(|&i| six(&assembly.dead[i]) + six(&assembly.live[i]) * lambda)
            .collect();
        let mut speeds = vec![0.0; 6 * self.free.len()];
        for step in 0..STEPS {
            let mut forces = loads.clone();
            let mut acting = self.size(&loads);
            self.act(&mut forces, &mut acting);
            let left = self.size(&forces);
            if step > 0 && left <= self.rest * acting {
                return true;
            }
            for (row, &i) in self.free.iter().enumerate() {
                for k in 0..6 {
                    let (force, speed) = (forces[row][k], &mut speeds[6 * row + k]);
                    let against = DAMPING * force.abs() * f64::signum(*speed);
                    let against = if *speed == 0.0 { 0.0 } else { against };
                    *speed += (force - against) / self.masses[6 * row + k];
                    let q = &mut self.displaced[i];
                    match k {
                        0..3 => q.velocity[k] += *speed,
                        _ => q.spin[k - 3] += *speed,
                    }
                }
                let far = self.displaced[i].velocity.norm();
                if far.is_nan() || far > GONE * assembly.blocks[i].size {
                    return false;
                }
            }
        }
        false
    }

    /// The sum of forces on the free blocks, moments over the size of the block.
    fn size(&self, forces: &[Vector6<f64>]) -> f64 {
        let blocks = &self.model.assembly.blocks;
        forces.iter().zip(&self.free).map(|(w, &i)| size(w, blocks[i].size)).sum()
    }

    /// Adds what joints and members do, and how much that is.
    fn act(&mut self, forces: &mut [Vector6<f64>], acting: &mut f64) {
        let model = self.model;
        let assembly = &model.assembly;
        for (joint, springs) in self.joints.list.iter().zip(&mut self.springs) {
            let motion = joint.motion(assembly, &self.displaced);
            let all = springs.respond(&joint.kind, motion);
            let [x, y, z] = all.force;
            let [u, v, w] = all.moment;
            for &i in &joint.free {
                let on = joint.lever(assembly, i).transpose() * Vector6::new(x, y, z, u, v, w);
                *acting += size(&on, assembly.blocks[i].size);
                if let Ok(row) = self.free.binary_search(&i) {
                    forces[row] += on;
                }
            }
        }
        for (line, ease) in self.joints.lines.iter().zip(&mut self.eases) {
            let pull = line.pull(*ease, &self.displaced);
            *ease = pull.ease;
            for (i, wrench) in &line.on {
                let on = wrench * pull.tension;
                *acting += size(&on, assembly.blocks[*i].size);
                if let Ok(row) = self.free.binary_search(i) {
                    forces[row] += on;
                }
            }
        }
    }
}

impl Springs {
    fn respond(&mut self, kind: &JointKind, motion: [f64; 6]) -> Resultant<f64> {
        let before = std::mem::replace(&mut self.before, motion);
        let mut all = Resultant::zero();
        for ((p, area), shear) in self.points.iter().zip(&mut self.shear) {
            let at = [p.x, p.y];
            let depth = -opens(&motion, at);
            if depth <= 0.0 {
                *shear = [0.0; 2];
                continue;
            }
            let (now, then) = (along(&motion, at), along(&before, at));
            let way = [now[0] - then[0], now[1] - then[1]];
            // Normal force, stiffness along the joint, coefficient of friction.
            let (normal, stiff, mu) = match kind {
                JointKind::Bed(bed) => (bed.normal * area * depth, bed.shear * area, bed.mu),
                JointKind::Grain(grain) => {
                    let contact = (grain.radius * depth).sqrt();
                    let normal = 4.0 / 3.0 * grain.modulus * contact * depth;
                    (normal, 8.0 * contact * grain.shear, grain.mu)
                }
            };
            *shear = std::array::from_fn(|k| shear[k] - stiff * way[k]);
            let size = shear[0].hypot(shear[1]);
            if size > mu * normal {
                *shear = shear.map(|v| v.times(mu * normal / size));
            }
            all.add(at, [shear[0], shear[1], normal]);
        }
        all
    }
}

/// Points of a bed with their shares of the area.
fn points(bed: &Bed, finer: usize) -> Vec<(P2, f64)> {
    let Domain::Triangles(list) = &bed.place else { return bed.whole() };
    let mut triangles = list.clone();
    for _ in 0..finer {
        let polygons: Vec<Vec<P2>> = triangles.iter().map(|t| t.to_vec()).collect();
        triangles = Bed::triangles(&polygons);
    }
    Bed { place: Domain::Triangles(triangles), ..bed.clone() }.whole()
}

fn size(w: &Vector6<f64>, block: f64) -> f64 {
    w.fixed_rows::<3>(0).norm() + w.fixed_rows::<3>(3).norm() / block
}

fn six(w: &Wrench) -> Vector6<f64> {
    Vector6::new(w.force.x, w.force.y, w.force.z, w.moment.x, w.moment.y, w.moment.z)
}
