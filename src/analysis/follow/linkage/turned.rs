//! A linkage whose parameter is the angle by which one of its blocks has turned: unlike the way of a
//! point it goes on growing until the block lies on its side.

use super::{CLOSED, Configuration, FREE, Linkage, STEPS, free};
use check::verdict::Rate;
use nalgebra::{DMatrix, DVector, Vector3};

/// How far a block must have turned.
#[derive(Clone, Copy, Debug)]
pub struct Turned {
    /// The block.
    pub block: usize,
    /// The unit axis about which its turn is measured.
    pub axis: Vector3<f64>,
    /// The component of its rotation vector along this axis, rad.
    pub angle: f64,
}

impl Linkage<'_> {
    /// The place near by at which a block has turned so far (Newton, least change); none where it
    /// does not come to rest.
    pub fn turn(&self, near: &Configuration, to: &Turned) -> Option<Configuration> {
        let column = self.bodies[self.body_of[to.block]].column?;
        let mut place = near.clone();
        let mut best = f64::INFINITY;
        for step in 0..STEPS {
            let (gaps, open) = self.equations(&place, None, &[]);
            let rows = gaps.nrows();
            let mut j = DMatrix::zeros(rows + 1, self.unknowns);
            let mut r = DVector::zeros(rows + 1);
            j.rows_mut(0, rows).copy_from(&gaps);
            r.rows_mut(0, rows).copy_from(&open);
            let turn = place.motions[self.body_of[to.block]].turn.scaled_axis();
            r[rows] = to.axis.dot(&turn) - to.angle;
            (0..3).for_each(|k| j[(rows, column + 3 + k)] = to.axis[k]);
            let size = r.amax();
            if !size.is_finite() || (step > 8 && size > 0.5 * best && size > CLOSED) {
                return None;
            }
            let settled = size <= 0.01 * CLOSED || (size <= CLOSED && size > 0.5 * best);
            best = best.min(size);
            if settled {
                // Padded to as many rows as unknowns: all right singular vectors are there.
                let svd = gaps.svd(false, true);
                place.free = free(&svd, FREE * svd.singular_values.max());
                return Some(place);
            }
            let svd = j.svd(true, true);
            let by = svd.solve(&-r, FREE * svd.singular_values.max()).ok()?;
            place = self.moved(&place, &by);
        }
        None
    }

    /// The rates of all blocks in a motion of the unknowns.
    pub fn rates(&self, place: &Configuration, by: &DVector<f64>) -> Vec<Rate> {
        let blocks = &self.start.assembly.blocks;
        (0..blocks.len())
            .map(|i| {
                let b = self.body_of[i];
                let Some(c) = self.bodies[b].column else { return Rate::zero() };
                let center = self.bodies[b].center + place.motions[b].shift;
                let arm = blocks[i].centroid + place.poses[i].shift - center;
                let spin = Vector3::from(by.fixed_rows::<3>(c + 3));
                let velocity = Vector3::from(by.fixed_rows::<3>(c)) * self.length;
                Rate { velocity: velocity + spin.cross(&arm), spin }
            })
            .collect()
    }

    /// The body of each block; blocks that move as one have the same.
    pub fn bodies(&self) -> &[usize] {
        &self.body_of
    }
}
