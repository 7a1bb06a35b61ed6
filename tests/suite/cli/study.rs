//! Studies of random scenes: what is printed, what is kept, what goes into folders.

use super::*;

#[test]
fn a_scene_of_a_study_is_printed_and_can_be_asked() {
    for study in ["--soak", "--cross", "--forge"] {
        let scene =
            out(&expect(YES, voussoir(&["study", study, "1", "--seed", "4", "--only", "18"])));
        let scene: Value = serde_json::from_str(&scene).unwrap();
        let name = if study == "--soak" { "soak 4/18: " } else { "cross 4/18: groove" };
        assert!(scene["name"].as_str().unwrap().starts_with(name), "{study}: {}", scene["name"]);
        let desk = Desk::new();
        assert_ne!(code(&voussoir(&["assess", "-q", &desk.write("scene.json", &scene)])), USAGE);
    }
}

#[test]
fn studies_of_random_scenes_exclude_each_other() {
    let said = err(&expect(USAGE, voussoir(&["study", "--cross", "1", "--forge", "1"])));
    assert!(said.contains("cannot be used with"), "{said}");
    expect(USAGE, voussoir(&["study", "--seed", "2"]));
    expect(USAGE, voussoir(&["study", "--soak", "1", "--dump", "."]));
    let said = err(&expect(USAGE, voussoir(&["study", "--cross", "1", "--dump", "no/folder"])));
    assert!(said.contains("no such folder"), "{said}");
}

#[test]
fn a_study_is_taken_up_and_told_in_words_and_in_numbers() {
    let desk = Desk::new();
    for (study, title) in [("--cross", "One scene, several ways"), ("--forge", "Forged results")] {
        let kept = desk.at(&format!("kept{study}"));
        let once = voussoir(&["study", study, "2", "--keep", &kept, "-q", "--json"]);
        let list: Vec<Value> = serde_json::from_slice(&once.stdout).unwrap();
        assert_eq!((list.len(), list[0]["family"].as_str()), (2, Some("wall")));
        // All is there: nothing is asked again, seconds are those of the first time.
        let twice = voussoir(&["study", study, "2", "--keep", &kept, "-q", "--json"]);
        assert_eq!((twice.stdout, twice.status.code()), (once.stdout, once.status.code()));
        let table = desk.at("table.csv");
        let text = out(&voussoir(&["study", study, "2", "--keep", &kept, "--csv", &table]));
        assert!(text.starts_with(title), "{text}");
        assert_eq!(fs::read_to_string(table).unwrap().lines().count(), 3);
        expect(USAGE, voussoir(&["study", study, "2", "--seed", "9", "--keep", &kept]));
    }
}
