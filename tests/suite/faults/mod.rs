//! Faults, really done: full disks, readers that go away, signals, kills, limits. Exit codes are
//! right, files are whole or absent, and what was worth keeping is kept.

mod disk;
mod files;
mod kill;
mod limits;
mod pipe;

use std::{
    path::Path,
    process::{Command, Output, Stdio},
};

const UNDECIDED: i32 = 3;
const USAGE: i32 = 2;

/// The program, run in a folder.
fn command(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
    command.current_dir(folder).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn run(folder: &Path, args: &[&str]) -> Output {
    let output = command(folder).args(args).output().unwrap();
    assert!(!said(&output).contains("panicked"), "{args:?}: {}", said(&output));
    output
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[track_caller]
fn expect(code: i32, output: &Output) {
    assert_eq!(
        output.status.code(),
        Some(code),
        "stdout: {}\nstderr: {}",
        String::from_utf8_lossy(&output.stdout),
        said(output)
    );
}

/// Names of the files in a folder, in order.
fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// A wall pushed out of its plane: `courses` × `blocks`.
fn wall(courses: usize, blocks: usize) -> String {
    serde_json::json!({
        "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } },
        "templates": [{ "wall": { "size": [1, 0.5, 0.4], "courses": courses, "blocks": blocks } }],
        "loads": { "live": [{ "weight": [0.3, 1, 0] }] }
    })
    .to_string()
}

/// A plan of `rows` rows over `wall.json`.
fn plan(rows: usize) -> String {
    serde_json::json!({
        "format": "voussoir-sweep/1", "scene": "wall.json", "question": { "limit": { "law": "associative" } },
        "vary": [{ "pointer": "/joints/default/friction", "from": 0.3, "to": 0.9, "count": rows }], "sampling": { "grid": {} }, "seed": 1
    })
    .to_string()
}

/// A folder with a wall and a plan over it.
fn desk(courses: usize, blocks: usize, rows: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("wall.json"), wall(courses, blocks)).unwrap();
    std::fs::write(folder.path().join("plan.json"), plan(rows)).unwrap();
    folder
}

/// Rows of a sweep without their times and the check sums over these, in order.
fn rows(file: &Path) -> Vec<serde_json::Value> {
    let text = std::fs::read_to_string(file).unwrap();
    let mut rows: Vec<serde_json::Value> =
        text.lines().skip(1).map(|l| serde_json::from_str(l).unwrap()).collect();
    for row in &mut rows {
        let row = row.as_object_mut().unwrap();
        row.remove("seconds");
        row.remove("sum");
    }
    rows.sort_by_key(|r| r["row"].as_u64());
    rows
}
