//! Contact points of the program: what each may carry, as columns and a cone.

use super::{
    Cone, ConicProgram, Pyramid, StaticsOptions,
    planar::{self, Plane},
};
use model::{
    assembly::Wrench,
    interface::{Interface, Interfaces, Model},
    strength,
};
use nalgebra::Vector3;
use scene::Friction;

/// What an element of the group makes of a bearing.
#[derive(Clone, Debug)]
pub struct BearingImage {
    /// The element.
    pub element: usize,
    /// The points there: interface and point.
    pub points: [(usize, usize); 2],
    /// −1 where the force on block `b` becomes one on block `a`.
    pub sign: f64,
}

/// A contact point (or pair of points) that stands for its images.
#[derive(Clone, Debug)]
pub struct BearingOrbit {
    /// What each element of the group makes of it.
    pub images: Vec<BearingImage>,
    /// How many images there are; each is counted `images.len() / distinct` times.
    pub distinct: usize,
}

/// The set in which the columns of one contact point lie. The first three are standard, self-dual
/// cones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BearingCone {
    /// Every column ≥ 0: a normal force alone (μ = 0), or the two edges of a plane friction cone.
    Rays,
    /// `x₀ ≥ ‖x₁, x₂‖`: the circular friction cone, its columns scaled by μ.
    Circular,
    /// `x₀ ≥ 0`, the others free: no sliding.
    Rough,
    /// Columns are normal force, tangential forces and couples themselves, with these limits.
    Limited(Limits),
}

/// What a contact point resists beside dry friction: `‖f_t‖ ≤ μ f_n + c`, `f_n ≥ −T`, and for
/// couples over the rolling arm `‖m_t‖ ≤ f_n`, `|m_n| ≤ f_n`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Coefficient of friction; infinite where sliding is excluded.
    pub mu: f64,
    /// Cohesion, N.
    pub cohesion: f64,
    /// Tensile strength, N.
    pub tension: f64,
    /// Number of tangential components: 1 in a plane, 2 in space.
    pub tangents: usize,
    /// Number of couples: 0 without a rolling arm, 1 (rolling) in a plane, 3 (two of rolling, one
    /// of twisting) in space.
    pub couples: usize,
}

/// One contact point of the program (or a mirrored pair of them) and its columns.
#[derive(Clone, Debug)]
pub struct Bearing {
    /// Index of the interface.
    pub interface: usize,
    /// Points of the interface that share the force equally: one, or two mirror images.
    pub points: [usize; 2],
    /// First column.
    pub column: usize,
    /// Force on block `b` and couple about the point per unit of each column.
    pub basis: Vec<Wrench>,
    /// The cone the columns lie in.
    pub cone: BearingCone,
    /// Force unit of the columns, N.
    pub unit: f64,
    /// Load that presumably passes here, N ([`carried`](super::carried)).
    pub(super) presumed: f64,
    /// Its images, where a symmetry makes it stand for them.
    pub(super) orbit: Option<BearingOrbit>,
}

impl Bearing {
    /// How many bearings of the whole scene it stands for.
    pub fn image_count(&self) -> usize {
        self.orbit.as_ref().map_or(1, |o| o.distinct)
    }

    /// How many points of the interface it stands for.
    pub fn point_count(&self) -> usize {
        if self.points[0] == self.points[1] { 1 } else { 2 }
    }

    /// Limits beside dry friction.
    pub fn limits(&self) -> Option<Limits> {
        if let BearingCone::Limited(limits) = self.cone { Some(limits) } else { None }
    }

    /// Sum over its points of an amount per corner.
    pub fn sum(&self, per_corner: &[f64]) -> f64 {
        self.points[..self.point_count()].iter().map(|&k| per_corner[k]).sum()
    }

    /// Mean over its points of an amount per corner.
    pub fn mean(&self, per_corner: &[f64]) -> f64 {
        0.5 * (per_corner[self.points[0]] + per_corner[self.points[1]])
    }

    /// Brings columns into the cone: the nearest point of a standard cone; with limits, what
    /// exceeds them is cut.
    pub(super) fn admit(&self, x: &mut [f64]) {
        match self.cone {
            BearingCone::Rays => x.iter_mut().for_each(|v| *v = v.max(0.0)),
            BearingCone::Rough => x[0] = x[0].max(0.0),
            BearingCone::Circular => {
                let t = x[1].hypot(x[2]);
                if t <= -x[0] {
                    x.fill(0.0);
                } else if t > x[0] {
                    let r = 0.5 * (x[0] + t);
                    (x[0], x[1], x[2]) = (r, x[1] / t * r, x[2] / t * r);
                }
            }
            BearingCone::Limited(limits) => limits.cut(x, self.unit),
        }
    }

