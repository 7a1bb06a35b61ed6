//! Files that are none, files that are named twice, and what the system says about them.

use super::{USAGE, command, desk, expect, plan, run, said};
use std::{
    fs,
    path::Path,
    process::{Command, Output},
    time::{Duration, Instant},
};

/// Runs a command that must not wait for anything.
fn at_once(folder: &Path, args: &[&str]) -> Output {
    let mut child = command(folder).args(args).spawn().unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("{args:?} waits or reads on and on");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap()
}

#[cfg(unix)]
#[test]
fn pipes_devices_and_folders_are_refused_at_once_wherever_a_file_is_read() {
    let desk = desk(1, 1, 2);
    let at = desk.path();
    assert!(Command::new("mkfifo").arg(at.join("pipe")).status().unwrap().success());
    fs::create_dir(at.join("folder")).unwrap();
    let own = plan(2);
    for odd in ["pipe", "/dev/zero", "/dev/full", "folder"] {
        fs::write(at.join("odd.json"), own.replace("wall.json", odd)).unwrap();
        for args in [
            &["assess", odd][..],
            &["check", odd],
            &["import", odd],
            &["sweep", odd],
            &["sweep", "odd.json"],
            &["sweep", "plan.json", "-o", odd],
            &["study", "--extreme", "--keep", odd],
            &["repose", "drain", "--question", "repose", "--keep", odd],
            &["settle", "wall.json", "--cracks", odd],
            &["settle", "wall.json", "--move", "base=0.01,0,0", "--from", odd],
        ] {
            let output = at_once(at, args);
            expect(USAGE, &output);
            let said = said(&output);
            assert!(said.contains("name a file") && said.lines().count() <= 2, "{args:?}: {said}");
        }
    }
    for odd in ["pipe", "/dev/zero"] {
        let output = at_once(at, &["sweep", "merge", odd]);
        expect(USAGE, &output);
        assert!(said(&output).contains("name a file"), "{}", said(&output));
    }
}

#[cfg(unix)]
#[test]
fn no_output_replaces_another_or_what_is_read() {
    let desk = desk(1, 1, 2);
    let at = desk.path();
    fs::write(at.join("a"), "kept").unwrap();
    std::os::unix::fs::symlink("a", at.join("soft")).unwrap();
    fs::hard_link(at.join("a"), at.join("hard")).unwrap();
    for name in ["wall", "plan"] {
        fs::hard_link(at.join(name).with_extension("json"), at.join(format!("other-{name}")))
            .unwrap();
    }
    let before: Vec<(String, Vec<u8>)> =
        super::files(at).into_iter().map(|n| (n.clone(), fs::read(at.join(n)).unwrap())).collect();
    for (args, word) in [
        (&["assess", "wall.json", "--save", "a", "--report", "a"][..], "two outputs"),
        (&["assess", "wall.json", "--save", "a", "--report", "./soft"], "two outputs"),
        (&["assess", "wall.json", "--svg", "hard", "--csv", "a"], "two outputs"),
        (&["assess", "wall.json", "--svg", "new.blocks", "--csv", "new"], "two outputs"),
        (&["assess", "wall.json", "--save", "new", "--svg", "./new"], "two outputs"),
        (&["sweep", "plan.json", "-o", "new", "--csv", "new"], "two outputs"),
        (&["sweep", "plan.json", "--csv", "new", "--report", "new"], "two outputs"),
        (&["study", "--extreme", "--keep", "new", "--csv", "new"], "two outputs"),
        (&["simulate", "wall.json", "--csv", "new", "--svg", "new"], "two outputs"),
        (&["simulate", "wall.json", "--csv", "other-wall"], "would overwrite this input"),
        (&["assess", "wall.json", "--save", "other-wall"], "would overwrite this input"),
        (&["sweep", "plan.json", "--csv", "other-plan"], "would overwrite this input"),
        (&["sweep", "plan.json", "--report", "other-wall"], "would overwrite this input"),
        (&["check", "wall.json", "--svg", "other-wall"], "would overwrite this input"),
        (&["import", "wall.json", "-o", "other-wall"], "would overwrite this input"),
        (&["sweep", "merge", "a", "--csv", "soft"], "would overwrite this input"),
    ] {
        let output = at_once(at, args);
        expect(USAGE, &output);
        assert!(said(&output).contains(word), "{args:?}: {}", said(&output));
    }
    let after: Vec<(String, Vec<u8>)> =
        super::files(at).into_iter().map(|n| (n.clone(), fs::read(at.join(n)).unwrap())).collect();
    assert!(before == after, "something was written: {:?}", super::files(at));
    // Devices take what they like.
    expect(0, &run(at, &["check", "wall.json", "--svg", "/dev/null", "--csv", "/dev/null"]));
}

#[test]
fn what_the_system_says_is_said_once() {
    let desk = desk(1, 1, 2);
    let at = desk.path();
    for args in [
        &["assess", "none.json"][..],
        &["sweep", "plan.json", "-o", "no/such/rows"],
        &["sweep", "merge", "none.jsonl"],
        &["sweep", "status", "none.jsonl"],
        &["study", "--extreme", "--keep", "no/such/file"],
        &["sweep", "--attach", "none.jsonl"],
        &["simulate", "wall.json", "--csv", "no/such/file"],
        &["generate", "wall", "-o", "/proc/none"],
    ] {
        let output = at_once(at, args);
        expect(USAGE, &output);
        let said = said(&output);
        assert_eq!(said.matches("os error").count(), 1, "{args:?}: {said}");
        assert!(!said.contains(".tmp"), "{args:?} names a file that nobody has given: {said}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn limits_of_the_system_end_with_a_message() {
    let desk = desk(20, 40, 2);
    let at = desk.path();
    let program = env!("CARGO_BIN_EXE_voussoir");
    // What is needed to be loaded at all: below it the system ends the process before it begins.
    let begins = |kilobytes: &u32| {
        let line = format!("ulimit -v {kilobytes}; exec {program} --version");
        Command::new("sh").args(["-c", &line]).output().unwrap().status.success()
    };
    let least = (4..100).map(|n| 5_000 * n).find(begins).expect("it begins in 500 MB");
    let mut refused = 0;
    for kilobytes in [0, 10_000, 20_000, 40_000, 80_000].map(|more| least + more) {
        // More than there is, so that no estimate refuses it before.
        for given in ["--max-memory 64G", ""] {
            let line = format!(
                "ulimit -v {kilobytes}; exec {program} limit wall.json --law associative --skip-dead --time-limit 20 {given}"
            );
            let output = Command::new("sh").current_dir(at).args(["-c", &line]).output().unwrap();
            let said = said(&output);
            assert!(
                matches!(output.status.code(), Some(0..=3)),
                "{kilobytes}: {:?} {said}",
                output.status
            );
            assert!(!said.contains("panicked"), "{said}");
            if said.contains("the system gives no more memory") {
                expect(USAGE, &output);
                assert!(said.contains("hint: ") && output.stdout.is_empty(), "{said}");
                refused += 1;
            }
        }
    }
    assert!(refused > 0, "the limit was never met");
}
