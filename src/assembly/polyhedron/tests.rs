use super::*;

fn cuboid(x: f64, y: f64, z: f64) -> (Vec<Vector3<f64>>, Vec<Vec<usize>>) {
    let corner =
        |i: usize| Vector3::new(if i & 1 == 0 { 0.0 } else { x }, if i & 2 == 0 { 0.0 } else { y }, if i & 4 == 0 { 0.0 } else { z });
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    ((0..8).map(corner).collect(), faces.iter().map(|f| f.to_vec()).collect())
}

#[test]
fn box_is_exact() {
    let (v, f) = cuboid(1.0, 2.0, 3.0);
    let (p, mends) = Polyhedron::from_faces(v, &f).unwrap();
    assert_eq!(mends, []);
    assert!(p.convex);
    assert_eq!(p.facets.len(), 6);
    let m = p.mass_properties();
    assert!((m.volume - 6.0).abs() < 1e-14);
    assert!((m.centroid - Vector3::new(0.5, 1.0, 1.5)).norm() < 1e-14);
    let i = Vector3::new(13.0, 10.0, 5.0) * 6.0 / 12.0;
    assert!((m.inertia - nalgebra::Matrix3::from_diagonal(&i)).norm() < 1e-13);
}
