//! Plane polygons: area, centroid, convex hull, least width, distance.
//!
//! Loops are counter-clockwise; lengths are in m.

use nalgebra::Vector2;

/// A point of a plane, m.
pub type P2 = Vector2<f64>;

/// Twice the signed area of the triangle `a`, `b`, `c`; positive counter-clockwise.
pub fn cross(a: P2, b: P2, c: P2) -> f64 {
    (b - a).perp(&(c - a))
}

/// Signed area, m²; positive counter-clockwise. Taken about the first corner, so that a far origin
/// costs no digits.
pub fn area(polygon: &[P2]) -> f64 {
    polygon.windows(2).skip(1).map(|w| cross(polygon[0], w[0], w[1])).sum::<f64>() / 2.0
}

/// Signed area, m², and its first moment about the first corner, m³.
pub fn area_and_moment(polygon: &[P2]) -> (f64, P2) {
    polygon.windows(2).skip(1).fold((0.0, P2::zeros()), |(area, moment), w| {
        let c = cross(polygon[0], w[0], w[1]) / 2.0;
        (area + c, moment + (w[0] + w[1] - polygon[0] * 2.0) * (c / 3.0))
    })
}

/// Centroid of the area; the mean of the corners where there is no area.
pub fn centroid(polygon: &[P2]) -> P2 {
    let Some(&origin) = polygon.first() else { return P2::zeros() };
    let (area, moment) = area_and_moment(polygon);
    if area == 0.0 {
        polygon.iter().sum::<P2>() / polygon.len() as f64
    } else {
        origin + moment / area
    }
}

/// Length of the closed loop, m.
pub fn perimeter(polygon: &[P2]) -> f64 {
    edges(polygon).map(|(p, q)| (q - p).norm()).sum()
}

/// The sides of the closed loop.
pub fn edges(polygon: &[P2]) -> impl Iterator<Item = (P2, P2)> + '_ {
    polygon.iter().enumerate().map(|(i, &p)| (p, polygon[(i + 1) % polygon.len()]))
}

/// Removes corners that repeat a neighbour or lie on the line between their neighbours, both within
/// `tol`.
pub fn tidy(polygon: &mut Vec<P2>, tol: f64) {
    loop {
        let n = polygon.len();
        if n < 3 {
            return;
        }
        let mut kept = Vec::with_capacity(n);
        let mut dropped_last = false;
        for i in 0..n {
            let (previous, here, next) =
                (polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]);
            // Never two neighbours in one sweep: each is judged by the other.
            let neighbour_dropped =
                dropped_last || (i + 1 == n && kept.first() != Some(&polygon[0]));
            let drop = !neighbour_dropped && distance_to_segment(here, previous, next) <= tol;
            if !drop {
                kept.push(here);
            }
            dropped_last = drop;
        }
        if kept.len() == n {
            return;
        }
        *polygon = kept;
    }
}

/// The convex hull, counter-clockwise, without collinear corners (within `tol`); Andrew's monotone
/// chain (Andrew 1979).
///
/// The turn at two corners that are one but for rounding has any sign, and behind it a corner that
/// dents the hull may be kept: the chain is made anew without such pairs until it is convex.
pub fn hull(points: &[P2], tol: f64) -> Vec<P2> {
    let mut points = points.to_vec();
    loop {
        let mut hull = chain(&mut points);
        tidy(&mut hull, tol);
        if hull.len() == points.len() || is_convex(&hull) {
            return hull;
        }
        points = hull;
    }
}

/// Whether every corner turns left, by rounding at least.
fn is_convex(polygon: &[P2]) -> bool {
    let n = polygon.len();
    (0..n).all(|i| cross(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) >= 0.0)
}

/// The monotone chain; sorts the points and drops repeated ones.
fn chain(points: &mut Vec<P2>) -> Vec<P2> {
    points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    points.dedup();
    if points.len() < 3 {
        return points.clone();
    }
    corners(points).into_iter().map(|i| points[i]).collect()
}

/// Corners of the convex hull, counter-clockwise, as positions in `points`: Andrew's monotone chain
/// (Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions").
pub fn corners(points: &[P2]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&i, &j| {
        points[i].x.total_cmp(&points[j].x).then(points[i].y.total_cmp(&points[j].y))
    });
    let half = |order: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for i in order {
            while let [.., a, b] = chain[..] {
                if cross(points[a], points[b], points[i]) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(i);
        }
        // The last of each half is the first of the other.
        chain.pop();
        chain
    };
    let mut lower = half(&mut order.iter().copied());
    lower.extend(half(&mut order.iter().rev().copied()));
    lower
}

/// Least width of a convex polygon: the least, over its sides, of the greatest distance of a corner
/// from that side.
pub fn width(hull: &[P2]) -> f64 {
    if hull.len() < 3 {
        return 0.0;
    }
    edges(hull)
        .filter(|(p, q)| p != q)
        .map(|(p, q)| hull.iter().map(|&c| cross(p, q, c)).fold(0.0, f64::max) / (q - p).norm())
        .fold(f64::INFINITY, f64::min)
}

