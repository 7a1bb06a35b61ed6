//! COMPAS JSON: envelopes, layouts, interfaces.

use super::*;
use serde_json::{Value, json};

/// The envelope of COMPAS 2, 1 or 0.
fn envelope(version: usize, data: Value) -> Value {
    match version {
        2 => json!({"dtype": "a/B", "data": data, "guid": "1"}),
        1 => json!({"dtype": "a/B", "value": data}),
        _ => json!({"compas": "0.19.3", "datatype": "a/B", "data": data}),
    }
}

fn interface(version: usize, points: &[[f64; 3]], xaxis: [f64; 3], yaxis: [f64; 3]) -> Value {
    let points: Vec<Value> = points.iter().map(|p| envelope(version, json!(p))).collect();
    let frame = envelope(version, json!({"point": [0, 0, 3], "xaxis": xaxis, "yaxis": yaxis}));
    envelope(
        version,
        json!({"points": points, "frame": frame, "forces": [{"c_np": 1.0}], "size": 2.0}),
    )
}

const SEAM: [[f64; 3]; 4] = [[0.0, 0.0, 3.0], [0.0, 2.0, 3.0], [1.0, 2.0, 3.0], [1.0, 0.0, 3.0]];
const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// Two boxes on top of each other; node 10 is the lower one, given after node 9.
fn assembly(version: usize, edges: Value) -> Value {
    let block = |z: f64| envelope(version, compas_mesh([0.0, 0.0, z]));
    let graph = json!({
        "default_node_attributes": {"is_support": false},
        "node": {"10": {"block": block(0.0), "is_support": true}, "9": {"block": block(3.0)}},
        "edge": edges
    });
    envelope(
        version,
        json!({"attributes": {"name": "Assembly"}, "graph": envelope(version, graph)}),
    )
}

#[test]
fn assemblies_of_all_versions_are_the_same_scene() {
    let read = |version| {
        let edges =
            json!({"10": {"9": {"interfaces": [interface(version, &SEAM, X, Y)]}}, "9": {}});
        good("pair.json", assembly(version, edges).to_string())
    };
    let newest = read(2);
    assert_eq!(ids(&newest), ["9", "10"], "keys are sorted as numbers");
    assert_eq!(supports(&newest), ["10"]);
    assert!(newest.scene.blocks.iter().all(|b| volume(b) == 6.0));
    let [seam] = &newest.scene.interfaces[..] else { panic!("{:?}", newest.scene.interfaces) };
    assert_eq!(seam.between, ["10", "9"]);
    assert_eq!(seam.points, SEAM);
    assert_eq!(
        seam.normal,
        Some([0.0, 0.0, 1.0]),
        "xaxis × yaxis, from the first block into the second"
    );
    finding(
        &newest,
        FindingCode::Converted,
        &["detected contacts: 1;", "forces, which were left out: 1"],
    );
    assert_eq!(read(1).scene, newest.scene);
    assert_eq!(read(0).scene, newest.scene);
}

#[test]
fn the_key_interface_and_the_oldest_layout_are_read() {
    let one = assembly(2, json!({"10": {"9": {"interface": interface(2, &SEAM, X, Y)}}}));
    let oldest = json!({
        "assembly": {
            "dva": {"is_support": false},
            "vertex": {"9": {"x": 0}, "10": {"is_support": true}},
            "edge": {"10": {"9": {"interface_points": SEAM, "interface_uvw": [X, Y, [0, 0, 1]]}}}
        },
        "blocks": {"9": compas_mesh([0.0, 0.0, 3.0]), "10": compas_mesh([0.0; 3])}
    });
    let (one, oldest) = (good("a.json", one.to_string()), good("a.json", oldest.to_string()));
    assert_eq!(one.scene, oldest.scene);
    assert_eq!((one.scene.interfaces.len(), supports(&one)), (1, vec!["10"]));
}

#[test]
fn keys_that_are_no_numbers_keep_their_order() {
    let graph = json!({"node": {"b": {"block": compas_mesh([0.0; 3])}, "a": {"block": compas_mesh([0.0; 3])}, "c": {}}, "edge": {}});
    let imported = good("x.json", json!({"graph": graph}).to_string());
    assert_eq!(ids(&imported), ["b", "a"]);
    finding(&imported, FindingCode::LeftOut, &["nodes without a block, left out: 1 (c)"]);
}

