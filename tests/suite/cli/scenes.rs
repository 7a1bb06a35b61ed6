//! Scenes from templates and meshes, and what is said of bad ones.

use super::*;

#[test]
fn templates_are_changed_by_key() {
    let list = out(&expect(YES, voussoir(&["generate", "--list"])));
    assert!(list.lines().count() >= 5);
    for line in list.lines() {
        let name = line.split(' ').next().unwrap();
        let scene = out(&expect(YES, voussoir(&["generate", name, "--name", "T"])));
        let answer = expect(YES, with_input(&["assess", "-", "-q"], &scene));
        assert_eq!(out(&answer), "T: stands\n", "{name}");
        let blocks =
            out(&expect(YES, voussoir(&["generate", name, "--expand", "--density", "1800"])));
        let blocks: Value = serde_json::from_str(&blocks).unwrap();
        assert!(
            blocks.get("templates").is_none()
                && blocks["materials"].as_object().unwrap().len() == 1,
            "{name}"
        );
        assert!(
            blocks["blocks"].as_array().unwrap().iter().all(|b| b["material"].is_string()),
            "{name}"
        );
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
        assert!(
            err(&answer).contains(said) && out(&answer).is_empty(),
            "{wrong:?}: {}",
            err(&answer)
        );
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
        for face in
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        {
            text.push_str(&format!("f {}\n", face.map(|i: i32| (i + first).to_string()).join(" ")));
        }
    }
    let obj = desk.at("stone.obj");
    fs::write(&obj, text).unwrap();
    let scene = desk.at("stone.json");
    for support in [["--support", "ground"], ["--support-below", "-0.5"]] {
        expect(
            YES,
            voussoir(
                &[&["import", &obj, "--friction", "0.5", "-o", &scene], &support[..]].concat(),
            ),
        );
        assert_eq!(desk.read("stone.json")["blocks"].as_array().unwrap().len(), 2);
        let result = desk.saved(YES, &["tilt", &scene, "--toward", "1,0"]);
        assert!((result["answer"]["tan_tilt"]["value"].as_f64().unwrap() - 0.5).abs() < 1e-7);
    }
    // What is missing is said, on standard error alone.
    let answer = expect(YES, voussoir(&["import", &obj]));
    assert!(
        err(&answer).contains("note: ") && serde_json::from_str::<Value>(&out(&answer)).is_ok()
    );
    expect(USAGE, voussoir(&["import", &obj, "--support", "nobody"]));
    expect(USAGE, voussoir(&["import", &desk.at("none.obj")]));
    expect(USAGE, voussoir(&["import", &obj, "--up", "w"]));
    let formats = expect(YES, voussoir(&["import"]));
    let formats = String::from_utf8_lossy(&formats.stdout).into_owned();
    assert!(formats.contains("voussoir import arch.dxf"), "{formats}");
    expect(USAGE, voussoir(&["import", "-o", &scene]));
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
    assert!(
        parts.next().unwrap().parse::<usize>().unwrap() > 10
            && parts.next().unwrap().parse::<usize>().is_ok(),
        "{place}"
    );
    assert!(parts.next().unwrap().starts_with(" blocks[3].density: "), "{place}");
    assert!(lines[1].starts_with("hint: ") && lines.len() == 2, "{lines:?}");
}

#[test]
fn the_schema_is_json() {
    let schema: Value = serde_json::from_str(&out(&expect(YES, voussoir(&["schema"])))).unwrap();
    assert!(schema["properties"]["blocks"].is_object());
}
