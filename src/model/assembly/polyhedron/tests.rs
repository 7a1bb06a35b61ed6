use super::*;
use base::error::FindingCode;
use nalgebra::{Matrix3, Rotation3};
use proptest::prelude::*;

type Points = Vec<Vector3<f64>>;
type Faces = Vec<Vec<usize>>;

fn build(shape: &(Points, Faces)) -> Result<(Polyhedron, Vec<Mend>), ShapeError> {
    Polyhedron::from_faces(shape.0.clone(), &shape.1)
}

/// Built without anything to mend.
fn clean(shape: &(Points, Faces)) -> Polyhedron {
    let (p, mends) = build(shape).unwrap();
    assert_eq!(mends, []);
    p
}

fn refused(shape: &(Points, Faces)) -> ShapeError {
    let error = build(shape).map(|(p, m)| (p.facets.len(), m)).unwrap_err();
    assert!(!error.hint().is_empty() && !error.to_string().contains('\n'));
    error
}

/// A box with one corner at `low`.
fn cuboid_at(low: [f64; 3], size: [f64; 3]) -> (Points, Faces) {
    let corner =
        |i: usize| Vector3::from_fn(|k, _| low[k] + if i >> k & 1 == 1 { size[k] } else { 0.0 });
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    ((0..8).map(corner).collect(), faces.iter().map(|f| f.to_vec()).collect())
}

fn cuboid(x: f64, y: f64, z: f64) -> (Points, Faces) {
    cuboid_at([0.0; 3], [x, y, z])
}

/// A polygon in x–y, counter-clockwise, extruded to `height`; its two ends are one face each.
fn prism(polygon: &[[f64; 2]], height: f64) -> (Points, Faces) {
    let n = polygon.len();
    let level = |z: f64| polygon.iter().map(move |p| Vector3::new(p[0], p[1], z));
    let mut faces: Faces = vec![(0..n).rev().collect(), (n..2 * n).collect()];
    faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
    (level(0.0).chain(level(height)).collect(), faces)
}

fn drum(sides: usize) -> (Points, Faces) {
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / sides as f64;
    prism(&(0..sides).map(|i| [angle(i).cos(), angle(i).sin()]).collect::<Vec<_>>(), 1.0)
}

const L: [[f64; 2]; 6] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
const U: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [3.0, 0.0],
    [3.0, 2.0],
    [2.0, 2.0],
    [2.0, 1.0],
    [1.0, 1.0],
    [1.0, 2.0],
    [0.0, 2.0],
];

/// Two shapes in one list.
fn with(mut a: (Points, Faces), b: (Points, Faces)) -> (Points, Faces) {
    let n = a.0.len();
    a.0.extend(b.0);
    a.1.extend(b.1.into_iter().map(|f| f.into_iter().map(|i| i + n).collect()));
    a
}

fn inverted(mut shape: (Points, Faces)) -> (Points, Faces) {
    shape.1.iter_mut().for_each(|f| f.reverse());
    shape
}

/// A square frame of outer side 3, inner side 1, height 1, centred on the origin; its top and
/// bottom arrive as 8 triangles each.
fn frame() -> (Points, Faces) {
    let square =
        |s: f64, z: f64| [[-s, -s], [s, -s], [s, s], [-s, s]].map(|p| Vector3::new(p[0], p[1], z));
    let points =
        [square(1.5, -0.5), square(0.5, -0.5), square(1.5, 0.5), square(0.5, 0.5)].concat();
    let mut faces = Faces::new();
    for i in 0..4 {
        let j = (i + 1) % 4;
        faces.push(vec![i, j, 8 + j, 8 + i]);
        faces.push(vec![4 + j, 4 + i, 12 + i, 12 + j]);
        faces.push(vec![j, i, 4 + i]);
        faces.push(vec![j, 4 + i, 4 + j]);
        faces.push(vec![8 + i, 8 + j, 12 + i]);
        faces.push(vec![8 + j, 12 + j, 12 + i]);
    }
    (points, faces)
}

fn dodecahedron() -> (Points, Faces) {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let mut points = Points::new();
    for i in 0..8 {
        points.push(Vector3::from_fn(|k, _| if i >> k & 1 == 1 { 1.0 } else { -1.0 }));
    }
    for k in 0..3 {
        for (s, t) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            let mut p = Vector3::zeros();
            p[(k + 1) % 3] = s / g;
            p[(k + 2) % 3] = t * g;
            points.push(p);
        }
    }
    // One pentagon in each direction of an icosahedron's corner.
    let mut faces = Faces::new();
    for k in 0..3 {
        for (s, t) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            let mut n = Vector3::zeros();
            n[(k + 1) % 3] = s * g;
            n[(k + 2) % 3] = t;
            let most = points.iter().map(|p| n.dot(p)).fold(f64::MIN, f64::max);
            let mut face: Vec<usize> =
                (0..20).filter(|&i| n.dot(&points[i]) > most - 1e-9).collect();
            let first = points[face[0]];
            let x = (first - n * n.dot(&first) / n.norm_squared()).normalize();
            let y = n.normalize().cross(&x);
            face.sort_by(|&a, &b| {
                points[a]
                    .dot(&y)
                    .atan2(points[a].dot(&x))
                    .total_cmp(&points[b].dot(&y).atan2(points[b].dot(&x)))
            });
            faces.push(face);
        }
    }
    (points, faces)
}

fn assert_box(p: &Polyhedron, center: Vector3<f64>, size: [f64; 3], relative: f64) {
    let m = p.mass_properties();
    let volume = size[0] * size[1] * size[2];
    let square = size.map(|s| s * s);
    let exact = Vector3::new(square[1] + square[2], square[2] + square[0], square[0] + square[1])
        * volume
        / 12.0;
    assert!((m.volume / volume - 1.0).abs() < relative, "{m:?}");
    assert!((m.centroid - center).norm() < relative * (p.vertices[0].norm() + size[0]), "{m:?}");
    assert!((m.inertia - Matrix3::from_diagonal(&exact)).norm() < relative * exact.norm(), "{m:?}");
}

