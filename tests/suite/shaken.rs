//! All blocks on ground that moves, as a question: saved and checked, in rows, and the masses of
//! loads beside the mechanism.

use crate::ask::model;
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::{ops::ControlFlow, path::Path};
use voussoir::{
    analysis::{
        Answer, Control, Question, ask, burdens,
        follow::machine::{MachineOptions, machine},
    },
    dynamics::{Progress, Shaken, ShakenFate, Shaking, SimulationSettings, shake},
    ground::Pulse,
    proof::{ResultFile, saved, shaken::ShakenWord, verify},
    rocking::{RunSettings, Search, scan},
    scene::Scene,
    sweep::{RowStatus, RunOptions, Sweep, run},
};

fn open(name: &str) -> Scene {
    crate::ask::open(&Path::new(env!("CARGO_MANIFEST_DIR")).join("structures").join(name))
}

fn block() -> Scene {
    open("slender-block.json")
}

/// A pulse that rocks the block and does not overturn it, with fast steps.
fn question() -> Value {
    json!({ "shake": {
        "ground": { "pulse": { "half_sine": { "acceleration": 3, "duration": 0.25 } } },
        "fast": true, "seconds": 1.5
    } })
}

fn asked(scene: &Scene, question: &Value) -> ResultFile {
    let question: Question = serde_json::from_value(question.clone()).expect("a question");
    let model = model(scene);
    let answer = ask(&question, scene, &model, &Control::default()).expect("an answer");
    saved::of(&question, scene, &model, &answer).expect("a result")
}

#[test]
fn a_saved_history_is_run_again_and_claims_nothing() {
    let scene = block();
    let honest = asked(&scene, &question());
    let said = honest.answer.shaken().expect("a history");
    assert_eq!(said.fate, ShakenWord::Moves);
    assert!((0.01..0.5).contains(&said.blocks[0].greatest_over_thickness), "{said:?}");
    let found = crate::ask::check(&scene, &honest);
    assert!(!found.refuted() && found.computed(), "{found:?}");
    assert_eq!(found.unchecked().count(), 0, "{found:?}");
    crate::ask::leaves_hold(&honest);
    let text = honest.to_value().expect("JSON");
    // The history, as it is told, is another one.
    let forge = |pointer: &str, value: Value| {
        let mut forged = text.clone();
        let pointer = format!("/evidence/shake{pointer}");
        let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
        forged.pointer_mut(parent).expect("a place")[key] = value;
        crate::ask::told(&mut forged);
        let saved = voussoir::proof::read::read_str("forged", forged.to_string()).ok()?;
        Some(verify(&saved, &saved.scene).expect("a scene"))
    };
    for (pointer, value) in [
        ("/fate", json!("overturns")),
        ("/overturned", json!("block")),
        ("/blocks", json!([])),
        ("/steps", json!(7)),
        ("/stop", json!("fallen")),
        ("/toward", json!([0.0, 1.0, 0.0])),
        ("/asked/toward", json!([0.0, 0.0, 1.0])),
        ("/asked/ground/scale", json!(0.5)),
    ] {
        // What does not even read is refused as well.
        if let Some(found) = forge(pointer, value) {
            assert!(found.refuted(), "{pointer} is believed: {found:?}");
        }
    }
    // Numbers that might be so are run again: no other machine's rounding is called a lie, and
    // nothing is confirmed.
    for (pointer, value) in [("/fate", json!("rests")), ("/step", json!(said.step * 1.0))] {
        let found = forge(pointer, value.clone()).expect("a result");
        let same = pointer == "/step";
        assert!(!found.refuted(), "{pointer}: {found:?}");
        assert_eq!(found.unchecked().count(), usize::from(!same), "{pointer}: {found:?}");
    }
}

