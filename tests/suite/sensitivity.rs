//! How load factors, tilts and α0 change with what was assumed: closed forms of blocks that slide or
//! turn; bends, which have two sides; what changes nothing; results that were edited; random scenes
//! beside differences.

use crate::ask::{
    check, cuboid, ground, leaves_hold, model, prove, saved as read, scene, survives, template,
};
use serde_json::{Value, json};
use trials::slopes;
use voussoir::{
    analysis::{Control, KinematicOptions, Law, LimitOptions, Question, TiltOptions, ask},
    proof::{Answer, ResultFile, recompute::Nothing, saved, verify::verify},
    scene::Scene,
    terms::{Derivative, Origin},
};

const FRICTION: &str = "/joints/default/friction";
const DENSITY: &str = "/materials/unit/density";
const FORCE: &str = "/loads/live/0/force/0";
const HEIGHT: &str = "/loads/live/0/at/2";

fn file_of(scene: &Scene, question: impl Into<Question>) -> ResultFile {
    let (question, model, control) = (question.into(), model(scene), Control::default());
    let answer = ask(&question, scene, &model, &control).expect("an answer");
    saved::of_question(&question, scene, &model, &answer, &control).expect("a result")
}

fn limit() -> LimitOptions {
    LimitOptions { law: Law::Associative, sensitivity: true, ..LimitOptions::default() }
}

/// Asks, and proves the result from the scene alone.
fn asked(scene: &Scene, question: impl Into<Question>) -> ResultFile {
    let file = file_of(scene, question);
    prove(scene, &file);
    file
}

fn of<'a>(file: &'a ResultFile, pointer: &str) -> &'a Derivative {
    let all = &file.sensitivity.as_ref().expect("a sensitivity").numbers;
    all.iter().find(|d| d.pointer == pointer).unwrap_or_else(|| panic!("{pointer}: {all:#?}"))
}

#[track_caller]
fn is(file: &ResultFile, pointer: &str, expected: f64) {
    let d = of(file, pointer);
    let value = d.one().unwrap_or_else(|| panic!("{d:?}"));
    assert!((value - expected).abs() <= 1e-6 * expected.abs().max(1e-3), "{d:?}: {expected}");
}

/// A block 1 m wide that a force of 1 N pushes at a height.
fn pushed(friction: f64, height: f64, at: f64) -> Scene {
    let live = json!({ "block": "b", "force": [1, 0, 0], "at": [0, 0, at] });
    let blocks = json!([ground(), cuboid("b", [1.0, 1.0, height], [0.0; 3])]);
    scene(friction, blocks, json!({ "loads": { "live": [live] } }))
}

#[test]
fn a_block_that_slides_follows_its_friction() {
    // λ = μ W.
    let file = asked(&pushed(0.5, 1.0, 0.1), limit());
    is(&file, FRICTION, 1.0);
    is(&file, DENSITY, 0.5);
    is(&file, FORCE, -0.5);
    is(&file, HEIGHT, 0.0);
    assert!(file.sensitivity.as_ref().unwrap().numbers.iter().all(|d| d.origin == Origin::Proof));
    // What matters most comes first, by 1 % of it.
    let first = &file.sensitivity.as_ref().unwrap().numbers[0];
    assert!((first.per_percent.unwrap().abs() - 0.005).abs() < 1e-9, "{first:?}");
    assert_eq!((of(&file, FRICTION).unit, of(&file, DENSITY).unit), ("", "kg/m³"));
}

#[test]
fn a_block_that_turns_follows_the_height_of_its_load() {
    // λ = W b / 2 z, with W = 2 N, b = 1 m, z = 1.6 m.
    let file = asked(&pushed(0.9, 2.0, 1.6), limit());
    let value = 1.0 / 1.6;
    is(&file, HEIGHT, -value / 1.6);
    is(&file, DENSITY, value);
    is(&file, FORCE, -value);
    is(&file, FRICTION, 0.0);
}

