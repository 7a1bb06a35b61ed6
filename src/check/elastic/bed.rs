//! Joints with an area: a bed of springs that cannot pull.
//!
//! *Law.* At a point of the joint with gap `g` (the rigid sides' distance) the pressure is `p = k_n
//! max(0, −g)` and the shear stress `t = −k_t e`, `‖t‖ ≤ μ p`, where the stretch `e` follows the
//! relative displacement along the joint and what goes beyond the limit is slip (return mapping of
//! each point for itself, one implicit step per increment of the load). A point that closes within
//! a step is stretched from there on only; one that opens forgets its stretch.
//!
//! *Integration.* Blocks are rigid, so `g` and the displacement are linear over the joint. Each
//! triangle of it is cut along `g = 0`, and on the pressed part the three mid-side points with a
//! third of the area each integrate quadratic functions exactly (Strang & Fix 1973): pressures,
//! their moments and the shear of what sticks are exact, however small the pressed part. Where the
//! pressed part moves, the stretch at its points is read from that of the step before (moving least
//! squares, exact for linear stretches, and the stretch itself where a point has not moved).

use super::{
    law::{Friction, Resultant, Spot, along, cut, opens},
    number::Number,
};
use base::plane::polygon::{P2, area, cross};
use nalgebra::{Matrix3, Vector3};

/// A bed.
#[derive(Clone, Debug)]
pub struct Bed {
    /// Pressure by closing, Pa/m.
    pub normal: f64,
    /// Shear stress by stretch, Pa/m.
    pub shear: f64,
    /// Coefficient of friction; infinite where nothing slides.
    pub mu: f64,
    /// Where it is integrated.
    pub place: Domain,
}

/// Where a bed is integrated.
#[derive(Clone, Debug)]
pub enum Domain {
    /// Over the pressed part of triangles, exactly.
    Triangles(Vec<[P2; 3]>),
    /// At points with a share of the area each, m².
    Points(Vec<(P2, f64)>),
}

/// What a bed remembers of the step before.
#[derive(Clone, Debug, Default)]
pub struct Past {
    /// The relative displacements.
    pub motion: [f64; 6],
    /// Its pressed points.
    pub spots: Vec<Spot>,
}

/// A point of the pressed part.
struct Sample<S> {
    at: [S; 2],
    area: S,
}

