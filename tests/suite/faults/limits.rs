//! Limits: what is too large is refused with numbers and a remedy, memory stays below what was
//! allowed, time below what was given.

use super::{UNDECIDED, USAGE, command, desk, expect, run, said, wall};
use serde_json::{Value, json};
use std::{
    fs,
    path::Path,
    process::Stdio,
    time::{Duration, Instant},
};

/// Runs a command; its exit code, what it said, and the most memory it took, bytes. The system's
/// own account at the end would include the test that started it, so the mark is read while it
/// runs.
fn weighed(folder: &Path, args: &[&str]) -> (Option<i32>, String, u64) {
    let err = folder.join("stderr");
    let mut child = command(folder)
        .args(args)
        .stdout(Stdio::null())
        .stderr(fs::File::create(&err).unwrap())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut most = 0;
    let code = loop {
        let mark = fs::read_to_string(&status)
            .ok()
            .filter(|text| text.contains("Name:\tvoussoir"))
            .and_then(|text| {
                let line = text.lines().find_map(|l| {
                    l.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB").map(str::to_owned)
                })?;
                line.parse::<u64>().ok()
            });
        most = most.max(mark.unwrap_or(0) << 10);
        if let Some(status) = child.try_wait().unwrap() {
            break status.code();
        }
        std::thread::sleep(Duration::from_micros(300));
    };
    (code, fs::read_to_string(err).unwrap(), most)
}

