//! The command line by behaviour: exit codes, what is printed where, files written whole or not at all, and saved results
//! that are refused as soon as anything in them is changed.

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
    let mut child = command().args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
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
        expect(YES, voussoir(&["generate", "arch", "voussoirs=15", "--density", "2400", "--expand", "-o", &desk.at("arch.json")]));
        expect(YES, voussoir(&["generate", "arch", "voussoirs=15", "thickness=0.3", "-o", &desk.at("thin.json")]));
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
        let mut names: Vec<String> =
            fs::read_dir(self.0.path()).unwrap().map(|e| e.unwrap().file_name().to_str().unwrap().to_string()).collect();
        names.sort();
        names
    }
}

fn norm(v: &Value) -> f64 {
    v.as_array().unwrap().iter().map(|c| c.as_f64().unwrap().powi(2)).sum::<f64>().sqrt()
}

/// The greatest force of a certificate: contact and point.
fn greatest_force(certificate: &Value) -> (usize, usize) {
    let contacts = certificate["forces"].as_array().unwrap();
    let mut greatest = (0, 0, 0.0);
    for (i, contact) in contacts.iter().enumerate() {
        for (j, force) in contact["forces"].as_array().unwrap().iter().enumerate() {
            if norm(force) > greatest.2 {
                greatest = (i, j, norm(force));
            }
        }
    }
    (greatest.0, greatest.1)
}

fn scale(v: &mut Value, factor: f64) {
    v.as_array_mut().unwrap().iter_mut().for_each(|c| *c = json!(c.as_f64().unwrap() * factor));
}

#[test]
fn exit_codes_say_what_the_answer_is() {
    let desk = Desk::new();
    let (arch, thin, pushed) = (desk.at("arch.json"), desk.at("thin.json"), desk.at("pushed.json"));
    expect(YES, voussoir(&["assess", &arch]));
    expect(NO, voussoir(&["assess", &thin]));
    expect(UNDECIDED, voussoir(&["assess", &arch, "--time-limit", "1e-9"]));
    expect(YES, voussoir(&["limit", &pushed]));
    expect(YES, voussoir(&["limit", &pushed, "--require", "0.1"]));
    expect(NO, voussoir(&["limit", &pushed, "--require", "0.9"]));
    expect(YES, voussoir(&["tilt", &arch, "--toward", "-1,0", "--require", "5"]));
    expect(NO, voussoir(&["tilt", &arch, "--toward", "1,0,0", "--require", "45"]));
    expect(USAGE, voussoir(&["limit", &arch]));
    expect(USAGE, voussoir(&["assess", &desk.at("none.json")]));
    expect(USAGE, voussoir(&["tilt", &arch, "--toward", "0,0,1"]));
    let critical = |more: &[&str]| voussoir(&[&["critical", &arch, "--law", "associative"], more].concat());
    expect(YES, critical(&["--vary", "/joints/default/friction", "--between", "0.9", "0.1", "--step", "0.3"]));
    expect(NO, critical(&["--vary", "/joints/default/friction", "--between", "0.8", "0.9"]));
    expect(YES, voussoir(&["thrust", &arch, "--support", "springer_right", "--direction", "-1,0"]));
    expect(NO, voussoir(&["thrust", &thin]));
    expect(USAGE, critical(&["--vary", "/joints/default/frictoin", "--between", "0.1", "0.9"]));
    expect(USAGE, voussoir(&["thrust", &arch, "--support", "v03"]));
    expect(USAGE, voussoir(&["thrust", &arch, "--direction", "0,0,1"]));
    for wrong in [
        &["critical", &arch][..],
        &["critical", &arch, "--vary", "/gravity/0"],
        &["critical", &arch, "--vary", "/gravity/0", "--between", "1"],
        &["critical", &arch, "--vary", "/gravity/0", "--between", "1", "1"],
        &["critical", &arch, "--vary", "/gravity/0", "--between", "0", "inf"],
        &["critical", &arch, "--vary", "/gravity/0", "--between", "0", "1", "--scan", "1"],
        &["critical", &arch, "--vary", "/gravity/0", "--between", "0", "1", "--step", "1e-9"],
        &["critical", &arch, "--vary", "gravity", "--between", "0", "1"],
        &["thrust", &arch, "--support", "nobody"],
        &["thrust", &arch, "--svg", "no/such/folder.svg"],
        &["nonsense"],
        &["assess"],
        &["assess", &arch, "--nonsense"],
        &["assess", &arch, "--time-limit", "0"],
        &["tilt", &arch, "--all", "0"],
        &["tilt", &arch, "--toward", "1"],
        &["tilt", &arch, "--require", "NaN"],
        &[],
    ] {
        let answer = expect(USAGE, voussoir(wrong));
        assert!(out(&answer).is_empty() && !err(&answer).is_empty());
    }
    for fine in [&["--help"][..], &["help", "limit"], &["--version"], &["schema"], &["generate", "--list"]] {
        let answer = expect(YES, voussoir(fine));
        assert!(!out(&answer).is_empty() && err(&answer).is_empty());
    }
}

#[test]
fn a_requirement_inside_the_bracket_is_not_rounded_up() {
    let desk = Desk::new();
    let value = desk.saved(YES, &["limit", &desk.at("pushed.json")])["answer"]["load_factor"]["upper"].as_f64().unwrap();
    expect(UNDECIDED, voussoir(&["limit", &desk.at("pushed.json"), "--require", &format!("{value:.17}")]));
}

/// A block in a groove and a block under a roof: the bound meets what dry friction does not.
#[test]
fn a_bound_alone_meets_no_requirement() {
    let scene = |name: &str| format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"));
    for (name, bound_only, both, neither) in [("block-in-groove", "0.75", "0.7", "0.9"), ("block-under-roof", "1", "0.399", "-")] {
        expect(NO, voussoir(&["limit", &scene(name), "--require", bound_only]));
        expect(YES, voussoir(&["limit", &scene(name), "--require", bound_only, "--law", "associative"]));
        expect(YES, voussoir(&["limit", &scene(name), "--require", both]));
        if neither != "-" {
            expect(NO, voussoir(&["limit", &scene(name), "--require", neither, "--law", "associative"]));
        }
        let first = out(&expect(YES, voussoir(&["limit", &scene(name), "--quiet"])));
        assert!(first.contains("dry friction"), "{first}");
    }
}

