//! Anderson acceleration (type II) of a fixed-point iteration `x = G(x)` (Anderson 1965; Walker &
//! Ni 2011).

use nalgebra::{DMatrix, DVector};
use std::collections::VecDeque;

/// How many earlier steps are combined. More: near-parallel steps spoil the least squares. Fewer:
/// slow tails.
const MEMORY: usize = 6;

/// Singular values below this × the largest are ignored in the least squares. Larger: good
/// directions are lost. Smaller: rounding in near-parallel steps throws the iterate far off.
const RANK: f64 = 1e-10;

/// The history of an accelerated iteration over non-negative vectors.
#[derive(Default)]
pub struct Anderson {
    last: Option<(DVector<f64>, DVector<f64>)>,
    steps: VecDeque<(DVector<f64>, DVector<f64>)>,
}

impl Anderson {
    /// The next iterate from `x` and `G(x)`, kept non-negative.
    pub fn next(&mut self, x: &[f64], g: &[f64]) -> Vec<f64> {
        let x = DVector::from_column_slice(x);
        let f = DVector::from_column_slice(g) - &x;
        if let Some((last_x, last_f)) = self.last.take() {
            self.steps.push_back((&x - last_x, &f - last_f));
            if self.steps.len() > MEMORY {
                self.steps.pop_front();
            }
        }
        let mut next = &x + &f;
        if !self.steps.is_empty() {
            let df =
                DMatrix::from_columns(&self.steps.iter().map(|s| s.1.clone()).collect::<Vec<_>>());
            let svd = df.svd(true, true);
            let cut = RANK * svd.singular_values.max();
            if let Ok(gamma) = svd.solve(&f, cut) {
                for (k, (dx, df)) in self.steps.iter().enumerate() {
                    next -= (dx + df) * gamma[k];
                }
            }
        }
        self.last = Some((x, f));
        next.iter().map(|v| v.max(0.0)).collect()
    }
}
