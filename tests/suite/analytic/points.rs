//! Bodies on contact points given by hand.

use crate::ask::*;
use serde_json::{Value, json};
use voussoir::scene::Scene;

fn floor() -> Value {
    fixed(prism("floor", &[[-9.0, -1.0], [9.0, -1.0], [9.0, 0.0], [-9.0, 0.0]]))
}

/// A bar of thickness 0.02 from one point to another.
fn bar(id: &str, [x0, z0]: [f64; 2], [x1, z1]: [f64; 2]) -> Value {
    let length = (x1 - x0).hypot(z1 - z0);
    let (nx, nz) = (0.01 * (z1 - z0) / length, -0.01 * (x1 - x0) / length);
    prism(id, &[[x0 + nx, z0 + nz], [x1 + nx, z1 + nz], [x1 - nx, z1 - nz], [x0 - nx, z0 - nz]])
}

fn contact(a: &str, b: &str, point: [f64; 2], normal: [f64; 2], friction: f64) -> Value {
    let friction = if friction.is_infinite() { json!("infinite") } else { json!(friction) };
    json!({ "between": [a, b], "points": [[point[0], 0.0, point[1]]], "normal": [normal[0], 0.0, normal[1]], "friction": friction })
}

#[test]
fn a_ladder_stands_above_its_critical_inclination() {
    // A18, A19: tan θ = (1 − μf μw) / 2 μf (textbook), here at θ (1 ± 1e-6).
    for (floor_friction, wall_friction, degrees) in [
        (0.5, 0.5, 36.86989764584402),
        (0.35, 0.2, 53.03165609448374),
        (0.6, 0.0, 39.80557109226519),
    ] {
        let ladder = |degrees: f64| -> Scene {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let (x, z) = (4.0 * cos, 4.0 * sin);
            scene(
                0.0,
                json!([
                    floor(),
                    fixed(prism("wall", &[[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 10.0], [x, 10.0]])),
                    bar("ladder", [0.0, 0.0], [x, z])
                ]),
                json!({ "interfaces": [
                    contact("floor", "ladder", [0.0, 0.0], [0.0, 1.0], floor_friction),
                    contact("wall", "ladder", [x, z], [-1.0, 0.0], wall_friction),
                ] }),
            )
        };
        let critical =
            ((1.0 - floor_friction * wall_friction) / (2.0 * floor_friction)).atan().to_degrees();
        assert!((critical - degrees).abs() < 1e-10, "{critical}");
        flips("ladder", ladder, critical * (1.0 + 1e-6), critical * (1.0 - 1e-6));
    }
}

#[test]
fn an_a_frame_needs_friction_at_its_feet() {
    // A20: μ = 1 / (2 tan θ), θ the inclination of the legs, whatever the friction at the ridge.
    for (degrees, ridge) in [(60.0, 0.0), (60.0, 5.0), (45.0, 0.3), (80.0, 0.1_f64)] {
        let frame = |friction: f64| {
            let (sin, cos) = f64::to_radians(degrees).sin_cos();
            let (x, z) = (2.0 * cos, 2.0 * sin);
            scene(
                0.0,
                json!([
                    floor(),
                    bar("left", [-x, 0.0], [0.0, z]),
                    bar("right", [x, 0.0], [0.0, z])
                ]),
                json!({ "interfaces": [
                    contact("floor", "left", [-x, 0.0], [0.0, 1.0], friction),
                    contact("floor", "right", [x, 0.0], [0.0, 1.0], friction),
                    contact("left", "right", [0.0, z], [1.0, 0.0], ridge),
                ] }),
            )
        };
        let critical = 0.5 / f64::to_radians(degrees).tan();
        flips("A-frame", frame, critical + 1e-6, critical - 1e-6);
    }
}

#[test]
fn three_discs_need_both_frictions() {
    // A15, R06: tan 15° = 2 − √3 between the discs, a third of it on the floor (classical
    // three-cylinder problem). Spheres in one plane, mass at their centres, are discs; their
    // contacts are found, and given by hand.
    let s = 3.0_f64.sqrt();
    let pile = |discs: f64, floor: f64, by_hand: bool| {
        let infinite = |mu: f64| if mu.is_infinite() { json!("infinite") } else { json!(mu) };
        let mut more = json!({ "joints": { "default": { "friction": infinite(discs) }, "overrides": [
            { "blocks": ["ground", "d1"], "friction": infinite(floor) }, { "blocks": ["ground", "d2"], "friction": infinite(floor) } ] } });
        if by_hand {
            more["interfaces"] = json!([
                contact("ground", "d1", [-1.0, 0.0], [0.0, 1.0], floor),
                contact("ground", "d2", [1.0, 0.0], [0.0, 1.0], floor),
                contact("d1", "d2", [0.0, 1.0], [1.0, 0.0], discs),
                contact("d1", "d3", [-0.5, 1.0 + s / 2.0], [0.5, s / 2.0], discs),
                contact("d2", "d3", [0.5, 1.0 + s / 2.0], [-0.5, s / 2.0], discs),
            ]);
        }
        let discs = [
            sphere("d1", 1.0, [-1.0, 0.0, 1.0]),
            sphere("d2", 1.0, [1.0, 0.0, 1.0]),
            sphere("d3", 1.0, [0.0, 0.0, 1.0 + s]),
        ];
        scene(0.0, json!([ground(), discs[0], discs[1], discs[2]]), more)
    };
    let (between, below) = (2.0 - s, (2.0 - s) / 3.0);
    assert!(
        (between - 0.2679491924311228).abs() < 1e-14 && (below - 0.08931639747704094).abs() < 1e-14
    );
    for by_hand in [true, false] {
        flips(
            "between discs",
            |mu| pile(mu, f64::INFINITY, by_hand),
            between + 1e-6,
            between - 1e-6,
        );
        flips("on the floor", |mu| pile(f64::INFINITY, mu, by_hand), below + 1e-6, below - 1e-6);
        assert!(stands(&pile(between + 1e-6, below + 1e-6, by_hand)), "both just enough");
        assert!(
            !stands(&pile(between + 1e-6, below - 1e-6, by_hand))
                && !stands(&pile(between - 1e-6, below + 1e-6, by_hand)),
            "both are needed"
        );
    }
}
