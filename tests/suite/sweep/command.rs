//! The command: killed and continued, sharded and merged, exit codes.

use super::arch;
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    fs,
    path::Path,
    process::{Command, Output, Stdio},
    time::{Duration, Instant},
};
use tempfile::TempDir;

/// A folder with `scene.json` and `plan.json`.
pub fn desk(samples: usize) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let plan = json!({
        "format": "voussoir-sweep/1",
        "name": "Arch",
        "scene": "scene.json",
        "question": { "limit": { "law": "associative" } },
        "vary": [
            { "pointer": "/templates/0/arch/thickness", "from": 0.15, "to": 0.3 },
            { "pointer": "/joints/default/friction", "from": 0.4, "to": 0.7 }
        ],
        "sampling": { "random": { "samples": samples } }
    });
    fs::write(folder.path().join("scene.json"), arch().to_string()).unwrap();
    fs::write(folder.path().join("plan.json"), plan.to_string()).unwrap();
    folder
}

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
    command
        .args(args)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

#[track_caller]
fn expect(code: i32, folder: &Path, args: &[&str]) -> Output {
    expect_in(code, command(folder, args).output().unwrap())
}

/// A run that ended with the code, and without a panic.
#[track_caller]
pub fn expect_in(code: i32, output: Output) -> Output {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{error}");
    assert!(!error.contains("panicked"), "{error}");
    output
}

pub fn rows(path: &Path) -> BTreeMap<u64, String> {
    let text = fs::read_to_string(path).unwrap();
    let mut rows = BTreeMap::new();
    for line in text.lines().skip(1) {
        let row: Value = serde_json::from_str(line).unwrap();
        let before = rows.insert(
            row["row"].as_u64().unwrap(),
            line.rsplit_once(",\"seconds\":").unwrap().0.to_string(),
        );
        assert!(before.is_none(), "twice: {line}");
    }
    rows
}

#[test]
fn killed_ten_times_and_continued_no_row_is_lost_or_twice() {
    const ROWS: usize = 220;
    let folder = desk(ROWS);
    let at = folder.path();
    expect(0, at, &["sweep", "plan.json", "-o", "whole.jsonl", "-q"]);
    let size = |name: &str| fs::metadata(at.join(name)).map_or(0, |m| m.len());
    let all = size("whole.jsonl");
    let mut in_the_middle = 0;
    for kill in 1..=10_u64 {
        let mut child =
            command(at, &["sweep", "plan.json", "-o", "killed.jsonl", "-q", "--threads", "3"])
                .spawn()
                .unwrap();
        // At some byte, in the middle of whatever it does then.
        let (until, patience) = (all * kill / 14, Instant::now() + Duration::from_secs(60));
        while size("killed.jsonl") < until
            && Instant::now() < patience
            && child.try_wait().unwrap().is_none()
        {
            std::thread::yield_now();
        }
        child.kill().unwrap();
        child.wait().unwrap();
        in_the_middle += usize::from(rows_there(&at.join("killed.jsonl")) < ROWS);
    }
    assert!(in_the_middle >= 3, "it was over before it was killed");
    expect(0, at, &["sweep", "plan.json", "-o", "killed.jsonl", "-q"]);
    let killed = rows(&at.join("killed.jsonl"));
    assert_eq!(killed.len(), ROWS);
    assert_eq!(killed, rows(&at.join("whole.jsonl")));
}

fn rows_there(path: &Path) -> usize {
    fs::read_to_string(path).unwrap().matches('\n').count().saturating_sub(1)
}

