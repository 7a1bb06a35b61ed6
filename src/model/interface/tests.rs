//! Detection by behaviour: exact answers on small scenes, invariance, and a word on everything left
//! out.

use super::*;
use crate::assembly::{
    Assembly, Block, Gyration, JointLaw, JointRules, Mend, Polyhedron, Solid, Wrench,
};
use base::error::{FindingCode, InputError, JsonPath};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;
use scene::{ContactSpec, Friction};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

type V = Vector3<f64>;

/// A shape on its way into a scene.
#[derive(Clone, Debug)]
enum Shape {
    Mesh(Vec<V>, Vec<Vec<usize>>),
    Ball(V, f64),
}

fn v(x: f64, y: f64, z: f64) -> V {
    V::new(x, y, z)
}

/// A polygon in the x–z plane, counter-clockwise seen from −y, from `y0` to `y1`.
fn prism(polygon: &[(f64, f64)], y0: f64, y1: f64) -> Shape {
    let n = polygon.len();
    let points =
        [y0, y1].iter().flat_map(|&y| polygon.iter().map(move |&(x, z)| v(x, y, z))).collect();
    let mut faces: Vec<Vec<usize>> = vec![(0..n).collect(), (n..2 * n).rev().collect()];
    faces.extend((0..n).map(|i| vec![i, n + i, n + (i + 1) % n, (i + 1) % n]));
    Shape::Mesh(points, faces)
}

fn cuboid(lo: V, hi: V) -> Shape {
    prism(&[(lo.x, lo.z), (hi.x, lo.z), (hi.x, hi.z), (lo.x, hi.z)], lo.y, hi.y)
}

/// The box with one corner at `(x, y, z)` and these lengths.
fn block(x: f64, y: f64, z: f64, dx: f64, dy: f64, dz: f64) -> Shape {
    cuboid(v(x, y, z), v(x + dx, y + dy, z + dz))
}

/// An upright pyramid or drum: the polygon at `z0`, scaled by `top` at `z1`.
fn tower(polygon: &[(f64, f64)], z0: f64, z1: f64, top: f64) -> Shape {
    let n = polygon.len();
    let mut points: Vec<V> = polygon.iter().map(|&(x, y)| v(x, y, z0)).collect();
    let mut faces: Vec<Vec<usize>> = vec![(0..n).rev().collect()];
    if top == 0.0 {
        points.push(v(0.0, 0.0, z1));
        faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n]));
    } else {
        points.extend(polygon.iter().map(|&(x, y)| v(x * top, y * top, z1)));
        faces.push((n..2 * n).collect());
        faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
    }
    Shape::Mesh(points, faces)
}

fn regular(n: usize, radius: f64, turn: f64) -> Vec<(f64, f64)> {
    (0..n)
        .map(|i| (turn + i as f64 / n as f64 * TAU).sin_cos())
        .map(|(s, c)| (radius * c, radius * s))
        .collect()
}

impl Shape {
    fn map(&self, f: impl Fn(V) -> V, scale: f64) -> Self {
        match self {
            Shape::Mesh(points, faces) => {
                Shape::Mesh(points.iter().map(|&p| f(p)).collect(), faces.clone())
            }
            Shape::Ball(center, radius) => Shape::Ball(f(*center), radius * scale),
        }
    }

    fn moved(&self, by: V) -> Self {
        self.map(|p| p + by, 1.0)
    }

    fn turned(&self, axis: V, angle: f64) -> Self {
        self.map(|p| Rotation3::from_scaled_axis(axis.normalize() * angle) * p, 1.0)
    }

    /// Every face fanned from its corner `k`; only for convex faces.
    fn triangulated(&self, k: usize) -> Self {
        let Shape::Mesh(points, faces) = self else { return self.clone() };
        let fan = |f: &Vec<usize>| {
            let n = f.len();
            let f = f.clone();
            (1..n - 1).map(move |i| vec![f[k % n], f[(k + i) % n], f[(k + i + 1) % n]])
        };
        Shape::Mesh(points.clone(), faces.iter().flat_map(fan).collect())
    }

    fn solid(&self) -> (Solid, f64) {
        match self {
            Shape::Mesh(points, faces) => {
                let size = super::body::Bounds::around(points);
                let (polyhedron, mends) =
                    Polyhedron::from_faces(points.clone(), faces).expect("a test shape is closed");
                // Corners of a grain, rounded far from the origin, are never quite plane.
                assert!(mends.iter().all(|m| matches!(m, Mend::Warped { .. })), "{mends:?}");
                (Solid::Polyhedron(polyhedron), (size.hi - size.lo).norm())
            }
            Shape::Ball(center, radius) => {
                (Solid::Sphere { center: *center, radius: *radius }, radius * 12f64.sqrt())
            }
        }
    }
}

fn assembly(shapes: &[Shape]) -> Assembly {
    let blocks: Vec<Block> = shapes
        .iter()
        .enumerate()
        .map(|(i, shape)| {
            let (solid, size) = shape.solid();
            let path = JsonPath::root().key("blocks").index(i);
            Block {
                id: format!("b{i}"),
                path,
                support: false,
                material: None,
                elastic: None,
                mass: 1.0,
                factor: 1.0,
                centroid: V::zeros(),
                gyration: Gyration::new(&Matrix3::identity(), 1.0),
                inertia: Matrix3::identity(),
                solid,
                size,
            }
        })
        .collect();
    let none = vec![Wrench::zero(); blocks.len()];
    let rule = Some(JointLaw::dry(Friction::Coefficient(0.6)));
    Assembly {
        name: String::new(),
        gravity: v(0.0, 0.0, -9.81),
        blocks,
        joints: JointRules { default: rule, by_material: Vec::new(), by_blocks: HashMap::new() },
        dead: none.clone(),
        dead_forces: Vec::new(),
        live_forces: Vec::new(),
        live: none,
        given: Vec::new(),
        members: Vec::new(),
        contact: ContactSpec::default(),
        said: Vec::new(),
        findings: Vec::new(),
    }
}

