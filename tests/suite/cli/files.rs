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
    assert_eq!(desk.read("real.json")["question"], "assess");
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
