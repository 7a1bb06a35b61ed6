//! A second checker, in another language, says what the first says: of honest results and of ones
//! whose evidence was changed and whose answer is the one that follows.

use serde_json::{Value, json};
use std::{path::Path, process::Command};
use voussoir::{
    analysis::{AssessOptions, Law, LimitOptions, Question, ThrustOptions, TiltOptions},
    report::{self, inspection::Inspection},
};

const SCENES: [&str; 7] = [
    "semicircular-arch-thin",
    "arch-with-point-load",
    "block-in-groove",
    "flat-arch",
    "tetrahedral-pile",
    "two-block-column",
    "running-bond-wall",
];

fn questions() -> [Question; 4] {
    let law = Law::Associative;
    [
        Question::Assess(AssessOptions { law }),
        Question::Limit(LimitOptions { law, ..LimitOptions::default() }),
        Question::Tilt(TiltOptions { law, all: Some(3), ..TiltOptions::default() }),
        Question::Thrust(ThrustOptions { law, range: true, ..ThrustOptions::default() }),
    ]
}

/// 0: it holds, 1: it is refuted, 3: it is not judged.
fn recheck(folder: &Path, result: &Value) -> (i32, String) {
    let [file, model] = ["result.json", "model.json"].map(|name| folder.join(name));
    std::fs::write(&file, result.to_string()).unwrap();
    let tool = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/tools/recheck.py");
    let output = Command::new("python3").arg(tool).args([&file, &model]).output().unwrap();
    let said =
        String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), said)
}

#[test]
fn a_second_checker_says_the_same() {
    if !Command::new("python3").arg("--version").output().is_ok_and(|o| o.status.success()) {
        return crate::skipped("there is no python3 for the second checker");
    }
    let folder = tempfile::tempdir().unwrap();
    let (mut honest, mut refused) = (0, 0);
    for name in SCENES {
        let path = format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let scene = crate::ask::open(path.as_ref());
        let model = crate::ask::model(&scene);
        let resolved = report::json::pretty(&Inspection::new(&model)).unwrap();
        std::fs::write(folder.path().join("model.json"), resolved).unwrap();
        for question in questions() {
            let control = voussoir::analysis::Control::default();
            let answer = voussoir::analysis::ask(&question, &scene, &model, &control);
            let Ok(answer) = answer else { continue };
            let file = voussoir::proof::saved::of(&question, &scene, &model, &answer).unwrap();
            let good = file.to_value().unwrap();
            let (code, said) = recheck(folder.path(), &good);
            assert_eq!(code, 0, "{name} {}: {said}", question.word());
            honest += 1;
            // The largest number of its evidence is another.
            let mut bad = good.clone();
            let Some(place) = largest(&good["evidence"], "/evidence".into()) else { continue };
            let leaf = bad.pointer_mut(&place.1).unwrap();
            *leaf = json!(leaf.as_f64().unwrap() * 1.01);
            crate::ask::told(&mut bad);
            let saved = voussoir::proof::read::read_str("forged", bad.to_string()).unwrap();
            let first = voussoir::proof::verify(&saved, &scene).unwrap().refuted();
            let (code, said) = recheck(folder.path(), &bad);
            assert_eq!(code == 1, first, "{name} {} {}: {said}", question.word(), place.1);
            refused += usize::from(first);
        }
    }
    assert!(honest > 20 && refused > 15, "{honest} {refused}");
}

/// The greatest number among forces and rates, with its place.
fn largest(value: &Value, at: String) -> Option<(f64, String)> {
    let of = |found: Vec<(f64, String)>| found.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    match value {
        Value::Number(n) => Some((n.as_f64()?.abs(), at)),
        Value::Array(list) => of(list
            .iter()
            .enumerate()
            .filter_map(|(k, v)| largest(v, format!("{at}/{k}")))
            .collect()),
        Value::Object(map) => of(map
            .iter()
            .filter(|(k, _)| !["points", "claim", "dry", "shrunk"].contains(&k.as_str()))
            .filter_map(|(k, v)| largest(v, format!("{at}/{k}")))
            .collect()),
        _ => None,
    }
}
