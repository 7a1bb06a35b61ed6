//! Polygons in a plane: hulls, straight edges, crossings, convex pieces.

use base::plane::polygon::{P2, area, corners as hull, cross, distance_to_segment};
use nalgebra::Vector3;
use std::collections::HashMap;

/// Two axes of a plane, right-handed with its normal.
pub(super) struct Frame {
    t1: Vector3<f64>,
    t2: Vector3<f64>,
}

impl Frame {
    /// Axes around a unit normal.
    pub fn around(n: &Vector3<f64>) -> Self {
        let axis = Vector3::ith(n.iamin(), 1.0);
        let t1 = (axis - n * n.dot(&axis)).normalize();
        Self { t1, t2: n.cross(&t1) }
    }

    pub fn project(&self, p: &Vector3<f64>) -> P2 {
        P2::new(self.t1.dot(p), self.t2.dot(p))
    }

    /// The point at `p` in the parallel plane through the origin.
    pub fn lift(&self, p: P2) -> Vector3<f64> {
        self.t1 * p[0] + self.t2 * p[1]
    }
}

/// The corners of a loop that is convex within `tolerance`, points on its straight edges left out;
/// `None` where it is not convex. Positions in `points`, which run counter-clockwise.
pub(super) fn convex_corners(points: &[P2], tolerance: f64) -> Option<Vec<usize>> {
    // Triangles and quadrilaterals, by far the most common: convex if every corner stands out from
    // the line between its neighbours. (Four left turns cannot go around twice.)
    if let 3 | 4 = points.len() {
        let n = points.len();
        let stands_out = |i: usize| {
            let (a, b, c) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
            cross(a, b, c) > tolerance * (c - a).norm()
        };
        if (0..n).all(stands_out) {
            return Some((0..n).collect());
        }
    }
    let mut corners = hull(points);
    if corners.len() < 3 {
        return None;
    }
    let first = (0..corners.len()).min_by_key(|&i| corners[i])?;
    corners.rotate_left(first);
    if !corners.is_sorted() {
        return None;
    }
    // What is not a corner of the hull must lie on the hull edge that it stands between.
    for i in 0..corners.len() {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        let mut p = (from + 1) % points.len();
        while p != to {
            if distance_to_segment(points[p], points[from], points[to]) > tolerance {
                return None;
            }
            p = (p + 1) % points.len();
        }
    }
    let hull: Vec<P2> = corners.iter().map(|&c| points[c]).collect();
    let kept = straighten(&hull, tolerance);
    (kept.len() >= 3).then(|| kept.into_iter().map(|k| corners[k]).collect())
}

/// The points of a loop that remain when points within `tolerance` of straight edges are left out.
/// Positions, increasing.
///
/// Every point left out is compared with the edge that replaces it (Douglas & Peucker 1973), not
/// with its neighbours: a fine curve is never straightened by more than the tolerance, however many
/// points it has.
pub(super) fn straighten(points: &[P2], tolerance: f64) -> Vec<usize> {
    let n = points.len();
    if n <= 3 {
        return (0..n).collect();
    }
    let farthest = |from: P2| {
        let d = |p: &P2| (p - from).norm();
        (0..n).max_by(|&a, &b| d(&points[a]).total_cmp(&d(&points[b]))).unwrap_or(0)
    };
    // Two corners that surely remain.
    let start = farthest(points[0]);
    let end = farthest(points[start]);
    let at = |i: usize| points[(start + i) % n];
    let end = (end + n - start) % n;
    let mut kept = vec![false; n + 1];
    (kept[0], kept[end], kept[n]) = (true, true, true);
    let mut open = vec![(0, end), (end, n)];
    while let Some((from, to)) = open.pop() {
        let off = |i: usize| distance_to_segment(at(i), at(from), at(to));
        if let Some(worst) = (from + 1..to).max_by(|&a, &b| off(a).total_cmp(&off(b)))
            && off(worst) > tolerance
        {
            kept[worst] = true;
            open.extend([(from, worst), (worst, to)]);
        }
    }
    // A point in an edge parallel to a chord may have been taken for its farthest point: look at
    // each once more between its neighbours.
    let mut previous = 0;
    for i in 1..n {
        if !kept[i] {
            continue;
        }
        let next = (i + 1..=n).find(|&j| kept[j]).unwrap_or(n);
        if (previous + 1..next)
            .all(|j| distance_to_segment(at(j), at(previous), at(next)) <= tolerance)
        {
            kept[i] = false;
        } else {
            previous = i;
        }
    }
    let mut corners: Vec<usize> = (0..n).filter(|&i| kept[i]).map(|i| (start + i) % n).collect();
    corners.sort_unstable();
    corners
}