#[test]
fn strengths_count_by_what_gives_way() {
    // λ = μ W + c A where it slides.
    let mut slides = pushed(0.5, 1.0, 0.1);
    slides.joints.default.cohesion = Some(0.2);
    slides.joints.default.tension = Some(0.1);
    let file = asked(&slides, limit());
    is(&file, "/joints/default/cohesion", 1.0);
    is(&file, "/joints/default/tension", 0.0);
    is(&file, FRICTION, 1.0);
    // λ z = (W + T A) b / 2 where it turns.
    let mut turns = pushed(0.9, 2.0, 1.6);
    turns.joints.default.cohesion = Some(5.0);
    turns.joints.default.tension = Some(0.1);
    let file = asked(&turns, limit());
    is(&file, "/joints/default/tension", 0.5 / 1.6);
    // λ z = W (b − W / σ d) / 2 where it crushes at the edge.
    let mut crushes = pushed(0.9, 2.0, 1.6);
    crushes.joints.default.compression = Some(40.0);
    let file = asked(&crushes, limit());
    let exact = 2.0 * 2.0 / (2.0 * 1.6 * 40.0 * 40.0);
    let told = of(&file, "/joints/default/compression").one().expect("one");
    assert!((told - exact).abs() <= 1e-4 * exact, "{told}: {exact}");
    is(&file, FRICTION, 0.0);
}

#[test]
fn a_tilt_and_an_earthquake_have_derivatives_of_their_own() {
    let wide = scene(0.4, json!([ground(), cuboid("b", [2.0, 1.0, 1.0], [0.0; 3])]), json!({}));
    let toward = vec![[1.0, 0.0, 0.0]];
    let law = Law::Associative;
    let tilt = TiltOptions { toward: toward.clone(), law, sensitivity: true, ..Default::default() };
    // tan θ = μ.
    let file = asked(&wide, tilt);
    is(&file, FRICTION, (1.0_f64 / (1.0 + 0.16)).to_degrees());
    is(&file, DENSITY, 0.0);
    // A weight on a wall that turns: α0 = (W b / 2 + P e) / (W h / 2 + P z).
    let dead = json!({ "block": "b", "force": [0, 0, -1], "at": [0.1, 0, 3] });
    let blocks = json!([ground(), cuboid("b", [1.0, 1.0, 3.0], [0.0; 3])]);
    let wall = scene(0.9, blocks, json!({ "loads": { "dead": [dead] } }));
    let quake =
        KinematicOptions { toward, law, sensitivity: true, linear: true, ..Default::default() };
    let file = asked(&wall, quake);
    let (up, over) = (3.0 * 0.5 + 0.4, 3.0 * 1.5 + 3.0);
    is(&file, "/loads/dead/0/at/0", -1.0 / over);
    is(&file, "/loads/dead/0/at/2", -up / over / over);
    is(&file, "/loads/dead/0/force/2", -(0.4 * over - up * 3.0) / over / over);
    is(&file, DENSITY, 3.0 * (0.5 * over - up * 1.5) / over / over);
    is(&file, FRICTION, 0.0);
}

#[test]
fn a_bend_has_two_sides() {
    // It slides and turns at one load: λ = W min(μ, b / 2 z), z = 1 m, b = 1 m.
    let scene = pushed(0.5, 1.0, 1.0);
    let file = asked(&scene, limit());
    let d = of(&file, FRICTION);
    assert_eq!(d.origin, Origin::AskedAgain);
    let (left, right) = (d.left.unwrap(), d.right.unwrap());
    assert!((left - 1.0).abs() < 1e-4 && right.abs() < 1e-4, "{d:?}");
    let d = of(&file, HEIGHT);
    let (left, right) = (d.left.unwrap(), d.right.unwrap());
    assert!(left.abs() < 1e-4 && (right + 0.5).abs() < 1e-4, "{d:?}");
    // Both mechanisms have the same power on density and force.
    is(&file, FORCE, -0.5);
    is(&file, DENSITY, 0.5);
    // Who only checks the file has no solver to ask again.
    let found = verify(&read(&file), &scene, &Nothing).unwrap();
    assert!(!found.refuted() && !found.proved());
}

