//! The command line by behaviour: exit codes, what is printed where, files written whole or not at
//! all, and saved results that are refused as soon as anything in them is changed.

mod answers;
mod checked;
mod edges;
mod files;
mod in_time;
mod next;
mod pictures;
mod proofs;
mod scenes;
mod verbs;
mod weakened;
mod words;

use serde_json::{Value, json};
use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};
use tempfile::TempDir;

const YES: i32 = 0;
const NO: i32 = 1;
const USAGE: i32 = 2;
const UNDECIDED: i32 = 3;

fn command() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
    command.env_remove("NO_COLOR").stdin(Stdio::null());
    command
}

fn voussoir(args: &[&str]) -> Output {
    ended(command().args(args).output().unwrap())
}

fn with_input(args: &[&str], input: &str) -> Output {
    let mut child = command()
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A refusal may come before the input is read.
    if let Err(e) = child.stdin.take().unwrap().write_all(input.as_bytes()) {
        assert_eq!(e.kind(), std::io::ErrorKind::BrokenPipe);
    }
    ended(child.wait_with_output().unwrap())
}

/// Whatever was asked, no panic.
fn ended(output: Output) -> Output {
    assert!(!err(&output).contains("panicked"), "{}", err(&output));
    output
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("ended by a signal")
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[track_caller]
fn expect(wanted: i32, output: Output) -> Output {
    assert_eq!(code(&output), wanted, "stdout: {}\nstderr: {}", out(&output), err(&output));
    output
}

/// A folder with scenes: `arch` stands, `thin` falls, `pushed` has a live load.
struct Desk(TempDir);

impl Desk {
    fn new() -> Self {
        let desk = Self(TempDir::new().unwrap());
        expect(
            YES,
            voussoir(&[
                "generate",
                "arch",
                "voussoirs=15",
                "--density",
                "2400",
                "--expand",
                "-o",
                &desk.at("arch.json"),
            ]),
        );
        expect(
            YES,
            voussoir(&[
                "generate",
                "arch",
                "voussoirs=15",
                "thickness=0.3",
                "-o",
                &desk.at("thin.json"),
            ]),
        );
        let mut pushed = desk.read("arch.json");
        pushed["loads"] = json!({ "live": [{ "weight": [1, 0, 0] }] });
        desk.write("pushed.json", &pushed);
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn at(&self, name: &str) -> String {
        self.path(name).to_str().unwrap().to_string()
    }

    fn read(&self, name: &str) -> Value {
        serde_json::from_str(&fs::read_to_string(self.path(name)).unwrap()).unwrap()
    }

    fn write(&self, name: &str, value: &Value) -> String {
        fs::write(self.path(name), value.to_string()).unwrap();
        self.at(name)
    }

    /// Asks a question, saves the result and reads it.
    fn saved(&self, wanted: i32, question: &[&str]) -> Value {
        let result = self.at("saved.json");
        expect(wanted, voussoir(&[question, &["--save", &result, "-q"]].concat()));
        self.read("saved.json")
    }

    #[track_caller]
    fn checked(&self, wanted: i32, result: &Value) -> String {
        let file = self.write("checked.json", result);
        out(&expect(wanted, voussoir(&["check", &file])))
    }

    fn files(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.0.path())
            .unwrap()
            .map(|e| e.unwrap().file_name().to_str().unwrap().to_string())
            .collect();
        names.sort();
        names
    }
}

fn structure(args: &[&str], name: &str) -> Output {
    let path = format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"));
    voussoir(&[args, &[path.as_str()]].concat())
}

fn scale(v: &mut Value, factor: f64) {
    v.as_array_mut().unwrap().iter_mut().for_each(|c| *c = json!(c.as_f64().unwrap() * factor));
}
