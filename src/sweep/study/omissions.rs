//! What leaving things out saves, and that the answer stays the same.

use super::Known;
use analysis::{Control, Law, limit};
use base::error::InputError;
use model::interface::prepare;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// One scene with and without omissions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Omission {
    /// The scene.
    pub scene: String,
    /// What was left out.
    pub left_out: Vec<String>,
    /// Unknowns of the largest program: with omissions, and with everything kept.
    pub unknowns: [usize; 2],
    /// Seconds, the same.
    pub seconds: [f64; 2],
    /// Load factors, the same; `None` where none was found.
    pub values: [Option<f64>; 2],
}

impl Omission {
    /// Relative difference of the two answers; `None` where one is missing.
    pub fn difference(&self) -> Option<f64> {
        let [Some(a), Some(b)] = self.values else { return None };
        Some((a - b).abs() / a.abs())
    }
}

/// Asks for the load factor of each scene with and without omissions; medians of `repeat` runs.
///
/// # Errors
/// A scene cannot be resolved.
pub fn omissions(
    scenes: &[Known],
    repeat: usize,
    mut each: impl FnMut(),
) -> Result<Vec<Omission>, InputError> {
    scenes
        .iter()
        .map(|known| {
            let model = prepare(&known.scene)?;
            let mut one = Omission {
                scene: known.name.into(),
                left_out: Vec::new(),
                unknowns: [0; 2],
                seconds: [0.0; 2],
                values: [None; 2],
            };
            for (k, keep_all) in [false, true].into_iter().enumerate() {
                let control = Control { law: Law::Associative, keep_all, ..Control::default() };
                let mut times = Vec::new();
                for _ in 0..repeat.max(1) {
                    let start = Instant::now();
                    let answer = limit(&model, &control);
                    times.push(start.elapsed().as_secs_f64());
                    one.values[k] = answer.value;
                    one.unknowns[k] = answer.attempts.iter().map(|a| a.size[0]).max().unwrap_or(0);
                    if !keep_all {
                        one.left_out.clone_from(&answer.left_out);
                    }
                }
                times.sort_by(f64::total_cmp);
                one.seconds[k] = times[times.len() / 2];
                each();
            }
            Ok(one)
        })
        .collect()
}
