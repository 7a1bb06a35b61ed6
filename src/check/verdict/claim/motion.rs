//! Claims that fall: mechanisms that gain power, and motions that start.

use super::balance::cones;
use crate::verdict::{
    Forces, Rate, certificate,
    exact::{Grade, motion},
    findings::Findings,
    law, no_forces,
};
use base::tolerance;
use model::{
    assembly::Wrench,
    interface::{self, Model, Part},
};

/// A sum of powers is exact to this × the sum of their sizes: for a thousand blocks that move, if
/// all roundings add up. Larger: less far-reaching proofs. Smaller: rounding counts as exact.
const ROUNDING: f64 = 1e-12;

/// The rates gain no power from the live load, so that no multiple of it stops them.
pub(super) fn without_live_power(f: &mut Findings, model: &Model, rates: &[Rate]) {
    let Model { assembly, interfaces, .. } = model;
    // Each load by what it does on the blocks that move.
    let norm = |loads: &[Wrench]| -> f64 {
        assembly
            .free()
            .map(|i| {
                certificate::size(assembly, i, &loads[i])
                    * certificate::speed(assembly, i, &rates[i])
            })
            .sum()
    };
    // What gives way in joints that crush has no exact sum.
    let (live, gain) = match motion::motion(model, rates) {
        Some(m) => (m.live.magnitude(), m.gain().lower),
        None => {
            let k = certificate::kinematics(model, rates, &no_forces(interfaces));
            let rounding = ROUNDING * norm(&assembly.live);
            (k.live_power.abs() + rounding, k.gain())
        }
    };
    if live == 0.0 {
        return f
            .holds
            .push("no multiple of the live load has power on the mechanism (exact)".into());
    }
    let reach = gain / norm(&assembly.dead) / (live / norm(&assembly.live));
    f.require_graded(
        reach >= tolerance::REACH,
        Grade::ToRounding(1.0 / reach),
        format!("the live load has no power on the mechanism: the proof holds for load factors up to {reach:.1e} × dead / live load of the moving blocks"),
    );
}

/// Forces from which a motion starts that obeys Coulomb's law with them.
pub(super) fn moves(f: &mut Findings, model: &Model, base: &Forces, rates: &[Rate]) {
    let assembly = &model.assembly;
    cones(f, "without self-stress, ", model, &certificate::statics(model, base, 0.0));
    let m = law::motion(model, base);
    f.require(
        m.acceleration >= tolerance::LEAST_MOTION,
        format!(
            "without self-stress a block stays out of balance by {:.3e} g, at least {:.0e} needed",
            m.acceleration,
            tolerance::LEAST_MOTION
        ),
    );
    f.require(
        m.natural_map <= tolerance::MOTION_LAW,
        format!(
            "forces and motion obey Coulomb's law: natural map {:.1e}, allowed {:.0e}",
            m.natural_map,
            tolerance::MOTION_LAW
        ),
    );
    let allowed = tolerance::MOTION_BREACH * m.acceleration;
    f.require(
        m.natural_map_in_loads <= allowed,
        format!(
            "their error is far smaller than the motion: natural map in g {:.1e}, allowed {allowed:.0e}",
            m.natural_map_in_loads
        ),
    );
    let dot = |a: &[Rate], b: &[Rate]| -> f64 {
        assembly
            .free()
            .map(|i| {
                let gyration = &assembly.blocks[i].gyration;
                a[i].velocity.dot(&b[i].velocity)
                    + gyration.speed(&a[i].spin).dot(&gyration.speed(&b[i].spin))
            })
            .sum()
    };
    let cosine = dot(rates, &m.rates) / (dot(rates, rates) * dot(&m.rates, &m.rates)).sqrt();
    f.require(
        cosine >= 1.0 - tolerance::MOTION_LAW,
        format!("the rates listed agree with this motion: cosine {cosine:.6}"),
    );
}