#[test]
fn units_and_mirrors_change_nothing() {
    let arch = |size: f64, side: f64| {
        let live = json!({ "block": "v03", "force": [0.02 * side, 0, -0.1] });
        let mut scene = template(
            0.7,
            json!({ "arch": { "radius": size, "thickness": 0.15 * size, "depth": size, "voussoirs": 13 } }),
            json!({ "loads": { "live": [live] } }),
        );
        if side < 0.0 {
            scene.loads.live[0].block = Some("v09".into());
        }
        scene.materials.get_mut("unit").unwrap().density = size.powi(-3);
        scene
    };
    let own = asked(&arch(1.0, 1.0), limit());
    let large = asked(&arch(1e3, 1.0), limit());
    let mirrored = asked(&arch(1.0, -1.0), limit());
    let one = |file: &ResultFile, pointer: &str| of(file, pointer).one().expect("one");
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-6 * a.abs().max(1e-6), "{a} {b}");
    near(one(&own, FRICTION), one(&large, FRICTION));
    near(one(&own, FRICTION), one(&mirrored, FRICTION));
    near(one(&own, DENSITY), one(&large, DENSITY) * 1e-9);
    near(one(&own, FORCE), one(&large, FORCE));
    near(one(&own, FORCE), -one(&mirrored, FORCE));
}

#[test]
fn forged_derivatives_are_refused() {
    let scene = pushed(0.5, 1.0, 1.0);
    let file = file_of(&scene, limit());
    leaves_hold(&file);
    let told = |value: &mut Value, to: f64| {
        let list = value["answer"]["sensitivity"]["numbers"].as_array_mut().unwrap();
        let own = list.iter_mut().find(|d| d["pointer"] == FRICTION).unwrap();
        own["left"] = json!(to);
    };
    assert!(!survives(&scene, &file, |v| told(v, 0.9)));
    // Nor what was asked again, on both sides of the file.
    let both = |v: &mut Value| {
        told(v, 0.9);
        let list = v["evidence"]["limit"]["sided"].as_array_mut().unwrap();
        list.iter_mut().find(|d| d["pointer"] == FRICTION).unwrap()["left"] = json!(0.9);
    };
    assert!(!survives(&scene, &file, both));
    assert!(survives(&scene, &file, |_| {}));
    // Numbers that follow from the proof are not taken from elsewhere.
    let scene = pushed(0.5, 1.0, 0.1);
    let file = file_of(&scene, limit());
    let more = |v: &mut Value| {
        v["evidence"]["limit"]["sided"] = json!([{ "pointer": FRICTION, "left": 3, "right": 3 }]);
    };
    assert!(survives(&scene, &file, more));
    // Nor is what nobody asked for.
    let unasked = |v: &mut Value| {
        v["question"]["limit"]["sensitivity"] = json!(false);
    };
    assert!(!survives(&scene, &file, unasked));
}

#[test]
fn dry_friction_that_slides_is_asked_again() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/block-in-groove.json");
    let (scene, _) = voussoir::scene::read_file(path.as_ref()).unwrap();
    let options = LimitOptions { law: Law::Coulomb, ..limit() };
    let file = file_of(&scene, options);
    let Answer::Limit(answer) = &file.answer else { panic!() };
    let value = answer.load_factor.value.unwrap();
    // λ = √2 μ.
    let d = of(&file, FRICTION);
    assert_eq!(d.origin, Origin::AskedAgain);
    for side in [d.left, d.right] {
        assert!((side.unwrap() - value / 0.5).abs() < 1e-2 * value, "{d:?}");
    }
    let found = check(&scene, &file);
    assert!(found.proved() && found.computed());
}

/// Derivatives of random scenes are those of differences: `trials slopes`.
#[test]
fn random_scenes_agree_with_differences() {
    let list = slopes::run(5, 6, None, |_| {}).unwrap();
    let wrong: Vec<_> = list.iter().filter(|s| s.is_wrong()).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(list.iter().map(|s| s.one).sum::<usize>() > 20, "{list:#?}");
}
