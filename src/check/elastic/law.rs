//! What contacts have in common: the motion of one side against the other, what comes of it, and
//! Coulomb's law at one point.

use super::number::Number;

/// How friction answers a small motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// By Coulomb's law.
    Follows,
    /// By a law that turns from sticking to sliding by and by, the more sharply the greater this power: a
    /// shear that would be `x` of its limit is `x / (1 + xᵖ)^(1/p)` of it. A way to Coulomb's law.
    Rounded(f64),
    /// As it is: what sticks goes on sticking, what slides goes on at its limit, which stays.
    Stays,
}

/// Share of its limit from which on a shear force counts as sliding. More: rounding hides what
/// slides. Less: what sticks counts as sliding.
pub const AT_LIMIT: f64 = 1.0 - 1e-9;

/// Force and moment about the joint's place on its second block, in its frame `(t1, t2, n)`.
#[derive(Clone, Copy, Debug)]
pub struct Resultant<S> {
    /// Force, N.
    pub force: [S; 3],
    /// Moment, N·m.
    pub moment: [S; 3],
}

impl<S: Number> Resultant<S> {
    /// Nothing.
    pub fn zero() -> Self {
        Self { force: [S::of(0.0); 3], moment: [S::of(0.0); 3] }
    }

    /// Adds a force at a point of the joint's plane.
    pub fn add(&mut self, [x, y]: [S; 2], force: [S; 3]) {
        let [f1, f2, f3] = force;
        for (all, one) in self.force.iter_mut().zip(force) {
            *all = *all + one;
        }
        let moment = [y * f3, -(x * f3), x * f2 - y * f1];
        for (all, one) in self.moment.iter_mut().zip(moment) {
            *all = *all + one;
        }
    }
}

/// What a contact does at one of its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Where, in the joint's plane from its place, m.
    pub at: [f64; 2],
    /// Its share of the area, m²; 0 of grains.
    pub area: f64,
    /// Pressing force, N, at least 0.
    pub normal: f64,
    /// Shear force on the second block, N.
    pub shear: [f64; 2],
    /// How far the sides are apart there, m; below zero where they press.
    pub opening: f64,
    /// How far the shear force has drawn it, m: what would spring back.
    pub stretch: [f64; 2],
    /// How far it slid in this step, m.
    pub slip: [f64; 2],
}

/// Displacement along the joint of a point of its plane.
pub fn along<S: Number>(motion: &[S; 6], [x, y]: [S; 2]) -> [S; 2] {
    [motion[0] - motion[5] * y, motion[1] + motion[5] * x]
}

/// How far a point of the joint's plane opens.
pub fn opens<S: Number>(motion: &[S; 6], [x, y]: [S; 2]) -> S {
    motion[2] + motion[3] * y - motion[4] * x
}

/// Coulomb's law: the stretch that is left of one that was tried, where no more than `most` can be.
/// Nothing is given back where all of it is left.
pub fn cut<S: Number>(tried: [S; 2], most: S, friction: Friction) -> Option<[S; 2]> {
    let square = tried[0] * tried[0] + tried[1] * tried[1];
    let (size, limit) = (square.value().sqrt(), most.value());
    match friction {
        Friction::Rounded(_) if limit <= 0.0 => Some(tried.map(|_| S::of(0.0))),
        Friction::Rounded(power) => {
            let share = rounded(square.sqrt() / most, power);
            Some(tried.map(|t| t * share))
        }
        Friction::Follows if size > limit => {
            let share = most / square.sqrt();
            Some(tried.map(|t| t * share))
        }
        Friction::Stays if size >= AT_LIMIT * limit => Some(tried.map(S::held)),
        _ => None,
    }
}

/// `(1 + xᵖ)^(−1/p)`, and how it changes.
fn rounded<S: Number>(x: S, power: f64) -> S {
    let v = x.value();
    if v <= 0.0 {
        return S::of(1.0);
    }
    // Of the two powers the one that does not overflow.
    let small = v.min(1.0 / v).powf(power);
    let part = (1.0 + small).powf(-1.0 / power);
    let share = if v > 1.0 { part / v } else { part };
    let slope = if v > 1.0 { 1.0 } else { small } * -share / (v * (1.0 + small));
    x.mapped(share, slope)
}
