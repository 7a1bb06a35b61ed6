//! A bar on standard error while something takes long; none where that is no terminal, or unwanted.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::Duration;
use voussoir::dynamics::{Fidelity, Progress};

/// A line is drawn again after this time.
const TICK: Duration = Duration::from_millis(200);

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
            "{:.2} of {:.2} s, displaced by {moved:.2} % of a block's thickness",
            progress.time, progress.horizon
        ));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A stage of work of which nobody knows how long it takes: its name, and for how long it lasts.
pub struct Stage(ProgressBar);

impl Stage {
    /// A line, hidden unless `shown` and on a terminal.
    pub fn begin(shown: bool, name: &'static str) -> Self {
        let target =
            if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let line = ProgressBar::with_draw_target(None, target);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
            line.set_style(style);
        }
        line.set_message(name);
        line.enable_steady_tick(TICK);
        Self(line)
    }

    /// What comes next.
    pub fn next(&self, name: &'static str) {
        self.0.set_message(name);
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
