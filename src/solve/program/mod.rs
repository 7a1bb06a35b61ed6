//! The conic programs, engine-neutral.
//!
//! [`Statics`] is the equilibrium of the free blocks, reduced and scaled: `A x + w + λ ℓ = 0` with
//! `x` in a product of standard cones. Rows are divided by each block's own load (moments also by
//! its size), columns by one force unit; with raw newtons an interior-point solver reports success
//! on wrong answers. From it come program **V**, the least equilibrium error ([`equilibrium_error`]), and program
//! **L**, the load factor ([`load_factor`]), each in the forces or, dually, in the rates of the
//! blocks; and program **T**, the thrust on a support ([`thrust()`]), in the forces.
//!
//! Signs: a contact force acts on block `b` along `n` (from `a` into `b`); rates are
//! power-conjugate to wrenches, so that `v = Aᵀ q` is the rate of separation and sliding of the
//! contacts, opening positive.

mod bearing;
mod build;
mod carried;
mod conic;
pub mod coulomb;
mod crushing;
mod equilibrium_error;
mod load_factor;
mod margin;
mod member;
mod opening;
mod options;
mod planar;
pub mod response;
mod section;
mod statics;
mod symmetry;
mod thrust;
mod unfold;

pub use bearing::{Bearing, BearingCone, Disc, Limits};
pub use conic::{Cone, ConicProgram, Sparse};
pub use crushing::CrushingJoint;
pub use equilibrium_error::{LiveLoad, equilibrium_error};
pub use load_factor::load_factor;
pub use margin::{margin, pressed};
pub use member::{MemberColumns, MemberSet};
pub use opening::opening;
pub use options::{Pyramid, StaticsOptions};
pub use planar::Plane;
pub use statics::{FreeBlock, Statics};
pub use symmetry::{Isometries, Isometry};
pub use thrust::{
    closing, endless_thrust, member_columns, pushed, reaction_columns, thrust, thrust_columns,
};

/// Which unknowns a program is written in; the others come out as multipliers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknowns {
    /// Contact forces. Converges on walls pushed in their plane, where the other stalls.
    Forces,
    /// Rates of the blocks: half the size. Best on walls pushed out of their plane.
    Rates,
}

/// Where the forces and the rates stand in the vectors of a solved program.
#[derive(Clone, Debug)]
pub struct Positions {
    unknowns: Unknowns,
    /// First entry of the forces (in `x` for [`Unknowns::Forces`], in `z` for [`Unknowns::Rates`]).
    forces: usize,
    /// Number of force entries.
    force_count: usize,
    /// First entry of the rates.
    rates: usize,
    /// Number of rate entries.
    rate_count: usize,
}

impl Positions {
    /// Scaled forces `x` (columns of [`Statics`]) of a solution given as primal `x` and dual `z`.
    pub fn forces<'a>(&self, x: &'a [f64], z: &'a [f64]) -> &'a [f64] {
        let source = if self.unknowns == Unknowns::Forces { x } else { z };
        &source[self.forces..self.forces + self.force_count]
    }

    /// Scaled rates (rows of [`Statics`]).
    pub fn rates<'a>(&self, x: &'a [f64], z: &'a [f64]) -> &'a [f64] {
        let source = if self.unknowns == Unknowns::Forces { z } else { x };
        &source[self.rates..self.rates + self.rate_count]
    }
}
