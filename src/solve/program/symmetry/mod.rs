//! Scenes that are images of themselves under a mirror or a turn about the vertical need only one
//! part of themselves.
//!
//! *Why it is exact.* Let a group of isometries carry blocks, contacts and loads into themselves.
//! The images of admissible forces are admissible, and so is the mean of all images, for the cones
//! are convex: among the best forces are symmetric ones, and likewise among the best mechanisms.
//! Programs C and D keep to symmetric states by themselves: each convex program has one solution,
//! and that of a symmetric program is symmetric. So one block stands for all its images, and
//! likewise one contact point: its forces are the variables, what its images do to a block is the
//! image of what it does to theirs. A block that is its own image balances by itself in the
//! directions that the symmetry excludes; those rows are left out. A member that acts by one amount
//! stands for its images likewise; where members have a direction of their own to choose (dowels,
//! fingers), no symmetry is looked for.
//!
//! *Multipliers.* With `m` images of a block, the multiplier of its rows in the reduced program is
//! `m` times the rate of each of them; powers and norms summed over all blocks are then those of
//! the reduced rows.
//!
//! The vertical through the centre of mass of the free blocks is carried into itself by every such
//! isometry, so that turns are about it and mirrors contain it.

mod find;
mod images;
mod matching;
mod members;
mod orbits;

pub use images::{Isometries, Isometry};
pub use orbits::{BlockOrbit, MemberOrbit, Orbits, Part};

use super::{Bearing, Plane};
use model::{assembly::Wrench, interface::Model};

/// The part that stands for a whole scene with its loads; `None` where there is no symmetry.
pub(super) fn part(
    model: &Model,
    loads: &[&[Wrench]],
    plane: Option<Plane>,
    bearings: &[Bearing],
) -> Option<Part> {
    let assembly = &model.assembly;
    let symmetry = find::find(model, loads, plane)?;
    Part::new(&symmetry, assembly.free(), bearings, model.interfaces.members.len(), plane)
}
