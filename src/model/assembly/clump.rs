//! Mass properties of spheres rigidly joined: of their union, so that where they overlap there is
//! mass once.
//!
//! * Spheres inside another one add nothing.
//! * Where no three spheres have a point in common the union is the sum of the spheres less the
//!   lenses in which two overlap, and a lens is two caps: exact, in closed form. `∫ (r² − x²) xᵏ
//!   dx` gives volume and first moments of a cap, `∫ (r² − x²)² / 4 dx` its second moments across
//!   the axis.
//! * Where three do, columns through the union are added up: along x the union of the chords is
//!   exact; across, the midpoint rule on [`COLUMNS`] × [`COLUMNS`] lines, closer together towards
//!   the silhouette (`y = c + h sin t`). Volume and moments of three spheres are good to 1e-4,
//!   whatever their size and place. It is done in the block's own frame: the mass does not depend
//!   on how the block stands.

use super::MassProperties;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Most spheres of one clump. More: time, for all pairs are looked at. Fewer: no rough lid for long
/// shear boxes (304 of 50 × 8 d).
pub(super) const MOST: usize = 2_000;

/// Lines of columns each way. More: time, by the square. Fewer: digits, by the power 3/2.
const COLUMNS: usize = 160;

type Ball = (Vector3<f64>, f64);

