//! Report pages as files: one self-contained file a page, what it holds is what was computed, no
//! string of a scene becomes markup.

use data_encoding::BASE64;
use serde_json::{Value, json};
use std::{fs, path::PathBuf, process::Command};
use voussoir::{
    analysis::{Control, Limited, assess, limit},
    dynamics::{Fidelity, Frame, Pose},
    interface::prepare,
    proof::{read, recompute::JustComputed, saved, verify::verify_model},
    report::{
        page,
        text::{Asked, Layout, TextOptions, render},
        view::{Film, View},
    },
    scene::{Scene, read_str},
};

/// Breaks out of an element, an attribute, a script and a comment.
pub const HOSTILE: &str = "</script><img src=x onerror=\"window.broken=1\">'&amp;--><!--{{data}}";

fn structure(name: &str) -> String {
    format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

/// Runs a question with `--report`; the page.
pub fn report(arguments: &[&str], file: &std::path::Path) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_voussoir"))
        .args(arguments)
        .arg("--quiet")
        .arg("--report")
        .arg(file)
        .output()
        .unwrap();
    assert!(
        output.status.code().is_some_and(|c| c != 2),
        "{arguments:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    fs::read_to_string(file).unwrap_or_else(|e| panic!("{arguments:?}: {e}"))
}

/// The data of a page.
pub fn data(page: &str) -> Value {
    let text = page
        .split("id=\"data\">")
        .nth(1)
        .and_then(|t| t.split("</script>").next())
        .expect("the page has data");
    serde_json::from_str(text).unwrap()
}

fn singles(value: &Value) -> Vec<f64> {
    let text = value
        .as_str()
        .and_then(|t| t.strip_prefix("f32:"))
        .unwrap_or_else(|| panic!("no numbers: {value}"));
    let bytes = BASE64.decode(text.as_bytes()).unwrap();
    bytes.chunks_exact(4).map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))).collect()
}

