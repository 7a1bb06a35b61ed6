//! How far a point lies off a block.

use super::{Polyhedron, Solid};
use nalgebra::Vector3;
use std::f64::consts::PI;

impl Solid {
    /// Distance of a point from the block, m; zero inside it.
    pub fn distance(&self, point: Vector3<f64>) -> f64 {
        match self {
            Self::Sphere { center, radius } => ((point - center).norm() - radius).max(0.0),
            Self::Clump { balls, .. } => balls
                .iter()
                .map(|(c, r)| ((point - c).norm() - r).max(0.0))
                .fold(f64::INFINITY, f64::min),
            Self::Polyhedron(p) if is_inside(p, point) => 0.0,
            Self::Polyhedron(p) => {
                triangles(p).map(|t| from_triangle(point, t)).fold(f64::INFINITY, f64::min)
            }
        }
    }
}

/// The surface as triangles.
fn triangles(solid: &Polyhedron) -> impl Iterator<Item = [Vector3<f64>; 3]> + '_ {
    let corner = |v: u32| solid.vertices[v as usize];
    let pieces = solid.facets.iter().flat_map(|f| &f.pieces);
    pieces.flat_map(move |p| {
        p.windows(2).skip(1).map(move |e| [corner(p[0]), corner(e[0]), corner(e[1])])
    })
}

/// Whether the surface is seen from the point in all directions: solid angles of its triangles (van
/// Oosterom & Strackee, 1983) sum to 4π inside, to 0 outside.
fn is_inside(solid: &Polyhedron, point: Vector3<f64>) -> bool {
    if solid.convex {
        return solid.facets.iter().all(|f| f.normal.dot(&point) <= f.offset);
    }
    let angle = |t: [Vector3<f64>; 3]| {
        let [a, b, c] = t.map(|v| v - point);
        let (x, y, z) = (a.norm(), b.norm(), c.norm());
        2.0 * a.dot(&b.cross(&c)).atan2(x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y)
    };
    triangles(solid).map(angle).sum::<f64>() > 2.0 * PI
}

/// Distance of a point from a triangle: from its plane where it lies above it, else from the
/// nearest edge.
fn from_triangle(point: Vector3<f64>, [a, b, c]: [Vector3<f64>; 3]) -> f64 {
    let normal = (b - a).cross(&(c - a));
    let edges = [(a, b), (b, c), (c, a)];
    let above =
        edges.iter().all(|(from, to)| normal.dot(&(to - from).cross(&(point - from))) >= 0.0);
    let length = normal.norm();
    if above && length > 0.0 {
        return (normal.dot(&(point - a)) / length).abs();
    }
    edges.into_iter().map(|(from, to)| from_edge(point, from, to)).fold(f64::INFINITY, f64::min)
}

fn from_edge(point: Vector3<f64>, from: Vector3<f64>, to: Vector3<f64>) -> f64 {
    let edge = to - from;
    let along = if edge.norm_squared() > 0.0 {
        (edge.dot(&(point - from)) / edge.norm_squared()).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (point - from - edge * along).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An L of unit height: the square 0 to 2 without the quarter beyond 1, 1.
    fn l_shape() -> Solid {
        let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        let vertices = [0.0, 1.0]
            .iter()
            .flat_map(|&z| outline.iter().map(move |p| Vector3::new(p[0], p[1], z)))
            .collect();
        let sides = (0..6).map(|i| vec![i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i]);
        let faces: Vec<Vec<usize>> =
            [(0..6).rev().collect(), (6..12).collect()].into_iter().chain(sides).collect();
        Solid::Polyhedron(Polyhedron::from_faces(vertices, &faces).unwrap().0)
    }

    #[test]
    fn a_point_is_as_far_off_as_the_nearest_place_of_the_surface() {
        let solid = l_shape();
        for ([x, y, z], expected) in [
            ([0.5, 0.5, 0.5], 0.0),
            ([1.0, 1.0, 0.5], 0.0),
            ([1.5, 1.5, 0.5], 0.5),
            ([0.5, 0.5, 3.0], 2.0),
            ([-3.0, -4.0, 0.5], 5.0),
            ([1.5, 1.2, 2.0], (1.0f64 + 0.04).sqrt()),
        ] {
            let got = solid.distance(Vector3::new(x, y, z));
            assert!((got - expected).abs() < 1e-12, "{x} {y} {z}: {got} expected {expected}");
        }
        let ball = Solid::Sphere { center: Vector3::zeros(), radius: 1.0 };
        assert_eq!(
            (
                ball.distance(Vector3::new(3.0, 0.0, 0.0)),
                ball.distance(Vector3::new(0.5, 0.0, 0.0))
            ),
            (2.0, 0.0)
        );
    }
}
