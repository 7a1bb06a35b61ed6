//! Thousands of random scenes: every verdict is held against its certificate, some against
//! omissions, some against a simulation.
//!
//! There is no closed form for these scenes, but a verdict that is wrong would have to come with a
//! proof that is wrong as well: forces that balance and a motion that nothing stops exclude each
//! other. So each claim is verified from the scene alone, the same scene is solved once more with
//! everything kept ([`EVERY_KEPT`]), and a sample is run in time ([`EVERY_SIMULATED`]), near limits
//! by fine steps.

mod scenes;
mod told;

pub use scenes::{FAMILIES, scene};

use analysis::{Control, Law, agreement, assess};
use base::error::{FindingCode, RowsError};
use check::verdict::Verdict;
use dynamics::Fate;
use model::interface::{Model, prepare};
use serde::{Deserialize, Serialize};
use serde_json::json;
use solve::deadline::Deadline;
use std::{
    ops::ControlFlow,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    time::Instant,
};
use sweep::keep::{Kept, Numbered, numbered};
pub use told::text;

/// One scene in so many is solved once more without omissions.
pub const EVERY_KEPT: usize = 10;
/// One scene in so many is simulated.
pub const EVERY_SIMULATED: usize = 25;
/// Scenes within this of a flip, in multiples of gravity sideways, are said to be near one where
/// verdict and simulation differ.
const NEAR: f64 = 0.03;
/// A scene may take so many seconds; more counts as undecided.
const SECONDS: f64 = 60.0;

/// What was done to a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Perturbation {
    /// Every free block was moved by up to 1e-8 to 1e-2 m (blocks are some decimetres large).
    Gaps,
    /// Every free block was turned by 1e-8 to 1e-2 rad.
    Rotations,
    /// One to three blocks are missing.
    Missing,
    /// A part of all weights acts sideways.
    Pushed,
    /// Densities differ by up to a thousand.
    Uneven,
    /// The whole scene was turned, moved and scaled.
    Moved,
}

/// Why verdict and simulation may say different things.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Difference {
    /// The verdict is another with a little more weight sideways: within what a simulation can
    /// tell.
    NearAFlip,
    /// Blocks overlap or nearly touch by more than the tolerance. Of these no contact is made, and
    /// that is said; in time they meet.
    ContactLeftOut,
    /// Neither.
    Unexplained,
}

/// What came of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Soaked {
    /// Its number.
    pub index: usize,
    /// Its family.
    pub family: String,
    /// What was done to it.
    pub perturbations: Vec<Perturbation>,
    /// Blocks.
    pub blocks: usize,
    /// What the program says: the verdict where its certificate proves it from the scene alone,
    /// "undecided" otherwise; `None` where the scene was refused.
    pub verdict: Option<Verdict>,
    /// The verdict whose certificate did not prove it, where there was one.
    pub unproved: Option<Verdict>,
    /// The verdict with everything kept, where it was asked.
    pub kept: Option<Verdict>,
    /// What the simulation showed, where one was run.
    pub fate: Option<Fate>,
    /// Whether verdict and simulation say the same.
    pub agrees: Option<bool>,
    /// Why not, where they differ.
    pub difference: Option<Difference>,
    /// Why the scene was refused, or that the program failed.
    pub error: Option<String>,
    /// Seconds.
    pub seconds: f64,
}

impl Numbered for Soaked {
    fn number(&self) -> usize {
        self.index
    }
}

impl Soaked {
    /// Two proofs that exclude each other, or a failure of the program.
    pub fn is_wrong(&self) -> bool {
        let claims = |v: Option<Verdict>| v.is_some_and(|v| v != Verdict::Undecided);
        let apart = claims(self.verdict) && claims(self.kept) && self.verdict != self.kept;
        apart || self.error.as_deref().is_some_and(|e| e.starts_with(FAILED))
    }
}

/// How the error of a scene begins on which the program itself failed.
pub const FAILED: &str = "the program failed";

/// The file in which the scenes of a seed are kept.
///
/// # Errors
/// As [`Kept::open`].
pub fn keep(path: &Path, seed: u64) -> Result<Kept<Soaked>, RowsError> {
    Kept::open(path, "voussoir-soak/1", json!({ "seed": seed }))
}