// ---- exact answers ----

#[test]
fn box_is_exact() {
    let p = clean(&cuboid(1.0, 2.0, 3.0));
    assert!(p.convex);
    assert_eq!((p.facets.len(), p.vertices.len()), (6, 8));
    assert_box(&p, Vector3::new(0.5, 1.0, 1.5), [1.0, 2.0, 3.0], 1e-14);
    for f in &p.facets {
        assert_eq!((f.pieces.len(), f.pieces[0].len(), f.warp), (1, 4, 0.0));
        assert!(p.facet_vertices(f).iter().all(|v| f.normal.dot(v) == f.offset));
        assert!(f.normal.dot(&(p.facet_vertices(f)[0] - p.mass_properties().centroid)) > 0.0);
    }
}

#[test]
fn tetrahedron_is_exact() {
    let points = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let p = clean(&(points, vec![vec![0, 2, 1], vec![0, 1, 3], vec![1, 2, 3], vec![2, 0, 3]]));
    let m = p.mass_properties();
    assert!((m.volume - 1.0 / 6.0).abs() < 1e-16);
    assert!((m.centroid - Vector3::repeat(0.25)).norm() < 1e-15);
    // ∫x² = 1/60 and ∫xy = 1/120 about the corner; about the centroid 1/60 − 1/96 and 1/120 − 1/96.
    let (square, product) = (1.0 / 60.0 - 1.0 / 96.0, 1.0 / 120.0 - 1.0 / 96.0);
    let exact = Matrix3::from_fn(|i, j| if i == j { 2.0 * square } else { -product });
    assert!((m.inertia - exact).norm() < 1e-16);
    assert!(p.convex);
}

#[test]
fn l_prism_is_exact_and_not_convex() {
    let p = clean(&prism(&L, 0.5));
    let m = p.mass_properties();
    // 1 × 3 and 1 × 1.
    assert!((m.volume - 2.0).abs() < 1e-14);
    assert!(
        (m.centroid - Vector3::new((3.0 * 0.5 + 1.5) / 4.0, (3.0 * 1.5 + 0.5) / 4.0, 0.25)).norm()
            < 1e-14
    );
    let izz = 1.5 * (1.0 + 9.0) / 12.0
        + 0.5 * 2.0 / 12.0
        + 1.5 * (0.25f64.powi(2) + 0.25f64.powi(2))
        + 0.5 * (0.75f64.powi(2) * 2.0);
    assert!((m.inertia[(2, 2)] - izz).abs() < 1e-14);
    assert!(!p.convex);
    assert_eq!(p.facets.len(), 8);
    // Two convex pieces are the least for an L.
    assert_eq!(
        p.facets.iter().map(|f| f.pieces.len()).collect::<Vec<_>>(),
        [2, 2, 1, 1, 1, 1, 1, 1]
    );
}

#[test]
fn u_prism_is_exact() {
    let p = clean(&prism(&U, 2.0));
    assert!((p.mass_properties().volume - 10.0).abs() < 1e-13);
    assert!(
        (p.mass_properties().centroid - Vector3::new(1.5, (3.0 * 0.5 + 2.0 * 1.5) / 5.0, 1.0))
            .norm()
            < 1e-14
    );
    assert_eq!(p.facets.len(), 10);
    assert!((p.facets[0].area - 5.0).abs() < 1e-14);
    assert!(p.facets[0].pieces.len() <= 4);
}

#[test]
fn cavity_is_subtracted() {
    let shape = with(cuboid(3.0, 3.0, 3.0), inverted(cuboid_at([1.0; 3], [1.0; 3])));
    let p = clean(&shape);
    assert!((p.mass_properties().volume - 26.0).abs() < 1e-13);
    let exact = 27.0 * 18.0 / 12.0 - 2.0 / 12.0;
    assert!((p.mass_properties().inertia[(0, 0)] - exact).abs() < 1e-12);
    assert_eq!(p.facets.len(), 12);
    assert!(!p.convex);
    // The whole inside out is the same block.
    let (q, mends) = build(&inverted(shape)).unwrap();
    assert_eq!(mends, [Mend::Inverted { faces: 12 }]);
    assert!((q.mass_properties().volume - 26.0).abs() < 1e-13);
}

#[test]
fn frame_has_ring_facets() {
    let p = clean(&frame());
    assert!((p.mass_properties().volume - 8.0).abs() < 1e-14);
    assert!(p.mass_properties().centroid.norm() < 1e-15);
    assert_eq!(p.facets.len(), 10);
    let rings: Vec<&Facet> = p.facets.iter().filter(|f| f.normal.z.abs() > 0.5).collect();
    assert_eq!(rings.len(), 2);
    for ring in rings {
        assert!((ring.area - 8.0).abs() < 1e-14);
        let filled: f64 = ring.pieces.iter().map(|piece| piece_area(&p, ring, piece)).sum();
        assert!((filled - 8.0).abs() < 1e-13);
        assert!((3..=8).contains(&ring.pieces.len()));
    }
}

#[test]
fn ring_face_may_come_as_one_loop_with_a_bridge() {
    let mut shape = frame();
    shape.1.retain(|f| f.len() == 4);
    shape.1.push(vec![8, 9, 10, 11, 8, 12, 15, 14, 13, 12]);
    shape.1.push(vec![3, 2, 1, 0, 4, 5, 6, 7, 4, 0]);
    let p = clean(&shape);
    assert_eq!(p.facets.len(), 10);
    assert!((p.mass_properties().volume - 8.0).abs() < 1e-14);
    let filled: f64 =
        p.facets.iter().flat_map(|f| f.pieces.iter().map(|piece| piece_area(&p, f, piece))).sum();
    assert!((filled - (2.0 * 8.0 + 12.0 + 4.0)).abs() < 1e-13);
}