    /// Its rows in a program in forces, which start at variable `column`.
    pub(super) fn rows(&self, p: &mut ConicProgram, column: usize) {
        let own = column + self.column;
        let (cone, size) = match self.cone {
            BearingCone::Rays => (Cone::NonNegative(self.basis.len()), self.basis.len()),
            BearingCone::Rough => (Cone::NonNegative(1), 1),
            BearingCone::Circular => (Cone::SecondOrder(3), 3),
            BearingCone::Limited(limits) => {
                let normal = p.cone(Cone::NonNegative(1));
                p.matrix.push(normal, own, -1.0);
                p.rhs[normal] = limits.tension / self.unit;
                for disc in limits.discs(own, self.unit) {
                    disc.cone(p);
                }
                return;
            }
        };
        let first = p.cone(cone);
        for k in 0..size {
            p.matrix.push(first + k, own + k, -1.0);
        }
    }
}

/// `‖x_first…‖ ≤ slope × x_normal + constant`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Column of the normal force.
    pub normal: usize,
    /// First of the columns that are limited.
    pub first: usize,
    /// How many: 1 or 2.
    pub count: usize,
    /// Growth with the normal force.
    pub slope: f64,
    /// Limit without any normal force.
    pub constant: f64,
}

impl Disc {
    /// The limit at a normal force; never negative.
    pub fn limit(&self, normal: f64) -> f64 {
        (self.slope * normal + self.constant).max(0.0)
    }

    /// The rows of the limit that grows with the normal force; divided by a steep slope, so that
    /// friction of 1e6 is no number of that size.
    pub(super) fn cone(&self, p: &mut ConicProgram) {
        let by = 1.0 / self.slope.max(1.0);
        if self.count == 1 {
            let row = p.cone(Cone::NonNegative(2));
            for (k, sign) in [(0, 1.0), (1, -1.0)] {
                p.matrix.push(row + k, self.normal, -self.slope * by);
                p.matrix.push(row + k, self.first, sign * by);
                p.rhs[row + k] = self.constant * by;
            }
        } else {
            let row = p.cone(Cone::SecondOrder(3));
            p.matrix.push(row, self.normal, -self.slope * by);
            p.rhs[row] = self.constant * by;
            p.matrix.push(row + 1, self.first, -by);
            p.matrix.push(row + 2, self.first + 1, -by);
        }
    }
}

impl Limits {
    /// The limits of a point whose columns start at `column` and have this unit, N.
    pub fn discs(&self, column: usize, unit: f64) -> Vec<Disc> {
        let mut discs = Vec::new();
        if self.mu.is_finite() && self.tangents > 0 {
            let constant = self.cohesion / unit;
            discs.push(Disc {
                normal: column,
                first: column + 1,
                count: self.tangents,
                slope: self.mu,
                constant,
            });
        }
        let couples = column + 1 + self.tangents;
        let disc = |first, count| Disc { normal: column, first, count, slope: 1.0, constant: 0.0 };
        match self.couples {
            0 => {}
            1 => discs.push(disc(couples, 1)),
            _ => discs.extend([disc(couples, 2), disc(couples + 2, 1)]),
        }
        discs
    }

    fn cut(&self, x: &mut [f64], unit: f64) {
        x[0] = x[0].max(-self.tension / unit);
        for disc in self.discs(0, unit) {
            let limit = disc.limit(x[0]);
            let part = &mut x[disc.first..disc.first + disc.count];
            let size = part.iter().map(|v| v * v).sum::<f64>().sqrt();
            if size > limit {
                part.iter_mut().for_each(|v| *v *= limit / size);
            }
        }
    }
}