fn found(shapes: &[Shape]) -> Interfaces {
    let interfaces = detect(&assembly(shapes)).expect("friction is given");
    for i in &interfaces.list {
        let ContactFrame { t1, t2, n } = i.frame;
        assert!(
            (t1.cross(&t2) - n).norm() < 1e-12 && (n.norm() - 1.0).abs() < 1e-12,
            "frame is right-handed"
        );
        if i.points.len() > 2 {
            let newell: V = (0..i.points.len())
                .map(|k| {
                    (i.points[k] - i.points[0])
                        .cross(&(i.points[(k + 1) % i.points.len()] - i.points[0]))
                })
                .sum();
            assert!(
                (newell.normalize() - n).norm() < 1e-5,
                "points run counter-clockwise around n: {newell} {n}"
            );
        }
    }
    interfaces
}

fn only(shapes: &[Shape]) -> Interface {
    let mut found = found(shapes);
    assert_eq!(found.list.len(), 1, "{found:#?}");
    found.list.remove(0)
}

fn near(x: f64, y: f64) -> bool {
    (x - y).abs() <= 1e-9 * y.abs().max(1e-3)
}

fn is_at(p: V, x: f64, y: f64, z: f64) -> bool {
    (p - v(x, y, z)).norm() < 1e-9
}

fn hull_area(i: &Interface) -> f64 {
    (1..i.points.len().saturating_sub(1))
        .map(|k| (i.points[k] - i.points[0]).cross(&(i.points[k + 1] - i.points[0])))
        .sum::<V>()
        .dot(&i.frame.n)
        / 2.0
}

fn says(found: &Interfaces, code: FindingCode) -> Vec<&str> {
    found.findings.iter().filter(|f| f.code == code).map(|f| f.text.as_str()).collect()
}

// --- Face against face ---

#[test]
fn box_on_a_box_offset() {
    let i = only(&[block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), block(0.25, -0.5, 1.0, 1.0, 1.0, 1.0)]);
    assert_eq!((i.a, i.b, i.kind, i.points.len(), i.patches), (0, 1, ContactKind::Face, 4, 1));
    assert!(near(i.area, 0.375) && near(hull_area(&i), 0.375) && i.pieces.is_empty());
    assert_eq!(i.frame.n, v(0.0, 0.0, 1.0));
    assert!(i.gap.abs() < 1e-15 && i.points.iter().all(|p| p.z == 1.0));
}

#[test]
fn normal_points_from_the_first_block_into_the_second() {
    let i = only(&[block(0.0, 0.0, 1.0, 1.0, 1.0, 1.0), block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0)]);
    assert_eq!(i.frame.n, v(0.0, 0.0, -1.0));
}

#[test]
fn identical_faces_keep_their_corners() {
    let i = only(&[block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), block(0.0, 0.0, 1.0, 1.0, 1.0, 1.0)]);
    assert!(near(i.area, 1.0) && i.points.len() == 4);
}

#[test]
fn twelve_sided_drum_uses_all_its_corners() {
    // n/2 · sin(2π/n) = 6 · sin 30° = 3
    let i = only(&[
        block(-2.0, -2.0, -1.0, 4.0, 4.0, 1.0),
        tower(&regular(12, 1.0, 0.1), 0.0, 1.0, 1.0),
    ]);
    assert_eq!(i.points.len(), 12);
    assert!((i.area - 3.0).abs() < 1e-14, "{}", i.area);
}

#[test]
fn rotated_squares_meet_in_an_octagon() {
    let s = 2f64.sqrt();
    let i = only(&[
        tower(&regular(4, s, PI / 4.0), 0.0, 1.0, 1.0),
        tower(&regular(4, s, 0.0), 1.0, 2.0, 1.0),
    ]);
    // Regular octagon of apothem 1: 8 tan(π/8).
    assert_eq!(i.points.len(), 8);
    assert!((i.area - 8.0 * (PI / 8.0).tan()).abs() < 1e-13);
}

fn u_shape() -> Shape {
    prism(
        &[
            (0.0, 0.0),
            (1.0, 0.0),
            (1.0, 2.0),
            (3.0, 2.0),
            (3.0, 0.0),
            (4.0, 0.0),
            (4.0, 3.0),
            (0.0, 3.0),
        ],
        0.0,
        1.0,
    )
}

#[test]
fn two_feet_on_one_bar_are_one_interface_of_two_patches() {
    let i = only(&[block(-1.0, 0.0, -1.0, 6.0, 1.0, 1.0), u_shape()]);
    assert_eq!((i.points.len(), i.patches, i.pieces.len()), (4, 2, 2));
    assert!(near(i.area, 2.0) && near(hull_area(&i), 4.0));
}

#[test]
fn frame_with_a_hole_is_one_patch_smaller_than_its_hull() {
    // A square tube standing on a slab: its foot is a ring.
    let ring = |z: f64, r: f64| [v(-r, -r, z), v(r, -r, z), v(r, r, z), v(-r, r, z)];
    let points = [ring(0.0, 1.0), ring(0.0, 0.5), ring(1.0, 1.0), ring(1.0, 0.5)].concat();
    let mut faces = Vec::new();
    for k in 0..4 {
        let l = (k + 1) % 4;
        faces.push(vec![k, 4 + k, 4 + l, l]);
        faces.push(vec![8 + k, 8 + l, 12 + l, 12 + k]);
        faces.push(vec![k, l, 8 + l, 8 + k]);
        faces.push(vec![4 + k, 12 + k, 12 + l, 4 + l]);
    }
    let i = only(&[block(-2.0, -2.0, -1.0, 4.0, 4.0, 1.0), Shape::Mesh(points, faces)]);
    assert_eq!((i.points.len(), i.patches), (4, 1));
    assert!(near(i.area, 3.0) && near(hull_area(&i), 4.0) && !i.pieces.is_empty());
}

#[test]
fn contact_on_two_planes_is_two_interfaces() {
    let step =
        prism(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)], 0.0, 1.0);
    let found = found(&[step, block(1.0, 0.0, 1.0, 0.5, 1.0, 0.5)]);
    assert_eq!(found.list.len(), 2);
    assert!(found.list.iter().all(|i| near(i.area, 0.5) && i.kind == ContactKind::Face));
    assert!(near(found.list[0].frame.n.dot(&found.list[1].frame.n).abs() + 1.0, 1.0));
}

#[test]
fn triangulation_does_not_matter() {
    let (a, b) = (block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), tower(&regular(5, 0.9, 0.2), 1.0, 2.0, 0.5));
    let plain = only(&[a.clone(), b.clone()]);
    for k in 0..4 {
        let cut = only(&[a.triangulated(k), b.triangulated(k + 1)]);
        assert!(
            near(cut.area, plain.area)
                && cut.points.len() == plain.points.len()
                && cut.pieces.is_empty()
        );
    }
}

