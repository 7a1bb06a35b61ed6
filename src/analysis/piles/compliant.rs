//! The verdict on a small part from its state on compliant contacts whose joints open as they
//! slide: one equation a block, a few Newton steps for each ε.
//!
//! As ε falls, what is left unbalanced falls with it, and forces that balance exactly exist nearby;
//! or it stays, and is a mechanism that gains power. Either is proved from the scene. Where no force
//! of the state at rest has reached its friction, nothing slides, and it is the state under dry
//! friction as well.

use crate::{
    analysis::{
        Assessment, Control, assess,
        coulomb::{State, StateMotion},
        mend,
    },
    interface::Model,
    program::{
        StaticsOptions,
        coulomb::{Contacts, HeldQuantity},
    },
    scene::Friction,
    solve::coulomb::Newton,
    terms::{Law, StateStep},
    tolerance,
    verdict::{Forces, Verdict, certificate, exact::existence, law, mechanism, no_forces},
};
use std::time::Instant;

/// The ε, each from the state at the one before. Fewer: the balance left is too far from an exact
/// one. More: time.
const EPSILONS: [f64; 4] = [1e-3, 1e-5, 1e-7, 1e-9];

/// A state that leaves more than this (g) is asked whether it is a mechanism, less whether forces
/// that balance lie near. Either side: time lost on the wrong proof.
const MOVES: f64 = 1e-4;

/// A force nearer to its friction limit than this share of it may have slid.
const STICKS: f64 = 1e-3;

/// The answer, where both proofs and the law allow one.
pub(super) fn decide(model: &Model, control: &Control) -> Option<Assessment> {
    let interfaces = &model.interfaces;
    let options = StaticsOptions { keep_all: control.keep_all, ..StaticsOptions::default() };
    let mut contacts = Contacts::new(model, options);
    contacts.by_mass();
    let mut newton = Newton::new(&contacts)?;
    let none = vec![0.0; contacts.discs().count()];
    let mut rates = vec![0.0; contacts.statics.matrix.rows];
    let mut before = f64::INFINITY;
    for epsilon in EPSILONS {
        let start = Instant::now();
        let at = (epsilon, HeldQuantity::SlidingRates, &none[..]);
        let solved = newton.solve(&contacts, at, &rates, control.deadline)?;
        let mut forces = contacts.statics.forces(interfaces, &solved.forces);
        mend::cut(interfaces, &mut forces);
        let left = certificate::statics(model, &forces, 0.0).unbalance;
        if left > MOVES && left > tolerance::ACCELERATION_STAYS * before {
            return falls(model, &forces, control);
        }
        if left <= MOVES
            && (left <= tolerance::UNBALANCE || left < tolerance::ACCELERATION_FALLS * before)
            && let Some(exact) = exactly(model, &forces)
        {
            if control.law == Law::Coulomb && slides(model, &forces) {
                return None;
            }
            let moved = law::motion(model, &exact);
            let step = StateStep {
                epsilon,
                acceleration: moved.acceleration,
                change: 0.0,
                natural_map: moved.natural_map,
                natural_map_in_loads: moved.natural_map_in_loads,
                solves: 1,
                seconds: start.elapsed().as_secs_f64(),
            };
            let state = State { motion: StateMotion::Rests, steps: vec![step], forces: exact };
            if let Some(answer) = assess::rests(model, state) {
                return Some(answer);
            }
        }
        (rates, before) = (solved.rates, left);
    }
    None
}

/// Forces near these that balance better, where some are near enough.
fn exactly(model: &Model, forces: &Forces) -> Option<Forces> {
    let mut better = existence::improved(model, forces, 0.0)?;
    mend::cut(&model.interfaces, &mut better);
    Some(better)
}

/// Whether any force has reached its friction, or nearly.
fn slides(model: &Model, forces: &Forces) -> bool {
    model.interfaces.list.iter().zip(forces).any(|(face, forces)| {
        let Friction::Coefficient(mu) = face.law.friction else { return false };
        let n = face.frame.n;
        let least = STICKS * forces.iter().map(|w| n.dot(&w.force)).fold(0.0, f64::max);
        forces.iter().any(|w| {
            let normal = n.dot(&w.force);
            let along = (w.force - n * normal).norm();
            along > (1.0 - STICKS) * mu * normal && along > mu * least * STICKS
        })
    })
}

/// The motion that is left as a mechanism that no forces hold.
fn falls(model: &Model, forces: &Forces, control: &Control) -> Option<Assessment> {
    let rates = law::motion(model, forces).rates;
    let power = certificate::kinematics(model, &rates, forces);
    let mended = mend::admissible(model, &rates, (0.0, 0.5 * power.gain()), control.deadline)?;
    let k = certificate::kinematics(model, &mended, &no_forces(&model.interfaces));
    let lower = k.gain() / k.norm;
    (lower > tolerance::UNBALANCE).then(|| {
        let upper = certificate::statics(model, forces, 0.0).unbalance;
        Assessment {
            verdict: Verdict::Unstable,
            mechanism: Some(mechanism::read(model, &mended)),
            rates: mended,
            ..assess::from_forces(model, forces.clone(), [lower, upper.max(lower)])
        }
    })
}
