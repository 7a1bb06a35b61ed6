//! Verifying a claim from the scene, the forces and the rates: no program, no solver, no trust in any saved number
//! but the forces and the rates themselves.

use super::{
    Forces, Rate, certificate, law,
    thrust::{self, Extreme, ThrustAt},
};
use crate::{
    assembly::{Assembly, Wrench},
    interface::Interfaces,
    tolerance,
};
use serde::{Deserialize, Serialize};

/// What is claimed about a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Claim {
    /// The forces balance the dead load inside the friction cones.
    Stable,
    /// The forces balance the dead load inside the friction cones, but the base forces, which need no pre-stress, leave a motion
    /// that obeys Coulomb's law with them.
    Conditional,
    /// The mechanism gains power under the dead load: nothing balances it.
    Unstable,
    /// The forces balance the dead load and `value` × the live load; the mechanism admits no more than `upper`.
    LoadFactor {
        /// Claimed load factor.
        value: f64,
        /// Claimed lower end.
        lower: f64,
        /// Claimed upper end.
        upper: f64,
    },
    /// The forces balance the dead load and `value` × the live load, and the mechanism, driven by the live load, obeys
    /// Coulomb's law with them: a load factor with dry friction (not the only one, perhaps).
    DryLoadFactor {
        /// Claimed load factor.
        value: f64,
    },
    /// The forces balance the live load alone (and other forces the scene at load factor `standing`).
    Unbounded {
        /// A load factor at which the scene stands.
        standing: f64,
    },
    /// The mechanism gains power under the dead load and none under the live load.
    Impossible,
    /// The forces balance the dead load and push a support with `value`; the mechanism that follows the support admits nothing beyond the
    /// bracket on the other side.
    Thrust {
        /// Where, and in which direction.
        at: ThrustAt,
        /// Least or greatest.
        extreme: Extreme,
        /// Claimed thrust, N.
        value: f64,
        /// Claimed lower end, N.
        lower: f64,
        /// Claimed upper end, N.
        upper: f64,
    },
    /// The forces balance without any load and push a support (and other forces balance the dead load): the thrust has no end.
    EndlessThrust {
        /// Where, and in which direction.
        at: ThrustAt,
        /// Least or greatest.
        extreme: Extreme,
    },
}

/// What the recomputation gave, one line of text each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// What holds, with its number.
    pub holds: Vec<String>,
    /// What does not, with its number.
    pub fails: Vec<String>,
}

impl Findings {
    pub(super) fn require(&mut self, ok: bool, text: String) {
        if ok { &mut self.holds } else { &mut self.fails }.push(text);
    }

    /// Whether the claim is proved.
    pub fn proved(&self) -> bool {
        self.fails.is_empty() && !self.holds.is_empty()
    }
}

/// Verifies a claim. `base` are the forces at `standing` of [`Claim::Unbounded`].
pub fn verify(
    assembly: &Assembly,
    interfaces: &Interfaces,
    claim: &Claim,
    forces: &Forces,
    base: Option<&Forces>,
    rates: &[Rate],
) -> Findings {
    let mut f = Findings::default();
    match *claim {
        Claim::Stable => balanced(&mut f, "", assembly, interfaces, forces, 0.0),
        Claim::Conditional => {
            balanced(&mut f, "", assembly, interfaces, forces, 0.0);
            match base {
                Some(base) => moves(&mut f, assembly, interfaces, base, rates),
                None => f.fails.push("the forces without the pre-stress are missing".into()),
            }
        }
        Claim::Unstable => gains(&mut f, assembly, interfaces, rates),
        Claim::LoadFactor { value, lower, upper } => load_factor(&mut f, assembly, interfaces, forces, rates, [value, lower, upper]),
        Claim::DryLoadFactor { value } => dry(&mut f, assembly, interfaces, forces, rates, value),
        Claim::Unbounded { standing } => {
            match base {
                Some(base) => balanced(&mut f, "at a load factor at which it stands, ", assembly, interfaces, base, standing),
                None => f.fails.push("forces at a load factor at which the scene stands are missing".into()),
            }
            let (alone, factor) = live_alone(assembly);
            f.require(factor.is_finite() && factor > 0.0, "there is a live load".into());
            // Forces in joints that limit them are not counted: nothing that has a limit wedges.
            let (unlimited, kept) = interfaces.unlimited();
            let scaled = kept.iter().map(|&k| forces[k].iter().map(|&v| v * factor).collect()).collect();
            balanced(&mut f, "under the live load alone, ", &alone, &unlimited, &scaled, 0.0);
        }
        Claim::Thrust { at, extreme, value, lower, upper } => {
            thrust::verify(&mut f, assembly, interfaces, (forces, rates), (&at, extreme), [value, lower, upper]);
        }
        Claim::EndlessThrust { at, extreme } => thrust::verify_endless(&mut f, assembly, interfaces, forces, base, &at, extreme),
        Claim::Impossible => {
            gains(&mut f, assembly, interfaces, rates);
            let k = certificate::kinematics(assembly, interfaces, rates, forces);
            let natural = natural_factor(assembly);
            let reach = (k.gain() / k.live_power).abs() / natural;
            f.require(
                reach >= REACH && natural.is_finite(),
                format!("the live load gains no power: the proof holds for load factors up to {reach:.1e} × dead / live load"),
            );
        }
    }
    f
}

