//! Mistakes of units, axes, loads, meshes and ids, one file each (`tests/mistakes`), found with the
//! right advice; and no scene that is meant as it is takes one for granted.
//!
//! `mistakes.json` lists them: `file`, `mistake` in words, `ask` (`check`; `refused`, an error of
//! every verb; `import` with its options) and `says`, words that have to be on one line of what is
//! said.

use super::{
    ask::{cuboid, fixed},
    granular, reference,
};
use serde_json::Value;
use std::{path::PathBuf, process::Command};
use voussoir::{
    import::{ImportOptions, Reach, import_files, read_meshes},
    interface::prepare,
    report::imported::examine,
    scene::{Friction, Scene, read_file},
};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Exit code, standard output and standard error of a command in the folder of mistakes.
fn run(args: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_voussoir"))
        .current_dir(root().join("tests/mistakes"))
        .args(args)
        .output()
        .unwrap();
    let text = |b: &[u8]| String::from_utf8_lossy(b).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

/// Whether one line, or two lines of an error and its hint, have all the words.
fn says(text: &str, words: &[&str]) -> bool {
    let lines: Vec<&str> = text.lines().collect();
    let pairs = lines.windows(2).filter(|p| p[1].starts_with("hint: ")).map(|p| p.concat());
    lines
        .iter()
        .map(|l| l.to_string())
        .chain(pairs)
        .any(|line| words.iter().all(|w| line.contains(w)))
}

/// What is not as it should be about one mistake.
fn missed(mistake: &Value) -> Vec<String> {
    let file = mistake["file"].as_str().unwrap();
    let words: Vec<&str> =
        mistake["says"].as_array().unwrap().iter().map(|w| w.as_str().unwrap()).collect();
    let mut wrong = Vec::new();
    let mut expect = |args: &[&str], code: &dyn Fn(i32) -> bool| {
        let (exit, _, said) = run(args);
        if !says(&said, &words) {
            wrong.push(format!("{file}: {args:?} does not say {words:?}, but: {said}"));
        }
        if !code(exit) {
            wrong.push(format!("{file}: {args:?} ends with {exit}: {said}"));
        }
    };
    match mistake["ask"].as_str().unwrap() {
        // Said whatever is asked, and however little is wanted; never a refusal.
        "check" => {
            expect(&["assess", file, "--quiet", "--law", "associative"], &|exit| exit != 2);
            expect(&["assess", file, "--json", "--law", "associative"], &|exit| exit != 2);
            let (exit, told, _) = run(&["check", file, "--json"]);
            let found: Value = serde_json::from_str(&told).unwrap();
            let found = found["findings"].as_array().unwrap();
            if exit != 1
                || !found
                    .iter()
                    .any(|f| words.iter().all(|w| f["text"].as_str().unwrap().contains(w)))
            {
                wrong.push(format!("{file}: check ends with {exit} and says {found:?}"));
            }
        }
        "refused" => {
            expect(&["check", file], &|exit| exit == 2);
            expect(&["assess", file], &|exit| exit == 2);
        }
        import => {
            let args: Vec<&str> = ["import", file, "--output", "-"]
                .into_iter()
                .chain(import.split_whitespace().skip(1))
                .collect();
            expect(&args, &|exit| exit < 2);
        }
    }
    wrong
}

#[test]
fn every_slip_is_found_with_the_right_advice() {
    let folder = root().join("tests/mistakes");
    let list: Value =
        serde_json::from_str(&std::fs::read_to_string(folder.join("mistakes.json")).unwrap())
            .unwrap();
    let list = list.as_array().unwrap();
    let wrong: Vec<String> = list.iter().flat_map(missed).collect();
    println!("{} mistakes, {} found", list.len(), list.len() - wrong.len().min(list.len()));
    assert!(list.len() >= 40 && wrong.is_empty(), "{wrong:#?}");
    for entry in std::fs::read_dir(&folder).unwrap() {
        let name = entry.unwrap().file_name().to_string_lossy().into_owned();
        assert!(
            name == "mistakes.json" || list.iter().any(|s| s["file"] == *name),
            "{name} is in no row"
        );
    }
}

#[test]
fn an_import_says_how_large_the_thing_is_and_where_objects_are_broken() {
    let (exit, _, said) = run(&[
        "import",
        "pile-in-metres.obj",
        "--friction",
        "0.6",
        "--support",
        "ground",
        "--output",
        "-",
    ]);
    assert_eq!(exit, 0, "{said}");
    assert!(said.contains("5 blocks, 1 support; 3 × 3 × 2.5 m along x, y, z, from (-1, -1, -0.5) to (2, 2, 2); volume 6.5 m³"), "{said}");
    assert!(!said.contains("warning"), "{said}");
    let (exit, scene, said) =
        run(&["import", "open.obj", "--friction", "0.6", "--support", "ground", "--output", "-"]);
    assert!(exit == 1 && scene.contains("stone1"), "it can be looked at: {said}");
    let text = std::fs::read_to_string(root().join("tests/mistakes/open.obj")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let line: usize =
        said.split("open.obj:").nth(1).and_then(|t| t.split(':').next()).unwrap().parse().unwrap();
    let object = lines[..line].iter().rfind(|l| l.starts_with("o ")).unwrap();
    assert!(
        lines[line - 1].starts_with("f ") && *object == "o stone1",
        "line {line} is {:?} of {object:?}",
        lines[line - 1]
    );
}

/// What is said of a scene that is meant as it is.
fn false_mistakes(name: &str, scene: &Scene) -> Vec<String> {
    let model = prepare(scene).unwrap_or_else(|e| panic!("{name}: {e}"));
    model
        .findings()
        .filter(|f| f.code.is_implausible())
        .map(|f| format!("{name}: {}", f.text))
        .collect()
}

#[test]
fn no_scene_of_the_collection_raises_a_false_one() {
    let mut seen = 0;
    let mut wrong = Vec::new();
    for entry in std::fs::read_dir(root().join("structures")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "json") || path.ends_with("expected.json") {
            continue;
        }
        let (mut scene, _) = read_file(&path).unwrap();
        read_meshes(&mut scene, &root().join("structures"), Reach::Folder).unwrap();
        wrong.extend(false_mistakes(&path.display().to_string(), &scene));
        seen += 1;
    }
    println!("{seen} scenes, {} false mistakes", wrong.len());
    assert!(seen >= 80 && wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn no_template_as_it_is_raises_a_false_one() {
    for template in voussoir::generate::examples() {
        let mut scene = Scene { templates: vec![template.clone()], ..Scene::default() };
        scene.joints.default.friction = Some(Friction::Coefficient(0.7));
        assert_eq!(false_mistakes(template.name(), &scene), [""; 0]);
    }
}

#[test]
fn no_reference_case_raises_a_false_one() {
    let file = reference::cases();
    let mut wrong = Vec::new();
    let mut seen = 0;
    for case in file["cases"].as_array().unwrap() {
        let given = |v: &Value| v.get("blocks").or_else(|| v.get("blocks3d")).is_some();
        let variants: Vec<&Value> = case["variants"]
            .as_array()
            .into_iter()
            .flatten()
            .chain([case])
            .filter(|v| given(v))
            .collect();
        let mu = reference::mu_of(case);
        for variant in variants {
            let found =
                false_mistakes(&case["id"].to_string(), &reference::scene(case, variant, mu));
            // Where a case gives contacts alone, its reader puts supports a kilometre below them.
            wrong.extend(found.into_iter().filter(|text| !text.contains("points lie up to")));
            seen += 1;
        }
    }
    for (name, scene) in granular::scenes() {
        wrong.extend(false_mistakes(name, &scene));
        seen += 1;
    }
    println!("{seen} scenes of reference cases, {} false mistakes", wrong.len());
    assert!(seen >= 60 && wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn no_real_assembly_raises_a_false_one() {
    let folder = root().join("tests/cases/compas");
    let armadillo: Vec<String> = (0..8)
        .chain(79..89)
        .chain(217..228)
        .chain(328..332)
        .map(|k: usize| k.to_string())
        .collect();
    let armadillo: Vec<&str> = armadillo.iter().map(String::as_str).collect();
    let mut wrong = Vec::new();
    for (file, supports) in [
        ("cra-cubes.json", &["0"][..]),
        ("cra-H.json", &["0", "1"]),
        ("cra-shelf.json", &["0"]),
        ("cra-shelf-stable.json", &["0"]),
        ("cra-bridge.json", &["0", "1"]),
        ("cra-type-b.json", &["0", "1"]),
        ("cra-armadillo.json", &armadillo),
        ("assembly-crossvault.json", &[]),
        ("assembly-wall.json", &[]),
        ("assembly-stack.json", &["0"]),
        ("dem-crossvault.obj", &["Mesh 180", "Mesh 181", "Mesh 182", "Mesh 183"]),
        ("dem-wall.obj", &["Mesh_0", "Mesh_1", "Mesh_2", "Mesh_3", "Mesh_4"]),
        ("dem-pavillionvault/blocks.json", &[]),
    ] {
        // As they are used, and as they come: before supports and friction are known.
        for supports in [supports, &[]] {
            let options = ImportOptions {
                supports: supports.iter().map(|s| s.to_string()).collect(),
                support_files: if file.starts_with("dem-pav") {
                    vec![folder.join("dem-pavillionvault/supports.json")]
                } else {
                    Vec::new()
                },
                friction: (!supports.is_empty()).then_some(Friction::Coefficient(0.84)),
                ..ImportOptions::default()
            };
            let imported =
                import_files(&[folder.join(file)], &options).unwrap_or_else(|e| panic!("{e}"));
            let examined = examine(&imported, &options, &|| false);
            wrong.extend(
                examined
                    .broken
                    .into_iter()
                    .chain(implausible(&examined.findings))
                    .map(|text| format!("{file}: {text}")),
            );
        }
    }
    // 349 units wide: no vault is, whatever its units are.
    let (units, wrong): (Vec<_>, Vec<_>) =
        wrong.into_iter().partition(|w| w.starts_with("dem-crossvault.obj"));
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(units.len() == 2 && units.iter().all(|u| u.contains("--scale")), "{units:#?}");
}

fn implausible(findings: &[voussoir::error::Finding]) -> Vec<String> {
    findings.iter().filter(|f| f.code.is_implausible()).map(|f| f.text.clone()).collect()
}

#[test]
fn what_is_expected_of_a_slip_is_really_compared() {
    let mistake = |says: &str| serde_json::json!({ "file": "density-in-kilonewtons.json", "ask": "check", "says": [says] });
    assert_eq!(missed(&mistake("kN/m³")), [""; 0]);
    assert_eq!(missed(&mistake("ounces")).len(), 3);
}

#[test]
fn a_thousand_mistakes_of_one_kind_are_one_finding() {
    let path = root().join("tests/mistakes/load-beside-the-block.json");
    let (mut scene, _) = read_file(&path).unwrap();
    let load = scene.loads.live[0].clone();
    scene.loads.live = vec![load.clone(); 1000];
    scene.loads.dead = vec![load];
    let found = false_mistakes("loads", &scene);
    assert!(
        found.len() == 1
            && found[0].contains("loads.dead[0]")
            && found[0].ends_with("(and 1000 more loads)"),
        "{found:?}"
    );
}

/// A cube on a wall is no drawing on its side where something presses it to the wall; heavy things
/// whose mass is given are no stones in another unit.
#[test]
fn what_is_pressed_to_a_wall_or_weighed_is_meant() {
    let scene = |press: f64, mass: f64| -> Scene {
        let wall = fixed(cuboid("wall", [0.1, 1.0, 2.0], [-0.05, 0.0, 0.0]));
        let mut cube = cuboid("cube", [0.1, 0.1, 0.1], [0.05, 0.0, 0.0]);
        cube["mass"] = serde_json::json!(mass);
        let load = serde_json::json!({ "block": "cube", "force": [-press, 0.0, 0.0] });
        let more = serde_json::json!({ "gravity": [0, 0, -9.81], "loads": { "dead": [load] } });
        crate::ask::scene(1.0, serde_json::json!([wall, cube]), more)
    };
    assert_eq!(false_mistakes("pressed", &scene(20.0, 1.0)), [""; 0]);
    // 22,310 kg/m³, as steel with a core of tungsten.
    assert_eq!(false_mistakes("weighed", &scene(400.0, 22.31)), [""; 0]);
    // What presses less than friction needs does not hold it: a load on a drawing with x up.
    let told = false_mistakes("free", &scene(5.0, 1.0));
    assert!(told.len() == 1 && told[0].contains("on its side"), "{told:?}");
}
