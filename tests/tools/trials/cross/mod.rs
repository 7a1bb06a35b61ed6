//! Thousands of random scenes, each asked in several ways that must give one answer.
//!
//! There is no closed form for these scenes, but there is for what happens to their answers: a
//! stranger beside a scene changes nothing (`stranger`), nor does the place where the scene stands;
//! up to the load factor with dry friction it stands, beyond the bound it falls; and more of the
//! same load does not raise again what it has brought down. Only answers whose proofs hold from the
//! scene alone count; what is computed, not proved, is that the state rests up to a load factor
//! with dry friction, and that counts as well.

mod answers;
mod scenes;
mod stranger;
mod told;
mod ways;

pub use answers::Answers;
pub use scenes::{FAMILIES, scene};
pub use stranger::{COLUMN, STRANGERS, Stranger, beside, moved, rough};
pub use ways::Variation;

use super::soak::FAILED;
use analysis::Outcome;
use base::error::RowsError;
use check::verdict::Verdict;
use scene::Scene;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    time::Instant,
};
use sweep::keep::{Kept, Numbered, numbered};
pub use told::text;

/// One scene in so many is simulated below and above its load factor.
pub const EVERY_SIMULATED: usize = 25;

/// What came of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Crossed {
    /// Its number.
    pub index: usize,
    /// Its family.
    pub family: String,
    /// Blocks.
    pub blocks: usize,
    /// Its verdict, where its certificate proves it; "undecided" otherwise.
    pub verdict: Verdict,
    /// What became of its load factor, likewise.
    pub outcome: Outcome,
    /// The bound on its load factor.
    pub bound: Option<f64>,
    /// Its load factor with dry friction.
    pub dry: Option<f64>,
    /// Other ways in which it was asked.
    pub ways: usize,
    /// Unions asked, and those whose answers are the same to the last bit.
    pub unions: [usize; 2],
    /// PartMethods in which an answer stayed open that is known otherwise.
    pub lost: Vec<Differs>,
    /// Contradictions.
    pub wrong: Vec<Differs>,
    /// Simulations, and those that agree.
    pub simulated: [usize; 2],
    /// Simulations that do not.
    pub apart: Vec<Differs>,
    /// Why the scene was refused, or that the program failed.
    pub error: Option<String>,
    /// Seconds.
    pub seconds: f64,
}

/// A way in which a scene was asked, and what came out against what was known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Differs {
    /// The way.
    pub way: Variation,
    /// In words.
    pub what: String,
}

impl Numbered for Crossed {
    fn number(&self) -> usize {
        self.index
    }
}

impl Crossed {
    /// A contradiction, or a failure of the program.
    pub fn is_wrong(&self) -> bool {
        !self.wrong.is_empty() || self.error.as_deref().is_some_and(|e| e.starts_with(FAILED))
    }
}

/// The file in which the scenes of a seed are kept.
///
/// # Errors
/// As [`Kept::open`].
pub fn keep(path: &Path, seed: u64) -> Result<Kept<Crossed>, RowsError> {
    Kept::open(path, "voussoir-cross/3", json!({ "seed": seed }))
}

/// Asks scenes number 0 to `count`, on all threads, but for those that are kept already; each is
/// kept as it ends, where there is a file, and `each` hears of it.
///
/// # Errors
/// Threads cannot be started, or the file cannot be written.
pub fn run(
    seed: u64,
    count: usize,
    kept: Option<&Kept<Crossed>>,
    each: impl Fn(&Crossed) + Sync,
) -> Result<Vec<Crossed>, RowsError> {
    numbered(count, kept, |index| one(seed, index), each)
}

/// Asks one scene in all ways.
pub fn one(seed: u64, index: usize) -> Crossed {
    let start = Instant::now();
    let mut crossed = Crossed {
        index,
        family: FAMILIES[index % FAMILIES.len()].into(),
        blocks: 0,
        verdict: Verdict::Undecided,
        outcome: Outcome::Undecided,
        bound: None,
        dry: None,
        ways: 0,
        unions: [0; 2],
        lost: Vec::new(),
        wrong: Vec::new(),
        simulated: [0; 2],
        apart: Vec::new(),
        error: None,
        seconds: 0.0,
    };
    // A mistake in the program is what this is for: it costs one scene.
    let asked = catch_unwind(AssertUnwindSafe(|| {
        scene(seed, index).and_then(|(scene, _)| ways::ask(&scene, index, &mut crossed))
    }));
    crossed.error = match asked {
        Ok(Ok(())) => None,
        Ok(Err(e)) => Some(e.to_string()),
        Err(_) => Some(format!("{FAILED} on this scene")),
    };
    crossed.seconds = start.elapsed().as_secs_f64();
    crossed
}