fn wholes(value: &Value) -> Vec<usize> {
    let text = value
        .as_str()
        .and_then(|t| t.strip_prefix("u16:"))
        .unwrap_or_else(|| panic!("no numbers: {value}"));
    let bytes = BASE64.decode(text.as_bytes()).unwrap();
    bytes.chunks_exact(2).map(|b| usize::from(u16::from_le_bytes([b[0], b[1]]))).collect()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

/// Nothing in a page asks for another file, on the network or beside it.
#[test]
fn every_question_makes_one_file_on_its_own() {
    let desk = folder();
    let thin = structure("semicircular-arch-thin");
    let questions: Vec<Vec<String>> = [
        &["assess", &thin][..],
        &["assess", &structure("column"), "--simulate"],
        &["limit", &structure("arch-with-point-load")],
        &["tilt", &structure("block-on-tilting-table"), "--toward", "1,0"],
        &["thrust", &structure("semicircular-arch-thick"), "--law", "associative"],
        &["simulate", &thin, "--fast"],
        &["repose", &structure("sphere-pile"), "--toward", "1,0"],
        &["repose", "drain", "grains=60", "size=[6,4]", "--question", "repose", "--seeds", "1"],
        &[
            "critical",
            &thin,
            "--vary",
            "/joints/default/friction",
            "--between",
            "0.5",
            "0.9",
            "--scan",
            "3",
        ],
        &[
            "sweep",
            &format!("{}/structures/sweeps/buttress-width.json", env!("CARGO_MANIFEST_DIR")),
            "-o",
            desk.path().join("rows").to_str().unwrap(),
        ],
        &["study", "--quick", "--scenes", "groove"],
    ]
    .iter()
    .map(|q| q.iter().map(|w| w.to_string()).collect())
    .collect();
    for (k, question) in questions.iter().enumerate() {
        let words: Vec<&str> = question.iter().map(String::as_str).collect();
        let text = report(&words, &desk.path().join(format!("{k}.html")));
        for foreign in
            [" src=", " href=", "url(", "@import", "fetch(", "XMLHttpRequest", "import(", "//cdn"]
        {
            let known = text.matches(foreign).count();
            assert_eq!(known, 0, "{words:?}: {foreign}");
        }
        assert!(
            text.starts_with("<!DOCTYPE html>")
                && text.trim_end().ends_with("</html>")
                && !text.contains("{{"),
            "{words:?}"
        );
        assert!(text.contains("default-src 'none'"), "a browser is told to load nothing");
        data(&text);
    }
}

/// A column: each joint carries what lies above it, whatever units the page uses inside.
#[test]
fn a_page_holds_the_numbers_of_the_answer() {
    let desk = folder();
    let mut scene: Value =
        serde_json::from_str(&fs::read_to_string(structure("column")).unwrap()).unwrap();
    scene["loads"] = json!({});
    let file = desk.path().join("column.json");
    fs::write(&file, scene.to_string()).unwrap();
    let data = data(&report(&["assess", file.to_str().unwrap()], &desk.path().join("page.html")));
    let view = &data["view"];
    let (length, unit) = (view["length"].as_f64().unwrap(), view["force"].as_f64().unwrap());
    let model = prepare(&read_str("column", scene.to_string()).unwrap().0).unwrap();
    let blocks = &model.assembly.blocks;
    let (a, b) = (wholes(&view["joints"]["a"]), wholes(&view["joints"]["b"]));
    let (forces, starts) =
        (singles(&view["states"][0]["forces"]), wholes(&view["joints"]["pointStart"]));
    assert_eq!((a.len(), starts.len()), (8, 9));
    for ((a, b), ends) in a.iter().zip(&b).zip(starts.windows(2)) {
        // Upwards on the upper block, downwards on the lower one.
        let normal = (ends[0]..ends[1]).map(|p| forces[3 * p + 2]).sum::<f64>().abs();
        let height = blocks[*a].centroid.z.min(blocks[*b].centroid.z);
        let above: f64 =
            blocks.iter().filter(|b| b.centroid.z > height + 1e-9).map(|b| b.mass * 9.81).sum();
        assert!((normal * unit / above - 1.0).abs() < 1e-5, "{} {above}", normal * unit);
    }
    let middle: Vec<f64> =
        view["middle"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let center = singles(&view["bodies"]["center"]);
    for (i, block) in blocks.iter().enumerate() {
        assert_eq!(view["bodies"]["mass"][i].as_f64().unwrap(), block.mass);
        assert_eq!(view["bodies"]["ids"][i].as_str().unwrap(), block.id);
        for k in 0..3 {
            assert!(
                (center[3 * i + k] * length + middle[k] - block.centroid[k]).abs() < 1e-6 * length
            );
        }
    }
}

/// Of joints that yield the page has the pressed parts with their pressures, and how far blocks went as
/// they are.
#[test]
fn a_page_holds_pressures_and_displacements() {
    let desk = folder();
    let bed = structure("block-on-bed");
    let view = &data(&report(&["state", &bed], &desk.path().join("bed.html")))["view"];
    // 39.24 kN on 1 m², at all four corners; 1e9 Pa/m.
    let pressures = &view["pressures"];
    assert!((pressures["greatest"].as_f64().unwrap() / 39240.0 - 1.0).abs() < 1e-9);
    assert_eq!((wholes(&pressures["joint"]), wholes(&pressures["start"])), (vec![0], vec![0, 4]));
    assert!(singles(&pressures["share"]).iter().all(|s| (s - 1.0).abs() < 1e-6));
    let way = view["motions"][0]["real"].as_f64().unwrap() * view["length"].as_f64().unwrap();
    assert!((way / 3.924e-5 - 1.0).abs() < 1e-9, "{way}");
    // Others have none.
    let rigid = &data(&report(&["limit", &bed], &desk.path().join("rigid.html")))["view"];
    assert!(rigid["pressures"].is_null() && rigid["motions"][0]["real"].is_null());
}

/// The same in millimetres and with other densities, up to single precision: a picture has no
/// units.
#[test]
fn a_picture_does_not_depend_on_units() {
    let scene = |radius: f64, density: f64| -> Scene {
        let arch = json!({ "arch": { "radius": radius, "thickness": 0.16 * radius, "depth": 0.2 * radius, "embrace_deg": 180, "voussoirs": 9, "material": "m" } });
        let text = json!({ "format": "voussoir-scene/1", "materials": { "m": { "density": density } }, "joints": { "default": { "friction": 0.7 } }, "templates": [arch] });
        read_str("arch", text.to_string()).unwrap().0
    };
    let view = |scene: &Scene| -> Value {
        let model = prepare(scene).unwrap();
        let answer = assess(&model, &Control::default());
        let file = saved::assessment(scene, &model, &answer).unwrap();
        let view = View::new(&model, &file, Vec::new()).unwrap();
        let text = render(
            &file,
            Asked { scene: "s", options: "", ..Default::default() },
            TextOptions::default(),
            Layout::default(),
        );
        data(&page::page(&text, &view, &[]).unwrap())["view"].take()
    };
    let (one, other) = (view(&scene(5.0, 2400.0)), view(&scene(5e-3, 1e-3)));
    for part in [["bodies", "corners"], ["joints", "points"]] {
        let (p, q) = (singles(&one[part[0]][part[1]]), singles(&other[part[0]][part[1]]));
        assert!(
            p.len() == q.len()
                && p.len() > 20
                && p.iter().zip(&q).all(|(p, q)| (p - q).abs() < 1e-6),
            "{part:?}"
        );
    }
}

#[test]
fn nothing_in_a_scene_becomes_markup() {
    let desk = folder();
    let scene = hostile();
    let file = desk.path().join("hostile.json");
    fs::write(&file, scene.to_string()).unwrap();
    let text = report(&["assess", file.to_str().unwrap()], &desk.path().join("page.html"));
    assert!(!text.contains("<img src=x") && !text.contains("onerror=\""));
    assert_eq!(text.matches("</script>").count(), 2, "the data and the script, nothing else");
    assert_eq!(data(&text)["view"]["bodies"]["ids"][1], HOSTILE);
}

/// A scene whose names are made to break out.
pub fn hostile() -> Value {
    let size = json!({ "box": { "size": [1, 1, 1] } });
    json!({
        "format": "voussoir-scene/1", "name": HOSTILE, "materials": { HOSTILE: { "density": 2000 } }, "joints": { "default": { "friction": 0.5 } },
        "blocks": [
            { "id": "ground", "shape": size, "at": [0, 0, -0.5], "support": true, "material": HOSTILE },
            { "id": HOSTILE, "shape": size, "at": [0, 0, 0.5], "material": HOSTILE }
        ]
    })
}

/// With two systems of forces, a mechanism and a film of the length that a page takes.
#[test]
fn a_page_of_5000_blocks_stays_below_10_mb() {
    let wall = json!({ "wall": { "size": [1, 0.5, 0.4], "courses": 50, "blocks": 100 } });
    let text = json!({ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.7 } }, "templates": [wall], "loads": { "live": [{ "weight": [1, 0, 0] }] } });
    let scene = read_str("wall", text.to_string()).unwrap().0;
    let model = prepare(&scene).unwrap();
    let count = model.assembly.blocks.len();
    assert!(count > 5000);
    // No time for an attempt: any forces take the same room.
    let control =
        Control { deadline: voussoir::deadline::Deadline::within(0.0), ..Control::default() };
    let bound = limit(&model, &control);
    let dead = Some(assess(&model, &control));
    let file = saved::load_factor(&scene, &model, &Limited { dead, ..bound.into() }).unwrap();
    let mut value = file.to_value().unwrap();
    let forces = &mut value["evidence"]["limit"]["factor"]["bound"]["forces"];
    for (face, contact) in model.interfaces.list.iter().zip(forces.as_array_mut().unwrap()) {
        let normal: [f64; 3] = face.frame.n.into();
        contact["forces"].as_array_mut().unwrap().fill(json!(normal));
    }
    let saved = read::read_str("result", value.to_string()).unwrap();
    let file = verify_model(&saved, &scene, &model, &JustComputed).file.unwrap();
    let mut film = Film::fitting(count);
    for k in 0..500 {
        let pose = |b: &voussoir::assembly::Block| Pose {
            center: b.centroid * (1.0 + 1e-3 * f64::from(k)),
            turn: Default::default(),
            velocity: Default::default(),
            spin: Default::default(),
        };
        let blocks = model.assembly.blocks.iter().map(pose).collect();
        film.see(&Frame {
            time: f64::from(k),
            fidelity: Fidelity::Fast,
            relative: 0.0,
            energy: 0.0,
            blocks,
        });
    }
    let view = View::new(&model, &file, film.frames()).unwrap();
    assert!(
        view.states.len() == 2 && view.film.len() >= 15 && view.states[0].line.len() > 20_000,
        "{} {}",
        view.states.len(),
        view.film.len()
    );
    let text = render(
        &file,
        Asked { scene: "s", options: "", ..Default::default() },
        TextOptions { verbose: true, brief: false },
        Layout::default(),
    );
    let page = page::page(&text, &view, &[]).unwrap();
    println!("{count} blocks: {:.1} MB", page.len() as f64 / 1e6);
    assert!(page.len() < 10_000_000, "{}", page.len());
}

