//! Rocking blocks whose answers are known: the error of the mechanism's integrator and of the engine
//! against the time that one history takes.
//!
//! Impacts keep Housner's speed (1 − 1.5 sin² α; Bull. Seism. Soc. Am. 53, 1963, 403–417). A jump of
//! the ground's velocity overturns from √(8/3 g R (1 − cos α)) / cos α on (conservation of momentum
//! and energy). Pulses are those of Housner (rectangle) and of Shi, Anooshehpoor, Zeng & Brune
//! (1996) and Makris & Roussos (2000) (half sine), for finite rotations: bisection on an ordinary
//! differential equation with events, to 1e-6.

use analysis::{
    Control,
    follow::machine::{Built, MachineOptions, machine},
};
use base::error::{InputError, JsonPath};
use check::{
    ground::{Motion, Pulse},
    rocking::{RunSettings, run},
};
use dynamics::{Fidelity, Progress, ShakenFate, Shaking, SimulationSettings, shake};
use model::interface::{Model, prepare};
use nalgebra::Vector3;
use scene::Scene;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::{ops::ControlFlow, time::Instant};

/// Gravity of all blocks, m/s².
const GRAVITY: f64 = 9.81;
/// Amplitudes are sought within this share of the exact one.
const WITHIN: f64 = 0.1;
/// Halvings by the engine: 8e-4, less than its steps can tell; and by the integrator.
const HALVINGS: [usize; 2] = [8, 40];
/// Knobs of the integrator: errors of a step, over the unstable equilibrium. The last one is what
/// everything else uses.
const TOLERANCES: [f64; 4] = [1e-3, 1e-5, 1e-8, 1e-11];
/// A jump of the ground that lifts a block to about so much of its way, for impacts: of the energy
/// that overturns it.
const LIFTS: f64 = 0.68;

/// A way to a history.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RockingMethod {
    /// The mechanism as a machine of one degree of freedom; knob: the error of a step.
    Integrator,
    /// All blocks in the engine, fast steps.
    EngineFast,
    /// All blocks in the engine, fine steps.
    EngineFine,
}

impl RockingMethod {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Integrator, Self::EngineFast, Self::EngineFine];

    /// What people call it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Integrator => "integrator of the mechanism",
            Self::EngineFast => "engine, fast steps",
            Self::EngineFine => "engine, fine steps",
        }
    }

    fn knobs(self) -> &'static [f64] {
        if self == Self::Integrator { &TOLERANCES } else { &[0.0] }
    }
}

/// What is known of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RockingQuantity {
    /// The share of the speed that an impact leaves.
    Impact,
    /// The least multiple of this motion that overturns it.
    Overturning(Pulse),
}

/// A block with a value that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct RockingCase {
    /// Its name.
    pub name: String,
    /// Half width and half height, m.
    pub half: [f64; 2],
    /// What is known.
    pub quantity: RockingQuantity,
    /// The value.
    pub truth: f64,
}

/// One way to one value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RockingPoint {
    /// The block.
    pub case: String,
    /// The method.
    pub method: RockingMethod,
    /// Its knob, where it has one.
    pub knob: f64,
    /// What came out; nothing where it is farther than 10 % from the exact value.
    pub value: Option<f64>,
    /// The exact value.
    pub truth: f64,
    /// |value − truth| / truth.
    pub error: Option<f64>,
    /// Histories that were run.
    pub histories: usize,
    /// Seconds that one took, on the average.
    pub seconds: f64,
}

/// The blocks: impacts of four, a jump, three rectangles and eight half sines.
pub fn cases() -> Vec<RockingCase> {
    let impact = |slenderness: f64| {
        let half = [1.0 / slenderness, 1.0];
        let sine = half[0] / half[0].hypot(half[1]);
        RockingCase {
            name: format!("impact, h/b = {slenderness}"),
            half,
            quantity: RockingQuantity::Impact,
            truth: 1.0 - 1.5 * sine * sine,
        }
    };
    let overturning = |name: String, half: [f64; 2], pulse: Pulse, truth: f64| RockingCase {
        name,
        half,
        quantity: RockingQuantity::Overturning(pulse),
        truth,
    };
    let slender = [0.2, 1.0];
    let jump = overturning(
        "jump of the velocity".into(),
        slender,
        Pulse::Jump { velocity: 1.0 },
        jump_that_overturns(slender),
    );
    let rectangle = |(a, pt): (f64, f64)| {
        let pulse =
            Pulse::Rectangle { acceleration: GRAVITY * 0.2, duration: pt / frequency(slender) };
        overturning(format!("rectangle, p t = {pt:.3}"), slender, pulse, a)
    };
    let half_sine = |(ratio, a): (f64, f64)| {
        let half = [0.2_f64.tan(), 1.0];
        let duration = std::f64::consts::PI / (ratio * frequency(half));
        let pulse = Pulse::HalfSine { acceleration: GRAVITY * half[0], duration };
        overturning(format!("half sine, ω/p = {ratio}"), half, pulse, a)
    };
    let rectangles = [(1.5, 1.098_702_4), (2.0, 0.694_138_7), (3.0, 0.406_534_3)];
    let sines = [
        (1.0, 1.321_685),
        (2.0, 1.801_227),
        (3.0, 2.296_165),
        (4.0, 2.795_134),
        (5.0, 3.295_663),
        (6.0, 3.796_937),
        (8.0, 4.800_531),
        (10.0, 5.804_775),
    ];
    [3.0, 4.0, 5.0, 6.0]
        .into_iter()
        .map(impact)
        .chain([jump])
        .chain(rectangles.into_iter().map(rectangle))
        .chain(sines.into_iter().map(half_sine))
        .collect()
}

