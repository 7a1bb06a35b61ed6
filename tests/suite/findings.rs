//! Scenes that were answered wrongly once, each with what is true about it (findings/README.md);
//! those about dry friction are in [`dry`](crate::dry).

use crate::ask::open;
use serde_json::{Value, json};
use std::path::PathBuf;
use voussoir::{
    analysis::{Control, Limited, LoadFactor, Outcome, Proved, assess, coulomb, limit},
    interface::prepare,
    proof::{ResultFile, read::read_str, saved, verify},
    scene::Scene,
    verdict::Verdict,
};

fn path(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/suite/findings"))
        .join(format!("{name}.json"))
}

fn scene(name: &str) -> Scene {
    open(&path(name))
}

/// What a result says of the verdict, proved from the scene alone.
fn verdict(name: &str) -> Verdict {
    let scene = scene(name);
    let model = prepare(&scene).unwrap();
    let file = saved::assessment(&scene, &model, &assess(&model, &Control::default())).unwrap();
    let said = file.answer.verdict().unwrap();
    assert!(said == Verdict::Undecided || crate::ask::check(&scene, &file).proved(), "{name}");
    println!("{name}: {said:?}");
    said
}

/// The bound and the load factor with dry friction, as a result has them.
fn limits(name: &str) -> (Proved<LoadFactor>, ResultFile) {
    let scene = scene(name);
    let model = prepare(&scene).unwrap();
    let bound = limit(&model, &Control::default());
    let has_dry = matches!(bound.outcome, Outcome::Found | Outcome::Unbounded);
    let dry = has_dry.then(|| coulomb::load_factor(&model, &bound, &Control::default()));
    let file =
        saved::load_factor(&scene, &model, &Limited { dry, ..bound.clone().into() }).unwrap();
    println!(
        "{name}: {:?} {:?} in {:?}, dry {:?}",
        bound.outcome,
        bound.value,
        bound.bracket,
        file.dry.as_ref().and_then(|d| d.value)
    );
    (bound, file)
}

#[test]
fn nothing_hides_behind_survey_coordinates() {
    assert!(!matches!(
        verdict("arch-at-survey-coordinates"),
        Verdict::Stable | Verdict::Conditional
    ));
}

#[test]
fn live_loads_on_other_blocks_hide_no_wall() {
    // Held from 19.62 on: whatever else is said of its load factor, it does not fall whatever the
    // load.
    assert_ne!(limits("wall-and-pressed").0.outcome, Outcome::Impossible);
    assert_eq!(verdict("wall-and-pressed-at-20"), Verdict::Stable);
}

#[test]
fn a_couple_is_measured_as_a_couple() {
    assert_eq!(verdict("key-and-couple"), Verdict::Stable);
}

#[test]
fn forged_results_of_the_findings_are_refused() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases/findings/forged");
    let list = std::fs::read_dir(&folder).unwrap();
    let forged = list
        .map(|f| f.unwrap().path())
        .filter(|p| p.file_name().is_some_and(|n| n.to_string_lossy().starts_with('F')));
    for path in forged {
        let text = std::fs::read_to_string(&path).unwrap();
        let error = read_str("forged", text.as_str()).unwrap_err().to_string();
        assert!(error.contains("version 1") && error.contains("--save"), "{error}");
        // What it says, with its evidence in the place where it stands today.
        let old: Value = serde_json::from_str(&text).unwrap();
        let Some(file) = in_version_3(&old) else { continue };
        let scene = read_scene(&old["scene"]["input"]);
        let saved = read_str("forged", file.to_string());
        let found = saved.map(|saved| verify(&saved, &scene));
        let proved = found.is_ok_and(|found| found.is_ok_and(|v| v.proved()));
        assert!(!proved, "{}", path.display());
    }
}

fn read_scene(value: &Value) -> Scene {
    voussoir::scene::read_str("forged", value.to_string()).unwrap().0
}

/// A forgery of the first version as its maker would write it today: its evidence, and the answer
/// that follows from it; nothing where it is of no such form.
fn in_version_3(old: &Value) -> Option<Value> {
    let standing = |certificate: &Value| json!({ "certificate": certificate });
    let word = old["question"].as_str()?;
    let evidence = match word {
        "assess" => json!({ "assess": { "standing": standing(&old["certificate"]) } }),
        "limit" => json!({ "limit": { "factor": { "bound": old["certificate"] } } }),
        _ => return None,
    };
    let mut question = json!({});
    question[word] = json!({ "law": "associative" });
    let mut value = json!({
        "format": "voussoir-result/3", "question": question, "scene": old["scene"]["input"],
        "evidence": evidence, "answer": {},
    });
    crate::ask::told(&mut value);
    Some(value)
}

#[test]
fn what_forged_results_held_falls() {
    assert_eq!(verdict("overhang"), Verdict::Unstable);
    assert_eq!(verdict("channel"), Verdict::Unstable);
}

#[test]
fn no_dry_load_factor_is_above_the_proved_bound() {
    for name in ["dry-above-1192", "dry-above-2872"] {
        let (bound, file) = limits(name);
        assert_eq!(bound.outcome, Outcome::Found, "{name}");
        if let Some(value) = file.dry.as_ref().and_then(|d| d.value) {
            let upper = bound.bracket.upper;
            assert!(
                value <= upper,
                "{name}: {value} is above {upper} by {:.1e}",
                value / upper - 1.0
            );
        }
    }
}
