//! Spheres: Hertz's law for the normal force and Mindlin's for the tangential one.
//!
//! *Law* (Johnson, Contact Mechanics, 1985, chapters 4 and 7). Approach `δ`, contact radius `a² = R
//! δ`, `N = 4/3 E* a δ`, `1/R = Σ 1/Rᵢ`, `1/E* = Σ (1 − νᵢ²)/Eᵢ`; tangential stiffness of a contact
//! that sticks `8 a G*`, `1/G* = Σ (2 − νᵢ)/Gᵢ`. The ring that slides grows from the rim inwards
//! (Cattaneo 1938, Mindlin 1949, Mindlin & Deresiewicz 1953), and what is left of a shear force
//! depends on the way there.
//!
//! *Method of dimensionality reduction* (Popov & Heß 2015), which is exact for this law along any
//! path in one direction: the contact is a row of springs at `x`, each with the stiffness `E* dx`
//! and pressed by `δ − x²/R`, and with `G̃ dx`, `G̃ = 4 G*`, along; every spring sticks or slides by
//! Coulomb's law for itself. With `ξ = x²/R` pressures are linear in `ξ` and stretches piecewise
//! linear, so that the integrals are closed forms: no points of integration.

use super::{
    law::{Friction, Resultant, Spot, cut},
    number::Number,
};

/// A contact of spheres, or of one with a plane.
#[derive(Clone, Debug)]
pub struct Grain {
    /// `R`, m.
    pub radius: f64,
    /// `E*`, Pa.
    pub modulus: f64,
    /// `G*`, Pa.
    pub shear: f64,
    /// Coefficient of friction; infinite where nothing slides.
    pub mu: f64,
}

/// What it remembers of the step before.
#[derive(Clone, Debug, Default)]
pub struct Past {
    /// Displacement along the joint and opening.
    pub motion: [f64; 3],
    /// Places `ξ`, m, ascending from 0, and the stretches there, m; linear between them.
    pub stretch: Vec<(f64, [f64; 2])>,
}

/// Springs that slide by less than this share of the greatest stretch stick. More: what hardly slides
/// goes unseen. Less: rounding of stretches at their limit slides.
const ROUNDING: f64 = 1e-12;

/// A corner of a piecewise linear stretch.
type Corner<S> = (S, [S; 2]);

impl Grain {
    /// Approach under a normal force.
    pub fn approach(&self, normal: f64) -> f64 {
        (9.0 * normal * normal / (16.0 * self.modulus * self.modulus * self.radius)).cbrt()
    }

    /// What it does to the second block at a relative displacement, and the stretches.
    pub fn respond<S: Number>(
        &self,
        past: &Past,
        motion: &[S; 6],
        friction: Friction,
    ) -> (Resultant<S>, Vec<Corner<S>>) {
        let mut all = Resultant::zero();
        let depth = -motion[2];
        if depth.value() <= 0.0 {
            return (all, Vec::new());
        }
        let root = depth.times(self.radius).sqrt();
        let normal = (root * depth).times(4.0 / 3.0 * self.modulus);
        let corners = if self.mu == 0.0 {
            vec![(S::of(0.0), [S::of(0.0); 2]), (depth, [S::of(0.0); 2])]
        } else {
            self.limited(past.tried(motion, depth), depth, friction)
        };
        let shear = self.sum(&corners);
        all.add([S::of(0.0); 2], [shear[0], shear[1], normal]);
        (all, corners)
    }

    /// The point of contact with its force.
    pub fn spot(&self, past: &Past, motion: &[f64; 6]) -> (Spot, Past) {
        let (all, corners) = self.respond(past, motion, Friction::Follows);
        let inner = corners.first().map_or([0.0; 2], |c| c.1);
        let slip = if corners.is_empty() { [0.0; 2] } else { self.slip(past, motion) };
        let spot = Spot {
            at: [0.0; 2],
            area: 0.0,
            normal: all.force[2],
            shear: [all.force[0], all.force[1]],
            opening: motion[2],
            stretch: inner,
            slip,
        };
        (spot, Past { motion: [motion[0], motion[1], motion[2]], stretch: tidy(corners) })
    }