#[test]
fn a_block_tips_over_its_edge_or_slides() {
    let desk = Desk::new();
    for (height, mu, tangent) in [(4.0, "0.7", 0.25), (0.5, "0.3", 0.3)] {
        let size = format!("size=[1,1,{height}]");
        let scene = desk.at("block.json");
        expect(YES, voussoir(&["generate", "column", "blocks=1", &size, "--friction", mu, "-o", &scene]));
        let result = desk.saved(YES, &["tilt", &scene]);
        assert_eq!(result["directions"].as_array().unwrap().len(), 8);
        let angle = result["answer"]["tilt_deg"].as_f64().unwrap();
        assert!((angle - f64::atan(tangent).to_degrees()).abs() < 1e-6, "{angle}");
        assert_eq!(result["dead_load"]["answer"]["verdict"], "stable");
    }
}

#[test]
fn json_is_one_object_and_nothing_else() {
    let desk = Desk::new();
    for (wanted, args) in [
        (YES, vec!["assess", "arch.json"]),
        (NO, vec!["assess", "thin.json"]),
        (UNDECIDED, vec!["limit", "pushed.json", "--time-limit", "1e-9"]),
        (YES, vec!["limit", "pushed.json"]),
        (YES, vec!["tilt", "arch.json", "--all", "4"]),
        (YES, vec!["critical", "arch.json", "--vary", "/joints/default/friction", "--between", "0.1", "0.9", "--scan", "5"]),
        (NO, vec!["critical", "arch.json", "--vary", "/joints/default/friction", "--between", "0.7", "0.9", "--scan", "2"]),
        (UNDECIDED, vec!["critical", "arch.json", "--vary", "/gravity/0", "--between", "0", "1", "--time-limit", "1e-9"]),
        (YES, vec!["thrust", "arch.json"]),
        (NO, vec!["thrust", "thin.json"]),
        (UNDECIDED, vec!["thrust", "arch.json", "--time-limit", "1e-9"]),
    ] {
        let answer = ended(command().current_dir(desk.0.path()).args(&args).arg("--json").output().unwrap());
        let answer = expect(wanted, answer);
        let value: Value = serde_json::from_str(&out(&answer)).unwrap();
        assert_eq!(value["format"], "voussoir-result/1");
        assert_eq!(value["question"], args[0]);
        assert!(err(&answer).is_empty());
        // What is printed can be piped into the check.
        let check = if wanted == UNDECIDED { UNDECIDED } else { YES };
        expect(check, with_input(&["check", "-"], &out(&answer)));
    }
}

#[test]
fn scenes_come_from_standard_input() {
    let scene = out(&expect(YES, voussoir(&["generate", "column"])));
    let answer = expect(YES, with_input(&["assess", "-"], &scene));
    assert!(out(&answer).starts_with("Column: stands\n"), "{}", out(&answer));
    let answer = expect(USAGE, with_input(&["assess", "-"], &scene[..scene.len() / 2]));
    assert!(err(&answer).contains("standard input:") && err(&answer).contains("hint: "), "{}", err(&answer));
}

#[test]
fn text_says_the_answer_first_and_what_next() {
    let desk = Desk::new();
    let text = out(&expect(YES, voussoir(&["assess", &desk.at("arch.json")])));
    assert!(text.starts_with("Arch: stands\n\n"), "{text}");
    assert!(text.contains("17 blocks (2 supports), 16 interfaces, 64 contact points") && text.contains("voussoir tilt "), "{text}");
    assert!(text.lines().count() < 24 && !text.contains('\x1b'), "{text}");
    let text = out(&expect(YES, voussoir(&["assess", &desk.at("arch.json"), "--verbose"])));
    assert!(text.contains("iterations"), "{text}");
    let text = out(&expect(NO, voussoir(&["assess", &desk.at("thin.json"), "--color", "always"])));
    assert!(text.contains("\x1b[1;31mfalls") && text.contains("hinges"), "{text}");
    let text = out(&expect(YES, voussoir(&["limit", &desk.at("pushed.json"), "--quiet"])));
    assert!(text.starts_with("Arch: λ = 0.1") && text.lines().count() == 1, "{text}");
}

/// A terminal of 40 lines shows the whole answer, first line included; `--verbose` says the rest.
#[test]
fn an_answer_fits_one_screen() {
    for (wanted, question) in [
        (YES, &["limit", "running-bond-wall.json"][..]),
        (YES, &["limit", "wall-with-openings.json"]),
        (YES, &["tilt", "wall-with-two-openings.json", "--all", "16"]),
        (YES, &["thrust", "semicircular-arch-thick.json"]),
        (NO, &["assess", "semicircular-arch-thin.json"]),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("structures").join(question[1]);
        let asked = [&[question[0], path.to_str().unwrap()], &question[2..], &["--law", "associative"]].concat();
        let short = out(&expect(wanted, voussoir(&asked)));
        let long = out(&expect(wanted, voussoir(&[&asked[..], &["--verbose"]].concat())));
        assert!(short.lines().count() <= 40, "{} lines:\n{short}", short.lines().count());
        assert!(long.lines().count() > short.lines().count() && !long.contains("--verbose for all"), "{long}");
        assert_eq!(short.lines().next(), long.lines().next());
    }
}

#[test]
fn digits_beyond_the_bracket_are_not_shown() {
    let desk = Desk::new();
    let text = out(&expect(YES, voussoir(&["limit", &desk.at("pushed.json"), "-q"])));
    let shown = text.trim().rsplit(' ').next().unwrap();
    let answer = &desk.saved(YES, &["limit", &desk.at("pushed.json")])["answer"]["load_factor"];
    let width = answer["upper"].as_f64().unwrap() - answer["lower"].as_f64().unwrap();
    let decimals = shown.split_once('.').unwrap().1.len() as i32;
    assert!(10f64.powi(-decimals) >= width && decimals >= 5, "{shown} ± {width}");
}