/// Refused before the work, and what was there stays.
#[test]
fn a_page_is_written_whole_or_not_at_all() {
    let desk = folder();
    let run = |arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_voussoir")).args(arguments).output().unwrap()
    };
    let nowhere: PathBuf = desk.path().join("none/page.html");
    let output = run(&["assess", &structure("column"), "--report", nowhere.to_str().unwrap()]);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    let (bad, page) = (desk.path().join("bad.json"), desk.path().join("page.html"));
    fs::write(&bad, "{").unwrap();
    fs::write(&page, "old").unwrap();
    assert_eq!(
        run(&["assess", bad.to_str().unwrap(), "--report", page.to_str().unwrap()]).status.code(),
        Some(2)
    );
    assert_eq!(fs::read_to_string(&page).unwrap(), "old");
    assert_eq!(fs::read_dir(desk.path()).unwrap().count(), 2, "no temporary file is left");
    let scene = desk.path().join("scene.json");
    fs::copy(structure("column"), &scene).unwrap();
    assert_eq!(
        run(&["assess", scene.to_str().unwrap(), "--report", scene.to_str().unwrap()])
            .status
            .code(),
        Some(2)
    );
    // On standard output the page is all there is.
    let output = run(&["assess", &structure("column"), "--report", "-"]);
    assert!(
        output.status.code() == Some(0)
            && output.stdout.starts_with(b"<!DOCTYPE html>")
            && output.stdout.trim_ascii_end().ends_with(b"</html>")
    );
}

