//! The Lagrangian of a load factor at the forces and rates that prove it, on the data of a scene in
//! which a number is another one.

use super::{
    numbers::Number,
    varied::{Under, Varied},
};
use crate::verdict::{
    Forces, Rate, at, certificate,
    joint::{Strength, rolling_arm, tension},
    member::{self, Bounds},
};
use base::tolerance;
use model::{
    assembly::{Member, Wrench},
    interface::{Interface, Model},
    strength::{
        crushing::{closing_volume, crushes},
        laws::are_dry,
    },
};
use nalgebra::{Rotation3, Vector3};
use scene::{Friction, Touches};

/// A number is changed by this × its scale. What does not depend on shapes is linear in the numbers,
/// and the difference exact but for rounding. Larger: loads at the edge of a block leave it. Smaller:
/// rounding of the loads of large scenes counts.
const STEP: f64 = 1e-6;
/// The same of what contacts depend on, which are found to [`tolerance::WELD`] of the blocks.
const STEP_OF_SHAPES: f64 = 1e-4;
/// A strength of zero grows by so many of its units.
const STEP_FROM_ZERO: f64 = 1e-3;

/// Forces and rates that prove a load factor from both sides, with the multipliers of the strengths.
pub struct Proof<'a> {
    /// The scene under its load.
    pub model: &'a Model,
    /// The forces.
    pub forces: &'a Forces,
    /// The rates.
    pub rates: &'a [Rate],
    /// The load factor λ.
    pub value: f64,
    /// Power of the live load, W in the scale of the rates.
    pub live: f64,
    /// Speed of the fastest corner, m/s.
    pub(super) fastest: f64,
    joints: Vec<Vec<Corner>>,
}

/// Rates of a corner of a joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Velocity of block `b` against `a`, m/s.
    pub velocity: Vector3<f64>,
    /// Along the joint, m/s.
    pub sliding: f64,
    /// By how much more than friction lifts it it opens, m/s; negative where it closes.
    pub opening: f64,
    /// Rolling and twisting together, rad/s.
    pub rolling: f64,
}

/// How the data of a scene change with a number, per unit of it.
pub(super) struct Change {
    /// What the forces leave out of balance on each block, N and N·m.
    pub loads: Vec<Wrench>,
    /// What friction and strengths leave, by the multipliers, W.
    pub room: f64,
    /// There is no such scene.
    pub is_none: bool,
}

/// A scene with a little less and a little more of a number, and how much more.
pub(super) struct Pair {
    pub less: Option<Model>,
    pub more: Option<Model>,
    /// How far each is from the number itself.
    pub step: f64,
}

impl Pair {
    /// Models with the weights by which what is computed on them makes a change per unit of the
    /// number; none where there is no such scene.
    pub fn sides<'b>(&'b self, own: &'b Model) -> Vec<(&'b Model, f64)> {
        match (&self.less, &self.more) {
            (Some(less), Some(more)) => vec![(more, 0.5 / self.step), (less, -0.5 / self.step)],
            (Some(less), None) => vec![(own, 1.0 / self.step), (less, -1.0 / self.step)],
            (None, Some(more)) => vec![(more, 1.0 / self.step), (own, -1.0 / self.step)],
            (None, None) => Vec::new(),
        }
    }
}

impl<'a> Proof<'a> {
    /// Forces and rates on the model that they are about; nothing where the load does not drive the
    /// rates, or edges meet others with several normals.
    pub fn new(
        model: &'a Model,
        forces: &'a Forces,
        rates: &'a [Rate],
        value: f64,
    ) -> Option<Self> {
        let live: f64 = model
            .assembly
            .free()
            .map(|i| certificate::power(&model.assembly.live[i], &rates[i]))
            .sum();
        let list = &model.interfaces.list;
        let fits = forces.len() == list.len() + model.interfaces.members.len();
        if !(live > 0.0 && fits && list.iter().all(|f| f.ways.is_empty())) {
            return None;
        }
        let joints: Vec<Vec<Corner>> = list.iter().map(|f| corners(model, rates, f)).collect();
        let speeds = joints.iter().flatten().map(|c| c.velocity.norm());
        let fastest = speeds.fold(0.0, f64::max);
        Some(Self { model, forces, rates, value, live, fastest, joints })
    }

    /// Rates of the corners of a joint.
    pub(super) fn corners(&self, face: usize) -> &[Corner] {
        &self.joints[face]
    }