#[test]
fn long_slab_carries_all_its_blocks() {
    let mut shapes = vec![block(-50.0, -1.0, -1.0, 100.0, 2.0, 1.0)];
    shapes.extend((0..41).map(|k| block(-50.0 + 2.4 * k as f64, -0.25, 0.0, 0.5, 0.5, 1.0)));
    let found = found(&shapes);
    assert_eq!(found.list.len(), 41);
    assert!(found.list.iter().all(|i| near(i.area, 0.25)));
}

#[test]
fn grain_of_a_micrometre_on_a_kilometre() {
    for at in [v(0.0, 0.0, 0.0), v(1e4, -1e4, 3e3)] {
        let slab = block(-500.0, -500.0, -1000.0, 1000.0, 1000.0, 1000.0)
            .turned(v(1.0, 2.0, 0.5), 0.3)
            .moved(at);
        let grain =
            block(-3e-7, 2e-7, 0.0, 1e-6, 1e-6, 1e-6).turned(v(1.0, 2.0, 0.5), 0.3).moved(at);
        let i = only(&[slab, grain]);
        // Coordinates are rounded at 1e-12 m there: a millionth of the grain.
        assert!((i.area / 1e-12 - 1.0).abs() < 1e-5, "{}", i.area);
        assert_eq!(i.kind, ContactKind::Face);
    }
}

#[test]
fn thin_plate_on_its_edge_is_a_bearing() {
    let i = only(&[block(-2.0, -2.0, -1.0, 4.0, 4.0, 1.0), block(0.0, -0.5, 0.0, 1e-6, 1.0, 1.0)]);
    assert!((i.area - 1e-6).abs() < 1e-13 && i.points.len() == 4);
}

#[test]
fn area_below_the_minimum_is_counted() {
    // Only a corner of each face: compact, and less than 1e-9 × size².
    let mut scene =
        assembly(&[block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), block(0.99, 0.99, 1.0, 1.0, 1.0, 1.0)]);
    scene.contact.min_area = 1e-3;
    let found = detect(&scene).unwrap();
    assert!(found.list.is_empty());
    assert!(
        says(&found, FindingCode::ContactIgnored)[0].contains("1e-4 m²"),
        "{:?}",
        found.findings
    );
}

// --- Gaps, near misses, overlaps ---

/// Unit boxes one on the other with a gap.
fn with_gap(gap: f64) -> Interfaces {
    found(&[block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), block(0.0, 0.0, 1.0 + gap, 1.0, 1.0, 1.0)])
}

#[test]
fn small_gaps_and_overlaps_are_closed_and_told() {
    for gap in [1e-8, 1e-6, -1e-6, 1e-4] {
        let found = with_gap(gap);
        assert_eq!(found.list.len(), 1, "{gap}");
        assert!((found.list[0].gap - gap).abs() < 1e-15);
        assert!((found.list[0].points[0].z - 1.0 - gap / 2.0).abs() < 1e-15, "points lie half-way");
        let told = says(&found, FindingCode::GapClosed);
        assert_eq!(told.len(), 1, "{gap}");
        assert!(told[0].contains(if gap > 0.0 { "1 open gap" } else { "1 overlap" }), "{told:?}");
    }
    assert!(with_gap(1e-9).findings.is_empty(), "rounding is not worth a word");
}

#[test]
fn the_tolerance_is_relative_to_the_smaller_block() {
    let limit = 1e-4 * 3f64.sqrt();
    assert_eq!(with_gap(limit * (1.0 - 1e-6)).list.len(), 1);
    let beyond = with_gap(limit * (1.0 + 1e-6));
    assert!(beyond.list.is_empty());
    assert_eq!(says(&beyond, FindingCode::NearMiss).len(), 1);
}

#[test]
fn near_misses_are_reported_with_the_remedy_that_closes_them() {
    let cube = |z: f64| block(0.0, 0.0, z, 10.0, 10.0, 10.0);
    let shapes = [cube(0.0), cube(10.05)];
    let found = found(&shapes);
    assert!(found.list.is_empty());
    let text = says(&found, FindingCode::NearMiss)[0];
    assert!(
        text.contains("1 pair") && text.contains("b0 and b1") && text.contains("0.05 m"),
        "{text}"
    );
    let remedy: f64 = text.rsplit(' ').next().unwrap().parse().unwrap();
    let mut scene = assembly(&shapes);
    scene.contact.gap = remedy;
    assert_eq!(detect(&scene).unwrap().list.len(), 1);
}

#[test]
fn blocks_that_share_part_of_a_warped_joint_touch() {
    // Between them the saddle z = 0.02 x y; over different parts of it the mean planes differ by
    // 0.005.
    let saddle = |x0: f64, x1: f64, flat: f64, up: bool| {
        let corners = [(x0, 0.0), (x1, 0.0), (x1, 1.0), (x0, 1.0)];
        let joint = corners.iter().map(|&(x, y)| v(x, y, 0.02 * x * y));
        let outer = corners.iter().map(|&(x, y)| v(x, y, flat));
        let points = if up { joint.chain(outer).collect() } else { outer.chain(joint).collect() };
        let mut faces: Vec<Vec<usize>> = vec![vec![3, 2, 1, 0], vec![4, 5, 6, 7]];
        faces.extend((0..4).map(|i| vec![i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i]));
        Shape::Mesh(points, faces)
    };
    let found = found(&[saddle(0.0, 1.0, -1.0, false), saddle(0.5, 1.5, 1.0, true)]);
    assert_eq!(found.list.len(), 1, "{found:?}");
    assert_eq!(found.list[0].kind, ContactKind::Face);
    assert!((found.list[0].area - 0.5).abs() < 1e-3);
    assert!(says(&found, FindingCode::GapClosed)[0].contains("0.005"), "{:?}", found.findings);
}

/// A prism over the unit square from `z0` to `z1`; the corners of its top or bottom are moved up
/// and down by `warp` in turn.
fn hypar(warp: f64, z0: f64, z1: f64, on_top: bool) -> Shape {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let ring = |z: f64, w: f64| {
        corners
            .iter()
            .enumerate()
            .map(move |(i, &(x, y))| v(x, y, z + if i % 2 == 0 { w } else { -w }))
    };
    let (low, high) = if on_top { (0.0, warp) } else { (warp, 0.0) };
    let mut faces: Vec<Vec<usize>> = vec![vec![3, 2, 1, 0], vec![4, 5, 6, 7]];
    faces.extend((0..4).map(|i| vec![i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i]));
    Shape::Mesh(ring(z0, low).chain(ring(z1, high)).collect(), faces)
}

