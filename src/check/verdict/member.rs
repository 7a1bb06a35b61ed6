//! What members do, derived from their ends and bounds without the numbers of the program.
//!
//! *Forces.* The amounts `a` of a member (one for a line or a push, two for a shear, three for a
//! finger: normal and two tangential ones) act along fixed directions, each on one block and
//! oppositely on another or on the ground ([`legs`]). They lie in a convex set `S`: an interval, a
//! disc, or a cone of friction that is cut off.
//!
//! *Power.* For rates with power `u` per amount the member takes up at most `D(u) = sup {−a·u : a ∈
//! S}`: `N × (rate of lengthening)⁺` for a tie of strength `N`. Where `S` has no end along `−u` a
//! mechanism is inadmissible, by [`Loss::endless`] per newton, as it is where a joint closes.

use super::{Rate, at};
use model::{
    assembly::{Action, Assembly, Member, Wrench},
    interface::ContactFrame,
};
use nalgebra::Vector3;

/// One force of a member: `amounts[axis] × direction` on block `b` at a point, its opposite on `a`;
/// the ground where there is no block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Which amount.
    pub axis: usize,
    /// The block that is pushed back.
    pub a: Option<usize>,
    /// The block that the force acts on.
    pub b: Option<usize>,
    /// Where, m.
    pub at: Vector3<f64>,
    /// Unit direction.
    pub direction: Vector3<f64>,
}

/// The forces of a member.
pub fn legs(member: &Member) -> Vec<Leg> {
    match &member.action {
        Action::Line(anchors) => anchors
            .windows(2)
            .map(|piece| {
                let [p, q] = [piece[0], piece[1]];
                // A pair along one line: it may act anywhere on it, best near a block.
                let at = if p.block.is_some() { p.at } else { q.at };
                let direction = (p.at - q.at).normalize();
                Leg { axis: 0, a: p.block, b: q.block, at, direction }
            })
            .collect(),
        Action::Push { on, from, at, direction } => {
            vec![Leg { axis: 0, a: *from, b: Some(*on), at: *at, direction: *direction }]
        }
        Action::Shear { blocks: [a, b], at, normal } => {
            let frame = ContactFrame::around(*normal);
            let axes = [frame.t1, frame.t2].into_iter().enumerate();
            axes.map(|(axis, direction)| Leg { axis, a: Some(*a), b: Some(*b), at: *at, direction })
                .collect()
        }
        Action::Press { on, at, normal, .. } => {
            let frame = ContactFrame::around(*normal);
            let axes = [*normal, frame.t1, frame.t2].into_iter().enumerate();
            axes.map(|(axis, direction)| Leg { axis, a: None, b: Some(*on), at: *at, direction })
                .collect()
        }
    }
}

/// The set of the amounts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bounds {
    /// The first from the least to the greatest.
    Range(f64, f64),
    /// The first two, no larger together.
    Disc(f64),
    /// The first from zero to the greatest, the others together at most μ times that.
    Cone {
        /// Coefficient of friction μ.
        mu: f64,
        /// The greatest normal force.
        most: f64,
    },
}

impl Bounds {
    /// Those of a member.
    pub fn of(member: &Member) -> Self {
        match &member.action {
            Action::Line(_) | Action::Push { .. } => Self::Range(member.least, member.greatest),
            Action::Shear { .. } => Self::Disc(member.greatest),
            Action::Press { friction, .. } => Self::Cone { mu: *friction, most: member.greatest },
        }
    }

    /// How many amounts there are.
    pub fn axes(self) -> usize {
        match self {
            Self::Range(..) => 1,
            Self::Disc(_) => 2,
            Self::Cone { .. } => 3,
        }
    }

    /// How far inside the set the amounts lie, N; negative outside, NaN where one is none.
    pub fn margin(self, a: &Vector3<f64>) -> f64 {
        let inside = match self {
            Self::Range(least, greatest) => least_of(a.x - least, greatest - a.x),
            Self::Disc(most) => most - a.x.hypot(a.y),
            Self::Cone { mu, most } => {
                let by_friction = (mu * a.x - a.y.hypot(a.z)) / mu.hypot(1.0);
                least_of(least_of(a.x, by_friction), most - a.x)
            }
        };
        // An amount that does not exist.
        let stray = (self.axes()..3).any(|k| a[k] != 0.0);
        if stray || a.iter().any(|c| c.is_nan()) { f64::NAN } else { inside }
    }

