//! Claims about load factors: forces at the lower end, a mechanism at the upper one, or both
//! together by Coulomb's law.

use super::{
    balance::{Left, cones, held, largest, natural_factor},
    motion::moving,
};
use crate::verdict::{
    Forces, Rate, certificate,
    exact::{
        Grade,
        motion::{self, MotionProof},
    },
    findings::Findings,
    in_every_way, law,
};
use base::tolerance;
use model::{assembly::Assembly, interface::Model};

/// Forces and a mechanism that obey Coulomb's law together.
pub(super) fn dry(f: &mut Findings, model: &Model, forces: &Forces, rates: &[Rate], value: f64) {
    let assembly = &model.assembly;
    let s = certificate::statics(model, forces, value);
    cones(f, "", model, &s);
    let allowed = tolerance::DRY_BALANCE;
    f.require(
        s.equilibrium_error <= allowed,
        format!("forces balance every free block at λ = {}: largest equilibrium error {:.1e} g, allowed {allowed:.0e}", value + 0.0, s.equilibrium_error),
    );
    let k = certificate::kinematics(model, rates, forces);
    f.require(
        k.live_power > 0.0,
        format!("the live load drives the mechanism: power {:.3e}", k.live_power),
    );
    let map = law::natural_map(model, forces, rates).unwrap_or(f64::INFINITY);
    f.require(
        map <= tolerance::DRY_LAW,
        format!(
            "forces and mechanism obey Coulomb's law: natural map {map:.1e}, allowed {:.0e}",
            tolerance::DRY_LAW
        ),
    );
    let in_loads = dry_map(model, forces, rates);
    f.require(
        in_loads <= tolerance::NATURAL_MAP,
        format!(
            "the same with rates scaled to the live load: natural map {in_loads:.1e}, allowed {:.0e}",
            tolerance::NATURAL_MAP
        ),
    );
    // Where the live load is small beside the dead load, far more of it is no more than rounding of
    // a block's balance.
    let hidden =
        assembly.free().map(|i| certificate::power(&s.residuals[i], &rates[i]).abs()).sum::<f64>()
            / k.live_power;
    // What stands beside it makes no room.
    let width = moving(model, forces, rates).map_or_else(
        || dry_width(assembly, value),
        |(part, ..)| {
            let own = part.units.own_load_factor(value);
            part.units.load_factor(dry_width(&part.model.assembly, own))
        },
    );
    f.require(
        hidden <= width,
        format!("the equilibrium error can change λ by at most {hidden:.1e}, allowed {width:.1e}"),
    );
}

/// How much of a load factor with dry friction what its forces leave off balance may hide.
pub fn dry_width(assembly: &Assembly, value: f64) -> f64 {
    tolerance::DRY_WIDTH * value.abs() + tolerance::LOAD_FACTOR_FLOOR * natural_factor(assembly)
}

/// The natural map of a mechanism with the rates as the live load drives them.
pub fn dry_map(model: &Model, forces: &Forces, rates: &[Rate]) -> f64 {
    law::natural_map_in_loads(model, forces, rates).unwrap_or(f64::INFINITY)
}

/// How far the ends of a load factor may lie from its value, with the one at which live and dead load
/// are equally large.
pub fn width(value: f64, natural: f64) -> f64 {
    tolerance::LOAD_FACTOR_WIDTH * value.abs() + tolerance::LOAD_FACTOR_FLOOR * natural
}

/// Forces at `lower` from below and a mechanism from above.
pub(super) fn load_factor(
    f: &mut Findings,
    model: &Model,
    forces: &Forces,
    rates: &[Rate],
    [value, lower, upper]: [f64; 3],
) {
    let assembly = &model.assembly;
    let (high, natural) = match moving(model, forces, rates) {
        Some((part, own, rates)) => {
            let high = upper_end(f, &part.model, &own, &rates, part.units.own_load_factor(value));
            (
                part.units.load_factor(high),
                part.units.load_factor(natural_factor(&part.model.assembly)),
            )
        }
        None => (upper_end(f, model, forces, rates, value), natural_factor(assembly)),
    };
    f.require(
        high <= upper,
        format!("the mechanism bounds the load factor: recomputed {high:.12}, claimed {upper:.12}"),
    );
    // A bracket may be true and wide; a load factor below the limit is still not the limit. NaN is
    // not narrow.
    let width = width(lower, natural);
    supported(f, model, (forces, rates), lower, width);
    let (open, narrow) = (upper - lower, 2.0 * width);
    if open.is_nan() || open.abs() > narrow {
        f.fails.push(format!("the bracket is too wide: {open:.1e}, allowed {narrow:.1e}"));
    }
    f.require(lower <= value && value <= upper, format!("λ = {value:.12} lies in its bracket"));
}

