//! The worst case within ranges against closed forms and against samples of the ranges.

use super::{arch, block};
use serde_json::{Value, json};
use voussoir::{
    analysis::{Control, Question, assess, limit},
    interface::prepare,
    scene::{Friction, Scene},
    sweep::{Between, Worst, worst},
    verdict::Verdict,
};

fn scene(value: &Value) -> Scene {
    serde_json::from_value(value.clone()).unwrap()
}

fn limits() -> Question {
    Question::Limit(Default::default())
}

fn stands() -> Question {
    Question::Assess(Default::default())
}

fn ask(value: &Value, ranges: &[&str], of: Question) -> Result<Worst, String> {
    let ranges: Vec<Between> = ranges.iter().map(|r| r.parse().unwrap()).collect();
    worst(&scene(value), &ranges, &of, &Control::default()).map_err(|e| e.to_string())
}

fn factor(scene: &Scene) -> f64 {
    let model = prepare(scene).unwrap();
    limit(&model, &Control::default()).value.unwrap()
}

#[test]
fn the_lowest_friction_is_the_worst() {
    let w = ask(&block(), &["friction=0.2..0.7"], limits()).unwrap();
    assert_eq!((w.corners, w.scene.joints.default.friction), (1, Some(Friction::Coefficient(0.2))));
    assert!((factor(&w.scene) - 0.2).abs() < 1e-6);
    assert!(w.argument[0].contains("0.2, the lowest"), "{:?}", w.argument);
}

/// A light block on a heavy one, a force at the top: which density is the worst differs from block
/// to block.
fn counterweight() -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "inner": { "density": 2200 }, "outer": { "density": 2200 } },
        "joints": { "default": { "friction": "infinite" } },
        "blocks": [
            { "id": "ground", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "inner", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 0.5], "material": "inner" },
            { "id": "outer", "shape": { "box": { "size": [2.4, 1, 1] } }, "at": [0.7, 0, 1.5], "material": "outer" }
        ],
        "loads": { "live": [{ "block": "outer", "force": [1, 0, 0] }] }
    })
}

#[test]
fn the_worst_densities_are_opposite_ends_where_one_weight_holds_the_other() {
    let ranges = ["density=2000..2400"];
    let w = ask(&counterweight(), &ranges, limits()).unwrap();
    assert_eq!(w.corners, 4);
    assert_eq!(
        (w.scene.materials["inner"].density, w.scene.materials["outer"].density),
        (2000.0, 2400.0)
    );
    assert!(w.argument[1].contains("no value between them is worse"), "{:?}", w.argument);
    // No value between is worse.
    let least = factor(&w.scene);
    for (inner, outer) in [
        (2000.0, 2000.0),
        (2100.0, 2300.0),
        (2400.0, 2400.0),
        (2400.0, 2000.0),
        (2000.0, 2399.0),
        (2200.0, 2200.0),
    ] {
        let mut s = scene(&counterweight());
        s.materials.get_mut("inner").unwrap().density = inner;
        s.materials.get_mut("outer").unwrap().density = outer;
        assert!(factor(&s) >= least - 1e-6 * least.abs(), "{inner} {outer}");
    }
}

/// A plank that reaches out over the edge of the ground by half, a stone on its other end, a load
/// at its tip.
fn lever(load: f64, density: f64) -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "plank": { "density": 1000 }, "stone": { "density": density } },
        "joints": { "default": { "friction": 0.7 } },
        "blocks": [
            { "id": "ground", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "plank", "shape": { "box": { "size": [2, 1, 0.2] } }, "at": [0.5, 0, 0.1], "material": "plank" },
            { "id": "stone", "shape": { "box": { "size": [0.4, 1, 1] } }, "at": [-0.3, 0, 0.7], "material": "stone" }
        ],
        "loads": { "dead": [{ "block": "plank", "force": [0, 0, -1000.0 * load], "at": [1.5, 0, 0.2] }] }
    })
}

