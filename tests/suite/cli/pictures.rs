//! Pictures and tables beside the answer.

use super::*;

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
        assert!(
            read("a.vtp").contains("type=\"PolyData\"") && read("a.vtp").ends_with("</VTKFile>\n")
        );
        assert_eq!(
            [read("a.csv").lines().count() > 14, read("a.blocks.csv").lines().count() == 18],
            [true; 2]
        );
        ["a.svg", "a.vtp", "a.csv", "a.blocks.csv"]
            .iter()
            .for_each(|n| fs::remove_file(desk.path(n)).unwrap());
    }
    let packing = desk.at("pile.json");
    expect(
        YES,
        voussoir(&["generate", "lattice", "layers=2", "--friction", "0.5", "-o", &packing]),
    );
    expect(
        YES,
        voussoir(&[
            "repose",
            &packing,
            "--toward",
            "0,-1",
            "--law",
            "associative",
            "--svg",
            &svg,
            "--vtk",
            &vtp,
            "-q",
        ]),
    );
    assert!(desk.files().contains(&"a.svg".into()) && desk.files().contains(&"a.vtp".into()));
    // A picture on standard output stands alone.
    let drawn = out(&expect(
        YES,
        voussoir(&[
            "assess",
            &desk.at("arch.json"),
            "--law",
            "associative",
            "--svg",
            "-",
            "--view",
            "corner",
        ]),
    ));
    assert!(
        drawn.starts_with("<svg ")
            && drawn.ends_with("</svg>\n")
            && drawn.matches("<svg ").count() == 2
    );
}

/// One model of all stages, whose animation goes through them: what comes later has no size before.
#[test]
fn a_model_goes_through_the_stages() {
    let desk = Desk::new();
    let cube = |id: &str, z: f64, support: bool| {
        json!({
            "id": id, "density": 1000, "support": support, "at": [0, 0, z],
            "shape": { "box": { "size": [1, 1, 1] } },
        })
    };
    let scene = json!({
        "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } },
        "blocks": [cube("ground", 0.0, true), cube("first", 1.0, false), cube("second", 2.0, false)],
        "stages": [
            { "name": "one", "add": ["ground", "first"] }, { "name": "two", "add": ["second"] }
        ],
    });
    fs::write(desk.path("staged.json"), scene.to_string()).unwrap();
    let [scene, model] = ["staged.json", "staged.gltf"].map(|n| desk.at(n));
    expect(YES, voussoir(&["stages", &scene, "--skip-margin", "-q", "--gltf", &model]));
    let json: Value = serde_json::from_slice(&fs::read(desk.path("staged.gltf")).unwrap()).unwrap();
    let animations = json["animations"].as_array().unwrap();
    assert_eq!((animations.len(), &animations[0]["name"]), (1, &json!("stage by stage")));
    let channels = animations[0]["channels"].as_array().unwrap();
    assert_eq!(channels.len(), 1, "{channels:?}");
    let target = &channels[0]["target"];
    let node = &json["nodes"][target["node"].as_u64().unwrap() as usize];
    assert_eq!((&target["path"], &node["name"]), (&json!("scale"), &json!("second")));
}

/// Models beside the answer, by their endings; supports are left out of something or refused.
#[test]
fn models_are_written_beside_the_answer() {
    let desk = Desk::new();
    let [text, binary, mesh] = ["a.gltf", "a.glb", "a.obj"].map(|n| desk.at(n));
    let asked = ["assess", &desk.at("thin.json"), "--law", "associative", "-q"];
    expect(NO, voussoir(&[&asked[..], &["--gltf", &text, "--obj", &mesh]].concat()));
    expect(NO, voussoir(&[&asked[..], &["--gltf", &binary, "--hide", "supports"]].concat()));
    let read = |name: &str| fs::read(desk.path(name)).unwrap();
    let json: Value = serde_json::from_slice(&read("a.gltf")).unwrap();
    assert_eq!(json["asset"]["version"], "2.0");
    assert_eq!(&read("a.glb")[..4], b"glTF");
    // The bound of a mechanism has no line of thrust: a root and the blocks.
    let names = |bytes: &[u8]| String::from_utf8_lossy(bytes).matches("\"mass_kg\"").count();
    let objects = String::from_utf8(read("a.obj")).unwrap().matches("\no ").count();
    assert_eq!((names(&read("a.gltf")), names(&read("a.glb"))), (objects, objects - 2));
    let wrong = [&asked[..], &["--hide", "supports"]].concat();
    let said = expect(USAGE, voussoir(&wrong));
    assert!(String::from_utf8_lossy(&said.stderr).contains("--hide"), "{said:?}");
    let wrong = [&asked[..], &["--gltf", &mesh]].concat();
    expect(USAGE, voussoir(&wrong));
}

