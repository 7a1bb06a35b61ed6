//! Verifying a claim from the scene, the forces and the rates: no program, no solver, no trust in any saved number
//! but the forces and the rates themselves.

use super::{
    Evidence, Forces, Rate, Verdict, certificate,
    exact::{
        Grade,
        balance::Unbalance,
        existence,
        motion::{self, MotionProof},
    },
    law, thrust,
    thrust::{Extreme, ThrustAt},
};
use crate::{
    assembly::{Assembly, Wrench},
    interface::{self, Model, Part},
    strength::laws::unlimited,
    tolerance,
};
use serde::{Deserialize, Serialize};

/// What is claimed about a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Claim {
    /// The forces balance the dead load inside the friction cones.
    Stable,
    /// The forces balance the dead load inside the friction cones, but the base forces, which need no pre-stress, leave a motion
    /// that obeys Coulomb's law with them.
    Conditional,
    /// The mechanism gains power under the dead load: nothing balances it.
    Unstable,
    /// The forces balance the dead load and `lower` × the live load; the mechanism admits no more than `upper`.
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

impl Claim {
    /// The verdict that it is; nothing where it is about a number.
    pub fn verdict(&self) -> Option<Verdict> {
        match self {
            Self::Stable => Some(Verdict::Stable),
            Self::Conditional => Some(Verdict::Conditional),
            Self::Unstable => Some(Verdict::Unstable),
            _ => None,
        }
    }
}

/// What the recomputation gave, one line of text each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// What holds, with its number.
    pub holds: Vec<String>,
    /// What does not, with its number.
    pub fails: Vec<String>,
    /// How exactly: the weakest of all that holds.
    pub grade: Grade,
    /// Whether something in it is computed, not proved.
    pub computed: bool,
}

impl Findings {
    pub(super) fn require(&mut self, ok: bool, text: String) {
        if ok { &mut self.holds } else { &mut self.fails }.push(text);
    }

    /// Requires something that is proved with a grade.
    pub(super) fn require_graded(&mut self, ok: bool, grade: Grade, text: impl std::fmt::Display) {
        self.grade = self.grade.and(grade);
        self.require(ok, format!("{text} ({grade})"));
    }

    /// Whether the claim is proved.
    pub fn proved(&self) -> bool {
        self.fails.is_empty() && !self.holds.is_empty()
    }
}

/// Verifies a claim.
pub fn verify(model: &Model, claim: &Claim, evidence: Evidence) -> Findings {
    let Evidence { forces, base, rates } = evidence;
    let assembly = &model.assembly;
    let mut f = Findings::default();
    // How fast a mechanism moves says nothing, but for rates that belong to forces or to a support.
    let unit;
    let rates = match claim {
        Claim::Unstable | Claim::LoadFactor { .. } | Claim::Impossible => {
            unit = certificate::at_unit_speed(assembly, rates);
            &unit[..]
        }
        _ => rates,
    };
    match *claim {
        Claim::Stable => balanced(&mut f, "", model, forces, 0.0),
        Claim::Conditional => {
            balanced(&mut f, "", model, forces, 0.0);
            match base {
                Some(base) => moves(&mut f, model, base, rates),
                None => f.fails.push("the forces without the pre-stress are missing".into()),
            }
        }
        Claim::Unstable => falls(&mut f, model, rates, false),
        Claim::LoadFactor { value, lower, upper } => load_factor(&mut f, model, forces, rates, [value, lower, upper]),
        Claim::DryLoadFactor { value } => dry(&mut f, model, forces, rates, value),
        Claim::Unbounded { standing } => {
            match base {
                Some(base) => balanced(&mut f, "at a load factor at which it stands, ", model, base, standing),
                None => f.fails.push("forces at a load factor at which the scene stands are missing".into()),
            }
            live_alone_balances(&mut f, model, forces);
        }
        Claim::Thrust { at, extreme, value, lower, upper } => {
            thrust::verify(&mut f, model, (forces, rates), (&at, extreme), [value, lower, upper]);
        }
        Claim::EndlessThrust { at, extreme } => thrust::verify_endless(&mut f, model, forces, base, &at, extreme),
        Claim::Impossible => falls(&mut f, model, rates, true),
    }
    f
}

