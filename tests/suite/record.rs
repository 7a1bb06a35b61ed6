//! The record of an assessment: what stands in it is what was asked and what came out.

use crate::page::report;
use serde_json::{Value, json};
use std::fs;

/// The page of a scene.
fn page(verb: &str, scene: &Value) -> String {
    let desk = tempfile::tempdir().unwrap();
    let file = desk.path().join("scene.json");
    fs::write(&file, scene.to_string()).unwrap();
    report(&[verb, file.to_str().unwrap()], &desk.path().join("page.html"))
}

/// The cells of the rows of the table whose first column has this name.
fn table(page: &str, column: &str) -> Vec<Vec<String>> {
    let record = page.split("class=\"record\"").nth(1).expect("a record");
    let table = record
        .split("<table>")
        .skip(1)
        .map(|t| t.split("</table>").next().unwrap())
        .find(|t| t.contains(&format!(">{column}</th>")))
        .unwrap_or_else(|| panic!("no table of {column}"));
    let rows = table.split("<tbody>").nth(1).unwrap();
    let text =
        |cell: &str| cell.split_once('>').unwrap().1.split("</td>").next().unwrap().to_string();
    rows.split("<tr>").skip(1).map(|r| r.split("<td").skip(1).map(text).collect()).collect()
}

/// A box 2 m wide and 1 m deep, 20 kN, with 20 kN down and 4 kN sideways half a metre off its middle,
/// on the plane of the joint: N = 40 kN at e = 0.25 m of t = 2 m, T = 4 kN. Under μ = 0.5 that is 4 / 20
/// of the friction; rectangular pressure on 2 − 2 · 0.25 m of depth 1 m is 26.7 kPa of 100 kPa.
fn pressed() -> Value {
    let size = |v: [f64; 3]| json!({ "box": { "size": v } });
    json!({
        "format": "voussoir-scene/1", "name": "Pressed", "gravity": [0, 0, -10],
        "materials": { "tuff": { "density": 1000 } },
        "joints": { "default": { "friction": 0.5, "compression": 1e5 } },
        "blocks": [
            { "id": "ground", "shape": size([4.0, 4.0, 1.0]), "at": [0, 0, -0.5], "support": true },
            { "id": "pier", "shape": size([2.0, 1.0, 1.0]), "at": [0, 0, 0.5], "material": "tuff" },
        ],
        "loads": {
            "dead": [{ "block": "pier", "force": [4e3, 0, -20e3], "at": [0.5, 0, 0] }],
            "live": [{ "block": "pier", "force": [1e3, 0, 0] }]
        }
    })
}

#[test]
fn joints_are_used_as_statics_says() {
    let page = page("assess", &pressed());
    let joints = table(&page, "joint");
    assert_eq!(joints.len(), 1);
    assert_eq!(joints[0][..5], ["ground | pier", "40 kN", "4 kN", "0.125", "25.0 %"]);
    assert_eq!(joints[0][5..], ["20.0 %", "26.7 %"]);
}

/// The digest is that of the file, byte by byte: of FIPS 180-4 for a known text, and another one for
/// a file that differs by a blank.
#[test]
fn the_file_of_the_scene_has_its_digest() {
    let digest = |text: &str| {
        let desk = tempfile::tempdir().unwrap();
        let file = desk.path().join("scene.json");
        fs::write(&file, text).unwrap();
        let page = report(&["assess", file.to_str().unwrap()], &desk.path().join("page.html"));
        let said = voussoir::keep::digest(text.as_bytes());
        assert!(page.contains(&said), "no digest {said}");
        said
    };
    let text = pressed().to_string();
    assert_ne!(digest(&text), digest(&format!("{text} ")));
    // With a byte order mark it is still that of the file.
    digest(&format!("\u{feff}{text}"));
}

/// The record names the format that is saved.
#[test]
fn the_format_of_results_is_the_one_that_is_saved() {
    let desk = tempfile::tempdir().unwrap();
    let saved = desk.path().join("result.json");
    let question = ["assess", "structures/column.json", "--save", saved.to_str().unwrap()];
    let page = report(&question, &desk.path().join("page.html"));
    let saved: Value = serde_json::from_str(&fs::read_to_string(saved).unwrap()).unwrap();
    let format = saved["format"].as_str().unwrap();
    assert!(page.contains(&format!(">{format}<")), "{format}");
}

/// Heaps have a record of their own: a row each, and how they were made.
#[test]
fn heaps_are_listed() {
    let desk = tempfile::tempdir().unwrap();
    let page = report(
        &["repose", "drain", "grains=60", "size=[6,4]", "--question", "repose", "--seeds", "2"],
        &desk.path().join("page.html"),
    );
    let heaps = table(&page, "seed");
    assert_eq!(heaps.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(), ["1", "2"]);
    for row in heaps {
        let grains = row[2].parse::<usize>().unwrap() + row[3].parse::<usize>().unwrap();
        assert!(row[1] == "at rest" && grains == 60, "{row:?}");
        // Too few to have an angle: the reason stands there.
        assert!(row[4] == "–" && !row[9].is_empty(), "{row:?}");
    }
    assert!(page.contains("How they were made") && page.contains("At what slope"));
}

