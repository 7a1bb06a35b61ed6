//! What a plan cannot mean is refused at once, with its place and a remedy.

use super::{arch, block};
use serde_json::{Value, json};
use std::fs;
use voussoir::{
    error::InputError,
    sweep::{Sweep, open},
};

fn read(plan: &Value, scene: &Value) -> Result<Sweep, InputError> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), scene.to_string()).unwrap();
    fs::write(folder.path().join("plan.json"), serde_json::to_string_pretty(plan).unwrap())
        .unwrap();
    open(&folder.path().join("plan.json"))
}

fn good() -> Value {
    json!({
        "format": "voussoir-sweep/1",
        "scene": "scene.json",
        "question": { "limit": {} },
        "vary": [{ "pointer": "/joints/default/friction", "from": 0.2, "to": 0.7, "count": 3 }],
        "sampling": { "grid": {} },
        "seed": 1
    })
}

#[track_caller]
fn refused(change: impl FnOnce(&mut Value), scene: &Value, words: &[&str]) {
    let mut plan = good();
    change(&mut plan);
    let error = read(&plan, scene).expect_err("refused");
    let text = error.to_string();
    assert!(error.position.is_some(), "{text}");
    for word in words {
        assert!(text.contains(word), "{text} lacks {word:?}");
    }
}

#[test]
fn wrong_plans_are_refused_with_place_and_remedy() {
    let s = block();
    assert_eq!(read(&good(), &s).unwrap().rows(), 3);
    refused(
        |p| p["vary"][0]["pointer"] = json!("/joints/default/fricton"),
        &s,
        &["plan.json:9:18: vary[0].pointer", "unknown field `fricton`"],
    );
    refused(
        |p| p["vary"][0]["pointer"] = json!("/materials/stome/density"),
        &s,
        &["vary[0].pointer", "did you mean \"stone\""],
    );
    refused(
        |p| p["vary"][0]["pointer"] = json!("/blocks/7/density"),
        &s,
        &["none of the 2 elements"],
    );
    refused(
        |p| p["vary"][0]["pointer"] = json!("/blocks/0/id"),
        &s,
        &["blocks[0].id of the scene is not a number"],
    );
    refused(|p| p["vary"][0]["pointer"] = json!("joints"), &s, &["not a JSON pointer"]);
    refused(|p| p["vary"][0]["to"] = json!(0.1), &s, &["vary[0].to", "empty"]);
    refused(|p| p["vary"][0]["count"] = json!(0), &s, &["vary[0].count"]);
    refused(|p| p["vary"][0]["cuont"] = json!(3), &s, &["vary[0].cuont", "did you mean \"count\""]);
    refused(|p| p["vary"] = json!([]), &s, &["vary", "nothing varies"]);
    refused(
        |p| p["vary"] = json!([p["vary"][0], p["vary"][0]]),
        &s,
        &["vary[1].pointer", "varies twice"],
    );
    refused(|p| p["vary"][0]["count"] = json!(100_000_000), &s, &["more than 2000000 rows"]);
    refused(
        |p| p["sampling"] = json!({ "random": { "samples": 10 } }),
        &s,
        &["vary[0].count", "applies to a grid only"],
    );
    refused(|p| p["question"] = json!({ "guess": {} }), &s, &["question.guess", "assess"]);
    refused(
        |p| p["question"] = json!({ "tilt": { "toward": [[1, 0, 0]], "all": 4 } }),
        &s,
        &["question.tilt.all"],
    );
    refused(|p| p["scene"] = json!("none.json"), &s, &["plan.json:3:", "scene", "cannot be read"]);
    refused(|p| p["format"] = json!("voussoir-scene/1"), &s, &["not a plan"]);
    // Options without any effect in rows.
    for (question, key, remedy) in [
        (json!({ "limit": { "skip_dead": true } }), "question.limit.skip_dead", "remove it"),
        (json!({ "tilt": { "skip_dead": true } }), "question.tilt.skip_dead", "remove it"),
        (json!({ "thrust": { "range": true } }), "question.thrust.range", "two plans give both"),
    ] {
        refused(|p| p["question"] = question, &s, &[key, "has no effect in the rows", remedy]);
    }
    // Words that the scene does not know, and numbers where words are.
    let words = |pointer: &str, values: Value| json!([{ "pointer": pointer, "values": values }]);
    let mut pushed = block();
    pushed["loads"]["live"] = json!([{ "block": "block", "force": [1, 0, 0] }]);
    refused(
        |p| p["vary"] = words("/loads/live/0/block", json!(["block", "blok"])),
        &pushed,
        &["vary[0].values[1]", "blok", "did you mean \"block\""],
    );
    refused(
        |p| p["vary"] = words("/loads/live/0/force", json!(["block"])),
        &pushed,
        &["vary[0].pointer", "not a word"],
    );
    refused(
        |p| p["vary"] = words("/joints/default/friction", json!([0.5, "rough"])),
        &s,
        &["vary[0].values[1]", "rough"],
    );
    refused(
        |p| p["vary"] = words("/loads/live/0/block", json!([1, 2])),
        &pushed,
        &["not a number", "list words to vary as \"values\""],
    );
    let mut still = block();
    still["loads"] = json!({});
    refused(|_| {}, &still, &["question", "no live load"]);
    refused(
        |p| {
            p["vary"][0] =
                json!({ "pointer": "/templates/0/arch/voussoirs", "from": 5, "to": 8, "count": 3 })
        },
        &arch(),
        &["\"round\": true"],
    );
    for samples in [0, 100_000] {
        refused(
            |p| {
                p["vary"][0].as_object_mut().unwrap().remove("count");
                p["sampling"] = json!({ "sobol": { "samples": samples } });
            },
            &s,
            &["sampling.sobol"],
        );
    }
}

#[test]
fn a_key_that_the_scene_leaves_out_may_vary() {
    let mut plan = good();
    plan["vary"] = json!([{ "pointer": "/joints/default/cohesion", "values": [0, 1000] }, { "pointer": "/blocks/1/density", "values": [2000] }]);
    let sweep = read(&plan, &block()).unwrap();
    let scene = sweep.scene_with(&sweep.parameters(1)).unwrap();
    assert_eq!(
        (scene.joints.default.cohesion, scene.blocks[1].density),
        (Some(1000.0), Some(2000.0))
    );
}

#[test]
fn a_scene_with_a_mistake_is_told_as_such() {
    let mut scene = block();
    scene["blocks"][0]["shpae"] = json!(1);
    let error = read(&good(), &scene).expect_err("refused").to_string();
    assert!(error.contains("scene.json:1:") && error.contains("shpae"), "{error}");
}

#[test]
fn the_schema_knows_every_key_of_a_plan() {
    let schema = voussoir::sweep::schema();
    let keys: Vec<&String> = schema["properties"].as_object().unwrap().keys().collect();
    assert_eq!(
        keys,
        ["format", "name", "scene", "question", "vary", "sampling", "seed", "records"]
    );
    assert!(schema.to_string().contains("latin_hypercube"));
}
