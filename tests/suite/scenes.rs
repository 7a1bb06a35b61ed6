//! The scenes of `structures/`: each is read, resolved and asked its question of `expected.json`;
//! the answer is the one that stands there, and its result, saved and read back, is proved from the
//! scene alone.

use crate::ask::{self, close};
use serde_json::Value;
use std::{collections::BTreeSet, path::PathBuf};
use voussoir::{
    analysis::{Law, Outcome},
    scene::Scene,
};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("structures")
}

fn expected() -> Vec<Value> {
    let text =
        std::fs::read_to_string(folder().join("expected.json")).expect("structures/expected.json");
    serde_json::from_str(&text).expect("JSON")
}

fn open(entry: &Value) -> (String, Scene) {
    let file = entry["file"].as_str().expect("a file").to_owned();
    let scene = ask::open(&folder().join(&file));
    (file, scene)
}

fn asked(question: &str, least: usize, check: impl Fn(&str, &Scene, &Value)) {
    let mut count = 0;
    for entry in expected().iter().filter(|e| e["question"] == question) {
        let (file, scene) = open(entry);
        check(&file, &scene, entry);
        count += 1;
    }
    assert!(count >= least, "only {count} scenes are asked {question}");
}

fn tolerance(entry: &Value) -> f64 {
    entry["expect"]["tolerance_rel"].as_f64().expect("a tolerance")
}

#[test]
fn verdicts_are_those_expected_and_proved() {
    asked("assess", 25, |file, scene, entry| {
        let want = entry["expect"]["verdict"].as_str().expect("a verdict");
        let got = serde_json::to_value(ask::verdict(scene, Law::Coulomb)).expect("a word");
        assert_eq!(got, want, "{file}");
    });
}

#[test]
fn load_factors_are_those_expected_and_proved() {
    asked("limit", 20, |file, scene, entry| {
        let (outcome, value) = ask::outcome(scene);
        match entry["expect"]["load_factor_status"].as_str() {
            Some(status) => {
                assert_eq!(serde_json::to_value(outcome).expect("a word"), status, "{file}")
            }
            None => {
                assert_eq!(outcome, Outcome::Found, "{file}");
                close(
                    file,
                    value.unwrap(),
                    entry["expect"]["load_factor"].as_f64().expect("a number"),
                    tolerance(entry),
                );
            }
        }
    });
}

#[test]
fn trains_weigh_what_is_expected_and_proved() {
    asked("moving", 1, |file, scene, entry| {
        let got = ask::moving(scene);
        let want = entry["expect"]["load_factor"].as_f64().expect("a number");
        close(file, got, want, tolerance(entry));
    });
}

#[test]
fn tilts_are_those_expected_and_proved() {
    asked("tilt", 2, |file, scene, entry| {
        let toward = [0, 1].map(|k| entry["toward"][k].as_f64().expect("a direction"));
        let got = ask::tilt_deg(scene, [toward[0], toward[1], 0.0]);
        close(file, got, entry["expect"]["tilt_deg"].as_f64().expect("a number"), tolerance(entry));
    });
}

#[test]
fn every_scene_is_listed_with_its_answer() {
    let table = std::fs::read_to_string(folder().join("README.md")).expect("structures/README.md");
    let files: BTreeSet<String> = std::fs::read_dir(folder())
        .expect("structures/")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".json") && name != "expected.json")
        .collect();
    let asked: BTreeSet<String> = expected().iter().map(|e| open(e).0).collect();
    assert_eq!(files, asked, "files of structures/ against expected.json");
    for file in &files {
        assert!(table.contains(&format!("]({file})")), "{file} is not in structures/README.md");
    }
    assert!(
        table.contains(&format!("{} scenes", files.len())),
        "structures/README.md does not say that there are {} scenes",
        files.len()
    );
}