/// Asks scenes number 0 to `count`, on all threads, but for those that are kept already; each is
/// kept as it ends, where there is a file, and `each` hears of it.
///
/// # Errors
/// Threads cannot be started, or the file cannot be written.
pub fn run(
    seed: u64,
    count: usize,
    kept: Option<&Kept<Soaked>>,
    each: impl Fn(&Soaked) + Sync,
) -> Result<Vec<Soaked>, RowsError> {
    numbered(count, kept, |index| one(seed, index), each)
}

/// Asks one scene.
pub fn one(seed: u64, index: usize) -> Soaked {
    let start = Instant::now();
    let mut soaked = Soaked {
        index,
        family: FAMILIES[index % FAMILIES.len()].into(),
        perturbations: Vec::new(),
        blocks: 0,
        verdict: None,
        unproved: None,
        kept: None,
        fate: None,
        agrees: None,
        difference: None,
        error: None,
        seconds: 0.0,
    };
    // A mistake in the program is what this is for: it costs one scene.
    if catch_unwind(AssertUnwindSafe(|| ask(seed, index, &mut soaked))).is_err() {
        soaked.error = Some(format!("{FAILED} on this scene"));
    }
    soaked.seconds = start.elapsed().as_secs_f64();
    soaked
}

fn ask(seed: u64, index: usize, soaked: &mut Soaked) {
    let prepared = scene(seed, index).and_then(|(scene, _, perturbations)| {
        soaked.perturbations = perturbations;
        prepare(&scene)
    });
    let model = match prepared {
        Ok(model) => model,
        Err(e) => return soaked.error = Some(e.to_string()),
    };
    let (model, assembly) = (&model, &model.assembly);
    let control =
        Control { law: Law::Coulomb, deadline: Deadline::within(SECONDS), ..Control::default() };
    let answer = assess(model, &control);
    soaked.blocks = assembly.blocks.len();
    soaked.verdict = Some(answer.verdict);
    soaked.unproved = answer.refused().and_then(|claim| claim.verdict());
    if index.is_multiple_of(EVERY_KEPT) {
        soaked.kept = Some(assess(model, &Control { keep_all: true, ..control }).verdict);
    }
    if index.is_multiple_of(EVERY_SIMULATED)
        && let Ok(outcome) =
            dynamics::simulate(model, &dynamics::SimulationSettings::default(), &mut |_| {
                ControlFlow::Continue(())
            })
    {
        let found = agreement(model, &answer, &outcome);
        (soaked.fate, soaked.agrees) = (Some(outcome.fate), found.agrees);
        if found.agrees == Some(false) {
            let apart = |code| matches!(code, FindingCode::Overlap | FindingCode::NearMiss);
            soaked.difference = Some(match () {
                () if model.findings().any(|f| apart(f.code)) => Difference::ContactLeftOut,
                () if is_near_a_flip(model, answer.verdict, &control) => Difference::NearAFlip,
                () => Difference::Unexplained,
            });
        }
    }
}

/// Whether the verdict is another with [`NEAR`] × the weight added sideways, one way or another.
fn is_near_a_flip(model: &Model, verdict: Verdict, control: &Control) -> bool {
    let assembly = &model.assembly;
    let down = assembly.gravity.normalize();
    check::question::spread(assembly.gravity, 8).into_iter().any(|d| {
        let mut pushed = assembly.clone();
        for i in assembly.free() {
            let weight = assembly.blocks[i].mass * assembly.gravity.norm();
            // Less weight as well: what falls because it is pushed may stand without.
            pushed.dead[i].force += (d - 0.1 * down) * (NEAR * weight);
        }
        assess(&Model::new(pushed, model.interfaces.clone()), control).verdict != verdict
    })
}

/// The sums over some scenes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SoakCount {
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
    /// Of the open ones, verdicts whose certificate did not prove them.
    pub unproved: usize,
    /// Contradictions and failures.
    pub wrong: usize,
    /// Simulated.
    pub simulated: usize,
    /// Of those, in agreement.
    pub agree: usize,
    /// Simulated, and either stayed open.
    pub open: usize,
    /// In disagreement near a flip.
    pub near: usize,
    /// In disagreement where contacts were left out, with a word.
    pub left_out: usize,
    /// In disagreement elsewhere.
    pub disagree: usize,
}

