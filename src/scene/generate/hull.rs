//! Convex hulls of points: the only place in the generators that names parry.

use parry3d::{mass_properties::MassProperties, math::Vector, transformation::try_convex_hull};

/// A convex polyhedron about its centroid.
pub struct Hull {
    /// Corners.
    pub vertices: Vec<[f64; 3]>,
    /// Triangles, counter-clockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
    /// Volume.
    pub volume: f64,
}

/// The hull of points; `None` where they lie in a plane.
pub fn hull(points: &[[f64; 3]]) -> Option<Hull> {
    let points: Vec<Vector> = points.iter().map(|p| Vector::new(p[0], p[1], p[2])).collect();
    let (corners, triangles) = try_convex_hull(&points).ok()?;
    let mass = MassProperties::from_convex_polyhedron(1.0, &corners, &triangles);
    let (middle, volume) = (mass.local_com, mass.mass());
    let vertices =
        corners.iter().map(|c| [c.x - middle.x, c.y - middle.y, c.z - middle.z]).collect();
    let faces = triangles.iter().map(|t| t.map(|k| k as usize).to_vec()).collect();
    (volume > 0.0).then_some(Hull { vertices, faces, volume })
}