/// The scenes of all contradictions, each as it was asked, with a name for its file.
pub fn scenes(seed: u64, list: &[Crossed]) -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    for crossed in list.iter().filter(|c| c.is_wrong()) {
        let Ok((own, _)) = scene(seed, crossed.index) else { continue };
        let name = |way: &str| format!("cross-{seed}-{}-{way}.json", crossed.index);
        scenes.extend(crossed.wrong.iter().map(|d| (name(&d.way.word()), d.way.scene(&own))));
        scenes.push((name("alone"), own));
    }
    scenes.sort_by(|a, b| a.0.cmp(&b.0));
    scenes.dedup_by(|a, b| a.0 == b.0);
    scenes
}

/// The sums over some scenes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrossCount {
    /// Scenes.
    pub scenes: usize,
    /// Stand.
    pub stable: usize,
    /// Stand only with self-stress.
    pub conditional: usize,
    /// Fall.
    pub unstable: usize,
    /// Stayed open.
    pub undecided: usize,
    /// Were refused with an error.
    pub refused: usize,
    /// With a bound on the load factor.
    pub bounds: usize,
    /// With a load factor with dry friction.
    pub dry: usize,
    /// Other ways asked.
    pub ways: usize,
    /// Open that way, known otherwise.
    pub lost: usize,
    /// Unions.
    pub unions: usize,
    /// Of those, with the same answers to the last bit.
    pub same: usize,
    /// Contradictions and failures.
    pub wrong: usize,
    /// Simulated.
    pub simulated: usize,
    /// Of those, in agreement.
    pub agree: usize,
    /// In disagreement; the others stayed open.
    pub apart: usize,
}

/// Counts the scenes for which `of` holds.
pub fn count(list: &[Crossed], of: impl Fn(&Crossed) -> bool) -> CrossCount {
    let mut c = CrossCount::default();
    for s in list.iter().filter(|s| of(s)) {
        c.scenes += 1;
        match s.verdict {
            _ if s.error.is_some() => c.refused += 1,
            Verdict::Stable => c.stable += 1,
            Verdict::Conditional => c.conditional += 1,
            Verdict::Unstable => c.unstable += 1,
            Verdict::Undecided => c.undecided += 1,
        }
        c.bounds += usize::from(s.bound.is_some());
        c.dry += usize::from(s.dry.is_some());
        c.ways += s.ways;
        c.lost += s.lost.len();
        (c.unions, c.same) = (c.unions + s.unions[0], c.same + s.unions[1]);
        c.wrong += usize::from(s.is_wrong());
        (c.simulated, c.agree, c.apart) =
            (c.simulated + s.simulated[0], c.agree + s.simulated[1], c.apart + s.apart.len());
    }
    c
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{
        fs,
        sync::atomic::{AtomicUsize, Ordering},
    };

    #[test]
    fn it_goes_on_where_it_was_stopped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cross.jsonl");
        let asked = || {
            let kept = keep(&path, 1).unwrap();
            let fresh = AtomicUsize::new(0);
            let count_it = |_: &Crossed| {
                fresh.fetch_add(1, Ordering::Relaxed);
            };
            let list = run(1, 6, Some(&kept), count_it).unwrap();
            (fresh.into_inner(), list)
        };
        let (fresh, whole) = asked();
        assert_eq!((fresh, whole.len()), (6, 6));
        let text = fs::read(&path).unwrap();
        fs::write(&path, &text[..text.len() / 2]).unwrap();
        let lines = text[..text.len() / 2].iter().filter(|b| **b == b'\n').count() - 1;
        let (fresh, list) = asked();
        assert_eq!((fresh, list.len()), (6 - lines, 6));
        for (a, b) in list.iter().zip(&whole) {
            assert_eq!(
                Crossed { seconds: 0.0, ..a.clone() },
                Crossed { seconds: 0.0, ..b.clone() }
            );
        }
    }

    #[test]
    fn a_contradiction_is_named_and_its_scenes_can_be_written() {
        let way = Variation::Beside { stranger: Stranger::Soft, before: true };
        let wrong = Crossed {
            wrong: vec![Differs { way, what: "Stable instead of Conditional".into() }],
            ..one(1, 4)
        };
        assert!(wrong.is_wrong() && count(std::slice::from_ref(&wrong), |_| true).wrong == 1);
        let written = scenes(1, &[wrong]);
        let names: Vec<&str> = written.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["cross-1-4-alone.json", "cross-1-4-soft-before.json"]);
        assert_eq!(written[1].1.blocks.len(), written[0].1.blocks.len() + COLUMN + 1);
        // A failure of the program counts as well, a scene that is refused does not.
        let failed = |error: &str| Crossed { error: Some(error.into()), ..one(1, 4) };
        assert!(
            failed(&format!("{FAILED} on this scene")).is_wrong()
                && !failed("no friction is given").is_wrong()
        );
    }
}
