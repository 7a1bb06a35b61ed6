//! Forging results: every result of many random scenes, of every kind of question, is changed, and
//! none that then says something false may be called proved.
//!
//! What is changed: leaves of the answer, one or several; of the question; of the evidence and of the
//! scene, with the answer that follows from it, as a forger who knows the program would have it. A
//! changed answer is false, for it is not what follows. What follows from changed evidence, question
//! or scene may be true: that is decided by asking anew. Beside them evidence is made for the opposite
//! of what is proved, and for other load factors: rates whose squares vanish or overflow, forces that
//! absorb the loads in their rounding, that pull, that cancel in pairs.

mod draft;
mod factors;
mod honest;
mod mutate;
mod opposite;
mod told;

pub use told::text;

use crate::{
    cross::{FAMILIES, Stranger, beside, scene},
    random::Random,
    soak::FAILED,
};
use analysis::recompute::Solvers;
use base::error::RowsError;
use check::proof::{read::read_str, verify::verify_model};
use honest::Honest;
use model::interface::prepare;
use mutate::{Part, mutate};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    time::Instant,
};
use sweep::keep::{Kept, Numbered, numbered};

/// Forgeries of each result.
const EACH: usize = 24;

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
    forge(seed, index, |_, _, _, _| {})
}

/// The forgeries that were accepted, as files, each with a name.
pub fn files(seed: u64, list: &[Forged]) -> Vec<(String, Value)> {
    let mut files = Vec::new();
    for forged in list.iter().filter(|f| !f.accepted.is_empty()) {
        forge(seed, forged.index, |honest, kind, file, number| {
            let index = forged.index;
            let name = format!("forged-{seed}-{index}-{number}-{}-{kind}.json", honest.name);
            files.push((name, file.clone()));
        });
    }
    files
}

fn forge(
    seed: u64,
    index: usize,
    mut accepted: impl FnMut(&Honest, &str, &Value, usize),
) -> Forged {
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
            let mut held = |part: Part, kind: &str, what: String, file: &Value| {
                *forged.made.entry(kind.into()).or_default() += 1;
                let begin = Instant::now();
                if let Some(false_in) = lies(part, file) {
                    accepted(&honest, kind, file, forged.count());
                    let what = format!("{what}: {false_in}");
                    let (question, kind) = (honest.name.into(), kind.into());
                    forged.accepted.push(Accepted { question, kind, what });
                }
                forged.verifying += begin.elapsed().as_secs_f64();
            };
            for _ in 0..EACH {
                if let Some((part, what, file)) = mutate(&honest.file, random) {
                    held(part, part.word(), what, &file);
                }
            }
            // False by construction: what is proved excludes it.
            let made = opposite::forge(&honest, random);
            for forgery in made.into_iter().chain(factors::forge(&honest, random)) {
                held(Part::Answer, forgery.kind, forgery.what, &forgery.file);
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

/// What is false in a forged file that is called proved; nothing where it is refused, or true.
fn lies(part: Part, file: &Value) -> Option<String> {
    let saved = read_str("forged", file.to_string()).ok()?;
    let model = prepare(&saved.scene).ok()?;
    if !verify_model(&saved, &saved.scene, &model, &Solvers::default()).proved() {
        return None;
    }
    match part {
        // It is not what follows.
        Part::Answer => Some("accepted".into()),
        Part::Question | Part::Evidence | Part::Scene => {
            let here = honest::asked(&saved.question, &saved.scene, &model)?;
            contradiction(&proved_part(&file["answer"]), &proved_part(&here["answer"]), "")
        }
    }
}

/// An answer without values with dry friction that are computed: how far states were seen at rest
/// depends on the time that there was.
fn proved_part(answer: &Value) -> Value {
    let mut answer = answer.clone();
    let is_proved = match answer["dry"]["found"].as_str() {
        Some(found) => matches!(found, "fixed_point" | "nothing_slides"),
        None => true,
    };
    if !is_proved {
        answer["dry"].take();
        let bound = answer["load_factor"]["associative"].take();
        answer["load_factor"] = json!({ "associative": bound });
    }
    answer
}

/// Numbers of two answers to one question differ by less than this share.
const ALIKE: f64 = 2e-3;

/// Where one of two answers to the same question must be wrong: another verdict, another number.
fn contradiction(a: &Value, b: &Value, at: &str) -> Option<String> {
    let (Some(left), Some(right)) = (a.as_object(), b.as_object()) else { return None };
    for (key, x) in left {
        let (Some(y), here) = (right.get(key), format!("{at}/{key}")) else { continue };
        let other = match (key.as_str(), x, y) {
            ("verdict" | "status" | "fate", Value::String(x), Value::String(y)) => {
                x != y && x != "undecided" && y != "undecided"
            }
            ("value", Value::Number(x), Value::Number(y)) => {
                let [x, y] = [x, y].map(|n| n.as_f64().unwrap_or(f64::NAN));
                (x - y).abs() > ALIKE * x.abs().max(y.abs()).max(1e-3)
            }
            (_, Value::Object(_), Value::Object(_)) => match contradiction(x, y, &here) {
                Some(found) => return Some(found),
                None => false,
            },
            _ => false,
        };
        if other {
            return Some(format!("{here} is {y}"));
        }
    }
    None
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
            let model = prepare(&own)?;
            let masses: Vec<f64> =
                model.assembly.free().map(|i| model.assembly.blocks[i].mass).collect();
            beside(&own, &masses, stranger, turn.is_multiple_of(2))
        }
    };
    honest::results(&scene, turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_proved(file: &Value) -> bool {
        let saved = read_str("honest", file.to_string()).unwrap();
        let model = prepare(&saved.scene).unwrap();
        verify_model(&saved, &saved.scene, &model, &Solvers::default()).proved()
    }

    #[test]
    fn honest_results_are_proved_after_a_round_through_their_text() {
        for index in 0..10 {
            for honest in honest(2, index).unwrap() {
                let text = honest.file.to_string();
                assert!(
                    is_proved(&serde_json::from_str(&text).unwrap()),
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
                forged.count() > 40 && !forged.is_wrong(),
                "{index}: {} {:?} {:?}",
                forged.count(),
                forged.error,
                forged.accepted
            );
        }
    }
}