#[test]
fn shards_tables_charts_and_summaries() {
    let folder = desk(9);
    let at = folder.path();
    let whole = expect(
        0,
        at,
        &[
            "sweep",
            "plan.json",
            "--json",
            "--csv",
            "table.csv",
            "--svg",
            "chart.svg",
            "--chart",
            "heat",
        ],
    );
    let summary: Value = serde_json::from_slice(&whole.stdout).unwrap();
    assert_eq!(
        (summary["format"].as_str(), &summary["summary"]["counts"]),
        (Some("voussoir-summary/1"), &json!({ "found": 9 }))
    );
    assert_eq!(rows(&at.join("plan.rows.jsonl")).len(), 9);
    assert_eq!(fs::read_to_string(at.join("table.csv")).unwrap().lines().count(), 10);
    assert!(fs::read_to_string(at.join("chart.svg")).unwrap().starts_with("<svg"));
    for shard in ["1/2", "2/2"] {
        expect(
            0,
            at,
            &["sweep", "plan.json", "--shard", shard, "-o", &shard.replace('/', "-"), "-q"],
        );
    }
    let half = expect(3, at, &["sweep", "merge", "1-2", "-q"]);
    assert!(
        String::from_utf8_lossy(&half.stderr)
            .contains("4 of 9 rows are missing, the first is row 1")
    );
    expect(0, at, &["sweep", "merge", "2-2", "1-2", "-o", "merged.jsonl", "-q"]);
    assert_eq!(rows(&at.join("merged.jsonl")), rows(&at.join("plan.rows.jsonl")));
    let text = fs::read_to_string(at.join("merged.jsonl")).unwrap();
    assert!(
        text.lines().skip(1).zip(0..).all(|(line, k)| line.starts_with(&format!("{{\"row\":{k},")))
    );
}

#[test]
fn what_cannot_be_done_is_said_before_the_work() {
    let folder = desk(3);
    let at = folder.path();
    let says = |args: &[&str], word: &str| {
        let error = String::from_utf8(expect(2, at, args).stderr).unwrap();
        assert!(error.contains(word), "{error}");
    };
    says(&["sweep", "none.json"], "cannot be read");
    says(&["sweep", "plan.json", "-o", "-"], "--output needs a file");
    says(&["sweep", "plan.json", "--shard", "3/2"], "K/N");
    says(&["sweep", "plan.json", "-o", "scene.json"], "would overwrite this input");
    fs::copy(at.join("scene.json"), at.join("other.json")).unwrap();
    says(&["sweep", "plan.json", "-o", "other.json"], "not the header of a file of rows");
    says(
        &["sweep", "plan.json", "--restart", "-o", "other.json"],
        "not the header of a file of rows",
    );
    assert_eq!(fs::read_to_string(at.join("other.json")).unwrap(), arch().to_string());
    says(&["sweep", "plan.json", "-o", "nowhere/rows.jsonl"], "cannot be written");
    says(&["sweep", "plan.json", "--csv", "nowhere/table.csv"], "no such folder");
    says(&["sweep", "plan.json", "--chart", "line"], "--svg");
    says(&["sweep", "plan.json", "--svg", "chart.svg", "--chart", "line", "--shard", "0/2"], "K/N");
    says(&["sweep", "merge", "plan.json"], "not the header");
    let mut grid: Value =
        serde_json::from_str(&fs::read_to_string(at.join("plan.json")).unwrap()).unwrap();
    grid["vary"] = json!([{ "pointer": "/joints/default/friction", "values": [0.5, 0.6] }]);
    grid["sampling"] = json!({ "grid": {} });
    fs::write(at.join("grid.json"), grid.to_string()).unwrap();
    for (kind, word) in [("heat", "two numbers"), ("fragility", "a sample")] {
        says(&["sweep", "grid.json", "--svg", "chart.svg", "--chart", kind], word);
        assert!(!at.join("grid.rows.jsonl").exists());
    }
    assert_eq!(fs::read_to_string(at.join("scene.json")).unwrap(), arch().to_string());
}

#[test]
fn the_worst_case_is_an_answer_like_others() {
    let folder = desk(1);
    let at = folder.path();
    let output = expect(
        0,
        at,
        &[
            "limit",
            "scene.json",
            "--worst",
            "friction=0.6..0.7,density=2000..2400",
            "--save",
            "result.json",
        ],
    );
    let page = String::from_utf8(output.stdout).unwrap();
    for word in [
        "worst case: friction 0.6, the lowest",
        "worst case: the worst of 2 corners",
        "--worst friction=0.6..0.7,density=2000..2400",
    ] {
        assert!(page.split_whitespace().collect::<Vec<_>>().join(" ").contains(word), "{page}");
    }
    let saved: Value =
        serde_json::from_str(&fs::read_to_string(at.join("result.json")).unwrap()).unwrap();
    assert_eq!(saved["scene"]["joints"]["default"]["friction"], json!(0.6));
    expect(0, at, &["check", "result.json"]);
    let error = expect(2, at, &["assess", "scene.json", "--worst", "frictoin=1..2"]).stderr;
    assert!(String::from_utf8_lossy(&error).contains("the names are friction"));
    expect(0, at, &["schema", "plan"]);
}

