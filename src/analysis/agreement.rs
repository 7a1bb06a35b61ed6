//! Verdict and simulation beside each other: two methods that share nothing but the blocks and
//! where they touch.

use super::Assessment;
use base::error::FindingCode;
use check::{
    terms::{Agreement, ForceAgreement, agree},
    verdict::{Forces, Rate, Verdict},
};
use dynamics::{Fate, SimulationOutcome};
use model::{
    assembly::Assembly,
    interface::{Model, is_forest},
};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Forces below this × the largest are rounding of two iterations, and left out of the comparison
/// block by block.
const SMALL: f64 = 1e-6;

/// Compares an assessment with a simulation of the same scene.
pub fn agreement(model: &Model, assessment: &Assessment, outcome: &SimulationOutcome) -> Agreement {
    let assembly = &model.assembly;
    let (verdict, fate) = (assessment.verdict, outcome.fate);
    let agrees =
        agree(verdict, fate, outcome.findings.iter().any(|f| f.code == FindingCode::LeftOut));
    let falls = matches!(verdict, Verdict::Unstable | Verdict::Conditional) && fate == Fate::Falls;
    let stands = verdict == Verdict::Stable && fate == Fate::Stands;
    let determinate = is_forest(model);
    let known = match &assessment.state {
        Some(state) => Some(&state.forces),
        None => determinate.then_some(&assessment.forces),
    };
    Agreement {
        verdict,
        fate,
        agrees,
        motion: falls.then(|| correlation(assembly, outcome, &assessment.rates)).flatten(),
        forces: known.filter(|_| stands).and_then(|f| forces(model, f, outcome, determinate)),
    }
}

/// `⟨x, q⟩ / (‖x‖ ‖q‖)` with `⟨x, q⟩ = Σ m u·v + φ·J ω` over the free blocks, `x = (u, φ)` the
/// first motion and `q = (v, ω)` the rates.
fn correlation(assembly: &Assembly, outcome: &SimulationOutcome, rates: &[Rate]) -> Option<f64> {
    let (mut across, mut one, mut other) = (0.0, 0.0, 0.0);
    for i in assembly.free() {
        let (block, motion, rate) =
            (&assembly.blocks[i], outcome.first_motion.get(i)?, rates.get(i)?);
        let product = |u: Vector3<f64>, a: Vector3<f64>, v: Vector3<f64>, b: Vector3<f64>| {
            block.mass * u.dot(&v) + a.dot(&(block.inertia * b))
        };
        across += product(motion.way, motion.turn, rate.velocity, rate.spin);
        one += product(motion.way, motion.turn, motion.way, motion.turn);
        other += product(rate.velocity, rate.spin, rate.velocity, rate.spin);
    }
    let size = one.sqrt() * other.sqrt();
    (size > 0.0).then(|| (across / size).clamp(-1.0, 1.0))
}

fn forces(
    model: &Model,
    computed: &Forces,
    outcome: &SimulationOutcome,
    determinate: bool,
) -> Option<ForceAgreement> {
    let Model { assembly, interfaces, .. } = model;
    // By pairs of blocks: computed, simulated; both on the block with the larger index.
    let mut pairs: BTreeMap<(usize, usize), [Vector3<f64>; 2]> = BTreeMap::new();
    for (face, points) in interfaces.list.iter().zip(computed) {
        let force: Vector3<f64> = points.iter().map(|w| w.force).sum();
        let (pair, force) =
            if face.a < face.b { ((face.a, face.b), force) } else { ((face.b, face.a), -force) };
        pairs.entry(pair).or_default()[0] += force;
    }
    for contact in &outcome.contacts {
        pairs.entry((contact.a, contact.b)).or_default()[1] += contact.force;
    }
    let largest = pairs.values().flatten().map(|f| f.norm()).fold(0.0, f64::max);
    pairs.retain(|_, f| f.iter().any(|f| f.norm() > SMALL * largest));
    let differences: Vec<((usize, usize), f64)> =
        pairs.iter().map(|(pair, [c, s])| (*pair, (c - s).norm())).collect();
    let (pair, worst) = differences.iter().copied().max_by(|x, y| x.1.total_cmp(&y.1))?;
    let square = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>().sqrt();
    let size = square(&mut pairs.values().map(|[c, _]| c.norm()));
    let id = |i: usize| assembly.blocks[i].id.clone();
    Some(ForceAgreement {
        largest: worst / largest,
        between: [id(pair.0), id(pair.1)],
        mean: if size > 0.0 { square(&mut differences.iter().map(|d| d.1)) / size } else { 0.0 },
        pairs: differences.len(),
        determinate,
    })
}
