//! The scenes of `structures/`: read, complete, listed.

use super::*;
use crate::{Scene, read_file};
use std::{collections::BTreeMap, path::PathBuf};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../structures")
}

/// Every scene by its file name.
fn scenes() -> BTreeMap<String, Scene> {
    let mut scenes = BTreeMap::new();
    for entry in std::fs::read_dir(folder()).expect("structures/") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if name.ends_with(".json") && name != "expected.json" {
            let (scene, _) = read_file(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
            scenes.insert(name, scene);
        }
    }
    scenes
}

#[test]
fn every_structure_has_a_name_a_source_and_blocks_with_references_that_resolve() {
    let scenes = scenes();
    assert!(scenes.len() >= 27, "{}", scenes.len());
    for (file, scene) in scenes {
        assert!(!scene.name.is_empty() && !scene.source.is_empty(), "{file}");
        let mut blocks = scene.blocks.clone();
        for template in &scene.templates {
            blocks.extend(expand(template).unwrap_or_else(|e| panic!("{file}: {e}")));
        }
        assert!(blocks.iter().any(|b| b.support) && blocks.iter().any(|b| !b.support), "{file}");
        let ids: HashSet<_> = blocks.iter().map(|b| b.id.as_str()).collect();
        assert_eq!(ids.len(), blocks.len(), "{file}: ids twice");
        let named =
            scene.loads.live.iter().chain(&scene.loads.dead).filter_map(|l| l.block.as_deref());
        let named =
            named.chain(scene.interfaces.iter().flat_map(|i| i.between.iter().map(String::as_str)));
        let named = named.chain(
            scene
                .joints
                .overrides
                .iter()
                .flat_map(|o| o.blocks.iter().flatten().map(String::as_str)),
        );
        for id in named {
            assert!(ids.contains(id), "{file}: no block {id}");
        }
        for block in blocks {
            assert!(
                block.material.is_none_or(|m| scene.materials.contains_key(&m)),
                "{file}: material of {}",
                block.id
            );
        }
    }
}

#[test]
fn expected_answers_and_the_table_list_every_structure_once() {
    let text = std::fs::read_to_string(folder().join("expected.json")).expect("expected.json");
    let table = std::fs::read_to_string(folder().join("README.md")).expect("README.md");
    let expected: Vec<serde_json::Value> = serde_json::from_str(&text).expect("JSON");
    let files: Vec<_> =
        expected.iter().map(|e| e["file"].as_str().expect("a file").to_owned()).collect();
    let mut sorted = files.clone();
    sorted.sort();
    assert_eq!(sorted, scenes().into_keys().collect::<Vec<_>>());
    for (file, entry) in files.iter().zip(&expected) {
        assert_eq!(table.matches(&format!("]({file})")).count(), 1, "{file}");
        let expect = &entry["expect"];
        let complete = match entry["question"].as_str() {
            Some("assess") => expect["verdict"].is_string(),
            Some("limit" | "moving") => {
                expect["load_factor"].is_number() && expect["tolerance_rel"].is_number()
                    || expect["load_factor_status"].is_string()
            }
            Some("tilt") => {
                expect["tilt_deg"].is_number()
                    && expect["tolerance_rel"].is_number()
                    && entry["toward"].is_array()
            }
            _ => false,
        };
        assert!(complete, "{entry}");
        assert!(entry["source"].as_str().is_some_and(|s| !s.is_empty()), "{file}");
    }
}
