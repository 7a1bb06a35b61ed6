//! The commands that an answer proposes, and how it is worded.

use super::*;

#[test]
fn the_commands_that_come_next_ask_the_same_question() {
    let text = out(&expect(
        YES,
        structure(&["tilt", "--toward", "1,0", "--law", "associative"], "block-on-tilting-table"),
    ));
    assert!(
        text.contains(
            "block-on-tilting-table.json --law associative --toward 1,0 --save result.json"
        ),
        "{text}"
    );
    let text = out(&expect(
        YES,
        structure(&["tilt", "--toward", "1,0,0.5", "--skip-dead"], "block-on-tilting-table"),
    ));
    assert!(text.contains(" --toward 1,0,0.5 --skip-dead --save "), "{text}");
    let critical = [
        "critical",
        "--vary",
        "/gravity/0",
        "--between",
        "0",
        "9",
        "--step",
        "3",
        "--law",
        "associative",
    ];
    let text = out(&expect(YES, structure(&critical, "block-on-tilting-table")));
    assert!(
        text.contains(
            ".json --law associative --vary /gravity/0 --between 0 9 --step 3 --save result.json"
        ),
        "{text}"
    );
    let text = out(&expect(
        YES,
        structure(
            &["thrust", "--support", "ground", "--direction", "1,0"],
            "block-on-tilting-table",
        ),
    ));
    assert!(text.contains(".json --support ground --direction 1,0 --save result.json"), "{text}");
    let text = out(&expect(YES, structure(&["tilt"], "block-on-tilting-table")));
    assert!(text.contains("block-on-tilting-table.json --save "), "{text}");
}

#[test]
fn a_thrust_is_drawn_and_a_critical_value_told_first() {
    let desk = Desk::new();
    let answer = expect(
        YES,
        voussoir(&["thrust", &desk.at("arch.json"), "--svg", &desk.at("arch.svg"), "--quiet"]),
    );
    assert!(
        out(&answer).starts_with("Arch: thrust on springer_left from ")
            && out(&answer).lines().count() == 1,
        "{}",
        out(&answer)
    );
    let drawing = fs::read_to_string(desk.path("arch.svg")).unwrap();
    assert!(drawing.starts_with("<svg ") && drawing.ends_with("</svg>\n"));
    let answer = voussoir(&[
        "critical",
        &desk.at("arch.json"),
        "--vary",
        "/joints/default/friction",
        "--between",
        "0.1",
        "0.9",
    ]);
    let text = out(&expect(YES, answer));
    assert!(text.starts_with("Arch: falls up to friction = 0.3"), "{text}");
    assert!(
        text.contains("  proved      falls at 0.3")
            && text.contains("33 values of /joints/default/friction"),
        "{text}"
    );
}

#[test]
fn paths_are_quoted_where_a_shell_would_split_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("it's $HOME.json");
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/structures/column.json"), &path).unwrap();
    let text = out(&expect(YES, voussoir(&["assess", path.to_str().unwrap()])));
    assert!(text.contains(r"/it'\''s $HOME.json' --save"), "{text}");
}

#[test]
fn no_limit_is_not_said_where_dry_friction_has_one() {
    let first = out(&structure(&["limit", "--quiet"], "block-under-roof"));
    assert!(first.contains("carries 0.4 × the live load with dry friction"), "{first}");
    let first = out(&structure(&["limit", "--quiet", "--law", "associative"], "block-under-roof"));
    assert!(first.contains(": no limit"), "{first}");
}

#[test]
fn a_scene_without_a_name_is_called_by_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("nameless.json");
    let scene = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.7 } }, "templates": [ { "column": { "blocks": 2, "size": [1, 1, 0.5] } } ] }"#;
    fs::write(&path, scene).unwrap();
    let path = path.to_str().unwrap();
    assert_eq!(out(&voussoir(&["assess", "--quiet", path])), "nameless.json: stands\n");
    assert!(out(&voussoir(&["check", path])).starts_with("nameless.json: "));
    assert_eq!(out(&with_input(&["assess", "--quiet", "-"], scene)), "standard input: stands\n");
}