    /// How far the spring slides that slides farthest: of a contact that slides in part one of the ring
    /// at its rim.
    fn slip(&self, past: &Past, motion: &[f64; 6]) -> [f64; 2] {
        let depth = -motion[2];
        if self.mu == 0.0 {
            return [motion[0] - past.motion[0], motion[1] - past.motion[1]];
        }
        if self.mu.is_infinite() {
            return [0.0; 2];
        }
        let least = ROUNDING * self.slope() * depth;
        let slides = past.tried(motion, depth).into_iter().filter_map(|(at, e)| {
            let left = cut(e, (depth - at) * self.slope(), Friction::Follows)?;
            let slip: [f64; 2] = std::array::from_fn(|i| e[i] - left[i]);
            Some((slip[0].hypot(slip[1]), slip)).filter(|s| s.0 > least)
        });
        slides.max_by(|a, b| a.0.total_cmp(&b.0)).map_or([0.0; 2], |s| s.1)
    }

    /// Greatest stretch by depth: `μ E* / 4 G*`.
    fn slope(&self) -> f64 {
        self.mu * self.modulus / (4.0 * self.shear)
    }

    /// Coulomb's law, spring by spring.
    fn limited<S: Number>(
        &self,
        tried: Vec<Corner<S>>,
        depth: S,
        friction: Friction,
    ) -> Vec<Corner<S>> {
        if self.mu.is_infinite() {
            return tried;
        }
        let slope = self.slope();
        let most = |at: S| (depth - at).times(slope);
        let mut corners: Vec<Corner<S>> = Vec::with_capacity(tried.len() + 2);
        for (k, &(at, e)) in tried.iter().enumerate() {
            // Rounded, a stretch has no corner at its limit.
            if k > 0 && !matches!(friction, Friction::Rounded(_)) {
                let (before, first) = tried[k - 1];
                for share in crossings((before, first), (at, e), depth, slope) {
                    let place = before + (at - before) * share;
                    let held: [S; 2] =
                        std::array::from_fn(|i| first[i] + (e[i] - first[i]) * share);
                    corners.push((place, held));
                }
            }
            let left = cut(e, most(at), friction).unwrap_or(e);
            corners.push((at, left));
        }
        corners
    }

    /// The shear force: `−4 G* √R ∫ e dξ/√ξ`, linear piece by linear piece.
    fn sum<S: Number>(&self, corners: &[Corner<S>]) -> [S; 2] {
        let mut sum = [S::of(0.0); 2];
        for pair in corners.windows(2) {
            let ((x, e), (y, f)) = (pair[0], pair[1]);
            let (s, t) = (x.sqrt(), y.sqrt());
            if t.value() <= s.value() {
                continue;
            }
            let share = (s.times(2.0) + t) / (s + t).times(3.0);
            let width = (t - s).times(-8.0 * self.shear * self.radius.sqrt());
            for (i, all) in sum.iter_mut().enumerate() {
                *all = *all + width * (e[i] + (f[i] - e[i]) * share);
            }
        }
        sum
    }
}

