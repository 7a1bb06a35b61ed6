//! How a load factor changes with what was assumed: derived from the forces and the mechanism that
//! prove it, and from what was asked again where these are not the only ones.

use super::certificate::Certificate;
use crate::{
    sensitivity::{Faces, Number, Proof, Target, Varied},
    terms::{Derivative, Origin, Sensitivity, Sided},
    verdict::{claim::Findings, evidence::read_rates},
};
use base::error::InputError;
use model::interface::Model;
use scene::Scene;

/// Derivatives that are asked again on another machine agree to this × themselves. Larger: changed
/// digits pass. Smaller: what solvers leave open of steep values is a difference.
const AGAIN: f64 = 1e-3;
/// The same of what changes a value by less than this × itself where the number changes by its own
/// size: first of proved values, then of those with dry friction.
const NOISE: [f64; 2] = [1e-6, 1e-3];

/// Asks again how a value changes with the numbers at these JSON pointers; nothing where this build
/// cannot.
pub(super) type Again<'a> = &'a dyn Fn(&[&str]) -> Option<Vec<Sided>>;

/// How a value changes; `again` where what was asked again is to be asked once more.
///
/// # Errors
/// As [`Varied::new`].
pub(super) fn derive(
    (scene, model): (&Scene, &Model),
    target: &Target,
    evidence: (&Certificate, &[Sided]),
    again: Option<Again<'_>>,
) -> Result<(Sensitivity, Findings), InputError> {
    let (found, noise) = sensitivity(scene, model, target, evidence)?;
    let mut f = Findings::default();
    let count = |origin| found.numbers.iter().filter(|d| d.origin == origin).count();
    f.holds.push(format!(
        "derivatives follow from the forces and the mechanism: {} of {}",
        count(Origin::Proof),
        found.numbers.len()
    ));
    let all = found.numbers.iter().zip(noise);
    let sided: Vec<(&Derivative, f64)> =
        all.filter(|(d, _)| d.origin == Origin::AskedAgain).collect();
    if !sided.is_empty() {
        f.computed = true;
        let text = format!("derivatives on both sides of {} numbers", sided.len());
        let pointers: Vec<&str> = sided.iter().map(|(d, _)| d.pointer.as_str()).collect();
        if let Some(again) = again {
            let here = again(&pointers);
            match here.map(|here| sided.iter().all(|(d, noise)| is_same(d, &here, *noise))) {
                Some(true) => f.holds.push(format!("{text} (computed again, not proved)")),
                Some(false) => f.fails.push(text),
                None => f.unchecked.push(text),
            }
        }
    }
    Ok((found, f))
}

/// Whether derivatives that were asked again are those that are told.
fn is_same(told: &Derivative, here: &[Sided], noise: f64) -> bool {
    let near = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= AGAIN * a.abs().max(b.abs()) + noise,
        (None, None) => true,
        _ => false,
    };
    here.iter()
        .find(|s| s.pointer == told.pointer)
        .is_some_and(|s| near(s.left, told.left) && near(s.right, told.right))
}

fn sensitivity(
    scene: &Scene,
    model: &Model,
    target: &Target,
    (certificate, sided): (&Certificate, &[Sided]),
) -> Result<(Sensitivity, Vec<f64>), InputError> {
    let varied = Varied::new(scene, model, target.under)?;
    let (all, omitted) = varied.numbers();
    let own = varied.own(target.bound)?;
    let forces = certificate.read(&own).map(|read| read.0).unwrap_or_default();
    let rates = read_rates(&own.assembly, &certificate.rates).ok();
    let proof = rates.as_ref().and_then(|q| Proof::new(&own, &forces, q, target.bound));
    let faces = proof.as_ref().map(Faces::new);
    let by = target.scale(target.bound);
    let noise = NOISE[usize::from(target.dry.is_some())];
    let one = |number: Number| {
        let known = faces.as_ref().and_then(|f| f.slope(&varied, &number));
        let again = sided.iter().find(|s| s.pointer == number.pointer);
        let (left, right, origin) = match (known, again) {
            (Some((slope, true)), _) if target.dry.is_none() => {
                (Some(slope * by), Some(slope * by), Origin::Proof)
            }
            (_, Some(again)) => (again.left, again.right, Origin::AskedAgain),
            _ => (None, None, Origin::NotAsked),
        };
        let greater = match (left, right) {
            (Some(l), Some(r)) => Some(if l.abs() > r.abs() { l } else { r }),
            (one, other) => one.or(other),
        };
        let zero = number.value == 0.0 && !number.place;
        let scale = varied.scale(&number);
        let percent = if zero { 0.0 } else { 0.01 * scale };
        // What the proof says orders numbers that were not asked again.
        let size = greater.or(known.map(|k| k.0 * by)).unwrap_or(0.0).abs() * percent;
        let derivative = Derivative {
            per_percent: greater.filter(|_| !zero).map(|d| d * percent),
            pointer: number.pointer,
            value: number.value,
            unit: number.unit,
            left,
            right,
            origin,
        };
        (derivative, told(size), noise * (target.bound * by).abs() / scale)
    };
    let mut list: Vec<(Derivative, f64, f64)> = all.into_iter().map(one).collect();
    list.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (numbers, noise) = list.into_iter().map(|(d, _, noise)| (d, noise)).unzip();
    Ok((Sensitivity { of: target.of, law: target.law, numbers, omitted }, noise))
}

/// Six digits, by which numbers that matter as much as each other keep the order of the scene.
fn told(size: f64) -> f64 {
    let unit = 10f64.powf(size.log10().floor() - 5.0);
    if unit > 0.0 { (size / unit).round() * unit } else { 0.0 }
}