#[test]
fn mean_planes_of_a_warped_joint_may_lean_by_its_twist() {
    // Joints warped by 0.02, of which the upper side is known only to lean by 2°; the warp explains
    // up to 2 × 2 × 0.02 = 4.6°.
    let lower = hypar(0.02, -1.0, 0.0, true);
    let leaning = |warp: f64, degrees: f64| {
        let about = v(0.5, 0.5, 0.0);
        hypar(warp, 0.0, 1.0, false)
            .moved(-about)
            .turned(v(0.0, 1.0, 0.0), degrees.to_radians())
            .moved(about)
    };
    let warped = found(&[lower, leaning(0.02, 2.0)]);
    assert_eq!(
        warped.list.iter().map(|i| i.kind).collect::<Vec<_>>(),
        [ContactKind::Face],
        "{:?}",
        warped.findings
    );
    assert!(warped.list[0].area > 0.99);
    // Plane faces that lean as much do not touch face to face.
    let plane = found(&[
        hypar(0.0, -1.0, 0.0, true),
        leaning(0.0, 2.0).moved(v(0.0, 0.0, 0.5 * 2f64.to_radians().sin())),
    ]);
    assert!(plane.list.iter().all(|i| i.kind == ContactKind::Edge), "{:?}", plane.list);
}

#[test]
fn faces_that_lean_too_far_are_near_misses_with_a_remedy_for_the_angle() {
    // A brick on a foot a twentieth as wide, which leans by 3°: 1.6 mm at its rims, within the
    // reach of near misses.
    let foot = block(0.0, 0.0, 0.0, 0.06, 1.0, 1.0);
    let brick = block(-0.5, 0.0, 0.0, 1.06, 1.0, 1.0)
        .turned(v(0.0, 1.0, 0.0), 3f64.to_radians())
        .moved(v(0.03, 0.0, 1.0));
    let mut scene = assembly(&[foot, brick]);
    let apart = detect(&scene).unwrap();
    assert!(apart.list.iter().all(|i| i.kind != ContactKind::Face));
    let text =
        match (&says(&apart, FindingCode::NearMiss)[..], &says(&apart, FindingCode::Overlap)[..]) {
            ([text], []) | ([], [text]) => text.to_string(),
            _ => panic!("{:?}", apart.findings),
        };
    let after = |words: &str| -> f64 {
        let rest = &text[text.rfind(words).unwrap_or_else(|| panic!("{text}")) + words.len()..];
        rest.split(" to ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap()
    };
    assert!((after("contact.angle_deg from ") - 3.0).abs() <= 0.11, "{text}");
    scene.contact = ContactSpec {
        gap: after("contact.gap from "),
        angle_deg: after("contact.angle_deg from "),
        ..scene.contact
    };
    let joined = detect(&scene).unwrap();
    assert_eq!(
        joined.list.iter().map(|i| i.kind).collect::<Vec<_>>(),
        [ContactKind::Face],
        "{text}"
    );
    // Beyond the reach: a brick set down askew on purpose.
    let askew = block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0).turned(v(0.0, -1.0, 0.0), 3f64.to_radians());
    assert!(
        says(&found(&[block(-2.0, -2.0, -1.0, 4.0, 4.0, 1.0), askew]), FindingCode::NearMiss)
            .is_empty()
    );
}

#[test]
fn the_remedy_for_an_overlap_closes_it() {
    let shapes = [block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), block(0.0, 0.0, 1.0 - 1e-3, 1.0, 1.0, 1.0)];
    let told = found(&shapes);
    let text = says(&told, FindingCode::Overlap)[0];
    let mut scene = assembly(&shapes);
    scene.contact.gap =
        text.rsplit(' ').next().unwrap().parse().unwrap_or_else(|_| panic!("{text}"));
    assert!(scene.contact.gap < 1e-3);
    assert_eq!(detect(&scene).unwrap().list.len(), 1);
    // An overlap as deep as a block is no matter of tolerances.
    let text =
        says(&found(&[shapes[0].clone(), shapes[0].moved(v(0.1, 0.1, 0.1))]), FindingCode::Overlap)
            [0]
        .to_string();
    assert!(text.ends_with("Correct the geometry"), "{text}");
}

#[test]
fn a_second_face_that_nearly_touches_is_told_though_the_first_does() {
    // On the lower step of a stair, 5 mm from its riser.
    let stair =
        prism(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)], 0.0, 1.0);
    let near = found(&[stair.clone(), block(1.005, 0.0, 1.0, 0.5, 1.0, 0.5)]);
    assert_eq!(near.list.len(), 1);
    assert!(says(&near, FindingCode::NearMiss)[0].contains("0.005 m"), "{:?}", near.findings);
    let free = found(&[stair, block(1.1, 0.0, 1.0, 0.5, 1.0, 0.5)]);
    assert!(free.list.len() == 1 && free.findings.is_empty(), "{:?}", free.findings);
}

#[test]
fn blocks_far_apart_are_not_worth_a_word() {
    assert!(with_gap(0.05).list.is_empty() && with_gap(0.05).findings.is_empty());
}

#[test]
fn second_neighbours_across_a_thin_block_are_neither_joined_nor_near_misses() {
    for thickness in [1e-5, 1e-4, 5e-3] {
        let found = found(&[
            block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0),
            block(0.0, 0.0, 1.0, 1.0, 1.0, thickness),
            block(0.0, 0.0, 1.0 + thickness, 1.0, 1.0, 1.0),
        ]);
        let pairs: Vec<_> = found.list.iter().map(|i| (i.a, i.b)).collect();
        assert_eq!(pairs, [(0, 1), (1, 2)], "thickness {thickness}");
        assert!(says(&found, FindingCode::NearMiss).is_empty());
        assert_eq!(says(&found, FindingCode::ContactIgnored).len(), usize::from(thickness < 1e-3));
    }
}

#[test]
fn a_chain_of_thin_blocks_is_joined_link_by_link() {
    let mut shapes = vec![block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0)];
    shapes.extend((0..4).map(|k| block(0.0, 0.0, 1.0 + 2e-5 * k as f64, 1.0, 1.0, 2e-5)));
    shapes.push(block(0.0, 0.0, 1.0 + 8e-5, 1.0, 1.0, 1.0));
    let pairs: Vec<_> = found(&shapes).list.iter().map(|i| (i.a, i.b)).collect();
    assert_eq!(pairs, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)]);
}

