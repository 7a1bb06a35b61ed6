//! Where an iteration ended.

/// Where an iteration ended.
#[derive(Clone, Debug)]
pub struct FixedPoint {
    /// Forces per column in mean block loads, cut back into the friction cones.
    pub forces: Vec<f64>,
    /// Rates of the blocks: multipliers of the rows.
    pub rates: Vec<f64>,
    /// The load factor (0 for a state).
    pub lambda: f64,
    /// Last change of what was held, each in the load that presumably passes there.
    pub change: f64,
    /// What is unsettled can make this of accelerations at most, in multiples of gravity.
    pub noise: f64,
    /// Convex programs solved.
    pub solves: usize,
}