#[test]
fn results_are_written_whole_or_not_at_all() {
    let desk = Desk::new();
    let before = desk.files();
    // The target is tried before anything is read.
    for target in ["no-folder/r.json", ""] {
        let answer = expect(USAGE, voussoir(&["assess", &desk.at("none.json"), "--save", &desk.at(target)]));
        assert!(err(&answer).contains("cannot be written") && out(&answer).is_empty(), "{}", err(&answer));
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

#[test]
fn a_stable_result_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(YES, &["assess", &desk.at("arch.json")]);
    assert!(desk.checked(YES, &good).starts_with("Arch: proved\n"));
    let (i, j) = greatest_force(&good["certificate"]);
    type Change<'a> = (&'a str, Box<dyn Fn(&mut Value) + 'a>);
    let changes: Vec<Change> = vec![
        ("one force", Box::new(|r| scale(&mut r["certificate"]["forces"][i]["forces"][j], 1.0 + 1e-6))),
        ("one force turned", Box::new(|r| scale(&mut r["certificate"]["forces"][i]["forces"][j], -1.0))),
        ("a contact dropped", Box::new(|r| drop(r["certificate"]["forces"].as_array_mut().unwrap().remove(i)))),
        ("a point moved", Box::new(|r| scale(&mut r["certificate"]["forces"][i]["points"][j], 1.001))),
        ("a force dropped", Box::new(|r| drop(r["certificate"]["forces"][i]["forces"].as_array_mut().unwrap().remove(j)))),
        ("an unknown block", Box::new(|r| r["certificate"]["forces"][i]["between"][0] = json!("nobody"))),
        ("the verdict", Box::new(|r| r["answer"]["verdict"] = json!("unstable"))),
        ("the verdict undecided", Box::new(|r| r["answer"]["verdict"] = json!("undecided"))),
        ("the claim", Box::new(|r| r["certificate"]["claim"] = json!("unstable"))),
        ("verdict and claim", Box::new(|r| (r["answer"]["verdict"], r["certificate"]["claim"]) = (json!("unstable"), json!("unstable")))),
        ("no claim", Box::new(|r| drop(r["certificate"].as_object_mut().unwrap().remove("claim")))),
        ("no verdict", Box::new(|r| drop(r["answer"].as_object_mut().unwrap().remove("verdict")))),
        ("no unbalance", Box::new(|r| drop(r["answer"].as_object_mut().unwrap().remove("unbalance")))),
        ("the unbalance", Box::new(|r| r["answer"]["unbalance"]["upper"] = json!(1e-3))),
        ("a count", Box::new(|r| r["scene"]["contact_points"] = json!(1))),
        ("another question", Box::new(|r| r["question"] = json!("limit"))),
        ("a density", Box::new(|r| r["scene"]["input"]["blocks"][5]["density"] = json!(2400.01))),
        ("the friction", Box::new(|r| r["scene"]["input"]["joints"]["default"]["friction"] = json!(0.01))),
        ("a load", Box::new(|r| r["scene"]["input"]["loads"] = json!({"dead": [{"block": "v05", "force": [1, 0, 0]}]}))),
    ];
    for (what, change) in changes {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good, "{what}");
        let text = desk.checked(NO, &bad);
        assert!(text.starts_with("Arch: refuted\n") && text.contains("fails"), "{what}: {text}");
    }
}

#[test]
fn an_unstable_result_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(NO, &["assess", &desk.at("thin.json")]);
    desk.checked(YES, &good);
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good);
        desk.checked(NO, &bad);
    };
    changed(&|r| scale(&mut r["certificate"]["rates"][3]["velocity"], 1.001));
    changed(&|r| scale(&mut r["certificate"]["rates"][3]["spin"], 0.5));
    changed(&|r| drop(r["certificate"]["rates"].as_array_mut().unwrap().remove(0)));
    changed(&|r| r["certificate"]["rates"][0]["block"] = json!("springer_left"));
    changed(&|r| r["answer"]["verdict"] = json!("stable"));
    changed(&|r| (r["answer"]["verdict"], r["certificate"]["claim"]) = (json!("stable"), json!("stable")));
    changed(&|r| r["answer"]["unbalance"]["lower"] = json!(1.0));
    changed(&|r| drop(r["mechanism"]["moving"].as_array_mut().unwrap().remove(0)));
    changed(&|r| r["mechanism"]["joints"][0]["motion"] = json!("slide"));
    changed(&|r| r["scene"]["input"]["templates"][0]["arch"]["thickness"] = json!(0.8));
}

#[test]
fn a_load_factor_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(YES, &["limit", &desk.at("pushed.json")]);
    desk.checked(YES, &good);
    let (i, j) = greatest_force(&good["certificate"]);
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good);
        desk.checked(NO, &bad);
    };
    let more = |v: &mut Value| *v = json!(v.as_f64().unwrap() * 1.001);
    changed(&|r| more(&mut r["answer"]["load_factor"]["value"]));
    changed(&|r| more(&mut r["certificate"]["claim"]["load_factor"]["value"]));
    changed(&|r| {
        for end in ["value", "lower", "upper"] {
            more(&mut r["answer"]["load_factor"][end]);
            more(&mut r["certificate"]["claim"]["load_factor"][end]);
        }
    });
    changed(&|r| r["answer"]["load_factor"]["status"] = json!("unbounded"));
    changed(&|r| drop(r["answer"]["load_factor"].as_object_mut().unwrap().remove("upper")));
    changed(&|r| scale(&mut r["certificate"]["forces"][i]["forces"][j], 1.01));
    changed(&|r| scale(&mut r["certificate"]["rates"][2]["velocity"], 1.01));
    changed(&|r| r["scene"]["input"]["blocks"][5]["density"] = json!(2500));
    changed(&|r| r["scene"]["input"]["loads"]["live"][0]["weight"] = json!([1.01, 0, 0]));
    changed(&|r| r["dead_load"]["answer"]["verdict"] = json!("unstable"));
    changed(&|r| drop(r["dead_load"]["certificate"].as_object_mut().unwrap().remove("claim")));
    changed(&|r| r["answer"]["tilt_deg"] = json!(10));
}

#[test]
fn a_load_factor_with_dry_friction_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(YES, &["limit", concat!(env!("CARGO_MANIFEST_DIR"), "/structures/block-in-groove.json")]);
    desk.checked(YES, &good);
    let (i, j) = greatest_force(&good["dry"]["certificate"]);
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good);
        desk.checked(NO, &bad);
    };
    changed(&|r| r["dry"]["value"] = json!(0.75));
    changed(&|r| {
        r["dry"]["value"] = json!(0.71);
        r["dry"]["certificate"]["claim"]["dry_load_factor"]["value"] = json!(0.71);
    });
    changed(&|r| drop(r["dry"]["certificate"].as_object_mut().unwrap().remove("claim")));
    changed(&|r| r["dry"]["found"] = json!("undecided"));
    changed(&|r| r["dry"]["found"] = json!("unlimited"));
    changed(&|r| scale(&mut r["dry"]["certificate"]["forces"][i]["forces"][j], 1.01));
    changed(&|r| r["dry"]["certificate"]["forces"] = r["certificate"]["forces"].clone());
    // The associative mechanism lifts where it slides.
    changed(&|r| r["dry"]["certificate"]["rates"] = r["certificate"]["rates"].clone());
}

