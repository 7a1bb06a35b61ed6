//! The thrust on a support: its value from forces, its bound from a mechanism, both re-added from
//! the scene.
//!
//! The thrust is the component `T` along a unit direction `d` of the force that the blocks exert on
//! the support (water in the joints included). Let the support move at the rate `σ d`, the others
//! rest and the free blocks follow at rates `q` with inadmissibility `e` (see [`certificate`]).
//! Virtual work gives for all admissible forces in equilibrium `σ T = w·q + Σ f·v ≥ w·q − D − Σ e
//! f_n`, with `D` the dissipation of cohesion, tension and crushing: a bound from below (σ = 1, the
//! support yields) or above (σ = −1, it is pushed in).
//!
//! The force `T` in a member is bounded in the same way by rates of the scene without it. A dowel
//! holds a shear `a`, ‖a‖ ≤ R, with a component `T` along a direction `w` of the joint: for rates with
//! the power `u` per amount and any `s > 0`, `−a·u = σ T s + a·p` with `p = −u − σ s w`, hence `σ T ≥
//! (w·q − D − Σ e f_n − R ‖p‖) / s`, and the best `s` solves a quadratic (`shear`).

use super::{Forces, Rate, certificate, findings::Findings, joint::water, member, no_forces};
use base::tolerance;
use model::{
    assembly::{Action, Assembly, Member, Wrench},
    interface::{Interfaces, Model},
    strength::laws::unlimited,
};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Which end of the range of thrusts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Extreme {
    /// The least: the support yields.
    Least,
    /// The greatest: the support is pushed in.
    Greatest,
}

impl Extreme {
    /// 1 for the least, −1 for the greatest.
    pub fn sigma(self) -> f64 {
        match self {
            Self::Least => 1.0,
            Self::Greatest => -1.0,
        }
    }
}

/// The support and the direction a thrust is about.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThrustAt {
    /// Index of the support in the scene.
    pub support: usize,
    /// Unit direction.
    pub direction: [f64; 3],
}

/// The member that a force is asked of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemberAt {
    /// Its index in the scene.
    pub member: usize,
    /// Of a dowel: unit direction across the normal of its joint. The force along it on the second
    /// block is meant.
    pub along: Option<[f64; 3]>,
}

impl MemberAt {
    /// What each amount of the member counts for in the force that is asked.
    pub fn shares(&self, own: &Member) -> Vector3<f64> {
        let Some(along) = self.along.map(Vector3::from) else { return Vector3::x() };
        member::legs(own).iter().fold(Vector3::zeros(), |mut sum, leg| {
            sum[leg.axis] += leg.direction.dot(&along);
            sum
        })
    }

    /// Whether a direction is given where the member needs one, across the normal of its joint.
    fn is_of(&self, own: &Member) -> bool {
        match (&own.action, self.along.map(Vector3::from)) {
            (Action::Shear { normal, .. }, Some(along)) => {
                (along.norm() - 1.0).abs() <= tolerance::ALONG
                    && along.dot(normal).abs() <= tolerance::ALONG
            }
            (Action::Shear { .. }, None) => false,
            (_, along) => along.is_none(),
        }
    }
}

/// What an extreme is sought of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sought {
    /// The thrust on a support.
    Thrust(ThrustAt),
    /// The force in a member.
    Member(MemberAt),
}

impl From<ThrustAt> for Sought {
    fn from(at: ThrustAt) -> Self {
        Self::Thrust(at)
    }
}

impl From<&ThrustAt> for Sought {
    fn from(at: &ThrustAt) -> Self {
        Self::Thrust(*at)
    }
}

impl ThrustAt {
    fn d(&self) -> Vector3<f64> {
        self.direction.into()
    }

