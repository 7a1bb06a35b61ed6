//! Bad input: an error with place and remedy, never a panic.

use super::*;
use proptest::prelude::*;
use serde_json::json;

/// The error, which has to name the file and a remedy.
fn error(name: &str, bytes: impl AsRef<[u8]>) -> String {
    let text = import(name, bytes).expect_err("has to be refused").to_string();
    assert!(text.starts_with(&format!("{name}:")) && text.contains("; hint: "), "{text}");
    text
}

#[test]
fn obj_errors_name_the_line() {
    let good = format!("o b\n{}", obj_box([0.0; 3], |i| i.to_string()));
    for (old, new, expected) in [
        ("v 1 0 0", "v 1 0", "x.obj:3:1: coordinate z is missing"),
        ("v 1 0 0", "v 1 nan 0", "x.obj:3:1: coordinate y: expected a finite number, got \"nan\""),
        (
            "v 1 0 0",
            "v 1 0 1e999",
            "x.obj:3:1: coordinate z: expected a finite number, got \"1e999\"",
        ),
        ("v 1 0 0", "v 1,5 0 0", "x.obj:3:1: coordinate x: expected a finite number, got \"1,5\""),
        ("f 1 4 3 2", "f 1 4 3 9", "x.obj:10:1: corner 9 does not exist: the file has 8 corners"),
        ("f 1 4 3 2", "f 1 4 3 0", "x.obj:10:1: face corner \"0\": there is no corner 0"),
        ("f 1 4 3 2", "f 1 4 3 -9", "x.obj:10:1: face corner \"-9\": does not exist"),
        ("f 1 4 3 2", "f 1 4 3 99999999999999999999", "x.obj:10:1: face corner"),
        ("f 1 4 3 2", "f 1 4 3 -9223372036854775808", "x.obj:10:1: face corner"),
        ("f 1 4 3 2", "f 1 4 x 2", "x.obj:10:1: face corner \"x\": expected an index"),
        ("f 1 4 3 2", "f 1 4", "x.obj:10:1: a face with 2 corners"),
        ("f 1 4 3 2", "f 1 4\0", "x.obj:10:1: a zero byte"),
    ] {
        let text = error("x.obj", good.replacen(old, new, 1));
        assert!(text.starts_with(expected), "{text}\nexpected {expected}");
    }
    assert!(error("x.obj", "v 0 0 0\n").contains("without faces (1 corners)"));
    let soup = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    assert!(error("x.obj", soup).contains("x.obj:4:1: the file names no objects"));
}

#[test]
fn ply_errors_name_the_line_or_the_element() {
    let good = ply_box();
    for (old, new, expected) in [
        ("\n1 0 0\n", "\n1 nan 0\n", "x.ply:11:1: "),
        (
            "\n1 0 0\n",
            "\n1 1e999 0\n",
            "x.ply:11:1: coordinate y: expected a finite number, got inf",
        ),
        ("4 0 3 2 1", "4 0 3 2 8", "x.ply:18:1: corner 8 does not exist: the file has 8 corners"),
        ("4 0 3 2 1", "4 0 3 2 -1", "x.ply:18:1: corner -1 does not exist"),
        ("4 0 3 2 1", "2 0 3", "x.ply:18:1: a face with 2 corners"),
        ("4 0 3 2 1", "9 0 3 2 1", "x.ply:18:1: "),
        ("element vertex 8", "element vertex 18446744073709551615", "x.ply:"),
        ("element vertex 8", "element vertex 99999999999999999999999", "x.ply:"),
        ("element face 6", "element face 7", "x.ply:24:1: Unexpected end of file"),
        ("element face 6", "element face 0", "x.ply: PLY header: no faces"),
        ("property double z\n", "", "x.ply: PLY header: no element \"vertex\" with x, y and z"),
        ("vertex_indices", "strips", "x.ply: PLY header: no faces"),
        ("list uchar int", "list uchar float", "x.ply:18:1: "),
        (
            "end_header",
            "element nothing 18446744073709551615\nend_header",
            "x.ply: PLY header: element \"nothing\" has no properties",
        ),
        ("ply\n", "plz\n", "x.ply:1:1: "),
    ] {
        let text = error("x.ply", good.replacen(old, new, 1));
        assert!(text.starts_with(expected), "{text}\nexpected {expected}");
        assert!(text.len() < 400 && !text.contains('\n'), "{text}");
    }
    let mut binary = ply_box_binary(true);
    let length = binary.len();
    binary[length - 4..].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(
        error("x.ply", &binary).starts_with("x.ply: face[5]: corner 4294967295 does not exist")
    );
    assert!(error("x.ply", &binary[..length - 1]).contains("end of file"));
}

