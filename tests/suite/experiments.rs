//! Predictions against laboratory tests: the page prints what the command finds, and a group that is
//! wrong is refused with the place.

use std::path::{Path, PathBuf};
use voussoir::study::experiments::{Compared, compare, groups, ratios};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn corpus() -> PathBuf {
    root().join("structures/experiments")
}

/// Every comparison stands on the page, with its numbers.
fn stands_on_the_page(list: &[Compared]) {
    let page = std::fs::read_to_string(root().join("docs/validation.md")).unwrap();
    let rows: Vec<Vec<String>> = page
        .lines()
        .filter(|l| l.starts_with("| "))
        .map(|l| l.split('|').map(|cell| cell.trim().to_string()).collect())
        .collect();
    let number = |cell: &str| cell.split(' ').next().unwrap().parse::<f64>().ok();
    for c in list {
        let named = |row: &&Vec<String>| {
            let place = row.get(2).and_then(|t| t.split(" at ").nth(1)).and_then(number);
            let here = match (c.at, place) {
                (None, None) => true,
                (Some(at), Some(place)) => (at - place).abs() < 1e-3 * at,
                _ => false,
            };
            row.get(1) == Some(&c.group) && row[2].split(" at ").next() == Some(&c.test) && here
        };
        let row = rows.iter().find(named).unwrap_or_else(|| panic!("no row of {c:?}"));
        for (cell, value) in [(3, Some(c.measured)), (4, c.predicted), (6, c.ratio())] {
            let (said, value) = (number(&row[cell]).unwrap(), value.unwrap());
            assert!((said - value).abs() <= 2e-3 * value.abs(), "{row:?}: {value}");
        }
    }
}

#[test]
fn the_page_holds_what_is_predicted() {
    let quick = [
        "brick-wall-out-of-plane",
        "lime-mortar-arches",
        "prestwood-bridge",
        "sawn-granite-walls",
        "semicircular-arch",
    ];
    let list = compare(&groups(&corpus(), &quick.map(String::from)).unwrap(), || {}).unwrap();
    assert_eq!(list.len(), 17);
    stands_on_the_page(&list);
    // What was assumed moves the prediction of the bridge.
    let bridge = list.iter().find(|c| c.group == "prestwood-bridge").unwrap();
    assert!(bridge.band.is_some_and(|[low, high]| low < 120.0 && high > 200.0), "{bridge:?}");
    let mut granite = groups(&corpus(), &["granite-walls".into()]).unwrap();
    granite[0].experiment.tests.truncate(6);
    granite[0].experiment.assumed.clear();
    let list = compare(&granite, || {}).unwrap();
    stands_on_the_page(&list);
    assert!(list.iter().all(|c| c.band.is_none()) && ratios(&list).unwrap().cov < 0.05);
}

/// How many tests there are, and how many that rest on no unknown number, stands on the page too.
#[test]
fn the_page_counts_the_tests() {
    let all = groups(&corpus(), &[]).unwrap();
    let count = |known_only: bool| -> usize {
        let counted = all.iter().filter(|g| !known_only || !g.experiment.unknown);
        counted.map(|g| g.experiment.tests.len()).sum()
    };
    let words =
        format!("{} tests in {} groups. For {} of them", count(false), all.len(), count(true));
    let page = std::fs::read_to_string(root().join("docs/validation.md")).unwrap();
    assert!(page.contains(&words), "{words}");
    assert!(count(false) >= 40 && count(true) >= 25, "{words}");
}

/// All groups: minutes where nothing is optimised.
#[test]
#[ignore = "takes minutes"]
fn the_page_holds_all_that_is_predicted() {
    let list = compare(&groups(&corpus(), &[]).unwrap(), || {}).unwrap();
    stands_on_the_page(&list);
    let granite = ratios(list.iter().filter(|c| c.group == "granite-walls")).unwrap();
    assert!((granite.mean - 1.0).abs() < 0.03 && granite.cov < 0.05, "{granite:?}");
}

#[test]
fn a_group_that_is_wrong_is_refused_with_its_place() {
    let none = groups(&corpus(), &["marble".into()]).unwrap_err().to_string();
    assert!(none.contains("\"marble\"") && none.contains("granite-walls"), "{none}");
    let folder = tempfile::tempdir().unwrap();
    assert!(groups(folder.path(), &[]).unwrap_err().to_string().contains("experiment.json"));
    let own = folder.path().join("walls");
    std::fs::create_dir(&own).unwrap();
    let from = corpus().join("granite-walls");
    std::fs::copy(from.join("wall.json"), own.join("wall.json")).unwrap();
    let text = std::fs::read_to_string(from.join("experiment.json")).unwrap();
    std::fs::write(own.join("experiment.json"), text.replace("/loads/dead/0/", "/loads/dead/7/"))
        .unwrap();
    let found = groups(folder.path(), &[]).unwrap();
    let wrong = compare(&found, || {}).unwrap_err().to_string();
    assert!(wrong.contains("/loads/dead/7/force/2") && wrong.contains("leads nowhere"), "{wrong}");
    std::fs::write(own.join("experiment.json"), text.replace("\"tests\"", "\"test\"")).unwrap();
    let wrong = groups(folder.path(), &[]).unwrap_err().to_string();
    assert!(wrong.contains("experiment.json:") && wrong.contains("test"), "{wrong}");
}

/// A loading beam without weight slides where the wall would rock: that is said, and of a wall whose
/// beam bears its vertical load it is not.
#[test]
fn a_loading_beam_without_weight_is_reported() {
    let findings = |beam: f64, force: f64| {
        let text = std::fs::read_to_string(corpus().join("granite-walls/wall.json")).unwrap();
        let mut scene: serde_json::Value = serde_json::from_str(&text).unwrap();
        scene["materials"]["beam"]["density"] = beam.into();
        scene["loads"]["dead"][0]["force"][2] = force.into();
        let (scene, _) = voussoir::scene::read_str("wall", scene.to_string()).unwrap();
        let model = voussoir::interface::prepare(&scene).unwrap();
        let said = model.findings().filter(|f| f.text.contains("presses its joint"));
        said.map(|f| f.text.clone()).collect::<Vec<_>>()
    };
    let light = findings(1e-3, -1e-6);
    assert!(light.len() == 1 && light[0].contains("\"beam\""), "{light:?}");
    assert!(findings(1e-3, -1e5).is_empty() && findings(2000.0, -1e-6).is_empty());
}