/// √(3g/4R), 1/s.
fn frequency([b, h]: [f64; 2]) -> f64 {
    (0.75 * GRAVITY / b.hypot(h)).sqrt()
}

/// m/s.
fn jump_that_overturns([b, h]: [f64; 2]) -> f64 {
    let cosine = h / b.hypot(h);
    (8.0 / 3.0 * GRAVITY * b.hypot(h) * (1.0 - cosine)).sqrt() / cosine
}

/// A block of these half sizes on the ground, which does not slide.
fn scene([b, h]: [f64; 2]) -> Result<Scene, InputError> {
    let ground = [[-20.0, -1.0], [20.0, -1.0], [20.0, 0.0], [-20.0, 0.0]];
    let block = [[-b, 0.0], [b, 0.0], [b, 2.0 * h], [-b, 2.0 * h]];
    let prism = |polygon: [[f64; 2]; 4]| json!({ "prism": { "polygon": polygon, "depth": 1 } });
    let value = json!({
        "format": "voussoir-scene/1", "name": "Block", "gravity": [0, 0, -GRAVITY],
        "joints": { "default": { "friction": "infinite" } },
        "blocks": [
            { "id": "ground", "support": true, "shape": prism(ground) },
            { "id": "block", "density": 1, "shape": prism(block) }
        ]
    });
    Scene::from_value(value).map_err(|e| InputError::at(JsonPath::root(), e.to_string()))
}

/// Runs every method over its knob on the blocks; `each` hears of every point as it is done.
///
/// # Errors
/// A block cannot be resolved.
pub fn rocking(
    cases: &[RockingCase],
    mut each: impl FnMut(&RockingPoint),
) -> Result<Vec<RockingPoint>, InputError> {
    let mut points = Vec::new();
    for case in cases {
        let scene = scene(case.half)?;
        let model = prepare(&scene)?;
        let options = MachineOptions { toward: Vector3::x(), control: None, restitution: None };
        let built = machine(&scene, &model, &options, &Control::default())?;
        for method in RockingMethod::ALL {
            for &knob in method.knobs() {
                let mut runner =
                    Runner { model: &model, built: &built, method, knob, histories: 0 };
                let start = Instant::now();
                let value = runner.value(case)?;
                let point = RockingPoint {
                    case: case.name.clone(),
                    method,
                    knob,
                    value,
                    truth: case.truth,
                    error: value.map(|v| (v / case.truth - 1.0).abs()),
                    histories: runner.histories,
                    seconds: start.elapsed().as_secs_f64() / runner.histories.max(1) as f64,
                };
                each(&point);
                points.push(point);
            }
        }
    }
    Ok(points)
}

/// How many points [`rocking`] will make.
pub fn count(cases: &[RockingCase]) -> usize {
    cases.len() * RockingMethod::ALL.iter().map(|m| m.knobs().len()).sum::<usize>()
}

/// One method on one block.
struct Runner<'a> {
    model: &'a Model,
    built: &'a Built,
    method: RockingMethod,
    knob: f64,
    histories: usize,
}

