//! Trains over bridges: the worst position of an axle (BR09 of `frontier_cases.json`), what changes
//! nothing, what is refused, and results that were edited.

use crate::ask::{close, model, prove};
use serde_json::{Value, json};
use voussoir::{
    analysis::{Control, Law, MovingOptions, Question, ask},
    proof::{ResultFile, answer::FactorStatus, moving::MovingAnswer, saved},
    report::tell,
    scene::{Scene, read_str},
    train::Travel,
};

fn read(value: &Value) -> Scene {
    let mut value = value.clone();
    value["format"] = json!("voussoir-scene/1");
    value["name"] = json!("test");
    read_str("test", value.to_string()).unwrap_or_else(|e| panic!("{e}\n{value}")).0
}

/// Half of the length from the first springing of Prestwood's bridge to the last, m.
const HALF: f64 = 3.275;

/// Prestwood's bridge with k = 1.5 and so many voussoirs; places from the left springing.
fn bridge(voussoirs: usize, train: Value) -> Value {
    json!({
        "materials": { "ring": { "density": 20e3 / 9.81 } },
        "joints": { "default": { "friction": 0.6 } },
        "templates": [{ "bridge": {
            "spans": [{ "clear_span": 6.55, "rise": 1.428, "thickness": 0.22, "voussoirs": voussoirs }],
            "width": 3.8, "material": "ring", "at": [HALF, 0, 0],
            "fill": { "cover": 0.165, "unit_weight": 18e3, "passive": 1.5 } } }],
        "train": train
    })
}

fn axle(path: [f64; 2], step: f64) -> Value {
    json!({ "axles": [{ "at": 0, "force": 1000 }], "path": path, "step": step })
}

/// A heavy axle behind a light one.
fn cart(path: [f64; 2]) -> Value {
    json!({ "axles": [{ "at": 0, "force": 400 }, { "at": -1.2, "force": [0, 0, -1000] }],
        "path": path, "step": 0.4 })
}

fn file_of(scene: &Scene) -> ResultFile {
    let question =
        Question::Moving(MovingOptions { law: Law::Associative, ..MovingOptions::default() });
    let model = model(scene);
    let answer = ask(&question, scene, &model, &Control::default()).expect("an answer");
    saved::of(&question, scene, &model, &answer).expect("a result")
}

fn said(file: &ResultFile) -> &MovingAnswer {
    file.answer.moving().expect("an answer to the question")
}

fn all(file: &ResultFile) -> Vec<&MovingAnswer> {
    file.directions.iter().filter_map(|d| d.answer.moving()).collect()
}

fn value(a: &MovingAnswer) -> f64 {
    a.load_factor.value.expect("a load factor")
}

/// BR09: every given position has its load, and the worst lies outside the quarter point, between 1.2
/// and 1.4 m.
#[test]
fn the_worst_position_is_found_between_the_steps() {
    let scene = read(&bridge(40, axle([0.8, 2.0], 0.2)));
    let file = file_of(&scene);
    prove(&scene, &file);
    let list = all(&file);
    for (x, wanted) in [
        (0.8, 184.983),
        (1.0, 166.387),
        (1.2, 160.535),
        (1.4, 160.292),
        (1.6, 167.109),
        (1.8, 178.264),
        (2.0, 193.739),
    ] {
        let there = list.iter().find(|a| (a.x - x).abs() < 1e-9).expect("a step");
        close(&format!("{x}"), value(there), wanted, 1e-4);
    }
    let worst = said(&file);
    assert!(worst.x > 1.2 && worst.x < 1.4, "{}", worst.x);
    let least = list.iter().map(|a| value(a)).fold(f64::INFINITY, f64::min);
    assert_eq!(value(worst), least);
    assert!(least < 160.292 * (1.0 - 1e-3), "{least}");
    assert_eq!((worst.axles.len(), worst.axles[0].axle), (1, 0));
    assert_eq!(worst.axles[0].x, worst.x);
    // Golden section ends where neighbours lie a thousandth of a step apart.
    let near = |a: &&&MovingAnswer| a.x != worst.x && (a.x - worst.x).abs() < 4e-4;
    assert!(list.iter().any(|a| near(&a)), "no position next to the worst");
    let table = tell::csv(&file).expect("a table");
    assert_eq!(table.lines().count(), list.len() + 1);
    let chart = tell::charts(&file).remove(0);
    assert!(chart.x.label.contains("the train") && chart.y.label.contains("load factor"));
}

/// A path that ends before the worst position is known says so, wherever the bridge lies.
#[test]
fn a_path_that_ends_too_early_is_said() {
    for (path, ends) in [([2.5, 3.2], true), ([0.5, 6.0], false)] {
        let file = file_of(&read(&bridge(20, axle(path, 0.35))));
        assert_eq!(voussoir::report::tell::at_an_end(&file), ends, "{path:?}: {}", said(&file).x);
    }
}