#[test]
fn what_asks_for_too_much_is_refused_before_it_is_taken() {
    let desk = desk(2, 2, 2);
    let at = desk.path();
    let scene = |templates: Value| {
        json!({ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } }, "templates": templates }).to_string()
    };
    let wall = |courses: u64, k: usize| json!({ "wall": { "size": [1, 1, 1], "courses": courses, "blocks": 999, "prefix": format!("w{k}_"), "at": [k * 10_000, 0, 0] } });
    let box_at = |k: usize| json!({ "id": format!("b{k}"), "shape": { "box": { "size": [1, 1, 1] } }, "at": [1e-4 * k as f64, 0, 0], "support": k == 0 });
    let cases = [
        ("a count", scene(json!([wall(1_000_000_000, 0)])), "templates[0].wall.courses: makes 1000000001 × 1000 blocks, more than 1000000"),
        ("a template beyond the memory", scene(json!([wall(900, 0)])), "would take about 5.2 GiB of memory; 200 MiB are allowed"),
        ("many templates", scene((0..40).map(|k| wall(20, k)).collect()), "of memory; 200 MiB are allowed"),
        ("a heap in one place", json!({ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } }, "blocks": (0..3000).map(box_at).collect::<Vec<_>>() }).to_string(), "near enough to touch would take about"),
        ("a deep list", format!("{}{}", r#"{ "format": "voussoir-scene/1", "name": "#, "[".repeat(200_000)), "name: expected a string"),
        ("deep objects", format!("{}{}", r#"{ "format": "voussoir-scene/1", "blocks": ["#, r#"{ "id": "#.repeat(100_000)), "blocks"),
        ("a long file", format!("{}{}", r#"{ "format": "voussoir-scene/1" }"#, " ".repeat(20 << 20)), "a file of 20.0 MiB would take about 320 MiB"),
    ];
    for (what, text, word) in cases {
        fs::write(at.join("scene.json"), text).unwrap();
        for verb in ["assess", "check"] {
            let (code, said, memory) = weighed(at, &[verb, "scene.json", "--max-memory", "200M"]);
            assert_eq!(code, Some(USAGE), "{what}: {said}");
            assert!(said.contains(word) && said.lines().count() <= 2, "{what}: {said}");
            assert!(memory <= 200 << 20, "{what}: {memory} bytes");
        }
    }
    // From standard input the length is not known before.
    let text = " ".repeat(20 << 20);
    let mut child = command(at)
        .args(["assess", "-", "--max-memory", "200M"])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let _ = std::io::Write::write_all(&mut child.stdin.take().unwrap(), text.as_bytes());
    let output = child.wait_with_output().unwrap();
    expect(USAGE, &output);
    assert!(
        said(&output).contains("standard input: ") && said(&output).contains("--max-memory"),
        "{}",
        said(&output)
    );
}

#[test]
fn memory_stays_below_what_is_allowed_whatever_is_asked() {
    let desk = desk(2, 2, 2);
    let mut greatest = 0;
    for (courses, blocks) in [(4, 4), (12, 20), (40, 40), (90, 90)] {
        fs::write(desk.path().join("wall.json"), wall(courses, blocks)).unwrap();
        for most in [64_u64, 100, 200] {
            let allowed = format!("{most}M");
            let (code, said, memory) = weighed(
                desk.path(),
                &[
                    "limit",
                    "wall.json",
                    "--law",
                    "associative",
                    "--skip-dead",
                    "--max-memory",
                    &allowed,
                    "--time-limit",
                    "20",
                ],
            );
            println!(
                "{courses} × {blocks} with {most} MiB: exit {code:?}, {:.1} MiB",
                memory as f64 / f64::from(1 << 20)
            );
            greatest = greatest.max(memory);
            assert!(memory <= most << 20, "{courses} × {blocks} took {memory} bytes of {most} MiB");
            match code {
                Some(0 | UNDECIDED) => {}
                Some(USAGE) => {
                    assert!(said.contains("memory") && said.contains("hint: "), "{said}")
                }
                other => panic!("{other:?}: {said}"),
            }
        }
    }
    // The shortest runs may end before the mark is read.
    assert!(greatest > 10 << 20, "nothing was weighed");
}

#[test]
fn sizes_are_read_with_their_units() {
    let desk = desk(2, 2, 2);
    for good in ["1G", "1.5GiB", "1048576K", "2gb", "1073741824"] {
        expect(0, &run(desk.path(), &["check", "wall.json", "--max-memory", good]));
    }
    for bad in ["", "G", "-1G", "much", "1X", "nan", "1e99G"] {
        expect(USAGE, &run(desk.path(), &["check", "wall.json", "--max-memory", bad]));
    }
    let output = run(desk.path(), &["check", "wall.json", "--max-memory", "1M"]);
    expect(USAGE, &output);
    assert!(said(&output).contains("the program itself takes"), "{}", said(&output));
}

#[test]
fn the_time_limit_holds_and_the_best_bracket_so_far_is_the_answer() {
    let desk = desk(30, 30, 2);
    let limit = 2.0;
    for question in [
        &["limit"][..],
        &["assess"],
        &["tilt", "--all", "16"],
        &["repose", "--all", "16"],
        &["critical", "--vary", "/joints/default/friction", "--between", "0.01", "0.9"],
        &["thrust", "--direction", "1,0"],
        &["simulate", "--fine", "--to-the-end"],
    ] {
        let start = Instant::now();
        let output = run(
            desk.path(),
            &[question, &["wall.json", "--json", "--time-limit", &limit.to_string()]].concat(),
        );
        let took = start.elapsed();
        println!("{}: {:.2} s, exit {:?}", question[0], took.as_secs_f64(), output.status.code());
        assert!(took < Duration::from_secs_f64(limit * 1.5 + 3.0), "{question:?} took {took:?}");
        assert!(
            matches!(output.status.code(), Some(0 | 1 | UNDECIDED)),
            "{question:?}: {}",
            said(&output)
        );
        let file: Value = serde_json::from_slice(&output.stdout)
            .unwrap_or_else(|e| panic!("{question:?}: {e}: {}", said(&output)));
        if question == ["limit"] {
            let answer = &file["answer"]["load_factor"];
            assert!(answer["status"].is_string(), "{answer}");
        }
    }
}

/// A floor, and boxes on it, each moved by `step` from the one before.
fn heap(count: usize, step: f64) -> String {
    let floor = json!({ "id": "floor", "shape": { "box": { "size": [9, 9, 1] } }, "at": [0, 0, -0.5], "support": true });
    let one = |k: usize| json!({ "id": format!("b{k}"), "shape": { "box": { "size": [1, 1, 1] } }, "at": [step * k as f64, 0, 0.5] });
    let blocks: Vec<Value> = std::iter::once(floor).chain((0..count).map(one)).collect();
    json!({ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } }, "blocks": blocks }).to_string()
}

#[test]
fn blocks_in_one_place_are_one_finding_and_cost_no_more_than_elsewhere() {
    let desk = desk(1, 1, 2);
    fs::write(desk.path().join("heap.json"), heap(20_000, 0.0)).unwrap();
    // 200 million pairs, looked at one by one, would take an hour.
    let output = run(desk.path(), &["check", "heap.json", "--time-limit", "60"]);
    expect(1, &output);
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        told.contains("20000 blocks coincide corner for corner, \"b0\" to \"b19999\""),
        "{told}"
    );
    // Each touches what the first touches, and none the others.
    fs::write(desk.path().join("heap.json"), heap(3, 0.0)).unwrap();
    let output = run(desk.path(), &["check", "heap.json", "--json"]);
    let model: Value = serde_json::from_slice(&output.stdout).unwrap();
    let faces = model["interfaces"].as_array().unwrap();
    let pairs: Vec<&Value> = faces.iter().map(|f| &f["between"]).collect();
    assert_eq!(json!(pairs), json!([[0, 1], [0, 2], [0, 3]]), "{model:.2000}");
    expect(0, &run(desk.path(), &["assess", "heap.json"]));
}

#[test]
fn check_and_import_end_in_time() {
    let desk = desk(1, 1, 2);
    fs::write(desk.path().join("heap.json"), heap(2000, 1e-4)).unwrap();
    let corners = |x: f64| -> String {
        let at = |k: u8| [k & 1, k >> 1 & 1, k >> 2].map(f64::from);
        let line = |[a, b, c]: [f64; 3]| format!("v {} {b} {c}\n", a + x);
        (0..8).map(at).map(line).collect()
    };
    let faces = |n: usize| -> String {
        let all =
            [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
        let line = |f: [usize; 4]| format!("f {}\n", f.map(|v| (v + n).to_string()).join(" "));
        all.map(line).concat()
    };
    let blocks: String = (0..2000)
        .map(|k| format!("o b{k}\n{}{}", corners(1e-4 * k as f64), faces(8 * k)))
        .collect();
    fs::write(desk.path().join("heap.obj"), blocks).unwrap();
    for args in [
        &["check", "heap.json"][..],
        &["import", "heap.obj", "--support", "b0", "--friction", "0.6", "-o", "made.json"],
    ] {
        let start = Instant::now();
        let output = run(desk.path(), &[args, &["--time-limit", "2"]].concat());
        expect(UNDECIDED, &output);
        assert!(start.elapsed() < Duration::from_secs(6), "{args:?}: {:?}", start.elapsed());
        assert!(said(&output).contains("time limit reached after"), "{}", said(&output));
    }
    // What was read is there all the same.
    assert!(fs::metadata(desk.path().join("made.json")).is_ok());
    // What is not computed again in time stays open, and is not refuted.
    let save = ["simulate", "wall.json", "--fine", "--to-the-end", "--skip-verdict", "--save", "r"];
    run(desk.path(), &save);
    let output = run(desk.path(), &["check", "r", "--time-limit", "0.02"]);
    assert!([0, UNDECIDED].contains(&output.status.code().unwrap()), "{}", said(&output));
}

#[test]
fn more_threads_than_the_machine_bears_are_not_started() {
    let desk = desk(2, 2, 4);
    let output = run(desk.path(), &["simulate", "wall.json", "--fast", "--threads", "256"]);
    let most = 4 * std::thread::available_parallelism().unwrap().get();
    if most < 256 {
        assert!(
            said(&output).contains(&format!("--threads 256: limited to {most} threads")),
            "{}",
            said(&output)
        );
    }
    let mut command = command(desk.path());
    let output = command.args(["assess", "wall.json"]).env("RAYON_NUM_THREADS", "100000").output();
    let output = output.unwrap();
    expect(0, &output);
    assert!(
        said(&output).contains(&format!("RAYON_NUM_THREADS 100000: limited to {most} threads"))
    );
}
