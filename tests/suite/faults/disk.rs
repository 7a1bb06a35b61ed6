//! Disks that are full, and files that cannot be written.

use super::{USAGE, command, desk, expect, files, rows, run, said};
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// A file system of a few pages in memory, gone when dropped.
struct Small {
    place: PathBuf,
    _folder: tempfile::TempDir,
}

impl Small {
    /// `None`, with a word, where the test may not mount.
    fn new(kilobytes: usize) -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("small");
        fs::create_dir(&place).unwrap();
        let mounted = Command::new("mount")
            .args(["-t", "tmpfs", "-o", &format!("size={kilobytes}k"), "tmpfs"])
            .arg(&place)
            .output()
            .is_ok_and(|o| o.status.success());
        if !mounted {
            crate::skipped("no right to mount a small file system here");
            return None;
        }
        Some(Self { place, _folder: folder })
    }

    fn at(&self, name: &str) -> String {
        self.place.join(name).to_str().unwrap().into()
    }
}

impl Drop for Small {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg("-l").arg(&self.place).status();
    }
}

#[test]
fn a_full_disk_leaves_results_whole_or_absent() {
    let Some(small) = Small::new(4) else { return };
    let desk = desk(3, 4, 4);
    for question in [
        &["assess"][..],
        &["limit", "--law", "associative"],
        &["tilt", "--all", "1", "--law", "associative"],
        &["simulate", "--fast"],
    ] {
        let output = run(
            desk.path(),
            &[question, &["wall.json", "--save", &small.at("result.json")]].concat(),
        );
        expect(USAGE, &output);
        assert!(
            said(&output).contains("result.json: cannot be written: No space left"),
            "{}",
            said(&output)
        );
        assert_eq!(files(&small.place), [""; 0]);
    }
    // What was there stays.
    fs::write(small.place.join("old.json"), "old").unwrap();
    expect(USAGE, &run(desk.path(), &["assess", "wall.json", "--save", &small.at("old.json")]));
    assert_eq!(fs::read_to_string(small.place.join("old.json")).unwrap(), "old");
    assert_eq!(files(&small.place), ["old.json"]);
    for args in [
        &["generate", "wall", "--expand", "-o", &small.at("scene.json")][..],
        &[
            "thrust",
            "wall.json",
            "--support",
            "base",
            "--direction",
            "1,0",
            "--law",
            "associative",
            "--svg",
            &small.at("thrust.svg"),
        ],
    ] {
        let output = run(desk.path(), args);
        expect(USAGE, &output);
        assert!(said(&output).contains("cannot be written"), "{args:?}: {}", said(&output));
    }
    // A trajectory is written as it comes; moments go before their collection, and that of an
    // earlier run is none of theirs.
    fs::remove_file(small.place.join("old.json")).unwrap();
    for (film, file) in [("--csv", "way.csv"), ("--vtk", "way.pvd")] {
        let args = ["simulate", "wall.json", "--fast", "--frames", "1000", "--skip-verdict", film];
        let output = run(desk.path(), &[&args[..], &[&small.at(file)]].concat());
        expect(USAGE, &output);
        assert!(said(&output).contains("cannot be written"), "{}", said(&output));
        assert_eq!(files(&small.place), [""; 0], "{file}");
    }
}

#[test]
fn a_sweep_on_a_full_disk_is_continued_when_there_is_room() {
    let Some(small) = Small::new(24) else { return };
    let desk = desk(2, 2, 60);
    let sweep = |output: &str| {
        run(desk.path(), &["sweep", "plan.json", "-o", output, "--quiet", "--threads", "2"])
    };
    let block = small.place.join("in-the-way");
    fs::write(&block, vec![0_u8; 16 << 10]).unwrap();
    let output = sweep(&small.at("rows.jsonl"));
    expect(USAGE, &output);
    assert!(
        said(&output).contains("rows.jsonl: cannot be written: No space left"),
        "{}",
        said(&output)
    );
    let kept =
        fs::read_to_string(small.place.join("rows.jsonl")).unwrap().matches("\"seconds\"").count();
    assert!(kept > 0 && kept < 60, "{kept}");
    fs::remove_file(&block).unwrap();
    expect(0, &sweep(&small.at("rows.jsonl")));
    expect(0, &sweep("direct.jsonl"));
    assert_eq!(rows(&small.place.join("rows.jsonl")), rows(&desk.path().join("direct.jsonl")));
}

#[test]
fn what_cannot_be_written_is_said_before_the_work() {
    let desk = desk(60, 40, 4);
    fs::create_dir(desk.path().join("folder")).unwrap();
    let start = std::time::Instant::now();
    for (path, word) in [
        ("folder", "it is a folder"),
        ("nowhere/result.json", "there is no such folder"),
        ("wall.json/result.json", "cannot be written"),
        ("/proc/result.json", "cannot be written"),
        ("/sys/result.json", "cannot be written"),
    ] {
        let output = run(desk.path(), &["limit", "wall.json", "--save", path]);
        expect(USAGE, &output);
        assert!(said(&output).contains(word), "{path}: {}", said(&output));
    }
    assert!(start.elapsed().as_secs() < 30, "the wall was solved first");
}

#[test]
fn a_full_device_is_an_error_and_not_a_silent_success() {
    if !Path::new("/dev/full").exists() {
        crate::skipped("no /dev/full here");
        return;
    }
    let desk = desk(2, 2, 4);
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for args in [
        &["assess", "wall.json"][..],
        &["assess", "wall.json", "--json"],
        &["generate", "wall"],
        &["generate", "--list"],
        &["schema"],
        &["check", "wall.json"],
        &["sweep", "plan.json", "--json"],
        &["sweep", "plan.json"],
        &["--help"],
    ] {
        let output = command(desk.path()).args(args).stdout(full()).output().unwrap();
        expect(USAGE, &output);
        assert!(!said(&output).contains("panicked"), "{}", said(&output));
    }
    for args in [
        &["assess", "wall.json", "--save", "/dev/full"][..],
        &["generate", "wall", "-o", "/dev/full"],
        &["sweep", "plan.json", "--csv", "/dev/full"],
    ] {
        let output = run(desk.path(), args);
        expect(USAGE, &output);
        assert!(said(&output).contains("No space left"), "{}", said(&output));
    }
    // Nowhere to complain: still the right code.
    let output =
        command(desk.path()).args(["assess", "none.json"]).stderr(full()).output().unwrap();
    expect(USAGE, &output);
}