/// What it was asked of: all that the scene says, with units.
#[test]
fn a_record_says_of_what_it_was_asked() {
    let page = page("assess", &pressed());
    assert_eq!(table(&page, "material"), [["tuff", "1", "1000", "2", "2000"]]);
    assert_eq!(table(&page, "support"), [["ground", "(0, 0, -0.5)"]]);
    let laws = &table(&page, "joints")[0];
    assert_eq!(laws[..6], ["1", "2", "0.5 (26.57°)", "0", "0", "100 kPa"]);
    let dead = &table(&page, "dead load on")[0];
    assert_eq!(dead[..3], ["pier", "(0.5, 0, 0)", "20.4 kN"]);
    // A verdict is about dead loads: the record says that the live one takes no part.
    assert_eq!(table(&page, "live load on")[0][2], "1 kN");
    assert!(page.contains("Live loads (× λ), not used for this question"));
    for words in [
        "Does it stand under its weight",
        "Warnings about the scene",
        "<h3>Proof</h3>",
        "made</dt>",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // Drawn without a script, and only where there is a record.
    let record = page.split("class=\"record\"").nth(1).unwrap();
    assert!(record.contains("class=\"sheet\"") && record.contains("<title>pier</title>"));
}

/// The meaning of λ stands beside it, and what the live loads are.
#[test]
fn a_load_factor_says_what_it_multiplies() {
    let page = page("limit", &pressed());
    assert!(page.contains("λ multiplies all live loads together"));
    assert!(!page.contains("not used for this question"));
    let asked = page.split("class=\"rows asked\"").nth(1).unwrap();
    assert!(asked.contains("dimensionless") && asked.contains("voussoir limit"));
}

/// The proof of a thrust stands at its two ends, and is not said to be missing.
#[test]
fn a_thrust_is_proved_at_both_ends() {
    let desk = tempfile::tempdir().unwrap();
    let arch = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/semicircular-arch-thick.json");
    let file = desk.path().join("page.html");
    let page = report(&["thrust", arch, "--law", "associative"], &file);
    let proof = page.split("<h3>Proof</h3>").nth(1).unwrap().split("</section>").next().unwrap();
    assert!(proof.contains("<dt>least</dt>") && proof.contains("<dt>greatest</dt>"), "{proof}");
    assert!(!proof.contains("claims nothing"), "{proof}");
}

/// Of a scene that falls no forces balance it, and no joint is said to be used.
#[test]
fn what_falls_has_no_used_joints() {
    let mut scene = pressed();
    scene["loads"]["dead"][0]["at"] = json!([1.0, 0, 0]);
    scene["loads"]["dead"][0]["force"] = json!([0, 0, -90e3]);
    let page = page("assess", &scene);
    assert!(page.contains("class=\"bad\"") && !page.contains("Joints of greatest utilisation"));
    assert!(page.contains("class=\"record\""));
}

/// The drawing of a film says what its frame is: a share of a movement is no time, and stages do not
/// move at all.
#[test]
fn a_film_is_drawn_with_what_it_goes_along() {
    let desk = tempfile::tempdir().unwrap();
    let record = |arguments: &[&str]| {
        let page = report(arguments, &desk.path().join("page.html"));
        let record = page.split("class=\"record\"").nth(1).unwrap().to_string();
        (page, record)
    };
    let (_, settled) =
        record(&["settle", "structures/spreading-arch.json", "--move", "springer_right=0.02,0,0"]);
    assert!(settled.contains("Share of the imposed movement 1") && !settled.contains(">after "));
    let (page, staged) = record(&["stages", "structures/a-frame-stands.json", "--any-order"]);
    assert!(!staged.contains(">after ") && !staged.contains("initial position"));
    assert!(page.contains("In which order can it be built"));
    // A train is drawn where it is worst, and the page has its loads and load factor at every position.
    let tandem = "structures/bridge-tandem.json";
    let (page, train) = record(&["limit", tandem, "--moving", "--law", "associative"]);
    assert!(train.contains("Position of the train 6.789 m, λ = 1.435"));
    assert!(page.contains("\"labels\":[\"λ = ") && page.contains("\"loads\":[{\"body\""));
}

/// Where joints yield their stiffness is listed, and what came out stands beside the question.
#[test]
fn stiffness_is_listed_where_there_is_one() {
    let desk = tempfile::tempdir().unwrap();
    let page = report(&["state", "structures/block-on-bed.json"], &desk.path().join("page.html"));
    // Rounding is no force.
    assert_eq!(table(&page, "joint")[0][2], "0 N");
    let laws = &table(&page, "normal stiffness")[0];
    assert_eq!(laws[8..], ["1 GPa/m", "400 MPa/m"]);
    let asked = page.split("class=\"rows asked\"").nth(1).unwrap();
    assert!(asked.contains("λ = 19.620000 along the path, the proved bound"));
}
