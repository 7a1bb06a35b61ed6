//! What is answered, on which channel, with which exit code.

use super::*;

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
    let critical =
        |more: &[&str]| voussoir(&[&["critical", &arch, "--law", "associative"], more].concat());
    expect(
        YES,
        critical(&[
            "--vary",
            "/joints/default/friction",
            "--between",
            "0.9",
            "0.1",
            "--step",
            "0.3",
        ]),
    );
    expect(NO, critical(&["--vary", "/joints/default/friction", "--between", "0.8", "0.9"]));
    expect(YES, voussoir(&["thrust", &arch, "--support", "springer_right", "--direction", "-1,0"]));
    expect(NO, voussoir(&["thrust", &thin]));
    let settle = |moves: &str| voussoir(&["settle", &arch, "--move", moves]);
    expect(YES, settle("springer_right=0.001,0,0"));
    expect(NO, settle("springer_right=1,0,0"));
    for wrong in
        ["springer_right=1,0", "springer_right=0,0,0", "v03=1,0,0", "nobody=1,0,0", "1,0,0"]
    {
        expect(USAGE, settle(wrong));
    }
    let push = |control: &str, toward: &str| {
        voussoir(&["push", &arch, "--control", control, "--toward", toward])
    };
    // There is no live load, no such point, no direction.
    expect(USAGE, push("v03=0,0,1", "1,0"));
    expect(USAGE, push("v03=0,0", "1,0"));
    expect(USAGE, push("v03=0,0,1", "1"));
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
    for fine in
        [&["--help"][..], &["help", "limit"], &["--version"], &["schema"], &["generate", "--list"]]
    {
        let answer = expect(YES, voussoir(fine));
        assert!(!out(&answer).is_empty() && err(&answer).is_empty());
    }
}

#[test]
fn a_requirement_inside_the_bracket_is_not_rounded_up() {
    let desk = Desk::new();
    let value =
        desk.saved(YES, &["limit", &desk.at("pushed.json")])["answer"]["load_factor"]["upper"]
            .as_f64()
            .unwrap();
    expect(
        UNDECIDED,
        voussoir(&["limit", &desk.at("pushed.json"), "--require", &format!("{value:.17}")]),
    );
}

/// A load factor is no yes where the scene falls without its load, and one line says so.
#[test]
fn a_scene_that_falls_without_its_load_is_no_yes() {
    let root = env!("CARGO_MANIFEST_DIR");
    let held = "tests/suite/findings/wall-and-pressed.json";
    for (scene, said) in [
        ("structures/pushed-uphill.json", "load factor -0.148"),
        (held, "no load factor with dry friction"),
    ] {
        let answer = expect(NO, voussoir(&["limit", &format!("{root}/{scene}"), "-q"]));
        let line = out(&answer);
        assert!(line.contains(said) && line.contains("; without its live load it falls"), "{line}");
        assert_eq!(line.lines().count(), 1, "{line}");
        // A requirement is no way around that.
        expect(NO, voussoir(&["limit", &format!("{root}/{scene}"), "--require", "-1"]));
    }
}