#[test]
fn missing_coordinates_and_flags_come_from_the_defaults() {
    for (vertices, nodes) in
        [("default_vertex_attributes", "default_node_attributes"), ("dva", "dna")]
    {
        let block = json!({
            vertices: {"x": 0.0, "y": 0.0, "z": 5.0},
            "vertex": {"0": {}, "1": {"x": 1}, "2": {"y": 1}, "3": {"z": 6}},
            "face": [[0, 2, 1], [0, 1, 3], ["1", "2", "3"], [2, 0, 3]]
        });
        let graph = json!({nodes: {"is_support": true}, "node": {"0": {"block": block}, "1": {"block": block, "is_support": false}}});
        let imported = good("x.json", json!({"graph": graph}).to_string());
        assert_eq!(
            mesh(&imported.scene.blocks[0]).0,
            [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0], [0.0, 0.0, 6.0]]
        );
        assert!((volume(&imported.scene.blocks[0]) - 1.0 / 6.0).abs() < 1e-15);
        assert_eq!(supports(&imported), ["0"]);
    }
}

#[test]
fn nested_lists_of_meshes_are_numbered() {
    let mesh = |z: f64| envelope(0, compas_mesh([0.0, 0.0, z]));
    let polyhedron = json!({"dtype": "compas.geometry/Polyhedron", "data": {"vertices": corners([0.0; 3]), "faces": FACES}});
    let imported =
        good("x.json", json!([[mesh(0.0)], [[mesh(3.0)], polyhedron], null]).to_string());
    assert_eq!(ids(&imported), ["0", "1", "2"]);
    assert!(imported.scene.blocks.iter().all(|b| volume(b) == 6.0));
    finding(&imported, FindingCode::LeftOut, &["[2]", "null"]);
}