impl Past {
    /// The stretches if nothing slid: a spring that comes to press on the way is stretched from
    /// there on only.
    fn tried<S: Number>(&self, motion: &[S; 6], depth: S) -> Vec<Corner<S>> {
        let before = (-self.motion[2]).max(0.0);
        let way: [S; 2] = [motion[0] - S::of(self.motion[0]), motion[1] - S::of(self.motion[1])];
        let end = if depth.value() < before { depth } else { S::of(before) };
        let add = |e: [f64; 2], share: S| -> [S; 2] {
            std::array::from_fn(|i| S::of(e[i]) + way[i] * share)
        };
        let one = S::of(1.0);
        // Where it was open, the way counts from where it closed.
        let closed = S::of(self.motion[2].max(0.0));
        let start = if self.motion[2] > 0.0 { depth / (depth + closed) } else { one };
        let mut corners: Vec<Corner<S>> = self
            .stretch
            .iter()
            .take_while(|(at, _)| *at < end.value())
            .map(|&(at, e)| (S::of(at), add(e, one)))
            .collect();
        if end.value() > 0.0 {
            corners.push((end, add(self.at(end.value()), one)));
        } else {
            corners.push((S::of(0.0), add([0.0; 2], start)));
        }
        if depth.value() > end.value() {
            corners.push((depth, [S::of(0.0); 2]));
        }
        corners
    }

    fn at(&self, place: f64) -> [f64; 2] {
        let list = &self.stretch;
        let k = list.partition_point(|(at, _)| *at <= place);
        match (k.checked_sub(1).and_then(|k| list.get(k)), list.get(k)) {
            (Some(&(x, e)), Some(&(y, f))) if y > x => {
                let share = (place - x) / (y - x);
                std::array::from_fn(|i| e[i] + (f[i] - e[i]) * share)
            }
            (Some(&(_, e)), _) | (None, Some(&(_, e))) => e,
            (None, None) => [0.0; 2],
        }
    }
}

/// Where between two corners a linear stretch is as large as can be: shares of the way, ascending.
fn crossings<S: Number>(
    (x, e): Corner<S>,
    (y, f): Corner<S>,
    depth: S,
    slope: f64,
) -> impl Iterator<Item = S> {
    // ‖e + s (f − e)‖² = slope² (depth − x − s (y − x))².
    let d: [S; 2] = std::array::from_fn(|i| f[i] - e[i]);
    let (first, change) = ((depth - x).times(slope), (y - x).times(-slope));
    let a = d[0] * d[0] + d[1] * d[1] - change * change;
    let b = (d[0] * e[0] + d[1] * e[1] - first * change).times(2.0);
    let c = e[0] * e[0] + e[1] * e[1] - first * first;
    let under = b * b - (a * c).times(4.0);
    let mut roots = [None; 2];
    let size = [a, b, c].iter().map(|v| v.value().abs()).fold(0.0, f64::max);
    if a.value().abs() <= 1e-14 * size {
        if b.value().abs() > 1e-14 * size {
            roots[0] = Some(-c / b);
        }
    } else if under.value() > 0.0 {
        // Without cancellation.
        let root = under.sqrt();
        let sum = if b.value() >= 0.0 { -(b + root) } else { root - b };
        let one = sum / a.times(2.0);
        let two = if sum.value() == 0.0 { one } else { c.times(2.0) / sum };
        roots = if one.value() <= two.value() {
            [Some(one), Some(two)]
        } else {
            [Some(two), Some(one)]
        };
    }
    roots.into_iter().flatten().filter(|s| s.value() > 0.0 && s.value() < 1.0)
}

/// Drops corners that repeat a place, and such as lie on the line between their neighbours.
fn tidy(corners: Vec<Corner<f64>>) -> Vec<Corner<f64>> {
    let mut kept: Vec<Corner<f64>> = Vec::with_capacity(corners.len());
    let scale = corners.iter().flat_map(|c| c.1).fold(0.0_f64, |m, v| m.max(v.abs()));
    for corner in corners {
        if kept.last().is_some_and(|last| last.0 >= corner.0) {
            continue;
        }
        if let [.., x, y] = kept[..] {
            let share = (y.0 - x.0) / (corner.0 - x.0);
            let line = |i: usize| x.1[i] + (corner.1[i] - x.1[i]) * share;
            if (0..2).all(|i| (y.1[i] - line(i)).abs() <= 1e-13 * scale) {
                kept.pop();
            }
        }
        kept.push(corner);
    }
    kept
}
