//! Elastic joints, on scenes with closed forms: the error of the state with stiffness, of springs
//! and dampers relaxed to rest (the penalty method), and of the simulation, against run time.
//!
//! The simulation knows no stiffness: it is asked for load factors alone.

mod cases;
mod penalty;

pub use cases::{ElasticCase, ElasticQuantity, ElasticWay, elastic_cases};

use super::method::simulated;
use analysis::{Answer, Control, Question, StateOptions, ask};
use base::error::InputError;
use check::{elastic::Quadrature, verdict::Rate};
use dynamics::Fidelity;
use model::interface::{Model, prepare};
use penalty::Penalty;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// A way to a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ElasticMethod {
    /// `state`: along a live load its whole path.
    State,
    /// The same with joints at their corners.
    Corners,
    /// Springs and dampers at the corners of joints, relaxed to rest; knob: the equilibrium error that
    /// counts as rest.
    PenaltyCorners,
    /// The same at 384 points of each joint.
    PenaltyFine,
    /// The engine, by halving on the load factor.
    Simulation,
}

impl ElasticMethod {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::State, Self::Corners, Self::PenaltyCorners, Self::PenaltyFine, Self::Simulation];

    /// What people call it.
    pub fn label(self) -> &'static str {
        match self {
            Self::State => "voussoir state",
            Self::Corners => "voussoir state, at corners",
            Self::PenaltyCorners => "springs and dampers, at corners",
            Self::PenaltyFine => "springs and dampers, 384 points",
            Self::Simulation => "simulation, fine steps",
        }
    }

    /// The settings of its knob that make sense for a case.
    fn knobs(self, case: &ElasticCase) -> &'static [f64] {
        let factor = case.quantity == ElasticQuantity::LoadFactor;
        match self {
            Self::State => &[0.0],
            Self::Simulation if factor => &[0.0],
            Self::Simulation => &[],
            // Of spheres the law at their one point is the same.
            Self::Corners if case.has_area => &[0.0],
            Self::PenaltyFine if !case.has_area => &[],
            Self::Corners => &[],
            // Of load factors rest is yes or no.
            Self::PenaltyCorners | Self::PenaltyFine if factor => &[1e-6],
            Self::PenaltyCorners | Self::PenaltyFine => &[1e-2, 1e-4, 1e-6, 1e-8],
        }
    }
}

/// One way to one value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ElasticPoint {
    /// The case.
    pub case: String,
    /// Whether the value is a load factor.
    pub is_factor: bool,
    /// The method.
    pub method: ElasticMethod,
    /// Its knob, where it has one.
    pub knob: f64,
    /// What came out, m, rad or a load factor.
    pub value: Option<f64>,
    /// The exact value.
    pub truth: f64,
    /// |value − truth| / truth.
    pub error: Option<f64>,
    /// Seconds; resolving the scene and finding its interfaces are not counted.
    pub seconds: f64,
}

/// Runs every method over its knob on the cases; `each` hears of every point as it is done.
///
/// # Errors
/// A case cannot be resolved.
pub fn elastic(
    cases: &[ElasticCase],
    mut each: impl FnMut(&ElasticPoint),
) -> Result<Vec<ElasticPoint>, InputError> {
    let mut points = Vec::new();
    for case in cases {
        let model = prepare(&case.scene)?;
        for method in ElasticMethod::ALL {
            for &knob in method.knobs(case) {
                let start = Instant::now();
                let value = value(case, &model, method, knob)?.filter(|v| v.is_finite());
                let point = ElasticPoint {
                    case: case.name.clone(),
                    is_factor: case.quantity == ElasticQuantity::LoadFactor,
                    method,
                    knob,
                    value,
                    truth: case.truth,
                    error: value.map(|v| (v / case.truth - 1.0).abs()),
                    seconds: start.elapsed().as_secs_f64(),
                };
                each(&point);
                points.push(point);
            }
        }
    }
    Ok(points)
}

/// How many points [`elastic`] will make.
pub fn elastic_count(cases: &[ElasticCase]) -> usize {
    let of =
        |case: &ElasticCase| ElasticMethod::ALL.iter().map(|m| m.knobs(case).len()).sum::<usize>();
    cases.iter().map(of).sum()
}

