//! Equations of heaps by incomplete factors: complete ones of 1,000 spheres have millions of entries.

use crate::{
    solve::{Blocks, Pattern},
    yielding::{JointKind, System},
};
use nalgebra::Vector6;

/// So many blocks that all touch as spheres do are a heap. Fewer: complete factors are faster.
const HEAP: usize = 200;
/// What a solution of the equations leaves of their right side near balance. More: more steps. Less:
/// more time for each.
pub const CLOSELY: f64 = 1e-4;
/// Most products of a solution: where it takes more, it takes thousands.
const PRODUCTS: usize = 240;

/// Whether a model is a heap, and they are tried.
pub fn serve(system: &System) -> bool {
    let round = |kind: &JointKind| matches!(kind, JointKind::Grain(_));
    system.free.len() >= HEAP && system.joints.list.iter().all(|j| round(&j.kind))
}

/// The solution to this share of the right side; nothing where incomplete factors do not get there.
pub fn solved(
    pattern: &Pattern,
    lower: &[f64],
    upper: &[f64],
    right: &[f64],
    share: f64,
) -> Option<Vec<f64>> {
    let matrix = Blocks::new(pattern, lower, upper);
    let factors = matrix.incomplete()?;
    let right: Vec<Vector6<f64>> = right.chunks_exact(6).map(Vector6::from_column_slice).collect();
    let x = matrix.solve(&factors, &right, share, PRODUCTS)?;
    Some(x.iter().flat_map(|v| v.iter().copied()).collect())
}
