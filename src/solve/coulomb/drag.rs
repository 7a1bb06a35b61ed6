//! Where the state has come to as it comes about.

/// Where blocks have come to.
#[derive(Clone, Default)]
pub struct Dragged {
    /// How long it took; nothing was asked yet at 0.
    pub time: f64,
    /// How far each row has come.
    pub rates: Vec<f64>,
    /// How fast it goes.
    pub speeds: Vec<f64>,
    /// What each column wants there.
    pub memory: Vec<f64>,
    /// The next step of time.
    pub step: f64,
}
