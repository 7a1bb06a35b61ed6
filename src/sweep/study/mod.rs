//! Error against run time, on scenes whose answers are known.
//!
//! [`run`] takes each method over its knob (the engine's tolerance, the number of facets, the
//! number of bisections) and records what came out, how long it took, and what the engine said
//! about it. [`extreme`] asks some thousand stiff scenes with closed forms and counts what is
//! wrong, undecided or loosely bracketed. [`rocking`] has blocks on ground that moves; [`elastic`]
//! joints, beside the penalty method. [`experiments`] holds predictions against tests of
//! laboratories.

pub mod elastic;
pub mod experiments;
pub mod extreme;
mod known;
mod method;
mod omissions;
pub mod rocking;

pub use elastic::{ElasticCase, ElasticMethod, ElasticPoint, ElasticQuantity};
pub use known::Known;
pub use method::StudyMethod;
pub use omissions::{Omission, omissions};
pub use rocking::{RockingCase, RockingMethod, RockingPoint, RockingQuantity};

use base::error::InputError;
use serde::{Deserialize, Serialize};
use solve::Status;

/// One run of a method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyPoint {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: StudyMethod,
    /// Its knob.
    pub knob: f64,
    /// The load factor that came out; the engine's own number, where the method has no other.
    pub value: Option<f64>,
    /// |value − truth| / truth; `None` where nothing came out.
    pub error: Option<f64>,
    /// Width of the recomputed bracket over the truth, where there is one.
    pub bracket: Option<f64>,
    /// Seconds, the median of the repetitions; resolving the scene and finding its interfaces are
    /// not counted.
    pub seconds: f64,
    /// Iterations of the engine.
    pub iterations: usize,
    /// The engine's last word.
    pub status: Option<Status>,
}

impl StudyPoint {
    /// Whether the engine said "solved" of a number that is off by more than [`WRONG`], and by far
    /// more than the tolerance it was given.
    pub fn is_silently_wrong(&self) -> bool {
        let asked = if self.method.knob() == "tolerance" { 100.0 * self.knob } else { 0.0 };
        self.status == Some(Status::Solved) && self.error.is_some_and(|e| e > WRONG.max(asked))
    }
}

/// A relative error that nobody would call solved. Larger: percents pass. Smaller: honest runs with
/// a coarse tolerance count.
pub const WRONG: f64 = 1e-3;

/// Runs every method over its knob on the scenes; `each` hears of every point as it is done.
///
/// # Errors
/// A scene cannot be resolved.
pub fn run(
    scenes: &[Known],
    quick: bool,
    repeat: usize,
    mut each: impl FnMut(&StudyPoint),
) -> Result<Vec<StudyPoint>, InputError> {
    let mut points = Vec::new();
    for known in scenes {
        let model = model::interface::prepare(&known.scene)?;
        for method in StudyMethod::ALL {
            for knob in method.knobs(known, &model, quick) {
                let mut runs: Vec<StudyPoint> =
                    (0..repeat.max(1)).map(|_| method.run(known, &model, knob)).collect();
                runs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
                let point = runs.swap_remove(runs.len() / 2);
                each(&point);
                points.push(point);
            }
        }
    }
    Ok(points)
}

/// How many points [`run`] will make.
///
/// # Errors
/// A scene cannot be resolved.
pub fn count(scenes: &[Known], quick: bool) -> Result<usize, InputError> {
    let of = |known: &Known| {
        let model = model::interface::prepare(&known.scene)?;
        Ok(StudyMethod::ALL.iter().map(|m| m.knobs(known, &model, quick).len()).sum::<usize>())
    };
    scenes.iter().map(of).sum()
}

/// A performance profile (Dolan & Moré 2002): for each method, the share of scenes on which it
/// reaches `error` within `ratio` times the time of the fastest method that does, at each ratio.
pub fn profile(points: &[StudyPoint], error: f64, ratios: &[f64]) -> Vec<(StudyMethod, Vec<f64>)> {
    let mut scenes: Vec<&str> = points.iter().map(|p| p.scene.as_str()).collect();
    scenes.sort_unstable();
    scenes.dedup();
    let time = |scene: &str, method: Option<StudyMethod>| {
        points
            .iter()
            .filter(|p| {
                p.scene == scene
                    && method.is_none_or(|m| p.method == m)
                    && p.error.is_some_and(|e| e <= error)
            })
            .map(|p| p.seconds)
            .fold(f64::INFINITY, f64::min)
    };
    StudyMethod::ALL
        .into_iter()
        .filter(|m| points.iter().any(|p| p.method == *m))
        .map(|m| {
            let slower: Vec<f64> =
                scenes.iter().map(|s| time(s, Some(m)) / time(s, None)).collect();
            let share =
                |r: &f64| slower.iter().filter(|s| **s <= *r).count() as f64 / scenes.len() as f64;
            (m, ratios.iter().map(share).collect())
        })
        .collect()
}