/// The parts of a scene that move, each in its own units, with its rates: what the others weigh is
/// no matter of its proof.
pub(super) fn moving_parts(model: &Model, rates: &[Rate]) -> Vec<(Part, Vec<Rate>)> {
    let moves = |part: &Part| part.blocks.iter().any(|&i| rates[i] != Rate::zero());
    let in_its_units = |part: Part| {
        let own = part
            .blocks
            .iter()
            .map(|&i| Rate {
                velocity: rates[i].velocity,
                spin: part.units.own_spin(&rates[i].spin),
            })
            .collect();
        (part, own)
    };
    interface::parts(model).into_iter().filter(moves).map(in_its_units).collect()
}

/// The part of a scene that alone moves, with its forces and rates. `None` where several move.
pub fn moving(model: &Model, forces: &Forces, rates: &[Rate]) -> Option<(Part, Forces, Vec<Rate>)> {
    let mut list = moving_parts(model, rates);
    let (part, own) = list.pop().filter(|_| list.is_empty())?;
    let forces = part.take_forces(forces);
    Some((part, forces, own))
}

/// A scene falls where one of its parts does: what moves gains power and closes no joint, each part
/// for itself, whatever the others weigh. Where no live load may help (`for_good`), it has no power
/// on one of them, or none on all of them together.
pub(super) fn falls(f: &mut Findings, model: &Model, rates: &[Rate], for_good: bool) {
    let meets = |model: &Model, rates: &[Rate]| {
        let [mut gain, mut live] = [Findings::default(), Findings::default()];
        gains(&mut gain, model, rates);
        if for_good {
            without_live_power(&mut live, model, rates);
        }
        [gain, live]
    };
    let parts = moving_parts(model, rates);
    let mut list: Vec<[Findings; 2]> =
        parts.iter().map(|(part, rates)| meets(&part.model, rates)).collect();
    // Of two parts the live load may drive one and hold back the other: then they prove together
    // what neither does by itself.
    let proves = |own: &[Findings; 2]| own.iter().all(|f| f.fails.is_empty());
    if list.is_empty() || (for_good && !list.iter().any(proves)) {
        list = vec![meets(model, rates)];
    }
    // The part that is proved best speaks for all; of the others only what fails is told.
    let decides = (0..list.len())
        .min_by_key(|&k| list[k].iter().map(|own| own.fails.len()).sum::<usize>())
        .unwrap_or(0);
    for (k, [gain, live]) in list.into_iter().enumerate() {
        f.fails.extend(gain.fails);
        f.grade = f.grade.and(gain.grade);
        if k == decides {
            f.holds.extend(gain.holds.into_iter().chain(live.holds));
            f.fails.extend(live.fails);
            f.grade = f.grade.and(live.grade);
        }
    }
}

/// The rates gain power, and close no joint.
pub(super) fn gains(f: &mut Findings, model: &Model, rates: &[Rate]) {
    let Model { assembly, interfaces, .. } = model;
    let none = no_forces(interfaces);
    let k = certificate::kinematics(model, rates, &none);
    let exact = motion::motion(model, rates);
    let gain = exact.map_or(k.gain(), |m| m.gain().lower);
    let threshold = tolerance::EQUILIBRIUM_ERROR;
    f.require(
        gain > threshold * k.norm,
        format!(
            "the mechanism gains power: {:.3e} g, at least {threshold:.1e} needed",
            gain / k.norm
        ),
    );
    if exact.is_some_and(|m| m.is_admissible()) {
        return f.require_graded(
            true,
            Grade::Exact,
            "the mechanism is admissible: no joint closes",
        );
    }
    let cap = k.force_cap(assembly);
    f.require_graded(
        k.is_admissible(assembly),
        Grade::ToRounding(1.0 / cap),
        format!(
            // Rounding: its size is worth telling, its digits are not.
            "the mechanism is admissible: joints close by less than {:.0e} of its speed; only contact forces above {:.0e} × the total load could make up for that",
            decade(k.inadmissibility, f64::ceil),
            decade(cap, f64::floor)
        ),
    );
}

/// The power of ten next to a number.
pub(super) fn decade(x: f64, round: fn(f64) -> f64) -> f64 {
    10f64.powf(round(x.log10()))
}