#[test]
fn overlaps_are_reported_with_their_depth_and_carry_nothing() {
    let base = block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0);
    let others = [
        (block(0.0, 0.0, 1.0 - 1e-3, 1.0, 1.0, 1.0), "0.001 m"),
        (block(0.3, 0.2, 1.0 - 1e-3, 1.0, 1.0, 1.0), "0.001 m"),
        (block(0.0, 0.0, 0.01, 1.0, 1.0, 1.0), "0.99 m"),
        (block(0.25, 0.25, 0.25, 0.5, 0.5, 0.5), "0.75 m"),
        (Shape::Ball(v(0.5, 0.5, 1.4), 0.5), "0.1 m"),
        (Shape::Ball(v(0.5, 0.5, 0.5), 0.1), "0.6 m"),
        // Two edges crossed, 0.05 into each other.
        (
            prism(&[(-1.0, 0.0), (1.0, 0.0), (0.0, 1.0)], -2.0, 2.0)
                .turned(v(1.0, 0.0, 0.0), PI)
                .turned(v(0.0, 0.0, 1.0), PI / 2.0)
                .moved(v(0.5, 0.5, 1.95)),
            "0.05 m",
        ),
    ];
    for (other, depth) in others {
        let found = found(&[base.clone(), other]);
        assert!(found.list.is_empty(), "{depth}");
        let told = says(&found, FindingCode::Overlap);
        assert!(told.len() == 1 && told[0].contains(depth), "{depth}: {:?}", found.findings);
    }
}

#[test]
fn crossed_ridges_that_overlap_are_told_apart_from_crossed_ridges_that_touch() {
    let roof = prism(&[(-1.0, 0.0), (1.0, 0.0), (0.0, 1.0)], -2.0, 2.0);
    let upside_down = roof.turned(v(1.0, 0.0, 0.0), PI).turned(v(0.0, 0.0, 1.0), PI / 2.0);
    let told = found(&[roof.clone(), upside_down.moved(v(0.0, 0.0, 1.99))]);
    assert!(
        told.list.is_empty() && says(&told, FindingCode::Overlap)[0].contains("0.01 m"),
        "{:?}",
        told.findings
    );
}

#[test]
fn overlaps_of_non_convex_blocks_are_found() {
    let u = u_shape();
    for other in [
        u.moved(v(0.01, 0.0, 0.0)),
        u.moved(v(0.5, 0.0, 0.0)),
        block(0.2, -1.0, 0.2, 0.2, 5.0, 0.2),
        block(1.5, 0.2, 1.5, 1.0, 0.5, 1.0),
    ] {
        let found = found(&[u.clone(), other]);
        assert_eq!(says(&found, FindingCode::Overlap).len(), 1, "{found:?}");
    }
    // In the mouth of the U, touching nothing.
    let free = found(&[u, block(1.5, 0.2, 0.5, 1.0, 0.5, 1.0)]);
    assert!(free.list.is_empty() && free.findings.is_empty(), "{free:?}");
}

#[test]
fn a_block_drawn_twice_is_no_overlap() {
    let base = block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0);
    for again in [base.clone(), base.moved(v(1e-5, 0.0, 0.0))] {
        let found = found(&[base.clone(), again]);
        assert!(says(&found, FindingCode::Overlap).is_empty() && found.left_out.is_none());
        assert_eq!(says(&found, FindingCode::Twice).len(), 1, "{:?}", found.findings);
    }
}

// --- Edges and corners ---

#[test]
fn wedge_standing_on_its_edge() {
    let wedge = prism(&[(0.0, 0.0), (0.5, 1.0), (-0.5, 1.0)], 0.0, 1.0);
    let i = only(&[block(-2.0, 0.25, -1.0, 4.0, 4.0, 1.0), wedge.clone()]);
    assert_eq!((i.kind, i.points.len(), i.area, i.patches), (ContactKind::Edge, 2, 0.0, 1));
    assert!(
        i.points.iter().any(|&p| is_at(p, 0.0, 0.25, 0.0))
            && i.points.iter().any(|&p| is_at(p, 0.0, 1.0, 0.0))
    );
    assert!(is_at(i.frame.n, 0.0, 0.0, 1.0));
    assert_eq!(only(&[wedge, block(-2.0, 0.25, -1.0, 4.0, 4.0, 1.0)]).frame.n, v(0.0, 0.0, -1.0));
}

#[test]
fn edge_over_two_feet_is_one_contact_of_two_patches() {
    // The U upside down, a wedge's edge along both its feet.
    let feet = u_shape().turned(v(1.0, 0.0, 0.0), PI);
    let wedge = prism(&[(0.0, 0.0), (0.5, 1.0), (-0.5, 1.0)], -1.0, 5.0)
        .turned(v(0.0, 0.0, 1.0), -PI / 2.0)
        .moved(v(0.0, -0.5, 0.0));
    let i = only(&[feet, wedge]);
    assert_eq!((i.kind, i.points.len(), i.patches), (ContactKind::Edge, 2, 2));
    assert!(near((i.points[0] - i.points[1]).norm(), 4.0));
}

#[test]
fn cone_on_its_tip() {
    let cone = tower(&regular(7, 0.5, 0.3), 0.0, 1.0, 0.0)
        .turned(v(1.0, 0.0, 0.0), PI)
        .moved(v(0.1, 0.2, 1.0));
    let i = only(&[block(-2.0, -2.0, -1.0, 4.0, 4.0, 1.0), cone]);
    assert_eq!((i.kind, i.points.len()), (ContactKind::Point, 1));
    assert!(is_at(i.points[0], 0.1, 0.2, 0.0) && is_at(i.frame.n, 0.0, 0.0, 1.0));
}

#[test]
fn crossed_ridges_touch_in_a_point() {
    let roof = prism(&[(-1.0, 0.0), (1.0, 0.0), (0.0, 1.0)], -2.0, 2.0);
    let upside_down = roof.turned(v(1.0, 0.0, 0.0), PI).turned(v(0.0, 0.0, 1.0), 1.0);
    let i = only(&[roof, upside_down.moved(v(0.0, 0.0, 2.0))]);
    assert_eq!((i.kind, i.points.len()), (ContactKind::Point, 1));
    assert!(is_at(i.points[0], 0.0, 0.0, 1.0) && is_at(i.frame.n, 0.0, 0.0, 1.0));
}