/// A word of the scene varies as a number does: where a load acts.
#[test]
fn the_block_of_a_load_varies() {
    let folder = desk(1);
    let at = folder.path();
    let stack = json!({
        "format": "voussoir-scene/1",
        "joints": { "default": { "friction": 0.9 } },
        "blocks": [
            { "id": "ground", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "low", "shape": { "box": { "size": [0.4, 1, 1] } }, "at": [0, 0, 0.5] },
            { "id": "high", "shape": { "box": { "size": [0.4, 1, 1] } }, "at": [0, 0, 1.5] }
        ],
        "loads": { "live": [{ "block": "low", "force": [1000, 0, 0] }] }
    });
    let plan = json!({
        "format": "voussoir-sweep/1",
        "scene": "stack.json",
        "question": { "limit": { "law": "associative" } },
        "vary": [
            { "pointer": "/loads/live/0/block", "name": "pushed", "values": ["low", "high"] },
            { "pointer": "/joints/default/friction", "values": [0.9, "infinite"] }
        ]
    });
    fs::write(at.join("stack.json"), stack.to_string()).unwrap();
    fs::write(at.join("words.json"), plan.to_string()).unwrap();
    let files = ["--csv", "t.csv", "--svg", "c.svg", "--report", "r.html"];
    expect(0, at, &[&["sweep", "words.json", "-q"], &files[..]].concat());
    let rows: Vec<Value> = rows(&at.join("words.rows.jsonl"))
        .values()
        .map(|l| serde_json::from_str(&format!("{l}}}")).unwrap())
        .collect();
    assert_eq!(rows[0]["parameters"], json!(["low", 0.9]));
    assert_eq!(rows[3]["parameters"], json!(["high", "infinite"]));
    // Two blocks of 960 kg tip about the edge on the ground, pushed half a block or three halves
    // above it.
    let weight = 0.4 * 2400.0 * 9.81;
    let value = |k: usize| rows[k]["value"].as_f64().unwrap() * 1000.0;
    assert!((value(1) - 2.0 * weight * 0.2 / 0.5).abs() < 1e-6 * weight, "{rows:?}");
    assert!((value(3) - 2.0 * weight * 0.2 / 1.5).abs() < 1e-6 * weight, "{rows:?}");
    assert!(fs::read_to_string(at.join("t.csv")).unwrap().contains("\"high\",\"infinite\""));
    assert!(fs::read_to_string(at.join("c.svg")).unwrap().contains("high"));
    // The same command finds its rows again.
    expect(0, at, &["sweep", "words.json", "-q"]);
}

/// Rows without an answer reach who reads one line, and who reads the exit code.
#[test]
fn rows_that_fail_are_no_success() {
    let folder = desk(1);
    let at = folder.path();
    let mut plan: Value =
        serde_json::from_str(&fs::read_to_string(at.join("plan.json")).unwrap()).unwrap();
    // The second arch is thicker than its radius allows.
    plan["vary"] = json!([{ "pointer": "/templates/0/arch/thickness", "values": [0.2, 3, 0.25] }]);
    plan["sampling"] = json!({ "grid": {} });
    fs::write(at.join("fails.json"), plan.to_string()).unwrap();
    for args in [
        &["sweep", "fails.json", "-q", "--svg", "c.svg"][..],
        &["sweep", "fails.json", "-q"],
        &["sweep", "merge", "fails.rows.jsonl", "-q"],
    ] {
        let output = expect(3, at, args);
        let (out, err) =
            (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(out.contains("3 rows: 1 error, 2 found"), "{out}");
        assert!(err.contains("1 of 3 rows has no answer, the first is row 1: "), "{err}");
    }
    assert!(fs::read_to_string(at.join("c.svg")).unwrap().contains("error: 1 row"));
    let json: Value =
        serde_json::from_slice(&expect(3, at, &["sweep", "fails.json", "--json"]).stdout).unwrap();
    assert_eq!(
        (&json["summary"]["open"], &json["summary"]["counts"]["error"]),
        (&json!(1), &json!(1))
    );
}