/// A model of two blocks: the lower moved into place by its own transformation, the upper by that
/// of its group.
fn model() -> Value {
    let moved = |z: f64| json!({"dtype": "T", "data": {"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]]}});
    let block = |transformation: Value, support: bool| {
        json!({"dtype": "Block", "data": {"geometry": envelope(2, compas_mesh([0.0; 3])), "transformation": transformation,
               "is_support": support, "material": "m1"}})
    };
    envelope(
        2,
        json!({
            "transformation": null,
            "elements": {
                "gg": {"dtype": "Group", "data": {"transformation": moved(2.0), "name": "Group"}},
                "g0": block(moved(-1.0), true),
                "g1": block(Value::Null, false)
            },
            "materials": {"m1": {"dtype": "Stone", "data": {"name": "Stone", "density": 2000}}},
            "tree": {"root": {"name": "root", "children": [
                {"element": "gg", "name": "a", "children": [{"element": "g1", "name": "b"}]}, {"element": "g0", "name": "c"}]}},
            "graph": {"node": {"7": {"element": "g1"}, "5": {"element": "g0"}, "6": {"element": "gg"}},
                      "edge": {"5": {"7": {"contacts": [interface(2, &SEAM.map(|[x, y, _]| [x, y, 2.0]), X, Y)]}}}}
        }),
    )
}

#[test]
fn a_block_model_has_its_places_contacts_and_materials() {
    let imported = good("model.json", model().to_string());
    assert_eq!(ids(&imported), ["5", "7"]);
    assert_eq!(supports(&imported), ["5"]);
    let lowest = |i: usize| {
        mesh(&imported.scene.blocks[i]).0.iter().map(|p| p[2]).fold(f64::INFINITY, f64::min)
    };
    assert_eq!((lowest(0), lowest(1)), (-1.0, 2.0));
    assert_eq!(imported.scene.interfaces[0].between, ["5", "7"]);
    assert_eq!(imported.scene.materials["Stone"].density, 2000.0);
    assert!(imported.scene.blocks.iter().all(|b| b.material.as_deref() == Some("Stone")));
    finding(&imported, FindingCode::LeftOut, &["elements without geometry, left out: 1 (6)"]);
}

#[test]
fn elements_may_be_a_list() {
    let mut list = model();
    let elements = list["data"]["elements"].as_object().expect("a map").clone();
    list["data"]["elements"] = elements
        .into_iter()
        .map(|(guid, mut element)| {
            element["guid"] = guid.into();
            element
        })
        .collect();
    assert_eq!(
        good("model.json", list.to_string()).scene,
        good("model.json", model().to_string()).scene
    );
}

#[test]
fn stored_interfaces_that_make_no_sense_are_left_out_or_mended_and_counted() {
    let line = [[0.0, 0.0, 3.0], [0.5, 0.0, 3.0], [1.0, 0.0, 3.0]];
    let bare = json!({"points": SEAM.map(|[x, y, _]| [x, y, 2.5])});
    let edges = json!({
        "10": {"9": {"interfaces": [interface(2, &SEAM, X, Y), interface(2, &line, X, Y), interface(2, &SEAM.map(|[x, y, _]| [x, y, 2.0]), X, [0.0, 0.0, 1.0]), bare,
                                    {"points": []}, {"points": [[0, 0, 3]]}, interface(2, &line[..2], X, Y)]}},
        "9": {"10": {"interfaces": [interface(2, &[SEAM[3], SEAM[0], SEAM[1], SEAM[2]], Y, X)]}}
    });
    let imported = good("x.json", assembly(2, edges).to_string());
    finding(
        &imported,
        FindingCode::LeftOut,
        &["without a definite plane", "left out: 3 ", "(3 corners)", "(0 corners)", "(1 corners)"],
    );
    finding(&imported, FindingCode::Mended, &["given the polygon's normal: 1 ", "90.0°"]);
    finding(&imported, FindingCode::LeftOut, &["in the file twice, used once: 1 "]);
    // Node 9 comes first, so its copy of the seam is the one that stays; then the skew one, the
    // bare one and the edge of two points.
    let kept: Vec<_> = imported
        .scene
        .interfaces
        .iter()
        .map(|i| (i.between[0].as_str(), i.points.len(), i.normal))
        .collect();
    assert_eq!(
        kept,
        [
            ("9", 4, Some([0.0, 0.0, -1.0])),
            ("10", 4, None),
            ("10", 4, None),
            ("10", 2, Some([0.0, 0.0, 1.0]))
        ]
    );
}

#[test]
fn a_normal_against_the_centres_is_kept_and_said() {
    let edges = json!({"10": {"9": {"interfaces": [interface(2, &SEAM, Y, X)]}}});
    let imported = good("x.json", assembly(2, edges).to_string());
    assert_eq!(imported.scene.interfaces[0].normal, Some([0.0, 0.0, -1.0]));
    finding(&imported, FindingCode::Converted, &["from the second block's centre"]);
}

#[test]
fn stored_interfaces_between_two_supports_are_left_out_with_their_number() {
    let edges = json!({"10": {"9": {"interfaces": [interface(2, &SEAM, Y, X)]}}});
    let text = assembly(2, edges).to_string();
    let held = |ids: &[&str]| {
        let options = ImportOptions {
            supports: ids.iter().map(|id| id.to_string()).collect(),
            ..ImportOptions::default()
        };
        import_bytes("x.json", text.as_bytes(), &options).expect("fine")
    };
    let one = held(&["10"]);
    assert_eq!(one.scene.interfaces.len(), 1);
    finding(&one, FindingCode::Converted, &["kept in place of detected contacts: 1"]);
    let both = held(&["9", "10"]);
    assert!(both.scene.interfaces.is_empty());
    finding(&both, FindingCode::LeftOut, &["between two supports, left out: 1 (\"10\"–\"9\")"]);
    assert!(both.findings.iter().all(|f| !f.text.contains("kept in place")), "{:?}", both.findings);
    // Nor with a third block on top, of which something can be asked; the stored interface alone
    // would be in its way.
    let mut three: Value = serde_json::from_str(&text).expect("JSON");
    three["data"]["graph"]["data"]["node"]["11"] =
        json!({"block": envelope(2, compas_mesh([0.0, 0.0, 6.0]))});
    let options = ImportOptions {
        supports: vec!["9".into()],
        friction: Some(crate::Friction::Coefficient(0.6)),
        density: Some(2000.0),
        ..ImportOptions::default()
    };
    let scene = import_bytes("x.json", three.to_string().as_bytes(), &options).expect("fine").scene;
    assert_eq!(scene.blocks.len(), 3);
    assert!(scene.interfaces.is_empty());
}

#[test]
fn what_became_of_the_stored_interfaces_is_counted_once() {
    let mut solved = interface(2, &SEAM, Y, X);
    solved["data"]["forces"] = json!([{"c_np": 1.0}]);
    let text = assembly(2, json!({"10": {"9": {"interfaces": [solved]}}})).to_string();
    let said = |stored_interfaces: bool| {
        let imported = import_bytes(
            "x.json",
            text.as_bytes(),
            &ImportOptions { stored_interfaces, ..ImportOptions::default() },
        )
        .expect("fine");
        imported
            .findings
            .into_iter()
            .map(|f| f.text)
            .filter(|t| t.starts_with("stored interfaces, "))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        said(false),
        ["stored interfaces, left out as asked (contacts are detected instead): 1"]
    );
    assert_eq!(
        said(true),
        [
            "stored interfaces, kept in place of detected contacts: 1; with solved forces, which were left out: 1"
        ]
    );
}

#[test]
fn older_block_models_keep_their_meshes_under_shape() {
    let mut old = model();
    for element in old["data"]["elements"].as_object_mut().expect("a map").values_mut() {
        let data = element["data"].as_object_mut().expect("an element");
        if let Some(mesh) = data.remove("geometry") {
            data.insert("shape".into(), mesh);
        }
    }
    assert_eq!(
        good("model.json", old.to_string()).scene,
        good("model.json", model().to_string()).scene
    );
    let list = json!([{"dtype": "Block", "data": {"shape": envelope(2, compas_mesh([0.0; 3])), "is_support": true}}]);
    assert_eq!(supports(&good("x.json", list.to_string())), ["0"]);
}
