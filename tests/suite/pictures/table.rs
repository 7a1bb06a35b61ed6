//! Tables read back.

use super::{arch, limited};
use crate::ask::{cuboid, ground, push, scene};
use serde_json::json;
use std::collections::HashMap;
use voussoir::{
    analysis::limit,
    proof::saved,
    report::{
        table,
        text::{Asked, Layout, TextOptions, render},
    },
};

type Row = HashMap<String, String>;

fn rows(text: &str) -> Vec<Row> {
    csv::Reader::from_reader(text.as_bytes()).deserialize().map(|r| r.unwrap()).collect()
}

fn number(row: &Row, key: &str) -> f64 {
    row[key].parse().unwrap_or_else(|_| panic!("{key}: {}", row[key]))
}

#[test]
fn forces_in_the_table_balance_every_block() {
    let (m, view) = limited(&arch(0.15, 1.0, serde_json::json!({})));
    let lambda = limit(&m, &super::control()).value.unwrap();
    let (joints, blocks) =
        (rows(&table::joints(&view).unwrap()), rows(&table::blocks(&view).unwrap()));
    assert_eq!((joints.len(), blocks.len()), (m.interfaces.list.len(), m.assembly.blocks.len()));
    for block in blocks.iter().filter(|b| b["support"] == "false") {
        let id = &block["block"];
        let sum = |key: &str| -> f64 {
            let sign = |row: &Row| {
                f64::from(u8::from(row["b"] == *id)) - f64::from(u8::from(row["a"] == *id))
            };
            joints.iter().map(|row| sign(row) * number(row, key)).sum()
        };
        let weight = number(block, "mass");
        assert!(
            (sum("fz") - weight).abs() < 1e-8 * weight
                && (sum("fx") + lambda * weight).abs() < 1e-8 * weight,
            "{id}"
        );
    }
    // Four hinges and nothing else, each where the section is used up.
    let hinges: Vec<&Row> = joints.iter().filter(|j| j["motion"] == "hinge").collect();
    assert!(
        hinges.len() == 4 && hinges.iter().all(|h| number(h, "section_used") > 1.0 - 1e-5),
        "{hinges:?}"
    );
    assert!(
        joints.iter().all(|j| number(j, "friction_used") <= 1.0 && number(j, "friction") == 0.8)
    );
    let fastest = blocks
        .iter()
        .map(|b| ["vx", "vy", "vz"].map(|k| number(b, k).powi(2)).iter().sum::<f64>().sqrt())
        .fold(0.0, f64::max);
    assert!(fastest > 0.5 && fastest <= 1.0, "{fastest}");
}

/// What is text is quoted and what is a number is not, so that a reader can tell a block named 007
/// from a number.
#[test]
fn ids_stay_text() {
    let ids = ["007", "1e5", "=A1", "+3", "a,b", "\"q\""];
    let mut blocks = vec![ground()];
    blocks.extend(
        ids.iter()
            .enumerate()
            .map(|(k, id)| cuboid(id, [1.0, 1.0, 0.2], [0.0, 0.0, 0.2 * k as f64])),
    );
    let (_, view) = limited(&scene(0.5, json!(blocks), push([1.0, 0.0, 0.0])));
    let (joints, list) = (table::joints(&view).unwrap(), table::blocks(&view).unwrap());
    // Read back, they are what they were; what a spreadsheet would compute has its apostrophe.
    let read: Vec<String> = rows(&list).iter().map(|r| r["block"].clone()).collect();
    assert_eq!(read, ["ground", "007", "1e5", "'=A1", "+3", "a,b", "\"q\""]);
    for text in [&joints, &list] {
        for quoted in ["\"007\"", "\"1e5\"", "\"'=A1\"", "\"+3\"", "\"a,b\""] {
            assert!(text.contains(quoted), "{quoted}: {text}");
        }
        for cell in text.lines().skip(1).flat_map(|l| l.split(',')).filter(|c| !c.contains('"')) {
            let plain = cell.is_empty() || cell.parse::<f64>().is_ok();
            assert!(plain || ids.iter().any(|id| id.contains(cell)), "{cell}: {text}");
        }
    }
}

/// A pier that crushes at its edge turns about a line inside the joint: N / (σ b) from the edge.
#[test]
fn text_and_table_agree_on_where_a_crushing_hinge_is() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/pier-that-crushes.json");
    let (scene, _) = voussoir::scene::read_file(path.as_ref()).unwrap();
    let m = voussoir::interface::prepare(&scene).unwrap();
    let result = saved::load_factor(&scene, &m, &limit(&m, &super::control()).into()).unwrap();
    let view = voussoir::report::view::View::new(&m, &result, Vec::new()).unwrap();
    let row = rows(&table::joints(&view).unwrap()).remove(0);
    assert_eq!(row["motion"], "crush");
    let at = ["motion_x", "motion_y", "motion_z"].map(|k| number(&row, k));
    let depth = 2400.0 * 1.5 * 9.81 / 1e6;
    assert!((at[0].abs() - (0.25 - depth)).abs() < 1e-3 * depth, "{at:?}");
    assert!(at[1].abs() < 1e-6 && at[2].abs() < 1e-9, "{at:?}");
    // The pressure on the crushed strip has its middle halfway.
    assert!((number(&row, "x").abs() - (0.25 - 0.5 * depth)).abs() < 1e-2 * depth, "{row:?}");
    let asked = Asked { scene: "SCENE", options: "", ..Default::default() };
    let options = TextOptions { verbose: true, brief: false };
    let text = render(&result, asked, options, Layout::default()).to_string();
    assert!(text.contains(&format!("at {}", voussoir::number::point(at))), "{at:?}: {text}");
}