/// The rates gain no power from the live load, so that no multiple of it stops them.
fn without_live_power(f: &mut Findings, model: &Model, rates: &[Rate]) {
    let assembly = &model.assembly;
    let Some(m) = motion::motion(model, rates) else {
        return f.fails.push("a joint that can crush closes: that bounds no load factor".into());
    };
    let live = m.live.magnitude();
    if live == 0.0 {
        return f.holds.push("the live load has no power on it, whatever its multiple (exact)".into());
    }
    // Each load by what it does on the blocks that move.
    let norm = |loads: &[Wrench]| -> f64 {
        assembly.free().map(|i| certificate::size(assembly, i, &loads[i]) * certificate::speed(assembly, i, &rates[i])).sum()
    };
    let reach = m.gain().lower / norm(&assembly.dead) / (live / norm(&assembly.live));
    f.require_graded(
        reach >= REACH,
        Grade::ToRounding(1.0 / reach),
        format!("the live load gains no power: the proof holds for load factors up to {reach:.1e} × dead / live load of what moves"),
    );
}

/// Forces that balance the live load alone: added to others as often as wanted, they leave the scene standing.
fn live_alone_balances(f: &mut Findings, model: &Model, forces: &Forces) {
    let Model { assembly, interfaces, .. } = model;
    f.require(assembly.free().any(|i| assembly.live[i] != Wrench::zero()), "there is a live load".into());
    // Forces in joints that limit them are not counted: nothing that has a limit wedges.
    let (unlimited, kept) = unlimited(interfaces);
    let counted = kept.iter().map(|&k| forces[k].clone()).collect();
    let mut alone = assembly.clone();
    for (dead, live) in alone.dead.iter_mut().zip(&mut alone.live) {
        *dead = std::mem::replace(live, Wrench::zero());
    }
    by_themselves(f, "under the live load alone, ", &Model::new(alone, unlimited), &counted);
}

/// Forces and a mechanism that obey Coulomb's law together.
fn dry(f: &mut Findings, model: &Model, forces: &Forces, rates: &[Rate], value: f64) {
    let assembly = &model.assembly;
    let s = certificate::statics(model, forces, value);
    cones(f, "", model, &s);
    let allowed = tolerance::DRY_BALANCE;
    f.require(
        s.unbalance <= allowed,
        format!("forces balance every free block at λ = {value}: largest unbalance {:.1e} g, allowed {allowed:.0e}", s.unbalance),
    );
    let k = certificate::kinematics(model, rates, forces);
    f.require(k.live_power > 0.0, format!("the live load drives the mechanism: power {:.3e}", k.live_power));
    let map = law::natural_map(model, forces, rates).unwrap_or(f64::INFINITY);
    f.require(
        map <= tolerance::DRY_LAW,
        format!("forces and mechanism obey Coulomb's law: natural map {map:.1e}, allowed {:.0e}", tolerance::DRY_LAW),
    );
    let in_loads = dry_map(model, forces, rates);
    f.require(
        in_loads <= tolerance::NATURAL_MAP,
        format!("with rates as the live load drives them: natural map {in_loads:.1e}, allowed {:.0e}", tolerance::NATURAL_MAP),
    );
    // Where the live load is small beside the dead load, far more of it is no more than rounding of a block's balance.
    let hidden = assembly.free().map(|i| certificate::power(&s.residuals[i], &rates[i]).abs()).sum::<f64>() / k.live_power;
    // What stands beside it makes no room.
    let natural = moving(model, forces, rates)
        .map_or_else(|| natural_factor(assembly), |(part, ..)| part.units.load_factor(natural_factor(&part.model.assembly)));
    let width = tolerance::DRY_WIDTH * value.abs() + tolerance::LOAD_FACTOR_FLOOR * natural;
    f.require(hidden <= width, format!("what the forces leave hides at most {hidden:.1e} of λ, allowed {width:.1e}"));
}

/// The natural map of a mechanism with the rates as the live load drives them.
pub fn dry_map(model: &Model, forces: &Forces, rates: &[Rate]) -> f64 {
    law::natural_map_in_loads(model, forces, rates).unwrap_or(f64::INFINITY)
}

