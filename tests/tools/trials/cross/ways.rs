//! The ways in which a scene is asked, and what each must answer.

use super::{
    Answers, Crossed, Differs, EVERY_SIMULATED,
    answers::{control, verdict},
    stranger::{STRANGERS, Stranger, beside, moved, rough},
};
use analysis::{Agreement, Outcome, agreement, assess};
use base::error::InputError;
use check::verdict::{Verdict, claim};
use dynamics::Fate;
use model::interface::{Model, prepare};
use scene::Scene;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Where surveyors' coordinates are, m.
const SURVEY: [f64; 3] = [5e5, 5e6, 2e2];
/// Scenes smaller than this, m, are not moved there: their contacts are below what coordinates of
/// that size can tell.
const LEAST_SURVEYED: f64 = 0.5;

/// Shares of the load factor at which a scene is asked on the way. Just below the value and just
/// above come on their own.
const ON_THE_WAY: [f64; 10] = [0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85, 0.95];
const BELOW: f64 = 0.99;
const ABOVE: f64 = 1.01;
/// Shares at which the simulation is asked: it errs by some percents near a limit.
const SIMULATED: [f64; 2] = [0.95, 1.05];

/// Bounds of two ways differ by less than this × their size. They are proved in brackets 1e-6 wide
/// or narrower.
const SAME_BOUND: f64 = 1e-5;
/// Load factors with dry friction differ by less than this × their size. The law holds at them to a
/// natural map of some 1e-5.
const SAME_DRY: f64 = 1e-3;
/// What coordinates rounded to 1e-9 m may change in a bound, over its size.
const MOVED_BOUND: f64 = 1e-4;
/// The load factor with dry friction passes the proved bound by no more than this × its size.
const BEYOND: f64 = 1e-9;
/// Load factors below this × (dead / live load) are none: grains in a pile that is no wider at its
/// foot fall under any push, and their load factors are what forces may be off balance.
const NONE: f64 = 1e-7;

/// A way in which a scene is asked.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Variation {
    /// As it is.
    Alone,
    /// With a stranger beside it, whose blocks come first or last.
    Beside {
        /// Which one.
        stranger: Stranger,
        /// Whether its blocks come first.
        before: bool,
    },
    /// At the coordinates of a survey; `rough`: without sliding, there and here.
    Surveyed {
        /// Whether nothing slides.
        rough: bool,
    },
    /// Under its dead load and so many times its live load.
    Loaded {
        /// The load factor.
        factor: f64,
    },
}

impl Variation {
    /// A word for the names of files.
    pub fn word(&self) -> String {
        match self {
            Self::Alone => "alone".into(),
            Self::Beside { stranger, before } => {
                format!("{stranger:?}-{}", if *before { "before" } else { "after" }).to_lowercase()
            }
            Self::Surveyed { rough } => if *rough { "survey-rough" } else { "survey" }.into(),
            Self::Loaded { factor } => format!("load-{factor}"),
        }
    }

    /// The scene as it is asked in this way.
    pub fn scene(&self, scene: &Scene) -> Scene {
        match *self {
            Self::Alone => scene.clone(),
            Self::Beside { stranger, before } => {
                let masses = prepare(scene).map(|m| masses(&m)).unwrap_or_default();
                beside(scene, &masses, stranger, before)
            }
            Self::Surveyed { rough: true } => moved(&rough(scene), SURVEY),
            Self::Surveyed { rough: false } => moved(scene, SURVEY),
            Self::Loaded { factor } => Scene { loads: scene.loads.fixed(factor), ..scene.clone() },
        }
    }
}

fn masses(model: &Model) -> Vec<f64> {
    model.assembly.free().map(|i| model.assembly.blocks[i].mass).collect()
}

/// Asks a scene in all ways.
pub(super) fn ask(scene: &Scene, index: usize, crossed: &mut Crossed) -> Result<(), InputError> {
    let model = prepare(scene)?;
    let own = Answers::of(scene, &model)?;
    crossed.blocks = model.assembly.blocks.len();
    (crossed.verdict, crossed.outcome) = (own.verdict, own.outcome);
    (crossed.bound, crossed.dry) = (own.bound.map(|b| b[0]), own.dry);
    let mut asked = Asked { crossed, own };
    asked.alone(&model);
    asked.unions(scene, &model, index)?;
    asked.surveyed(scene, index)?;
    asked.loaded(scene, &model);
    if index.is_multiple_of(EVERY_SIMULATED) {
        asked.simulated(&model);
    }
    Ok(())
}

