//! Kills and interrupts at any moment.

use super::{command, desk, expect, files, rows, run};
use serde_json::Value;
use std::{
    fs,
    path::Path,
    process::{Child, Command, ExitStatus, Stdio},
    time::{Duration, Instant},
};

/// Ends a child with a signal; the status it ended with, by the signal or by itself if it was
/// faster.
fn signal(child: &mut Child, number: i32) -> ExitStatus {
    // SAFETY: a child of this test that has not been waited for: its number is its own.
    #[expect(unsafe_code, reason = "a signal by its number is sent by the system alone")]
    unsafe {
        libc::kill(i32::try_from(child.id()).unwrap(), number)
    };
    child.wait().unwrap()
}

/// How long a command takes, at least a moment.
fn measured(folder: &Path, args: &[&str]) -> (Duration, Option<i32>) {
    let start = Instant::now();
    let output = run(folder, args);
    (start.elapsed().max(Duration::from_millis(5)), output.status.code())
}

#[test]
fn killed_at_any_moment_a_file_is_whole_or_absent() {
    use std::os::unix::process::ExitStatusExt;
    let desk = desk(4, 4, 4);
    let verbs: [&[&str]; 6] = [
        &["assess", "wall.json", "--save", "result.json"],
        &["limit", "wall.json", "--law", "associative", "--save", "result.json"],
        &["simulate", "wall.json", "--fast", "--save", "result.json"],
        &["repose", "wall.json", "--law", "associative", "--all", "2", "--save", "result.json"],
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
            "--save",
            "result.json",
        ],
        &["generate", "wall", "courses=40", "--expand", "-o", "result.json"],
    ];
    for args in verbs {
        let (time, code) = measured(desk.path(), args);
        let mut cut = 0;
        for (k, number) in
            (0..16).zip([libc::SIGKILL, libc::SIGINT, libc::SIGTERM].into_iter().cycle())
        {
            let _ = fs::remove_file(desk.path().join("result.json"));
            let mut child = command(desk.path()).args(args).spawn().unwrap();
            // The end, where files are written, more often than the beginning.
            std::thread::sleep(time.mul_f64(1.1 * (f64::from(k) / 15.0).sqrt()));
            let status = signal(&mut child, number);
            assert!(status.signal() == Some(number) || status.code() == code, "{args:?}: {status}");
            cut += usize::from(status.signal().is_some());
            match fs::read_to_string(desk.path().join("result.json")) {
                Err(_) => {}
                Ok(text) => drop(
                    serde_json::from_str::<serde_json::Value>(&text)
                        .unwrap_or_else(|e| panic!("{args:?}: {e}")),
                ),
            }
            let left: Vec<String> =
                files(desk.path()).into_iter().filter(|f| f != "result.json").collect();
            assert_eq!(left, ["plan.json", "wall.json"], "{args:?} left something");
        }
        assert!(cut > 0, "{args:?} was never cut off");
    }
}

#[test]
fn killed_while_it_replaces_a_file_the_old_one_stays_or_the_new_one_is_there() {
    let desk = desk(2, 2, 4);
    let args = ["generate", "wall", "courses=100", "--expand", "-o", "scene.json"];
    let (time, _) = measured(desk.path(), &args);
    let new = fs::read_to_string(desk.path().join("scene.json")).unwrap();
    for k in 0..20 {
        fs::write(desk.path().join("scene.json"), "old").unwrap();
        let mut child = command(desk.path()).args(args).spawn().unwrap();
        std::thread::sleep(time.mul_f64(1.05 * f64::from(k) / 19.0));
        signal(&mut child, libc::SIGKILL);
        let text = fs::read_to_string(desk.path().join("scene.json")).unwrap();
        assert!(text == "old" || text == new);
    }
}

#[test]
fn a_sweep_killed_again_and_again_is_the_sweep_in_one_go() {
    let desk = desk(5, 4, 40);
    let args = [
        "sweep",
        "plan.json",
        "-o",
        "rows.jsonl",
        "--csv",
        "table.csv",
        "--quiet",
        "--threads",
        "2",
    ];
    let (time, _) = measured(
        desk.path(),
        &[
            "sweep",
            "plan.json",
            "-o",
            "direct.jsonl",
            "--csv",
            "direct.csv",
            "--quiet",
            "--threads",
            "2",
        ],
    );
    for k in 0..6 {
        let mut child = command(desk.path()).args(args).spawn().unwrap();
        std::thread::sleep(time / 8);
        signal(&mut child, if k % 2 == 0 { libc::SIGKILL } else { libc::SIGINT });
    }
    let kept = fs::read_to_string(desk.path().join("rows.jsonl")).unwrap().matches('\n').count();
    assert!(kept > 1, "nothing was kept");
    expect(0, &run(desk.path(), &args));
    assert_eq!(rows(&desk.path().join("rows.jsonl")), rows(&desk.path().join("direct.jsonl")));
    assert_eq!(
        files(desk.path()),
        ["direct.csv", "direct.jsonl", "plan.json", "rows.jsonl", "table.csv", "wall.json"]
    );
}