#[test]
fn a_tilt_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(YES, &["tilt", &desk.at("arch.json"), "--all", "4"]);
    desk.checked(YES, &good);
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good);
        desk.checked(NO, &bad);
    };
    changed(&|r| r["answer"]["tilt_deg"] = json!(r["answer"]["tilt_deg"].as_f64().unwrap() + 1e-6));
    changed(&|r| {
        // The strongest direction in place of the weakest.
        let list = r["directions"].as_array().unwrap();
        let angle = |d: &Value| d["answer"]["tilt_deg"].as_f64().unwrap();
        let strongest = list.iter().max_by(|a, b| angle(a).total_cmp(&angle(b))).unwrap().clone();
        r["answer"] = strongest["answer"].clone();
        r["certificate"] = strongest["certificate"].clone();
    });
    changed(&|r| r["directions"][1]["answer"]["toward"] = json!([0.6, 0.8, 0.0]));
    changed(&|r| r["directions"][1]["answer"]["toward"] = json!([0.0, 0.0, 1.0]));
    changed(&|r| drop(r["directions"][1]["answer"].as_object_mut().unwrap().remove("toward")));
    changed(&|r| scale(&mut r["directions"][2]["certificate"]["rates"][0]["velocity"], 1.1));
    let one = desk.saved(YES, &["tilt", &desk.at("arch.json"), "--toward", "1,1", "--skip-dead"]);
    assert!(one.get("directions").is_none() && one.get("dead_load").is_none());
    desk.checked(YES, &one);
}

#[test]
fn loads_without_limit_and_without_answer_are_proved_as_well() {
    let desk = Desk::new();
    let mut scene: Value = serde_json::from_str(&out(&expect(YES, voussoir(&["generate", "column", "blocks=3"])))).unwrap();
    scene["loads"] = json!({ "live": [{ "weight": [0.1, 0, -1] }] });
    let result = desk.saved(YES, &["limit", &desk.write("down.json", &scene), "--require", "1e9"]);
    assert_eq!(result["answer"]["load_factor"]["status"], "unbounded");
    desk.checked(YES, &result);
    let mut bad = result.clone();
    bad["certificate"].as_object_mut().unwrap().remove("base");
    desk.checked(NO, &bad);
    let mut bad = result;
    bad["certificate"]["claim"]["unbounded"]["standing"] = json!(-1e3);
    desk.checked(NO, &bad);

    // The upper block leans out of its support along x, and the live load acts along y.
    scene["templates"] = json!([{ "stack": { "blocks": 2, "size": [1, 1, 0.2], "shift": 0.6 } }]);
    scene["loads"] = json!({ "live": [{ "weight": [0, 1, 0] }] });
    let result = desk.saved(NO, &["limit", &desk.write("out.json", &scene)]);
    assert_eq!(result["answer"]["load_factor"]["status"], "impossible", "{}", result["answer"]);
    desk.checked(YES, &result);
}

#[test]
fn a_result_is_verified_against_the_scene_that_the_reader_trusts() {
    let desk = Desk::new();
    let mut result = desk.saved(YES, &["assess", &desk.at("arch.json")]);
    // The scene inside is not looked at.
    result["scene"]["input"]["blocks"][5]["density"] = json!(1.0);
    let file = desk.write("doubtful.json", &result);
    expect(NO, voussoir(&["check", &file]));
    expect(YES, voussoir(&["check", &file, "--scene", &desk.at("arch.json")]));
    expect(NO, voussoir(&["check", &file, "--scene", &desk.at("thin.json")]));
    expect(USAGE, voussoir(&["check", &file, "--scene", &desk.at("none.json")]));
    expect(USAGE, voussoir(&["check", &desk.at("arch.json"), "--scene", &desk.at("arch.json")]));
}

#[test]
fn damaged_results_are_input_errors() {
    let desk = Desk::new();
    let good = desk.saved(YES, &["assess", &desk.at("arch.json")]);
    let mut bad = good.clone();
    bad["surplus"] = json!(1);
    expect(USAGE, voussoir(&["check", &desk.write("bad.json", &bad)]));
    let mut bad = good.clone();
    bad["certificate"]["forces"][0]["forces"][0] = json!([null, 0, 0]);
    let answer = expect(USAGE, voussoir(&["check", &desk.write("bad.json", &bad)]));
    assert!(err(&answer).contains("certificate.forces[0].forces[0][0]"), "{}", err(&answer));
    let mut bad = good.clone();
    bad["scene"]["input"]["blocks"] = json!([]);
    expect(USAGE, voussoir(&["check", &desk.write("bad.json", &bad)]));
    let text = good.to_string();
    for end in [1, text.len() / 3, text.len() - 2] {
        expect(USAGE, with_input(&["check", "-"], &text[..end]));
    }
    expect(USAGE, with_input(&["check", "-"], ""));
    expect(USAGE, with_input(&["assess", "-"], &text));
}

#[test]
fn a_scene_is_searched_for_slips() {
    let desk = Desk::new();
    let text = out(&expect(YES, voussoir(&["check", &desk.at("arch.json")])));
    assert!(text.contains("17 blocks (2 supports)"), "{text}");
    let mut scene = desk.read("arch.json");
    scene["blocks"].as_array_mut().unwrap().push(json!({ "id": "kite", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 99] }));
    let file = desk.write("loose.json", &scene);
    let text = out(&expect(NO, voussoir(&["check", &file])));
    assert!(text.contains("kite"), "{text}");
    // It falls freely, and the answer says which.
    let text = out(&expect(NO, voussoir(&["assess", &file])));
    assert!(text.contains("kite"), "{text}");
    let result = desk.saved(NO, &["assess", &file]);
    desk.checked(YES, &result);
}