/// Where a loop crosses itself by more than `tolerance`, if it does. Touching itself, or running
/// back along itself, is not crossing.
pub(super) fn crossing(points: &[P2], tolerance: f64) -> Option<P2> {
    let n = points.len();
    let end = |i: usize| points[(i + 1) % n];
    let span = |i: usize| (points[i][0].min(end(i)[0]), points[i][0].max(end(i)[0]));
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_unstable_by(|&a, &b| span(a).0.total_cmp(&span(b).0));
    for (rank, &i) in order.iter().enumerate() {
        for &j in order[rank + 1..].iter().take_while(|&&j| span(j).0 <= span(i).1) {
            let (a, b, c, d) = (points[i], end(i), points[j], end(j));
            let (ab, cd) = ((b - a).norm(), (d - c).norm());
            let (pa, pb, pc, pd) = (cross(c, d, a), cross(c, d, b), cross(a, b, c), cross(a, b, d));
            let apart = |x: f64, y: f64, length: f64| {
                x * y < 0.0 && x.abs().min(y.abs()) > tolerance * length
            };
            if apart(pa, pb, cd) && apart(pc, pd, ab) {
                let t = pa / (pa - pb);
                return Some(a + (b - a) * t);
            }
        }
    }
    None
}

/// Whether a point lies inside a loop (even-odd rule).
fn contains(points: &[P2], p: P2) -> bool {
    let n = points.len();
    let mut inside = false;
    for i in 0..n {
        let (a, b) = (points[i], points[(i + 1) % n]);
        if (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        {
            inside = !inside;
        }
    }
    inside
}

/// Cuts a region into convex pieces. `loops` are positions in `points`; those that run
/// counter-clockwise bound the region from outside, the others are its holes.
pub(super) fn convex_pieces(points: &[P2], loops: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let shape = |l: &[usize]| -> Vec<P2> { l.iter().map(|&i| points[i]).collect() };
    let (outer, holes): (Vec<_>, Vec<_>) =
        loops.iter().map(|l| (l, shape(l))).partition(|(_, s)| area(s) > 0.0);
    let mut pieces = Vec::new();
    let mut ear = earcut::Earcut::new();
    for (corners, outline) in &outer {
        let mut corners: Vec<usize> = (*corners).clone();
        let mut starts: Vec<u32> = Vec::new();
        for (hole, points) in &holes {
            if outer.len() == 1 || contains(outline, points[0]) {
                starts.push(corners.len() as u32);
                corners.extend(hole.iter());
            }
        }
        let mut triangles: Vec<u32> = Vec::new();
        ear.earcut(corners.iter().map(|&c| points[c].into()), &starts, &mut triangles);
        let triangles = triangles.chunks_exact(3).filter_map(|t| {
            let [a, b, c] =
                [corners[t[0] as usize], corners[t[1] as usize], corners[t[2] as usize]];
            let sign = cross(points[a], points[b], points[c]);
            if sign > 0.0 {
                Some(vec![a, b, c])
            } else if sign < 0.0 {
                Some(vec![a, c, b])
            } else {
                None
            }
        });
        pieces.extend(join_convex(points, triangles.collect()));
    }
    pieces
}

/// Removes inner edges as long as the pieces stay convex (Hertel & Mehlhorn 1983: at most four
/// times the least number of pieces).
fn join_convex(points: &[P2], mut pieces: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    let edges = |piece: &[usize]| -> Vec<(usize, usize)> {
        (0..piece.len()).map(|i| (piece[i], piece[(i + 1) % piece.len()])).collect()
    };
    let mut owner: HashMap<(usize, usize), usize> = HashMap::new();
    for (p, piece) in pieces.iter().enumerate() {
        owner.extend(edges(piece).into_iter().map(|e| (e, p)));
    }
    let mut inner: Vec<(usize, usize)> =
        owner.keys().copied().filter(|&(u, v)| u < v && owner.contains_key(&(v, u))).collect();
    // Longest first: leaves compact pieces, and does not hang on the order of the hash map.
    let length = |&(u, v): &(usize, usize)| (points[u] - points[v]).norm();
    inner.sort_unstable_by(|a, b| length(b).total_cmp(&length(a)).then(a.cmp(b)));
    for (u, v) in inner {
        let (Some(&p), Some(&q)) = (owner.get(&(u, v)), owner.get(&(v, u))) else { continue };
        if p == q {
            continue;
        }
        let from = |piece: &[usize], start: usize| -> Option<Vec<usize>> {
            let at = piece.iter().position(|&x| x == start)?;
            Some([&piece[at..], &piece[..at]].concat())
        };
        // One runs v … u, the other u … v.
        let (Some(a), Some(b)) = (from(&pieces[p], v), from(&pieces[q], u)) else { continue };
        let left = |x: usize, y: usize, z: usize| cross(points[x], points[y], points[z]) >= 0.0;
        if !(left(a[a.len() - 2], u, b[1]) && left(b[b.len() - 2], v, a[1])) {
            continue;
        }
        for edge in edges(&b) {
            owner.insert(edge, p);
        }
        pieces[p] = [&a[..], &b[1..b.len() - 1]].concat();
        pieces[q].clear();
    }
    pieces.retain(|p| !p.is_empty());
    pieces
}
