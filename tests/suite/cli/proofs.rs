//! Saved results are refused as soon as anything in them is changed.

use super::*;

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

#[test]
fn a_stable_result_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(YES, &["assess", &desk.at("arch.json")]);
    assert!(desk.checked(YES, &good).starts_with(
        "Arch: proved, exact; that states under dry friction rest or move is computed, not proved\n"
    ));
    let (i, j) = greatest_force(&good["certificate"]);
    type Change<'a> = (&'a str, Box<dyn Fn(&mut Value) + 'a>);
    let changes: Vec<Change> = vec![
        (
            "one force",
            Box::new(|r| scale(&mut r["certificate"]["forces"][i]["forces"][j], 1.0 + 1e-6)),
        ),
        (
            "one force turned",
            Box::new(|r| scale(&mut r["certificate"]["forces"][i]["forces"][j], -1.0)),
        ),
        (
            "a contact dropped",
            Box::new(|r| drop(r["certificate"]["forces"].as_array_mut().unwrap().remove(i))),
        ),
        (
            "a point moved",
            Box::new(|r| scale(&mut r["certificate"]["forces"][i]["points"][j], 1.001)),
        ),
        (
            "a force dropped",
            Box::new(|r| {
                drop(r["certificate"]["forces"][i]["forces"].as_array_mut().unwrap().remove(j))
            }),
        ),
        (
            "an unknown block",
            Box::new(|r| r["certificate"]["forces"][i]["between"][0] = json!("nobody")),
        ),
        ("the verdict", Box::new(|r| r["answer"]["verdict"] = json!("unstable"))),
        ("the verdict undecided", Box::new(|r| r["answer"]["verdict"] = json!("undecided"))),
        ("the claim", Box::new(|r| r["certificate"]["claim"] = json!("unstable"))),
        (
            "verdict and claim",
            Box::new(|r| {
                (r["answer"]["verdict"], r["certificate"]["claim"]) =
                    (json!("unstable"), json!("unstable"))
            }),
        ),
        ("no claim", Box::new(|r| drop(r["certificate"].as_object_mut().unwrap().remove("claim")))),
        ("the unbalance", Box::new(|r| r["answer"]["unbalance"]["upper"] = json!(1e-3))),
        ("a count", Box::new(|r| r["scene"]["contact_points"] = json!(1))),
        ("another question", Box::new(|r| r["question"] = json!("limit"))),
        ("a density", Box::new(|r| r["scene"]["input"]["blocks"][5]["density"] = json!(2400.01))),
        (
            "the friction",
            Box::new(|r| r["scene"]["input"]["joints"]["default"]["friction"] = json!(0.01)),
        ),
        (
            "a load",
            Box::new(|r| {
                r["scene"]["input"]["loads"] =
                    json!({"dead": [{"block": "v05", "force": [1, 0, 0]}]})
            }),
        ),
    ];
    for (what, change) in changes {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good, "{what}");
        let text = desk.checked(NO, &bad);
        assert!(text.starts_with("Arch: refuted\n") && text.contains("fails"), "{what}: {text}");
    }
    // An answer with half of its keys is no result at all.
    for key in ["verdict", "unbalance"] {
        let mut bad = good.clone();
        drop(bad["answer"].as_object_mut().unwrap().remove(key));
        desk.checked(USAGE, &bad);
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
    changed(&|r| {
        (r["answer"]["verdict"], r["certificate"]["claim"]) = (json!("stable"), json!("stable"))
    });
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
    changed(&|r| more(&mut r["answer"]["load_factor"]["associative"]["value"]));
    changed(&|r| more(&mut r["certificate"]["claim"]["load_factor"]["value"]));
    changed(&|r| {
        for end in ["value", "lower", "upper"] {
            more(&mut r["answer"]["load_factor"][end]);
            more(&mut r["answer"]["load_factor"]["associative"][end]);
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
    changed(&|r| {
        (r["answer"]["verdict"], r["dead_load"]["answer"]["verdict"]) =
            (json!("unstable"), json!("unstable"))
    });
    // Keys of two questions in one answer are no result at all.
    let mut mixed = good.clone();
    mixed["answer"]["tilt_deg"] = mixed["answer"]["load_factor"].clone();
    desk.checked(USAGE, &mixed);
}

#[test]
fn a_load_factor_with_dry_friction_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(
        YES,
        &["limit", concat!(env!("CARGO_MANIFEST_DIR"), "/structures/block-in-groove.json")],
    );
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
    changed(&|r| {
        r["answer"]["tilt_deg"]["value"] =
            json!(r["answer"]["tilt_deg"]["value"].as_f64().unwrap() + 1e-6)
    });
    changed(&|r| {
        // The strongest direction in place of the weakest.
        let list = r["directions"].as_array().unwrap();
        let angle = |d: &Value| d["answer"]["tilt_deg"]["associative"]["value"].as_f64().unwrap();
        let strongest = list.iter().max_by(|a, b| angle(a).total_cmp(&angle(b))).unwrap().clone();
        r["answer"] = strongest["answer"].clone();
        r["certificate"] = strongest["certificate"].clone();
    });
    changed(&|r| r["directions"][1]["answer"]["toward"] = json!([0.6, 0.8, 0.0]));
    changed(&|r| r["directions"][1]["answer"]["toward"] = json!([0.0, 0.0, 1.0]));
    let mut nowhere = good.clone();
    drop(nowhere["directions"][1]["answer"].as_object_mut().unwrap().remove("toward"));
    desk.checked(USAGE, &nowhere);
    changed(&|r| scale(&mut r["directions"][2]["certificate"]["rates"][0]["velocity"], 1.1));
    let one = desk.saved(YES, &["tilt", &desk.at("arch.json"), "--toward", "1,1", "--skip-dead"]);
    assert!(one.get("directions").is_none() && one.get("dead_load").is_none());
    desk.checked(YES, &one);
}

#[test]
fn loads_without_limit_and_without_answer_are_proved_as_well() {
    let desk = Desk::new();
    let mut scene: Value =
        serde_json::from_str(&out(&expect(YES, voussoir(&["generate", "column", "blocks=3"]))))
            .unwrap();
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