#[test]
fn a_trajectory_that_was_cut_off_ends_with_a_whole_frame() {
    let desk = desk(4, 4, 4);
    let args = [
        "simulate",
        "wall.json",
        "--fine",
        "--frames",
        "2000",
        "--skip-verdict",
        "--to-the-end",
        "--csv",
        "way.csv",
    ];
    let mut child = command(desk.path()).args(args).spawn().unwrap();
    let begun = Instant::now();
    let lines = || fs::read_to_string(desk.path().join("way.csv")).map_or(0, |t| t.lines().count());
    while lines() < 100 && begun.elapsed().as_secs() < 60 {
        std::thread::sleep(Duration::from_millis(2));
    }
    signal(&mut child, libc::SIGKILL);
    let text = fs::read_to_string(desk.path().join("way.csv")).unwrap();
    let blocks = 1 + 4 * 4 + 2;
    assert!(text.ends_with('\n') && text.lines().skip(1).all(|l| l.split(',').count() == 16));
    assert_eq!((text.lines().count() - 1) % blocks, 0, "a frame was cut");
}

/// Starts a command that keeps what it does in `kept`, and kills it as soon as that file has grown
/// by a line; whether it was still at work.
fn killed_after_a_line(folder: &std::path::Path, args: &[&str]) -> bool {
    let lines = || fs::read_to_string(folder.join("kept")).map_or(0, |t| t.matches('\n').count());
    let (before, begun) = (lines().max(1), Instant::now());
    let mut child = command(folder).args(args).stdout(Stdio::null()).spawn().unwrap();
    while lines() <= before && begun.elapsed().as_secs() < 60 && child.try_wait().unwrap().is_none()
    {
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(lines() >= before, "lines were lost");
    signal(&mut child, libc::SIGKILL).code().is_none()
}

#[test]
fn heaps_killed_again_and_again_are_the_heaps_in_one_go() {
    let folder = tempfile::tempdir().unwrap();
    let args = [
        "repose",
        "drain",
        "grains=60",
        "size=[6,4]",
        "--question",
        "repose",
        "--quiet",
        "--json",
        "--keep",
    ];
    let timeless = |output: &std::process::Output| {
        let mut file: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        for heap in file["heaps"].as_array_mut().unwrap() {
            heap["seconds"] = 0.into();
            heap["margin"]["seconds"] = 0.into();
        }
        file
    };
    let direct = run(folder.path(), &[&args[..], &["direct", "--seeds", "3"]].concat());
    let again = [&args[..], &["kept", "--seeds", "3"]].concat();
    let cut = (0..3).filter(|_| killed_after_a_line(folder.path(), &again)).count();
    assert!(cut > 0, "it was never killed");
    let resumed = run(folder.path(), &again);
    assert_eq!(timeless(&resumed), timeless(&direct));
    // All is there: nothing is done again, seconds are those of the first time, and pictures are
    // drawn all the same.
    let third = run(folder.path(), &[&again[..], &["--svg", "heap.svg"]].concat());
    assert_eq!(third.stdout, resumed.stdout);
    assert_eq!(files(folder.path()), ["direct", "heap.svg", "kept"]);
    let other = run(
        folder.path(),
        &["repose", "drain", "grains=61", "size=[6,4]", "--question", "repose", "--keep", "kept"],
    );
    let error = String::from_utf8_lossy(&other.stderr).into_owned();
    assert!(
        other.status.code() == Some(2) && error.contains("give --keep another name"),
        "{error}"
    );
}

#[test]
fn the_extreme_grid_is_taken_up_where_it_was_killed() {
    let folder = tempfile::tempdir().unwrap();
    let args = ["study", "--extreme", "--quiet", "--keep", "kept"];
    assert!((0..2).all(|_| killed_after_a_line(folder.path(), &args)));
    let text = fs::read_to_string(folder.path().join("kept")).unwrap();
    let numbers: Vec<u64> = text
        .lines()
        .skip(1)
        .filter_map(|l| serde_json::from_str::<serde_json::Value>(l).ok())
        .map(|l| l[0].as_u64().unwrap())
        .collect();
    let distinct: std::collections::BTreeSet<_> = numbers.iter().collect();
    assert!(numbers.len() > 1 && distinct.len() == numbers.len(), "{numbers:?}");
    let other = run(folder.path(), &["study", "--quick", "--keep", "kept"]);
    assert_eq!(other.status.code(), Some(2));
}

#[test]
fn a_study_that_is_interrupted_leaves_no_half_table() {
    use std::os::unix::process::ExitStatusExt;
    let desk = desk(2, 2, 4);
    for number in [libc::SIGINT, libc::SIGKILL] {
        let mut child = command(desk.path())
            .args(["study", "--quick", "--scenes", "arch", "--csv", "study.csv"])
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(50));
        let status = signal(&mut child, number);
        assert!(status.signal() == Some(number) || status.success());
        assert!(status.success() || !desk.path().join("study.csv").exists());
        assert!(files(desk.path()).iter().all(|f| !f.starts_with('.')));
        let _ = fs::remove_file(desk.path().join("study.csv"));
    }
}