/// Distance of `p` from the segment `a`–`b`.
pub fn distance_to_segment(p: P2, a: P2, b: P2) -> f64 {
    let along = b - a;
    let square = along.norm_squared();
    let s = if square > 0.0 { ((p - a).dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (p - a - along * s).norm()
}

/// Whether `p` lies in the convex polygon, its rim widened by `tol`.
pub fn contains(polygon: &[P2], p: P2, tol: f64) -> bool {
    edges(polygon).all(|(a, b)| cross(a, b, p) >= -tol * (b - a).norm())
}

/// Whether two convex polygons come within about `tol` of each other: no side of either separates
/// them by more.
pub fn touch(a: &[P2], b: &[P2], tol: f64) -> bool {
    let separates = |a: &[P2], b: &[P2]| {
        edges(a).any(|(p, q)| b.iter().all(|&c| cross(p, q, c) < -tol * (q - p).norm()))
    };
    !separates(a, b) && !separates(b, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two corners that are one but for rounding: the turn at them says nothing.
    #[test]
    fn a_corner_twice_does_not_dent_the_hull() {
        for shift in [1e-16, -1e-16, 3e-16, -3e-16] {
            for turn in 0..8 {
                let (sin, cos) = (std::f64::consts::FRAC_PI_4 * f64::from(turn)).sin_cos();
                let at = |x: f64, y: f64| p(cos * x - sin * y, sin * x + cos * y);
                // The third lies inside, just above the lower side; a twin of it, moved by
                // rounding, beside it.
                let low = [
                    at(0.0, 0.0),
                    at(2.0, 0.0),
                    at(1.0, 1e-3),
                    at(1.0 + shift, 1e-3),
                    at(1.0, 1e-3 + shift),
                    at(2.0, 2.0),
                    at(0.0, 2.0),
                ];
                let hull = hull(&low, 1e-9);
                assert_eq!(hull.len(), 4, "{hull:?}");
                assert!(low.iter().all(|&c| contains(&hull, c, 1e-12)));
            }
        }
    }

    fn p(x: f64, y: f64) -> P2 {
        P2::new(x, y)
    }

    #[test]
    fn measures_of_a_rectangle_far_from_the_origin() {
        let r = [p(1e4, 1e4), p(1e4 + 2.0, 1e4), p(1e4 + 2.0, 1e4 + 1.0), p(1e4, 1e4 + 1.0)];
        assert_eq!(area(&r), 2.0);
        assert_eq!(centroid(&r), p(1e4 + 1.0, 1e4 + 0.5));
        assert_eq!(perimeter(&r), 6.0);
        assert_eq!(width(&r), 1.0);
    }

    #[test]
    fn hull_drops_inner_repeated_and_collinear_points() {
        let points = [
            p(0.0, 0.0),
            p(1.0, 1e-13),
            p(2.0, 0.0),
            p(2.0, 1.0),
            p(1.0, 0.5),
            p(0.0, 1.0),
            p(0.0, 0.5),
            p(2.0, 1.0 - 1e-12),
            p(1e-13, 0.0),
        ];
        let h = hull(&points, 1e-9);
        assert_eq!(h.len(), 4, "{h:?}");
        assert!((area(&h) - 2.0).abs() < 1e-9);
    }

    #[test]
    fn hull_of_a_line_has_its_two_ends() {
        let h = hull(&[p(0.0, 0.0), p(1.0, 1.0), p(2.0, 2.0), p(0.5, 0.5)], 1e-9);
        assert_eq!(h.len(), 2, "{h:?}");
    }

    #[test]
    fn tidy_keeps_a_fine_circle_round() {
        let n = 1000;
        let mut circle: Vec<P2> = (0..n)
            .map(|i| (i as f64 / n as f64 * std::f64::consts::TAU).sin_cos())
            .map(|(s, c)| p(c, s))
            .collect();
        let before = area(&circle);
        tidy(&mut circle, 1e-9);
        assert_eq!(circle.len(), n);
        // Every corner lies 2e-5 off its neighbours' chord: every second one goes, the rest lie
        // 8e-5 off.
        tidy(&mut circle, 3e-5);
        assert_eq!(circle.len(), n / 2);
        assert!((area(&circle) - before).abs() < 1e-4);
    }

    #[test]
    fn touching_is_told_from_being_apart() {
        let square = |x: f64, y: f64| [p(x, y), p(x + 1.0, y), p(x + 1.0, y + 1.0), p(x, y + 1.0)];
        assert!(touch(&square(0.0, 0.0), &square(1.0, 0.0), 1e-9));
        assert!(touch(&square(0.0, 0.0), &square(1.0, 1.0), 1e-9));
        assert!(!touch(&square(0.0, 0.0), &square(1.001, 0.0), 1e-9));
    }
}