/// Forces and a mechanism that obey Coulomb's law together.
fn dry(f: &mut Findings, assembly: &Assembly, interfaces: &Interfaces, forces: &Forces, rates: &[Rate], value: f64) {
    let s = certificate::statics(assembly, interfaces, forces, value);
    cones(f, "", assembly, interfaces, &s);
    let allowed = tolerance::DRY_BALANCE.max(s.resolution);
    f.require(
        s.unbalance <= allowed,
        format!("forces balance every free block at λ = {value}: largest unbalance {:.1e} g, allowed {allowed:.0e}", s.unbalance),
    );
    let k = certificate::kinematics(assembly, interfaces, rates, forces);
    f.require(k.live_power > 0.0, format!("the live load drives the mechanism: power {:.3e}", k.live_power));
    let map = law::natural_map(assembly, interfaces, forces, rates).unwrap_or(f64::INFINITY);
    f.require(
        map <= tolerance::DRY_LAW,
        format!("forces and mechanism obey Coulomb's law: natural map {map:.1e}, allowed {:.0e}", tolerance::DRY_LAW),
    );
    let in_loads = dry_map(assembly, interfaces, forces, rates);
    f.require(
        in_loads <= tolerance::NATURAL_MAP,
        format!("with rates as the live load drives them: natural map {in_loads:.1e}, allowed {:.0e}", tolerance::NATURAL_MAP),
    );
}

/// The natural map of a mechanism with the rates as the live load drives them.
pub fn dry_map(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces, rates: &[Rate]) -> f64 {
    let k = certificate::kinematics(assembly, interfaces, rates, forces);
    let power = k.live_power * natural_factor(assembly);
    law::natural_map_in_loads(assembly, interfaces, forces, rates, power).unwrap_or(f64::INFINITY)
}

/// Forces from which a motion starts that obeys Coulomb's law with them.
fn moves(f: &mut Findings, assembly: &Assembly, interfaces: &Interfaces, base: &Forces, rates: &[Rate]) {
    cones(f, "without a pre-stress, ", assembly, interfaces, &certificate::statics(assembly, interfaces, base, 0.0));
    let m = law::motion(assembly, interfaces, base);
    f.require(
        m.acceleration >= tolerance::LEAST_MOTION,
        format!("without a pre-stress a block is left with {:.3e} g, at least {:.0e} needed", m.acceleration, tolerance::LEAST_MOTION),
    );
    f.require(
        m.natural_map <= tolerance::MOTION_LAW,
        format!("forces and motion obey Coulomb's law: natural map {:.1e}, allowed {:.0e}", m.natural_map, tolerance::MOTION_LAW),
    );
    let dot = |a: &[Rate], b: &[Rate]| -> f64 {
        assembly
            .free()
            .map(|i| {
                let gyration = &assembly.blocks[i].gyration;
                a[i].velocity.dot(&b[i].velocity) + gyration.speed(&a[i].spin).dot(&gyration.speed(&b[i].spin))
            })
            .sum()
    };
    let cosine = dot(rates, &m.rates) / (dot(rates, rates) * dot(&m.rates, &m.rates)).sqrt();
    f.require(cosine >= 1.0 - tolerance::MOTION_LAW, format!("the rates are that motion: cosine {cosine:.6}"));
}

/// "Impossible" is proved when no load factor below this × (dead / live load) helps. Larger: rounding of ℓ·q = 0 fails a
/// correct proof. Smaller: a load factor that does help could be missed.
const REACH: f64 = 1e6;

/// Total dead over total live load: the size a load factor has when both weigh the same.
pub fn natural_factor(assembly: &Assembly) -> f64 {
    let sum = |loads: &[Wrench]| assembly.free().map(|i| certificate::size(assembly, i, &loads[i])).sum::<f64>();
    sum(&assembly.dead) / sum(&assembly.live)
}

/// The assembly with its live load, brought to the size of the dead load, in place of the dead load; and that factor.
pub fn live_alone(assembly: &Assembly) -> (Assembly, f64) {
    let factor = natural_factor(assembly);
    let mut alone = assembly.clone();
    for (dead, live) in alone.dead.iter_mut().zip(&mut alone.live) {
        *dead = Wrench { force: live.force * factor, moment: live.moment * factor };
        *live = Wrench::zero();
    }
    (alone, factor)
}