    /// The amounts brought into the set, and further inside by a share of what bounds them.
    pub fn cut(self, a: &Vector3<f64>, inside: f64) -> Vector3<f64> {
        let (less, tangents) = (1.0 - inside, a.y.hypot(a.z));
        match self {
            Self::Range(least, greatest) => {
                let (low, high) = (if least < 0.0 { least * less } else { least }, greatest * less);
                Vector3::new(
                    if a.x < low {
                        low
                    } else if a.x > high {
                        high
                    } else {
                        a.x
                    },
                    0.0,
                    0.0,
                )
            }
            Self::Disc(most) => {
                let size = a.x.hypot(a.y);
                let by = if size > most * less { most * less / size } else { 1.0 };
                Vector3::new(a.x * by, a.y * by, 0.0)
            }
            Self::Cone { mu, most } => {
                let normal = a.x.clamp(0.0, most * less);
                let limit = mu * normal * less;
                let by = if tangents > limit { limit / tangents } else { 1.0 };
                Vector3::new(normal, a.y * by, a.z * by)
            }
        }
    }

    /// The amounts of the set nearest to `a`.
    pub fn nearest(self, a: &Vector3<f64>) -> Vector3<f64> {
        let Self::Cone { mu, most } = self else { return self.cut(a, 0.0) };
        let t = a.y.hypot(a.z);
        let along = |normal: f64, radius: f64| {
            let by = if t > radius { radius / t } else { 1.0 };
            Vector3::new(normal, a.y * by, a.z * by)
        };
        if a.x > most {
            // Beyond the end of the cone: on its lid, or on its side below the lid.
            let on = (a.x + mu * t) / (1.0 + mu * mu);
            return if t <= mu * most || on >= most {
                along(most, mu * most)
            } else {
                along(on.max(0.0), mu * on.max(0.0))
            };
        }
        if t <= mu * a.x {
            return *a;
        }
        let on = ((a.x + mu * t) / (1.0 + mu * mu)).clamp(0.0, most);
        along(on, mu * on)
    }

    /// What the member takes up at most of the power of rates that do the power `u` per amount.
    pub fn loss(self, u: &Vector3<f64>) -> Loss {
        let bounded = |most: f64, rate: f64| match (most, rate > 0.0) {
            (_, false) => Loss::default(),
            (f64::INFINITY, true) => Loss { endless: rate, ..Loss::default() },
            (most, true) => Loss { bounded: most * rate, ..Loss::default() },
        };
        let loss = match self {
            Self::Range(least, greatest) => match u.x {
                x if x < 0.0 => bounded(greatest, -x),
                x => bounded(-least, x),
            },
            Self::Disc(most) => bounded(most, u.x.hypot(u.y)),
            Self::Cone { mu, most } => bounded(most, mu * u.y.hypot(u.z) - u.x),
        };
        if u.iter().any(|c| c.is_nan()) { Loss { endless: f64::NAN, ..loss } } else { loss }
    }
}

/// What a member takes up of the power of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loss {
    /// Power, where its bounds end it.
    pub bounded: f64,
    /// Speed against which it takes up any force.
    pub endless: f64,
}

/// The amounts of a member among forces.
pub fn amounts(forces: &[Wrench]) -> Vector3<f64> {
    forces.first().map_or_else(Vector3::zeros, |w| w.force)
}

/// Power of each amount of a member, W/N.
pub fn power(assembly: &Assembly, member: &Member, rates: &[Rate]) -> Vector3<f64> {
    let mut u = Vector3::zeros();
    for leg in legs(member) {
        let speed = |block: Option<usize>| {
            block.map_or_else(Vector3::zeros, |i| at(assembly, rates, i, &leg.at))
        };
        u[leg.axis] += leg.direction.dot(&(speed(leg.b) - speed(leg.a)));
    }
    u
}

/// The fastest of the points that a member acts at, m/s.
pub fn fastest(assembly: &Assembly, member: &Member, rates: &[Rate]) -> f64 {
    let speed = |leg: &Leg| {
        let of =
            |block: Option<usize>| block.map_or(0.0, |i| at(assembly, rates, i, &leg.at).norm());
        of(leg.a).max(of(leg.b))
    };
    legs(member).iter().map(speed).fold(0.0, f64::max)
}

/// The lesser of two; a NaN stays.
fn least_of(a: f64, b: f64) -> f64 {
    if a < b || a.is_nan() { a } else { b }
}
