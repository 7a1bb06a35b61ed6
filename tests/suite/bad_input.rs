//! Whatever a file holds, the program answers with a clear error (exit code 2), a finding, or a
//! verdict; it never panics.

use proptest::prelude::*;
use serde_json::{Value, json};
use std::{
    path::Path,
    process::{Command, Output, Stdio},
};
use voussoir::{
    analysis::{Control, assess},
    error::FindingCode,
    interface::prepare,
    proof::saved,
    scene::{Scene, read_bytes, read_str},
    verdict::Verdict,
};

fn run(args: &[&str], stdin: &str, folder: &Path) -> Output {
    use std::io::Write;
    let mut child = Command::new(env!("CARGO_BIN_EXE_voussoir"))
        .args(args)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that refuses early closes its end: that is no failure of the test.
    let _ = child.stdin.take().unwrap().write_all(stdin.as_bytes());
    child.wait_with_output().unwrap()
}

fn base() -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "stone": { "density": 2400 } },
        "joints": { "default": { "friction": 0.7 } },
        "blocks": [
            { "id": "ground", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "block", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 0.5], "material": "stone" }
        ]
    })
}

/// The scene with the value at a JSON pointer replaced.
fn with(pointer: &str, value: Value) -> String {
    let mut scene = base();
    match scene.pointer_mut(pointer) {
        Some(place) => *place = value,
        None => {
            let (parent, key) = pointer.rsplit_once('/').unwrap();
            scene.pointer_mut(parent).unwrap()[key] = value;
        }
    }
    scene.to_string()
}