/// What other programs build their equations from: with the forces of a result it must balance, in the stated frames and signs.
#[test]
fn the_resolved_scene_is_printed_for_other_programs() {
    let desk = Desk::new();
    let result = desk.saved(YES, &["limit", &desk.at("pushed.json"), "--law", "associative"]);
    let printed = out(&expect(YES, voussoir(&["check", &desk.at("pushed.json"), "--json"])));
    let model: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(model["format"], "voussoir-model/1");
    let lambda = result["answer"]["load_factor"]["value"].as_f64().unwrap();
    let vector = |v: &Value| nalgebra::Vector3::from_iterator(v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()));
    let blocks = model["blocks"].as_array().unwrap();
    let load = |b: &Value, part: &str| vector(&b["dead"][part]) + lambda * vector(&b["live"][part]);
    let mut sums: Vec<_> = blocks.iter().map(|b| (load(b, "force"), load(b, "moment"))).collect();
    let forces = result["certificate"]["forces"].as_array().unwrap();
    let faces = model["interfaces"].as_array().unwrap();
    assert_eq!(faces.len(), forces.len());
    for (face, carried) in faces.iter().zip(forces) {
        let (t1, t2, n) = (vector(&face["t1"]), vector(&face["t2"]), vector(&face["n"]));
        assert!((t1.cross(&t2) - n).norm() < 1e-12);
        let mu = face["friction"].as_f64().unwrap();
        for (point, force) in face["points"].as_array().unwrap().iter().zip(carried["forces"].as_array().unwrap()) {
            let (point, force) = (vector(point), vector(force));
            let slack = mu * force.dot(&n) - force.dot(&t1).hypot(force.dot(&t2));
            assert!(slack >= -1e-6 * force.norm(), "{slack}");
            for (side, sign) in [(0, -1.0), (1, 1.0)] {
                let block = face["between"][side].as_u64().unwrap() as usize;
                sums[block].0 += sign * force;
                sums[block].1 += sign * (point - vector(&blocks[block]["centroid"])).cross(&force);
            }
        }
    }
    for (block, (force, moment)) in blocks.iter().zip(&sums).filter(|(b, _)| b["support"] == false) {
        let weight = block["mass"].as_f64().unwrap() * 9.81;
        assert!(force.norm() < 1e-6 * weight && moment.norm() < 1e-6 * weight, "{block}: {force} {moment}");
    }
}

#[test]
fn a_verification_is_printed_for_other_programs() {
    let desk = Desk::new();
    let result = desk.saved(YES, &["assess", &desk.at("arch.json")]);
    let of = |wanted: i32, result: &Value| -> Value {
        serde_json::from_str(&out(&expect(wanted, voussoir(&["check", &desk.write("r.json", result), "--json"])))).unwrap()
    };
    let good = of(YES, &result);
    assert_eq!((&good["proved"], &good["refuted"]), (&json!(true), &json!(false)));
    let mut forged = result;
    forged["certificate"]["forces"][3]["forces"][0][2] = json!(1e6);
    let bad = of(NO, &forged);
    assert_eq!((&bad["proved"], &bad["refuted"]), (&json!(false), &json!(true)));
    assert!(bad["parts"].as_array().unwrap().iter().any(|p| !p["fails"].as_array().unwrap().is_empty()), "{bad}");
}

#[test]
fn templates_are_changed_by_key() {
    let list = out(&expect(YES, voussoir(&["generate", "--list"])));
    assert!(list.lines().count() >= 5);
    for line in list.lines() {
        let name = line.split(' ').next().unwrap();
        let scene = out(&expect(YES, voussoir(&["generate", name, "--name", "T"])));
        let answer = expect(YES, with_input(&["assess", "-", "-q"], &scene));
        assert_eq!(out(&answer), "T: stands\n", "{name}");
        let blocks = out(&expect(YES, voussoir(&["generate", name, "--expand", "--density", "1800"])));
        let blocks: Value = serde_json::from_str(&blocks).unwrap();
        assert!(blocks.get("templates").is_none() && blocks["materials"].as_object().unwrap().len() == 1, "{name}");
        assert!(blocks["blocks"].as_array().unwrap().iter().all(|b| b["material"].is_string()), "{name}");
    }
    let scene: Value = serde_json::from_str(&out(&expect(
        YES,
        voussoir(&[
            "generate",
            "arch",
            "radius=null",
            "span=8",
            "rise=3",
            "profile=elliptical",
            "buttresses={\"width\":2,\"height\":3}",
            "buttresses.height=4",
            "--friction",
            "infinite",
        ]),
    )))
    .unwrap();
    assert_eq!(scene["templates"][0]["arch"]["buttresses"], json!({ "width": 2.0, "height": 4.0 }));
    assert_eq!(scene["joints"]["default"]["friction"], "infinite");

    let deep = vec!["a"; 5000].join(".") + "=1";
    for (wrong, said) in [
        (&["arch", "voussiors=9"][..], "voussiors"),
        (&["arch", "voussoirs=many"], "voussoirs"),
        (&["arch", "voussoirs=-3"], "voussoirs"),
        (&["arch", "thickness=-1"], "thickness"),
        (&["arch", "thickness=1e400"], "thickness"),
        (&["arch", "voussoirs=100000000"], "voussoirs"),
        (&["arch", "radius"], "key=value"),
        (&["arch", "=1"], "key=value"),
        (&["column", "size.7=1"], "size.7"),
        (&["arch", "at.7=1"], "arch.at"),
        (&["arch", &deep], "not a key"),
        (&["cathedral"], "arch"),
        (&["arch", "--friction", "-1"], "friction"),
        (&["arch", "--density", "0"], "density"),
        (&["arch", "--density", "-1"], "density"),
    ] {
        let answer = expect(USAGE, voussoir(&[&["generate"], wrong].concat()));
        assert!(err(&answer).contains(said) && out(&answer).is_empty(), "{wrong:?}: {}", err(&answer));
    }
}

#[test]
fn meshes_become_scenes() {
    let desk = Desk::new();
    let mut text = String::new();
    for (name, z, first) in [("ground", -1.0, 1), ("stone", 0.0, 9)] {
        text.push_str(&format!("o {name}\n"));
        for k in 0..8 {
            text.push_str(&format!("v {} {} {}\n", k & 1, k >> 1 & 1, z + f64::from(k >> 2)));
        }
        for face in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
            text.push_str(&format!("f {}\n", face.map(|i: i32| (i + first).to_string()).join(" ")));
        }
    }
    let obj = desk.at("stone.obj");
    fs::write(&obj, text).unwrap();
    let scene = desk.at("stone.json");
    for support in [["--support", "ground"], ["--support-below", "-0.5"]] {
        expect(YES, voussoir(&[&["import", &obj, "--friction", "0.5", "-o", &scene], &support[..]].concat()));
        assert_eq!(desk.read("stone.json")["blocks"].as_array().unwrap().len(), 2);
        let result = desk.saved(YES, &["tilt", &scene, "--toward", "1,0"]);
        assert!((result["answer"]["load_factor"]["value"].as_f64().unwrap() - 0.5).abs() < 1e-7);
    }
    // What is missing is said, on standard error alone.
    let answer = expect(YES, voussoir(&["import", &obj]));
    assert!(err(&answer).contains("note: ") && serde_json::from_str::<Value>(&out(&answer)).is_ok());
    expect(USAGE, voussoir(&["import", &obj, "--support", "nobody"]));
    expect(USAGE, voussoir(&["import", &desk.at("none.obj")]));
    expect(USAGE, voussoir(&["import", &obj, "--up", "w"]));
    expect(USAGE, voussoir(&["import"]));
}