    /// The scene beside a number on both sides.
    pub(super) fn beside(&self, varied: &Varied, number: &Number) -> Pair {
        let step = match (number.touches, number.value == 0.0 && !number.place) {
            (_, true) => STEP_FROM_ZERO,
            (Touches::Shapes, _) => STEP_OF_SHAPES * varied.scale(number),
            _ => STEP * varied.scale(number),
        };
        let with = |value: f64| {
            let allowed = number.signed || value >= 0.0;
            let model = allowed.then(|| varied.at(number, value, self.value).ok()).flatten()?;
            self.is_alike(&model).then_some(model)
        };
        // What is linear in a number has the same slope on both sides.
        let more = with(number.value + step);
        let both = number.touches == Touches::Shapes || more.is_none();
        Pair { less: both.then(|| with(number.value - step)).flatten(), more, step }
    }

    /// Whether the same joints and members are there.
    fn is_alike(&self, other: &Model) -> bool {
        let (own, other) = (&self.model.interfaces, &other.interfaces);
        let alike = |f: &Interface, g: &Interface| {
            (f.a, f.b, f.points.len(), f.ways.len()) == (g.a, g.b, g.points.len(), g.ways.len())
        };
        own.list.len() == other.list.len()
            && own.members.len() == other.members.len()
            && own.list.iter().zip(&other.list).all(|(f, g)| alike(f, g))
            && own.members.iter().zip(&other.members).all(|(m, n)| m.id == n.id)
    }

    /// Change of the load factor per unit of a number; nothing where there is no such scene with
    /// the same joints.
    pub fn slope(&self, varied: &Varied, number: &Number) -> Option<f64> {
        self.slope_of(varied, &self.change(&self.beside(varied, number)))
    }

    pub(super) fn slope_of(&self, varied: &Varied, change: &Change) -> Option<f64> {
        let slope = self.of(change) / (1.0 - self.by_itself(varied));
        Some(slope).filter(|s| s.is_finite() && !change.is_none)
    }

    /// What a change of the data changes of the load factor.
    fn of(&self, change: &Change) -> f64 {
        let free = self.model.assembly.free();
        let power = free.map(|i| certificate::power(&change.loads[i], &self.rates[i]));
        (change.room - power.sum::<f64>()) / self.live
    }

    /// Of a tilt whose joints have strengths: how the load factor changes with the tilt at which
    /// they are taken, for it has to be its own answer.
    fn by_itself(&self, varied: &Varied) -> f64 {
        let dry = are_dry(&self.model.interfaces);
        let (Under::Tilt(_), false) = (varied.under(), dry) else { return 0.0 };
        let step = STEP * self.value.abs().max(STEP);
        let [less, more] = [-step, step].map(|step| varied.own(self.value + step).ok());
        self.of(&self.change(&Pair { less, more, step }))
    }

    /// How the data change with a number: what the forces then leave out of balance, and what
    /// strengths leave of them by the multipliers.
    pub(super) fn change(&self, pair: &Pair) -> Change {
        let mut change = Change {
            loads: vec![Wrench::zero(); self.model.assembly.blocks.len()],
            room: 0.0,
            is_none: true,
        };
        for (model, by) in pair.sides(self.model) {
            change.is_none = false;
            let moved = self.moved(model);
            let forces = moved.as_ref().unwrap_or(self.forces);
            let left = certificate::statics(model, forces, self.value).residuals;
            change.loads.iter_mut().zip(left).for_each(|(sum, w)| *sum += w * by);
            change.room += by * self.room(model);
        }
        change
    }

    /// The forces in the axes of the joints of another scene; nothing where these are the same.
    fn moved(&self, other: &Model) -> Option<Forces> {
        let (own, others) = (&self.model.interfaces.list, &other.interfaces.list);
        let turned =
            own.iter().zip(others).any(|(f, g)| f.frame.n != g.frame.n || f.points != g.points);
        turned.then(|| {
            let mut forces = self.forces.clone();
            for ((f, g), list) in own.iter().zip(others).zip(&mut forces) {
                let turn = turn(f, g);
                let before = std::mem::replace(list, vec![Wrench::zero(); g.points.len()]);
                for (k, w) in before.iter().enumerate() {
                    list[nearest(&f.points[k], g)] +=
                        Wrench { force: turn * w.force, moment: turn * w.moment };
                }
            }
            forces
        })
    }