/// The bearings of every interface, in column order.
pub(super) fn bearings(
    model: &Model,
    plane: Option<Plane>,
    options: StaticsOptions,
) -> Vec<Bearing> {
    let Model { assembly, interfaces, .. } = model;
    let mut list = Vec::new();
    let mut column = 0;
    for (index, face) in interfaces.list.iter().enumerate() {
        let n = face.frame.n;
        let shares = if face.law.is_dry() { Vec::new() } else { strength::shares(face) };
        let (directions, cone) = friction_columns(face, plane, options);
        let mut basis: Vec<Wrench> = directions
            .into_iter()
            .map(|force| Wrench { force, moment: Vector3::zeros() })
            .collect();
        if !face.law.is_dry() && strength::rolling_arm(face) > 0.0 {
            let axes =
                plane.map_or_else(|| vec![face.frame.t1, face.frame.t2, n], |p| vec![p.axis]);
            basis.extend(axes.into_iter().map(|axis| Wrench {
                force: Vector3::zeros(),
                moment: axis * strength::rolling_arm(face),
            }));
        }
        let points: Vec<[usize; 2]> = match plane {
            None => (0..face.points.len()).map(|k| [k, k]).collect(),
            Some(p) => {
                let t = p.axis.cross(&n);
                let along = |k: &usize| t.dot(&(face.points[*k] - face.points[0]));
                let by = |a: &usize, b: &usize| along(a).total_cmp(&along(b));
                let (Some(low), Some(high)) =
                    ((0..face.points.len()).min_by(by), (0..face.points.len()).max_by(by))
                else {
                    continue;
                };
                let size = assembly.blocks[face.a].size.min(assembly.blocks[face.b].size);
                let pair = |k: usize| {
                    [
                        k,
                        planar::mirror_of(&face.points, face.points[k], p.axis, p.offset, size)
                            .unwrap_or(k),
                    ]
                };
                if along(&high) - along(&low) <= f64::EPSILON * size {
                    vec![pair(low)]
                } else {
                    vec![pair(low), pair(high)]
                }
            }
        };
        for points in points {
            let mut bearing = Bearing {
                interface: index,
                points,
                column,
                basis: basis.clone(),
                cone,
                unit: 1.0,
                presumed: 0.0,
                orbit: None,
            };
            if let BearingCone::Limited(limits) = &mut bearing.cone {
                if shares.is_empty() {
                    list.push(bearing);
                    column += basis.len();
                    continue;
                }
                let share: f64 = shares[points[0]]
                    + if points[0] == points[1] { 0.0 } else { shares[points[1]] };
                (limits.cohesion, limits.tension) =
                    (face.law.cohesion * share, strength::tension(face) * share);
            }
            column += basis.len();
            list.push(bearing);
        }
    }
    list
}

/// Friction above which the edges of a cone are too flat to be coordinates: forces of common size
/// become differences of forces μ times as large. Larger: digits are lost (at 1e6 light blocks on
/// heavy ones came out wrong). Smaller: scenes go without programs in rates.
const STEEP: f64 = 30.0;

/// Directions of the force columns and their cone; constants of [`Limits`] are still to be filled
/// in.
fn friction_columns(
    face: &Interface,
    plane: Option<Plane>,
    options: StaticsOptions,
) -> (Vec<Vector3<f64>>, BearingCone) {
    let n = face.frame.n;
    let tangents =
        plane.map_or_else(|| vec![face.frame.t1, face.frame.t2], |p| vec![p.axis.cross(&n)]);
    let split = || std::iter::once(n).chain(tangents.iter().copied()).collect::<Vec<_>>();
    let steep = !options.split
        && options.pyramid.is_none()
        && matches!(face.law.friction, Friction::Coefficient(mu) if mu > STEEP);
    if !face.law.is_dry() || steep {
        let couples = match (strength::rolling_arm(face) > 0.0, plane) {
            (false, _) => 0,
            (true, Some(_)) => 1,
            (true, None) => 3,
        };
        let limits = Limits {
            mu: face.law.friction.mu(),
            cohesion: 0.0,
            tension: 0.0,
            tangents: tangents.len(),
            couples,
        };
        return (split(), BearingCone::Limited(limits));
    }
    match (plane, face.law.friction) {
        (_, Friction::Coefficient(mu)) if mu == 0.0 && !options.keep_all => {
            (vec![n], BearingCone::Rays)
        }
        _ if options.split => (split(), BearingCone::Rough),
        (_, Friction::Infinite) => (split(), BearingCone::Rough),
        (Some(_), Friction::Coefficient(mu)) => {
            let (t, scale) = (tangents[0], 1.0 / mu.hypot(1.0));
            (vec![(n + t * mu) * scale, (n - t * mu) * scale], BearingCone::Rays)
        }
        (None, Friction::Coefficient(mu)) if options.pyramid.is_some_and(|p| p.facets > 2) => {
            let Pyramid { facets, around } =
                options.pyramid.unwrap_or(Pyramid { facets: 3, around: false });
            let step = std::f64::consts::TAU / facets as f64;
            let slope = if around { mu / (0.5 * step).cos() } else { mu };
            let edge = |k: usize| {
                let (sin, cos) = (k as f64 * step).sin_cos();
                (n + (tangents[0] * cos + tangents[1] * sin) * slope) / slope.hypot(1.0)
            };
            ((0..facets).map(edge).collect(), BearingCone::Rays)
        }
        (None, Friction::Coefficient(mu)) => {
            let (normal, shear) = if mu > 1.0 { (1.0 / mu, 1.0) } else { (1.0, mu) };
            (vec![n * normal, tangents[0] * shear, tangents[1] * shear], BearingCone::Circular)
        }
    }
}

/// Whether the bearings stand for every point of their interfaces.
pub(super) fn ends_are_all(bearings: &[Bearing], interfaces: &Interfaces) -> bool {
    let mut seen = vec![0usize; interfaces.list.len()];
    for b in bearings {
        seen[b.interface] += b.point_count();
    }
    seen.iter().zip(&interfaces.list).all(|(&n, f)| n == f.points.len())
}
