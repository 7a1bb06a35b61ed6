//! The equations of one step of Newton's method, in unknowns of like size.

/// Equations for a step: values of the lower triangle and of its mirror image, right side, and what
/// unknowns are divided by.
pub(super) struct Equations {
    pub unit: Vec<f64>,
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    pub right: Vec<f64>,
}

/// A step in m and rad.
pub(super) fn scaled(mut x: Vec<f64>, unit: &[f64]) -> Option<Vec<f64>> {
    x.iter_mut().zip(unit).for_each(|(x, d)| *x /= d);
    x.iter().all(|v| v.is_finite()).then_some(x)
}
