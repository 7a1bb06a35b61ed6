//! Pages a reader gets through, and that do not contradict each other.

use std::path::{Path, PathBuf};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")
}

/// Pages for readers, without the reference of keys and the measurements.
fn pages() -> Vec<(PathBuf, String)> {
    let mut list: Vec<PathBuf> = ["", "guide"]
        .iter()
        .flat_map(|folder| std::fs::read_dir(docs().join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "md") && !p.ends_with("keys.md"))
        .collect();
    list.sort();
    list.into_iter().map(|p| (p.clone(), std::fs::read_to_string(p).unwrap())).collect()
}

#[test]
fn no_page_is_longer_than_one_sitting() {
    for (path, text) in pages() {
        let words = text.split_whitespace().count();
        assert!(words <= 2500, "{}: {words} words", path.display());
    }
}

/// What has a page of its own, or a key, is not said to be left out elsewhere.
#[test]
fn no_page_denies_what_another_explains() {
    let features = [
        "elastic joints",
        "deformable joints",
        "backing",
        "haunching",
        "stages",
        "ground motion",
        "ties",
        "strips",
        "grains",
        "trains",
        "fill",
        "crushing",
        "mortar",
    ];
    let denied = ["are not modelled", "is not modelled", "are not supported", "is not supported"];
    for (path, text) in pages() {
        for line in text.split(['.', '\n']).map(str::to_lowercase) {
            let denies = denied.iter().any(|d| line.contains(d));
            let named = features.iter().find(|f| {
                line.contains(&format!("{f} are not")) || line.contains(&format!("{f} is not"))
            });
            assert!(!denies || named.is_none(), "{}: {line:?}", path.display());
        }
    }
}

/// One term a thing: words that were given up do not come back.
#[test]
fn words_that_were_given_up_do_not_come_back() {
    for (path, text) in pages().into_iter().filter(|(p, _)| !p.ends_with("glossary.md")) {
        let lower = text.to_lowercase();
        for word in ["unbalance ", "pre-stress", "joints that yield", "a pre-stress"] {
            assert!(!lower.contains(word), "{}: {word:?}", path.display());
        }
    }
}