/// A road on a block that is not there is an error with its place, not a position without a train.
#[test]
fn a_road_on_a_missing_block_is_an_error() {
    let scene = read(&bridge(12, axle([0.8, 2.0], 0.4)));
    let whole = model(&scene);
    let gone = whole.assembly.find("v02").expect("a voussoir");
    let question =
        Question::Moving(MovingOptions { law: Law::Associative, ..MovingOptions::default() });
    let e =
        ask(&question, &scene, &whole.without(&[gone]), &Control::default()).expect_err("an error");
    let text = format!("{}: {} ({})", e.path, e.message, e.hint.unwrap_or_default());
    assert!(text.starts_with("train.axles[0]: at x = "), "{text}");
    assert!(text.contains("\"v02\"") && text.contains("with all blocks of its bridge"), "{text}");
}

/// The mirror image of a position is the train turned round: both directions of travel have the
/// same least load factor on a bridge that is its own image.
#[test]
fn both_directions_of_travel_are_asked() {
    let mut value_ = bridge(12, cart([-1.0, 1.2]));
    value_["templates"][0]["bridge"]["at"] = json!([0, 0, 0]);
    value_["train"]["path"] = json!([-3.6, 3.6]);
    let file = file_of(&read(&value_));
    let list = all(&file);
    let of = |travel: Travel| {
        list.iter().filter(|a| a.travel == travel).map(|a| value(a)).fold(f64::INFINITY, f64::min)
    };
    close("both", of(Travel::Forward), of(Travel::Backward), 1e-6);
    // Axles that have not come onto the bridge yet are not there.
    assert!(list.iter().any(|a| a.axles.len() == 1) && list.iter().any(|a| a.axles.len() == 2));
    for a in &list {
        for s in &a.axles {
            let at = [0.0, -1.2][s.axle];
            let sign = if a.travel == Travel::Forward { 1.0 } else { -1.0 };
            assert!((s.x - (a.x + sign * at)).abs() < 1e-12 && s.share > 0.0 && s.share <= 1.0);
        }
    }
}

#[test]
fn place_units_and_two_ways_of_writing_change_nothing() {
    let wanted = file_of(&read(&bridge(12, cart([0.4, 2.4]))));
    let mut shifted = bridge(12, cart([1000.4, 1002.4]));
    shifted["templates"][0]["bridge"]["at"] = json!([1000.0 + HALF, -20, 7]);
    let got = file_of(&read(&shifted));
    close("shifted", value(said(&got)), value(said(&wanted)), 1e-6);
    close("there", said(&got).x - 1000.0, said(&wanted).x, 2e-3);
    let mut heavy = bridge(12, cart([0.4, 2.4]));
    heavy["train"]["axles"] =
        json!([{ "at": 0, "force": [0, 0, -4e5] }, { "at": -1.2, "force": 1e6 }]);
    let got = file_of(&read(&heavy));
    close("in other units", 1000.0 * value(said(&got)), value(said(&wanted)), 1e-6);
    // Alone in its place a train is the live load that it says.
    let mut fixed = bridge(12, Value::Null);
    fixed.as_object_mut().expect("an object").remove("train");
    let at = &said(&wanted).axles;
    let loads: Vec<Value> =
        at.iter().map(|s| json!({ "road": { "x": s.x }, "force": [0, 0, -s.force] })).collect();
    fixed["loads"] = json!({ "live": loads });
    close("as a load", crate::ask::load_factor(&read(&fixed)), value(said(&wanted)), 1e-6);
}

#[test]
fn edited_results_are_refused() {
    let scene = read(&bridge(12, axle([0.8, 2.0], 0.4)));
    let honest = file_of(&scene);
    prove(&scene, &honest);
    crate::ask::leaves_hold(&honest);
    let least = honest.directions.iter().position(|d| d.answer == honest.answer).expect("it");
    let another = (least + 1) % honest.directions.len();
    fn positions(v: &mut Value) -> &mut Vec<Value> {
        v["evidence"]["moving"]["positions"].as_array_mut().expect("positions")
    }
    let edits: [crate::ask::Edit; 4] = [
        ("a step left out", &|v| drop(positions(v).remove(0))),
        ("no positions", &|v| positions(v).clear()),
        ("the certificate of another position", &|v| {
            positions(v)[another]["factor"] = positions(v)[least]["factor"].clone();
        }),
        ("a position beside the way", &|v| positions(v)[another]["x"] = json!(5.0)),
    ];
    crate::ask::edits_are_refused(&scene, &honest, &edits);
    assert!(!crate::ask::survives(&scene, &honest, |v| drop(positions(v).remove(least))));
}