    /// The thrust that forces exert, N.
    pub fn value(&self, interfaces: &Interfaces, forces: &Forces) -> f64 {
        let mut sum = 0.0;
        for (face, forces) in interfaces.list.iter().zip(forces) {
            let sign = f64::from(u8::from(face.b == self.support))
                - f64::from(u8::from(face.a == self.support));
            if sign != 0.0 {
                let total = forces
                    .iter()
                    .map(|f| f.force)
                    .chain(water(face).map(|w| w.force))
                    .sum::<Vector3<f64>>();
                sum += sign * self.d().dot(&total);
            }
        }
        let joints = interfaces.list.len();
        for (own, forces) in interfaces.members.iter().zip(forces.iter().skip(joints)) {
            let amounts = member::amounts(forces);
            for leg in member::legs(own) {
                let on = |end: Option<usize>| f64::from(u8::from(end == Some(self.support)));
                sum += (on(leg.b) - on(leg.a)) * amounts[leg.axis] * self.d().dot(&leg.direction);
            }
        }
        sum
    }

    /// The rates with the support's own.
    fn with_support(&self, rates: &[Rate], sigma: f64) -> Vec<Rate> {
        let mut rates = rates.to_vec();
        if let Some(rate) = rates.get_mut(self.support) {
            *rate = Rate { velocity: self.d() * sigma, spin: Vector3::zeros() };
        }
        rates
    }
}

impl Sought {
    /// Its value under these forces, N.
    pub fn value(&self, interfaces: &Interfaces, forces: &Forces) -> f64 {
        match self {
            Self::Thrust(at) => at.value(interfaces, forces),
            Self::Member(at) => {
                let shares = at.shares(&interfaces.members[at.member]);
                let own = forces.get(interfaces.list.len() + at.member);
                own.map_or(f64::NAN, |f| member::amounts(f).dot(&shares))
            }
        }
    }

    /// What forces and rates prove about an extreme.
    pub fn bracket(
        &self,
        model: &Model,
        extreme: Extreme,
        forces: &Forces,
        rates: &[Rate],
    ) -> Proof {
        let assembly = &model.assembly;
        let sigma = extreme.sigma();
        let s = certificate::statics(model, forces, 0.0);
        let value = self.value(&model.interfaces, forces);
        let largest = forces.iter().flatten().map(|f| f.force.norm()).fold(0.0, f64::max);
        // As if every contact carried the largest force, or the total load: forces that vanish
        // would hide everything.
        let total: f64 = assembly.free().map(|i| certificate::load_scale(assembly, i)).sum();
        let hidden = |rates: &[Rate]| -> f64 {
            assembly.free().map(|i| certificate::power(&s.residuals[i], &rates[i]).abs()).sum()
        };
        let (bound, hidden, behind) = match self {
            Self::Thrust(at) => {
                let rates = at.with_support(rates, sigma);
                let k = certificate::kinematics(model, &rates, forces);
                let bound = sigma * (k.gain() - k.slack);
                (bound, hidden(&rates), k.excess * largest.max(total))
            }
            Self::Member(at) => {
                let own = &model.interfaces.members[at.member];
                let bounds = member::Bounds::of(own);
                // What its own bounds say needs no mechanism.
                let end = match bounds {
                    member::Bounds::Disc(most) => -sigma * most,
                    _ if sigma > 0.0 => own.least,
                    _ => own.greatest,
                };
                let (others, forces) = without(model, at.member, forces);
                let k = certificate::kinematics(&others, rates, &forces);
                let u = member::power(assembly, own, rates);
                let gain = k.gain() - k.slack;
                // Virtual work without the member: σ T × speed ≥ w·q − D − Σ e f_n.
                let (speed, gain, stray) = match bounds {
                    member::Bounds::Range(..) => (-sigma * u.x, gain, 0.0),
                    member::Bounds::Cone { mu, .. } => {
                        (sigma * (mu * u.y.hypot(u.z) - u.x), gain, 0.0)
                    }
                    member::Bounds::Disc(most) => {
                        let along = u.dot(&at.shares(own));
                        let across = (u.norm_squared() - along * along).max(0.0).sqrt();
                        shear(-sigma * along, across, most, gain)
                    }
                };
                let behind = (k.excess + stray) * largest.max(total) / speed;
                let bound = sigma * gain / speed;
                let moves = speed > 0.0 && rounding(behind, value, total);
                let better = moves && if sigma > 0.0 { bound > end } else { bound < end };
                if better { (bound, hidden(rates) / speed, behind) } else { (end, 0.0, 0.0) }
            }
        };
        let reached = value + sigma * hidden;
        let (lower, upper) =
            if extreme == Extreme::Least { (bound, reached) } else { (reached, bound) };
        Proof { value, lower, upper, behind, statics: s }
    }

