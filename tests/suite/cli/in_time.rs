//! Simulations, and heaps of grains.

use super::*;

/// A column of two blocks that stands, or falls under its live load.
const PUSHED: &str = r#"{ "format": "voussoir-scene/1", "name": "Pushed", "gravity": [0, 0, -10], "joints": { "default": { "friction": 0.9 } }, "blocks": [
    { "id": "ground", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
    { "id": "lower", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 0.5] },
    { "id": "upper", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 1.5] } ],
    "loads": { "live": [ { "weight": [1, 0, 0] } ] } }"#;

/// A dome of courses without bond, a window of `wide` segments under every sixth lintel: the lintels
/// hang between their neighbours, held by friction or not at all.
fn dome_with_windows(friction: f64, wide: usize) -> String {
    let template = json!({ "dome": { "radius": 5.0, "thickness": 0.5, "rings": 8, "segments": 24, "oculus_deg": 10.0 } });
    let template = serde_json::from_value(template).expect("a template");
    let mut blocks = voussoir::generate::expand(&template).expect("blocks");
    let gone = |id: &str| {
        ["r01_", "r02_"].iter().any(|ring| {
            id.strip_prefix(ring)
                .and_then(|s| s.parse::<usize>().ok())
                .is_some_and(|segment| segment % 6 < wide)
        })
    };
    blocks.retain(|b| !gone(&b.id));
    json!({ "format": "voussoir-scene/1", "name": "Dome", "joints": { "default": { "friction": friction } },
        "blocks": blocks, "loads": { "live": [ { "weight": [1, 0, 0] } ] } })
    .to_string()
}

/// Forces that hold the lintels exist, and so does their fall: what is proved to need self-stress
/// stands for nobody who reads one line, or one exit code.
#[test]
fn all_verbs_agree_about_a_dome_with_windows_or_say_why_they_do_not() {
    for (friction, wide) in [(0.7, 1), (0.7, 2)] {
        let dome = dome_with_windows(friction, wide);
        let line = |verb: &str| {
            let answer = expect(NO, with_input(&[verb, "-"], &dome));
            let words: Vec<String> = out(&answer)
                .lines()
                .map(|l| l.split_whitespace().collect::<Vec<_>>().join(" "))
                .collect();
            (words[0].clone(), words.join(" "))
        };
        assert!(line("assess").0.starts_with("Dome: stands only with self-stress"));
        assert!(
            line("limit").0.starts_with("Dome: no load factor with dry friction: the blocks move")
        );
        let (first, whole) = line("simulate");
        let explained = first
            == "Dome: stands in the simulation, but by proof only with self-stress"
            && whole.contains("Both are solutions with dry friction");
        assert!(explained || first.starts_with("Dome: falls"), "{whole}");
    }
}

#[test]
fn simulate_answers_by_its_exit_code_and_says_whether_the_verdict_agrees() {
    let stands = expect(YES, with_input(&["simulate", "-"], PUSHED));
    assert!(
        out(&stands).starts_with("Pushed: stands\n")
            && out(&stands).contains("The verdict agrees: it stands."),
        "{}",
        out(&stands)
    );
    let falls = expect(NO, with_input(&["simulate", "-", "--load-factor", "0.55"], PUSHED));
    assert!(
        out(&falls).contains(
            "The verdict agrees: it falls. The correlation of the first motion with the mechanism is"
        ),
        "{}",
        out(&falls)
    );
    let open = expect(
        UNDECIDED,
        with_input(
            &[
                "simulate",
                "-",
                "--load-factor",
                "0.55",
                "--fast",
                "--seconds",
                "0.05",
                "--skip-verdict",
            ],
            PUSHED,
        ),
    );
    assert!(
        out(&open).starts_with("Pushed: undecided: it neither rests nor has it fallen: ")
            && !out(&open).contains("The verdict"),
        "{}",
        out(&open)
    );
    let brief = expect(YES, with_input(&["simulate", "-", "--quiet"], PUSHED));
    assert_eq!((out(&brief).as_str(), err(&brief).as_str()), ("Pushed: stands\n", ""));
}

#[test]
fn simulate_writes_trajectories_and_results_that_check_knows() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (csv, result) = (path("motion.csv"), path("result.json"));
    expect(
        NO,
        with_input(
            &[
                "simulate",
                "-",
                "--load-factor",
                "0.6",
                "--csv",
                &csv,
                "--frames",
                "50",
                "--save",
                &result,
            ],
            PUSHED,
        ),
    );
    let text = fs::read_to_string(&csv).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert!(rows[0].starts_with("run,time,block,x,y,z,qw,") && rows.len() > 7, "{text}");
    assert!(
        rows[1].starts_with("\"fast\",0,\"ground\",0,0,-0.5,1,0,0,0,0,0,0,")
            && rows.iter().any(|r| r.starts_with("\"fine\",")),
        "{text}"
    );
    let file: Value = serde_json::from_str(&fs::read_to_string(&result).unwrap()).unwrap();
    assert_eq!(
        (&file["answer"]["fate"], &file["answer"]["verdict"]),
        (&json!("falls"), &json!("unstable"))
    );
    assert_eq!(file["run"]["frames"][0]["blocks"].as_array().map(Vec::len), Some(3));
    let checked = expect(YES, voussoir(&["check", &result]));
    assert!(
        out(&checked)
            .contains("the simulation gives the same result when run again (computed, not proved)"),
        "{}",
        out(&checked)
    );
    let mut forged = file.clone();
    forged["answer"]["fate"] = json!("stands");
    let forged_path = path("forged.json");
    fs::write(&forged_path, forged.to_string()).unwrap();
    expect(NO, voussoir(&["check", &forged_path]));
    // Frames are not in a result that nobody asked to hold them.
    let plain = expect(YES, with_input(&["simulate", "-", "--json", "--threads", "2"], PUSHED));
    let plain: Value = serde_json::from_str(&out(&plain)).unwrap();
    assert!(
        plain["run"].get("frames").is_none()
            && plain["answer"]["simulation"]["agreement"]["agrees"] == json!(true)
    );
}

