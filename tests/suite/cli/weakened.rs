//! What weakens an answer reaches whoever reads one line, one number or one exit code.

use super::*;

/// Rings that are cut into different numbers of voussoirs: chords of one lie inside those of the
/// other, so that most joints between them overlap and are no contacts.
fn rings() -> Value {
    let ring = |k: usize, voussoirs: usize| json!({ "arch": { "prefix": format!("r{k}_"), "radius": 2.5 + 0.1 * k as f64, "embrace_deg": 120, "thickness": 0.1, "depth": 1, "voussoirs": voussoirs, "material": "b" } });
    json!({
        "format": "voussoir-scene/1", "name": "rings", "materials": { "b": { "density": 2000 } },
        "joints": { "default": { "friction": 0.5 } }, "templates": [ring(0, 20), ring(1, 21)],
        "loads": { "live": [{ "weight": [1, 0, 0] }] }, "contact": { "gap": 1e-4 }
    })
}

/// A stone that was drawn into the ground, by this much.
fn sunk(depth: f64) -> Value {
    json!({
        "format": "voussoir-scene/1", "name": "Sunk", "joints": { "default": { "friction": 0.6 } },
        "blocks": [
            { "id": "ground", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "stone", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 0.5 - depth] }
        ]
    })
}

#[test]
fn rings_that_overlap_say_so_on_the_line_that_has_the_number() {
    let desk = Desk::new();
    let scene = desk.write("rings.json", &rings());
    for law in ["associative", "coulomb"] {
        let limit = voussoir(&["limit", &scene, "-q", "--skip-dead", "--law", law]);
        let line = out(&limit);
        assert_eq!(line.lines().count(), 1, "{line}");
        for word in [
            "carries 0.",
            "without contacts between ",
            " overlap by up to ",
            "with them closed the load factor is ",
        ] {
            assert!(line.contains(word), "{word}: {line}");
        }
        // On standard error too, for who reads the number from JSON or a picture.
        assert!(err(&limit).contains("warning: without contacts between"), "{}", err(&limit));
    }
    let saved = desk.saved(YES, &["limit", &scene, "--law", "associative", "--skip-dead"]);
    let said = &saved["answer"]["left_out_contacts"];
    assert!(said["contacts"]["overlaps"].as_u64().unwrap() > 20, "{said}");
    assert_eq!(said["closed"]["difference"], "stronger");
    let closed = said["closed"]["answer"]["load_factor"]["value"].as_f64().unwrap();
    let given = saved["answer"]["load_factor"]["value"].as_f64().unwrap();
    assert!(closed > 1.05 * given, "{closed}, {given}");
    // The number beside it is what the advised tolerances give.
    let mut wide = rings();
    wide["contact"] = json!({
        "gap": said["contacts"]["closing_gap"], "angle_deg": said["contacts"]["closing_angle_deg"]
    });
    let wide = desk.write("wide.json", &wide);
    let there = desk.saved(YES, &["limit", &wide, "--law", "associative", "--skip-dead"]);
    let there = there["answer"]["load_factor"]["value"].as_f64().unwrap();
    assert!((there - closed).abs() < 1e-6 * closed, "{there}, {closed}");
    // It is verified like the rest, and a false one is refused.
    desk.checked(YES, &saved);
    for (key, value) in [
        ("difference", json!("none")),
        ("answer", json!({ "load_factor": { "status": "unbounded" } })),
    ] {
        let mut forged = saved.clone();
        forged["answer"]["left_out_contacts"]["closed"][key] = value;
        desk.checked(NO, &forged);
    }
    let mut silent = saved;
    silent["answer"].as_object_mut().unwrap().remove("left_out_contacts");
    desk.checked(NO, &silent);
}

#[test]
fn what_falls_for_a_joint_that_overlaps_says_that_it_stands_with_it() {
    let desk = Desk::new();
    let scene = desk.write("sunk.json", &sunk(0.0058));
    let assess = expect(NO, voussoir(&["assess", &scene, "-q"]));
    assert_eq!(
        out(&assess),
        "Sunk: falls; without contacts between 1 pair of blocks that overlap by up to 0.0058 m; with them closed it stands\n"
    );
    let json: Value =
        serde_json::from_str(&out(&expect(NO, voussoir(&["assess", &scene, "--json"])))).unwrap();
    assert_eq!(json["answer"]["verdict"], "unstable");
    assert_eq!(
        (
            &json["answer"]["left_out_contacts"]["closed"]["answer"]["verdict"],
            &json["answer"]["left_out_contacts"]["closed"]["difference"]
        ),
        (&json!("stable"), &json!("stronger"))
    );
    // No tolerance closes this one, and that is said as well.
    let deep = desk.write("deep.json", &sunk(0.3));
    let line = out(&voussoir(&["assess", &deep, "-q"]));
    assert!(line.contains("overlap by up to 0.3 m; with them the answer may differ"), "{line}");
}

