//! Forging results: every result of many random scenes is changed into claims that are false, and
//! each must be refused.
//!
//! A forgery is false by construction: the honest result is proved, and what the forged one says
//! excludes it (`words`, `numbers`, `opposite`, `factors`). Forgeries that leave a true claim
//! (other forces for the same verdict) are not made. None may be called proved.

mod edit;
mod factors;
mod forgery;
mod honest;
mod numbers;
mod opposite;
mod words;

use crate::{
    keep::{Kept, Numbered, numbered},
    study::{
        cross::{FAMILIES, Stranger, beside, scene},
        random::Random,
        soak::FAILED,
    },
};
use analysis::recompute::Solvers;
use base::error::RowsError;
use check::proof::{read::read_str, verify::verify_model};
use forgery::Forgery;
use honest::Honest;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    time::Instant,
};

/// What became of the forgeries of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Forged {
    /// The number of the scene.
    pub index: usize,
    /// Its family.
    pub family: String,
    /// Honest results that are proved, by question.
    pub results: BTreeMap<String, usize>,
    /// Forgeries by kind.
    pub made: BTreeMap<String, usize>,
    /// Forgeries that were called proved.
    pub accepted: Vec<Accepted>,
    /// Why the scene was refused, or that the program failed.
    pub error: Option<String>,
    /// Seconds.
    pub seconds: f64,
    /// Seconds of them for the verification of forgeries.
    pub verifying: f64,
}

/// A forgery that was called proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accepted {
    /// The question.
    pub question: String,
    /// The kind of the forgery.
    pub kind: String,
    /// What is false in it.
    pub what: String,
}

impl Numbered for Forged {
    fn number(&self) -> usize {
        self.index
    }
}

impl Forged {
    /// A forgery was accepted, or the program failed.
    pub fn is_wrong(&self) -> bool {
        !self.accepted.is_empty() || self.error.as_deref().is_some_and(|e| e.starts_with(FAILED))
    }

    /// Forgeries made.
    pub fn count(&self) -> usize {
        self.made.values().sum()
    }
}

/// The file in which the scenes of a seed are kept.
///
/// # Errors
/// As [`Kept::open`].
pub fn keep(path: &Path, seed: u64) -> Result<Kept<Forged>, RowsError> {
    Kept::open(path, "voussoir-forge/1", json!({ "seed": seed }))
}

/// Forges the results of scenes number 0 to `count`, on all threads, but for those that are kept
/// already; each is kept as it ends, where there is a file, and `each` hears of it.
///
/// # Errors
/// Threads cannot be started, or the file cannot be written.
pub fn run(
    seed: u64,
    count: usize,
    kept: Option<&Kept<Forged>>,
    each: impl Fn(&Forged) + Sync,
) -> Result<Vec<Forged>, RowsError> {
    numbered(count, kept, |index| one(seed, index), each)
}

/// Forges the results of one scene.
pub fn one(seed: u64, index: usize) -> Forged {
    forge(seed, index, |_, _, _| {})
}

/// The forgeries that were accepted, as files, each with a name.
pub fn files(seed: u64, list: &[Forged]) -> Vec<(String, Value)> {
    let mut files = Vec::new();
    for forged in list.iter().filter(|f| !f.accepted.is_empty()) {
        forge(seed, forged.index, |honest, forgery, number| {
            files.push((
                format!(
                    "forged-{seed}-{}-{number}-{}-{}.json",
                    forged.index, honest.name, forgery.kind
                ),
                forgery.file.clone(),
            ));
        });
    }
    files
}

fn forge(seed: u64, index: usize, mut accepted: impl FnMut(&Honest, &Forgery, usize)) -> Forged {
    let start = Instant::now();
    let mut forged = Forged {
        index,
        family: FAMILIES[index % FAMILIES.len()].into(),
        results: BTreeMap::new(),
        made: BTreeMap::new(),
        accepted: Vec::new(),
        error: None,
        seconds: 0.0,
        verifying: 0.0,
    };
    // A mistake in the program is what this is for: it costs one scene.
    let done = catch_unwind(AssertUnwindSafe(|| {
        let random = &mut Random::apart(seed ^ 0x466f_7267, index);
        for honest in honest(seed, index)? {
            *forged.results.entry(honest.name.into()).or_default() += 1;
            let all = [
                words::forge(&honest),
                numbers::forge(&honest, random),
                opposite::forge(&honest, random),
                factors::forge(&honest, random),
            ];
            for forgery in all.into_iter().flatten() {
                *forged.made.entry(forgery.kind.into()).or_default() += 1;
                let begin = Instant::now();
                if is_proved(&honest, &forgery.file) {
                    accepted(&honest, &forgery, forged.count());
                    let (kind, what) = (forgery.kind.into(), forgery.what);
                    forged.accepted.push(Accepted { question: honest.name.into(), kind, what });
                }
                forged.verifying += begin.elapsed().as_secs_f64();
            }
        }
        Ok::<_, base::error::InputError>(())
    }));
    forged.error = match done {
        Ok(Ok(())) => None,
        Ok(Err(e)) => Some(e.to_string()),
        Err(_) => Some(format!("{FAILED} on this scene")),
    };
    forged.seconds = start.elapsed().as_secs_f64();
    forged
}

/// The proved results of a scene: every third has a heavy stranger beside it, every third a light
/// one, behind whose forces there is room to hide something.
fn honest(seed: u64, index: usize) -> Result<Vec<Honest>, base::error::InputError> {
    let (own, _) = scene(seed, index)?;
    let turn = index / FAMILIES.len();
    let stranger = [None, Some(Stranger::Heavy), Some(Stranger::Light)][turn % 3];
    let scene = match stranger {
        None => own,
        Some(stranger) => {
            let model = model::interface::prepare(&own)?;
            let masses: Vec<f64> =
                model.assembly.free().map(|i| model.assembly.blocks[i].mass).collect();
            beside(&own, &masses, stranger, turn.is_multiple_of(2))
        }
    };
    honest::results(&scene, turn)
}

/// Whether a file is called proved. One that cannot be read is not.
fn is_proved(honest: &Honest, file: &Value) -> bool {
    let Ok(file) = read_str("forged", file.to_string()) else { return false };
    verify_model(&file, &honest.scene, &honest.model, &Solvers).proved()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn honest_results_are_proved_after_a_round_through_their_text() {
        for index in 0..10 {
            for honest in honest(2, index).unwrap() {
                let text = honest.file.to_string();
                assert!(
                    is_proved(&honest, &serde_json::from_str(&text).unwrap()),
                    "{index}: {}",
                    honest.name
                );
            }
        }
    }

    #[test]
    fn no_forgery_is_accepted() {
        for index in [0, 3, 9, 15, 19] {
            let forged = one(1, index);
            assert!(
                forged.count() > 50 && !forged.is_wrong(),
                "{index}: {:?} {:?}",
                forged.error,
                forged.accepted
            );
        }
    }
}