/// Volume, ∫ x dV and ∫ x xᵀ dV about the origin.
#[derive(Clone, Copy)]
struct Moments {
    volume: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Moments {
    const ZERO: Self = Self {
        volume: 0.0,
        first: Vector3::new(0.0, 0.0, 0.0),
        second: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    };

    fn add(&mut self, other: &Self, sign: f64) {
        self.volume += sign * other.volume;
        self.first += sign * other.first;
        self.second += sign * other.second;
    }

    /// Of the part of a ball at `center` beyond a plane at distance `from` along the unit vector
    /// `axis`; the whole ball from `-radius`.
    fn cap(center: Vector3<f64>, radius: f64, axis: Vector3<f64>, from: f64) -> Self {
        let (r2, a, b) = (radius * radius, from, radius);
        let between = |f: &dyn Fn(f64) -> f64| f(b) - f(a);
        let volume = PI * between(&|x| r2 * x - x.powi(3) / 3.0);
        let along = PI * between(&|x| r2 * x * x / 2.0 - x.powi(4) / 4.0);
        let along2 = PI * between(&|x| r2 * x.powi(3) / 3.0 - x.powi(5) / 5.0);
        let across2 =
            0.25 * PI * between(&|x| r2 * r2 * x - 2.0 * r2 * x.powi(3) / 3.0 + x.powi(5) / 5.0);
        let uu = axis * axis.transpose();
        let own = uu * along2 + (Matrix3::identity() - uu) * across2;
        let first = axis * along;
        let shifted = own
            + center * first.transpose()
            + first * center.transpose()
            + center * center.transpose() * volume;
        Self { volume, first: first + center * volume, second: shifted }
    }
}

/// Mass properties of the union at unit density.
pub(super) fn mass_properties(balls: &[Ball]) -> MassProperties {
    // In numbers around one and about the middle: no digits are lost far away, and none overflow.
    let low =
        balls.iter().map(|(c, r)| c.add_scalar(-r)).reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let high =
        balls.iter().map(|(c, r)| c.add_scalar(*r)).reduce(|a, b| a.sup(&b)).unwrap_or_default();
    let (middle, unit) = (0.5 * (low + high), (high - low).amax().max(f64::MIN_POSITIVE));
    let scaled: Vec<Ball> = balls.iter().map(|(c, r)| ((c - middle) / unit, r / unit)).collect();
    let outer = outer(&scaled);
    let m = if has_triple(&outer) { columns(&outer) } else { pairs(&outer) };
    let centroid = m.first / m.volume;
    let covariance = m.second - centroid * centroid.transpose() * m.volume;
    let inertia = Matrix3::identity() * covariance.trace() - covariance;
    MassProperties {
        volume: m.volume * unit.powi(3),
        centroid: middle + centroid * unit,
        inertia: inertia * unit.powi(5),
    }
}

/// The balls that lie inside no other one; of equal ones the first.
fn outer(balls: &[Ball]) -> Vec<Ball> {
    let inside = |i: usize, j: usize| {
        let (gap, (c, r), (d, s)) = ((balls[i].0 - balls[j].0).norm(), balls[i], balls[j]);
        gap + r <= s && (c != d || r < s || j < i)
    };
    (0..balls.len())
        .filter(|&i| !(0..balls.len()).any(|j| j != i && inside(i, j)))
        .map(|i| balls[i])
        .collect()
}

/// Whether three balls, none inside another, have a point inside all of them.
///
/// By symmetry then also one in the plane of the centres, where the common part of three discs has
/// a corner: a point where two circles cross inside the third disc.
fn has_triple(balls: &[Ball]) -> bool {
    let meet = |a: &Ball, b: &Ball| (a.0 - b.0).norm() < a.1 + b.1;
    let crosses_in = |a: &Ball, b: &Ball, c: &Ball| {
        let between = b.0 - a.0;
        let (axis, gap) = (between.normalize(), between.norm());
        let along = (gap * gap + a.1 * a.1 - b.1 * b.1) / (2.0 * gap);
        let off = c.0 - a.0;
        let side =
            (off - axis * axis.dot(&off)).try_normalize(1e-12).unwrap_or_else(|| across(&axis));
        let half = (a.1 * a.1 - along * along).max(0.0).sqrt();
        [half, -half]
            .iter()
            .any(|h| (a.0 + axis * along + side * *h - c.0).norm() < c.1 * (1.0 - 1e-12))
    };
    let n = balls.len();
    (0..n).any(|i| {
        (0..i).filter(|&j| meet(&balls[i], &balls[j])).any(|j| {
            (0..j).filter(|&k| meet(&balls[i], &balls[k]) && meet(&balls[j], &balls[k])).any(|k| {
                let (a, b, c) = (&balls[i], &balls[j], &balls[k]);
                crosses_in(a, b, c) || crosses_in(b, c, a) || crosses_in(c, a, b)
            })
        })
    })
}

/// Some unit vector across another.
fn across(axis: &Vector3<f64>) -> Vector3<f64> {
    axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize()
}

/// Spheres less lenses.
fn pairs(balls: &[Ball]) -> Moments {
    let mut sum = Moments::ZERO;
    for (i, (c, r)) in balls.iter().enumerate() {
        sum.add(&Moments::cap(*c, *r, Vector3::z(), -r), 1.0);
        for (d, s) in &balls[..i] {
            let gap = (d - c).norm();
            if gap < r + s {
                let axis = (d - c) / gap;
                let from = (gap * gap + r * r - s * s) / (2.0 * gap);
                sum.add(&Moments::cap(*c, *r, axis, from), -1.0);
                sum.add(&Moments::cap(*d, *s, -axis, gap - from), -1.0);
            }
        }
    }
    sum
}

/// Columns along x.
fn columns(balls: &[Ball]) -> Moments {
    let side = |k: usize| {
        let low = balls.iter().map(|(c, r)| c[k] - r).fold(f64::INFINITY, f64::min);
        let high = balls.iter().map(|(c, r)| c[k] + r).fold(f64::NEG_INFINITY, f64::max);
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        (0..COLUMNS).map(move |i| {
            let t = PI * (i as f64 + 0.5) / COLUMNS as f64 - FRAC_PI_2;
            (middle + half * t.sin(), half * t.cos() * PI / COLUMNS as f64)
        })
    };
    let mut sum = Moments::ZERO;
    let mut chords: Vec<(f64, f64)> = Vec::with_capacity(balls.len());
    for (z, dz) in side(2) {
        for (y, dy) in side(1) {
            chords.clear();
            chords.extend(balls.iter().filter_map(|(c, r)| {
                let left = r * r - (y - c.y).powi(2) - (z - c.z).powi(2);
                (left > 0.0).then(|| (c.x - left.sqrt(), c.x + left.sqrt()))
            }));
            chords.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut end = f64::NEG_INFINITY;
            for &(from, to) in &chords {
                let from = from.max(end);
                if to > from {
                    end = to;
                    let (l, x1, x2) = (
                        to - from,
                        (to * to - from * from) / 2.0,
                        (to.powi(3) - from.powi(3)) / 3.0,
                    );
                    let second = Matrix3::new(
                        x2,
                        x1 * y,
                        x1 * z,
                        x1 * y,
                        l * y * y,
                        l * y * z,
                        x1 * z,
                        l * y * z,
                        l * z * z,
                    );
                    sum.add(
                        &Moments { volume: l, first: Vector3::new(x1, l * y, l * z), second },
                        dy * dz,
                    );
                }
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(got: f64, want: f64, tolerance: f64) {
        assert!(
            (got - want).abs() <= tolerance * want.abs(),
            "{got}, expected {want}: off by {:.1e}",
            got / want - 1.0
        );
    }

    fn at(x: f64, y: f64, z: f64) -> Vector3<f64> {
        Vector3::new(x, y, z)
    }

    #[test]
    fn two_spheres_overlap_in_a_lens() {
        // Lens of two spheres of radius R at distance d: π (4 R + d) (2 R − d)² / 12.
        let (r, d) = (0.7, 0.5);
        let m = mass_properties(&[(at(1e3, 0.0, 0.0), r), (at(1e3, d, 0.0), r)]);
        near(
            m.volume,
            8.0 / 3.0 * PI * r.powi(3) - PI * (4.0 * r + d) * (2.0 * r - d).powi(2) / 12.0,
            1e-13,
        );
        assert!((m.centroid - at(1e3, 0.5 * d, 0.0)).norm() < 1e-12, "{}", m.centroid);
        // Touching: two spheres and Steiner.
        let m = mass_properties(&[(at(0.0, 0.0, 0.0), 1.0), (at(0.0, 0.0, 2.0), 1.0)]);
        let v = 4.0 / 3.0 * PI;
        near(m.inertia[(2, 2)], 2.0 * 0.4 * v, 1e-14);
        near(m.inertia[(0, 0)], 2.0 * v * (0.4 + 1.0), 1e-14);
    }

    #[test]
    fn spheres_inside_another_and_spheres_given_twice_weigh_nothing() {
        let one = mass_properties(&[(at(1.0, 2.0, 3.0), 2.0)]);
        let balls = [
            (at(1.0, 2.0, 3.0), 2.0),
            (at(1.5, 2.0, 3.0), 1.0),
            (at(1.0, 2.0, 3.0), 2.0),
            (at(1.0, 2.0, 4.0), 1.0),
        ];
        let m = mass_properties(&balls);
        near(m.volume, one.volume, 1e-14);
        near(m.inertia.trace(), one.inertia.trace(), 1e-14);
        near(one.inertia.trace(), 3.0 * 0.4 * one.volume * 4.0, 1e-14);
    }

    #[test]
    fn columns_agree_with_the_closed_form() {
        let balls =
            [(at(0.0, 0.0, 0.0), 1.0), (at(0.7, 0.4, -0.5), 0.8), (at(-0.6, -0.9, 0.7), 0.6)];
        assert!(!has_triple(&balls));
        let (exact, counted) = (pairs(&balls), columns(&balls));
        let off = (
            counted.volume / exact.volume - 1.0,
            (counted.first - exact.first).norm() / exact.volume,
            (counted.second - exact.second).norm() / exact.second.norm(),
        );
        assert!(off.0.abs() < 1e-4 && off.1 < 1e-4 && off.2 < 1e-4, "{off:?}");
    }

    #[test]
    fn three_spheres_around_a_point_are_counted_once() {
        let r = 0.6;
        let balls: Vec<Ball> = (0..3)
            .map(|k| (r * k as f64 * PI / 1.5, k))
            .map(|(_, k)| {
                let (s, c) = (k as f64 * PI / 1.5).sin_cos();
                (at(r * c, r * s, 0.0), 1.0)
            })
            .collect();
        assert!(has_triple(&balls));
        let m = mass_properties(&balls);
        assert!(m.centroid.norm() < 1e-4, "{}", m.centroid);
        // Threefold symmetry: the inertia is the same about every axis in the plane.
        near(m.inertia[(0, 0)], m.inertia[(1, 1)], 3e-4);
        // The same shape turned out of the grid.
        let turn = nalgebra::Rotation3::new(at(0.3, -0.8, 0.5));
        let turned =
            mass_properties(&balls.iter().map(|(c, r)| (turn * c, *r)).collect::<Vec<_>>());
        near(turned.volume, m.volume, 2e-4);
        // A fourth sphere inside the union and inside no other sphere changes nothing.
        let inner: Vec<Ball> = balls.iter().copied().chain([(at(0.0, 0.0, 0.0), 0.55)]).collect();
        near(mass_properties(&inner).volume, m.volume, 1e-12);
    }

    #[test]
    fn triples_are_seen_where_they_are() {
        let triangle = |side: f64| {
            [
                (at(0.0, 0.0, 0.0), 1.0),
                (at(side, 0.0, 0.0), 1.0),
                (at(0.5 * side, 0.75f64.sqrt() * side, 0.0), 1.0),
            ]
        };
        // Three unit discs on a triangle of side s meet in one point at s = √3.
        assert!(
            has_triple(&triangle(3f64.sqrt() - 1e-6)) && !has_triple(&triangle(3f64.sqrt() + 1e-6))
        );
        // In a row: the lens of two of them inside the third.
        assert!(has_triple(&[
            (at(0.0, 0.0, 0.0), 1.0),
            (at(1.0, 0.0, 0.0), 1.0),
            (at(0.5, 0.0, 0.0), 0.9)
        ]));
        assert!(!has_triple(&[
            (at(0.0, 0.0, 0.0), 1.0),
            (at(1.0, 0.0, 0.0), 1.0),
            (at(2.0, 0.0, 0.0), 1.0)
        ]));
    }
}
