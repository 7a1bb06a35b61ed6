//! Prism → vertices and faces. A polygon in the x–z plane is extruded along y, centred on y = 0.

use base::{
    error::{InputError, JsonPath},
    plane::polygon::area,
    tolerance,
};
use nalgebra::{Vector2, Vector3};

type Corner = Vector2<f64>;

/// Vertices, and faces as loops of their indices, counter-clockwise seen from outside.
pub(super) type Surface = (Vec<Vector3<f64>>, Vec<Vec<usize>>);

/// Vertices and outward faces of a prism; `path` is that of the polygon. The numbers are finite and
/// the depth is positive.
pub(super) fn faces(
    polygon: &[[f64; 2]],
    depth: f64,
    path: &JsonPath,
) -> Result<Surface, InputError> {
    let mut points: Vec<Corner> = polygon.iter().map(|&p| p.into()).collect();
    simple(&points, path)?;
    if area(&points) < 0.0 {
        points.reverse();
    }
    let n = points.len();
    // Counter-clockwise from x to z is clockwise about +y, so the loop as it stands faces -y.
    let at = |y: f64| points.iter().map(move |p| Vector3::new(p.x, y, p.y));
    let vertices = at(-0.5 * depth).chain(at(0.5 * depth)).collect();
    let mut faces: Vec<Vec<usize>> = vec![(0..n).collect(), (n..2 * n).rev().collect()];
    faces.extend((0..n).map(|i| {
        let j = (i + 1) % n;
        vec![i, n + i, n + j, j]
    }));
    Ok((vertices, faces))
}

/// Refuses a polygon that has fewer than three corners, repeats a corner, or touches or crosses
/// itself. Everything closer than [`tolerance::WELD`] × the polygon's diagonal touches: the corners
/// would be welded.
fn simple(points: &[Corner], path: &JsonPath) -> Result<(), InputError> {
    let n = points.len();
    if n < 3 {
        return Err(InputError::at(
            path.clone(),
            format!("a polygon needs at least 3 corners, got {n}"),
        ));
    }
    let (low, high) = points.iter().fold((points[0], points[0]), |(l, h), p| (l.inf(p), h.sup(p)));
    let near = tolerance::WELD * (high - low).norm();
    for i in 0..n {
        let j = (i + 1) % n;
        if (points[i] - points[j]).norm() <= near {
            let error = InputError::at(
                path.index(i.max(j)),
                format!("the corner repeats corner {}", i.min(j)),
            );
            return Err(error.hint(if j == 0 {
                "leave the last corner out: the polygon closes by itself"
            } else {
                "leave one of them out"
            }));
        }
    }
    // Sweep along x: only edges whose x-ranges overlap can meet.
    let edge = |i: usize| (points[i], points[(i + 1) % n]);
    let range = |i: usize| {
        let (p, q) = edge(i);
        (p.x.min(q.x), p.x.max(q.x))
    };
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&i, &j| range(i).0.total_cmp(&range(j).0));
    for (k, &i) in order.iter().enumerate() {
        for &j in order[k + 1..].iter().take_while(|&&j| range(j).0 <= range(i).1 + near) {
            let (first, second) = (i.min(j), i.max(j));
            let next = |e: usize| (e + 1) % n;
            let clash = if next(first) == second {
                folds(points[first], points[second], points[next(second)], near)
            } else if next(second) == first {
                folds(points[second], points[first], points[next(first)], near)
            } else {
                distance(edge(first), edge(second)) <= near
            };
            if clash {
                return Err(InputError::at(
                    path.clone(),
                    format!("the polygon meets itself: edge {first} and edge {second} touch or cross"),
                )
                .hint("give the corners in order around the outline; edge i runs from corner i to the next"));
            }
        }
    }
    Ok(())
}

/// Whether the path a–b–c turns back onto itself.
fn folds(a: Corner, b: Corner, c: Corner, near: f64) -> bool {
    point_distance(a, (b, c)) <= near || point_distance(c, (a, b)) <= near
}

fn point_distance(p: Corner, (a, b): (Corner, Corner)) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (p - a - along * t).norm()
}

fn distance(one: (Corner, Corner), two: (Corner, Corner)) -> f64 {
    let side = |(a, b): (Corner, Corner), p: Corner| (b - a).perp(&(p - a));
    let split = |edge, (p, q): (Corner, Corner)| (side(edge, p) > 0.0) != (side(edge, q) > 0.0);
    if split(one, two) && split(two, one) {
        return 0.0;
    }
    [
        point_distance(one.0, two),
        point_distance(one.1, two),
        point_distance(two.0, one),
        point_distance(two.1, one),
    ]
    .into_iter()
    .fold(f64::INFINITY, f64::min)
}