/// Area of a piece, and that it is convex and counter-clockwise.
fn piece_area(p: &Polyhedron, facet: &Facet, piece: &[u32]) -> f64 {
    let points: Points = p.points(piece).collect();
    let n = points.len();
    assert!(n >= 3);
    for i in 0..n {
        let (a, b, c) = (points[i], points[(i + 1) % n], points[(i + 2) % n]);
        assert!(
            facet.normal.dot(&(b - a).cross(&(c - b))) >= -1e-12 * (b - a).norm() * (c - b).norm()
        );
    }
    (1..n - 1)
        .map(|i| facet.normal.dot(&(points[i] - points[0]).cross(&(points[i + 1] - points[0]))))
        .sum::<f64>()
        / 2.0
}

#[test]
fn sliver_is_a_block() {
    let p = clean(&cuboid(1.0, 1.0, 1e-6));
    assert_box(&p, Vector3::new(0.5, 0.5, 5e-7), [1.0, 1.0, 1e-6], 1e-9);
    assert_eq!(p.facets.len(), 6);
    assert!(p.convex);
}

#[test]
fn far_from_the_origin_nothing_is_lost() {
    let center = Vector3::new(1e4 + 0.5, -1e4 + 1.0, 1e4 + 1.5);
    let p = clean(&cuboid_at([1e4, -1e4, 1e4], [1.0, 2.0, 3.0]));
    assert_box(&p, center, [1.0, 2.0, 3.0], 1e-14);
}

#[test]
fn extreme_sizes_keep_their_inertia() {
    for scale in [1e-29, 1e29] {
        let p = clean(&cuboid(scale, 2.0 * scale, 3.0 * scale));
        assert_box(
            &p,
            Vector3::new(0.5, 1.0, 1.5) * scale,
            [scale, 2.0 * scale, 3.0 * scale],
            1e-13,
        );
    }
    assert!(matches!(refused(&cuboid(1e-60, 1e-60, 1e-60)), ShapeError::OutOfRange { .. }));
    assert!(matches!(refused(&cuboid(1e200, 1.0, 1.0)), ShapeError::OutOfRange { .. }));
}

// ---- facets ----

#[test]
fn fine_curves_keep_their_facets() {
    let p = clean(&drum(1000));
    assert_eq!(p.facets.len(), 1002);
    assert!(p.convex);
    assert_eq!(p.facets[0].pieces[0].len(), 1000);
    assert!(
        (p.mass_properties().volume - 500.0 * (std::f64::consts::TAU / 1000.0).sin()).abs() < 1e-12
    );

    // A sphere of 100 × 50 quadrilaterals and triangles.
    let (around, up) = (100, 50);
    let mut points = vec![-Vector3::z(), Vector3::z()];
    for j in 1..up {
        for i in 0..around {
            let (a, b) = (
                std::f64::consts::TAU * i as f64 / around as f64,
                std::f64::consts::PI * (j as f64 / up as f64 - 0.5),
            );
            points.push(Vector3::new(b.cos() * a.cos(), b.cos() * a.sin(), b.sin()));
        }
    }
    let at = |i: usize, j: usize| 2 + (j - 1) * around + i % around;
    let mut faces = Faces::new();
    for i in 0..around {
        faces.push(vec![0, at(i + 1, 1), at(i, 1)]);
        faces.push(vec![1, at(i, up - 1), at(i + 1, up - 1)]);
        faces.extend(
            (1..up - 1).map(|j| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]),
        );
    }
    let p = clean(&(points, faces));
    assert_eq!(p.facets.len(), around * up);
    assert!(p.convex);
}

#[test]
fn warped_face_is_kept_whole_and_said() {
    let mut shape = cuboid(1.0, 1.0, 1.0);
    shape.0[7].z += 0.01;
    let (p, mends) = build(&shape).unwrap();
    let [mend @ Mend::Warped { faces: 1, face: 1, warp }] = &mends[..] else { panic!("{mends:?}") };
    assert!((warp - 0.0025).abs() < 1e-5);
    assert_eq!(mend.finding("k").code, FindingCode::Warped);
    assert_eq!(p.facets.len(), 6);
    assert_eq!(p.facets[1].pieces.len(), 1);
    // The mean of the four corners is a quarter of the lift above the square; so is the mean height
    // of the fan.
    assert!((p.mass_properties().volume - 1.0025).abs() < 1e-12);
    assert!((p.facets[1].warp - warp).abs() < 1e-15);

    // Stacked on a block whose top is the same warped face, it leaves neither gap nor overlap.
    let upper_face: Points = [4, 5, 7, 6].iter().map(|&i| shape.0[i]).collect();
    let mut above = cuboid_at([0.0, 0.0, 1.0], [1.0, 1.0, 1.0]);
    for (&i, p) in [0, 1, 3, 2].iter().zip(upper_face) {
        above.0[i] = p;
    }
    let (q, _) = build(&above).unwrap();
    assert!((p.mass_properties().volume + q.mass_properties().volume - 2.0).abs() < 1e-14);
}

#[test]
fn folded_face_is_refused() {
    // Two sides of a box as one face of six corners, the others as they are: where it runs between
    // them nobody can say.
    let (points, mut faces) = cuboid(1.0, 1.0, 1.0);
    let shared = |f: &[usize]| f.iter().filter(|&v| faces[0].contains(v)).count();
    let beside = (1..6).find(|&f| shared(&faces[f]) == 2).unwrap();
    let second = faces.remove(beside);
    let first = &mut faces[0];
    let n = first.len();
    let i = (0..n)
        .find(|&i| second.contains(&first[i]) && second.contains(&first[(i + 1) % n]))
        .unwrap();
    let from = second.iter().position(|&v| v == first[i]).unwrap();
    // Counter-clockwise the neighbour runs the shared edge the other way, so its own two corners
    // follow it.
    let own: Vec<usize> = (1..=2).map(|k| second[(from + k) % 4]).collect();
    for (k, v) in own.into_iter().enumerate() {
        first.insert(i + 1 + k, v);
    }
    assert!(matches!(refused(&(points, faces)), ShapeError::Folded { face: 0, .. }));
}

