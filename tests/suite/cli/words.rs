//! Messages blame what was typed, name the place that there is, and say what things are measured
//! by.

use super::*;

#[test]
fn a_span_and_a_rise_are_enough_for_an_arch() {
    for args in [
        &["generate", "arch", "span=4", "rise=1"][..],
        &["generate", "arch", "profile=elliptical", "span=4", "rise=1"],
        &["generate", "barrel", "intrados_span=4", "intrados_rise=1"],
        &["generate", "stack", "harmonic=0.9"],
    ] {
        let scene: Value = serde_json::from_str(&out(&expect(YES, voussoir(args)))).unwrap();
        let values = scene["templates"][0].as_object().unwrap().values().next().unwrap();
        assert!(values["radius"].is_null() && values["shift"].is_null(), "{values}");
    }
    let both = err(&expect(USAGE, voussoir(&["generate", "arch", "span=4", "rise=1", "radius=3"])));
    assert!(
        both.contains("arch.radius: cannot be combined with span and rise")
            && both.contains("of the mid-line"),
        "{both}"
    );
    let one = err(&expect(USAGE, voussoir(&["generate", "arch", "span=4"])));
    assert!(
        one.contains("arch.rise: missing") && one.contains("span and rise of the mid-line"),
        "{one}"
    );
    let two = err(&expect(
        USAGE,
        voussoir(&["generate", "arch", "intrados_span=4", "intrados_rise=1", "rise=1"]),
    ));
    assert!(
        two.contains("arch.rise: cannot be combined with intrados_span")
            && two.contains("leave rise out"),
        "{two}"
    );
}

#[test]
fn the_help_of_a_template_lists_its_parameters_with_units() {
    let arch = out(&expect(YES, voussoir(&["generate", "arch", "--help"])));
    for words in [
        "\n  radius=5.0\n      Radius of the mid-line, m",
        "\n  intrados_span\n      Clear span",
        "pointed: Two arcs",
        "buttresses.width",
        "(needed)",
    ] {
        assert!(arch.contains(words), "{words:?} in {arch}");
    }
    for name in ["barrel", "column", "dome", "flat_arch", "lattice", "stack", "wall"] {
        let text = out(&expect(YES, voussoir(&["generate", name, "-h"])));
        assert!(text.starts_with(&format!("{name}: ")) && text.contains(", m"), "{text}");
    }
    let verb = out(&expect(YES, voussoir(&["generate", "--help"])));
    assert!(verb.contains("Usage:") && verb.contains("--expand"), "{verb}");
    expect(USAGE, voussoir(&["generate"]));
}

#[test]
fn what_is_about_the_command_line_names_no_place_in_the_scene() {
    for args in [
        &["thrust", "structures/dome.json", "--direction", "0,0,-1"][..],
        &["tilt", "structures/column.json", "--toward", "0,0,-1"],
    ] {
        let said = err(&expect(USAGE, voussoir(args)));
        assert!(said.contains("parallel to gravity") && !said.contains(".json:"), "{said}");
    }
    let said = err(&expect(USAGE, voussoir(&["repose", "drain"])));
    assert!(
        said.contains("`drain` is a protocol")
            && said.contains("voussoir repose drain --question repose"),
        "{said}"
    );
}

#[test]
fn an_import_takes_an_angle_beside_the_gap() {
    let desk = Desk::new();
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/mistakes/pile-in-metres.obj");
    let import = |angle: &str| {
        voussoir(&["import", mesh, "--gap", "1e-3", "--angle", angle, "-o", &desk.at("scene.json")])
    };
    expect(YES, import("3"));
    let scene: Value =
        serde_json::from_str(&fs::read_to_string(desk.path("scene.json")).unwrap()).unwrap();
    assert_eq!(
        (&scene["contact"]["gap"], &scene["contact"]["angle_deg"]),
        (&json!(1e-3), &json!(3.0))
    );
    assert!(err(&expect(USAGE, import("60"))).contains("must be > 0 and < 45, got 60"));
}