#[test]
fn mistakes_are_errors_with_place_and_remedy_and_nothing_is_written() {
    let cases: Vec<(String, &str)> = vec![
        (String::new(), "empty"),
        (base().to_string()[..100].to_string(), "ends"),
        ("[1, 2".into(), "JSON object"),
        ("hello".into(), "expected"),
        ("{}".into(), "format"),
        (with("/format", json!("voussoir-scene/9")), "voussoir-scene/1"),
        (with("/frction", json!(1)), "frction"),
        (with("/blocks/1/densty", json!(1)), "did you mean \"density\""),
        (with("/blocks/1/material", json!("stoan")), "stoan"),
        (with("/blocks/1/density", json!(0)), "must be > 0"),
        (with("/blocks/1/density", json!(-2400)), "must be > 0"),
        (with("/blocks/1/mass", json!(-1)), "must be > 0"),
        (with("/blocks/1/id", json!("ground")), "ground"),
        (with("/blocks/1/at", json!([0, 0])), "blocks[1].at"),
        (with("/blocks/1/at", json!("here")), "blocks[1].at"),
        (base().to_string().replace("[0,0,0.5]", "[0,0,NaN]"), "NaN"),
        (base().to_string().replace("[0,0,0.5]", "[0,0,1e999]"), "number"),
        (with("/blocks/0/support", json!(false)), "support"),
        (with("/blocks/1/support", json!(true)), "all of the 2 blocks are supports"),
        (with("/blocks", json!([])), "blocks"),
        (with("/joints/default/friction", json!(-0.1)), "friction"),
        (with("/joints/default/friction", json!("lots")), "infinite"),
        (with("/joints", json!({})), "friction"),
        (with("/gravity", json!([0, 0, 0])), "gravity"),
        (with("/contact", json!({ "gap": -1 })), "gap"),
        (with("/blocks/1/shape", json!({ "box": { "size": [1, 0, 1] } })), "size"),
        (with("/blocks/1/shape", json!({ "sphere": { "radius": -1 } })), "radius"),
        (with("/blocks/1/shape", json!({ "ball": { "radius": 1 } })), "ball"),
        (
            with(
                "/blocks/1/shape",
                json!({ "prism": { "polygon": [[0, 0], [1, 1], [1, 0], [0, 1]], "depth": 1 } }),
            ),
            "polygon",
        ),
        (
            with(
                "/blocks/1/shape",
                json!({ "polyhedron": { "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 1, 9], [0, 1, 3], [1, 2, 3], [0, 2, 3]] } }),
            ),
            "9",
        ),
        (
            with(
                "/blocks/1/shape",
                json!({ "polyhedron": { "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3]] } }),
            ),
            "open",
        ),
        (with("/loads", json!({ "live": [{ "block": "nobody", "force": [1, 0, 0] }] })), "nobody"),
        (with("/loads", json!({ "dead": [{ "block": "ground", "force": [1, 0, 0] }] })), "support"),
        (
            with(
                "/templates",
                json!([{ "wall": { "size": [1, 1, 1], "courses": 1000000000, "blocks": 1000000000 } }]),
            ),
            "wall",
        ),
        (
            with(
                "/templates",
                json!([{ "arch": { "radius": 1, "thickness": 5, "depth": 1, "voussoirs": 9 } }]),
            ),
            "thickness",
        ),
    ];
    let folder = tempfile::tempdir().unwrap();
    let mut wrong = Vec::new();
    for (text, word) in &cases {
        let out = run(&["assess", "-", "--save", "result.json"], text, folder.path());
        let error = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(2), "{text}\n{error}");
        if !error.contains(word) {
            wrong.push(format!("{word:?} is not in {error:?} for {text}"));
        }
        assert!(error.starts_with("error: ") && !error.contains("panicked"), "{error}");
        assert!(out.stdout.is_empty());
        assert_eq!(
            std::fs::read_dir(folder.path()).unwrap().count(),
            0,
            "a file was left behind for {text}"
        );
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn a_floating_block_falls_at_once_and_is_named() {
    let text = with("/blocks/1/at", json!([0, 0, 3]));
    let folder = tempfile::tempdir().unwrap();
    let out = run(&["assess", "-"], &text, folder.path());
    assert_eq!(out.status.code(), Some(1));
    let said = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(said.contains("falls") && said.contains("block"), "{said}");
    let (scene, _) = read_str("test", text).unwrap();
    let m = prepare(&scene).unwrap();
    let a = assess(&m, &Control::default());
    assert!(a.attempts.is_empty(), "no program is needed");
    assert_eq!(a.floating, vec![vec![1]]);
}

#[test]
fn mistakes_of_units_are_told() {
    for (pointer, value) in [
        ("/blocks/1/shape", json!({ "box": { "size": [1e6, 1e6, 1e6] } })),
        ("/blocks/1/density", json!(2.4e9)),
        ("/gravity", json!([0, 0, -9.81e6])),
    ] {
        let (scene, _) = read_str("test", with(pointer, value)).unwrap();
        let m = prepare(&scene).unwrap();
        assert!(m.findings().any(|f| f.code == FindingCode::Units), "{pointer}");
    }
}

/// An error, or an answer that verifies from its own file, or undecided.
fn answered(scene: &Scene) {
    let Ok(m) = prepare(scene) else { return };
    let a = assess(
        &m,
        &Control { deadline: voussoir::deadline::Deadline::within(10.0), ..Control::default() },
    );
    let file = saved::assessment(scene, &m, &a).unwrap();
    if file.answer.verdict() != Some(Verdict::Undecided) {
        let found = crate::ask::check(scene, &file);
        assert!(found.proved(), "{scene:?}: {:?}", found.parts);
    }
}

#[test]
fn extreme_numbers_are_errors_or_answers() {
    let mut texts = vec![
        with("/blocks/1/shape", json!({ "box": { "size": [1e-5, 1, 1e5] } })),
        with("/blocks/1/at", json!([0, 0, -0.5])),
        with("/blocks/1/at", json!([0, 0, -0.2])),
        with("/blocks/1/density", json!(1e33)),
        with("/blocks/1/density", json!(1e-30)),
        with("/loads", json!({ "dead": [{ "block": "block", "force": [0, 0, 1e300] }] })),
        with(
            "/loads",
            json!({ "dead": [{ "block": "block", "force": [0, 0, -1e20], "at": [0.4, 0, 1] }] }),
        ),
        with("/joints/default/friction", json!(1e308)),
        with("/joints/default/friction", json!(1e-300)),
    ];
    for big in [1e300, 1e150, 1e20, 1e-20, 1e-150, 1e-300] {
        texts.push(with("/gravity", json!([0, 0, -big])));
        texts.push(with("/blocks/1/at", json!([big, 0, 0.5])));
        texts.push(with("/blocks/1/shape", json!({ "box": { "size": [big, big, big] } })));
        texts.push(with("/blocks/1/shape", json!({ "sphere": { "radius": big } })));
        texts.push(with("/blocks/1/mass", json!(big)));
    }
    let twins: Vec<Value> =
        (0..300).map(|k| json!({ "id": format!("t{k}"), "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 0.5] })).collect();
    let mut same = base();
    same["blocks"].as_array_mut().unwrap().extend(twins);
    texts.push(same.to_string());
    for text in texts {
        if let Ok((scene, _)) = read_str("test", text.as_str()) {
            answered(&scene);
        }
    }
}

fn structures() -> Vec<Vec<u8>> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/structures");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "json"))
        .collect();
    files.sort();
    files
        .iter()
        .map(|p| std::fs::read(p).unwrap())
        .filter(|b| b.len() < 20_000 && !b.windows(4).any(|w| w == b"1000"))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn damaged_scenes_never_panic(which in any::<prop::sample::Index>(), cut in any::<prop::sample::Index>(), edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4), truncate in proptest::bool::weighted(0.3)) {
        let files = structures();
        let mut bytes = files[which.index(files.len())].clone();
        for (at, byte) in &edits {
            let at = at.index(bytes.len());
            // Digits often, so that many damaged scenes are still read.
            bytes[at] = if byte % 2 == 0 { b'0' + byte % 10 } else { *byte };
        }
        if truncate {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok((scene, _)) = read_bytes("damaged", bytes) {
            answered(&scene);
        }
    }
}