#[test]
fn flat_foot_and_tip_of_one_block_both_stand() {
    // A foot from x = 0 to 1 and a blade with its edge at x = 3.
    let block_on_both = prism(
        &[
            (0.0, 0.0),
            (1.0, 0.0),
            (1.0, 1.0),
            (2.5, 1.0),
            (3.0, 0.0),
            (3.5, 1.0),
            (4.0, 2.0),
            (0.0, 2.0),
        ],
        0.0,
        1.0,
    );
    let found = found(&[block(-1.0, -1.0, -1.0, 6.0, 3.0, 1.0), block_on_both]);
    let kinds: Vec<_> = found.list.iter().map(|i| (i.kind, i.points.len())).collect();
    assert_eq!(kinds, [(ContactKind::Face, 4), (ContactKind::Edge, 2)]);
}

#[test]
fn tilted_box_stands_on_its_edge_and_the_face_is_a_near_miss() {
    let slab = block(-2.0, -2.0, -1.0, 4.0, 4.0, 1.0);
    let tilted = |degrees: f64| {
        found(&[
            slab.clone(),
            block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0).turned(v(0.0, -1.0, 0.0), degrees.to_radians()),
        ])
    };
    for degrees in [0.5, 5.0, 44.0] {
        let found = tilted(degrees);
        assert_eq!(found.list.len(), 1, "{degrees}: {found:?}");
        assert_eq!((found.list[0].kind, found.list[0].points.len()), (ContactKind::Edge, 2));
        assert!(is_at(found.list[0].frame.n, 0.0, 0.0, 1.0));
        assert_eq!(says(&found, FindingCode::NearMiss).len(), usize::from(degrees < 1.0));
    }
    assert_eq!(tilted(1e-3).list[0].kind, ContactKind::Face);
}

#[test]
fn diagonal_neighbours_are_not_joined() {
    let mut shapes = Vec::new();
    for k in 0..9 {
        shapes.push(block(f64::from(k % 3), 0.0, f64::from(k / 3), 1.0, 0.5, 1.0));
    }
    let found = found(&shapes);
    assert_eq!(found.list.len(), 12);
    assert!(found.list.iter().all(|i| near(i.area, 0.5)));
    let told = says(&found, FindingCode::ContactIgnored);
    assert!(told.len() == 1 && told[0].starts_with("8 pairs"), "{told:?}");
}

#[test]
fn diagonal_neighbours_in_rounded_files_are_not_joined_either() {
    // Coordinates good to 1e-5: the neighbours overlap in a strip of 2e-5, or miss each other by as
    // much.
    for (dx, dz) in [(-1e-5, 0.0), (1e-5, 0.0), (-1e-5, -1e-5), (-1e-5, 1e-5), (1e-5, -1e-5)] {
        let diagonal =
            [block(0.0, 0.0, 0.0, 1.0, 0.5, 1.0), block(1.0 + dx, 0.0, 1.0 + dz, 1.0, 0.5, 1.0)];
        let bond = [
            diagonal[0].clone(),
            diagonal[1].clone(),
            block(1.0, 0.0, 0.0, 1.0, 0.5, 1.0),
            block(0.0, 0.0, 1.0, 1.0, 0.5, 1.0),
        ];
        let found_in_bond = found(&bond);
        assert_eq!(found_in_bond.list.len(), 4, "{dx} {dz}: {:?}", found_in_bond.list);
        assert_eq!(says(&found_in_bond, FindingCode::ContactIgnored).len(), 1, "{dx} {dz}");
        // Alone they stand on each other's edge, and which way they push is open.
        let alone = found(&diagonal);
        assert_eq!(alone.list.len(), 1, "{dx} {dz}: {:?}", alone.list);
        assert_eq!(alone.list[0].ways.len(), 2, "{dx} {dz}: {:?}", alone.list);
    }
}

#[test]
fn edges_and_corners_that_meet_others_lie_across_the_middle_of_their_normals() {
    let roof = prism(&[(-1.0, 0.0), (1.0, 0.0), (0.0, 1.0)], -2.0, 2.0);
    let cone = tower(&regular(7, 0.5, 0.3), 0.0, 1.0, 0.0);
    let flip = |s: &Shape| s.turned(v(1.0, 0.0, 0.0), PI);
    let cube = |at: f64| block(at, at, at, 1.0, 1.0, 1.0);
    let up = v(0.0, 0.0, 1.0);
    let pairs = [
        ([roof.clone(), flip(&roof).moved(v(0.0, 0.0, 2.0))], 2, 2, up),
        ([roof, flip(&cone).moved(v(0.0, 0.0, 2.0))], 1, 2, up),
        ([cube(0.0), cube(1.0)], 1, 3, v(1.0, 1.0, 1.0).normalize()),
    ];
    for (pair, points, ways, n) in pairs {
        let found = found(&pair);
        let [one] = &found.list[..] else { panic!("{:?}", found.list) };
        assert_eq!((one.points.len(), one.ways.len()), (points, ways), "{one:?}");
        assert!((one.frame.n - n).norm() < 1e-9, "{one:?}");
        assert_eq!(says(&found, FindingCode::Flattened).len(), 1, "{:?}", found.findings);
    }
    // Every facet of one corner and every one of the other.
    let both = found(&[cone.clone(), flip(&cone).moved(v(0.0, 0.0, 2.0))]);
    assert!(both.list.len() == 1 && both.list[0].ways.len() >= 7, "{:?}", both.list);
}

#[test]
fn a_foot_in_the_corner_of_slab_and_kerb_stands_on_both() {
    let foot =
        |dx: f64| prism(&[(dx, 0.0), (0.5 + dx, 0.2), (1.2 + dx, 1.2), (0.2 + dx, 0.4)], 0.2, 0.8);
    for dx in [0.0, 1e-6, 1e-5, 1e-4] {
        // A kerb on the slab, and one beside it, whose face goes on below the slab's.
        for (from, kerb) in [
            (-1.0, block(-0.5, 0.0, 0.0, 0.5, 1.0, 0.3)),
            (0.0, block(-0.5, 0.0, -0.5, 0.5, 1.0, 0.8)),
        ] {
            let slab = block(from, 0.0, -0.5, 4.0, 1.0, 0.5);
            let found = found(&[slab, kerb, foot(dx)]);
            let on_foot: Vec<_> = found.list.iter().filter(|f| f.b == 2).collect();
            assert_eq!(on_foot.len(), 2, "{dx}: {:?}", found.list);
            assert!(on_foot.iter().all(|f| f.ways.is_empty() && f.kind == ContactKind::Edge));
            assert!((on_foot[0].frame.n - v(0.0, 0.0, 1.0)).norm() < 1e-9);
            assert!((on_foot[1].frame.n - v(1.0, 0.0, 0.0)).norm() < 1e-9);
        }
    }
}

