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
        "Arch: proved, exact; whether states under dry friction rest or move is computed, not proved\n"
    ));
    let (i, j) = greatest_force(&good["evidence"]["assess"]["standing"]["certificate"]);
    type Change<'a> = (&'a str, Box<dyn Fn(&mut Value) + 'a>);
    let changes: Vec<Change> = vec![
        (
            "one force",
            Box::new(|r| {
                scale(
                    &mut r["evidence"]["assess"]["standing"]["certificate"]["forces"][i]["forces"]
                        [j],
                    1.0 + 1e-6,
                )
            }),
        ),
        (
            "one force turned",
            Box::new(|r| {
                scale(
                    &mut r["evidence"]["assess"]["standing"]["certificate"]["forces"][i]["forces"]
                        [j],
                    -1.0,
                )
            }),
        ),
        (
            "a contact dropped",
            Box::new(|r| {
                drop(
                    r["evidence"]["assess"]["standing"]["certificate"]["forces"]
                        .as_array_mut()
                        .unwrap()
                        .remove(i),
                )
            }),
        ),
        (
            "a point moved",
            Box::new(|r| {
                scale(
                    &mut r["evidence"]["assess"]["standing"]["certificate"]["forces"][i]["points"]
                        [j],
                    1.001,
                )
            }),
        ),
        (
            "a force dropped",
            Box::new(|r| {
                drop(
                    r["evidence"]["assess"]["standing"]["certificate"]["forces"][i]["forces"]
                        .as_array_mut()
                        .unwrap()
                        .remove(j),
                )
            }),
        ),
        (
            "an unknown block",
            Box::new(|r| {
                r["evidence"]["assess"]["standing"]["certificate"]["forces"][i]["between"][0] =
                    json!("nobody")
            }),
        ),
        ("the verdict", Box::new(|r| r["answer"]["verdict"] = json!("unstable"))),
        ("the verdict undecided", Box::new(|r| r["answer"]["verdict"] = json!("undecided"))),
        (
            "the claim",
            Box::new(|r| {
                r["evidence"]["assess"]["standing"]["certificate"]["claim"] = json!("unstable")
            }),
        ),
        (
            "verdict and claim",
            Box::new(|r| {
                (
                    r["answer"]["verdict"],
                    r["evidence"]["assess"]["standing"]["certificate"]["claim"],
                ) = (json!("unstable"), json!("unstable"))
            }),
        ),
        (
            "no claim",
            Box::new(|r| {
                drop(
                    r["evidence"]["assess"]["standing"]["certificate"]
                        .as_object_mut()
                        .unwrap()
                        .remove("claim"),
                )
            }),
        ),
        (
            "the equilibrium error",
            Box::new(|r| r["answer"]["equilibrium_error"]["upper"] = json!(1e-3)),
        ),
        ("a count", Box::new(|r| r["answer"]["counts"]["contact_points"] = json!(1))),
        ("another question", Box::new(|r| r["question"] = json!({ "limit": {} }))),
        ("a density", Box::new(|r| r["scene"]["blocks"][5]["density"] = json!(2400.01))),
        ("the friction", Box::new(|r| r["scene"]["joints"]["default"]["friction"] = json!(0.01))),
        (
            "a load",
            Box::new(|r| {
                r["scene"]["loads"] = json!({"dead": [{"block": "v05", "force": [1, 0, 0]}]})
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
    // So is an answer with half of its keys.
    for key in ["verdict", "equilibrium_error"] {
        let mut bad = good.clone();
        drop(bad["answer"].as_object_mut().unwrap().remove(key));
        desk.checked(NO, &bad);
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
    changed(&|r| {
        scale(
            &mut r["evidence"]["assess"]["standing"]["certificate"]["rates"][3]["velocity"],
            1.001,
        )
    });
    changed(&|r| {
        scale(&mut r["evidence"]["assess"]["standing"]["certificate"]["rates"][3]["spin"], 0.5)
    });
    changed(&|r| {
        drop(
            r["evidence"]["assess"]["standing"]["certificate"]["rates"]
                .as_array_mut()
                .unwrap()
                .remove(0),
        )
    });
    changed(&|r| {
        r["evidence"]["assess"]["standing"]["certificate"]["rates"][0]["block"] =
            json!("springer_left")
    });
    changed(&|r| r["answer"]["verdict"] = json!("stable"));
    changed(&|r| {
        (r["answer"]["verdict"], r["evidence"]["assess"]["standing"]["certificate"]["claim"]) =
            (json!("stable"), json!("stable"))
    });
    changed(&|r| r["answer"]["equilibrium_error"]["lower"] = json!(1.0));
    changed(&|r| drop(r["answer"]["mechanism"]["moving"].as_array_mut().unwrap().remove(0)));
    changed(&|r| r["answer"]["mechanism"]["joints"][0]["motion"] = json!("slide"));
    changed(&|r| r["scene"]["templates"][0]["arch"]["thickness"] = json!(0.8));
}

#[test]
fn a_load_factor_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(YES, &["limit", &desk.at("pushed.json")]);
    desk.checked(YES, &good);
    let (i, j) = greatest_force(&good["evidence"]["limit"]["factor"]["bound"]);
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good);
        desk.checked(NO, &bad);
    };
    let more = |v: &mut Value| *v = json!(v.as_f64().unwrap() * 1.001);
    changed(&|r| more(&mut r["answer"]["load_factor"]["value"]));
    changed(&|r| more(&mut r["answer"]["load_factor"]["associative"]["value"]));
    changed(&|r| {
        more(&mut r["evidence"]["limit"]["factor"]["bound"]["claim"]["load_factor"]["value"])
    });
    changed(&|r| {
        for end in ["value", "lower", "upper"] {
            more(&mut r["answer"]["load_factor"][end]);
            more(&mut r["answer"]["load_factor"]["associative"][end]);
            more(&mut r["evidence"]["limit"]["factor"]["bound"]["claim"]["load_factor"][end]);
        }
    });
    changed(&|r| r["answer"]["load_factor"]["status"] = json!("unbounded"));
    changed(&|r| drop(r["answer"]["load_factor"].as_object_mut().unwrap().remove("upper")));
    changed(&|r| {
        scale(&mut r["evidence"]["limit"]["factor"]["bound"]["forces"][i]["forces"][j], 1.01)
    });
    changed(&|r| {
        scale(&mut r["evidence"]["limit"]["factor"]["bound"]["rates"][2]["velocity"], 1.01)
    });
    changed(&|r| r["scene"]["blocks"][5]["density"] = json!(2500));
    changed(&|r| r["scene"]["loads"]["live"][0]["weight"] = json!([1.01, 0, 0]));
    changed(&|r| r["answer"]["dead_load"]["answer"]["verdict"] = json!("unstable"));
    changed(&|r| {
        drop(r["evidence"]["limit"]["dead"]["certificate"].as_object_mut().unwrap().remove("claim"))
    });
    changed(&|r| {
        (r["answer"]["verdict"], r["answer"]["dead_load"]["answer"]["verdict"]) =
            (json!("unstable"), json!("unstable"))
    });
    let mut mixed = good.clone();
    mixed["answer"]["tilt_deg"] = mixed["answer"]["load_factor"].clone();
    desk.checked(NO, &mixed);
}

#[test]
fn a_load_factor_with_dry_friction_is_refused_after_any_change() {
    let desk = Desk::new();
    let good = desk.saved(
        YES,
        &["limit", concat!(env!("CARGO_MANIFEST_DIR"), "/structures/block-in-groove.json")],
    );
    desk.checked(YES, &good);
    let (i, j) = greatest_force(&good["evidence"]["limit"]["factor"]["dry"]["certificate"]);
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good);
        desk.checked(NO, &bad);
    };
    changed(&|r| r["evidence"]["limit"]["factor"]["dry"]["value"] = json!(0.75));
    changed(&|r| {
        r["evidence"]["limit"]["factor"]["dry"]["value"] = json!(0.71);
        r["evidence"]["limit"]["factor"]["dry"]["certificate"]["claim"]["dry_load_factor"]["value"] =
            json!(0.71);
    });
    changed(&|r| {
        drop(
            r["evidence"]["limit"]["factor"]["dry"]["certificate"]
                .as_object_mut()
                .unwrap()
                .remove("claim"),
        )
    });
    changed(&|r| r["evidence"]["limit"]["factor"]["dry"]["found"] = json!("undecided"));
    changed(&|r| r["evidence"]["limit"]["factor"]["dry"]["found"] = json!("unlimited"));
    changed(&|r| {
        scale(
            &mut r["evidence"]["limit"]["factor"]["dry"]["certificate"]["forces"][i]["forces"][j],
            1.01,
        )
    });
    changed(&|r| {
        r["evidence"]["limit"]["factor"]["dry"]["certificate"]["forces"] =
            r["evidence"]["limit"]["factor"]["bound"]["forces"].clone()
    });
    // The associative mechanism lifts where it slides.
    changed(&|r| {
        r["evidence"]["limit"]["factor"]["dry"]["certificate"]["rates"] =
            r["evidence"]["limit"]["factor"]["bound"]["rates"].clone()
    });
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
        let list = r["answer"]["directions"].as_array().unwrap();
        let angle = |d: &Value| d["answer"]["tilt_deg"]["associative"]["value"].as_f64().unwrap();
        let strongest = list.iter().max_by(|a, b| angle(a).total_cmp(&angle(b))).unwrap().clone();
        for key in ["toward", "tan_tilt", "tilt_deg"] {
            r["answer"][key] = strongest["answer"][key].clone();
        }
    });
    changed(&|r| r["answer"]["directions"][1]["answer"]["toward"] = json!([0.6, 0.8, 0.0]));
    changed(&|r| r["answer"]["directions"][1]["answer"]["toward"] = json!([0.0, 0.0, 1.0]));
    let mut nowhere = good.clone();
    drop(nowhere["answer"]["directions"][1]["answer"].as_object_mut().unwrap().remove("toward"));
    desk.checked(NO, &nowhere);
    changed(&|r| {
        scale(&mut r["evidence"]["tilt"]["directions"][2]["bound"]["rates"][0]["velocity"], 1.1)
    });
    let one = desk.saved(YES, &["tilt", &desk.at("arch.json"), "--toward", "1,1", "--skip-dead"]);
    assert!(one["answer"].get("directions").is_none() && one["answer"].get("dead_load").is_none());
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
    bad["evidence"]["limit"]["factor"]["bound"].as_object_mut().unwrap().remove("base");
    desk.checked(NO, &bad);
    let mut bad = result;
    bad["evidence"]["limit"]["factor"]["bound"]["claim"]["unbounded"]["standing"] = json!(-1e3);
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
    result["scene"]["blocks"][5]["density"] = json!(1.0);
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
    bad["evidence"]["assess"]["standing"]["certificate"]["forces"][0]["forces"][0] =
        json!([null, 0, 0]);
    let answer = expect(USAGE, voussoir(&["check", &desk.write("bad.json", &bad)]));
    assert!(err(&answer).contains("certificate.forces[0].forces[0][0]"), "{}", err(&answer));
    let mut bad = good.clone();
    bad["scene"]["blocks"] = json!([]);
    expect(USAGE, voussoir(&["check", &desk.write("bad.json", &bad)]));
    let text = good.to_string();
    for end in [1, text.len() / 3, text.len() - 2] {
        expect(USAGE, with_input(&["check", "-"], &text[..end]));
    }
    expect(USAGE, with_input(&["check", "-"], ""));
    expect(USAGE, with_input(&["assess", "-"], &text));
}
