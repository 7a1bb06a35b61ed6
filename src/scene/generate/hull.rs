//! Convex hulls of points: the only place in this crate that names parry.

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
    let (corners, triangles) = raw(points)?;
    let mass = MassProperties::from_convex_polyhedron(1.0, &corners, &triangles);
    let (middle, volume) = (mass.local_com, mass.mass());
    let vertices =
        corners.iter().map(|c| [c.x - middle.x, c.y - middle.y, c.z - middle.z]).collect();
    (volume > 0.0).then_some(Hull { vertices, faces: faces(triangles), volume })
}

/// Volume over the cube of the size, below which points lie in a plane. Less: rounding is a body. More:
/// needles are none.
const FLAT: f64 = 1e-12;

/// Corners, and the corners of each face.
pub type Corners = (Vec<[f64; 3]>, Vec<Vec<usize>>);

/// Corners of the hull of points, where they are, and triangles, counter-clockwise seen from outside;
/// `None` where the points lie in a plane.
pub fn corners(points: &[[f64; 3]]) -> Option<Corners> {
    let (corners, triangles) = raw(points)?;
    // Of points in a plane there is a hull, too, of two sides.
    let volume = MassProperties::from_convex_polyhedron(1.0, &corners, &triangles).mass();
    let size = corners.iter().map(|c| (*c - corners[0]).length()).fold(0.0, f64::max);
    if volume <= FLAT * size.powi(3) {
        return None;
    }
    Some((corners.iter().map(|c| [c.x, c.y, c.z]).collect(), faces(triangles)))
}

fn raw(points: &[[f64; 3]]) -> Option<(Vec<Vector>, Vec<[u32; 3]>)> {
    let points: Vec<Vector> = points.iter().map(|p| Vector::new(p[0], p[1], p[2])).collect();
    try_convex_hull(&points).ok()
}

fn faces(triangles: Vec<[u32; 3]>) -> Vec<Vec<usize>> {
    triangles.iter().map(|t| t.map(|k| k as usize).to_vec()).collect()
}