#[test]
fn edge_with_different_faces_along_it_still_carries() {
    // A ridge whose far side is steep for half its length and shallow for the other half: one side
    // of the ridge is a single long edge, the other two.
    let ridge = Shape::Mesh(
        vec![
            v(0.0, 0.0, 0.0),
            v(0.0, 2.0, 0.0),
            v(-1.0, 0.0, 1.0),
            v(-1.0, 2.0, 1.0),
            v(0.0, 1.0, 0.0),
            v(1.0, 0.0, 1.0),
            v(1.0, 1.0, 1.0),
            v(0.5, 1.0, 1.0),
            v(0.5, 2.0, 1.0),
        ],
        vec![
            vec![0, 2, 3, 1, 4],
            vec![0, 4, 6, 5],
            vec![4, 1, 8, 7],
            vec![4, 7, 6],
            vec![0, 5, 2],
            vec![1, 3, 8],
            vec![2, 5, 6, 7, 8, 3],
        ],
    );
    let i = only(&[block(-2.0, -2.0, -1.0, 4.0, 6.0, 1.0), ridge]);
    assert_eq!((i.kind, i.points.len(), i.patches), (ContactKind::Edge, 2, 1));
    assert!(near((i.points[0] - i.points[1]).norm(), 2.0));
}

// --- Spheres ---

#[test]
fn sphere_on_face_edge_and_corner() {
    let cube = block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0);
    for (center, foot) in [
        (v(0.5, 0.5, 1.5), v(0.5, 0.5, 1.0)),
        (v(1.0 + 0.3, 0.5, 1.0 + 0.4), v(1.0, 0.5, 1.0)),
        (v(1.0 + 1.0 / 6.0, 1.0 + 1.0 / 3.0, 1.0 + 1.0 / 3.0), v(1.0, 1.0, 1.0)),
    ] {
        let i = only(&[Shape::Ball(center, 0.5), cube.clone()]);
        assert_eq!((i.kind, i.points.len(), i.area), (ContactKind::Point, 1, 0.0));
        assert!(
            (i.points[0] - foot).norm() < 1e-12
                && (i.frame.n - (foot - center) / 0.5).norm() < 1e-12
        );
        let turned = only(&[cube.clone(), Shape::Ball(center, 0.5)]);
        assert!((turned.frame.n + i.frame.n).norm() < 1e-12);
    }
}

#[test]
fn sphere_in_the_groove_of_one_block_touches_twice() {
    let groove = prism(&[(-2.0, 0.0), (2.0, 0.0), (2.0, 3.0), (0.0, 1.0), (-2.0, 3.0)], -1.0, 1.0);
    let found = found(&[groove, Shape::Ball(v(0.0, 0.0, 1.0 + 0.5 * 2f64.sqrt()), 0.5)]);
    assert_eq!(found.list.len(), 2);
    let h = 0.5f64.sqrt();
    assert!(
        is_at(found.list[0].frame.n, h, 0.0, h) && is_at(found.list[1].frame.n, -h, 0.0, h),
        "{found:?}"
    );
}

#[test]
fn pile_of_spheres() {
    // Three on the ground, one on top: a regular tetrahedron of touching unit spheres.
    let r = 2.0 / 3f64.sqrt();
    let mut shapes = vec![block(-5.0, -5.0, -1.0, 10.0, 10.0, 1.0)];
    shapes.extend(regular(3, r, 0.4).into_iter().map(|(x, y)| Shape::Ball(v(x, y, 1.0), 1.0)));
    shapes.push(Shape::Ball(v(0.0, 0.0, 1.0 + (8f64 / 3.0).sqrt()), 1.0));
    let found = found(&shapes);
    assert_eq!(found.list.len(), 9);
    assert!(found.list.iter().all(|i| i.kind == ContactKind::Point && i.gap.abs() < 1e-14));
    assert!(found.findings.is_empty());
}

#[test]
fn spheres_nearly_touching_are_reported() {
    let found = found(&[Shape::Ball(v(0.0, 0.0, 0.0), 1.0), Shape::Ball(v(0.0, 0.0, 2.002), 1.0)]);
    assert!(found.list.is_empty());
    assert!(says(&found, FindingCode::NearMiss)[0].contains("0.002 m"));
}

// --- Rules ---

#[test]
fn pairs_of_supports_are_counted_and_left_out() {
    let mut scene = assembly(&[
        block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0),
        block(1.0, 0.0, 0.0, 1.0, 1.0, 1.0),
        block(0.5, 0.0, 1.0, 1.0, 1.0, 1.0),
    ]);
    scene.blocks[0].support = true;
    scene.blocks[1].support = true;
    let found = detect(&scene).unwrap();
    assert_eq!((found.list.len(), found.support_pairs), (2, 1));
}

#[test]
fn touching_pair_without_friction_is_an_error_that_names_both() {
    let mut scene =
        assembly(&[block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), block(0.0, 0.0, 1.0, 1.0, 1.0, 1.0)]);
    scene.joints.default = None;
    let InputError { message, hint, path, .. } = detect(&scene).unwrap_err();
    assert!(
        message.contains("\"b0\"")
            && message.contains("\"b1\"")
            && hint.is_some()
            && path == JsonPath::root()
    );
    scene.joints.by_blocks.insert((0, 1), JointLaw::dry(Friction::Infinite));
    assert_eq!(detect(&scene).unwrap().list[0].law.friction, Friction::Infinite);
}