#[test]
fn one_corner_that_falls_is_the_verdict() {
    // About the edge at x = 0.5 the plank has no moment, the load P one of 1 m × P, the stone 0.8 m
    // × 0.4 m³ ρ g: 6278 N m at 2000 kg/m³, 7534 N m at 2400. Of the corners only the greater load
    // with the lesser density falls.
    let verdict = |scene: &Scene| {
        let model = prepare(scene).unwrap();
        assess(&model, &Control::default()).verdict
    };
    for (load, density) in [(5.0, 2000.0), (5.0, 2400.0), (7.0, 2000.0), (7.0, 2400.0)] {
        let falls = load * 1000.0 > 0.8 * 0.4 * density * 9.81;
        assert_eq!(falls, (load, density) == (7.0, 2000.0));
        let want = if falls { Verdict::Unstable } else { Verdict::Stable };
        assert_eq!(verdict(&scene(&lever(load, density))), want, "{load} {density}");
    }
    let w = ask(&lever(1.0, 2200.0), &["load=5..7", "density:stone=2000..2400"], stands()).unwrap();
    assert_eq!((w.corners, verdict(&w.scene)), (4, Verdict::Unstable));
    assert_eq!(
        (w.scene.loads.dead[0].force, w.scene.materials["stone"].density),
        (Some([0.0, 0.0, -7000.0]), 2000.0)
    );
    assert_eq!(w.scene.materials["plank"].density, 1000.0);
}

#[test]
fn of_corners_that_all_fall_the_fastest_is_named() {
    let mut value = counterweight();
    value["loads"] =
        json!({ "dead": [{ "block": "outer", "force": [0, 0, -1000], "at": [1.9, 0, 2] }] });
    // Outer turns about the edge of inner, whatever inner weighs: every load falls, the greatest
    // fastest. Together the two turn about the ground's edge at x = 0.5, 0.5 W_inner against 0.2
    // W_outer and 1.4 P, which is slower.
    let w = ask(&value, &["load=0.5..6", "density:inner=2000..2400"], stands()).unwrap();
    let model = prepare(&w.scene).unwrap();
    let a = assess(&model, &Control::default());
    let moment = 0.5 * 2000.0 * 9.81 - 0.2 * 2.4 * 2200.0 * 9.81 - 1.4 * 6000.0;
    assert!(moment < 0.0);
    assert_eq!((w.corners, a.verdict), (4, Verdict::Unstable));
    assert_eq!(w.scene.loads.dead[0].force, Some([0.0, 0.0, -6000.0]));
}

#[test]
fn other_numbers_are_searched_and_nothing_more_is_claimed() {
    let w = ask(&arch(), &["/templates/0/arch/thickness=0.15..0.2", "friction=0.6..0.7"], limits())
        .unwrap();
    assert!(
        w.argument.iter().any(|a| a.contains("values between them were not computed")),
        "{:?}",
        w.argument
    );
    let thin: Value = serde_json::to_value(&w.scene).unwrap();
    assert_eq!(thin.pointer("/templates/0/arch/thickness"), Some(&json!(0.15)));
    // The live load is a weight, which densities change as well: no claim about what lies between.
    let w = ask(&arch(), &["density=2000..2400"], limits()).unwrap();
    assert!(w.argument[1].contains("values between them were not computed"), "{:?}", w.argument);
}

#[test]
fn ranges_that_name_nothing_are_refused() {
    for (range, word) in [
        ("frction=0..1", "unknown"),
        ("friction=-1..1", "must not be negative"),
        ("density=0..1", "above 0"),
        ("density:stome=1..2", "did you mean \"stone\""),
        ("load=1..2", "no dead load"),
        ("/blocks/9/density=1..2", "does not exist"),
    ] {
        let error = ask(&block(), &[range], stands()).expect_err("refused");
        assert!(error.contains(word), "{error}");
    }
    assert!(ask(&block(), &["friction=0..1", "friction=0..1"], stands()).is_err());
    for text in ["friction", "friction=1", "friction=2..1", "friction=a..b", "friction=0..inf"] {
        assert!(text.parse::<Between>().is_err(), "{text}");
    }
}
