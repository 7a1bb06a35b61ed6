//! Files written whole or not at all, and readers that go away.

use super::*;

#[test]
fn results_are_written_whole_or_not_at_all() {
    let desk = Desk::new();
    let before = desk.files();
    // The target is tried before anything is read.
    for target in ["no-folder/r.json", ""] {
        let answer =
            expect(USAGE, voussoir(&["assess", &desk.at("none.json"), "--save", &desk.at(target)]));
        assert!(
            err(&answer).contains("cannot be written") && out(&answer).is_empty(),
            "{}",
            err(&answer)
        );
    }
    // A question that fails leaves what was there.
    fs::write(desk.path("old.json"), "old").unwrap();
    expect(USAGE, voussoir(&["limit", &desk.at("arch.json"), "--save", &desk.at("old.json")]));
    assert_eq!(fs::read_to_string(desk.path("old.json")).unwrap(), "old");
    expect(USAGE, voussoir(&["limit", &desk.at("arch.json"), "--save", &desk.at("new.json")]));
    expect(NO, voussoir(&["assess", &desk.at("thin.json"), "--save", &desk.at("old.json")]));
    assert_eq!(desk.read("old.json")["answer"]["verdict"], "unstable");
    fs::remove_file(desk.path("old.json")).unwrap();
    assert_eq!(desk.files(), before, "something was left behind");
    // Neither the scene nor standard output is a place for a result.
    let scene = fs::read(desk.path("arch.json")).unwrap();
    expect(USAGE, voussoir(&["assess", &desk.at("arch.json"), "--save", &desk.at("arch.json")]));
    expect(USAGE, voussoir(&["assess", &desk.at("arch.json"), "--save", "-"]));
    assert_eq!(fs::read(desk.path("arch.json")).unwrap(), scene);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_stays_what_it_is() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let desk = Desk::new();
    expect(YES, voussoir(&["assess", &desk.at("arch.json"), "--save", "/dev/null"]));
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    fs::write(desk.path("real.json"), "").unwrap();
    symlink(desk.path("real.json"), desk.path("link.json")).unwrap();
    expect(YES, voussoir(&["assess", &desk.at("arch.json"), "--save", &desk.at("link.json")]));
    assert!(fs::symlink_metadata(desk.path("link.json")).unwrap().is_symlink());
    assert_eq!(desk.read("real.json")["question"], json!({ "assess": { "law": "coulomb" } }));
}

#[test]
fn a_reader_that_went_away_is_no_error() {
    let desk = Desk::new();
    let arch = desk.at("arch.json");
    let pushed = desk.at("pushed.json");
    for (wanted, args) in [
        (YES, vec!["--help"]),
        (YES, vec!["schema"]),
        (YES, vec!["assess", &arch, "--json"]),
        (YES, vec!["tilt", &arch]),
        (NO, vec!["limit", &pushed, "--require", "1"]),
        (YES, vec!["generate", "wall", "--expand"]),
        (USAGE, vec!["assess", "none.json"]),
        (USAGE, vec!["nonsense"]),
    ] {
        for both in [false, true] {
            let mut command = command();
            command.args(&args).stdout(closed_pipe());
            if both {
                command.stderr(closed_pipe());
            }
            expect(wanted, ended(command.output().unwrap()));
        }
    }
}

/// The writing end of a pipe nobody reads.
fn closed_pipe() -> Stdio {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    writer.into()
}

/// `settle` and `push` keep what is proved: cut anywhere, the same command ends at the same answer.
#[test]
fn paths_are_taken_up_where_they_were_cut() {
    let folder = TempDir::new().unwrap();
    let table = json!({
        "format": "voussoir-scene/1", "gravity": [0, 0, -1], "materials": { "u": { "density": 1 } },
        "joints": { "default": { "friction": 0.3 } },
        "blocks": [
            { "id": "table", "support": true, "material": "u", "shape": { "box": { "size": [4, 1, 0.5] } }, "at": [0, 0, -0.25] },
            { "id": "block", "material": "u", "shape": { "box": { "size": [1, 1, 0.5] } }, "at": [1, 0, 0.25] }
        ],
        "loads": { "live": [{ "weight": [1, 0, 0] }] }
    });
    let scene = folder.path().join("table.json");
    fs::write(&scene, table.to_string()).unwrap();
    let scene = scene.to_str().unwrap();
    let arch = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/spreading-arch.json");
    let block = ["push", scene, "--control", "block=1,0,0.25", "--toward", "1,0,0"];
    let spread = ["settle", arch, "--move", "springer_right=0.12,0,0"];
    for (name, asked) in [("slides", &block[..]), ("hinges", &spread[..])] {
        let kept = folder.path().join(format!("{name}.jsonl"));
        let ask = || {
            let own = ["--keep", kept.to_str().unwrap(), "-q", "--json"];
            let output = voussoir(&[asked, &own[..]].concat());
            let file: Value = serde_json::from_str(&out(&output)).unwrap();
            (output.status.code(), file)
        };
        let (code, whole) = ask();
        let result = folder.path().join("result.json");
        let values = |file: &Value| -> Vec<f64> {
            let points = file["answer"]["curve"]["points"].as_array().unwrap();
            points.iter().map(|p| p["value"].as_f64().unwrap()).collect()
        };
        let text = fs::read_to_string(&kept).unwrap();
        let lines = text.lines().count();
        assert!(lines > 4, "{lines}");
        for part in [1, lines / 2, lines] {
            let cut: String = text.lines().take(part).map(|l| format!("{l}\n")).collect();
            // A line that was being written.
            fs::write(&kept, cut + "{\"path\":").unwrap();
            let (again, file) = ask();
            assert_eq!(again, code);
            let ends = |file: &Value| file["answer"]["path"]["value"].as_f64().unwrap();
            assert!((ends(&file) - ends(&whole)).abs() < 1e-9, "{name} {part}");
            let (a, b) = (values(&file), values(&whole));
            let last = text.lines().take(part).count();
            assert!(a.len().abs_diff(b.len()) <= 2, "{name} {last}: {} of {}", a.len(), b.len());
            assert_eq!(file["answer"]["path"]["status"], whole["answer"]["path"]["status"]);
            let kinds = |f: &Value| -> Vec<Value> {
                let events = f["answer"]["curve"]["events"].as_array().unwrap();
                events.iter().map(|e| e["kind"].clone()).collect()
            };
            assert_eq!(kinds(&file), kinds(&whole), "{name} {part}");
            fs::write(&result, file.to_string()).unwrap();
            let scene = asked[1];
            expect(YES, voussoir(&["check", result.to_str().unwrap(), "--scene", scene]));
        }
        // Another question does not go on from it.
        let other = ["--keep", kept.to_str().unwrap(), "-q", "--at", "0.5"];
        expect(USAGE, voussoir(&[asked, &other[..]].concat()));
    }
}