#[test]
fn errors_name_the_place_and_the_remedy() {
    let desk = Desk::new();
    let mut scene = desk.read("arch.json");
    scene["blocks"][3]["density"] = json!(-2400);
    fs::write(desk.path("bad.json"), serde_json::to_string_pretty(&scene).unwrap()).unwrap();
    let answer = expect(USAGE, voussoir(&["assess", &desk.at("bad.json")]));
    let lines: Vec<String> = err(&answer).lines().map(str::to_string).collect();
    let file = Path::new(&desk.at("bad.json")).display().to_string();
    let place = lines[0].strip_prefix(&format!("error: {file}:")).expect(&lines[0]);
    let mut parts = place.splitn(3, ':');
    assert!(parts.next().unwrap().parse::<usize>().unwrap() > 10 && parts.next().unwrap().parse::<usize>().is_ok(), "{place}");
    assert!(parts.next().unwrap().starts_with(" blocks[3].density: "), "{place}");
    assert!(lines[1].starts_with("hint: ") && lines.len() == 2, "{lines:?}");
}

#[test]
fn the_schema_is_json() {
    let schema: Value = serde_json::from_str(&out(&expect(YES, voussoir(&["schema"])))).unwrap();
    assert!(schema["properties"]["blocks"].is_object());
}

#[test]
fn the_commands_that_come_next_ask_the_same_question() {
    let text = out(&expect(YES, structure(&["tilt", "--toward", "1,0", "--law", "associative"], "block-on-tilting-table")));
    assert!(text.contains("block-on-tilting-table.json --toward 1,0 --law associative --save result.json"), "{text}");
    let text = out(&expect(YES, structure(&["tilt", "--toward", "1,0,0.5", "--skip-dead"], "block-on-tilting-table")));
    assert!(text.contains(" --toward 1,0,0.5 --skip-dead --save "), "{text}");
    let critical = ["critical", "--vary", "/gravity/0", "--between", "0", "9", "--step", "3", "--law", "associative"];
    let text = out(&expect(YES, structure(&critical, "block-on-tilting-table")));
    assert!(text.contains(".json --vary /gravity/0 --between 0 9 --step 3 --law associative --save result.json"), "{text}");
    let text = out(&expect(YES, structure(&["thrust", "--support", "ground", "--direction", "1,0"], "block-on-tilting-table")));
    assert!(text.contains(".json --support ground --direction 1,0,0 --save result.json"), "{text}");
    let text = out(&expect(YES, structure(&["tilt"], "block-on-tilting-table")));
    assert!(text.contains("block-on-tilting-table.json --save "), "{text}");
}

#[test]
fn a_thrust_is_drawn_and_a_critical_value_told_first() {
    let desk = Desk::new();
    let answer = expect(YES, voussoir(&["thrust", &desk.at("arch.json"), "--svg", &desk.at("arch.svg"), "--quiet"]));
    assert!(out(&answer).starts_with("Arch: thrust on springer_left from ") && out(&answer).lines().count() == 1, "{}", out(&answer));
    let drawing = fs::read_to_string(desk.path("arch.svg")).unwrap();
    assert!(drawing.starts_with("<svg ") && drawing.ends_with("</svg>\n"));
    let answer = voussoir(&["critical", &desk.at("arch.json"), "--vary", "/joints/default/friction", "--between", "0.1", "0.9"]);
    let text = out(&expect(YES, answer));
    assert!(text.starts_with("Arch: falls below friction = 0.3"), "{text}");
    assert!(text.contains("  proved      falls at 0.3") && text.contains("33 values of /joints/default/friction"), "{text}");
}

#[test]
fn paths_are_quoted_where_a_shell_would_split_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("it's $HOME.json");
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/structures/column.json"), &path).unwrap();
    let text = out(&expect(YES, voussoir(&["assess", path.to_str().unwrap()])));
    assert!(text.contains(r"/it'\''s $HOME.json' --save"), "{text}");
}

#[test]
fn no_limit_is_not_said_where_dry_friction_has_one() {
    let first = out(&structure(&["limit", "--quiet"], "block-under-roof"));
    assert!(first.contains("with dry friction λ = 0.40000") && !first.contains("without limit"), "{first}");
    let first = out(&structure(&["limit", "--quiet", "--law", "associative"], "block-under-roof"));
    assert!(first.contains("without limit"), "{first}");
}

#[test]
fn a_scene_without_a_name_is_called_by_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("nameless.json");
    let scene = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.7 } }, "templates": [ { "column": { "blocks": 2, "size": [1, 1, 0.5] } } ] }"#;
    fs::write(&path, scene).unwrap();
    let path = path.to_str().unwrap();
    assert_eq!(out(&voussoir(&["assess", "--quiet", path])), "nameless.json: stands\n");
    assert!(out(&voussoir(&["check", path])).starts_with("nameless.json: "));
    assert_eq!(out(&with_input(&["assess", "--quiet", "-"], scene)), "standard input: stands\n");
}

fn structure(args: &[&str], name: &str) -> Output {
    let path = format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"));
    voussoir(&[args, &[path.as_str()]].concat())
}

/// A column of two blocks that stands, or falls under its live load.
const PUSHED: &str = r#"{ "format": "voussoir-scene/1", "name": "Pushed", "gravity": [0, 0, -10], "joints": { "default": { "friction": 0.9 } }, "blocks": [
    { "id": "ground", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
    { "id": "lower", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 0.5] },
    { "id": "upper", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 1.5] } ],
    "loads": { "live": [ { "weight": [1, 0, 0] } ] } }"#;

#[test]
fn simulate_answers_by_its_exit_code_and_says_whether_the_verdict_agrees() {
    let stands = expect(YES, with_input(&["simulate", "-"], PUSHED));
    assert!(
        out(&stands).starts_with("Pushed: stands\n") && out(&stands).contains("The verdict says the same: it stands."),
        "{}",
        out(&stands)
    );
    let falls = expect(NO, with_input(&["simulate", "-", "--load-factor", "0.55"], PUSHED));
    assert!(
        out(&falls).contains("The verdict says the same: it falls. Its first motion and the mechanism correlate by"),
        "{}",
        out(&falls)
    );
    let open =
        expect(UNDECIDED, with_input(&["simulate", "-", "--load-factor", "0.55", "--fast", "--seconds", "0.05", "--skip-verdict"], PUSHED));
    assert!(out(&open).starts_with("Pushed: undecided\n") && !out(&open).contains("verdict says"), "{}", out(&open));
    let brief = expect(YES, with_input(&["simulate", "-", "--quiet"], PUSHED));
    assert_eq!((out(&brief).as_str(), err(&brief).as_str()), ("Pushed: stands\n", ""));
}