/// `when` says which of several sets of forces is meant.
pub(super) fn balanced(f: &mut Findings, when: &str, assembly: &Assembly, interfaces: &Interfaces, forces: &Forces, lambda: f64) {
    let s = certificate::statics(assembly, interfaces, forces, lambda);
    let threshold = tolerance::UNBALANCE.max(s.resolution);
    f.require(
        s.balanced,
        format!(
            "{when}forces balance every free block: largest unbalance {:.1e} g, on {}, allowed {threshold:.1e}",
            s.unbalance, assembly.blocks[s.worst].id
        ),
    );
    cones(f, when, assembly, interfaces, &s);
}

pub(super) fn cones(f: &mut Findings, when: &str, assembly: &Assembly, interfaces: &Interfaces, s: &certificate::Statics) {
    f.require(
        s.cone_excess <= tolerance::CONE,
        format!("{when}forces lie in their friction cones: largest excess {:.1e} of the force", s.cone_excess),
    );
    if s.crushing > 0.0 {
        let (used, joint) = (100.0 * s.crushing, joint(assembly, interfaces, s.most_pressed));
        let text = format!("{when}no joint is pressed beyond its compressive strength: at most {used:.4} % of it, in {joint}");
        f.require(s.is_within_strength(), text);
    }
}

fn gains(f: &mut Findings, assembly: &Assembly, interfaces: &Interfaces, rates: &[Rate]) {
    let none = super::no_forces(interfaces);
    let k = certificate::kinematics(assembly, interfaces, rates, &none);
    let resolution = certificate::statics(assembly, interfaces, &none, 0.0).resolution;
    let gain = k.gain() / k.norm;
    let threshold = tolerance::UNBALANCE.max(resolution);
    f.require(gain > threshold, format!("the mechanism gains power: {gain:.3e} g, at least {threshold:.1e} needed"));
    let cap = k.force_cap(assembly);
    let closing = if cap.is_infinite() {
        "no joint closes".to_string()
    } else {
        format!(
            // Rounding: its size is worth telling, its digits are not.
            "joints close by less than {:.0e} of its speed; only contact forces above {:.0e} × the total load could hide behind that",
            decade(k.inadmissibility, f64::ceil),
            decade(cap, f64::floor)
        )
    };
    f.require(k.is_admissible(assembly), format!("the mechanism is admissible: {closing}"));
}

/// The two blocks of a joint.
fn joint(assembly: &Assembly, interfaces: &Interfaces, k: usize) -> String {
    let face = &interfaces.list[k];
    format!("{} | {}", assembly.blocks[face.a].id, assembly.blocks[face.b].id)
}

/// The power of ten next to a number.
fn decade(x: f64, round: fn(f64) -> f64) -> f64 {
    10f64.powf(round(x.log10()))
}

fn load_factor(
    f: &mut Findings,
    assembly: &Assembly,
    interfaces: &Interfaces,
    forces: &Forces,
    rates: &[Rate],
    [value, lower, upper]: [f64; 3],
) {
    let s = certificate::statics(assembly, interfaces, forces, value);
    cones(f, "", assembly, interfaces, &s);
    let k = certificate::kinematics(assembly, interfaces, rates, forces);
    let hidden: f64 = assembly.free().map(|i| certificate::power(&s.residuals[i], &rates[i]).abs()).sum();
    f.require(k.live_power > 0.0, format!("the live load drives the mechanism: power {:.3e}", k.live_power));
    let natural = natural_factor(assembly);
    let width = |v: f64| tolerance::LOAD_FACTOR_WIDTH * v.abs() + tolerance::LOAD_FACTOR_FLOOR * natural;
    let loose = tolerance::LOOSE_BALANCE.max(s.resolution);
    f.require(
        s.unbalance <= loose,
        format!(
            "forces balance every free block at λ = {value}: largest unbalance {:.1e} g, on {}, allowed {loose:.1e}",
            s.unbalance, assembly.blocks[s.worst].id
        ),
    );
    let behind = k.behind(forces);
    let allowed = tolerance::LOAD_FACTOR_BEHIND * value.abs() + tolerance::LOAD_FACTOR_WIDTH * natural;
    f.require(
        behind <= allowed,
        format!("the mechanism is admissible: its rounding could hide at most {behind:.1e} of λ, allowed {allowed:.1e}"),
    );
    let (low, high) = (value - hidden / k.live_power, k.upper());
    f.require(
        low >= lower - width(value) && high <= upper + width(value),
        format!("bracket recomputed: [{low:.12}, {high:.12}], claimed [{lower:.12}, {upper:.12}]"),
    );
    // A bracket may be true and wide; a load factor below the limit is still not the limit. NaN is not narrow.
    let (open, narrow) = (high - low, 2.0 * width(value));
    if open.is_nan() || open.abs() > narrow {
        f.fails.push(format!("the two sides do not meet: bracket {open:.1e} wide, allowed {narrow:.1e}"));
    }
    f.require(lower - width(value) <= value && value <= upper + width(value), format!("λ = {value:.12} lies in its bracket"));
}
