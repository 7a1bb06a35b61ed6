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

/// The first page.
fn cover(page: &str) -> &str {
    let cover = page.split("<section class=\"cover\"").nth(1).expect("a first page");
    cover.split("</section>").next().unwrap()
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
    let cover = cover(&page);
    assert!(cover.contains("class=\"sheet\"") && cover.contains("<title>pier</title>"));
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
        let record = cover(&page).to_string();
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

/// The text of a piece of a page, without drawings and markup.
fn text(html: &str) -> String {
    let (before, rest) = html.split_once("<svg").unwrap_or((html, ""));
    let after = rest.split_once("</svg>").map_or("", |r| r.1);
    let mut inside = false;
    let plain = |c: char| {
        inside = (inside || c == '<') && c != '>';
        if inside || c == '>' { ' ' } else { c }
    };
    format!("{before}{after}").chars().map(plain).collect()
}

/// The numbers in a text, with the digits after the point.
fn numbers(text: &str) -> Vec<(f64, usize)> {
    text.split(|c: char| !c.is_ascii_digit() && c != '.')
        .map(|word| word.trim_matches('.'))
        .filter_map(|word| {
            let digits = word.split_once('.').map_or(0, |p| p.1.len());
            Some((word.parse().ok()?, digits))
        })
        .collect()
}

/// All numbers of a result, also those in its texts.
fn all_numbers(value: &Value, list: &mut Vec<f64>) {
    match value {
        Value::Number(n) => list.push(n.as_f64().unwrap().abs()),
        Value::String(text) => list.extend(numbers(text).iter().map(|n| n.0)),
        Value::Array(values) => values.iter().for_each(|v| all_numbers(v, list)),
        Value::Object(values) => values.values().for_each(|v| all_numbers(v, list)),
        Value::Null | Value::Bool(_) => {}
    }
}

/// A bridge under a train, with all that the first page says in the scene, and its result.
fn bridge(record: Value) -> (String, Value) {
    let desk = tempfile::tempdir().unwrap();
    let place = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/bridge-tandem.json");
    let mut scene: Value = serde_json::from_str(&fs::read_to_string(place).unwrap()).unwrap();
    scene["templates"][0]["bridge"]["fill"]["dispersal"] = json!(0.5);
    scene["joints"]["default"]["compression"] = json!(5e6);
    scene["require"] = json!({ "load_factor": 1.25 });
    scene["record"] = record;
    let [file, saved] = ["scene.json", "result.json"].map(|name| desk.path().join(name));
    fs::write(&file, scene.to_string()).unwrap();
    let asked = ["limit", file.to_str().unwrap(), "--moving", "--law", "associative", "--save"];
    let asked: Vec<&str> = asked.into_iter().chain([saved.to_str().unwrap()]).collect();
    let page = report(&asked, &desk.path().join("page.html"));
    (page, serde_json::from_str(&fs::read_to_string(saved).unwrap()).unwrap())
}

/// Nothing on the first page was made up: project and people, source, numbers come from the scene and
/// from the answer.
#[test]
fn every_number_of_the_first_page_is_in_the_result() {
    let people = json!({
        "project": "Prestwood 1986", "author": "A. Mason", "checker": "C. Check", "revision": "B",
        "date": "2026-11-30"
    });
    let (page, result) = bridge(people.clone());
    let head = page.split("<header>").nth(1).unwrap().split("</header>").next().unwrap();
    let first = text(head) + &text(cover(&page));
    for said in people.as_object().unwrap().values() {
        assert!(first.contains(said.as_str().unwrap()), "{said}");
    }
    let source = result["scene"]["source"].as_str().unwrap();
    assert!(!source.is_empty() && first.contains(source), "{first}");
    for words in
        ["requirement", "at least 1.25: met", "μ = 0.6", "compression 5 MPa", "Not in the model"]
    {
        assert!(first.contains(words), "{words}: {first}");
    }
    let mut known = Vec::new();
    all_numbers(&result, &mut known);
    let said = numbers(&first);
    assert!(said.len() > 20);
    for (number, digits) in said {
        // Rounded to the digits that are shown, up or down, in units with a prefix.
        let near =
            |v: f64| (v - number).abs() <= 10f64.powi(-(digits as i32)).min(1e-3 * v.abs() + 1e-12);
        assert!(
            known.iter().any(|v| [1.0, 1e-3, 1e-6].iter().any(|by| near(v * by))),
            "{number} is not in the result: {first}"
        );
    }
}

/// What the model leaves out is said in the words of the guide.
#[test]
fn the_limits_are_those_of_the_guide() {
    let (page, _) = bridge(json!({}));
    let guide =
        fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/guide/limits.md")).unwrap();
    let list = cover(&page).split("<ul>").nth(1).unwrap().split("</ul>").next().unwrap();
    let lines: Vec<&str> =
        list.split("<li>").skip(1).map(|l| l.trim_end_matches("</li>")).collect();
    assert!(lines.len() >= 6 && list.contains("Spandrel walls and skew are not modelled"));
    for part in lines.iter().flat_map(|line| line.split(": ")) {
        assert!(guide.contains(part), "{part}");
    }
}

/// Without the key there are blank lines to fill in and to sign.
#[test]
fn a_record_without_names_has_blanks() {
    let page = page("assess", &pressed());
    let cover = cover(&page);
    for name in ["project", "revision", "date", "author", "checker"] {
        assert!(cover.contains(&format!("<dt>{name}</dt><dd></dd>")), "{name}");
    }
    assert!(cover.contains("<dt>structure</dt><dd>Pressed</dd>"));
    assert!(cover.contains("not given in the scene"));
    for role in ["author", "checker"] {
        let row = format!("<th scope=\"row\">{role}</th><td></td><td></td><td></td>");
        assert!(cover.contains(&row), "{role}");
    }
}

/// The wheels on the drawing stand where the axles of the answer do, on the road, which is as long on
/// either side of the middle of the bridge.
#[test]
fn wheels_stand_at_the_governing_position() {
    let (page, result) = bridge(json!({}));
    let axles: Vec<f64> = result["answer"]["moving"]["axles"]
        .as_array()
        .unwrap_or_else(|| panic!("{}", result["answer"]))
        .iter()
        .map(|a| a["x"].as_f64().unwrap())
        .collect();
    let drawn = cover(&page);
    let attribute = |of: &str, name: &str| -> f64 {
        let value = of.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap();
        value.parse().unwrap()
    };
    let wheels: Vec<[f64; 3]> = drawn
        .split("<circle class=\"wheel\"")
        .skip(1)
        .filter(|c| {
            c.starts_with(|_| true) && c.split("</circle>").next().unwrap().contains("<title>axle")
        })
        .map(|c| ["cx", "cy", "r"].map(|name| attribute(c, name)))
        .collect();
    // In both panels.
    assert!(axles.len() == 2 && wheels.len() == 4, "{axles:?} {wheels:?}");
    let road = drawn.split("<path class=\"road\" d=\"M").nth(1).unwrap().split('"').next().unwrap();
    let ends: Vec<f64> = road.split(['L', ' ']).map(|v| v.parse().unwrap()).collect();
    let [middle, scale] =
        [0.5 * (ends[0] + ends[2]), (wheels[1][0] - wheels[0][0]) / (axles[1] - axles[0])];
    assert!(scale > 10.0, "{scale}");
    for (x, [cx, cy, r]) in axles.iter().zip(&wheels) {
        assert!((cx - middle - scale * x).abs() < 0.05, "{x}: {cx}, {middle}, {scale}");
        assert!((cy + r - ends[1]).abs() < 0.06, "not on the road");
    }
}

/// Soil is a line and a table of its own, not one arrow a chord; arrows stay inside the drawing.
#[test]
fn soil_is_a_band() {
    let (page, result) = bridge(json!({}));
    let soil = result["answer"]["counts"]["members"].as_u64().unwrap() as usize;
    assert!(page.contains(&format!("{soil} soil members: ")));
    assert_eq!(table(&page, "soil").len(), soil);
    let drawn = cover(&page);
    assert!(drawn.contains("class=\"fill\"") && !drawn.contains("class=\"push\""));
    assert_eq!(table(&page, "reaction of").len(), 2);
    assert!(table(&page, "position, m").len() > 60);
}
