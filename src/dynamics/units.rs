//! Units in which every scene looks alike to the engine, whose own tolerances are absolute: lengths
//! in median block sizes, masses in median block masses, times such that the blocks' acceleration
//! under their loads is one.

use model::assembly::{Assembly, Wrench};
use nalgebra::Vector3;

/// What one unit of the engine is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    /// Scene coordinates of the engine's origin, m.
    pub origin: Vector3<f64>,
    /// m.
    pub length: f64,
    /// kg.
    pub mass: f64,
    /// s.
    pub time: f64,
}

impl Units {
    /// Units for a scene under the given loads; `None` where nothing is free.
    pub fn of(assembly: &Assembly, loads: &[Wrench]) -> Option<Self> {
        let free: Vec<usize> = assembly.free().collect();
        let length = median(free.iter().map(|&i| assembly.blocks[i].size).collect())?;
        let mass = median(free.iter().map(|&i| assembly.blocks[i].mass).collect())?;
        let origin = free.iter().map(|&i| assembly.blocks[i].centroid).sum::<Vector3<f64>>()
            / free.len() as f64;
        let total: f64 = free.iter().map(|&i| assembly.blocks[i].mass).sum();
        // Moments count by the forces that make them at the block's own size.
        let force =
            |i: &usize| loads[*i].force.norm() + loads[*i].moment.norm() / assembly.blocks[*i].size;
        let acceleration = assembly.gravity.norm().max(free.iter().map(force).sum::<f64>() / total);
        // Without any load nothing moves, in whatever time.
        let time = if acceleration > 0.0 { (length / acceleration).sqrt() } else { length.sqrt() };
        Some(Self { origin, length, mass, time })
    }

    pub fn place(&self, point: Vector3<f64>) -> Vector3<f64> {
        (point - self.origin) / self.length
    }

    /// One unit of force, N.
    pub fn force(&self) -> f64 {
        self.mass * self.length / self.time.powi(2)
    }

    /// One unit of moment, N·m.
    pub fn moment(&self) -> f64 {
        self.force() * self.length
    }

    /// One unit of inertia, kg·m².
    pub fn inertia(&self) -> f64 {
        self.mass * self.length * self.length
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