#[test]
fn a_tangle_of_folded_faces_that_encloses_more_than_its_box_is_refused() {
    // Found by the fuzzer.
    let points = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [-1.0 + 1e-19, -1.0 + 1e-19, -1.0],
        [0.0, 0.0, 4.0 + 1e-3],
        [-2.0 + 1e-3, -2.0 + 1e-3, -2.0 + 1e-3],
        [0.0, -2.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, -2.0, 0.0],
    ];
    let points: Points = points.iter().map(|&p| p.into()).collect();
    let faces = vec![vec![2, 4, 0], vec![0, 7, 5, 3, 2, 4, 0], vec![5, 5, 4, 5, 3, 2, 1]];
    refused(&(points, faces));
}

#[test]
fn a_tangle_with_negative_moments_is_refused() {
    // Found by the fuzzer: warped faces that run through each other.
    let far = |x: f64| x + 1e-19;
    let points = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 4.0, 3.0],
        [far(-1.0), -1.0 + 10f64.powi(-3), far(-2.0)],
        [far(-1.0), far(-1.0), far(-1.0)],
        [-1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [-3.0, -1.0, -1.0],
        [-1.0, -1.0, -2.0],
        [0.0, 0.0, 0.0],
        [-4.0, -1.0, -2.0],
        [0.0, 0.0, 4.0],
        [-2.0 + 1e-3, -2.0 + 1e-3, -2.0 + 1e-3],
    ];
    let points: Points = points.iter().map(|&p| p.into()).collect();
    let faces = vec![
        vec![5, 5, 5, 5, 5, 13, 5, 7],
        vec![5, 5, 5, 5, 4, 0],
        vec![5, 4, 5, 3, 2, 1],
        vec![4, 5, 3, 2, 1],
    ];
    refused(&(points, faces));
    // And by hand: two boxes of which the larger is wound inward would weigh less than nothing
    // where they overlap.
    let surface = with(cuboid(1.0, 1.0, 1.0), cuboid_at([0.2, 0.2, 0.2], [0.5, 0.5, 1.5]));
    refused(&surface);
}

#[test]
fn faces_that_go_around_twice_are_refused() {
    // Found by the fuzzer: three times around one triangle and spikes to elsewhere; the centroid
    // lay outside of what was left.
    let (o, far) = ([0.0; 3], [-3.0; 3]);
    let points = [[1.0, 0.1, -1.0], [-1.0; 3], [2.0; 3], o, [1.0, 0.0, 0.0], [-4.0; 3], far];
    let points: Points = points.iter().map(|&p| p.into()).collect();
    let faces = vec![
        vec![5, 2, 3, 6, 0, 1, 3, 6, 0, 1, 3, 5, 2, 4, 3, 6, 0, 1],
        vec![3, 6, 0, 1, 3, 5, 2, 4, 3, 6, 0, 1, 6, 0, 1, 6, 0, 1],
        vec![6, 0, 1],
    ];
    assert!(matches!(refused(&(points, faces)), ShapeError::CrossedFace { .. }));
    // A square that goes around twice, in a box; once around and a bridge is no such thing.
    let (points, mut faces) = cuboid(1.0, 1.0, 1.0);
    faces[0] = [faces[0].clone(), faces[0].clone()].concat();
    assert!(matches!(refused(&(points, faces)), ShapeError::CrossedFace { face: 0, .. }));
}

#[test]
fn two_bodies_are_said() {
    let (p, mends) =
        build(&with(cuboid(1.0, 1.0, 1.0), inverted(cuboid_at([2.0, 0.0, 0.0], [1.0; 3]))))
            .unwrap();
    assert_eq!(mends, [Mend::Bodies { bodies: 2 }, Mend::Turned { faces: 6, first: 6, of: 12 }]);
    assert!((p.mass_properties().volume - 2.0).abs() < 1e-14);
    assert!(!p.convex);
}

#[test]
fn bodies_that_touch_in_an_edge_or_corner_are_not_overlapping() {
    for low in [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 0.5, 1.0]] {
        let (p, _) = build(&with(cuboid(1.0, 1.0, 1.0), cuboid_at(low, [1.0; 3]))).unwrap();
        assert!((p.mass_properties().volume - 2.0).abs() < 1e-14, "{low:?}");
    }
}

#[test]
fn voxels_that_meet_in_an_edge_are_one_solid() {
    // A ring of voxels closed through a shared edge: that edge has four faces.
    let polygon = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [3.0, 1.0],
        [3.0, 3.0],
        [0.0, 3.0],
    ];
    let mut shape = prism(&polygon, 1.0);
    shape.1[0].reverse();
    let (p, mends) = build(&shape).unwrap();
    assert!((p.mass_properties().volume - 7.0).abs() < 1e-13, "{:?}", p.mass_properties());
    assert!(mends.contains(&Mend::Turned { faces: 1, first: 0, of: 12 }), "{mends:?}");
    let filled: f64 =
        p.facets.iter().flat_map(|f| f.pieces.iter().map(|piece| piece_area(&p, f, piece))).sum();
    assert!((filled - p.facets.iter().map(|f| f.area).sum::<f64>()).abs() < 1e-12);
}

// ---- mending ----

#[test]
fn inverted_box_is_turned() {
    let (p, mends) = build(&inverted(cuboid(1.0, 2.0, 3.0))).unwrap();
    assert_eq!(mends, [Mend::Inverted { faces: 6 }]);
    assert_box(&p, Vector3::new(0.5, 1.0, 1.5), [1.0, 2.0, 3.0], 1e-14);
}

