//! The methods of a study and their knobs.

use super::{Known, StudyPoint};
use analysis::{Control, Law, LoadFactor, assess, coulomb, limit, limit::Formulation};
use check::verdict::Verdict;
use dynamics::{Fate, Fidelity};
use model::interface::Model;
use serde::{Deserialize, Serialize};
use solve::{
    EngineSettings,
    program::{Pyramid, Statics, StaticsOptions, Unknowns},
};
use std::time::Instant;

/// A way to a load factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StudyMethod {
    /// What `limit` does: the ladder of attempts. No knob.
    Ladder,
    /// One program in the forces; knob: the engine's tolerance.
    Forces,
    /// One program in the rates; knob: the engine's tolerance.
    Rates,
    /// One program in the forces with nothing left out; knob: the engine's tolerance.
    KeepAll,
    /// One program in newtons and metres, as a textbook writes it; knob: the engine's tolerance.
    Unscaled,
    /// Friction inscribed pyramids the cones; knob: the number of facets.
    PyramidInside,
    /// Friction circumscribed pyramids the cones; knob: the number of facets.
    PyramidAround,
    /// Bisection by verdicts of the least equilibrium error; knob: the number of verdicts.
    Bisection,
    /// The load factor with dry friction. No knob.
    DryFriction,
    /// Bisection by simulations in time; knob: steps per second (fast, fine).
    Simulation,
}

impl StudyMethod {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Ladder,
        Self::Forces,
        Self::Rates,
        Self::KeepAll,
        Self::Unscaled,
        Self::PyramidInside,
        Self::PyramidAround,
        Self::Bisection,
        Self::DryFriction,
        Self::Simulation,
    ];

    /// What people call it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Ladder => "voussoir limit",
            Self::Forces => "one program in forces",
            Self::Rates => "one program in rates",
            Self::KeepAll => "in forces, no reductions",
            Self::Unscaled => "in newtons, unscaled",
            Self::PyramidInside => "inscribed pyramids",
            Self::PyramidAround => "circumscribed pyramids",
            Self::Bisection => "bisection of verdicts",
            Self::DryFriction => "dry friction",
            Self::Simulation => "simulation in time",
        }
    }

    /// What its knob is.
    pub fn knob(self) -> &'static str {
        match self {
            Self::Ladder | Self::DryFriction => "",
            Self::Forces | Self::Rates | Self::KeepAll | Self::Unscaled => "tolerance",
            Self::PyramidInside | Self::PyramidAround => "facets",
            Self::Bisection => "verdicts",
            Self::Simulation => "steps per second",
        }
    }

    /// The settings of its knob that make sense for a scene.
    pub(super) fn knobs(self, known: &Known, model: &Model, quick: bool) -> Vec<f64> {
        let plane = || {
            Statics::new(model, StaticsOptions { live: true, ..StaticsOptions::default() })
                .plane
                .is_some()
        };
        let thin =
            |list: Vec<f64>| if quick { list.into_iter().step_by(2).collect() } else { list };
        match self {
            Self::DryFriction | Self::Simulation if known.dry.is_none() => Vec::new(),
            Self::Ladder | Self::DryFriction => vec![0.0],
            Self::KeepAll if !plane() => Vec::new(),
            Self::Forces | Self::Rates | Self::KeepAll | Self::Unscaled => {
                thin((1..=6).map(|k| 10f64.powi(-2 * k)).collect())
            }
            // In a plane two edges are the cone.
            Self::PyramidInside | Self::PyramidAround if plane() => Vec::new(),
            Self::PyramidInside | Self::PyramidAround => thin(vec![4.0, 8.0, 16.0, 32.0]),
            Self::Bisection => thin(vec![8.0, 16.0, 24.0, 32.0]),
            // Minutes on large scenes, for two digits.
            Self::Simulation if model.assembly.blocks.len() > SIMULATED || quick => Vec::new(),
            Self::Simulation => vec![240.0, 1000.0],
        }
    }

    /// One run.
    pub(super) fn run(self, known: &Known, model: &Model, knob: f64) -> StudyPoint {
        let start = Instant::now();
        let tolerance = |way: Formulation| Formulation { tolerance: knob, ..way };
        let once = |way: Formulation| Measurement::from(&limit::attempt(model, &way));
        let pyramid = |around: bool| {
            let options = StaticsOptions {
                pyramid: Some(Pyramid { facets: knob as usize, around }),
                keep_all: true,
                ..StaticsOptions::default()
            };
            once(Formulation { options, ..Formulation::usual(Unknowns::Forces) })
        };
        // What is simulated slides without opening.
        let dry = matches!(self, Self::DryFriction | Self::Simulation);
        let truth = if dry { known.dry.unwrap_or(f64::NAN) } else { known.truth };
        let got: Measurement = match self {
            Self::Ladder => {
                let l =
                    limit::limit(model, &Control { law: Law::Associative, ..Control::default() });
                Measurement { value: l.value, ..Measurement::from(&*l) }
            }
            Self::Forces => once(tolerance(Formulation::usual(Unknowns::Forces))),
            Self::Rates => once(tolerance(Formulation::usual(Unknowns::Rates))),
            Self::KeepAll => once(tolerance(Formulation {
                options: StaticsOptions { keep_all: true, ..StaticsOptions::default() },
                ..Formulation::usual(Unknowns::Forces)
            })),
            Self::Unscaled => once(Formulation {
                options: StaticsOptions { unscaled: true, ..StaticsOptions::default() },
                unknowns: Unknowns::Forces,
                unit: 1.0,
                local: false,
                tolerance: knob,
                engine: EngineSettings::default(),
            }),
            Self::PyramidInside => pyramid(false),
            Self::PyramidAround => pyramid(true),
            Self::Bisection => bisection(model, knob as usize, 2.0 * truth),
            Self::DryFriction => {
                let l = limit::limit(model, &Control::default());
                let d = coulomb::load_factor(model, &l, &Control::default());
                Measurement { value: d.value, iterations: d.solves, ..Measurement::default() }
            }
            Self::Simulation => {
                let fidelity = if knob < 500.0 { Fidelity::Fast } else { Fidelity::Fine };
                let [low, high] = simulated(model, fidelity, 2.0 * known.truth);
                Measurement {
                    value: Some(0.5 * (low + high)),
                    bracket: Some(high - low),
                    ..Measurement::default()
                }
            }
        };
        let value = got.value.filter(|v| v.is_finite());
        StudyPoint {
            scene: known.name.into(),
            method: self,
            knob,
            value,
            error: value.map(|v| (v - truth).abs() / truth).filter(|e| e.is_finite()),
            bracket: got.bracket.map(|b| b / truth).filter(|b| b.is_finite()),
            seconds: start.elapsed().as_secs_f64(),
            iterations: got.iterations,
            status: got.status,
        }
    }
}