/// Forces from which a motion starts that obeys Coulomb's law with them.
fn moves(f: &mut Findings, model: &Model, base: &Forces, rates: &[Rate]) {
    let assembly = &model.assembly;
    cones(f, "without a pre-stress, ", model, &certificate::statics(model, base, 0.0));
    let m = law::motion(model, base);
    f.require(
        m.acceleration >= tolerance::LEAST_MOTION,
        format!("without a pre-stress a block is left with {:.3e} g, at least {:.0e} needed", m.acceleration, tolerance::LEAST_MOTION),
    );
    f.require(
        m.natural_map <= tolerance::MOTION_LAW,
        format!("forces and motion obey Coulomb's law: natural map {:.1e}, allowed {:.0e}", m.natural_map, tolerance::MOTION_LAW),
    );
    let allowed = tolerance::MOTION_BREACH * m.acceleration;
    f.require(
        m.natural_map_in_loads <= allowed,
        format!("to far less than that motion: natural map in g {:.1e}, allowed {allowed:.0e}", m.natural_map_in_loads),
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
pub(super) fn balanced(f: &mut Findings, when: &str, model: &Model, forces: &Forces, lambda: f64) {
    let assembly = &model.assembly;
    let scale = |i: usize| certificate::load_scale(assembly, i).max(lambda.abs() * certificate::size(assembly, i, &assembly.live[i]));
    balanced_against(f, when, model, forces, lambda, &scale);
}

/// Forces that balance without any load, or one that stands in the place of the dead load: each block by its own load, by the contact
/// forces on it where it has none.
pub(super) fn by_themselves(f: &mut Findings, when: &str, model: &Model, forces: &Forces) {
    let Model { assembly, interfaces, .. } = model;
    let mut greatest = vec![0.0_f64; assembly.blocks.len()];
    for (face, forces) in interfaces.list.iter().zip(forces) {
        let most = largest(std::slice::from_ref(forces));
        [face.a, face.b].into_iter().for_each(|i| greatest[i] = greatest[i].max(most));
    }
    let scale = |i: usize| match certificate::size(assembly, i, &assembly.dead[i]) {
        0.0 => greatest[i],
        own => own,
    };
    balanced_against(f, when, model, forces, 0.0, &scale);
}

/// Forces that balance at `lambda`, each block by its own `scale`, N.
fn balanced_against(f: &mut Findings, when: &str, model: &Model, forces: &Forces, lambda: f64, scale: &dyn Fn(usize) -> f64) {
    let assembly = &model.assembly;
    let left = Left::of(model, forces, lambda, scale);
    held(f, when, assembly, &left);
    cones(f, when, model, &certificate::statics(model, forces, lambda));
}

/// What forces leave, over the scale of the block.
struct Left {
    /// Where no forces that balance exactly are [covered](existence::covered) nearby; on any block where there are everywhere.
    greatest: Unbalance,
    /// Whether there are everywhere.
    exists: bool,
}

impl Left {
    fn of(model: &Model, forces: &Forces, lambda: f64, scale: &dyn Fn(usize) -> f64) -> Self {
        let covered = existence::covered(model, forces, lambda);
        let exists = covered.iter().all(|held| *held);
        let counted = |i: usize| if covered[i] && !exists { f64::INFINITY } else { scale(i) };
        Self { greatest: Unbalance::of(model, forces, lambda, &counted), exists }
    }

    /// Whether that proves that the blocks are held.
    fn is_balanced(&self) -> bool {
        self.exists || self.greatest.greatest <= tolerance::UNBALANCE
    }
}

fn held(f: &mut Findings, when: &str, assembly: &Assembly, left: &Left) {
    let (by, id) = (left.greatest.greatest, &assembly.blocks[left.greatest.block].id);
    if left.exists {
        let text = format!("{when}forces that balance every free block exist inside their cones, within {by:.1e} g of the given ones");
        f.require_graded(true, Grade::Exact, text);
    } else {
        let allowed = tolerance::UNBALANCE;
        let text = format!("{when}forces balance every free block: largest unbalance {by:.1e} g, on {id}, allowed {allowed:.1e}");
        f.require_graded(left.is_balanced(), Grade::ToRounding(by), text);
    }
}

pub(super) fn cones(f: &mut Findings, when: &str, model: &Model, s: &certificate::Residuals) {
    f.require(
        s.cone_excess <= tolerance::CONE,
        format!("{when}forces lie in their friction cones: largest excess {:.1e} of the force", s.cone_excess),
    );
    if s.crushing > 0.0 {
        let (used, joint) = (100.0 * s.crushing, joint(model, s.most_pressed));
        let text = format!("{when}no joint is pressed beyond its compressive strength: at most {used:.4} % of it, in {joint}");
        f.require(s.is_within_strength(), text);
    }
}

/// The parts of a scene that move, each in its own units, with its rates: what the others weigh is no matter of its proof.
fn moving_parts(model: &Model, rates: &[Rate]) -> Vec<(Part, Vec<Rate>)> {
    let moves = |part: &Part| part.blocks.iter().any(|&i| rates[i] != Rate::zero());
    let in_its_units = |part: Part| {
        let own = part.blocks.iter().map(|&i| Rate { velocity: rates[i].velocity, spin: part.units.own_spin(&rates[i].spin) }).collect();
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

/// A scene falls where one of its parts does: what moves gains power and closes no joint, each part for itself, whatever the others weigh. Where no
/// live load may help (`for_good`), it has no power on one of them, or none on all of them together.
fn falls(f: &mut Findings, model: &Model, rates: &[Rate], for_good: bool) {
    let meets = |model: &Model, rates: &[Rate]| {
        let [mut gain, mut live] = [Findings::default(), Findings::default()];
        gains(&mut gain, model, rates);
        if for_good {
            without_live_power(&mut live, model, rates);
        }
        [gain, live]
    };
    let parts = moving_parts(model, rates);
    let mut list: Vec<[Findings; 2]> = parts.iter().map(|(part, rates)| meets(&part.model, rates)).collect();
    // Of two parts the live load may drive one and hold back the other: then they prove together what neither does by itself.
    let proves = |own: &[Findings; 2]| own.iter().all(|f| f.fails.is_empty());
    if list.is_empty() || (for_good && !list.iter().any(proves)) {
        list = vec![meets(model, rates)];
    }
    // The part that is proved best speaks for all; of the others only what fails is told.
    let decides = (0..list.len()).min_by_key(|&k| list[k].iter().map(|own| own.fails.len()).sum::<usize>()).unwrap_or(0);
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
fn gains(f: &mut Findings, model: &Model, rates: &[Rate]) {
    let Model { assembly, interfaces, .. } = model;
    let none = super::no_forces(interfaces);
    let k = certificate::kinematics(model, rates, &none);
    let exact = motion::motion(model, rates);
    let gain = exact.map_or(k.gain(), |m| m.gain().lower);
    let threshold = tolerance::UNBALANCE;
    f.require(gain > threshold * k.norm, format!("the mechanism gains power: {:.3e} g, at least {threshold:.1e} needed", gain / k.norm));
    if exact.is_some_and(|m| m.is_admissible()) {
        return f.require_graded(true, Grade::Exact, "the mechanism is admissible: no joint closes");
    }
    let cap = k.force_cap(assembly);
    f.require_graded(
        k.is_admissible(assembly),
        Grade::ToRounding(1.0 / cap),
        format!(
            // Rounding: its size is worth telling, its digits are not.
            "the mechanism is admissible: joints close by less than {:.0e} of its speed; only contact forces above {:.0e} × the total load could hide behind that",
            decade(k.inadmissibility, f64::ceil),
            decade(cap, f64::floor)
        ),
    );
}

/// The two blocks of a joint.
fn joint(model: &Model, k: usize) -> String {
    let Model { assembly, interfaces, .. } = model;
    let face = &interfaces.list[k];
    format!("{} | {}", assembly.blocks[face.a].id, assembly.blocks[face.b].id)
}

/// The power of ten next to a number.
fn decade(x: f64, round: fn(f64) -> f64) -> f64 {
    10f64.powf(round(x.log10()))
}

/// Forces at `lower` from below and a mechanism from above.
fn load_factor(f: &mut Findings, model: &Model, forces: &Forces, rates: &[Rate], [value, lower, upper]: [f64; 3]) {
    let assembly = &model.assembly;
    let (high, natural) = match moving(model, forces, rates) {
        Some((part, own, rates)) => {
            let high = upper_end(f, &part.model, &own, &rates, part.units.own_load_factor(value));
            (part.units.load_factor(high), part.units.load_factor(natural_factor(&part.model.assembly)))
        }
        None => (upper_end(f, model, forces, rates, value), natural_factor(assembly)),
    };
    f.require(high <= upper, format!("the mechanism bounds the load factor: recomputed {high:.12}, claimed {upper:.12}"));
    // A bracket may be true and wide; a load factor below the limit is still not the limit. NaN is not narrow.
    let width = tolerance::LOAD_FACTOR_WIDTH * lower.abs() + tolerance::LOAD_FACTOR_FLOOR * natural;
    supported(f, model, (forces, rates), lower, width);
    let (open, narrow) = (upper - lower, 2.0 * width);
    if open.is_nan() || open.abs() > narrow {
        f.fails.push(format!("the two sides do not meet: bracket {open:.1e} wide, allowed {narrow:.1e}"));
    }
    f.require(lower <= value && value <= upper, format!("λ = {value:.12} lies in its bracket"));
}

/// Forces that hold the scene at the lower end of a load factor. What they leave unbalanced counts with the power that it has on the
/// mechanism, and may be more than elsewhere where that is next to nothing.
fn supported(f: &mut Findings, model: &Model, (forces, rates): (&Forces, &[Rate]), lower: f64, width: f64) {
    let assembly = &model.assembly;
    let scale = |i: usize| certificate::load_scale(assembly, i).max(lower.abs() * certificate::size(assembly, i, &assembly.live[i]));
    let when = format!("at λ = {lower}, ");
    let left = Left::of(model, forces, lower, &scale);
    let s = certificate::statics(model, forces, lower);
    if left.is_balanced() {
        held(f, &when, assembly, &left);
        return cones(f, &when, model, &s);
    }
    let left = left.greatest.greatest;
    let live = certificate::kinematics(model, rates, forces).live_power;
    let hidden = assembly.free().map(|i| certificate::power(&s.residuals[i], &rates[i]).abs()).sum::<f64>() / live;
    let (block, allowed) = (&assembly.blocks[s.worst].id, tolerance::LOOSE_BALANCE);
    let text = format!("{when}forces balance every free block: largest unbalance {left:.1e} g, on {block}, allowed {allowed:.0e}");
    f.require_graded(left <= allowed, Grade::ToRounding(left), text);
    f.require(hidden <= width, format!("what they leave hides at most {hidden:.1e} of λ, allowed {width:.1e}"));
    cones(f, &when, model, &s);
}

/// The load factor above which a mechanism gains power.
fn upper_end(f: &mut Findings, model: &Model, forces: &Forces, rates: &[Rate], value: f64) -> f64 {
    let assembly = &model.assembly;
    let k = certificate::kinematics(model, rates, forces);
    let exact = motion::motion(model, rates);
    let live = exact.map_or(k.live_power, |m| m.live.lower);
    f.require(live > 0.0, format!("the live load drives the mechanism: power {:.3e}", k.live_power));
    if exact.is_some_and(|m| m.is_admissible()) {
        f.require_graded(true, Grade::Exact, "the mechanism is admissible: no joint closes");
        return upper_bound(exact, || k.upper());
    }
    // What joints that close by rounding take up of the given forces counts to first order; of the largest on all of them, as a bound.
    let natural = natural_factor(assembly);
    let behind = exact.map_or(k.excess, |m| m.excess) * largest(forces) / live;
    let allowed = tolerance::LOAD_FACTOR_BEHIND * value.abs() + tolerance::LOAD_FACTOR_WIDTH * natural;
    f.require_graded(
        behind <= allowed,
        Grade::ToRounding(behind / value.abs().max(natural)),
        format!("the mechanism is admissible: its rounding could hide at most {behind:.1e} of λ, allowed {allowed:.1e}"),
    );
    upper_bound(exact, || k.upper())
}

/// The load factor above which a mechanism gains power; where its joints close by rounding, at least `to_first_order`, with what these take up of
/// the forces.
pub fn upper_bound(motion: Option<MotionProof>, to_first_order: impl Fn() -> f64) -> f64 {
    let exactly = |m: MotionProof| (-m.gain()).over(m.live).upper;
    match motion {
        Some(m) if m.is_admissible() => exactly(m),
        Some(m) => exactly(m).max(to_first_order()),
        None => to_first_order(),
    }
}

/// The greatest contact force, N.
pub(super) fn largest(forces: &[Vec<Wrench>]) -> f64 {
    forces.iter().flatten().map(|v| v.force.norm()).fold(0.0, f64::max)
}