#[test]
fn single_flipped_face_is_turned() {
    let mut shape = cuboid(1.0, 2.0, 3.0);
    shape.1[3].reverse();
    let (p, mends) = build(&shape).unwrap();
    assert_eq!(mends, [Mend::Turned { faces: 1, first: 3, of: 6 }]);
    assert_eq!(
        mends[0].to_string(),
        "1 of 6 faces pointed inward and was turned outward (the first is face 3)"
    );
    assert_box(&p, Vector3::new(0.5, 1.0, 1.5), [1.0, 2.0, 3.0], 1e-14);
}

#[test]
fn duplicate_vertices_are_welded() {
    // As an STL file has it: every face with vertices of its own, some off by rounding.
    let (points, faces) = cuboid(1.0, 2.0, 3.0);
    let own: Points = faces
        .iter()
        .flatten()
        .enumerate()
        .map(|(i, &v)| points[v] + Vector3::repeat(1e-8 * (i % 3) as f64))
        .collect();
    let faces: Faces = (0..6).map(|f| (4 * f..4 * f + 4).collect()).collect();
    let (p, mends) = build(&(own, faces)).unwrap();
    let [Mend::Welded { vertices: 16, farthest }] = mends[..] else { panic!("{mends:?}") };
    assert!(farthest > 1e-9 && farthest < 1e-7);
    assert_eq!((p.facets.len(), p.vertices.len()), (6, 8));
    assert!((p.mass_properties().volume - 6.0).abs() < 1e-6);
}

#[test]
fn many_duplicate_vertices_are_welded_alike() {
    // Above the size from which a hash grid is used.
    let (points, faces) = drum(200);
    let own: Points = faces.iter().flatten().map(|&v| points[v]).collect();
    let mut next = 0;
    let separate: Faces = faces
        .iter()
        .map(|f| {
            next += f.len();
            (next - f.len()..next).collect()
        })
        .collect();
    let (p, mends) = build(&(own, separate)).unwrap();
    assert_eq!(mends, [Mend::Welded { vertices: 800, farthest: 0.0 }]);
    assert_eq!(p.facets.len(), 202);
    assert_eq!(p.mass_properties().volume, clean(&(points, faces)).mass_properties().volume);
}

#[test]
fn unused_vertices_do_not_count() {
    let mut shape = cuboid(1.0, 1.0, 1.0);
    shape.0.insert(0, Vector3::repeat(1e6));
    shape.1.iter_mut().flatten().for_each(|v| *v += 1);
    assert_eq!(clean(&shape).vertices.len(), 8);
}

#[test]
fn vertex_in_an_edge_splits_it() {
    // The face x = 1 comes in two parts, whose common corner (1, 1, 0.5) stands in the edges of two
    // whole faces.
    let mut shape = cuboid(1.0, 1.0, 1.0);
    shape.0.extend([Vector3::new(1.0, 0.0, 0.5), Vector3::new(1.0, 1.0, 0.5)]);
    shape.1.splice(5..6, [vec![1, 3, 9, 8], vec![8, 9, 7, 5]]);
    let (p, mends) = build(&shape).unwrap();
    assert!(matches!(mends[..], [Mend::Split { vertices: 2, .. }]), "{mends:?}");
    assert_eq!((p.facets.len(), p.vertices.len(), p.convex), (6, 8, true));
    assert_box(&p, Vector3::repeat(0.5), [1.0; 3], 1e-14);
}

#[test]
fn faces_without_extent_are_dropped() {
    let mut shape = cuboid(1.0, 1.0, 1.0);
    shape.0.push(shape.0[0]);
    shape.1.push(vec![0, 8, 1]);
    let (p, mends) = build(&shape).unwrap();
    assert!(mends.contains(&Mend::Dropped { faces: 1, first: 6 }), "{mends:?}");
    assert_box(&p, Vector3::repeat(0.5), [1.0; 3], 1e-14);
}

// ---- refusals ----

#[test]
fn numbers_that_are_none_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut shape = cuboid(1.0, 1.0, 1.0);
        shape.0[5].y = bad;
        assert_eq!(refused(&shape), ShapeError::NotFinite { vertex: 5 });
    }
    // Finite, but their difference is not.
    let mut shape = cuboid(1.0, 1.0, 1.0);
    (shape.0[0].x, shape.0[1].x) = (-f64::MAX, f64::MAX);
    assert!(matches!(refused(&shape), ShapeError::OutOfRange { .. }));
}

#[test]
fn wrong_indices_are_refused() {
    let mut shape = cuboid(1.0, 1.0, 1.0);
    shape.1[2][1] = 8;
    assert_eq!(refused(&shape), ShapeError::NoSuchVertex { face: 2, index: 8, vertices: 8 });
    shape.1[2] = vec![0, 1, 0, 1];
    assert_eq!(refused(&shape), ShapeError::TooFewCorners { face: 2, distinct: 2 });
    shape.1[2] = vec![];
    assert_eq!(refused(&shape), ShapeError::TooFewCorners { face: 2, distinct: 0 });
    shape.1.clear();
    assert!(matches!(refused(&shape), ShapeError::Count { faces: 0, .. }));
}

#[test]
fn open_box_is_refused() {
    let mut shape = cuboid(1.0, 2.0, 3.0);
    shape.1.remove(1);
    let error = refused(&shape);
    assert!(matches!(error, ShapeError::Open { edges: 4, .. }), "{error}");
    let text = error.to_string();
    assert!(
        text.starts_with(
            "the surface is open: 4 edges have a face on one side only, one of them from ("
        ),
        "{text}"
    );
    // The place is in scene coordinates, on the missing face.
    assert!(text.contains(", 3) to (") && text.ends_with(')'), "{text}");
}

#[test]
fn flat_shapes_are_refused() {
    assert_eq!(
        refused(&cuboid(1.0, 1.0, 0.0)),
        ShapeError::Flat { thickness: 0.0, size: 2f64.sqrt() }
    );
    assert!(matches!(refused(&cuboid(1.0, 1.0, 1e-9)), ShapeError::Flat { .. }));
    assert!(matches!(refused(&cuboid(1.0, 0.0, 0.0)), ShapeError::Flat { .. }));
}

