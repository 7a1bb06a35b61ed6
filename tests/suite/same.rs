//! The same answer everywhere: whatever the threads, and however often, the same bytes but for
//! times.

use serde_json::Value;
use std::{
    path::Path,
    process::Command,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
};

/// A result without what time and place have to do with.
fn timeless(mut value: Value) -> String {
    fn strip(value: &mut Value) {
        match value {
            Value::Object(map) => {
                for key in ["timings", "seconds", "peak_memory", "sum"] {
                    map.remove(key);
                }
                map.values_mut().for_each(strip);
            }
            Value::Array(list) => list.iter_mut().for_each(strip),
            _ => {}
        }
    }
    strip(&mut value);
    value.to_string()
}

fn answer(folder: &Path, args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_voussoir"))
        .current_dir(folder)
        .args(args)
        .output()
        .unwrap();
    assert!(
        matches!(output.status.code(), Some(0 | 1 | 3)),
        "{args:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    timeless(serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{args:?}: {e}")))
}

const STRUCTURES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/structures");

#[test]
fn twenty_answers_are_the_same_bytes() {
    let folder = Path::new(STRUCTURES);
    for args in [
        &["assess", "squeezed-block.json", "--json"][..],
        &["limit", "block-in-groove.json", "--json"],
        &["assess", "dome-with-oculus.json", "--json", "--law", "associative"],
        &["tilt", "sphere-pile.json", "--json", "--all", "3", "--law", "associative"],
        &["thrust", "semicircular-arch-thick.json", "--json"],
        &["check", "arch-at-critical-plus.json"],
    ] {
        let ask = || match args[0] {
            "check" => String::from_utf8(
                Command::new(env!("CARGO_BIN_EXE_voussoir"))
                    .current_dir(folder)
                    .args(args)
                    .output()
                    .unwrap()
                    .stdout,
            )
            .unwrap(),
            _ => answer(folder, args),
        };
        let first = ask();
        let again: Vec<String> = std::thread::scope(|s| {
            let threads: Vec<_> =
                (0..4).map(|_| s.spawn(|| (0..5).map(|_| ask()).collect::<Vec<_>>())).collect();
            threads.into_iter().flat_map(|t| t.join().unwrap()).collect()
        });
        assert_eq!(again.len(), 20);
        for other in &again {
            // The page of `check` ends with its times.
            let cut = |s: &str| {
                s.lines()
                    .filter(|l| !l.trim_start().starts_with("time "))
                    .map(str::to_owned)
                    .collect::<Vec<_>>()
            };
            assert_eq!(cut(other), cut(&first), "{args:?}");
        }
    }
}

#[test]
fn threads_change_no_byte() {
    let folder = Path::new(STRUCTURES);
    for args in [
        &["simulate", "running-bond-wall.json", "--fast", "--json"][..],
        &["simulate", "semicircular-arch-thin.json", "--json"],
        &["assess", "sphere-pile.json", "--simulate", "--json"],
    ] {
        let with = |threads: &str| answer(folder, &[args, &["--threads", threads]].concat());
        let one = with("1");
        for threads in ["4", "2", "4"] {
            assert!(with(threads) == one, "{args:?} differs with {threads} threads");
        }
    }
}

#[test]
fn a_time_limit_that_is_not_reached_changes_no_byte() {
    // Under a limit the engine runs on a thread of its own, and a bound and the verdict beside it one
    // after the other.
    let folder = Path::new(STRUCTURES);
    for args in [
        &["assess", "squeezed-block.json", "--json"][..],
        &["limit", "two-block-column.json", "--json"],
        &["limit", "wall-with-openings.json", "--json", "--law", "associative"],
        &["limit", "running-bond-wall-40.json", "--json", "--law", "associative"],
    ] {
        assert!(
            answer(folder, &[args, &["--time-limit", "1000"]].concat()) == answer(folder, args),
            "{args:?}"
        );
    }
}

