//! Meshes as they come: one file for each thing that can be wrong with one (`tests/meshes`), with
//! what has to be said about it.
//!
//! A file begins with a sentence in a comment; the comments after it are what is expected of the
//! block called `stone`: `silent` (nothing is said), `said: …` (a finding with these words),
//! `refused: …` (an error with these words, and a remedy), `volume: …` in m³.

use std::path::{Path, PathBuf};
use voussoir::{
    analysis::{Control, assess},
    error::FindingCode,
    import::{ImportOptions, import_bytes},
    interface::prepare,
    scene::Friction,
};

fn corpus() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    files
}

/// What is not as it was expected of one file.
fn differences(text: &str) -> Vec<String> {
    let expected: Vec<&str> = text.lines().map_while(|l| l.strip_prefix("# ")).skip(1).collect();
    let mut wrong = Vec::new();
    let options = ImportOptions {
        friction: Some(Friction::Coefficient(0.6)),
        density: Some(1.0),
        supports: vec!["ground".into()],
        ..ImportOptions::default()
    };
    let result = import_bytes("mesh.obj", text.as_bytes(), &options)
        .and_then(|imported| prepare(&imported.scene));
    let model = match result {
        Ok(model) => model,
        Err(e) => {
            if e.hint.is_none() {
                wrong.push(format!("no remedy: {e}"));
            }
            match expected[..] {
                [one]
                    if one
                        .strip_prefix("refused: ")
                        .is_some_and(|words| e.to_string().contains(words.trim())) => {}
                _ => wrong.push(format!("refused: {e}")),
            }
            return wrong;
        }
    };
    // Density 1 kg/m³ is a mistake of units on purpose: masses are volumes.
    let said: Vec<&str> = model
        .findings()
        .filter(|f| !f.text.contains("density of 1.000e0"))
        .map(|f| f.text.as_str())
        .collect();
    let stone = &model.assembly.blocks[model.assembly.find("stone").unwrap()];
    for line in expected {
        let fits = match line.split_once(": ").unwrap_or((line, "")) {
            ("silent", _) => said.is_empty(),
            ("said", words) => said.iter().any(|s| s.contains(words)),
            ("volume", number) => {
                let volume: f64 = number.parse().unwrap();
                (stone.mass / volume - 1.0).abs() < 1e-6
            }
            _ => false,
        };
        if !fits {
            wrong.push(format!("{line}; but: {said:?}, volume {}", stone.mass));
        }
    }
    // Whatever it is, a question about it has an answer.
    assess(
        &model,
        &Control { deadline: voussoir::deadline::Deadline::within(10.0), ..Control::default() },
    );
    wrong
}

#[test]
fn every_bad_mesh_is_mended_with_a_word_or_refused_with_the_reason() {
    let files = corpus();
    assert!(files.len() >= 35, "{}", files.len());
    let mut wrong = Vec::new();
    for file in files {
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let found = differences(&std::fs::read_to_string(&file).unwrap());
        wrong.extend(found.into_iter().map(|text| format!("{name}: {text}")));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn what_is_expected_of_a_mesh_is_really_compared() {
    let good = std::fs::read_to_string(corpus().iter().find(|p| p.ends_with("good.obj")).unwrap())
        .unwrap();
    assert_eq!(differences(&good), [""; 0]);
    assert_eq!(differences(&good.replace("volume: 6", "volume: 7")).len(), 1);
    assert_eq!(differences(&good.replace("silent", "said: something")).len(), 1);
    assert_eq!(differences(&good.replace("silent", "refused: something")).len(), 1);
}

#[test]
fn real_files_with_open_edges_are_refused_with_the_place_of_one() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/compas/rb3d-stones");
    let list = std::fs::read_dir(&folder).unwrap();
    let mut count = 0;
    for path in
        list.map(|e| e.unwrap().path()).filter(|p| p.extension().is_some_and(|e| e == "ply"))
    {
        count += 1;
        let options = ImportOptions {
            friction: Some(Friction::Coefficient(0.6)),
            ..ImportOptions::default()
        };
        let mut imported =
            voussoir::import::import_file(&path, &options).unwrap_or_else(|e| panic!("{e}"));
        // A table under the stone, so that there is something to prepare.
        let mut table = imported.scene.blocks[0].clone();
        table.id = "table".into();
        table.support = true;
        table.shape = voussoir::scene::Shape::Cuboid { size: [1.0; 3] };
        table.at = [1e3, 0.0, 0.0];
        imported.scene.blocks.push(table);
        match prepare(&imported.scene) {
            Ok(model) => assert!(
                model.findings().any(|f| f.code == FindingCode::Mended),
                "{}: nothing is said",
                path.display()
            ),
            Err(e) => assert!(
                e.to_string().contains("open") && e.hint.is_some(),
                "{}: {e}",
                path.display()
            ),
        }
    }
    assert!(count >= 3, "{count}");
}
