//! What an answer cost.

use super::ResultFile;
use model::interface::Model;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// What an answer cost, beside the seconds per stage.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Work {
    /// Attempts at a program that stand in the trace.
    pub attempts: usize,
    /// Convex programs of the fixed points with dry friction.
    pub fixed_points: usize,
    /// Iterations of the engine over all attempts.
    pub iterations: usize,
    /// Force unknowns and equations before anything was left out: 3 per contact point, 6 per free
    /// block.
    pub full: [usize; 2],
    /// Unknowns and rows of the largest program that was tried.
    pub largest: [usize; 2],
    /// Width of the bracket of the answer.
    pub bracket: Option<f64>,
    /// Greatest resident memory of the process so far, bytes; where the system tells it.
    pub peak_memory: Option<u64>,
}

impl Work {
    /// The work behind a result.
    pub fn of(file: &ResultFile, model: &Model) -> Self {
        let points = model.contact_points();
        let largest =
            file.run.trace.iter().map(|a| a.size).max_by_key(|size| size[0]).unwrap_or_default();
        let ends = file.answer.bound().and_then(|l| Some((l.lower?, l.upper?)));
        let bracket = ends
            .or(file
                .answer
                .as_verdict()
                .map(|a| (a.equilibrium_error.lower, a.equilibrium_error.upper)))
            .map(|(lower, upper)| upper - lower);
        let states = file.run.state_steps.iter().map(|s| s.solves).sum::<usize>();
        let dry = file.run.dry_solves;
        Self {
            attempts: file.run.trace.len(),
            fixed_points: states + dry,
            iterations: file.run.trace.iter().map(|a| a.iterations).sum(),
            full: [3 * points, 6 * model.assembly.free().count()],
            largest,
            bracket: bracket.filter(|b| b.is_finite()),
            peak_memory: peak_memory(),
        }
    }
}

/// Linux tells it in `/proc`; elsewhere it is not known.
fn peak_memory() -> Option<u64> {
    let status = base::files::of_system("/proc/self/status")?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024 * kilobytes)
}