#[test]
fn rows_of_a_sweep_are_the_same_whatever_the_threads() {
    let out = tempfile::tempdir().unwrap();
    let plan = format!("{STRUCTURES}/sweeps/arch-in-earthquake.json");
    let rows = |threads: &str| {
        let file = out.path().join(format!("rows-{threads}.jsonl"));
        let shard = [
            "sweep",
            &plan,
            "--threads",
            threads,
            "--shard",
            "3/40",
            "--quiet",
            "-o",
            file.to_str().unwrap(),
        ];
        assert!(
            Command::new(env!("CARGO_BIN_EXE_voussoir"))
                .args(shard)
                .output()
                .unwrap()
                .status
                .success()
        );
        let text = std::fs::read_to_string(file).unwrap();
        let mut rows: Vec<String> =
            text.lines().map(|l| timeless(serde_json::from_str(l).unwrap())).collect();
        rows.sort();
        rows
    };
    let one = rows("1");
    assert!(one.len() > 5);
    assert_eq!(rows("4"), one);
}

/// The questions that are asked of every structure. The largest are asked for associative sliding
/// alone, which takes seconds where dry friction takes minutes without optimisation.
fn questions() -> Vec<Vec<String>> {
    let mut names: Vec<String> = std::fs::read_dir(STRUCTURES)
        .unwrap()
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".json") && name != "expected.json")
        .collect();
    names.sort();
    let mut all = Vec::new();
    for name in names {
        let large = name.contains("1000") || name.contains("-40.");
        let law = if large { "--law=associative" } else { "--law=coulomb" };
        let loaded = std::fs::read_to_string(Path::new(STRUCTURES).join(&name))
            .unwrap()
            .contains("\"live\"");
        let mut asked = vec![vec!["assess", law], vec!["check"]];
        if loaded {
            asked.push(vec!["limit", law]);
        }
        if !large {
            asked.extend([
                vec!["tilt", "--all=2", law],
                vec!["thrust"],
                vec!["simulate", "--fast", "--skip-verdict", "--seconds=0.3"],
            ]);
        }
        all.extend(asked.into_iter().map(|q| {
            [&[q[0], name.as_str(), "--json"], &q[1..]]
                .concat()
                .into_iter()
                .map(String::from)
                .collect()
        }));
    }
    all
}

#[test]
#[ignore = "builds the program once more, with or without optimisation: minutes"]
fn debug_and_release_give_the_same_bytes() {
    let other = if cfg!(debug_assertions) { "release" } else { "debug" };
    let mut build = Command::new(env!("CARGO"));
    build
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["build", "--quiet"])
        .args((other == "release").then_some("--release"));
    assert!(build.status().unwrap().success());
    let this = Path::new(env!("CARGO_BIN_EXE_voussoir"));
    let that = this.parent().unwrap().parent().unwrap().join(other).join(this.file_name().unwrap());
    let ask = |program: &Path, question: &[String]| {
        let output = Command::new(program).current_dir(STRUCTURES).args(question).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (
            output.status.code(),
            said,
            serde_json::from_slice(&output.stdout).map_or_else(|_| String::new(), timeless),
        )
    };
    let questions = questions();
    let (answered, differ) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    voussoir::parallel::for_each(0, &questions, |question| {
        let answer = ask(this, question);
        answered.fetch_add(usize::from(!answer.2.is_empty()), Ordering::Relaxed);
        if answer != ask(&that, question) {
            differ.lock().unwrap().push(question.join(" "));
        }
        Ok::<(), ()>(())
    })
    .unwrap()
    .unwrap();
    let mut differ = differ.into_inner().unwrap();
    differ.sort();
    let answered = answered.into_inner();
    println!("{} questions, {answered} answers, {} differ", questions.len(), differ.len());
    // Some scenes have no thrust.
    assert!(differ.is_empty() && answered > questions.len() * 9 / 10, "{differ:#?}");
}
