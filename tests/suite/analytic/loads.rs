//! Load factors of every kind, and loads and masses given by hand.

use crate::ask::*;
use serde_json::json;
use voussoir::{analysis::Outcome, scene::Scene};

/// A flat block on a plane inclined by `degrees` towards +x.
fn incline(degrees: f64, friction: f64, more: serde_json::Value) -> Scene {
    let turn = json!({ "axis": [0, 1, 0], "angle": degrees });
    let mut plane = fixed(json!({ "id": "plane", "shape": { "box": { "size": [40, 40, 1] } } }));
    plane["rotation_deg"] = turn.clone();
    let (sin, cos) = degrees.to_radians().sin_cos();
    plane["at"] = json!([-0.5 * sin, 0.0, -0.5 * cos]);
    let block = json!({ "id": "block", "shape": { "box": { "size": [1, 1, 0.1] } }, "rotation_deg": turn, "at": [0.05 * sin, 0.0, 0.05 * cos] });
    scene(friction, json!([plane, block]), more)
}

#[test]
fn a_load_factor_may_be_negative() {
    // Steeper than its friction angle φ, the block stands only if pushed uphill: λ = tan(φ − θ) at
    // most.
    for (degrees, friction) in [(35.0, 0.5), (27.0, 0.5), (60.0, 0.2_f64)] {
        let pushed = incline(degrees, friction, push([1.0, 0.0, 0.0]));
        let want = (friction.atan() - f64::to_radians(degrees)).tan();
        assert!(want < 0.0 && !stands(&incline(degrees, friction, json!({}))));
        exact(&format!("{degrees}°"), &pushed, want, 1e-6);
    }
}

#[test]
fn a_block_on_an_incline_stands_up_to_the_friction_angle() {
    for friction in [0.1, 0.5, 1.0_f64] {
        let critical = friction.atan().to_degrees();
        flips(
            "incline",
            |degrees| incline(degrees, friction, json!({})),
            critical * (1.0 - 1e-6),
            critical * (1.0 + 1e-6),
        );
    }
}

#[test]
fn a_load_that_presses_the_block_down_has_no_limit() {
    for force in [[0.0, 0.0, -1.0], [0.4, 0.0, -1.0], [0.0, 1e-3, -1.0]] {
        let load = json!({ "loads": { "live": [{ "block": "block", "force": force }] } });
        let pressed =
            scene(0.5, json!([ground(), cuboid("block", [1.0, 1.0, 0.5], [0.0; 3])]), load);
        assert_eq!(outcome(&pressed).0, Outcome::Unbounded, "{force:?}");
    }
    // Outside the friction cone it has one: λ (f_x − μ f_z) = μ W.
    let load = json!({ "loads": { "live": [{ "block": "block", "force": [0.6, 0, -1] }] } });
    let pushed = scene(0.5, json!([ground(), cuboid("block", [2.0, 2.0, 0.5], [0.0; 3])]), load);
    exact("outside", &pushed, 0.5 * 2.0 / (0.6 - 0.5), 1e-6);
}

#[test]
fn no_multiple_of_a_load_may_help() {
    // Without friction nothing along the normal holds a block on an incline; with too little,
    // nothing across the slope does.
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    assert_eq!(outcome(&incline(30.0, 0.0, push([-sin, 0.0, -cos]))).0, Outcome::Impossible);
    assert_eq!(outcome(&incline(30.0, 0.5, push([0.0, 1.0, 0.0]))).0, Outcome::Impossible);
    // Pressed against the plane, friction does hold it: there is a least multiple, and no greatest.
    assert_eq!(outcome(&incline(30.0, 0.5, push([-sin, 0.0, -cos]))).0, Outcome::Unbounded);
    // A block over the edge of a table falls whatever its neighbour carries.
    let blocks = json!([
        ground(),
        cuboid("table", [1.0, 1.0, 1.0], [0.0; 3]),
        cuboid("over", [1.0, 1.0, 0.2], [0.51, 0.0, 1.0])
    ]);
    let load = json!({ "loads": { "live": [{ "block": "table", "force": [1, 0, 0] }] } });
    assert_eq!(outcome(&scene(0.5, blocks, load)).0, Outcome::Impossible);
}

#[test]
fn the_load_factor_does_not_depend_on_how_the_load_is_written() {
    // The same push as weight, acceleration and force at the centroid; λ is inversely proportional
    // to the unit load.
    let pushed = |live: serde_json::Value| {
        let more = json!({ "gravity": [0, 0, -9.81], "loads": { "live": [live] } });
        scene(0.9, json!([ground(), cuboid("block", [1.0, 1.0, 2.0], [0.0; 3])]), more)
    };
    exact("weight", &pushed(json!({ "weight": [1, 0, 0] })), 0.5, 1e-7);
    exact("half the weight", &pushed(json!({ "weight": [0.5, 0, 0] })), 1.0, 1e-7);
    exact("acceleration", &pushed(json!({ "acceleration": [2, 0, 0] })), 0.5 * 9.81 / 2.0, 1e-7);
    exact(
        "force",
        &pushed(json!({ "block": "block", "force": [1, 0, 0] })),
        0.5 * 2.0 * 9.81,
        1e-7,
    );
    // A couple M with axis y overturns at W b / 2.
    exact(
        "couple",
        &pushed(json!({ "block": "block", "moment": [0, 3, 0] })),
        2.0 * 9.81 * 0.5 / 3.0,
        1e-7,
    );
}