/// What a run gives.
#[derive(Default)]
struct Measurement {
    value: Option<f64>,
    bracket: Option<f64>,
    iterations: usize,
    status: Option<solve::Status>,
}

impl From<&LoadFactor> for Measurement {
    fn from(l: &LoadFactor) -> Self {
        Self {
            value: l.attempts.last().and_then(|a| a.engine_value),
            bracket: Some(l.bracket.width()),
            iterations: l.attempts.iter().map(|a| a.iterations).sum(),
            status: l.attempts.last().map(|a| a.engine_status),
        }
    }
}

/// Scenes with more blocks are not simulated.
const SIMULATED: usize = 40;
/// Simulations of a bisection: two digits, more than the steps can tell.
const SIMULATIONS: usize = 8;

/// Halving between 0 and `high` by what happens in time: what is left.
pub(super) fn simulated(model: &Model, fidelity: Fidelity, mut high: f64) -> [f64; 2] {
    let settings = dynamics::SimulationSettings {
        fidelity: Some(fidelity),
        ..dynamics::SimulationSettings::default()
    };
    let mut low = 0.0;
    for _ in 0..SIMULATIONS {
        let middle = 0.5 * (low + high);
        match dynamics::simulate(&model.at_load_factor(middle), &settings, &mut |_| {
            std::ops::ControlFlow::Continue(())
        })
        .map(|outcome| outcome.fate)
        {
            Ok(Fate::Stands) => low = middle,
            Ok(Fate::Falls) => high = middle,
            _ => break,
        }
    }
    [low, high]
}

/// Halving between 0 and `high` by verdicts about the scene under its dead load and that multiple
/// of the live load.
fn bisection(model: &Model, verdicts: usize, mut high: f64) -> Measurement {
    let (mut low, mut iterations) = (0.0, 0);
    for _ in 0..verdicts {
        let middle = 0.5 * (low + high);
        let answer = assess(
            &model.at_load_factor(middle),
            &Control { law: Law::Associative, ..Control::default() },
        );
        iterations += answer.attempts.iter().map(|a| a.iterations).sum::<usize>();
        match answer.verdict {
            Verdict::Stable | Verdict::Conditional => low = middle,
            Verdict::Unstable => high = middle,
            // Too close to tell: the answer is here.
            Verdict::Undecided => break,
        }
    }
    Measurement {
        value: Some(0.5 * (low + high)),
        bracket: Some(high - low),
        iterations,
        status: None,
    }
}