/// A thrust and a critical value are asked again, too: other numbers are no yes any more, and a file
/// that says otherwise is refused.
#[test]
fn thrusts_and_flips_are_asked_again_with_contacts_closed() {
    let desk = Desk::new();
    let mut closed = rings();
    let given = desk.write("rings.json", &closed);
    let check = desk.saved(YES, &["limit", &given, "--law", "associative", "--skip-dead"]);
    let contacts = &check["answer"]["left_out_contacts"]["contacts"];
    closed["contact"] =
        json!({ "gap": contacts["closing_gap"], "angle_deg": contacts["closing_angle_deg"] });
    let closed = desk.write("closed.json", &closed);

    let line = out(&expect(UNDECIDED, voussoir(&["thrust", &given, "-q"])));
    assert!(line.contains("with them closed the least thrust is "), "{line}");
    let saved = desk.saved(UNDECIDED, &["thrust", &given]);
    let there = desk.saved(YES, &["thrust", &closed]);
    let said = &saved["answer"]["left_out_contacts"]["closed"];
    assert_eq!(said["difference"], "another");
    for end in ["least", "greatest"] {
        let (a, b) = (&said["answer"]["thrust"][end], &there["answer"]["thrust"][end]);
        let (a, b) = (a["value"].as_f64().unwrap(), b["value"].as_f64().unwrap());
        assert!((a - b).abs() < 1e-6 * b, "{end}: {a}, {b}");
    }
    desk.checked(YES, &saved);
    let mut forged = saved;
    forged["closed"]["answer"]["thrust"]["least"]["value"] = json!(1.0);
    desk.checked(NO, &forged);

    let flip = ["--vary", "/joints/default/friction", "--between", "0.1", "0.9", "--scan", "9"];
    let ask = |scene| [&["critical", scene][..], &flip].concat();
    let (here, there) = (ask(given.as_str()), ask(closed.as_str()));
    let saved = desk.saved(UNDECIDED, &here);
    let there = desk.saved(YES, &there);
    let said = &saved["answer"]["left_out_contacts"]["closed"];
    assert_eq!(said["difference"], "another");
    let first = said["answer"]["flips"]["values"][0].as_f64().unwrap();
    let alone = there["answer"]["critical"][0]["value"].as_f64().unwrap();
    assert!((first - alone).abs() < 1e-5 * alone, "{first}, {alone}");
    desk.checked(YES, &saved);
}

/// A near miss that carries nothing either way is not on the line.
#[test]
fn contacts_that_change_nothing_are_not_said() {
    let desk = Desk::new();
    let mut scene = sunk(0.0);
    let mut beside = scene["blocks"][1].clone();
    (beside["id"], beside["at"]) = (json!("beside"), json!([1.001, 0, 0.5]));
    scene["blocks"].as_array_mut().unwrap().push(beside);
    let scene = desk.write("beside.json", &scene);
    let assess = expect(YES, voussoir(&["assess", &scene, "-q"]));
    assert_eq!((out(&assess).as_str(), err(&assess).as_str()), ("Sunk: stands\n", ""));
    let saved = desk.saved(YES, &["assess", &scene]);
    assert_eq!(saved["answer"]["left_out_contacts"]["contacts"]["near_misses"], 1);
    assert_eq!(saved["answer"]["left_out_contacts"]["closed"]["difference"], "none");
    desk.checked(YES, &saved);
}

/// Undecided answers name the most probable cause and the next step, in every form.
#[test]
fn undecided_answers_say_why_and_what_next() {
    let desk = Desk::new();
    let (arch, pushed, thin) = (desk.at("arch.json"), desk.at("pushed.json"), desk.at("thin.json"));
    let late = ["--time-limit", "1e-9"];
    for (question, cause, next) in [
        ([&["assess", arch.as_str()][..], &late].concat(), "time_limit", "raise --time-limit"),
        ([&["limit", &pushed][..], &late].concat(), "time_limit", "raise --time-limit"),
        ([&["tilt", &arch, "--all", "2"][..], &late].concat(), "time_limit", "raise --time-limit"),
        ([&["thrust", &arch][..], &late].concat(), "time_limit", "raise --time-limit"),
        (
            vec!["simulate", &thin, "--fast", "--seconds", "0.01", "--skip-verdict"],
            "still_moving",
            "simulate longer: --seconds 0.02",
        ),
    ] {
        let line = out(&expect(UNDECIDED, voussoir(&[&question[..], &["-q"]].concat())));
        assert!(line.lines().count() == 1 && line.contains("undecided"), "{question:?}: {line}");
        assert!(line.trim_end().ends_with(next), "{question:?}: {line}");
        let json: Value = serde_json::from_str(&out(&expect(
            UNDECIDED,
            voussoir(&[&question[..], &["--json"]].concat()),
        )))
        .unwrap();
        assert_eq!(json["run"]["doubt"]["cause"], cause, "{question:?}");
        assert!(!json["run"]["doubt"]["evidence"].as_str().unwrap().is_empty());
        assert_eq!(json["run"]["doubt"]["next"], next);
    }
    // What is decided has no doubt.
    let json: Value =
        serde_json::from_str(&out(&expect(YES, voussoir(&["assess", &arch, "--json"])))).unwrap();
    assert!(json["run"].get("doubt").is_none());
}

/// What a packing of one's own does not give to a protocol, and what was taken for granted of it.
#[test]
fn what_is_left_of_a_packing_of_ones_own_is_told() {
    let desk = Desk::new();
    let dump = "ITEM: ATOMS id type x y z radius\n1 1 9 9 9 0.005\n2 2 0 0 0.005 0.005\n";
    fs::write(desk.path("own.dump"), dump).unwrap();
    let start = desk.at("own.dump");
    let run = ["repose", "drain", "grains=30", "size=[6,4]", "--question", "repose", "--start"];
    let told = err(&expect(USAGE, voussoir(&[&run[..], &[&start]].concat())));
    assert!(told.contains("spheres of type 2, read as supports: 1"), "{told}");
    assert!(told.contains("own.dump: 1 support not used; the protocol has its own"), "{told}");
    assert!(told.contains("lies outside the box"), "{told}");
    assert!(!told.contains("no friction for its joints"), "{told}");
}