impl Runner<'_> {
    fn value(&mut self, case: &RockingCase) -> Result<Option<f64>, InputError> {
        match case.quantity {
            RockingQuantity::Impact => self.impact(case.half),
            RockingQuantity::Overturning(pulse) => self.amplitude(&pulse.motion(), case.truth),
        }
    }

    /// What an impact leaves of the speed, told from the highest points before and after it.
    fn impact(&mut self, half: [f64; 2]) -> Result<Option<f64>, InputError> {
        let motion = Pulse::Jump { velocity: LIFTS * jump_that_overturns(half) }.motion();
        let angles = match self.method {
            RockingMethod::Integrator => {
                self.histories += 1;
                let settings = RunSettings {
                    until: Some(3.0),
                    tolerance: self.knob,
                    ..RunSettings::default()
                };
                let history = run(&self.built.machine, &motion, &settings);
                // Turning points are found as roots: these are the highest points themselves.
                let peak = |k: usize| history.impacts.get(k).map_or(0.0, |i| i.peak.abs());
                vec![-peak(0), peak(1)]
            }
            _ => self.engine(&motion, Some(3.0))?.1,
        };
        // The jump pushes it over to −x; it comes back and leans to +x.
        let first = angles.iter().copied().fold(0.0, f64::min);
        let lowest = angles.iter().position(|a| *a == first).unwrap_or_default();
        let second = angles[lowest..].iter().copied().fold(0.0, f64::max);
        let alpha = (half[0] / half[1]).atan();
        let energy = |angle: f64| (alpha - angle.abs()).cos() - alpha.cos();
        let left = (energy(second) / energy(first)).sqrt();
        Ok(left.is_finite().then_some(left))
    }

    /// The multiple at which it begins to overturn, by halving.
    fn amplitude(&mut self, motion: &Motion, truth: f64) -> Result<Option<f64>, InputError> {
        let [mut low, mut high] = [1.0 - WITHIN, 1.0 + WITHIN].map(|k| k * truth);
        if self.overturns(&motion.scaled(low))? || !self.overturns(&motion.scaled(high))? {
            return Ok(None);
        }
        for _ in 0..HALVINGS[usize::from(self.method == RockingMethod::Integrator)] {
            let middle = 0.5 * (low + high);
            if self.overturns(&motion.scaled(middle))? { high = middle } else { low = middle }
        }
        Ok(Some(0.5 * (low + high)))
    }

    fn overturns(&mut self, motion: &Motion) -> Result<bool, InputError> {
        if self.method != RockingMethod::Integrator {
            return Ok(matches!(self.engine(motion, None)?.0, ShakenFate::Overturned { .. }));
        }
        self.histories += 1;
        let settings =
            RunSettings { tolerance: self.knob, fate_only: true, ..RunSettings::default() };
        Ok(run(&self.built.machine, motion, &settings).overturned())
    }

    /// A history in the engine, and the angle of the block after every step where it has an end.
    fn engine(
        &mut self,
        motion: &Motion,
        seconds: Option<f64>,
    ) -> Result<(ShakenFate, Vec<f64>), InputError> {
        self.histories += 1;
        let fidelity = match self.method {
            RockingMethod::EngineFast => Fidelity::Fast,
            _ => Fidelity::Fine,
        };
        let settings = SimulationSettings {
            fidelity: Some(fidelity),
            seconds,
            every_step: seconds.is_some(),
            ..SimulationSettings::default()
        };
        let mut angles = Vec::new();
        let mut watch = |progress: &Progress| {
            angles.extend(progress.moment.map(|f| f.blocks[1].turn.scaled_axis().y));
            ControlFlow::Continue(())
        };
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let ground = Shaking { motion, axes: &axes, burdens: &[] };
        let shaken = shake(self.model, ground, &settings, &mut watch)?;
        Ok((shaken.fate, angles))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integrator at its own tolerance has every value to the digits that are known of it, and a
    /// coarse step is no better.
    #[test]
    fn the_integrator_has_the_exact_values() {
        for case in cases() {
            let scene = scene(case.half).unwrap();
            let model = prepare(&scene).unwrap();
            let options = MachineOptions { toward: Vector3::x(), control: None, restitution: None };
            let built = machine(&scene, &model, &options, &Control::default()).unwrap();
            let method = RockingMethod::Integrator;
            let error = |knob: f64| {
                let mut runner =
                    Runner { model: &model, built: &built, method, knob, histories: 0 };
                let value = runner.value(&case).unwrap();
                value.map_or(f64::INFINITY, |v| (v / case.truth - 1.0).abs())
            };
            let digits = if case.quantity == RockingQuantity::Impact { 1e-8 } else { 2e-6 };
            assert!(error(1e-11) < digits, "{}: {}", case.name, error(1e-11));
            assert!(error(1e-3) < 0.01, "{}", case.name);
        }
    }

    #[test]
    fn engine_and_closed_form_agree_on_a_jump() {
        let case = cases().into_iter().find(|c| c.name.starts_with("jump")).unwrap();
        let mut seen = 0;
        let points = rocking(std::slice::from_ref(&case), |_| seen += 1).unwrap();
        assert_eq!(seen, count(std::slice::from_ref(&case)));
        let fine = points.iter().find(|p| p.method == RockingMethod::EngineFine).unwrap();
        assert!(fine.error.is_some_and(|e| e < 0.02) && fine.histories == 10, "{fine:?}");
    }
}