/// Dimensions are those of the scene: two spans of 6 m, 1.5 m high, 0.45 m thick, on a drawing alone.
#[test]
fn dimensions_are_those_of_the_scene() {
    let desk = Desk::new();
    let svg = desk.at("a.svg");
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/bridge-two-spans.json");
    let asked = ["assess", scene, "--law", "associative", "-q", "--dimensions"];
    expect(YES, voussoir(&[&asked[..], &["--svg", &svg]].concat()));
    let drawn = fs::read_to_string(desk.path("a.svg")).unwrap();
    let sizes: Vec<&str> = drawn
        .split("<text class=\"size\"")
        .skip(1)
        .map(|t| t.split_once('>').unwrap().1.split('<').next().unwrap())
        .collect();
    assert_eq!(sizes[2..], ["6 m", "1.5 m", "0.45 m", "6 m", "1.5 m", "0.45 m"]);
    // From the foot of the pier to the crown of the extrados.
    assert!(sizes[1].starts_with("4.9"), "{sizes:?}");
    let said = expect(USAGE, voussoir(&asked));
    assert!(String::from_utf8_lossy(&said.stderr).contains("--dimensions"), "{said:?}");
}

#[test]
fn saved_results_and_scenes_are_drawn_by_check() {
    let desk = Desk::new();
    let svg = desk.at("a.svg");
    let mut result =
        desk.saved(NO, &["assess", &desk.at("thin.json"), "--law", "associative", "--svg", &svg]);
    let asked = fs::read_to_string(&svg).unwrap();
    expect(YES, voussoir(&["check", &desk.at("saved.json"), "--svg", &svg]));
    assert_eq!(fs::read_to_string(&svg).unwrap(), asked);
    assert!(asked.contains("class=\"moved\"") && asked.contains(">hinge<"));
    fs::remove_file(&svg).unwrap();
    // What is refuted is not drawn.
    scale(
        &mut result["evidence"]["assess"]["standing"]["certificate"]["rates"][0]["velocity"],
        -1.0,
    );
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
    expect(
        NO,
        voussoir(&[
            "simulate",
            &desk.at("thin.json"),
            "--fast",
            "--skip-verdict",
            "--vtk",
            &pvd,
            "--svg",
            &svg,
            "-q",
        ]),
    );
    let text = fs::read_to_string(&pvd).unwrap();
    let named: Vec<&str> =
        text.split("file=\"").skip(1).filter_map(|t| t.split('"').next()).collect();
    assert!(named.len() > 2 && named.iter().all(|n| desk.path(n).is_file()), "{text}");
    assert!(fs::read_to_string(&svg).unwrap().contains("after "));
}

/// A path as a collection of its points, as a page with a film and the curve, and its rest from where
/// it was saved.
#[test]
fn a_path_is_a_collection_of_poses_and_a_film_beside_its_curve() {
    let desk = Desk::new();
    let arch = desk.at("arch.json");
    let [pvd, page, csv, saved] =
        ["way.pvd", "way.html", "way.csv", "way.result.json"].map(|n| desk.at(n));
    let asked = ["settle", &arch, "--move", "springer_right=0.004,0,0", "-q"];
    let files = ["--vtk", &pvd, "--report", &page, "--csv", &csv, "--save", &saved];
    expect(YES, voussoir(&[&asked[..], &files].concat()));
    let text = fs::read_to_string(&pvd).unwrap();
    let named: Vec<&str> =
        text.split("file=\"").skip(1).filter_map(|t| t.split('"').next()).collect();
    assert!(named.len() > 1 && named.iter().all(|n| desk.path(n).is_file()), "{text}");
    assert_eq!(fs::read_to_string(&csv).unwrap().lines().count(), named.len() + 1);
    let page = fs::read_to_string(&page).unwrap();
    assert!(page.contains("\"film\":[") && page.contains("Share of the imposed movement"));
    assert!(page.contains("path, point by point") && !page.contains("simulation, fine"));
    // All of this movement is done; of a longer one that begins so, the rest is left.
    let longer = ["settle", &arch, "--move", "springer_right=0.008,0,0", "--from", &saved, "-q"];
    let again = desk.at("again.csv");
    expect(YES, voussoir(&[&longer[..], &["--csv", &again]].concat()));
    let first = fs::read_to_string(&again).unwrap();
    assert!(first.lines().nth(1).unwrap().starts_with("0.5"), "{first}");
    expect(USAGE, voussoir(&[&asked[..4], &["--from", &arch]].concat()));
}

