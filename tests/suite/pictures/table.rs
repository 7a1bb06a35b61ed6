//! Tables read back.

use super::{arch, limited};
use std::collections::HashMap;
use voussoir::{analysis::limit, report::table};

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
    let lambda = limit(&m, &super::control()).value;
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