/// Two hundred kills at random moments, and the same bytes in the end. Long: `cargo test --test suite
/// -- --ignored two_hundred_kills`, with the program of the trials built before.
#[test]
#[ignore = "takes minutes"]
fn two_hundred_kills_leave_what_one_go_leaves() {
    let desk = desk(5, 4, 60);
    let arch = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/spreading-arch.json");
    fs::copy(arch, desk.path().join("arch.json")).unwrap();
    let trials = Path::new(env!("CARGO_BIN_EXE_voussoir")).with_file_name("trials");
    let sweep = ["sweep", "plan.json", "--quiet", "--threads", "2", "-o"];
    let settle = ["settle", "arch.json", "--move", "springer_left=0.1,0,0", "--json", "--keep"];
    let heap =
        ["grains=60", "size=[6,4]", "--question", "repose", "--quiet", "--json", "--seeds", "2"];
    let repose = [&["repose", "drain"], &heap[..], &["--keep"]].concat();
    let soak = ["soak", "40", "--json", "--keep"];
    let own = env!("CARGO_BIN_EXE_voussoir");
    let all =
        [(own, &sweep[..]), (own, &settle), (own, &repose), (trials.to_str().unwrap(), &soak)];
    for (program, args) in all {
        if !Path::new(program).exists() {
            crate::skipped("the program of the trials is not built");
            continue;
        }
        let start = |file: &str| {
            Command::new(program)
                .current_dir(desk.path())
                .args(args)
                .arg(file)
                .stdout(Stdio::piped())
                .stderr(Stdio::null())
                .spawn()
                .unwrap()
        };
        let begun = Instant::now();
        let direct = start("direct").wait_with_output().unwrap();
        let time = begun.elapsed();
        for k in 0..50_u32 {
            let mut child = start("kept");
            // From its first moments to a whole run, evenly.
            std::thread::sleep(time.mul_f64(f64::from(k * 37 % 50) / 50.0));
            signal(&mut child, if k % 2 == 0 { libc::SIGKILL } else { libc::SIGINT });
        }
        let resumed = start("kept").wait_with_output().unwrap();
        assert_eq!(resumed.status.code(), direct.status.code(), "{args:?}");
        let timeless = |bytes: &[u8]| -> Vec<String> {
            let text = String::from_utf8_lossy(bytes).into_owned();
            let untimed = |line: &str| {
                let line = line.split("\"sum\"").next().unwrap_or_default();
                let mut value = serde_json::from_str(line).unwrap_or_default();
                without_times(&mut value);
                value.to_string()
            };
            let mut lines: Vec<String> = match serde_json::from_str::<Value>(&text) {
                Ok(_) => vec![untimed(&text)],
                Err(_) => text.lines().map(untimed).collect(),
            };
            lines.sort();
            lines
        };
        match args[0] {
            "sweep" => {
                assert_eq!(rows(&desk.path().join("kept")), rows(&desk.path().join("direct")))
            }
            _ => assert!(timeless(&resumed.stdout) == timeless(&direct.stdout), "{args:?}"),
        }
    }
}

/// Takes times and memory out of a value.
fn without_times(value: &mut Value) {
    match value {
        Value::Object(map) => {
            let timed = [
                "seconds",
                "timings",
                "peak_memory",
                "solve",
                "read",
                "check",
                "detect",
                "work",
                "trace",
            ];
            map.retain(|key, _| !timed.contains(&key.as_str()));
            map.values_mut().for_each(without_times);
        }
        Value::Array(list) => list.iter_mut().for_each(without_times),
        _ => {}
    }
}
