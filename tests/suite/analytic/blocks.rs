//! Blocks and columns that slide or topple: λ = min(μ, b / h) with b the half width and h the
//! height of the centre of mass (elementary statics).

use crate::ask::*;
use serde_json::json;

/// A single block of a width and height on the ground, pushed along x.
fn block(width: f64, height: f64, friction: f64) -> voussoir::scene::Scene {
    scene(
        friction,
        json!([ground(), cuboid("block", [width, 1.0, height], [0.0; 3])]),
        push([1.0, 0.0, 0.0]),
    )
}

#[test]
fn a_block_slides_or_topples_whichever_comes_first() {
    // λ = min(μ, width / height). A08, A09, A01, A02, G10, R15's shape; and where both come at
    // once.
    for (width, height, friction) in [
        (0.5, 1.0, 0.3),
        (0.5, 1.0, 0.7),
        (1.0, 1.0, 0.5),
        (0.4, 1.0, 0.8),
        (1.0, 2.0, 1e6),
        (1.0, 2.0, 0.5),
        (1.0, 10.0, 1.0),
        (3.0, 1.0, 0.0),
    ] {
        let want = f64::min(friction, width / height);
        let pushed = block(width, height, friction);
        if want == 0.0 {
            let got = load_factor(&pushed);
            assert!(got.abs() < 1e-9, "{got}");
        } else {
            exact(&format!("{width} × {height}, μ = {friction}"), &pushed, want, 1e-7);
        }
    }
}

#[test]
fn a_block_on_a_tilting_table_falls_at_the_arc_tangent_of_its_load_factor() {
    // A01, A02, R01: θ = atan min(μ, b / h).
    for (width, height, friction, want) in [
        (1.0, 1.0, 0.5, 26.56505117707799),
        (0.4, 1.0, 0.8, 21.80140948635181),
        (1.0, 2.0, 0.3, 16.69924423399362),
    ] {
        close("tilt", tilt_deg(&block(width, height, friction), [1.0, 0.0, 0.0]), want, 1e-7);
    }
}

/// By as much as a slope is steeper or flatter than friction allows, a few thousandths of a degree:
/// there a load factor is next to zero, and so is what its bracket may be wide.
#[test]
fn a_block_next_to_its_angle_of_friction_falls_at_the_difference() {
    for (name, slope) in [("slides", 26.57), ("stands", 26.56)] {
        let root = env!("CARGO_MANIFEST_DIR");
        let path = format!("{root}/structures/block-on-incline-{name}.json");
        let block = open(path.as_ref());
        let want = 0.5_f64.atan().to_degrees() - slope;
        close(name, tilt_deg(&block, [1.0, 0.0, 0.0]), want, 1e-5);
    }
}

#[test]
fn turning_gravity_flips_the_verdict_at_the_tilt() {
    // The same as a verdict: gravity itself turned by θ (1 ∓ 1e-6).
    let turned = |deg: f64| {
        let (sin, cos) = deg.to_radians().sin_cos();
        scene(
            0.8,
            json!([ground(), cuboid("block", [0.4, 1.0, 1.0], [0.0; 3])]),
            json!({ "gravity": [sin, 0.0, -cos] }),
        )
    };
    let critical = 0.4_f64.atan().to_degrees();
    flips("gravity turned", turned, critical * (1.0 - 1e-6), critical * (1.0 + 1e-6));
}

#[test]
fn without_friction_only_the_level_plane_holds() {
    // G09: stands on the level plane, slides at a slope of 1e-6.
    let sloped = |slope: f64| {
        scene(
            0.0,
            json!([ground(), cuboid("block", [1.0; 3], [0.0; 3])]),
            json!({ "gravity": [slope, 0.0, -1.0] }),
        )
    };
    flips("slope", sloped, 0.0, 1e-6);
}

#[test]
fn a_force_topples_about_the_far_edge() {
    // A10: block 1 × 1 × 2 m of 2000 kg/m³, force at 1.5 m: min(μ W, W b / 1.5) = 13080 N.
    let scene = scene(
        0.6,
        json!([ground(), cuboid("block", [1.0, 1.0, 2.0], [0.5, 0.0, 0.0])]),
        json!({
            "gravity": [0, 0, -9.81], "materials": { "unit": { "density": 2000 } },
            "loads": { "live": [{ "block": "block", "force": [1, 0, 0], "at": [0, 0, 1.5] }] }
        }),
    );
    exact("force", &scene, 13080.0, 1e-7);
}