    /// Whether the scene has such a support, or such a member.
    fn is_there(&self, f: &mut Findings, model: &Model) -> bool {
        match self {
            Self::Thrust(at) => is_support(f, &model.assembly, at),
            Self::Member(at) => {
                let there =
                    model.interfaces.members.get(at.member).is_some_and(|own| at.is_of(own));
                if !there {
                    f.fails.push("the force is not that of a member along its direction".into());
                }
                there
            }
        }
    }

    fn word(&self) -> &'static str {
        match self {
            Self::Thrust(_) => "thrust",
            Self::Member(_) => "force",
        }
    }
}

/// What a mechanism proves of a dowel's shear in one direction: the speed `s` along it, what it
/// gains beside a force of at most `most` across what is left, and what is left where nothing
/// limits that force. `p` is the rate of yielding along the direction, `q ≥ 0` that across it.
///
/// `(gain − most ‖(p − s, q)‖) / s` is stationary where `most (n² − p s) = gain ‖(p − s, q)‖` with `n²
/// = p² + q²`: a quadratic in `s`. Any `s > 0` is a proof; the best of its roots and `p` is taken.
fn shear(p: f64, q: f64, most: f64, gain: f64) -> (f64, f64, f64) {
    if most == f64::INFINITY {
        return (p, gain, q);
    }
    let (c, n) = (gain / most, p.hypot(q));
    let apart = ((n - c) * (n + c)).max(0.0);
    let root = |sign: f64| (p * apart + sign * c * q * apart.sqrt()) / ((p - c) * (p + c));
    let with = |s: f64| (s, gain - most * (p - s).hypot(q), 0.0);
    let better = |x: (f64, f64, f64), y: (f64, f64, f64)| {
        if y.0 > 0.0 && y.0.is_finite() && (x.0 <= 0.0 || y.1 / y.0 > x.1 / x.0) { y } else { x }
    };
    [root(1.0), root(-1.0)].into_iter().map(with).fold(with(p), better)
}

/// The scene without one of its members, and the forces of the rest.
fn without(model: &Model, m: usize, forces: &Forces) -> (Model, Forces) {
    let mut interfaces = model.interfaces.clone();
    interfaces.members.remove(m);
    let mut forces = forces.clone();
    if interfaces.list.len() + m < forces.len() {
        forces.remove(interfaces.list.len() + m);
    }
    (model.with_interfaces(interfaces), forces)
}

/// Whether what a mechanism could hide, N, is rounding.
fn rounding(behind: f64, value: f64, total: f64) -> bool {
    behind <= tolerance::LOAD_FACTOR_BEHIND * value.abs() + tolerance::LOAD_FACTOR_WIDTH * total
}

/// What forces and a mechanism prove about a thrust.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The thrust of the forces, N.
    pub value: f64,
    /// Lower end of the extreme's bracket, N.
    pub lower: f64,
    /// Upper end, N.
    pub upper: f64,
    /// What the mechanism's inadmissibility could hide if every contact carried the largest force
    /// or the total load, N.
    pub behind: f64,
    /// What the forces leave.
    pub statics: certificate::Residuals,
}

impl Proof {
    /// Whether the mechanism's inadmissibility is rounding; `total` is the total load, N.
    pub fn is_admissible(&self, total: f64) -> bool {
        rounding(self.behind, self.value, total)
    }
}

/// The width of a bracket that counts as found, N.
pub fn width(assembly: &Assembly, value: f64) -> f64 {
    let total: f64 = assembly.free().map(|i| certificate::load_scale(assembly, i)).sum();
    tolerance::THRUST_WIDTH * value.abs() + tolerance::THRUST_FLOOR * total
}