#[test]
fn dead_loads_count_as_weight() {
    // A dead force P on top moves the toppling limit of a push on the block's own weight W: λ = (W + P) (b / 2) / (W h / 2).
    let loaded = |p: f64, at: f64| {
        scene(
            5.0,
            json!([ground(), cuboid("block", [1.0, 1.0, 2.0], [0.0; 3])]),
            json!({ "loads": { "dead": [{ "block": "block", "force": [0, 0, -p], "at": [at, 0, 2] }], "live": [{ "weight": [1, 0, 0] }] } }),
        )
    };
    let want = |p: f64, at: f64| (2.0 * 0.5 + p * (0.5 - at)) / 2.0;
    for (p, at) in [(1e-3, 0.0), (3.0, 0.0), (3.0, 0.25), (3.0, -0.5), (-1.5, 0.1)] {
        exact(&format!("P = {p} at {at}"), &loaded(p, at), want(p, at), 1e-7);
    }
}

#[test]
fn a_hanging_load_turns_with_gravity() {
    // W at half height, P hung at (x, z): moments about the edge b / 2 vanish at tan θ = (W b / 2 +
    // P (b / 2 − x)) / |W h / 2 + P z| (x = 0 where the load hangs so low that the block tips
    // backwards).
    for (p, x, z) in [
        (1e-3_f64, 0.0_f64, 0.0_f64),
        (3.0, 0.0, 2.0),
        (3.0, 0.0, -1.0),
        (1.0, 0.4, 5.0),
        (0.5, -0.5, 2.0),
    ] {
        let hung = scene(
            50.0,
            json!([ground(), cuboid("block", [1.0, 1.0, 2.0], [0.0; 3])]),
            json!({ "loads": { "dead": [{ "block": "block", "force": [0, 0, -p], "at": [x, 0, z] }] } }),
        );
        let want = f64::atan((2.0 * 0.5 + p * (0.5 - x)) / (2.0 + p * z).abs()).to_degrees();
        close(&format!("P = {p} at ({x}, {z})"), tilt_deg(&hung, [1.0, 0.0, 0.0]), want, 1e-7);
    }
}

#[test]
fn masses_and_centres_of_mass_may_be_given() {
    // λ = (b / 2 − x) / z with the centre of mass at (x, z); the mass drops out.
    for (mass, x, z) in [(1.0, 0.0, 0.3), (1e4, 0.2, 0.7), (1e-3, -0.3, -0.5)] {
        let mut block = cuboid("block", [1.0, 1.0, 2.0], [0.0; 3]);
        block["mass"] = json!(mass);
        block["centroid"] = json!([x, 0.0, z]);
        let pushed = scene(5.0, json!([ground(), block]), push([1.0, 0.0, 0.0]));
        exact(&format!("{mass} kg at ({x}, {z})"), &pushed, (0.5 - x) / (1.0 + z), 1e-7);
    }
    // Two blocks of given masses: the whole topples about its foot, λ = (b / 2) M / Σ m z.
    let blocks = |m: [f64; 2]| {
        let [mut b0, mut b1] = [
            cuboid("b0", [1.0, 1.0, 1.0], [0.0; 3]),
            cuboid("b1", [1.0, 1.0, 1.0], [0.0, 0.0, 1.0]),
        ];
        (b0["mass"], b1["mass"]) = (json!(m[0]), json!(m[1]));
        scene(5.0, json!([ground(), b0, b1]), push([1.0, 0.0, 0.0]))
    };
    for m in [[1.0, 1.0], [1.0, 7.0], [1000.0, 1.0]] {
        exact(&format!("{m:?}"), &blocks(m), 0.5 * (m[0] + m[1]) / (0.5 * m[0] + 1.5 * m[1]), 1e-6);
    }
}

#[test]
fn of_a_tilt_in_two_directions_each_has_its_own_angle() {
    // A box of 1 × 0.6 × 2: atan(0.5) towards x, atan(0.3) towards y, the same backwards.
    let block =
        scene(2.0, json!([ground(), cuboid("block", [1.0, 0.6, 2.0], [0.0; 3])]), json!({}));
    for (toward, want) in [
        ([1.0, 0.0, 0.0], 0.5_f64),
        ([-2.0, 0.0, 0.0], 0.5),
        ([0.0, 3.0, 0.0], 0.3),
        ([0.0, -1.0, 0.5], 0.3),
    ] {
        close(&format!("{toward:?}"), tilt_deg(&block, toward), want.atan().to_degrees(), 1e-7);
    }
}