#[test]
fn columns_topple_as_a_whole_or_above_a_joint() {
    // A12: upper block alone 0.5 / 1.2, the whole later.
    let two = json!([
        ground(),
        cuboid("b0", [1.0, 1.0, 0.6], [0.0; 3]),
        cuboid("b1", [0.5, 1.0, 1.2], [0.0, 0.0, 0.6])
    ]);
    exact("two blocks", &scene(0.6, two, push([1.0, 0.0, 0.0])), 0.5 / 1.2, 1e-7);
    // A14, R15, G12: n blocks of height h: width / (n h).
    for (n, height, friction) in [(8, 0.5, 0.4), (10, 1.0, 1.0), (1, 0.5, 3.0), (100, 0.02, 0.7)] {
        let column = template(
            friction,
            json!({ "column": { "blocks": n, "size": [1, 1, height] } }),
            push([1.0, 0.0, 0.0]),
        );
        exact(&format!("{n} blocks"), &column, 1.0 / (f64::from(n) * height), 1e-7);
    }
}

#[test]
fn a_column_slides_at_its_weakest_joint() {
    // A31: the least of the frictions, if it topples later.
    let column = |weakest: [f64; 3]| {
        let between = [["ground", "b0"], ["b0", "b1"], ["b1", "b2"]];
        let overrides: Vec<_> = between
            .iter()
            .zip(weakest)
            .map(|(b, mu)| json!({ "blocks": b, "friction": mu }))
            .collect();
        let blocks: Vec<_> = (0..3)
            .map(|k| cuboid(&format!("b{k}"), [1.0, 1.0, 0.3], [0.0, 0.0, 0.3 * f64::from(k)]))
            .collect();
        let mut more = push([1.0, 0.0, 0.0]);
        more["joints"] = json!({ "default": { "friction": 0 }, "overrides": overrides });
        scene(0.0, json!([ground(), blocks[0], blocks[1], blocks[2]]), more)
    };
    for frictions in [[0.5, 0.25, 0.4], [0.2, 0.25, 0.4], [0.5, 0.45, 0.1]] {
        exact(
            "weakest",
            &column(frictions),
            frictions.into_iter().fold(f64::INFINITY, f64::min),
            1e-7,
        );
    }
}

#[test]
fn the_friction_cone_is_round() {
    // E01: a flat block slides at λ = μ in every direction. (Pyramids of four faces: down to 0.707
    // μ, up to 1.414 μ.)
    for k in 0..16 {
        let (sin, cos) = (22.5 * f64::from(k) + 3.0_f64).to_radians().sin_cos();
        let scene = scene(
            0.5,
            json!([ground(), cuboid("block", [1.0, 1.0, 0.2], [0.0; 3])]),
            push([cos, sin, 0.0]),
        );
        exact(&format!("direction {k}"), &scene, 0.5, 1e-6);
    }
    let scene = scene(
        0.5,
        json!([ground(), cuboid("block", [1.0, 1.0, 0.2], [0.0; 3])]),
        push([22.5_f64.to_radians().cos(), 22.5_f64.to_radians().sin(), 0.0]),
    );
    exact("E01", &scene, 0.5, 1e-6);
}

#[test]
fn oblique_overturning_is_about_the_nearer_edge() {
    // E03, E04 and more directions ψ: λ = min(bx / (h cos ψ), by / (h sin ψ)).
    for psi in [0.0, 10.0, 30.0, 30.963756532073525, 50.0, 75.0, 90.0_f64] {
        let (sin, cos) = psi.to_radians().sin_cos();
        let scene = scene(
            0.9,
            json!([ground(), cuboid("block", [1.0, 0.6, 2.0], [0.0; 3])]),
            push([cos, sin, 0.0]),
        );
        exact(&format!("ψ = {psi}°"), &scene, f64::min(0.5 / cos, 0.3 / sin), 1e-6);
    }
}