#[test]
fn mistakes_are_named() {
    let told = |change: &dyn Fn(&mut Value)| {
        let mut value = bridge(12, axle([0.8, 2.0], 0.4));
        change(&mut value);
        match voussoir::interface::prepare(&read(&value)) {
            Ok(_) => panic!("{value}"),
            Err(e) => format!("{}: {}", e.path, e.message),
        }
    };
    for (text, wanted) in [
        (told(&|v| v["train"]["axles"] = json!([])), "train.axles: the train has no axles"),
        (told(&|v| v["train"]["step"] = json!(0)), "train.step: must be > 0"),
        (told(&|v| v["train"]["step"] = json!(1e-9)), "train.step: makes more than"),
        (told(&|v| v["train"]["path"] = json!([2, 1])), "train.path: the path must run"),
        (told(&|v| v["train"]["path"] = json!([40, 50])), "train.path: no axle reaches a span"),
        (
            told(&|v| v["train"]["axles"][0]["force"] = json!(-1)),
            "train.axles[0].force: must be > 0",
        ),
        (
            told(&|v| v["train"]["axles"][0]["force"] = json!([1, 0, -1])),
            "train.axles[0].force: an axle must press down",
        ),
        (
            told(&|v| v["train"]["axles"][0]["patch"] = json!(0)),
            "train.axles[0].patch: must be > 0",
        ),
        (
            told(&|v| {
                v["templates"] =
                    json!([{ "column": { "blocks": 2, "size": [1, 1, 1], "material": "ring" } }]);
            }),
            "train: the scene has no road",
        ),
    ] {
        assert!(text.contains(wanted), "{text}: {wanted}");
    }
    // Without a train there is nothing to ask, and a train is no live load.
    let mut value = bridge(12, Value::Null);
    value.as_object_mut().expect("an object").remove("train");
    let asked = |scene: &Scene, question: Question| {
        let e = ask(&question, scene, &model(scene), &Control::default()).expect_err("an error");
        format!("{} {}", e.message, e.hint.unwrap_or_default())
    };
    let text = asked(&read(&value), Question::Moving(MovingOptions::default()));
    assert!(text.contains("no train"), "{text}");
    let scene = read(&bridge(12, axle([0.8, 2.0], 0.4)));
    let text = asked(&scene, Question::Limit(voussoir::analysis::LimitOptions::default()));
    assert!(text.contains("--moving"), "{text}");
}

/// A ring that slides on another: with dry friction less than the bound.
fn two_rings(friction: f64) -> Value {
    let mut value = bridge(7, axle([1.6, 2.4], 0.8));
    let own = &mut value["templates"][0]["bridge"];
    own["at"] = json!([0, 0, 0]);
    own["spans"][0]["rings"] = json!(2);
    own["spans"][0]["thickness"] = json!(0.5);
    value["joints"]["default"]["friction"] = json!(friction);
    value
}

fn dry_file(scene: &Scene, every_value: bool) -> ResultFile {
    let question = Question::Moving(MovingOptions { every_value, ..MovingOptions::default() });
    let model = model(scene);
    let answer = ask(&question, scene, &model, &Control::default()).expect("an answer");
    saved::of(&question, scene, &model, &answer).expect("a result")
}

/// With dry friction the worst position has its value, and of every other one it is only known that
/// it is not less: as asking all of them for their values says.
#[test]
fn other_positions_than_the_worst_bear_what_it_does() {
    let scene = read(&two_rings(0.4));
    let (least, every) = (dry_file(&scene, false), dry_file(&scene, true));
    prove(&scene, &least);
    let worst = said(&least);
    let v = value(worst);
    let bound = worst.load_factor.associative.value.expect("a bound");
    assert!(v < 0.99 * bound, "{v} {bound}: something slides");
    let of_all = value(said(&every));
    // One that is less by no more than others are asked below the value may pass for no less.
    assert!(v <= of_all * (1.0 + 1.1e-3), "{v} {of_all}");
    let is_at_least = |a: &MovingAnswer| a.load_factor.status == FactorStatus::AtLeast;
    let list = all(&least);
    assert!(list.iter().filter(|a| is_at_least(a)).count() > list.len() / 2);
    for a in list.iter().filter(|a| is_at_least(a)) {
        let floor = a.load_factor.lower.expect("a least value");
        assert!(floor >= (1.0 - 2e-3) * v && a.load_factor.value.is_none());
        let there = all(&every).into_iter().find(|e| e.position() == a.position());
        let Some(own) = there.and_then(|e| e.load_factor.value) else { continue };
        assert!(floor <= own * (1.0 + 1e-6), "x = {}: {floor} {own}", a.x);
    }
    let k = least.directions.iter().position(|d| d.answer.moving().is_some_and(is_at_least));
    let k = k.expect("a position");
    for (what, by) in [
        ("a position that bears less than the worst", 0.5),
        ("a position that bears more than it does", 50.0),
    ] {
        let edit = |v: &mut Value| {
            let own = &mut v["evidence"]["moving"]["positions"][k]["factor"]["dry"]["rests_at"];
            *own = json!(by * own.as_f64().expect("a number"));
        };
        crate::ask::edits_are_refused(&scene, &least, &[(what, &edit)]);
    }
    // Tables and charts have the bound where there is no value.
    let chart = tell::charts(&least).remove(0);
    let names: Vec<&str> = chart.series.iter().map(|s| s.name.as_str()).collect();
    let names = names.join(", ");
    assert!(names.contains("upper bound") && names.contains("with dry friction"), "{names}");
    let table = tell::csv(&least).expect("a table");
    assert_eq!(table.lines().count(), list.len() + 1);
}