/// Forces that hold the scene at the lower end of a load factor. What they leave out of balance counts
/// with the power that it has on the mechanism, and may be more than elsewhere where that is next
/// to nothing.
pub(super) fn supported(
    f: &mut Findings,
    model: &Model,
    (forces, rates): (&Forces, &[Rate]),
    lower: f64,
    width: f64,
) {
    let assembly = &model.assembly;
    let scale = |i: usize| {
        certificate::load_scale(assembly, i)
            .max(lower.abs() * certificate::size(assembly, i, &assembly.live[i]))
    };
    let when = format!("at λ = {}, ", lower + 0.0);
    let left = Left::of(model, forces, lower, &scale);
    let s = certificate::statics(model, forces, lower);
    if left.is_balanced() {
        held(f, &when, assembly, &left);
        return cones(f, &when, model, &s);
    }
    let left = left.greatest.greatest;
    let live = certificate::kinematics(model, rates, forces).live_power;
    let hidden =
        assembly.free().map(|i| certificate::power(&s.residuals[i], &rates[i]).abs()).sum::<f64>()
            / live;
    let (block, allowed) = (&assembly.blocks[s.worst].id, tolerance::LOOSE_BALANCE);
    let text = format!(
        "{when}forces balance every free block: largest equilibrium error {left:.1e} g, on {block}, allowed {allowed:.0e}"
    );
    f.require_graded(left <= allowed, Grade::ToRounding(left), text);
    f.require(
        hidden <= width,
        format!("the equilibrium error can change λ by at most {hidden:.1e}, allowed {width:.1e}"),
    );
    cones(f, &when, model, &s);
}

/// The load factor above which a mechanism gains power.
pub(super) fn upper_end(
    f: &mut Findings,
    model: &Model,
    forces: &Forces,
    rates: &[Rate],
    value: f64,
) -> f64 {
    let assembly = &model.assembly;
    let k = certificate::kinematics(model, rates, forces);
    let exact = motion::motion(model, rates);
    let live = exact.map_or(k.live_power, |m| m.live.lower);
    f.require(
        live > 0.0,
        format!("the live load drives the mechanism: power {:.3e}", k.live_power),
    );
    if exact.is_some_and(|m| m.is_admissible()) {
        f.require_graded(true, Grade::Exact, "the mechanism is admissible: no joint closes");
        return upper_bound(exact, || k.upper());
    }
    // What joints that close by rounding take up of the given forces counts to first order; of the
    // largest on all of them, as a bound.
    let natural = natural_factor(assembly);
    let behind = exact.map_or(k.excess, |m| m.excess) * largest(forces) / live;
    let allowed =
        tolerance::LOAD_FACTOR_BEHIND * value.abs() + tolerance::LOAD_FACTOR_WIDTH * natural;
    f.require_graded(
        behind <= allowed,
        Grade::ToRounding(behind / value.abs().max(natural)),
        format!("the mechanism is admissible: its rounding can change λ by at most {behind:.1e}, allowed {allowed:.1e}"),
    );
    upper_bound(exact, || k.upper())
}

/// The load factor above which a mechanism gains power; where its joints close by rounding, at
/// least `to_first_order`, with what these take up of the forces.
pub fn upper_bound(motion: Option<MotionProof>, to_first_order: impl Fn() -> f64) -> f64 {
    let exactly = |m: MotionProof| (-m.gain()).over(m.live).upper;
    match motion {
        Some(m) if m.is_admissible() => exactly(m),
        Some(m) => exactly(m).max(to_first_order()),
        None => to_first_order(),
    }
}

/// Of two ends between which a load factor is said to lie, those that forces and a mechanism give,
/// as far as rounding tells. Nothing is claimed by them.
pub fn ends(
    model: &Model,
    forces: &Forces,
    rates: &[Rate],
    [lower, upper]: [Option<f64>; 2],
) -> [Option<f64>; 2] {
    if let Some((wide, forces)) = in_every_way(model, forces) {
        return ends(&wide, &forces, rates, [lower, upper]);
    }
    let lower = lower.filter(|lower| {
        let mut f = Findings::default();
        let s = certificate::statics(model, forces, *lower);
        cones(&mut f, "", model, &s);
        s.equilibrium_error <= tolerance::LOOSE_BALANCE && f.fails.is_empty()
    });
    let assembly = &model.assembly;
    let total: f64 = assembly.free().map(|i| certificate::load_scale(assembly, i)).sum();
    let upper = upper.filter(|upper| {
        let k = certificate::kinematics(model, rates, forces);
        let room = tolerance::LOAD_FACTOR_BEHIND * upper.abs();
        let behind = k.excess * largest(forces).max(total);
        k.live_power > 0.0 && k.upper() <= upper + room && behind <= room * k.live_power
    });
    [lower, upper]
}