#[test]
fn stl_errors_name_the_line_or_the_triangle() {
    let good = stl_ascii("a");
    for (old, new, expected) in [
        ("vertex 0 0 0\n", "vertex 0 0\n", "x.stl:4:1: coordinate z is missing"),
        ("vertex 0 0 0\n", "vertex 0 inf 0\n", "x.stl:4:1: coordinate y"),
        ("vertex 0 0 0\n", "", "x.stl:7:1: a facet with 2 corners"),
        ("outer loop\n", "", "x.stl:3:1: unexpected here: \"vertex 0 0 0\""),
        ("endsolid a\n", "", "x.stl:85:1: the file ends inside a solid"),
        ("solid a\n", "solid a\nsolid b\n", "x.stl:2:1: unexpected here"),
    ] {
        let text = error("x.stl", good.replacen(old, new, 1));
        assert!(text.starts_with(expected), "{text}\nexpected {expected}");
    }
    let binary = stl_binary("box");
    assert!(
        error("x.stl", &binary[..600])
            .contains("the header announces 12 triangles (684 bytes), the file has 600 bytes")
    );
    let mut huge = binary.clone();
    huge[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(error("x.stl", &huge).contains("4294967295 triangles"));
    let mut nan = binary.clone();
    nan[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(
        error("x.stl", &nan)
            .contains("triangle 1 (byte 134): expected finite coordinates, got NaN")
    );
    assert!(error("x.stl", "").contains("no triangles"));
    assert!(error("x.stl", "solid a\nendsolid a\n").contains("no blocks found"));
    let mut longer = binary;
    longer.extend([1, 2, 3]);
    finding(
        &good_bytes(&longer),
        FindingCode::LeftOut,
        &["bytes after the last triangle, left out: 3"],
    );
}

fn good_bytes(bytes: &[u8]) -> Imported {
    good("x.stl", bytes)
}

#[test]
fn json_errors_name_the_line_or_the_path() {
    let good = json!({"dtype": "A", "data": {"graph": {"node": {"0": {"block": compas_mesh([0.0; 3])}, "1": {"block": compas_mesh([0.0; 3])}},
        "edge": {"0": {"1": {"interfaces": [{"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}}}}}});
    type Change = fn(&mut serde_json::Value);
    let changes: [(Change, &str); 12] = [
        (
            |v| v["node"]["1"]["block"]["vertex"]["18"]["x"] = json!("?"),
            "data.graph.node.1.block.vertex.18.x: expected a number, got \"?\"",
        ),
        (
            |v| v["node"]["1"]["block"]["vertex"]["18"]["x"] = json!([1]),
            "data.graph.node.1.block.vertex.18.x: expected a number, got a list",
        ),
        (
            |v| v["node"]["1"]["block"]["vertex"]["18"] = json!([1, 2]),
            "data.graph.node.1.block.vertex.18: expected three coordinates",
        ),
        (
            |v| v["node"]["1"]["block"]["vertex"] = json!({}),
            "data.graph.node.1.block.face.0[0]: the mesh has no vertex 20",
        ),
        (
            |v| v["node"]["1"]["block"]["vertex"] = json!(7),
            "data.graph.node.1.block.vertex: expected an object, got 7",
        ),
        (
            |v| v["node"]["1"]["block"]["face"]["0"] = json!([20, 18]),
            "data.graph.node.1.block.face.0: expected three corners or more",
        ),
        (
            |v| v["node"]["1"]["block"]["face"]["0"] = json!([20, 18, 5]),
            "data.graph.node.1.block.face.0[2]: the mesh has no vertex 5",
        ),
        (
            |v| v["node"]["1"]["is_support"] = json!("yes"),
            "data.graph.node.1.is_support: expected true or false, got \"yes\"",
        ),
        (
            |v| v["node"]["1"]["block"] = json!({"xsize": 1}),
            "data.graph.node.1.block: expected a mesh",
        ),
        (
            |v| v["edge"]["0"]["5"] = v["edge"]["0"]["1"].clone(),
            "data.graph.edge.0.5: an interface with node \"5\", which has no block",
        ),
        (
            |v| v["edge"]["0"]["0"] = v["edge"]["0"]["1"].clone(),
            "data.graph.edge.0.0: an interface of block \"0\" with itself",
        ),
        (
            |v| v["edge"]["0"]["1"]["interfaces"][0]["points"] = json!("?"),
            "data.graph.edge.0.1.interfaces[0].points: expected a list",
        ),
    ];
    for (change, expected) in changes {
        let mut bad = good.clone();
        change(&mut bad["data"]["graph"]);
        let text = error("x.json", bad.to_string());
        assert!(text.starts_with(&format!("x.json: {expected}")), "{text}\nexpected {expected}");
    }
    assert!(error("x.json", "{\n \"a\": [1,\n").starts_with("x.json:3:0:"));
    assert!(error("x.json", "[\n  NaN]").starts_with("x.json:2:3:"));
    assert!(error("x.json", "[1e999]").contains("number out of range"));
    assert!(error("x.json", "[".repeat(100_000)).contains("recursion limit"));
    assert!(error("x.json", "[]").contains("no blocks found in this COMPAS JSON file"));
    assert!(error("x.json", "{\"a\": 1}").contains("expected a mesh with \"vertex\" and \"face\""));
    assert!(
        error("x.json", "{\"format\": \"voussoir-scene/1\", \"blocks\": []}")
            .contains("use it as it is")
    );
    let skew = json!({"elements": {"a": {"geometry": compas_mesh([0.0; 3]), "transformation": {"matrix": [[1, 0], [0, 1]]}}}});
    assert!(
        error("x.json", skew.to_string())
            .starts_with("x.json: elements.a.transformation.matrix: expected a transformation")
    );
}

#[test]
fn files_that_are_not_there_or_of_no_format_are_said() {
    let text = import_file(Path::new("no/such.obj"), &ImportOptions::default())
        .expect_err("not there")
        .to_string();
    assert!(text.starts_with("no/such.obj: cannot be read") && text.contains("hint:"), "{text}");
    assert!(
        error("notes.txt", "hello\n").contains("unknown from both the extension and the content")
    );
}

/// A good file of every format.
fn samples() -> Vec<(&'static str, Vec<u8>)> {
    let seam = json!({"points": [[0, 0, 3], [1, 0, 3], [1, 2, 3]], "frame": {"xaxis": [1, 0, 0], "yaxis": [0, 1, 0]}});
    let node = |z: f64| json!({"block": {"dtype": "B", "data": compas_mesh([0.0, 0.0, z])}});
    let graph = json!({"node": {"0": node(0.0), "1": node(3.0)}, "edge": {"0": {"1": {"interfaces": [seam.clone()]}}}});
    let element = json!({"geometry": compas_mesh([0.0; 3]), "transformation": {"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}});
    let model = json!({"elements": {"a": element, "b": element}, "tree": {"root": {"children": [{"element": "a", "children": [{"element": "b"}]}]}},
        "graph": {"node": {"0": {"element": "a"}, "1": {"element": "b"}}, "edge": {"0": {"1": {"contacts": [seam]}}}}});
    vec![
        ("x.json", json!({"graph": graph}).to_string().into_bytes()),
        ("x.json", model.to_string().into_bytes()),
        ("x.obj", format!("o b\n{}", obj_box([0.0; 3], |i| format!("{i}//{i}"))).into_bytes()),
        ("x.ply", ply_box().into_bytes()),
        ("x.ply", ply_box_binary(true)),
        ("x.ply", ply_box_binary(false)),
        ("x.stl", stl_ascii("a").into_bytes()),
        ("x.stl", stl_binary("a")),
    ]
}

/// Whatever comes in: a scene that holds what scenes promise, or an error with file and remedy.
fn survives(name: &str, bytes: &[u8]) {
    match import(name, bytes) {
        Ok(imported) => check(&imported.scene),
        Err(error) => assert!(
            error.file.is_some() && error.hint.is_some() && error.to_string().len() < 2000,
            "{error}"
        ),
    }
}

proptest! {
    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400), format in 0usize..5) {
        survives(["x.json", "x.obj", "x.ply", "x.stl", "x"][format], &bytes);
    }

    #[test]
    fn random_bytes_after_a_good_beginning_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200), which in 0usize..8, at in 0.0..1.0) {
        let (name, mut sample) = samples().swap_remove(which);
        sample.truncate((at * sample.len() as f64) as usize);
        sample.extend(bytes);
        survives(name, &sample);
    }

    #[test]
    fn damaged_bytes_never_panic(damage in proptest::collection::vec((0.0..1.0, any::<u8>()), 1..6), which in 0usize..8) {
        let (name, mut sample) = samples().swap_remove(which);
        for (at, byte) in damage {
            let i = (at * sample.len() as f64) as usize;
            sample[i] = byte;
        }
        survives(name, &sample);
    }

    #[test]
    fn damaged_words_never_panic(old in "[0-9]|\"[a-z_]+\"|x|face|vertex", new in "-?[0-9]{1,20}|null|\\[\\]|\\{\\}|nan|1e308", which in 0usize..8) {
        let (name, sample) = samples().swap_remove(which);
        if let Ok(text) = String::from_utf8(sample) {
            survives(name, text.replacen(&old, &new, 3).as_bytes());
        }
    }
}

#[test]
fn every_truncation_is_refused_or_is_a_whole_scene() {
    for (name, sample) in samples() {
        survives(name, &sample);
        for length in 0..sample.len() {
            survives(name, &sample[..length]);
        }
    }
}
