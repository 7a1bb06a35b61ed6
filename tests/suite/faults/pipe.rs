//! Readers that go away, before the work or in the middle of the text.

use super::{command, desk, said};
use std::{io::Read, process::Stdio};

#[test]
fn a_reader_that_goes_away_changes_no_exit_code() {
    let desk = desk(2, 2, 3);
    let page = |args: &[&str]| command(desk.path()).args(args).output().unwrap().status.code();
    for args in [
        &["assess", "wall.json"][..],
        &["assess", "wall.json", "--json"],
        &["limit", "wall.json", "--law", "associative", "--json"],
        &["tilt", "wall.json", "--law", "associative", "--all", "1"],
        &["thrust", "wall.json", "--law", "associative", "--direction", "1,0"],
        &[
            "critical",
            "wall.json",
            "--law",
            "associative",
            "--vary",
            "/joints/default/friction",
            "--between",
            "0.1",
            "0.9",
            "--scan",
            "3",
        ],
        &["simulate", "wall.json", "--fast", "--skip-verdict", "--csv", "-"],
        &["repose", "wall.json", "--law", "associative", "--all", "1"],
        &["sweep", "plan.json", "--json"],
        &["generate", "wall", "--expand"],
        &["generate", "--list"],
        &["check", "wall.json"],
        &["schema", "plan"],
        &["--help"],
        &["nonsense"],
    ] {
        let wanted = page(args);
        assert!(wanted.is_some(), "{args:?}");
        // Gone before anything is written.
        let mut child = command(desk.path()).args(args).spawn().unwrap();
        drop((child.stdout.take(), child.stderr.take()));
        assert_eq!(child.wait().unwrap().code(), wanted, "{args:?}, gone at once");
        // Gone after the first byte.
        let mut child = command(desk.path()).args(args).spawn().unwrap();
        if let Some(mut out) = child.stdout.take() {
            let _ = out.read(&mut [0]);
        }
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), wanted, "{args:?}, gone after a byte: {}", said(&output));
    }
}

#[test]
fn standard_input_that_ends_early_is_an_input_error() {
    use std::io::Write;
    let desk = desk(2, 2, 3);
    let text = std::fs::read(desk.path().join("wall.json")).unwrap();
    for length in [0, 1, text.len() / 2, text.len() - 1] {
        let mut child =
            command(desk.path()).args(["assess", "-"]).stdin(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(&text[..length]).unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", said(&output));
        assert!(said(&output).contains("standard input"), "{}", said(&output));
    }
}