#[test]
fn crossing_bodies_are_refused() {
    // Skew, through each other in an edge of a triangulation, and flush on three sides.
    for low in [[0.3, 0.4, 0.5], [0.5, 0.0, 0.5], [0.5, 0.0, 0.0]] {
        let mut shape = with(cuboid(1.0, 1.0, 1.0), cuboid_at(low, [1.0; 3]));
        assert!(matches!(refused(&shape), ShapeError::Overlap { .. }), "{low:?}");
        shape.1 =
            shape.1.iter().flat_map(|f| [vec![f[0], f[1], f[2]], vec![f[0], f[2], f[3]]]).collect();
        assert!(matches!(refused(&shape), ShapeError::Overlap { .. }), "{low:?}");
    }
}

#[test]
fn faces_that_cut_each_other_are_named() {
    // The inner walls of the U lean so far that they pass through each other.
    let mut shape = prism(&U, 2.0);
    for i in [3, 11] {
        shape.0[i].x = 0.5;
    }
    for i in [6, 14] {
        shape.0[i].x = 2.5;
    }
    // Its ends cross themselves: triangulated by hand, only faces against faces are left.
    assert!(matches!(refused(&shape), ShapeError::CrossedFace { face: 0, .. }));
    let ends = [[0, 1, 4], [1, 2, 3], [1, 3, 4], [0, 4, 5], [0, 5, 6], [0, 6, 7]];
    shape.1.drain(..2);
    shape.1.extend(
        ends.iter().flat_map(|t| [vec![t[2], t[1], t[0]], vec![t[0] + 8, t[1] + 8, t[2] + 8]]),
    );
    let error = refused(&shape);
    assert!(matches!(error, ShapeError::Overlap { .. }), "{error}");
}

#[test]
fn body_inside_a_body_is_refused() {
    let shape = with(cuboid(3.0, 3.0, 3.0), cuboid_at([1.0; 3], [1.0; 3]));
    assert_eq!(refused(&shape), ShapeError::Nested { inner: 6, outer: 0 });
}

#[test]
fn a_face_listed_again_is_taken_once() {
    for again in [vec![4, 5, 7, 6], vec![7, 6, 4, 5], vec![6, 7, 5, 4]] {
        let mut shape = cuboid(1.0, 1.0, 1.0);
        shape.1.push(again);
        let (solid, mends) = build(&shape).unwrap();
        assert_eq!(mends, [Mend::Doubled { faces: 1, first: 6, repeats: 1 }]);
        assert_eq!((solid.facets.len(), solid.mass_properties().volume), (6, 1.0));
    }
}

#[test]
fn inner_wall_is_refused() {
    // Two cells with a wall between: three faces at each edge of the wall.
    let mut shape = with(cuboid(1.0, 1.0, 1.0), cuboid_at([1.0, 0.0, 0.0], [1.0; 3]));
    shape.1.remove(10);
    let error = refused(&shape);
    assert!(matches!(error, ShapeError::Branching { faces: 3, .. }), "{error}");
}

#[test]
fn bow_tie_face_is_refused() {
    let mut shape = cuboid(1.0, 1.0, 1.0);
    shape.1[1].swap(0, 1);
    assert!(matches!(refused(&shape), ShapeError::CrossedFace { face: 1, .. }));
    // Lobes of different size.
    shape.0[4].x -= 0.5;
    let error = refused(&shape);
    assert!(matches!(error, ShapeError::CrossedFace { face: 1, .. }), "{error}");
}

#[test]
fn one_sided_surface_is_refused() {
    // The projective plane with six corners: closed, every edge with two faces, no inside.
    let faces = [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 1],
        [1, 2, 4],
        [2, 3, 5],
        [3, 4, 1],
        [4, 5, 2],
        [5, 1, 3],
    ];
    let points = (0..6)
        .map(|i| Vector3::new((i * i % 5) as f64, (i * 2 % 3) as f64, (i * 3 % 7) as f64))
        .collect();
    let error = refused(&(points, faces.iter().map(|f| f.to_vec()).collect()));
    assert!(matches!(error, ShapeError::OneSided { .. }), "{error}");
}

#[test]
fn surface_wound_twice_is_refused() {
    // The same cube twice, triangulated along different diagonals: every face plane has all corners
    // below it, yet the volume counts twice.
    let (points, quads) = cuboid(1.0, 1.0, 1.0);
    let cut = |f: &Vec<usize>, k: usize| {
        [vec![f[k], f[k + 1], f[k + 2]], vec![f[k], f[k + 2], f[(k + 3) % 4]]]
    };
    let faces: Faces =
        quads.iter().flat_map(|f| cut(f, 0)).chain(quads.iter().flat_map(|f| cut(f, 1))).collect();
    assert!(matches!(refused(&(points, faces)), ShapeError::Overlap { .. }));
}

// ---- invariance ----

/// Cuts polygons into triangles in a random way: repeatedly takes off a corner that is convex and
/// holds no other corner.
fn triangulate(points: &Points, face: &[usize], random: &mut impl FnMut(usize) -> usize) -> Faces {
    let mut rest = face.to_vec();
    let mut triangles = Faces::new();
    let normal: Vector3<f64> = (1..face.len() - 1)
        .map(|i| {
            (points[face[i]] - points[face[0]]).cross(&(points[face[i + 1]] - points[face[0]]))
        })
        .sum::<Vector3<f64>>();
    while rest.len() > 3 {
        let n = rest.len();
        let side = |a: usize, b: usize, c: usize| {
            normal.dot(&(points[b] - points[a]).cross(&(points[c] - points[a])))
        };
        let ears: Vec<usize> = (0..n)
            .filter(|&i| {
                let (a, b, c) = (rest[i], rest[(i + 1) % n], rest[(i + 2) % n]);
                side(a, b, c) > 1e-9
                    && rest.iter().filter(|p| ![a, b, c].contains(p)).all(|&p| {
                        side(a, b, p) < -1e-9 || side(b, c, p) < -1e-9 || side(c, a, p) < -1e-9
                    })
            })
            .collect();
        let i = ears[random(ears.len())];
        triangles.push(vec![rest[i], rest[(i + 1) % n], rest[(i + 2) % n]]);
        rest.remove((i + 1) % n);
    }
    triangles.push(rest);
    triangles
}