#[test]
fn simulate_writes_trajectories_and_results_that_check_knows() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (csv, result) = (path("motion.csv"), path("result.json"));
    expect(NO, with_input(&["simulate", "-", "--load-factor", "0.6", "--csv", &csv, "--frames", "50", "--save", &result], PUSHED));
    let text = fs::read_to_string(&csv).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert!(rows[0].starts_with("run,time,block,x,y,z,qw,") && rows.len() > 7, "{text}");
    assert!(rows[1].starts_with("fast,0,ground,0,0,-0.5,1,0,0,0,0,0,0,") && rows.iter().any(|r| r.starts_with("fine,")), "{text}");
    let file: Value = serde_json::from_str(&fs::read_to_string(&result).unwrap()).unwrap();
    assert_eq!(
        (&file["question"], &file["answer"]["fate"], &file["answer"]["verdict"]),
        (&json!("simulate"), &json!("falls"), &json!("unstable"))
    );
    assert_eq!(file["simulation"]["frames"][0]["blocks"].as_array().map(Vec::len), Some(3));
    let checked = expect(YES, voussoir(&["check", &result]));
    assert!(out(&checked).contains("observed, not proved"), "{}", out(&checked));
    let mut forged = file.clone();
    forged["answer"]["fate"] = json!("stands");
    let forged_path = path("forged.json");
    fs::write(&forged_path, forged.to_string()).unwrap();
    expect(NO, voussoir(&["check", &forged_path]));
    // Frames are not in a result that nobody asked to hold them.
    let plain = expect(YES, with_input(&["simulate", "-", "--json", "--threads", "2"], PUSHED));
    let plain: Value = serde_json::from_str(&out(&plain)).unwrap();
    assert!(plain["simulation"].get("frames").is_none() && plain["simulation"]["agreement"]["agrees"] == json!(true));
}

#[test]
fn assess_simulates_when_asked_or_in_doubt() {
    let simulated = |args: &[&str], scene: &str| {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/");
        let output = voussoir(&[&["assess", &format!("{file}{scene}.json"), "--json"], args].concat());
        let value: Value = serde_json::from_str(&out(&output)).unwrap();
        value.get("simulation").map(|s| s["fate"].clone())
    };
    assert_eq!(simulated(&[], "squeezed-block"), None);
    assert_eq!(simulated(&["--thorough"], "squeezed-block"), Some(json!("falls")));
    assert_eq!(simulated(&["--thorough"], "two-block-column"), None);
    assert_eq!(simulated(&["--simulate"], "two-block-column"), Some(json!("stands")));
}

#[test]
fn simulate_refuses_what_it_cannot_do() {
    for args in [&["--seconds", "0"][..], &["--frames", "0"], &["--fast", "--fine"], &["--load-factor", "nan"]] {
        expect(USAGE, with_input(&[&["simulate", "-"], args].concat(), PUSHED));
    }
    let lost = expect(USAGE, with_input(&["simulate", "-", "--csv", "/nowhere/motion.csv"], PUSHED));
    assert!(err(&lost).contains("/nowhere/motion.csv: cannot be written"), "{}", err(&lost));
}

#[test]
fn repose_answers_both_questions() {
    let desk = Desk::new();
    expect(YES, voussoir(&["generate", "lattice", "layers=2", "--friction", "0.5", "-o", &desk.at("pile.json")]));
    let (pile, saved, table) = (desk.at("pile.json"), desk.at("saved.json"), desk.at("contacts.csv"));
    let options = ["--toward", "0,-1", "--fabric", "--csv", &table, "--save", &saved, "--json"];
    let answer: Value = serde_json::from_str(&out(&expect(YES, voussoir(&[&["repose", &pile][..], &options].concat())))).unwrap();
    assert!((answer["directions"][0]["tilt_deg"].as_f64().unwrap() - 19.471220634).abs() < 1e-6, "{answer}");
    assert_eq!(answer["fabric"]["grains"], 4);
    expect(YES, voussoir(&["check", &saved]));
    let rows = fs::read_to_string(&table).unwrap().lines().count();
    assert_eq!(rows, 1 + answer["fabric"]["contacts"].as_u64().unwrap() as usize, "a row for each contact that carries");

    let protocol = ["repose", "drain", "grains=30", "size=[6,4]", "--question", "repose", "--seeds", "2", "--json"];
    let heaps = desk.at("heap.json");
    let one = out(&voussoir(&[&protocol[..], &["--heaps", &heaps, "--skip-margin"]].concat()));
    let file: Value = serde_json::from_str(&one).unwrap();
    assert_eq!(file["heaps"].as_array().unwrap().len(), 2, "{one}");
    assert!(file["heaps"][0]["rested"].as_bool().unwrap());
    assert!([YES, UNDECIDED].contains(&code(&voussoir(&[
        "repose",
        &desk.at("heap.1.json"),
        "--toward",
        "1,0",
        "--law",
        "associative",
        "-q"
    ]))));
    expect(USAGE, voussoir(&["repose", "heap", "--question", "repose"]));
    expect(USAGE, voussoir(&["repose", "drain", "grain=30", "--question", "repose"]));
    expect(USAGE, voussoir(&["repose", "drain", "grains=-1", "--question", "repose"]));
    expect(USAGE, voussoir(&["repose", &pile, "grains=30"]));
}

