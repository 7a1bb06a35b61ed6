//! Cutting one convex polygon by another: Sutherland & Hodgman (1974) with a tolerance.
//!
//! A corner within `tol` of a clip line is *on* it and is kept as it stands. That makes the case
//! masonry is full of, polygons that share corners and sides, exact: nothing is doubled and nothing
//! is lost. The result may reach `tol` beyond the clip polygon.

use super::polygon::{P2, cross, tidy};
use nalgebra::SVector;

/// The part of the convex polygon `subject` inside the convex polygon `clip`, counter-clockwise
/// like both; empty where they have no area in common.
pub fn clip(subject: &[P2], clip: &[P2], tol: f64) -> Vec<P2> {
    let mut polygon = subject.to_vec();
    for (i, &a) in clip.iter().enumerate() {
        let b = clip[(i + 1) % clip.len()];
        let length = (b - a).norm();
        if length <= tol {
            continue; // too short to have a direction; its neighbours bound the polygon here
        }
        let depth: Vec<f64> = polygon.iter().map(|&p| cross(a, b, p) / length).collect();
        if depth.iter().all(|&d| d >= -tol) {
            continue;
        }
        polygon = cut(&polygon, &depth, tol);
        if polygon.len() < 3 {
            return Vec::new();
        }
    }
    tidy(&mut polygon, tol);
    if polygon.len() < 3 { Vec::new() } else { polygon }
}

/// The part of a convex polygon, in its plane or in space, where `depth` is positive; corners where
/// it is 0 within `tol` are kept.
pub fn inside<const D: usize>(
    polygon: &[SVector<f64, D>],
    depth: impl Fn(&SVector<f64, D>) -> f64,
    tol: f64,
) -> Vec<SVector<f64, D>> {
    cut(polygon, &polygon.iter().map(depth).collect::<Vec<_>>(), tol)
}

/// Cuts a convex polygon, in its plane or in space, by the line or plane from which its corners
/// have the signed distances `depth`, positive inside.
fn cut<const D: usize>(
    polygon: &[SVector<f64, D>],
    depth: &[f64],
    tol: f64,
) -> Vec<SVector<f64, D>> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &p) in polygon.iter().enumerate() {
        let next = (i + 1) % polygon.len();
        let (d, e) = (depth[i], depth[next]);
        if d >= -tol {
            kept.push(p);
        }
        if (d > tol && e < -tol) || (d < -tol && e > tol) {
            kept.push(p + (polygon[next] - p) * (d / (d - e)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::super::polygon::area;
    use super::*;
    use proptest::prelude::*;

    const TOL: f64 = 1e-9;

    fn regular(n: usize, radius: f64, turn: f64, at: P2) -> Vec<P2> {
        (0..n)
            .map(|i| (turn + i as f64 / n as f64 * std::f64::consts::TAU).sin_cos())
            .map(|(s, c)| at + P2::new(c, s) * radius)
            .collect()
    }

    #[test]
    fn identical_polygons_come_back_unchanged() {
        let p = regular(12, 1.0, 0.3, P2::new(5.0, -2.0));
        assert_eq!(clip(&p, &p, TOL), p);
    }

    #[test]
    fn shared_side_without_common_area_is_nothing() {
        let square = regular(4, 1.0, std::f64::consts::FRAC_PI_4, P2::zeros());
        let beside = regular(4, 1.0, std::f64::consts::FRAC_PI_4, P2::new(2f64.sqrt(), 0.0));
        assert!(area(&clip(&square, &beside, TOL)) <= 4.0 * TOL);
    }

    #[test]
    fn square_by_the_same_square_turned_45_degrees_is_a_regular_octagon() {
        let c = clip(
            &regular(4, 1.0, 0.0, P2::zeros()),
            &regular(4, 1.0, std::f64::consts::FRAC_PI_4, P2::zeros()),
            TOL,
        );
        assert_eq!(c.len(), 8);
        // Apothem 1/√2: area 8 tan(π/8) / 2.
        assert!((area(&c) - 4.0 * (std::f64::consts::PI / 8.0).tan()).abs() < 1e-14);
    }

    proptest! {
        #[test]
        fn area_does_not_depend_on_which_polygon_cuts(n in 3usize..9, m in 3usize..9, ta in 0.0..6.0, tb in 0.0..6.0, r in 0.1..3.0, x in -2.0..2.0, y in -2.0..2.0) {
            let (a, b) = (regular(n, 1.0, ta, P2::zeros()), regular(m, r, tb, P2::new(x, y)));
            let (ab, ba) = (area(&clip(&a, &b, TOL)), area(&clip(&b, &a, TOL)));
            prop_assert!((ab - ba).abs() < 20.0 * TOL, "{ab} {ba}");
            prop_assert!(ab <= area(&a).min(area(&b)) + 20.0 * TOL);
        }
    }
}