#[test]
fn interface_given_by_hand_replaces_detection() {
    let mut scene =
        assembly(&[block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), block(0.0, 0.0, 1.0, 1.0, 1.0, 1.0)]);
    scene.given.push(crate::assembly::GivenInterface {
        a: 1,
        b: 0,
        points: vec![v(0.0, 0.0, 1.0), v(0.5, 0.0, 1.0), v(0.5, 0.5, 1.0), v(0.0, 0.5, 1.0)],
        normal: v(0.0, 0.0, -1.0),
        law: JointLaw::dry(Friction::Coefficient(0.1)),
    });
    let found = detect(&scene).unwrap();
    assert_eq!(found.list.len(), 1);
    let i = &found.list[0];
    assert_eq!(
        (i.a, i.b, i.kind, i.law.friction, i.patches),
        (1, 0, ContactKind::Given, Friction::Coefficient(0.1), 1)
    );
    assert!(
        near(i.area, 0.25) && near(hull_area(i), 0.25),
        "turned counter-clockwise around the normal"
    );
}

#[test]
fn nothing_and_one_block_have_no_contacts() {
    assert!(found(&[]).list.is_empty());
    assert!(found(&[block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0)]).list.is_empty());
}

#[test]
fn zero_tolerance_still_joins_what_touches_exactly() {
    let mut scene =
        assembly(&[block(0.0, 0.0, 0.0, 1.0, 1.0, 1.0), block(0.1, 0.1, 1.0, 1.0, 1.0, 1.0)]);
    scene.contact = ContactSpec { gap: 0.0, angle_deg: 0.0, min_area: 0.0 };
    assert_eq!(detect(&scene).unwrap().list.len(), 1);
}

// --- Invariance ---

/// A scene with every kind of contact.
fn mixed() -> Vec<Shape> {
    let u = u_shape().moved(v(0.0, 0.0, 1.0));
    vec![
        block(-6.0, -6.0, 0.0, 14.0, 14.0, 1.0),
        u,
        block(0.5, 0.1, 4.0, 2.0, 0.7, 0.6),
        tower(&regular(12, 0.8, 0.1), 1.0, 2.0, 0.7).moved(v(-2.0, 3.0, 0.0)),
        prism(&[(0.0, 1.0), (0.5, 2.0), (-0.5, 2.0)], -4.0, -2.0).moved(v(5.0, 0.0, 0.0)),
        prism(&[(0.0, 1.0), (0.5, 2.0), (-0.5, 2.0)], -3.0, -1.0).moved(v(-3.0, 0.0, 0.0)),
        Shape::Ball(v(2.0, -3.0, 1.7), 0.7),
        Shape::Ball(v(2.0, -3.0, 2.9), 0.5),
        tower(&regular(5, 0.4, 0.0), 0.0, 1.0, 0.0)
            .turned(v(1.0, 0.0, 0.0), PI)
            .moved(v(-3.0, -4.5, 2.0)),
    ]
}

/// What must not change: kind, number of points, area and patches, per contact, in any order.
fn signature(found: &Interfaces, scale: f64) -> Vec<(u8, usize, usize, i64)> {
    let mut list: Vec<_> = found
        .list
        .iter()
        .map(|i| {
            (
                i.kind as u8,
                i.points.len(),
                i.patches,
                (i.area / (scale * scale) * 1e6).round() as i64,
            )
        })
        .collect();
    list.sort_unstable();
    list
}

fn points(found: &Interfaces) -> Vec<V> {
    found.list.iter().flat_map(|i| i.points.clone()).collect()
}

fn same_points(moved: &[V], original: &[V], tol: f64) -> bool {
    moved.len() == original.len()
        && original.iter().all(|p| moved.iter().any(|q| (p - q).norm() <= tol))
}

#[test]
fn mixed_scene_has_every_kind_of_contact() {
    let found = found(&mixed());
    let count = |k: ContactKind| found.list.iter().filter(|i| i.kind == k).count();
    assert_eq!(
        (count(ContactKind::Face), count(ContactKind::Edge), count(ContactKind::Point)),
        (3, 2, 3),
        "{:#?}",
        found.list
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn contacts_move_with_the_scene(
        axis in (-1.0..1.0, -1.0..1.0, 0.1..1.0), angle in 0.0..TAU,
        shift in (-1e4..1e4, -1e4..1e4, -1e4..1e4), power in -3.0..3.0,
    ) {
        let scale = 10f64.powf(power);
        let turn = Rotation3::from_scaled_axis(v(axis.0, axis.1, axis.2).normalize() * angle);
        let f = |p: V| (turn * p) * scale + v(shift.0, shift.1, shift.2) * scale.min(1.0);
        let original = found(&mixed());
        let moved = found(&mixed().iter().map(|s| s.map(f, scale)).collect::<Vec<_>>());
        prop_assert_eq!(signature(&moved, scale), signature(&original, 1.0));
        let expected: Vec<V> = points(&original).into_iter().map(f).collect();
        prop_assert!(same_points(&points(&moved), &expected, 1e-6 * scale));
    }

    #[test]
    fn order_of_blocks_only_relabels(seed in any::<u64>()) {
        let shapes = mixed();
        let mut order: Vec<usize> = (0..shapes.len()).collect();
        order.sort_by_key(|&k| (k as u64 + 1).wrapping_mul(seed | 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let original = found(&shapes);
        let shuffled = found(&order.iter().map(|&k| shapes[k].clone()).collect::<Vec<_>>());
        prop_assert_eq!(signature(&shuffled, 1.0), signature(&original, 1.0));
        prop_assert!(same_points(&points(&shuffled), &points(&original), 1e-12));
        for i in &shuffled.list {
            let (a, b) = (order[i.a].min(order[i.b]), order[i.a].max(order[i.b]));
            let sign = if order[i.a] == a { 1.0 } else { -1.0 };
            prop_assert!(original.list.iter().any(|j| (j.a, j.b) == (a, b) && (j.frame.n * sign - i.frame.n).norm() < 1e-9));
        }
    }

    #[test]
    fn area_of_two_random_prisms_does_not_depend_on_cutting(
        n in 3usize..9, m in 3usize..9, turn in 0.0..TAU, x in -1.0..1.0, y in -1.0..1.0, k in 0usize..9,
    ) {
        let (a, b) = (tower(&regular(n, 1.0, 0.0), 0.0, 1.0, 0.8), tower(&regular(m, 0.7, turn), 0.0, 1.0, 0.9).moved(v(x, y, -1.0)));
        let (plain, cut) = (found(&[a.clone(), b.clone()]), found(&[b.triangulated(k), a.triangulated(k + 3)]));
        prop_assert_eq!(plain.list.len(), cut.list.len());
        for (i, j) in plain.list.iter().zip(&cut.list) {
            prop_assert!((i.area - j.area).abs() < 1e-8);
            prop_assert_eq!(i.points.len(), j.points.len());
        }
    }
}