struct Asked<'a> {
    crossed: &'a mut Crossed,
    own: Answers,
}

impl Asked<'_> {
    fn wrong(&mut self, way: Variation, what: String) {
        self.crossed.wrong.push(Differs { way, what });
    }

    /// Verdict and load factors of one scene.
    fn alone(&mut self, model: &Model) {
        let none = NONE * claim::natural_factor(&model.assembly);
        let Answers { verdict, outcome, bound, dry, .. } = self.own;
        let has_forces = matches!(verdict, Verdict::Stable | Verdict::Conditional);
        if has_forces && outcome == Outcome::Impossible {
            self.wrong(
                Variation::Alone,
                format!("{verdict:?} under its dead load, and falls whatever the live load"),
            );
        }
        let Some([_, upper]) = bound else { return };
        if has_forces && upper < -BEYOND * upper.abs() - none {
            self.wrong(
                Variation::Alone,
                format!("{verdict:?} under its dead load, and the load factor is at most {upper}"),
            );
        }
        if let Some(dry) = dry {
            if dry > upper + BEYOND * upper.abs() + none {
                self.wrong(Variation::Alone, format!("the load factor with dry friction, {dry}, is above the proved bound {upper}"));
            }
            if verdict == Verdict::Conditional && dry > none {
                self.wrong(
                    Variation::Alone,
                    format!("needs self-stress under its dead load, and stands up to {dry}"),
                );
            }
        }
    }

    /// With strangers beside it: two of the eight unions, in turn.
    fn unions(&mut self, scene: &Scene, model: &Model, index: usize) -> Result<(), InputError> {
        let masses = masses(model);
        let turn = index / super::FAMILIES.len();
        for (stranger, before) in [
            (STRANGERS[turn % 4], turn % 8 < 4),
            (STRANGERS[(turn + 1 + turn / 8 % 3) % 4], turn % 8 >= 4),
        ] {
            let way = Variation::Beside { stranger, before };
            let union = beside(scene, &masses, stranger, before);
            let said = Answers::of(&union, &prepare(&union)?)?;
            let same = said.is_same(&self.own);
            self.crossed.unions[0] += 1;
            self.crossed.unions[1] += usize::from(same);
            self.compare(way, said, SAME_BOUND);
        }
        Ok(())
    }

    /// At the coordinates of a survey.
    fn surveyed(&mut self, scene: &Scene, index: usize) -> Result<(), InputError> {
        let (low, high) = super::scenes::extent(scene);
        if (high - low).norm() < LEAST_SURVEYED {
            return Ok(());
        }
        let nothing_slides = (index / super::FAMILIES.len()).is_multiple_of(2);
        let way = Variation::Surveyed { rough: nothing_slides };
        let moved = way.scene(scene);
        let there = prepare(&moved)?;
        if nothing_slides {
            let rough = rough(scene);
            let (here, there) = (verdict(&rough, &prepare(&rough)?), verdict(&moved, &there));
            self.crossed.ways += 1;
            self.verdicts(way, here, there);
        } else {
            self.compare(way, Answers::of(&moved, &there)?, MOVED_BOUND);
        }
        Ok(())
    }

    fn verdicts(&mut self, way: Variation, known: Verdict, said: Verdict) {
        match (known, said) {
            (Verdict::Undecided, _) => {}
            (_, Verdict::Undecided) => self
                .crossed
                .lost
                .push(Differs { way, what: format!("undecided instead of {known:?}") }),
            _ if known == said => {}
            _ => self.wrong(way, format!("{said:?} instead of {known:?}")),
        }
    }

    /// Answers that must be the same.
    fn compare(&mut self, way: Variation, said: Answers, same_bound: f64) {
        self.crossed.ways += 1;
        let own = self.own;
        self.verdicts(way, own.verdict, said.verdict);
        match (own.outcome, said.outcome) {
            (Outcome::Undecided, _) => {}
            (_, Outcome::Undecided) => {
                self.crossed.lost.push(Differs { way, what: "the bound is undecided".into() })
            }
            (a, b) if a == b => {}
            (a, b) => self.wrong(way, format!("load factor {b:?} instead of {a:?}")),
        }
        let mut near = |name: &str, a: Option<f64>, b: Option<f64>, width: f64| match (a, b) {
            // Values next to 0 have no size of their own; loads are of the size of the weight.
            (Some(a), Some(b)) if (a - b).abs() > width * a.abs() + 1e-9 => {
                self.wrong(way, format!("{name} {b} instead of {a}"))
            }
            (Some(_), None) if name != "bound" => {
                self.crossed.lost.push(Differs { way, what: format!("{name} is undecided") })
            }
            _ => {}
        };
        near("bound", own.bound.map(|b| b[0]), said.bound.map(|b| b[0]), same_bound);
        near("dry load factor", own.dry, said.dry, SAME_DRY);
    }

    /// On the way to the load factor with dry friction, and at the bound.
    fn loaded(&mut self, scene: &Scene, model: &Model) {
        let mut factors: Vec<f64> = Vec::new();
        let none = NONE * claim::natural_factor(&model.assembly);
        // What falls without its live load is held by it, and may be from some load on only.
        let dry = self.own.dry.filter(|d| *d > none && self.own.verdict != Verdict::Unstable);
        let bound = self.own.bound.filter(|b| b[0] > none);
        factors.extend(dry.iter().flat_map(|dry| {
            ON_THE_WAY.into_iter().chain([BELOW, ABOVE]).map(move |share| share * dry)
        }));
        factors.extend(bound.iter().flat_map(|[value, _]| [BELOW * value, ABOVE * value]));
        factors.sort_by(f64::total_cmp);
        factors.dedup_by(|a, b| (*a - *b).abs() <= 1e-6 * b.abs());
        let mut fell: Option<f64> = None;
        for factor in factors {
            let way = Variation::Loaded { factor };
            let said = verdict(scene, &model.at_load_factor(factor));
            self.crossed.ways += 1;
            if dry.is_some_and(|dry| factor < dry * (1.0 - 1e-6)) {
                self.verdicts(way, Verdict::Stable, said);
            }
            let has_forces = matches!(said, Verdict::Stable | Verdict::Conditional);
            if let Some([_, upper]) =
                bound.filter(|[_, upper]| has_forces && factor > upper * (1.0 + 1e-6))
            {
                self.wrong(way, format!("{said:?} above the proved bound {upper}"));
            }
            if let Some(less) = fell.filter(|_| {
                has_forces && matches!(self.own.verdict, Verdict::Stable | Verdict::Conditional)
            }) {
                self.wrong(way, format!("{said:?}, and falls under a load factor of {less}"));
            }
            let stood = matches!(self.own.verdict, Verdict::Stable | Verdict::Conditional)
                && dry.is_none_or(|dry| factor >= dry);
            if let Some([value, _]) = bound.filter(|[value, _]| {
                stood && said == Verdict::Unstable && factor < value * (1.0 - 1e-6)
            }) {
                self.wrong(way, format!("falls below the bound {value}, which has forces"));
            }
            if said == Verdict::Unstable {
                fell = fell.or(Some(factor));
            }
        }
    }

    /// The load factor with dry friction against what happens in time.
    fn simulated(&mut self, model: &Model) {
        // Strengths are left out of simulations.
        let has_one = |d: &f64| {
            *d > NONE * claim::natural_factor(&model.assembly)
                && self.own.verdict != Verdict::Unstable
        };
        let Some(dry) = self
            .own
            .dry
            .filter(|d| has_one(d) && model.interfaces.list.iter().all(|f| f.law.is_dry()))
        else {
            return;
        };
        for (share, expected) in SIMULATED.into_iter().zip([Fate::Stands, Fate::Falls]) {
            let loaded = model.at_load_factor(share * dry);
            let run =
                dynamics::simulate(&loaded, &dynamics::SimulationSettings::default(), &mut |_| {
                    ControlFlow::Continue(())
                });
            let Ok(outcome) = run else { continue };
            self.crossed.simulated[0] += 1;
            if outcome.fate == expected {
                self.crossed.simulated[1] += 1;
            } else if outcome.fate != Fate::Undecided {
                let answer = assess(&loaded, &control());
                let Agreement { verdict, .. } = agreement(&loaded, &answer, &outcome);
                let what = format!(
                    "at {share} of the dry load factor {dry} the simulation {:?}, the verdict is {verdict:?}",
                    outcome.fate
                );
                self.crossed
                    .apart
                    .push(Differs { way: Variation::Loaded { factor: share * dry }, what });
            }
        }
    }
}