#[test]
fn rows_over_scales_are_those_asked_alone() {
    let value: Value = serde_json::from_str(
        &std::fs::read_to_string("structures/slender-block.json").expect("a scene"),
    )
    .expect("JSON");
    let pulse = json!({ "jump": { "velocity": 1 } });
    let plan = json!({
        "format": "voussoir-sweep/1", "scene": "scene.json", "sampling": { "grid": {} },
        "question": { "shake": { "ground": { "pulse": pulse }, "fast": true, "seconds": 4 } },
        "vary": [{ "pointer": "/question/shake/ground/scale", "values": [0.5, 0.9] }]
    });
    let sweep = Sweep::new(serde_json::from_value(plan).expect("a plan"), value).expect("a sweep");
    let folder = tempfile::tempdir().expect("a folder");
    let done = run(&sweep, &folder.path().join("rows.jsonl"), &RunOptions::default(), &|_| {})
        .expect("rows");
    let status: Vec<RowStatus> = done.rows.iter().map(|r| r.answer.status).collect();
    // Of the closed form of a block pushed by a jump: it overturns from 0.734 m/s on.
    assert_eq!(status, [RowStatus::Undecided, RowStatus::Unstable]);
}

#[test]
fn options_that_mean_nothing_are_refused() {
    let refused = |question: Value, word: &str| {
        let question: Question = serde_json::from_value(question).expect("a question");
        let scene = block();
        let error = ask(&question, &scene, &model(&scene), &Control::default());
        let error = error.expect_err("refused").to_string();
        assert!(error.contains(word), "{error}");
    };
    let jump = json!({ "pulse": { "jump": { "velocity": 1 } } });
    refused(json!({ "shake": {} }), "nothing moves");
    refused(json!({ "shake": { "ground": jump, "toward": [0, 0, 0] } }), "must not be zero");
    refused(json!({ "shake": { "ground": jump, "toward": [0, 0, -3] } }), "parallel to gravity");
    refused(json!({ "shake": { "ground": jump, "seconds": 0 } }), "must be > 0");
    let double = json!({ "pulse": { "double_jump": { "velocity": 1 } } });
    refused(json!({ "shake": { "ground": double } }), "waits for a landing");
    refused(json!({ "shake": { "ground": { "record": "r.csv" } } }), "was not read");
}

/// A wall with a floor on it: the masses of loads rock with the wall. The mechanism is exact; without
/// the mass of the floor the engine would be 30 % off.
#[test]
fn masses_of_loads_go_with_their_blocks() {
    let weighs = open("overturning-wall-with-floor.json");
    // Beside it the same mass pushed without resting.
    let mut pushes = weighs.clone();
    pushes.loads.dead.clear();
    pushes.loads.masses = serde_json::from_value(
        json!([{ "block": "wall", "at": [-0.4, 0, 6], "mass": 40000.0 / 9.80665 }]),
    )
    .expect("masses");
    for scene in [weighs, pushes] {
        let model = model(&scene);
        let options = MachineOptions { toward: Vector3::x(), control: None, restitution: None };
        let built = machine(&scene, &model, &options, &Control::default()).expect("a machine");
        // The ground goes to −x, and pushes the wall over its toe.
        let jump = Pulse::Jump { velocity: -1.0 }.motion();
        let search = Search { from: 0.05, to: 2.0, steps: 40, width: 1e-9 };
        let found = scan(&built.machine, &jump, &RunSettings::default(), &search);
        let least = found.flips[0].overturns_at();
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let burdens = burdens(&scene, &model, Vector3::x()).expect("masses");
        let shaken = |scale: f64| -> Shaken {
            let motion = jump.scaled(scale * least);
            let ground = Shaking { motion: &motion, axes: &axes, burdens: &burdens };
            let mut watch = |_: &Progress| ControlFlow::Continue(());
            let settings = SimulationSettings { seconds: Some(12.0), ..Default::default() };
            shake(&model, ground, &settings, &mut watch).expect("a history")
        };
        let overturns =
            [0.98, 1.02].map(|k| matches!(shaken(k).fate, ShakenFate::Overturned { .. }));
        assert_eq!(overturns, [false, true], "least {least}");
        let findings = shaken(0.1).findings;
        assert!(findings.is_empty(), "{findings:?}");
    }
}

#[test]
fn dead_loads_that_are_no_weights_are_told() {
    let mut scene = open("overturning-wall-with-floor.json");
    scene.loads.dead[0].massless = true;
    let question: Question = serde_json::from_value(json!({ "shake": {
        "ground": { "pulse": { "jump": { "velocity": 0.1 } } }, "fast": true, "seconds": 0.1
    } }))
    .expect("a question");
    let answer = ask(&question, &scene, &model(&scene), &Control::default()).expect("an answer");
    let Answer::Shake(s) = answer else { panic!("another answer") };
    assert!(s.shaken.findings[0].text.contains("not weights"), "{:?}", s.shaken.findings);
}