/// Load factors are sought up to so many times the exact one.
const HIGH: f64 = 1.7;

fn value(
    case: &ElasticCase,
    model: &Model,
    method: ElasticMethod,
    knob: f64,
) -> Result<Option<f64>, InputError> {
    match method {
        ElasticMethod::State => state(case, model, Quadrature::Area),
        ElasticMethod::Corners => state(case, model, Quadrature::Corners),
        ElasticMethod::PenaltyCorners => penalty(case, model, None, knob),
        ElasticMethod::PenaltyFine => penalty(case, model, Some(2), knob),
        ElasticMethod::Simulation => {
            let [low, high] = simulated(model, Fidelity::Fine, HIGH * case.truth);
            Ok(Some(0.5 * (low + high)))
        }
    }
}

fn state(
    case: &ElasticCase,
    model: &Model,
    quadrature: Quadrature,
) -> Result<Option<f64>, InputError> {
    let live = matches!(case.quantity, ElasticQuantity::Live(_));
    let at = if live { vec![1.0] } else { Vec::new() };
    let question = Question::State(StateOptions { quadrature, at, ..StateOptions::default() });
    let answer = ask(&question, &case.scene, model, &Control::default())?;
    let Answer::State(found) = answer else { return Ok(None) };
    Ok(match &case.quantity {
        ElasticQuantity::LoadFactor => found.factor().and_then(|f| f.value),
        ElasticQuantity::Dead(way) => {
            found.track.as_ref().map(|t| way.of(model, &t.steps[0].displaced))
        }
        ElasticQuantity::Live(way) => found.track.as_ref().and_then(|t| {
            let there = t.steps.iter().find(|s| s.load_factor == 1.0)?;
            Some(way.of(model, &there.displaced))
        }),
    })
}

/// The live load grows in so many increments.
const INCREMENTS: usize = 20;
/// Halvings of the load factor: 2e-5 of it.
const HALVINGS: usize = 16;

/// `finer`: how often the triangles of joints are cut in four; at corners where nothing is said.
fn penalty(
    case: &ElasticCase,
    model: &Model,
    finer: Option<usize>,
    rest: f64,
) -> Result<Option<f64>, InputError> {
    let mut springs = Penalty::new(model, finer, rest)?;
    if !springs.relax(0.0) {
        return Ok(None);
    }
    let seen = |displaced: &[Rate]| match &case.quantity {
        ElasticQuantity::Dead(way) | ElasticQuantity::Live(way) => way.of(model, displaced),
        ElasticQuantity::LoadFactor => f64::NAN,
    };
    Ok(match &case.quantity {
        ElasticQuantity::Dead(_) => Some(seen(&springs.displaced)),
        ElasticQuantity::Live(_) => {
            let stays = (1..=INCREMENTS).all(|k| springs.relax(k as f64 / INCREMENTS as f64));
            stays.then(|| seen(&springs.displaced))
        }
        ElasticQuantity::LoadFactor => {
            let (mut low, mut high) = (0.0, HIGH * case.truth);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if springs.clone().relax(middle) { low = middle } else { high = middle }
            }
            Some(0.5 * (low + high))
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The state has every value; springs and dampers come near where their points allow it, and the
    /// less is left out of balance, the nearer.
    #[test]
    fn the_state_has_the_exact_values() {
        for case in elastic_cases().unwrap() {
            let model = prepare(&case.scene).unwrap();
            let off = |method, knob| {
                let value = value(&case, &model, method, knob).unwrap();
                value.map_or(f64::INFINITY, |v| (v / case.truth - 1.0).abs())
            };
            // What tips slides at its edge: it is followed to a thousandth below its bound.
            let exact = if case.quantity == ElasticQuantity::LoadFactor { 1.1e-3 } else { 1e-8 };
            let error = off(ElasticMethod::State, 0.0);
            assert!(error < exact, "{}: {error}", case.name);
            if case.quantity != ElasticQuantity::LoadFactor && case.name.starts_with("sphere") {
                let [coarse, fine] = [1e-2, 1e-6].map(|k| off(ElasticMethod::PenaltyCorners, k));
                assert!(fine < coarse && fine < 0.3, "{}: {coarse} {fine}", case.name);
            }
        }
    }
}
