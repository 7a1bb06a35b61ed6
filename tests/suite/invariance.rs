//! Answers do not depend on units, density, place, direction, order or the triangulation of faces;
//! nor on what is left out.

use crate::ask::{push, scene, sphere, template};
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;
use serde_json::json;
use voussoir::{
    analysis::{Control, Outcome, assess, limit},
    generate,
    interface::prepare,
    scene::{BlockSpec, Scene, Shape},
    verdict::Verdict,
};

type V = Vector3<f64>;

/// Critical thickness over radius of the semicircular arch of 16 straight-chord voussoirs
/// (five-hinge closed form).
const CRITICAL: f64 = 0.10707620314306167;

fn arch(thickness: f64, mu: f64) -> Scene {
    template(
        mu,
        json!({ "arch": { "radius": 1.0, "thickness": thickness, "depth": 1.0, "voussoirs": 16 } }),
        push([1.0, 0.0, 0.0]),
    )
}

/// Scenes that show every kind of geometry.
fn scenes() -> Vec<(&'static str, Scene)> {
    let live = || push([1.0, 0.0, 0.0]);
    let box_ = |x: f64, z: f64| json!({ "id": format!("p{x}{z}"), "shape": { "box": { "size": [1, 1, 1] } }, "at": [x, 0, z], "support": true });
    vec![
        ("arch that stands", arch(CRITICAL * 1.001, 0.8)),
        ("arch that falls", arch(CRITICAL * 0.999, 0.8)),
        (
            "wall with an opening",
            template(
                0.6,
                json!({ "wall": { "size": [1, 0.5, 0.4], "courses": 6, "blocks": 6, "base": "course", "openings": [{ "x": 2.5, "z": 0.8, "width": 1.0, "height": 0.8 }] } }),
                live(),
            ),
        ),
        (
            "flat arch",
            template(
                0.6,
                json!({ "flat_arch": { "span": 3.0, "height": 0.6, "depth": 0.5, "voussoirs": 5, "center_depth": 2.0 } }),
                live(),
            ),
        ),
        (
            "dome",
            template(
                0.7,
                json!({ "dome": { "radius": 2.0, "thickness": 0.3, "rings": 3, "segments": 8 } }),
                live(),
            ),
        ),
        (
            "leaning stack",
            template(
                0.6,
                json!({ "stack": { "blocks": 6, "size": [1, 1, 0.2], "shift": 0.1 } }),
                live(),
            ),
        ),
        (
            "spheres",
            scene(
                0.5,
                json!([
                    sphere("a", 1.0, [-1.0, 0.0, 1.0]), sphere("b", 1.0, [1.0, 0.0, 1.0]), sphere("c", 1.0, [0.0, 0.0, 1.0 + 3f64.sqrt()]),
                    { "id": "floor", "shape": { "box": { "size": [20, 20, 1] } }, "at": [0, 0, -0.5], "support": true },
                ]),
                live(),
            ),
        ),
        (
            "U on a bar",
            scene(
                0.5,
                json!([
                    { "id": "bar", "shape": { "box": { "size": [6, 1, 1] } }, "at": [0, 0, -0.5], "support": true },
                    { "id": "u", "shape": { "prism": { "polygon": [[-1.5, 0], [-0.5, 0], [-0.5, 1], [0.5, 1], [0.5, 0], [1.5, 0], [1.5, 2], [-1.5, 2]], "depth": 1.0 } } },
                ]),
                live(),
            ),
        ),
        (
            "lintel",
            scene(
                0.5,
                json!([box_(-1.0, 0.0), box_(1.0, 0.0), { "id": "lintel", "shape": { "box": { "size": [3, 1, 0.4] } }, "at": [0, 0, 0.7] }]),
                live(),
            ),
        ),
    ]
}

/// Every block as a polyhedron in scene coordinates; spheres stay.
fn explicit(scene: &Scene) -> Scene {
    let mut out = scene.clone();
    for t in std::mem::take(&mut out.templates) {
        out.blocks.extend(generate::expand(&t).unwrap());
    }
    out
}

/// The corners and faces of a block in scene coordinates.
fn faces(b: &BlockSpec) -> Option<(Vec<V>, Vec<Vec<usize>>)> {
    let quad = |n: usize| -> Vec<Vec<usize>> {
        let mut f = vec![(0..n).collect::<Vec<_>>(), (n..2 * n).rev().collect()];
        f.extend((0..n).map(|i| vec![i, i + n, (i + 1) % n + n, (i + 1) % n]));
        f
    };
    let (points, faces): (Vec<V>, _) = match &b.shape {
        Shape::Sphere { .. } | Shape::Clump { .. } | Shape::Plane { .. } => return None,
        Shape::Cuboid { size } => {
            let c = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
            let at = |k: usize, y: f64| V::new(c[k][0] * size[0], y * size[1], c[k][1] * size[2]);
            ((0..8).map(|k| at(k % 4, if k < 4 { -0.5 } else { 0.5 })).collect(), quad(4))
        }
        Shape::Prism { polygon, depth } => {
            let n = polygon.len();
            (
                (0..2 * n)
                    .map(|k| {
                        V::new(
                            polygon[k % n][0],
                            if k < n { -0.5 * depth } else { 0.5 * depth },
                            polygon[k % n][1],
                        )
                    })
                    .collect(),
                quad(n),
            )
        }
        Shape::Polyhedron { vertices, faces } => {
            (vertices.iter().map(|&v| v.into()).collect(), faces.clone())
        }
        Shape::Mesh { scale, vertices, faces, .. } => {
            (vertices.iter().map(|&v| V::from(v) * *scale).collect(), faces.clone())
        }
    };
    let turn = b.rotation_deg.as_ref().map_or(Rotation3::identity(), |r| {
        Rotation3::new(V::from(r.axis).normalize() * r.angle.to_radians())
    });
    Some((points.iter().map(|p| turn * p + V::from(b.at)).collect(), faces))
}

