//! What one interface, or two that face each other, can carry.

use crate::ask::*;
use serde_json::json;
use voussoir::analysis::Outcome;

#[test]
fn torsion_of_a_rectangle_is_carried_at_its_corners() {
    // E11: with forces at the corners every one has its arm d / 2 to the centre, so the torque is μ
    // W d / 2, d the diagonal (corner model of Livesley 1978; uniform pressure would give 1 / 1.848
    // of it for the square).
    for (a, b, friction) in [(1.0, 1.0, 0.6), (2.0, 1.0, 0.3), (5.0, 0.5, 1.2_f64)] {
        let load = json!({ "loads": { "live": [{ "block": "block", "moment": [0, 0, 1] }] } });
        let weight = a * b;
        let twisted =
            scene(friction, json!([ground(), cuboid("block", [a, b, 1.0], [0.0; 3])]), load);
        exact(&format!("{a} × {b}"), &twisted, friction * weight * a.hypot(b) / 2.0, 1e-6);
    }
}

#[test]
fn a_table_on_three_points_tips_about_their_nearest_side() {
    // E13: λ = W d(centre) / d(load) with the distances to the line that the load lies beyond; no
    // limit inside the triangle.
    let feet = [[-0.8, -0.8], [0.8, -0.8], [0.0, 0.8_f64]];
    let table = |x: f64, y: f64| {
        let points: Vec<_> = feet.iter().map(|f| [f[0], f[1], 0.0]).collect();
        scene(
            0.5,
            json!([ground(), cuboid("plate", [2.0, 2.0, 0.1], [0.0; 3])]),
            json!({
                "interfaces": [{ "between": ["ground", "plate"], "points": points, "normal": [0, 0, 1] }],
                "loads": { "live": [{ "block": "plate", "force": [0, 0, -1], "at": [x, y, 0.1] }] }
            }),
        )
    };
    // Positive inside, for the feet run counter-clockwise.
    let inside = |k: usize, p: [f64; 2]| {
        let (a, b) = (feet[k], feet[(k + 1) % 3]);
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    };
    for p in [[0.8, 0.5], [-0.8, 0.5], [0.1, -1.0], [0.95, -0.5], [0.0, 0.95]] {
        let want = (0..3)
            .filter(|&k| inside(k, p) < 0.0)
            .map(|k| 0.4 * inside(k, [0.0, 0.0]) / -inside(k, p))
            .fold(f64::INFINITY, f64::min);
        exact(&format!("load at {p:?}"), &table(p[0], p[1]), want, 1e-6);
    }
    exact("E13", &table(0.8, 0.5), 0.2461538461538462, 1e-6);
    assert_eq!(outcome(&table(0.1, -0.1)).0, Outcome::Unbounded);
}

#[test]
fn a_bar_between_two_posts_is_admissible_with_any_friction() {
    // A22 (Kao et al., CAD 146, 2022, model H): clamping forces W / 2μ balance it. A true block
    // falls; that is another law.
    let posts = |friction: f64| {
        scene(
            friction,
            json!([
                fixed(prism("left", &[[-1.1, -1.0], [-0.9, -1.0], [-0.9, 1.4], [-1.1, 1.4]])),
                fixed(prism("right", &[[0.9, -1.0], [1.1, -1.0], [1.1, 1.4], [0.9, 1.4]])),
                prism("bar", &[[-0.9, -0.2], [0.9, -0.2], [0.9, 0.6], [-0.9, 0.6]]),
            ]),
            json!({}),
        )
    };
    for friction in [0.05, 0.5, 0.84, 1.4] {
        assert!(stands(&posts(friction)), "μ = {friction}");
    }
    assert!(!stands(&posts(0.0)), "without friction nothing carries");
}

#[test]
fn posts_that_lean_inwards_hold_from_the_tangent_of_their_lean() {
    // A23 (Kao et al. 2022, model A): the contact force must point upwards, μ ≥ tan 30°. Just
    // above, forces grow like 1 / (μ − μc).
    let posts = |friction: f64| {
        let t = 30.0_f64.to_radians().tan();
        // Faces x = ∓(c − z tan 30°) through the bar's sides.
        let x = |z: f64| 1.0392304845413263 - t * z;
        scene(
            friction,
            json!([
                fixed(prism(
                    "left",
                    &[
                        [-x(-1.05), -1.05],
                        [-x(1.45), 1.45],
                        [-x(1.45) - 0.25, 1.45],
                        [-x(-1.05) - 0.25, -1.05]
                    ]
                )),
                fixed(prism(
                    "right",
                    &[
                        [x(-1.05), -1.05],
                        [x(-1.05) + 0.25, -1.05],
                        [x(1.45) + 0.25, 1.45],
                        [x(1.45), 1.45]
                    ]
                )),
                prism("bar", &[[-x(-0.2), -0.2], [x(-0.2), -0.2], [x(0.6), 0.6], [-x(0.6), 0.6]]),
            ]),
            json!({}),
        )
    };
    let critical = 30.0_f64.to_radians().tan();
    flips("A23", posts, critical + 1e-4, critical - 1e-4);
    assert!(stands(&posts(0.84)));
}

#[test]
fn a_keystone_needs_no_friction() {
    // A25: wider at the top, between faces 20° from the vertical.
    let t = 20.0_f64.to_radians().tan();
    for friction in [0.0, 0.3, 1e6] {
        let keystone = scene(
            friction,
            json!([
                fixed(prism(
                    "left",
                    &[[-1.5, 0.0], [-1.5 + t, -1.0], [-1.0 + t, -1.0], [-1.0, 0.0]]
                )),
                fixed(prism("right", &[[1.0 - t, -1.0], [1.5 - t, -1.0], [1.5, 0.0], [1.0, 0.0]])),
                prism(
                    "bar",
                    &[
                        [-1.0 + 0.8 * t, -0.8],
                        [1.0 - 0.8 * t, -0.8],
                        [1.0 - 0.2 * t, -0.2],
                        [-1.0 + 0.2 * t, -0.2]
                    ]
                ),
            ]),
            json!({}),
        );
        assert!(stands(&keystone), "μ = {friction}");
    }
}

#[test]
fn a_tight_roof_leaves_no_limit() {
    // A26 (class of Drucker 1954): associative sliding would lift the block, the roof forbids it,
    // any clamping force is admissible.
    let slot = |roof: bool| {
        let mut blocks = vec![
            fixed(prism("floor", &[[-5.0, -1.0], [5.0, -1.0], [5.0, 0.0], [-5.0, 0.0]])),
            prism("block", &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]),
        ];
        if roof {
            blocks.push(fixed(prism("roof", &[[-5.0, 1.0], [5.0, 1.0], [5.0, 2.0], [-5.0, 2.0]])));
        }
        scene(0.4, json!(blocks), push([1.0, 0.0, 0.0]))
    };
    assert_eq!(outcome(&slot(true)).0, Outcome::Unbounded);
    exact("without the roof", &slot(false), 0.4, 1e-6);
}