#[test]
fn assess_simulates_when_asked_or_in_doubt() {
    let simulated = |args: &[&str], scene: &str| {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/");
        let output =
            voussoir(&[&["assess", &format!("{file}{scene}.json"), "--json"], args].concat());
        let value: Value = serde_json::from_str(&out(&output)).unwrap();
        value["answer"].get("simulation").map(|s| s["fate"].clone())
    };
    assert_eq!(simulated(&[], "squeezed-block"), None);
    assert_eq!(simulated(&["--thorough"], "squeezed-block"), Some(json!("falls")));
    assert_eq!(simulated(&["--thorough"], "two-block-column"), None);
    assert_eq!(simulated(&["--simulate"], "two-block-column"), Some(json!("stands")));
}

#[test]
fn simulate_refuses_what_it_cannot_do() {
    for args in [
        &["--seconds", "0"][..],
        &["--frames", "0"],
        &["--fast", "--fine"],
        &["--load-factor", "nan"],
    ] {
        expect(USAGE, with_input(&[&["simulate", "-"], args].concat(), PUSHED));
    }
    let lost =
        expect(USAGE, with_input(&["simulate", "-", "--csv", "/nowhere/motion.csv"], PUSHED));
    assert!(err(&lost).contains("/nowhere/motion.csv: cannot be written"), "{}", err(&lost));
}

#[test]
fn repose_answers_both_questions() {
    let desk = Desk::new();
    expect(
        YES,
        voussoir(&[
            "generate",
            "lattice",
            "layers=2",
            "--friction",
            "0.5",
            "-o",
            &desk.at("pile.json"),
        ]),
    );
    let (pile, saved, table) =
        (desk.at("pile.json"), desk.at("saved.json"), desk.at("contacts.csv"));
    let options = ["--toward", "0,-1", "--fabric", "--csv", &table, "--save", &saved, "--json"];
    let answer: Value = serde_json::from_str(&out(&expect(
        YES,
        voussoir(&[&["repose", &pile][..], &options].concat()),
    )))
    .unwrap();
    assert!(
        (answer["directions"][0]["tilt_deg"].as_f64().unwrap() - 19.471220634).abs() < 1e-6,
        "{answer}"
    );
    assert_eq!(answer["fabric"]["grains"], 4);
    expect(YES, voussoir(&["check", &saved]));
    let rows = fs::read_to_string(&table).unwrap().lines().count();
    assert_eq!(
        rows,
        1 + answer["fabric"]["contacts"].as_u64().unwrap() as usize,
        "a row for each contact that carries"
    );

    let protocol = [
        "repose",
        "drain",
        "grains=30",
        "size=[6,4]",
        "--question",
        "repose",
        "--seeds",
        "2",
        "--json",
    ];
    let heaps = desk.at("heap.json");
    let one = out(&voussoir(&[&protocol[..], &["--heaps", &heaps, "--skip-margin"]].concat()));
    let file: Value = serde_json::from_str(&one).unwrap();
    assert_eq!(file["heaps"].as_array().unwrap().len(), 2, "{one}");
    assert!(file["heaps"][0]["rested"].as_bool().unwrap());
    // So few grains have no angle of repose: no number, the reason, and the exit code of an open
    // question.
    expect(UNDECIDED, voussoir(&[&protocol[..], &["--skip-margin"]].concat()));
    assert!(file["angle_deg"].is_null() && file["spread_deg"].is_null(), "{one}");
    assert!(file.as_object().unwrap().contains_key("angle_deg"), "null, not absent: {one}");
    assert!(file["no_angle"].as_str().unwrap().contains("cells of the surface"), "{one}");
    for heap in file["heaps"].as_array().unwrap() {
        assert!(heap["angle_deg"].is_null() && heap["parts_deg"] == json!([]), "{one}");
        assert!(!heap["no_angle"].as_array().unwrap().is_empty(), "{one}");
    }
    assert_eq!(file["protocol"]["size"], json!([6.0, 4.0]));
    let said = out(&voussoir(&[&protocol[..8], &["--skip-margin", "-q"]].concat()));
    assert!(said.contains("no angle of repose: seed 1: "), "{said}");
    let page = desk.at("heap.html");
    let more = ["--skip-margin", "--report", page.as_str()];
    expect(UNDECIDED, voussoir(&[&protocol[..8], &more].concat()));
    let page = fs::read_to_string(&page).unwrap();
    assert!(page.contains("no angle of repose") && !page.contains("class=\"fitted\" d="));
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
    let rough = voussoir(&["repose", "drain", "friction=inf", "--question", "repose"]);
    assert!(err(&expect(USAGE, rough)).contains("friction: inf is not a finite number"));
    expect(USAGE, voussoir(&["repose", &pile, "grains=30"]));
}
