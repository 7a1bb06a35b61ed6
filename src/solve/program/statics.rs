//! The equilibrium of the free blocks, reduced and scaled.

use super::{
    Unknowns, bearing::Bearing, conic::Sparse, crushing::CrushingJoint, member::MemberColumns,
    planar::Plane, symmetry::Orbits,
};
use model::assembly::{Gyration, Wrench};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// A free block and the scales of its rows.
#[derive(Clone, Debug)]
pub struct FreeBlock {
    /// Index into the assembly.
    pub block: usize,
    /// Force scale, N: the greatest of own weight and dead load.
    pub weight: f64,
    /// What moments are measured by: the block's own radii of gyration, or metres
    /// ([`StaticsOptions::unscaled`](super::StaticsOptions::unscaled)).
    pub gyration: Gyration,
    /// Its rows: 6 in space, 3 in a plane, fewer where the block is its own image.
    pub rows: Range<usize>,
    /// The row coordinates among those 6 or 3 that the rows stand for, as columns; `None` for
    /// themselves.
    pub(super) directions: Option<DMatrix<f64>>,
    /// The blocks it stands for, itself among them, and the symmetry that takes it there; empty
    /// without symmetry.
    pub(super) images: Vec<(usize, usize)>,
}

impl FreeBlock {
    /// How many blocks it stands for.
    pub fn image_count(&self) -> usize {
        self.images.len().max(1)
    }
}

/// `A x + w + λ ℓ = 0`, reduced and scaled. `A` has `d·n_free` rows, `d` = 6 in space and 3 in a
/// plane, or fewer with symmetry.
#[derive(Clone, Debug)]
pub struct Statics {
    /// The mirror plane, where the scene is solved in it.
    pub plane: Option<Plane>,
    /// The free blocks in row order.
    pub free: Vec<FreeBlock>,
    /// The contact points in column order.
    pub bearings: Vec<Bearing>,
    /// The members, in column order after the contact points.
    pub members: Vec<MemberColumns>,
    /// What fingers apply, N and N·m about the centres of mass; contained in `dead`.
    pub(super) applied: Vec<(usize, Wrench)>,
    /// The joints that can crush.
    pub sections: Vec<CrushingJoint>,
    /// Scaled equilibrium operator.
    pub matrix: Sparse,
    /// Scaled dead load, with the water in the joints.
    pub dead: Vec<f64>,
    /// Scaled live load.
    pub live: Vec<f64>,
    /// Common force unit of the columns, N.
    pub unit: f64,
    /// What was left out, one line each.
    pub left_out: Vec<String>,
    /// The symmetry that reduced the scene to a part.
    pub(super) orbits: Option<Orbits>,
}

impl Statics {
    /// Whether a symmetry of the scene reduced it to a part.
    pub fn is_part(&self) -> bool {
        self.orbits.is_some()
    }

    /// Load of all free blocks, N.
    pub fn total_load(&self) -> f64 {
        self.free.iter().map(|f| f.weight * f.image_count() as f64).sum()
    }

    /// How many free blocks there are in the whole scene.
    pub fn free_count(&self) -> usize {
        self.free.iter().map(FreeBlock::image_count).sum()
    }

    /// How many blocks each row stands for.
    pub fn row_images(&self) -> Vec<f64> {
        self.free
            .iter()
            .flat_map(|f| std::iter::repeat_n(f.image_count() as f64, f.rows.len()))
            .collect()
    }

    /// How many bearings each column stands for.
    pub fn column_images(&self) -> Vec<f64> {
        self.bearings
            .iter()
            .flat_map(|b| std::iter::repeat_n(b.image_count() as f64, b.basis.len()))
            .chain(
                self.members
                    .iter()
                    .flat_map(|m| std::iter::repeat_n(m.images.len() as f64, m.amounts.len())),
            )
            .collect()
    }

    /// A wrench on the block of `row` in its row coordinates.
    pub(super) fn scaled(&self, row: usize, wrench: Wrench) -> Vec<f64> {
        let FreeBlock { weight, gyration, directions, .. } = &self.free[row];
        let f = wrench.force / *weight;
        let all = match self.plane {
            Some(p) => {
                let m = p.axis.dot(&wrench.moment) * gyration.force(&p.axis).norm() / weight;
                vec![p.e1.dot(&f), p.e2.dot(&f), m]
            }
            None => {
                let m = gyration.force(&wrench.moment) / *weight;
                vec![f.x, f.y, f.z, m.x, m.y, m.z]
            }
        };
        match directions {
            None => all,
            Some(q) => q.tr_mul(&DVector::from_vec(all)).as_slice().to_vec(),
        }
    }

    /// Multiplies the force unit by `factor`. With `local` units, no bearing's unit exceeds
    /// `LOCAL_UNIT` × the load that presumably passes there: without it a grain on a mountain is
    /// lost in the mountain's unit.
    pub fn rescale(&mut self, factor: f64, local: bool) {
        self.unit *= factor;
        let mut by = vec![1.0; self.matrix.columns];
        for bearing in &mut self.bearings {
            let unit = if local { self.unit.min(LOCAL_UNIT * bearing.presumed) } else { self.unit };
            by[bearing.column..bearing.column + bearing.basis.len()].fill(unit / bearing.unit);
            bearing.unit = unit;
        }
        for member in &mut self.members {
            let unit = if local { self.unit.min(LOCAL_UNIT * member.presumed) } else { self.unit };
            by[member.column..member.column + member.amounts.len()].fill(unit / member.unit);
            member.unit = unit;
        }
        for (j, v) in self.matrix.j.iter().zip(&mut self.matrix.v) {
            *v *= by[*j];
        }
    }

    /// Measures every block by the greatest load instead of its own: rates of light blocks among
    /// heavy ones then come out as exactly as those of the heavy ones, at the cost of their forces.
    pub fn even(&mut self) {
        let greatest = self.free.iter().map(|f| f.weight).fold(0.0, f64::max);
        self.measure(|_| greatest);
    }

    /// Measures every block by what `scale` makes of its own load.
    pub fn measure(&mut self, scale: impl Fn(f64) -> f64) {
        let by: Vec<f64> = self
            .free
            .iter()
            .flat_map(|f| std::iter::repeat_n(f.weight / scale(f.weight), f.rows.len()))
            .collect();
        for (i, v) in self.matrix.i.iter().zip(&mut self.matrix.v) {
            *v *= by[*i];
        }
        for (row, (dead, live)) in self.dead.iter_mut().zip(&mut self.live).enumerate() {
            *dead *= by[row];
            *live *= by[row];
        }
        self.free.iter_mut().for_each(|f| f.weight = scale(f.weight));
    }

    /// Whether joints have strengths or couples, or there are members, for which only programs in
    /// forces exist.
    pub fn in_forces_only(&self) -> bool {
        !self.members.is_empty() || self.bearings.iter().any(|b| b.limits().is_some())
    }

    /// The unknowns that a program can be written in.
    pub(super) fn unknowns(&self, wanted: Unknowns) -> Unknowns {
        if self.in_forces_only() { Unknowns::Forces } else { wanted }
    }
}

/// Greatest local unit, in presumed loads. Larger: blocks 1e9 times smaller than their neighbours
/// are lost. Smaller: ordinary walls get uneven units and stall.
const LOCAL_UNIT: f64 = 1e5;
