//! A ball as triangles: an octahedron whose edges are halved, its corners moved onto the sphere.

use nalgebra::Vector3;
use std::collections::HashMap;

/// Corners of a unit ball and triangles counter-clockwise seen from outside, after so many
/// halvings: 8 · 4ⁿ triangles.
pub fn ball(halvings: usize) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let mut points = vec![x, y, z, -x, -y, -z];
    let mut faces: Vec<[u32; 3]> = vec![
        [0, 1, 2],
        [1, 3, 2],
        [3, 4, 2],
        [4, 0, 2],
        [1, 0, 5],
        [3, 1, 5],
        [4, 3, 5],
        [0, 4, 5],
    ];
    for _ in 0..halvings {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let mut finer = Vec::with_capacity(4 * faces.len());
        for [a, b, c] in faces {
            let mut middle = |i: u32, j: u32| {
                *middles.entry([i.min(j), i.max(j)]).or_insert_with(|| {
                    points.push((points[i as usize] + points[j as usize]).normalize());
                    points.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    (points, faces)
}