    /// By how much more friction and strengths of another scene leave, weighed by the multipliers.
    fn room(&self, other: &Model) -> f64 {
        let own = &self.model.interfaces;
        let joints = own.list.iter().zip(&other.interfaces.list).enumerate();
        let changed = joints.filter(|(_, (f, g))| f.law != g.law || f.points != g.points);
        let mut sum: f64 = changed.map(|(k, (f, g))| self.room_of(k, g) - self.room_of(k, f)).sum();
        let forces = self.forces.iter().skip(own.list.len());
        for ((m, n), forces) in own.members.iter().zip(&other.interfaces.members).zip(forces) {
            sum += self.member(m, n, forces) - self.member(m, m, forces);
        }
        sum
    }

    /// What friction and strengths leave of a joint, which in another scene is `other`.
    pub(super) fn room_of(&self, index: usize, other: &Interface) -> f64 {
        let f = &self.model.interfaces.list[index];
        let strength = Strength::of(other);
        let mu = match other.law.friction {
            Friction::Coefficient(mu) => mu,
            Friction::Infinite => 0.0,
        };
        let arm = rolling_arm(other);
        let crushes = self.crushes(index);
        let mut closing = vec![0.0; other.points.len()];
        let mut sum = 0.0;
        for (k, corner) in self.joints[index].iter().enumerate() {
            let place = nearest(&f.points[k], other);
            let [cohesion, tension] = strength.at(place);
            let normal = f.frame.n.dot(&self.forces[index][k].force);
            closing[place] = -corner.opening;
            sum += corner.sliding * (mu * normal + cohesion) + corner.rolling * arm * normal;
            sum += tension * if crushes { corner.opening } else { corner.opening.max(0.0) };
        }
        if crushes {
            sum += (other.law.compression + tension(other)) * closing_volume(other, &closing);
        }
        sum
    }

    /// Whether the compressive strength of a joint gives way.
    pub(super) fn crushes(&self, face: usize) -> bool {
        let closes = |c: &Corner| -c.opening > tolerance::ADMISSIBLE * self.fastest;
        crushes(&self.model.interfaces.list[face]) && self.joints[face].iter().any(closes)
    }

    fn member(&self, own: &Member, other: &Member, forces: &[Wrench]) -> f64 {
        let u = member::power(&self.model.assembly, own, self.rates);
        match (Bounds::of(own), Bounds::of(other)) {
            // As the normal force may slide without being all there is, friction counts by it.
            (Bounds::Cone { mu, .. }, Bounds::Cone { mu: new, most }) => {
                let sliding = u.y.hypot(u.z);
                let closing = (mu * sliding - u.x).max(0.0);
                let most = if closing > 0.0 && most.is_finite() { most * closing } else { 0.0 };
                new * sliding * member::amounts(forces).x + most
            }
            (_, bounds) => bounds.loss(&u).bounded,
        }
    }
}

/// Rates of the corners of a joint.
fn corners(model: &Model, rates: &[Rate], face: &Interface) -> Vec<Corner> {
    let n = face.frame.n;
    let spin = rates[face.b].spin - rates[face.a].spin;
    let twist = n.dot(&spin);
    let arm = rolling_arm(face);
    let rolling = if arm > 0.0 { (spin - n * twist).norm() + twist.abs() } else { 0.0 };
    let mu = match face.law.friction {
        Friction::Coefficient(mu) => mu,
        Friction::Infinite => 0.0,
    };
    let corner = |p: &Vector3<f64>| {
        let assembly = &model.assembly;
        let velocity = at(assembly, rates, face.b, p) - at(assembly, rates, face.a, p);
        let normal = n.dot(&velocity);
        let sliding = (velocity - n * normal).norm();
        Corner { velocity, sliding, opening: normal - mu * sliding - arm * rolling, rolling }
    };
    face.points.iter().map(corner).collect()
}

/// What turns the axes of a joint into those of the same joint in another scene.
pub(super) fn turn(own: &Interface, other: &Interface) -> Rotation3<f64> {
    match own.frame.n == other.frame.n {
        true => Rotation3::identity(),
        false => Rotation3::rotation_between(&own.frame.n, &other.frame.n)
            .unwrap_or_else(Rotation3::identity),
    }
}

/// The corner of a joint next to a point.
pub(super) fn nearest(point: &Vector3<f64>, other: &Interface) -> usize {
    let off = |k: &usize| (other.points[*k] - point).norm_squared();
    (0..other.points.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0)
}