impl Bed {
    /// The triangles of convex pieces, each cut in four: more points at which shear can reach its
    /// limit.
    pub fn triangles(pieces: &[Vec<P2>]) -> Vec<[P2; 3]> {
        let fan = pieces
            .iter()
            .flat_map(|p| (2..p.len()).map(move |i| [p[0], p[i - 1], p[i]]))
            .filter(|[a, b, c]| cross(*a, *b, *c) != 0.0);
        fan.flat_map(|[a, b, c]| {
            let (ab, bc, ca) = ((a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0);
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        })
        .collect()
    }

    /// Its area, m².
    pub fn area(&self) -> f64 {
        match &self.place {
            Domain::Triangles(list) => list.iter().map(|t| area(t).abs()).sum(),
            Domain::Points(list) => list.iter().map(|p| p.1).sum(),
        }
    }

    /// Points with their shares of the area that integrate over all of it, pressed or not.
    pub fn whole(&self) -> Vec<(P2, f64)> {
        match &self.place {
            Domain::Triangles(list) => list
                .iter()
                .flat_map(|&[a, b, c]| {
                    let third = area(&[a, b, c]).abs() / 3.0;
                    [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0].map(|p| (p, third))
                })
                .collect(),
            Domain::Points(list) => list.clone(),
        }
    }

    /// The corners between which its opening is greatest and least.
    pub fn corners(&self) -> Vec<P2> {
        match &self.place {
            Domain::Triangles(list) => list.iter().flatten().copied().collect(),
            Domain::Points(list) => list.iter().map(|p| p.0).collect(),
        }
    }

    /// What it does to the second block at a relative displacement; every point to `tell`.
    pub fn respond<S: Number>(
        &self,
        past: &Past,
        motion: &[S; 6],
        friction: Friction,
        mut tell: impl FnMut(Spot),
    ) -> Resultant<S> {
        let mut all = Resultant::zero();
        self.pressed(motion, |sample| {
            let at = sample.at;
            let opening = opens(motion, at);
            // A corner of the pressed part can lie on the line where it ends.
            if opening.value() >= 0.0 {
                return;
            }
            let pressure = -opening.times(self.normal);
            let normal = pressure * sample.area;
            let (stretch, slip) = self.stretch(past, motion, at, opening, friction);
            let shear = stretch.map(|e| -(e * sample.area).times(self.shear));
            all.add(at, [shear[0], shear[1], normal]);
            tell(Spot {
                at: at.map(S::value),
                area: sample.area.value(),
                normal: normal.value(),
                shear: shear.map(S::value),
                opening: opening.value(),
                stretch: stretch.map(S::value),
                slip,
            });
        });
        all
    }

    /// The stretch at a pressed point, and how far it slid in this step.
    fn stretch<S: Number>(
        &self,
        past: &Past,
        motion: &[S; 6],
        at: [S; 2],
        opening: S,
        friction: Friction,
    ) -> ([S; 2], [f64; 2]) {
        if self.mu == 0.0 {
            let way = along(motion, at).map(S::value);
            let before = along(&past.motion, at.map(S::value));
            return ([S::of(0.0); 2], [way[0] - before[0], way[1] - before[1]]);
        }
        let before = past.motion.map(S::of);
        let (now, then) = (along(motion, at), along(&before, at));
        let was = opens(&before, at);
        let way = [now[0] - then[0], now[1] - then[1]];
        let tried = if was.value() < 0.0 {
            let [e, d] = past.stretch_at(at, self.size());
            [e + way[0], d + way[1]]
        } else {
            // Closed on the way: stretched from there on.
            let share = if was.value() > 0.0 { opening / (opening - was) } else { S::of(1.0) };
            way.map(|w| w * share)
        };
        if self.mu.is_infinite() {
            return (tried, [0.0; 2]);
        }
        let most = -opening.times(self.normal * self.mu / self.shear);
        match cut(tried, most, friction) {
            Some(left) => {
                let slip = std::array::from_fn(|i| tried[i].value() - left[i].value());
                (left, slip)
            }
            None => (tried, [0.0; 2]),
        }
    }

    /// Its size, m: what places are told apart by.
    fn size(&self) -> f64 {
        self.area().sqrt()
    }

    /// The points of the pressed part.
    fn pressed<S: Number>(&self, motion: &[S; 6], mut tell: impl FnMut(Sample<S>)) {
        match &self.place {
            Domain::Points(list) => {
                for (p, area) in list {
                    tell(Sample { at: [p.x, p.y].map(S::of), area: S::of(*area) });
                }
            }
            Domain::Triangles(list) => {
                for triangle in list {
                    let corners = triangle.map(|p| {
                        let at = [p.x, p.y].map(S::of);
                        (at, -opens(motion, at))
                    });
                    let (polygon, n) = part(&corners);
                    for i in 2..n {
                        thirds([polygon[0], polygon[i - 1], polygon[i]], &mut tell);
                    }
                }
            }
        }
    }
}

/// The part of a triangle where depth is positive: at most four corners, and how many.
fn part<S: Number>(corners: &[([S; 2], S); 3]) -> ([[S; 2]; 4], usize) {
    let mut polygon = [[S::of(0.0); 2]; 4];
    let mut n = 0;
    let mut push = |p: [S; 2]| {
        polygon[n] = p;
        n += 1;
    };
    for i in 0..3 {
        let ((p, d), (q, e)) = (corners[i], corners[(i + 1) % 3]);
        if d.value() >= 0.0 {
            push(p);
        }
        if (d.value() > 0.0 && e.value() < 0.0) || (d.value() < 0.0 && e.value() > 0.0) {
            let share = d / (d - e);
            push([p[0] + (q[0] - p[0]) * share, p[1] + (q[1] - p[1]) * share]);
        }
    }
    (polygon, n)
}

/// The mid-side points of a triangle.
fn thirds<S: Number>([a, b, c]: [[S; 2]; 3], tell: &mut impl FnMut(Sample<S>)) {
    let double = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let double = if double.value() < 0.0 { -double } else { double };
    if double.value() == 0.0 {
        return;
    }
    let area = double.times(1.0 / 6.0);
    for (p, q) in [(a, b), (b, c), (c, a)] {
        tell(Sample { at: [(p[0] + q[0]).times(0.5), (p[1] + q[1]).times(0.5)], area });
    }
}

/// Places nearer than this share of a joint's size are one. More: stretches are mixed up. Less: a
/// point that has not moved is not found by rounding.
const SAME_PLACE: f64 = 1e-9;

impl Past {
    /// The stretch that a place has from the step before.
    fn stretch_at<S: Number>(&self, at: [S; 2], size: f64) -> [S; 2] {
        let here = at.map(S::value);
        let Some(nearest) = self.spots.iter().min_by(|a, b| far(a, here).total_cmp(&far(b, here)))
        else {
            return [S::of(0.0); 2];
        };
        if far(nearest, here) <= (SAME_PLACE * size).powi(2) {
            return nearest.stretch.map(S::of);
        }
        // Moving least squares: a linear field whose nearest points count most.
        let mut matrix = Matrix3::zeros();
        let mut sides = [Vector3::zeros(); 2];
        for spot in &self.spots {
            let weight = 1.0 / far(spot, here).powi(2).max(f64::MIN_POSITIVE);
            let row =
                Vector3::new(1.0, (spot.at[0] - here[0]) / size, (spot.at[1] - here[1]) / size);
            matrix += row * row.transpose() * weight;
            for (side, e) in sides.iter_mut().zip(spot.stretch) {
                *side += row * (weight * e);
            }
        }
        let scale = matrix.trace();
        let solved = (matrix / scale).try_inverse().filter(|m| m.amax() < 1e12);
        let Some(inverse) = solved else { return nearest.stretch.map(S::of) };
        let d = [
            (at[0] - S::of(here[0])).times(1.0 / size),
            (at[1] - S::of(here[1])).times(1.0 / size),
        ];
        sides.map(|side| {
            let field = inverse * side / scale;
            S::of(field.x) + d[0].times(field.y) + d[1].times(field.z)
        })
    }
}

fn far(spot: &Spot, at: [f64; 2]) -> f64 {
    (spot.at[0] - at[0]).powi(2) + (spot.at[1] - at[1]).powi(2)
}