fn shapes() -> Vec<(Points, Faces)> {
    let hexagon: Vec<[f64; 2]> =
        (0..6).map(|i| (i as f64 + 0.1).sin_cos()).map(|(s, c)| [c, s]).collect();
    vec![
        cuboid(1.0, 2.0, 3.0),
        prism(&hexagon, 0.7),
        dodecahedron(),
        prism(&U, 0.5),
        prism(&L, 2.0),
        frame(),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn cutting_order_place_and_scale_do_not_matter(
        which in 0usize..6,
        seed in any::<u64>(),
        triangles in any::<bool>(),
        axis in prop::array::uniform3(-1.0f64..1.0),
        angle in 0.0f64..6.3,
        shift in prop::array::uniform3(-1e4f64..1e4),
        exponent in -3.0f64..3.0,
    ) {
        let original = shapes().swap_remove(which);
        let reference = clean(&original);
        let mut state = seed | 1;
        let mut random = |n: usize| {
            // xorshift64*
            state ^= state >> 12;
            state ^= state << 25;
            state ^= state >> 27;
            (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % n
        };
        let scale = 10f64.powf(exponent);
        let turn = Rotation3::from_scaled_axis(Vector3::from(axis).try_normalize(1e-3).unwrap_or(Vector3::z()) * angle);
        let shift = Vector3::from(shift);

        let (points, mut faces) = original;
        if triangles {
            faces = faces.iter().flat_map(|f| triangulate(&points, f, &mut random)).collect();
        }
        let mut order: Vec<usize> = (0..points.len()).collect();
        for i in (1..order.len()).rev() {
            order.swap(i, random(i + 1));
        }
        for i in (1..faces.len()).rev() {
            faces.swap(i, random(i + 1));
        }
        let mut new = vec![Vector3::zeros(); points.len()];
        for (old, &to) in order.iter().enumerate() {
            new[to] = (turn * points[old] + shift) * scale;
        }
        for face in &mut faces {
            let by = random(face.len());
            face.rotate_left(by);
            face.iter_mut().for_each(|v| *v = order[*v]);
        }
        let (p, mends) = Polyhedron::from_faces(new, &faces).unwrap();

        prop_assert_eq!(mends, []);
        prop_assert_eq!(p.convex, reference.convex);
        prop_assert_eq!(p.vertices.len(), reference.vertices.len());
        prop_assert_eq!(p.facets.len(), reference.facets.len());
        let mut areas: Vec<f64> = p.facets.iter().map(|f| f.area / scale.powi(2)).collect();
        let mut expected: Vec<f64> = reference.facets.iter().map(|f| f.area).collect();
        areas.sort_by(f64::total_cmp);
        expected.sort_by(f64::total_cmp);
        for (a, e) in areas.iter().zip(expected) {
            prop_assert!((a / e - 1.0).abs() < 1e-9);
        }
        for f in &p.facets {
            let filled: f64 = f.pieces.iter().map(|piece| piece_area(&p, f, piece)).sum();
            prop_assert!((filled / f.area - 1.0).abs() < 1e-9);
        }
        let (m, r) = (p.mass_properties(), reference.mass_properties());
        prop_assert!((m.volume / scale.powi(3) / r.volume - 1.0).abs() < 1e-9);
        let centroid = (turn * r.centroid + shift) * scale;
        prop_assert!((m.centroid - centroid).norm() < 1e-9 * scale);
        let inertia = turn * r.inertia * turn.inverse();
        prop_assert!((m.inertia / scale.powi(5) - inertia).norm() < 1e-9 * r.inertia.norm());
    }

    #[test]
    fn winding_does_not_matter(which in 0usize..6, seed in any::<u64>()) {
        let mut shape = shapes().swap_remove(which);
        let reference = clean(&shape);
        for (f, face) in shape.1.iter_mut().enumerate().filter(|(f, _)| seed >> (f % 64) & 1 == 1) {
            face.rotate_left(f % 3);
            face.reverse();
        }
        let (p, mends) = build(&shape).unwrap();
        let count = shape.1.len();
        let turned = (0..count).filter(|f| seed >> (f % 64) & 1 == 1).count();
        match mends[..] {
            [] => prop_assert_eq!(turned, 0),
            [Mend::Turned { faces, of, .. }] => prop_assert_eq!((faces, of), (turned, count)),
            [Mend::Inverted { faces }] => prop_assert_eq!((faces, turned), (count, count)),
            _ => prop_assert!(false, "{:?}", mends),
        }
        let (m, r) = (p.mass_properties(), reference.mass_properties());
        prop_assert!((m.volume / r.volume - 1.0).abs() < 1e-13);
        prop_assert!((m.inertia - r.inertia).norm() < 1e-13 * r.inertia.norm());
        // A closed surface has no net area in any direction.
        prop_assert!(p.facets.iter().map(|f| f.normal * f.area).sum::<Vector3<f64>>().norm() < 1e-12);
    }

    #[test]
    fn two_boxes_overlap_where_no_axis_separates_them(
        place in prop::array::uniform3(prop_oneof![(-4i8..5).prop_map(|k| f64::from(k) / 2.0), -2.0f64..2.0]),
        size in prop::array::uniform3(prop_oneof![Just(1.0), Just(2.0), 0.2f64..3.0]),
        turn in prop_oneof![Just([0.0; 3]), Just([0.0, 0.0, std::f64::consts::FRAC_PI_4]), prop::array::uniform3(-3.0f64..3.0)],
        triangles in any::<bool>(),
    ) {
        let turn = Rotation3::from_scaled_axis(Vector3::from(turn));
        let mut other = cuboid_at(size.map(|s| -s / 2.0), size);
        other.0.iter_mut().for_each(|p| *p = turn * *p + Vector3::from(place));
        let fixed = cuboid_at([-0.5, -1.0, -0.5], [1.0, 2.0, 1.0]);
        // Separating axes of two boxes (Gottschalk, Lin & Manocha 1996).
        let axes: Points = (0..3).map(|k| Vector3::ith(k, 1.0)).collect();
        let own: Points = axes.iter().map(|a| turn * a).collect();
        let crossed = axes.iter().flat_map(|a| own.iter().filter_map(|b| a.cross(b).try_normalize(1e-6)));
        let depth = axes.iter().chain(&own).copied().chain(crossed).map(|axis| {
            let span = |points: &Points| points.iter().map(|p| axis.dot(p)).fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
            let ((a, b), (c, d)) = (span(&fixed.0), span(&other.0));
            b.min(d) - a.max(c)
        }).fold(f64::MAX, f64::min);
        let mut shape = with(fixed.clone(), other.clone());
        if triangles {
            shape.1 = shape.1.iter().flat_map(|f| [vec![f[0], f[1], f[2]], vec![f[0], f[2], f[3]]]).collect();
        }
        let result = build(&shape);
        if fixed.0.iter().all(|p| other.0.contains(p)) {
            // The same box twice is one.
            prop_assert!(result.is_ok());
        } else if depth > 1e-3 {
            prop_assert!(result.is_err(), "{} deep", depth);
        } else if depth < -1e-6 {
            prop_assert!(result.is_ok(), "{:?}", result);
        }
    }

    #[test]
    fn rubbish_is_refused_or_mended_but_never_panics(
        points in prop::collection::vec(prop::array::uniform3(prop_oneof![-2i8..3, Just(100i8)]), 0..14),
        faces in prop::collection::vec(prop::collection::vec(0usize..14, 0..7), 0..24),
    ) {
        let points: Points = points.into_iter().map(|p| Vector3::from(p.map(f64::from))).collect();
        let bound = points.len().max(1);
        let faces: Faces = faces.into_iter().map(|f| f.into_iter().map(|v| v % bound).collect()).collect();
        if let Ok((p, _)) = Polyhedron::from_faces(points, &faces) {
            prop_assert!(p.mass_properties().volume > 0.0);
        }
    }

    #[test]
    fn damaged_shapes_never_panic(which in 0usize..6, face in any::<prop::sample::Index>(), corner in any::<prop::sample::Index>(), vertex in any::<prop::sample::Index>(), by in prop::array::uniform3(-2.0f64..2.0)) {
        let mut shape = shapes().swap_remove(which);
        let n = shape.0.len();
        let f = face.index(shape.1.len());
        let c = corner.index(shape.1[f].len());
        shape.1[f][c] = vertex.index(n);
        let _ = build(&shape);
        let mut shape = shapes().swap_remove(which);
        shape.0[vertex.index(n)] += Vector3::from(by);
        if let Ok((p, _)) = build(&shape) {
            prop_assert!(p.mass_properties().volume > 0.0);
        }
    }
}

#[test]
fn real_stones_are_closed_or_said_to_be_open() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/cases/compas/rb3d-stones");
    // Faces wound both ways; one stone has a hole of eight edges.
    for (name, closed) in [
        ("stone_0.ply", false),
        ("stone_1.ply", true),
        ("stone_2.ply", true),
        ("stone_10.ply", true),
    ] {
        match build(&read_ply(&std::fs::read(folder.join(name)).unwrap())) {
            Ok((p, mends)) => {
                assert!(closed && matches!(mends[..], [Mend::Turned { .. }]), "{name}: {mends:?}");
                let (net, total) = p
                    .facets
                    .iter()
                    .fold((Vector3::zeros(), 0.0), |(n, a), f| (n + f.normal * f.area, a + f.area));
                assert!(net.norm() < 1e-9 * total, "{name}: {net}");
            }
            Err(error) => assert!(
                !closed && matches!(error, ShapeError::Open { edges: 8, .. }),
                "{name}: {error}"
            ),
        }
    }
}

/// Binary little-endian PLY with double coordinates and `uchar int` faces, as these files are.
fn read_ply(bytes: &[u8]) -> (Points, Faces) {
    let end = b"end_header\n";
    let mut at = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let header = String::from_utf8_lossy(&bytes[..at]).into_owned();
    let count = |key: &str| -> usize {
        header.lines().find_map(|l| l.strip_prefix(key)).unwrap().trim().parse().unwrap()
    };
    let mut next = |n: usize| {
        at += n;
        &bytes[at - n..at]
    };
    let points = (0..count("element vertex"))
        .map(|_| Vector3::from_fn(|_, _| f64::from_le_bytes(next(8).try_into().unwrap())))
        .collect();
    let faces = (0..count("element face"))
        .map(|_| {
            let corners = next(1)[0];
            (0..corners).map(|_| i32::from_le_bytes(next(4).try_into().unwrap()) as usize).collect()
        })
        .collect();
    (points, faces)
}

#[test]
fn bodies_apart_by_more_than_a_distance_along_a_facet() {
    // Two slabs 0.1 thick that lean by 45°, 0.05 apart: their boxes overlap almost entirely.
    let turn = Rotation3::from_euler_angles(0.0, 0.25 * std::f64::consts::PI, 0.0);
    let slab = |low: f64| {
        let (points, faces) = cuboid_at([0.0, 0.0, low], [1.0, 1.0, 0.1]);
        build(&(points.into_iter().map(|p| turn * p).collect(), faces)).unwrap().0
    };
    let (a, b) = (slab(0.0), slab(0.15));
    for (p, q) in [(&a, &b), (&b, &a)] {
        assert!(p.is_apart_from(q, 0.049) && !p.is_apart_from(q, 0.051));
    }
}
