//! The gallery: every scene of `structures/` with its drawing, as the command of the page draws it.

use serde_json::Value;
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    process::Command,
};

/// What the page calls too large to be drawn in it, bytes.
const LARGE: usize = 100_000;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The command that draws a scene, as the page has it.
fn command(entry: &Value, name: &str, drawing: &Path) -> Vec<String> {
    let question = entry["question"].as_str().unwrap();
    let toward: Vec<String> =
        entry["toward"].as_array().into_iter().flatten().map(Value::to_string).collect();
    let asked: &[&str] = match question {
        "moving" => &["limit", "--moving"],
        other => &[other],
    };
    let scene = format!("structures/{name}.json");
    let drawn = drawing.to_string_lossy();
    let mut list: Vec<String> = asked.iter().map(|w| w.to_string()).collect();
    list.extend([&scene, "--law", "associative", "--quiet", "--svg", &drawn].map(String::from));
    if question == "tilt" {
        list.extend(["--toward".into(), toward.join(",")]);
    }
    list
}

#[test]
fn every_scene_is_drawn_as_its_command_draws_it() {
    let text = std::fs::read_to_string(root().join("structures/expected.json")).unwrap();
    let list: Vec<Value> = serde_json::from_str(&text).unwrap();
    let page = std::fs::read_to_string(root().join("docs/gallery.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let (mut drawn, mut wrong) = (BTreeSet::new(), Vec::new());
    for entry in &list {
        let name = entry["file"].as_str().unwrap().trim_end_matches(".json");
        assert!(page.contains(&format!("../structures/{name}.json")), "the page lacks {name}");
        let kept = root().join(format!("docs/gallery/{name}.svg"));
        // Those of thousands of blocks are asked elsewhere.
        if page.contains(&format!("[{name}](../structures")) && !kept.exists() {
            continue;
        }
        let drawing = folder.path().join(format!("{name}.svg"));
        let words = command(entry, name, &drawing);
        let output = Command::new(env!("CARGO_BIN_EXE_voussoir"))
            .current_dir(root())
            .args(&words)
            .output()
            .unwrap();
        let made = std::fs::read(&drawing).unwrap_or_else(|e| {
            panic!("{words:?}: {e}: {}", String::from_utf8_lossy(&output.stderr))
        });
        assert!(made.len() < LARGE, "{name} is large: {} bytes", made.len());
        if std::fs::read(&kept).ok() != Some(made) {
            wrong.push(format!("voussoir {}", command(entry, name, &kept).join(" ")));
        }
        drawn.insert(format!("{name}.svg"));
    }
    assert!(wrong.is_empty(), "drawings of the gallery are to be made anew:\n{}", wrong.join("\n"));
    for entry in std::fs::read_dir(root().join("docs/gallery")).unwrap() {
        let name = entry.unwrap().file_name().to_string_lossy().into_owned();
        assert!(drawn.contains(&name), "{name} is the drawing of no scene");
    }
}