/// A page runs no code but its own, and a module of WebAssembly only where it verifies itself.
#[test]
fn a_page_that_verifies_itself_holds_result_and_checker() {
    let folder = tempfile::tempdir().unwrap();
    let [module, other, page] = ["checker.gz", "other", "page.html"].map(|n| folder.path().join(n));
    std::fs::write(&module, [0x1f, 0x8b, 8, 0]).unwrap();
    std::fs::write(&other, "\0asm").unwrap();
    let scene = format!("{}/structures/column.json", env!("CARGO_MANIFEST_DIR"));
    let policy = |text: &str| -> String {
        text.split("http-equiv=\"Content-Security-Policy\"")
            .nth(1)
            .unwrap()
            .split('>')
            .next()
            .unwrap()
            .into()
    };
    let plain = report(&["assess", &scene], &page);
    assert!(!policy(&plain).contains("eval") && !plain.contains("id=\"checker\""));
    let own = report(&["assess", &scene, "--self-checking", module.to_str().unwrap()], &page);
    assert!(policy(&own).contains("'unsafe-inline' 'wasm-unsafe-eval';"), "{}", policy(&own));
    assert!(own.contains("id=\"checker\">H4sIAA==</script>"));
    let result = own.split("id=\"result\">").nth(1).unwrap().split("</script>").next().unwrap();
    let result: serde_json::Value = serde_json::from_str(result).unwrap();
    assert_eq!(result["format"], "voussoir-result/3");
    for file in [&other, &folder.path().join("none")] {
        let output = Command::new(env!("CARGO_BIN_EXE_voussoir"))
            .args(["assess", &scene, "--report"])
            .arg(&page)
            .arg("--self-checking")
            .arg(file)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains("web/build --checker"), "{said}");
    }
}