/// Files of an answer beside its text: each is there, whole, and the text stays what it is.
#[test]
fn pictures_and_tables_are_written_beside_the_answer() {
    let desk = Desk::new();
    let [svg, vtp, csv] = ["a.svg", "a.vtp", "a.csv"].map(|n| desk.at(n));
    let files = ["--svg", &svg, "--vtk", &vtp, "--csv", &csv];
    for (wanted, question) in [
        (NO, vec!["assess", "thin.json"]),
        (YES, vec!["limit", "pushed.json", "--law", "associative"]),
        (YES, vec!["tilt", "arch.json", "--toward", "1,0", "--law", "associative"]),
        (YES, vec!["thrust", "arch.json", "--law", "associative"]),
    ] {
        let scene = desk.at(question[1]);
        let asked = [&[question[0], &scene], &question[2..]].concat();
        let plain = out(&expect(wanted, voussoir(&[&asked[..], &["-q"]].concat())));
        let with = out(&expect(wanted, voussoir(&[&asked[..], &files, &["-q"]].concat())));
        assert_eq!(plain, with);
        let read = |name: &str| fs::read_to_string(desk.path(name)).unwrap();
        assert!(read("a.svg").starts_with("<svg ") && read("a.svg").ends_with("</svg>\n"));
        assert!(read("a.vtp").contains("type=\"PolyData\"") && read("a.vtp").ends_with("</VTKFile>\n"));
        assert_eq!([read("a.csv").lines().count() > 14, read("a.blocks.csv").lines().count() == 18], [true; 2]);
        ["a.svg", "a.vtp", "a.csv", "a.blocks.csv"].iter().for_each(|n| fs::remove_file(desk.path(n)).unwrap());
    }
    let packing = desk.at("pile.json");
    expect(YES, voussoir(&["generate", "lattice", "layers=2", "--friction", "0.5", "-o", &packing]));
    expect(YES, voussoir(&["repose", &packing, "--toward", "0,-1", "--law", "associative", "--svg", &svg, "--vtk", &vtp, "-q"]));
    assert!(desk.files().contains(&"a.svg".into()) && desk.files().contains(&"a.vtp".into()));
    // A picture on standard output stands alone.
    let drawn = out(&expect(YES, voussoir(&["assess", &desk.at("arch.json"), "--law", "associative", "--svg", "-", "--view", "corner"])));
    assert!(drawn.starts_with("<svg ") && drawn.ends_with("</svg>\n") && drawn.matches("<svg ").count() == 2);
}

#[test]
fn saved_results_and_scenes_are_drawn_by_check() {
    let desk = Desk::new();
    let svg = desk.at("a.svg");
    let mut result = desk.saved(NO, &["assess", &desk.at("thin.json"), "--law", "associative", "--svg", &svg]);
    let asked = fs::read_to_string(&svg).unwrap();
    expect(YES, voussoir(&["check", &desk.at("saved.json"), "--svg", &svg]));
    assert_eq!(fs::read_to_string(&svg).unwrap(), asked);
    assert!(asked.contains("class=\"moved\"") && asked.contains(">hinge<"));
    fs::remove_file(&svg).unwrap();
    // What is refuted is not drawn.
    scale(&mut result["certificate"]["rates"][0]["velocity"], -1.0);
    let file = desk.write("forged.json", &result);
    expect(NO, voussoir(&["check", &file, "--svg", &svg]));
    assert!(!desk.path("a.svg").exists());
    expect(YES, voussoir(&["check", &desk.at("arch.json"), "--svg", &svg]));
    let bare = fs::read_to_string(&svg).unwrap();
    assert!(bare.contains("class=\"block\"") && !bare.contains("<path class=\"line"));
}

#[test]
fn a_simulation_is_a_collection_of_moments() {
    let desk = Desk::new();
    let (pvd, svg) = (desk.at("fall.pvd"), desk.at("fall.svg"));
    expect(NO, voussoir(&["simulate", &desk.at("thin.json"), "--fast", "--skip-verdict", "--vtk", &pvd, "--svg", &svg, "-q"]));
    let text = fs::read_to_string(&pvd).unwrap();
    let named: Vec<&str> = text.split("file=\"").skip(1).filter_map(|t| t.split('"').next()).collect();
    assert!(named.len() > 2 && named.iter().all(|n| desk.path(n).is_file()), "{text}");
    assert!(fs::read_to_string(&svg).unwrap().contains("after "));
}

#[test]
fn pictures_that_cannot_be_made_are_refused_before_the_work() {
    let desk = Desk::new();
    let arch = desk.at("arch.json");
    for (wrong, word) in [
        (&["--vtk", "a.vtk"][..], "name it a.vtp"),
        (&["--vtk", "-", "--svg", "-"], "standard output takes one of"),
        (&["--svg", "-", "--json"], "standard output takes one of"),
        (&["--csv", "-"], "--csv takes a file"),
        (&["--svg", &arch], "would replace the scene"),
        (&["--svg", "no/such/folder.svg"], "no such folder"),
        (&["--view", "corner"], "--svg"),
        (&["--svg", "a.svg", "--view", "inside"], "not auto, front"),
    ] {
        let answer = expect(USAGE, voussoir(&[&["assess", &arch], wrong].concat()));
        assert!(err(&answer).contains(word), "{wrong:?}: {}", err(&answer));
    }
    let answer = expect(USAGE, voussoir(&["simulate", &arch, "--vtk", "a.vtp"]));
    assert!(err(&answer).contains("name it a.pvd"), "{}", err(&answer));
    let answer = expect(USAGE, voussoir(&["repose", "drain", "--question", "repose", "--csv", "a.csv"]));
    assert!(err(&answer).contains("--heaps"), "{}", err(&answer));
}

/// Verbs of the help's list.
fn verbs() -> Vec<String> {
    let help = out(&expect(YES, voussoir(&["--help"])));
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap().to_string();
    let words = list.lines().filter(|l| l.starts_with("  ") && !l.starts_with("   ")).filter_map(|l| l.split_whitespace().next());
    words.map(String::from).filter(|w| w != "help").collect()
}

#[test]
fn shells_and_manuals_know_every_verb() {
    assert!(verbs().len() >= 14, "{:?}", verbs());
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = out(&expect(YES, voussoir(&["completions", shell])));
        assert!(verbs().iter().all(|v| script.contains(v)) && script.contains("moving-mass"), "{shell}");
    }
    assert!(err(&expect(USAGE, voussoir(&["completions", "sh"]))).contains("bash"));
    let desk = Desk::new();
    expect(YES, voussoir(&["man", "--folder", &desk.at("")]));
    let whole = out(&expect(YES, voussoir(&["man"])));
    for verb in verbs() {
        let page = out(&expect(YES, voussoir(&["man", &verb])));
        assert!(page.contains(&format!(".TH voussoir-{verb} 1")) && page.contains(".SH SYNOPSIS"), "{verb}");
        assert_eq!(fs::read_to_string(desk.path(&format!("voussoir-{verb}.1"))).unwrap(), page);
        assert!(whole.contains(&format!("voussoir\\-{verb}(1)")), "{verb}");
    }
    assert_eq!(fs::read_to_string(desk.path("voussoir.1")).unwrap(), whole);
    assert!(whole.contains("Exit codes") && whole.contains("130"));
    expect(USAGE, voussoir(&["man", "nonsense"]));
    expect(USAGE, voussoir(&["man", "--folder", &desk.at("no/folder")]));
}
