//! What the command line refuses or answers, a sweep refuses or answers as well, in the same words.

use super::{block, command::expect_in};
use serde_json::{Value, json};
use std::{fs, path::Path, process::Command};

fn voussoir(folder: &Path, args: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_voussoir")).args(args).current_dir(folder).output().unwrap()
}

/// A folder with the scene and a plan of two rows, which differ in nothing that matters.
fn desk(scene: &Value, question: Value) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let plan = json!({
        "format": "voussoir-sweep/1", "scene": "scene.json", "question": question,
        "vary": [{ "pointer": "/materials/other/density", "from": 2000, "to": 2100, "count": 2 }]
    });
    fs::write(folder.path().join("scene.json"), scene.to_string()).unwrap();
    fs::write(folder.path().join("plan.json"), plan.to_string()).unwrap();
    folder
}

fn rows(folder: &Path, code: i32) -> Vec<Value> {
    expect_in(code, voussoir(folder, &["sweep", "plan.json", "-o", "rows.jsonl", "--quiet"]));
    let text = fs::read_to_string(folder.join("rows.jsonl")).unwrap();
    text.lines().skip(1).map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn said(output: &std::process::Output) -> String {
    String::from_utf8_lossy(&output.stderr).split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_thrust_on_a_support_that_touches_nothing() {
    let mut scene = block();
    let far = json!({ "id": "far", "shape": { "box": { "size": [1, 1, 1] } }, "at": [50, 0, 0], "support": true });
    scene["blocks"].as_array_mut().unwrap().push(far);
    for (support, direction, words) in [
        ("far", "1,0", "support far touches no free block"),
        ("block", "1,0", "support block: this block is not a support"),
        ("nobody", "1,0", "support nobody: there is no such block"),
        ("table", "0,0,1", "is parallel to gravity"),
    ] {
        let numbers: Vec<f64> =
            direction.split(',').map(|n| n.parse().unwrap()).chain([0.0]).take(3).collect();
        let folder =
            desk(&scene, json!({ "thrust": { "support": support, "direction": numbers } }));
        let verb = expect_in(
            2,
            voussoir(
                folder.path(),
                &["thrust", "scene.json", "--support", support, "--direction", direction],
            ),
        );
        assert!(said(&verb).contains(words), "{}", said(&verb));
        for row in rows(folder.path(), 3) {
            let error = row["error"].as_str().unwrap_or_else(|| panic!("answered: {row}"));
            assert!(error.contains(words), "{error}");
        }
    }
}

#[test]
fn options_outside_their_range() {
    for (question, verb, key) in [
        (json!({ "repose": { "moving_mass": 7 } }), &["--moving-mass", "7"][..], "moving_mass"),
        (json!({ "repose": { "moving_mass": -0.1 } }), &["--moving-mass", "-0.1"], "moving_mass"),
        (json!({ "repose": { "all": 0 } }), &["--all", "0"], "all"),
        (
            json!({ "repose": { "all": 4, "toward": [[1, 0, 0]] } }),
            &["--all", "4", "--toward", "1,0"],
            "all",
        ),
    ] {
        let folder = desk(&block(), question);
        expect_in(2, voussoir(folder.path(), &[&["repose", "scene.json"], verb].concat()));
        let plan =
            expect_in(2, voussoir(folder.path(), &["sweep", "plan.json", "-o", "rows.jsonl"]));
        assert!(said(&plan).contains(&format!("question.repose.{key}")), "{}", said(&plan));
        assert!(!folder.path().join("rows.jsonl").exists());
    }
}

/// A live load above the centre of mass turns with its block; in time its arm counts.
#[test]
fn a_simulation_under_a_load_factor() {
    let mut scene = block();
    scene["loads"] =
        json!({ "live": [{ "block": "block", "at": [0.19, 0, 1], "force": [1000, 0, 0] }] });
    for factor in [0.5, 6.0] {
        let folder = desk(&scene, json!({ "simulate": { "load_factor": factor } }));
        let verb = voussoir(
            folder.path(),
            &["simulate", "scene.json", "--load-factor", &factor.to_string(), "--json"],
        );
        let fate = serde_json::from_slice::<Value>(&verb.stdout).unwrap()["answer"]["fate"].clone();
        let wanted = if fate == "stands" { "stable" } else { "unstable" };
        for row in rows(folder.path(), 0) {
            assert_eq!(row["status"], wanted, "{row}");
        }
    }
}