/// Counts the scenes for which `of` holds.
pub fn count(list: &[Soaked], of: impl Fn(&Soaked) -> bool) -> SoakCount {
    let mut c = SoakCount::default();
    for s in list.iter().filter(|s| of(s)) {
        c.scenes += 1;
        match s.verdict {
            Some(Verdict::Stable) => c.stable += 1,
            Some(Verdict::Conditional) => c.conditional += 1,
            Some(Verdict::Unstable) => c.unstable += 1,
            Some(Verdict::Undecided) => c.undecided += 1,
            None => c.refused += 1,
        }
        c.unproved += usize::from(s.unproved.is_some());
        c.wrong += usize::from(s.is_wrong());
        c.simulated += usize::from(s.fate.is_some());
        match (s.fate, s.agrees, s.difference) {
            (None, ..) => {}
            (_, None, _) => c.open += 1,
            (_, Some(true), _) => c.agree += 1,
            (_, Some(false), Some(Difference::NearAFlip)) => c.near += 1,
            (_, Some(false), Some(Difference::ContactLeftOut)) => c.left_out += 1,
            (_, Some(false), _) => c.disagree += 1,
        }
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

    fn asked(path: &Path, count: usize) -> (usize, Vec<Soaked>) {
        let kept = keep(path, 1).unwrap();
        let fresh = AtomicUsize::new(0);
        let count_it = |_: &Soaked| {
            fresh.fetch_add(1, Ordering::Relaxed);
        };
        let list = run(1, count, Some(&kept), count_it).unwrap();
        (fresh.into_inner(), list)
    }

    #[test]
    fn a_soak_goes_on_where_it_was_stopped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("soak.jsonl");
        let (fresh, whole) = asked(&path, 14);
        assert_eq!((fresh, whole.len()), (14, 14));
        let text = fs::read(&path).unwrap();
        // What is whole is kept to the bit, seconds included, and the rest is asked.
        fs::write(&path, &text[..text.len() / 2]).unwrap();
        let lines = text[..text.len() / 2].iter().filter(|b| **b == b'\n').count() - 1;
        let (fresh, list) = asked(&path, 14);
        assert_eq!((fresh, list.len()), (14 - lines, 14));
        assert!(list.iter().zip(&whole).filter(|(a, b)| a == b).count() >= lines);
        for (a, b) in list.iter().zip(&whole) {
            assert_eq!(Soaked { seconds: 0.0, ..a.clone() }, Soaked { seconds: 0.0, ..b.clone() });
        }
        // More scenes go on from fewer, and fewer need nothing.
        assert_eq!(asked(&path, 16).0, 2);
        assert_eq!((asked(&path, 3).0, asked(&path, 3).1.len()), (0, 3));
    }

    #[test]
    fn a_short_soak_has_nothing_wrong() {
        let list = run(1, 70, None, |_| {}).unwrap();
        let all = count(&list, |_| true);
        assert_eq!(
            (all.scenes, all.wrong),
            (70, 0),
            "{:?}",
            list.iter().filter(|s| s.is_wrong()).collect::<Vec<_>>()
        );
        assert!(all.stable > 5 && all.unstable > 5, "{all:?}");
        assert_eq!(all.stable + all.conditional + all.unstable + all.undecided + all.refused, 70);
        // Numbers of a scene do not depend on the threads.
        let again = Soaked { seconds: 0.0, ..one(1, 25) };
        assert_eq!(again, Soaked { seconds: 0.0, ..list[25].clone() });
    }

    #[test]
    fn two_proofs_that_differ_are_wrong() {
        let good = Soaked { error: None, ..one(1, 0) };
        assert!(!good.is_wrong());
        assert!(
            Soaked {
                verdict: Some(Verdict::Stable),
                kept: Some(Verdict::Unstable),
                ..good.clone()
            }
            .is_wrong()
        );
        assert!(Soaked { error: Some(format!("{FAILED}: x")), ..good.clone() }.is_wrong());
        assert!(
            !Soaked { verdict: Some(Verdict::Undecided), kept: Some(Verdict::Stable), ..good }
                .is_wrong()
        );
    }
}
