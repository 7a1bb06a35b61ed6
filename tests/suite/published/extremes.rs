//! Tall stacks, ratios over many decades, gaps and overlaps. Values are elementary statics.

use crate::ask::*;
use serde_json::json;
use voussoir::{error::FindingCode, scene::Scene};

const X: [f64; 3] = [1.0, 0.0, 0.0];

#[test]
fn the_harmonic_stack_is_critical_in_every_joint() {
    // A04: overhang ½ (1 + 1/2 + 1/3 + 1/4).
    let stack = |s: f64| {
        template(
            1.0,
            json!({ "stack": { "blocks": 4, "size": [1, 1, 0.2], "harmonic": s } }),
            json!({}),
        )
    };
    flips("A04", stack, 0.999999, 1.000001);
}

#[test]
fn a_leaning_stack_falls_when_its_centre_passes_the_edge() {
    // A06, G13: n blocks of length 1 lean until n × shift exceeds it.
    let stack = |blocks: u32, shift: f64, friction: f64| {
        template(
            friction,
            json!({ "stack": { "blocks": blocks, "size": [1, 1, 0.2], "shift": shift } }),
            json!({}),
        )
    };
    flips("A06", |shift| stack(10, shift, 1.0), 0.0999999, 0.1000001);
    flips("G13", |shift| stack(1000, shift, 0.6), 0.00099999, 0.00100001);
}

#[test]
fn columns_of_a_thousand_blocks() {
    // G12, and blocks 1 × 1 × 0.5: width / height.
    for (height, want) in [(0.05, 0.02), (0.5, 0.002)] {
        let column =
            template(0.5, json!({ "column": { "blocks": 1000, "size": [1, 1, height] } }), push(X));
        exact(&format!("1000 × {height}"), &column, want, 1e-6);
    }
}

#[test]
fn densities_over_nine_decades() {
    // G01 heavy on top, G02 heavy below: λ = (b / 2) Σ m / Σ m z.
    for (case, friction, lower, upper) in [("G01", 0.7, 1.0, 1e9), ("G02", 2.0, 1e9, 1.0)] {
        let [mut b0, mut b1] =
            [cuboid("b0", [1.0; 3], [0.0; 3]), cuboid("b1", [1.0; 3], [0.0, 0.0, 1.0])];
        (b0["density"], b1["density"]) = (json!(lower), json!(upper));
        let want = 0.5 * (lower + upper) / (0.5 * lower + 1.5 * upper);
        exact(case, &scene(friction, json!([ground(), b0, b1]), push(X)), want, 1e-6);
    }
}

#[test]
fn slivers() {
    // G04 on end, G05 lying: aspect ratio 1e5.
    for (case, width, height, want) in [("G04", 0.001, 100.0, 1e-5), ("G05", 100.0, 0.001, 0.5)] {
        let base = fixed(cuboid("base", [400.0, 1.0, 1.0], [0.0, 0.0, -1.0]));
        exact(
            case,
            &scene(0.5, json!([base, cuboid("block", [width, 1.0, height], [0.0; 3])]), push(X)),
            want,
            1e-5,
        );
    }
}

#[test]
fn a_tiny_block_on_a_huge_one_decides() {
    // G07: 1e-6 m on 1000 m, where coordinates are rounded at 1e-7 of the tiny block. The tiny one
    // topples at 0.5; one tolerance for both says 0.8, the friction.
    let base = fixed(prism("base", &[[-5e3, -1e3], [5e3, -1e3], [5e3, 0.0], [-5e3, 0.0]]));
    let huge = prism("huge", &[[-500.0, 0.0], [500.0, 0.0], [500.0, 1000.0], [-500.0, 1000.0]]);
    let tiny = prism(
        "tiny",
        &[[-5e-7, 1000.0], [5e-7, 1000.0], [5e-7, 1000.000002], [-5e-7, 1000.000002]],
    );
    bracketed("G07", &scene(0.8, json!([base, huge, tiny]), push(X)), 0.5, 1e-4, 1e-6);
}

/// G19–G24: three blocks 1 × 0.5, the second lifted by `gap`.
fn gapped(gap: f64) -> Scene {
    let blocks: Vec<_> = (0..3)
        .map(|k| {
            cuboid(
                &format!("b{k}"),
                [1.0, 1.0, 0.5],
                [0.0, 0.0, 0.5 * f64::from(k) + if k > 0 { gap } else { 0.0 }],
            )
        })
        .collect();
    scene(0.5, json!([ground(), blocks[0], blocks[1], blocks[2]]), push(X))
}

#[test]
fn small_gaps_and_overlaps_are_closed_and_told() {
    for (case, gap, tolerance) in
        [("G19", 1e-9, 1e-6), ("G20", 1e-6, 4e-6), ("G21", 1e-4, 4e-4), ("G22", -1e-6, 4e-6)]
    {
        let scene = gapped(gap);
        exact(case, &scene, 0.5, tolerance);
        let told = model(&scene).findings().any(|f| f.code == FindingCode::GapClosed);
        assert_eq!(
            told,
            gap.abs() > 1e-8,
            "{case}: {:?}",
            model(&scene).findings().collect::<Vec<_>>()
        );
    }
}

#[test]
fn wide_gaps_stay_open() {
    // G24: 5 % of a block.
    let scene = gapped(0.05);
    assert!(!stands(&scene));
    let floating: Vec<_> = model(&scene).findings().map(|f| f.text.clone()).collect();
    assert!(floating.iter().any(|m| m.contains("b1")), "{floating:?}");
}

#[test]
fn a_floating_block_falls_and_is_named() {
    // G25.
    let scene = scene(
        0.5,
        json!([
            ground(),
            cuboid("block", [1.0; 3], [0.0; 3]),
            cuboid("float", [1.0; 3], [3.0, 0.0, 2.0])
        ]),
        json!({}),
    );
    assert!(!stands(&scene));
    let model = model(&scene);
    let answer = voussoir::analysis::assess(&model, &Default::default());
    let mechanism = answer.mechanism.as_ref().expect("a mechanism");
    assert_eq!(
        mechanism.moving.iter().map(|&i| model.assembly.blocks[i].id.as_str()).collect::<Vec<_>>(),
        ["float"]
    );
}
