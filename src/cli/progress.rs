//! A bar on standard error while something takes long; none where that is no terminal, or unwanted.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use voussoir::dynamics::{Fidelity, Progress};

/// Steps of the bar.
const STEPS: u64 = 1000;

/// How far a simulation is.
pub struct Bar(ProgressBar);

impl Bar {
    /// A bar, hidden unless `shown` and on a terminal.
    pub fn new(shown: bool) -> Self {
        let target =
            if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(STEPS), target);
        if let Ok(style) = ProgressStyle::with_template("{prefix} {wide_bar} {msg}") {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// Shows a state.
    pub fn show(&self, progress: &Progress) {
        let steps = match progress.fidelity {
            Fidelity::Fast => "fast steps",
            Fidelity::Fine => "fine steps",
        };
        self.0.set_prefix(steps);
        self.0.set_position((STEPS as f64 * progress.time / progress.horizon) as u64);
        let moved = 100.0 * progress.relative;
        self.0.set_message(format!(
            "{:.2} of {:.2} s, moved by {moved:.2} % of a block's thickness",
            progress.time, progress.horizon
        ));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