/// A block in a groove and a block under a roof: the bound meets what dry friction does not.
#[test]
fn a_bound_alone_meets_no_requirement() {
    let scene = |name: &str| format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"));
    for (name, bound_only, both, neither) in
        [("block-in-groove", "0.75", "0.7", "0.9"), ("block-under-roof", "1", "0.399", "-")]
    {
        expect(NO, voussoir(&["limit", &scene(name), "--require", bound_only]));
        expect(
            YES,
            voussoir(&["limit", &scene(name), "--require", bound_only, "--law", "associative"]),
        );
        expect(YES, voussoir(&["limit", &scene(name), "--require", both]));
        if neither != "-" {
            expect(
                NO,
                voussoir(&["limit", &scene(name), "--require", neither, "--law", "associative"]),
            );
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
        expect(
            YES,
            voussoir(&["generate", "column", "blocks=1", &size, "--friction", mu, "-o", &scene]),
        );
        let result = desk.saved(YES, &["tilt", &scene]);
        assert_eq!(result["answer"]["directions"].as_array().unwrap().len(), 8);
        let angle = result["answer"]["tilt_deg"]["value"].as_f64().unwrap();
        assert!((angle - f64::atan(tangent).to_degrees()).abs() < 1e-6, "{angle}");
        assert_eq!(result["answer"]["dead_load"]["answer"]["verdict"], "stable");
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
        (
            YES,
            vec![
                "critical",
                "arch.json",
                "--vary",
                "/joints/default/friction",
                "--between",
                "0.1",
                "0.9",
                "--scan",
                "5",
            ],
        ),
        (
            NO,
            vec![
                "critical",
                "arch.json",
                "--vary",
                "/joints/default/friction",
                "--between",
                "0.7",
                "0.9",
                "--scan",
                "2",
            ],
        ),
        (
            UNDECIDED,
            vec![
                "critical",
                "arch.json",
                "--vary",
                "/gravity/0",
                "--between",
                "0",
                "1",
                "--time-limit",
                "1e-9",
            ],
        ),
        (YES, vec!["thrust", "arch.json"]),
        (NO, vec!["thrust", "thin.json"]),
        (UNDECIDED, vec!["thrust", "arch.json", "--time-limit", "1e-9"]),
    ] {
        let answer =
            ended(command().current_dir(desk.0.path()).args(&args).arg("--json").output().unwrap());
        let answer = expect(wanted, answer);
        let value: Value = serde_json::from_str(&out(&answer)).unwrap();
        assert_eq!(value["format"], "voussoir-result/3");
        assert!(value["question"].get(args[0]).is_some());
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
    assert!(
        err(&answer).contains("standard input:") && err(&answer).contains("hint: "),
        "{}",
        err(&answer)
    );
}

#[test]
fn text_says_the_answer_first_and_what_next() {
    let desk = Desk::new();
    let text = out(&expect(YES, voussoir(&["assess", &desk.at("arch.json")])));
    assert!(text.starts_with("Arch: stands\n\n"), "{text}");
    assert!(
        text.contains("17 blocks (2 supports), 16 interfaces, 64 contact points")
            && text.contains("voussoir tilt "),
        "{text}"
    );
    assert!(text.lines().count() < 24 && !text.contains('\x1b'), "{text}");
    let text = out(&expect(YES, voussoir(&["assess", &desk.at("arch.json"), "--verbose"])));
    assert!(text.contains("iterations"), "{text}");
    let text = out(&expect(NO, voussoir(&["assess", &desk.at("thin.json"), "--color", "always"])));
    assert!(text.contains("\x1b[1;31mfalls") && text.contains("hinges"), "{text}");
    let text = out(&expect(YES, voussoir(&["limit", &desk.at("pushed.json"), "--quiet"])));
    assert!(text.starts_with("Arch: carries 0.1") && text.lines().count() == 1, "{text}");
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
        let asked =
            [&[question[0], path.to_str().unwrap()], &question[2..], &["--law", "associative"]]
                .concat();
        let short = out(&expect(wanted, voussoir(&asked)));
        let long = out(&expect(wanted, voussoir(&[&asked[..], &["--verbose"]].concat())));
        assert!(short.lines().count() <= 40, "{} lines:\n{short}", short.lines().count());
        assert!(
            long.lines().count() > short.lines().count() && !long.contains("--verbose for all"),
            "{long}"
        );
        assert_eq!(short.lines().next(), long.lines().next());
    }
}

#[test]
fn four_digits_are_shown_on_the_safe_side_and_all_that_are_known_with_verbose() {
    let desk = Desk::new();
    let limit = |options: &[&str]| {
        let answer = voussoir(&[&["limit", &desk.at("pushed.json")], options].concat());
        out(&expect(YES, answer))
    };
    let answer = &desk.saved(YES, &["limit", &desk.at("pushed.json")])["answer"]["load_factor"];
    let [low, high] = ["lower", "upper"].map(|end| answer[end].as_f64().unwrap());
    let quiet = limit(&["-q"]);
    let shown = quiet.split(' ').find_map(|word| word.parse::<f64>().ok()).unwrap();
    assert!(shown <= low && shown > 0.999 * low, "{quiet}");
    assert!(shown.to_string().len() <= 6, "{quiet}");
    let whole = limit(&["--verbose"]);
    let line = whole.lines().find(|l| l.trim_start().starts_with("bound ")).unwrap();
    let value = line.split("λ = ").nth(1).unwrap().split(',').next().unwrap();
    let decimals = value.split_once('.').unwrap().1.len() as i32;
    assert!(10f64.powi(-decimals) >= high - low && decimals >= 5, "{line} ± {}", high - low);
}

/// The first line says what was required and whether it is there, as the exit code does.
#[test]
fn what_is_required_stands_on_the_first_line() {
    let desk = Desk::new();
    for (least, code, words) in
        [("0.01", YES, "required 0.01: met"), ("9", NO, "required 9: not met")]
    {
        let answer = voussoir(&["limit", &desk.at("pushed.json"), "-q", "--require", least]);
        let line = out(&expect(code, answer));
        assert!(line.contains(words) && line.lines().count() == 1, "{line}");
    }
    // The joints that are used most stand in the answer.
    let text = out(&expect(YES, voussoir(&["limit", &desk.at("pushed.json")])));
    assert!(text.contains("  weak joints ") && text.contains("e/t 0."), "{text}");
}
