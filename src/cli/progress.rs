//! A bar on standard error while something takes long; none where that is no terminal, or unwanted.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::{
    sync::{Mutex, PoisonError},
    time::Duration,
};
use voussoir::{
    analysis::Watched,
    dynamics::{Fidelity, Progress},
};

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

/// What a question is at, for as long as it lasts: what is known already, and what is being done. Where it
/// is interrupted the line stays.
pub struct Watching(());

/// The line of the question that is asked, what is known of its answer, and what is being done.
static WATCHED: Mutex<Option<(ProgressBar, String, String)>> = Mutex::new(None);

/// Short questions show no line.
const PATIENCE: Duration = Duration::from_millis(700);

impl Watching {
    /// A line on standard error, where that is a terminal.
    pub fn begin() -> Self {
        let line = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed:>4} {wide_msg}") {
            line.set_style(style);
        }
        *Self::line() = Some((line, String::new(), "solving".into()));
        std::thread::spawn(|| {
            std::thread::sleep(PATIENCE);
            if let Some((line, known, doing)) = &*Self::line() {
                line.enable_steady_tick(TICK);
                line.set_message(told(known, doing));
            }
        });
        Self(())
    }

    fn line() -> std::sync::MutexGuard<'static, Option<(ProgressBar, String, String)>> {
        WATCHED.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Hears of the work.
    pub fn hear(watched: Watched) {
        let Some((line, known, doing)) = &mut *Self::line() else { return };
        match watched {
            Watched::Known(text) => *known = text,
            Watched::Doing(text) => *doing = text,
        }
        if line.elapsed() > PATIENCE {
            line.set_message(told(known, doing));
        }
    }
}

fn told(known: &str, doing: &str) -> String {
    if known.is_empty() { doing.into() } else { format!("{known}; {doing}") }
}

impl Drop for Watching {
    fn drop(&mut self) {
        if let Some((line, ..)) = Self::line().take() {
            line.finish_and_clear();
        }
    }
}