/// The scene without loads, in which endless forces balance by themselves; block weights stay as
/// the scale.
pub fn unloaded(assembly: &Assembly) -> Assembly {
    let mut bare = assembly.clone();
    bare.dead.iter_mut().chain(&mut bare.live).for_each(|w| *w = Wrench::zero());
    bare
}

/// Verifies a least or greatest thrust: its value and bracket.
pub(super) fn verify(
    f: &mut Findings,
    model: &Model,
    (forces, rates): (&Forces, &[Rate]),
    (at, extreme): (&Sought, Extreme),
    [value, lower, upper]: [f64; 3],
) {
    let assembly = &model.assembly;
    if !at.is_there(f, model) {
        return;
    }
    let p = at.bracket(model, extreme, forces, rates);
    let s = &p.statics;
    super::claim::cones(f, "", model, s);
    let loose = tolerance::LOOSE_BALANCE;
    f.require(
        s.equilibrium_error <= loose,
        format!(
            "forces balance every free block: largest equilibrium error {:.1e} g, on {}, allowed {loose:.1e}",
            s.equilibrium_error, assembly.blocks[s.worst].id
        ),
    );
    let width = width(assembly, p.value);
    f.require(
        (p.value - value).abs() <= width,
        format!("the {} of these forces is {:.9e} N, claimed {value:.9e} N", at.word(), p.value),
    );
    let total: f64 = assembly.free().map(|i| certificate::load_scale(assembly, i)).sum();
    f.require(
        p.is_admissible(total),
        format!(
            "the mechanism is admissible: its rounding can change the result by at most {:.1e} of the total load",
            p.behind / total
        ),
    );
    let holds = p.lower >= lower - width && p.upper <= upper + width;
    f.require(
        holds,
        format!(
            "bracket recomputed: [{:.9e}, {:.9e}] N, claimed [{lower:.9e}, {upper:.9e}] N",
            p.lower, p.upper
        ),
    );
    let open = p.upper - p.lower;
    if open.is_nan() || open > 2.0 * width {
        f.fails
            .push(format!("the bracket is too wide: {open:.1e} N, allowed {:.1e} N", 2.0 * width));
    }
}

/// Verifies that a thrust has no end: forces that balance by themselves and push, beside others
/// that balance the loads.
pub(super) fn verify_endless(
    f: &mut Findings,
    model: &Model,
    forces: &Forces,
    base: Option<&Forces>,
    at: &Sought,
    extreme: Extreme,
) {
    let Model { assembly, interfaces, .. } = model;
    if !at.is_there(f, model) {
        return;
    }
    match base {
        Some(base) => super::claim::balanced(f, "", model, base, 0.0),
        None => f.fails.push("forces that balance the loads are missing".into()),
    }
    let (unlimited, kept) = unlimited(interfaces);
    let alone: Forces = kept.iter().map(|&k| forces[k].clone()).collect();
    super::claim::balanced(
        f,
        "without loads, ",
        &Model::new(unloaded(assembly), unlimited),
        &alone,
        0.0,
    );
    // Forces in joints that limit them are not counted.
    let mut counted = no_forces(interfaces);
    kept.iter().zip(alone).for_each(|(&k, forces)| counted[k] = forces);
    let dry: f64 = at.value(interfaces, &counted) - at.value(interfaces, &no_forces(interfaces));
    let total: f64 = assembly.free().map(|i| certificate::load_scale(assembly, i)).sum();
    f.require(
        -extreme.sigma() * dry >= 0.5 * total,
        format!("they push with {dry:.3e} N (at least half the total load of {total:.3e} N is needed) and can be multiplied without limit"),
    );
}

fn is_support(f: &mut Findings, assembly: &Assembly, at: &ThrustAt) -> bool {
    let support = assembly.blocks.get(at.support).is_some_and(|b| b.support);
    let unit = (at.d().norm() - 1.0).abs() <= tolerance::ALONG;
    if !support || !unit {
        f.fails.push("the thrust does not act on a support along a unit direction".into());
    }
    support && unit
}