/// Scale, rotate, move, reorder, triangulate, change density.
#[derive(Clone, Debug)]
struct Change {
    scale: f64,
    axis: [f64; 3],
    shift: [f64; 3],
    density: f64,
    order: usize,
    triangulate: bool,
}

fn changed(scene: &Scene, c: &Change) -> Scene {
    let turn = Rotation3::new(V::from(c.axis));
    let place = |p: V| -> [f64; 3] { (turn * (p * c.scale) + V::from(c.shift)).into() };
    let along = |v: [f64; 3]| -> [f64; 3] { (turn * V::from(v)).into() };
    let mut out = explicit(scene);
    for b in &mut out.blocks {
        b.density = Some(c.density * b.density.unwrap_or(1.0));
        b.material = None;
        match faces(b) {
            None => {
                if let Shape::Sphere { radius } = &mut b.shape {
                    *radius *= c.scale;
                }
                b.at = place(V::from(b.at));
            }
            Some((points, faces)) => {
                let convex_enough = |f: &Vec<usize>| f.len() == 4;
                let faces = faces
                    .into_iter()
                    .enumerate()
                    .flat_map(|(k, f)| {
                        if c.triangulate && convex_enough(&f) {
                            let s = (k + c.order) % 4;
                            let at = |i: usize| f[(s + i) % 4];
                            vec![vec![at(0), at(1), at(2)], vec![at(0), at(2), at(3)]]
                        } else {
                            vec![f]
                        }
                    })
                    .collect();
                b.shape = Shape::Polyhedron {
                    vertices: points.iter().map(|p| place(*p)).collect(),
                    faces,
                };
                (b.at, b.rotation_deg) = ([0.0; 3], None);
            }
        }
    }
    let n = out.blocks.len();
    out.blocks.rotate_left(c.order % n);
    if c.order % 2 == 1 {
        out.blocks.reverse();
    }
    out.gravity = along(out.gravity);
    for l in &mut out.loads.live {
        l.weight = l.weight.map(along);
    }
    out
}

#[derive(Debug, PartialEq)]
struct Answers {
    verdict: Verdict,
    outcome: Outcome,
    value: f64,
    interfaces: usize,
    area: f64,
}

fn answers(scene: &Scene, keep_all: bool) -> Answers {
    let m = prepare(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let control = Control { keep_all, ..Control::default() };
    let (a, l) = (assess(&m, &control), limit(&m, &control));
    Answers {
        verdict: a.verdict,
        outcome: l.outcome,
        value: l.value.unwrap_or(f64::NAN),
        interfaces: m.interfaces.list.len(),
        area: m.interfaces.list.iter().map(|f| f.area).sum(),
    }
}

fn same(name: &str, a: &Answers, b: &Answers, scale: f64) {
    assert_eq!(
        (a.verdict, a.outcome, a.interfaces),
        (b.verdict, b.outcome, b.interfaces),
        "{name}"
    );
    let near = |x: f64, y: f64, tol: f64| {
        x == y || (x.is_nan() && y.is_nan()) || (x - y).abs() <= tol * x.abs().max(1e-3)
    };
    assert!(near(a.value, b.value, 1e-6), "{name}: load factor {} and {}", a.value, b.value);
    assert!(
        near(a.area * scale * scale, b.area, 1e-6),
        "{name}: area {} and {}",
        a.area * scale * scale,
        b.area
    );
}

#[test]
fn what_is_left_out_changes_no_answer() {
    for (name, s) in scenes() {
        let (reduced, full) = (answers(&s, false), answers(&s, true));
        same(name, &reduced, &full, 1.0);
        assert_ne!(reduced.verdict, Verdict::Undecided, "{name}");
    }
}

fn change() -> impl Strategy<Value = Change> {
    (
        prop_oneof![Just(1.0), Just(1e-3), Just(1e3)],
        proptest::array::uniform3(-3.0..3.0f64),
        prop_oneof![Just([0.0; 3]), Just([1e4, -1e4, 1e4])],
        prop_oneof![Just(1.0), Just(1e-3), Just(1e6)],
        0usize..40,
        any::<bool>(),
    )
        // A move by 1e4 counts in sizes of the scene: it is scaled with it.
        .prop_map(|(scale, axis, shift, density, order, triangulate)| Change {
            scale,
            axis,
            shift: shift.map(|s| s * scale),
            density,
            order,
            triangulate,
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn answers_stay_when_the_scene_is_written_otherwise(which in 0usize..9, c in change()) {
        let (name, s) = scenes().swap_remove(which);
        let (before, after) = (answers(&s, false), answers(&changed(&s, &c), false));
        same(&format!("{name} under {c:?}"), &before, &after, c.scale);
    }

    /// Even within 1e-6 of the critical thickness.
    #[test]
    fn verdicts_stay_close_to_the_limit(stands in any::<bool>(), c in change()) {
        let s = arch(CRITICAL * if stands { 1.0 + 1e-6 } else { 1.0 - 1e-6 }, 0.8);
        let m = prepare(&changed(&s, &c)).unwrap();
        let a = assess(&m, &Control::default());
        prop_assert_eq!(a.verdict, if stands { Verdict::Stable } else { Verdict::Unstable }, "{:?} {:?}", a.equilibrium_error, a.threshold);
    }
}