#[test]
fn pictures_that_cannot_be_made_are_refused_before_the_work() {
    let desk = Desk::new();
    let arch = desk.at("arch.json");
    for (wrong, word) in [
        (&["--vtk", "a.vtk"][..], "name it a.vtp"),
        (&["--vtk", "-", "--svg", "-"], "can go to standard output"),
        (&["--svg", "-", "--json"], "can go to standard output"),
        (&["--csv", "-"], "--csv needs a file"),
        (&["--svg", "no/such/folder.svg"], "no such folder"),
        (&["--view", "corner"], "--svg"),
        (&["--svg", "a.svg", "--view", "inside"], "expected auto, front"),
    ] {
        let answer = expect(USAGE, voussoir(&[&["assess", &arch], wrong].concat()));
        assert!(err(&answer).contains(word), "{wrong:?}: {}", err(&answer));
    }
    // Without an ending the scene itself is seen.
    let plain = desk.at("arch");
    fs::copy(&arch, &plain).unwrap();
    for wrong in [["--svg", &plain], ["--report", &plain]] {
        let answer = expect(USAGE, voussoir(&[&["assess", &plain], &wrong[..]].concat()));
        assert!(err(&answer).contains("would overwrite the scene"), "{}", err(&answer));
    }
    let answer = expect(USAGE, voussoir(&["simulate", &arch, "--vtk", "a.vtp"]));
    assert!(err(&answer).contains("name it a.pvd"), "{}", err(&answer));
    let answer =
        expect(USAGE, voussoir(&["repose", "drain", "--question", "repose", "--csv", "a.csv"]));
    assert!(err(&answer).contains("--heaps"), "{}", err(&answer));
}

/// A drawing called `x.png` opens nowhere.
#[test]
fn an_ending_of_another_format_is_refused_before_the_work() {
    let desk = Desk::new();
    let (arch, before) = (desk.at("arch.json"), desk.files());
    for (question, option, name, remedy) in [
        (&["assess", arch.as_str()][..], "--svg", "x.png", "x.svg, and convert that"),
        (&["assess", &arch], "--report", "r.pdf", "r.html, and print that from a browser"),
        (&["limit", &arch], "--csv", "t.xlsx", "t.csv, and open that"),
        (&["tilt", &arch], "--save", "result.html", "result.json"),
        (&["thrust", &arch], "--svg", "x.csv", "x.svg"),
        (&["simulate", &arch], "--csv", "way.JSON", "way.csv"),
        (&["repose", &arch], "--csv", "contacts.svg", "contacts.csv"),
        (&["repose", "drain", "--question", "repose"], "--heaps", "heap.obj", "heap.json"),
        (&["check", &arch], "--svg", "scene.pdf", "scene.svg, and convert that"),
        (&["sweep", "no-plan.json"], "--svg", "chart.png", "chart.svg, and convert that"),
        (&["sweep", "no-plan.json"], "-o", "rows.csv", "rows.jsonl"),
        (&["sweep", "no-plan.json"], "--csv", "rows.jsonl", "rows.csv"),
        (&["study", "--quick"], "--svg", "charts.svg", "name a folder"),
        (&["study", "--quick"], "--report", "study.svg", "study.html"),
        (&["generate", "arch"], "-o", "arch.obj", "arch.json"),
        (&["import", "no.obj"], "-o", "scene.obj", "scene.json"),
    ] {
        let path = desk.at(name);
        let answer = expect(USAGE, voussoir(&[question, &[option, &path]].concat()));
        assert!(
            err(&answer).contains(remedy) && err(&answer).contains(option),
            "{question:?} {option} {name}: {}",
            err(&answer)
        );
        assert_eq!((out(&answer), desk.files()), (String::new(), before.clone()));
    }
}
