//! Models of robots and engines, and glTF: files of other programs (`tests/formats/bodies.py`) against
//! what those programs say of them, and small models with known answers.

use super::*;
use crate::{Friction, import::rigid};
use nalgebra::{Rotation3, Unit, Vector3};
use serde_json::Value;
use std::path::PathBuf;

fn folder(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/formats")).join(name)
}

/// Corners of a block in the scene, or ends of its spheres; volume, m³; centre of its shape.
fn body(block: &BlockSpec) -> (Vec<Vector3<f64>>, f64, Vector3<f64>) {
    let at = Vector3::from(block.at);
    let ball = |r: f64| 4.0 / 3.0 * std::f64::consts::PI * r.powi(3);
    match &block.shape {
        Shape::Polyhedron { vertices, faces } => {
            let (size, centre) = rigid::of_mesh(vertices, faces);
            assert!((size / volume(block) - 1.0).abs() < 1e-9, "{}: faces outward", block.id);
            (vertices.iter().map(|v| Vector3::from(*v)).collect(), size, centre.coords)
        }
        Shape::Sphere { radius } => {
            let ends = [-*radius, *radius].map(|r| at.add_scalar(r));
            (ends.to_vec(), ball(*radius), at)
        }
        Shape::Clump { spheres } => {
            let ends = |s: &crate::Ball| {
                [-s.radius, s.radius].map(|r| (at + Vector3::from(s.at)).add_scalar(r))
            };
            let size: f64 = spheres.iter().map(|s| ball(s.radius)).sum();
            let moment: Vector3<f64> =
                spheres.iter().map(|s| (at + Vector3::from(s.at)) * ball(s.radius)).sum();
            (spheres.iter().flat_map(ends).collect(), size, moment / size)
        }
        other => panic!("{other:?}"),
    }
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_iterator(value.as_array().expect("a list").iter().map(|v| v.as_f64().unwrap()))
}

/// Coefficient of friction of a pair of blocks.
fn friction(scene: &Scene, a: &str, b: &str) -> Friction {
    let material = |id: &str| {
        let block = scene.blocks.iter().find(|block| block.id == id).expect("there");
        block.material.clone().expect("a material")
    };
    let (a, b) = (material(a), material(b));
    let is = |between: &[String; 2]| {
        *between == [a.clone(), b.clone()] || *between == [b.clone(), a.clone()]
    };
    let own = scene.joints.overrides.iter().rev().find(|o| o.between.as_ref().is_some_and(is));
    own.and_then(|o| o.friction).or(scene.joints.default.friction).expect("friction")
}

/// Every file of a folder is read as its program says; every fault has its place.
fn agrees(format: &str) {
    let folder = folder(format);
    let text = std::fs::read_to_string(folder.join("expected.json")).expect("what is expected");
    let all: serde_json::Map<String, Value> = serde_json::from_str(&text).expect("JSON");
    assert!(all.len() >= 6);
    for (name, wanted) in &all {
        let read = import_file(&folder.join(name), &ImportOptions::default());
        let words = |key: &str| wanted[key].as_array().cloned().unwrap_or_default();
        if wanted["error"].is_array() {
            let error = read.expect_err(name);
            let text = error.to_string();
            for word in words("error") {
                assert!(text.contains(word.as_str().unwrap()), "{name}: {text}");
            }
            if let Some(line) = wanted["line"].as_u64() {
                assert_eq!(error.position.map(|p| p.0 as u64), Some(line), "{name}: {text}");
            }
            assert!(error.hint.is_some(), "{name}: {text}");
            continue;
        }
        let imported = read.unwrap_or_else(|e| panic!("{name}: {e}"));
        let said: Vec<&str> = imported.findings.iter().map(|f| f.text.as_str()).collect();
        for word in words("findings") {
            assert!(
                said.iter().any(|s| s.contains(word.as_str().unwrap())),
                "{name}: {word} in {said:#?}"
            );
        }
        if let Some(line) = wanted["line"].as_u64() {
            let place = format!("line {line})");
            let has = said.iter().any(|s| s.contains(&place))
                || imported.origins.iter().any(|o| o.line == Some(line as usize));
            assert!(has, "{name}: {place} in {said:#?}");
        }
        blocks(name, &imported, wanted);
        for pair in words("pairs") {
            let [a, b] = [0, 1].map(|k| pair[k].as_str().unwrap());
            let mu = Friction::Coefficient(pair[2].as_f64().unwrap());
            assert_eq!(friction(&imported.scene, a, b), mu, "{name}: {a} {b}");
        }
        if wanted["gravity"].is_array() {
            assert_eq!(Vector3::from(imported.scene.gravity), vector(&wanted["gravity"]), "{name}");
        }
        if wanted["supports"].is_array() {
            let mut held: Vec<Value> = supports(&imported).into_iter().map(Value::from).collect();
            let mut named = wanted["supports"].as_array().cloned().unwrap_or_default();
            held.sort_by_key(ToString::to_string);
            named.sort_by_key(ToString::to_string);
            assert_eq!(held, named, "{name}");
        }
    }
}

/// Free blocks as they are expected.
fn blocks(name: &str, imported: &Imported, wanted: &Value) {
    let Some(wanted_blocks) = wanted["blocks"].as_object() else { return };
    let scene = &imported.scene;
    let free: Vec<&BlockSpec> = scene.blocks.iter().filter(|b| !b.support).collect();
    assert_eq!(free.len(), wanted_blocks.len(), "{name}: {:?}", ids(imported));
    let is_single = wanted["single"].is_boolean() || name.contains(".gl");
    for block in free {
        let wanted = &wanted_blocks[&block.id];
        let (corners, size, shape_centre) = body(block);
        let low = corners.iter().copied().reduce(|a, b| a.inf(&b)).unwrap();
        let high = corners.iter().copied().reduce(|a, b| a.sup(&b)).unwrap();
        // Cylinders are prisms; the box of a turned one is a little larger.
        let is_round = corners.len() > 60 && !is_single;
        // Parts of one block are drawn together by a millionth.
        let is_joined = match &block.shape {
            Shape::Polyhedron { vertices, faces } => {
                raw::parts(vertices, faces).into_iter().max() > Some(0)
            }
            _ => false,
        };
        let near = (high - low).norm()
            * if is_round {
                3e-5
            } else if is_single || is_joined {
                1e-6
            } else {
                1e-12
            }
            + 1e-12;
        let off =
            (low - vector(&wanted["low"])).amax().max((high - vector(&wanted["high"])).amax());
        assert!(off <= near, "{name} {}: off by {off:e} > {near:e}", block.id);
        if let Some(volume) = wanted["volume"].as_f64() {
            assert!((size / volume - 1.0).abs() < 4e-6, "{name} {}: {size} {volume}", block.id);
        }
        if let Some(mass) = wanted["mass"].as_f64() {
            let material = block.material.as_ref().and_then(|m| scene.materials.get(m));
            let density = block.density.or(material.map(|m| m.density));
            let own = block.mass.unwrap_or_else(|| density.expect("a density") * size);
            let near = if is_single { 1e-6 } else { 1e-12 };
            assert!((own / mass - 1.0).abs() < near, "{name} {}: {own} {mass}", block.id);
        }
        if wanted["centre"].is_array() {
            let own =
                block.centroid.map_or(shape_centre, |c| Vector3::from(c) + Vector3::from(block.at));
            let off = (own - vector(&wanted["centre"])).norm();
            assert!(off <= 10.0 * near, "{name} {}: centre off by {off:e}", block.id);
        }
    }
}

#[test]
fn mjcf_is_read_as_mujoco_reads_it() {
    agrees("mjcf");
}

#[test]
fn urdf_is_read_as_it_was_written() {
    agrees("urdf");
}

#[test]
fn sdf_is_read_as_it_was_written() {
    agrees("sdf");
}

#[test]
fn gltf_of_other_programs_is_read() {
    agrees("gltf");
}

/// A model of MuJoCo with these things in the world.
fn mjcf(world: &str) -> String {
    format!(
        "<mujoco><worldbody><geom name=\"floor\" type=\"plane\" size=\"1 1 1\"/>{world}</worldbody></mujoco>"
    )
}

fn free(name: &str, geoms: &str) -> String {
    format!("<body name=\"{name}\"><freejoint/>{geoms}</body>")
}

fn unit_box(more: &str) -> String {
    format!("<geom type=\"box\" size=\"0.5 0.5 0.5\" {more}/>")
}

fn read(text: &str, options: &ImportOptions) -> Imported {
    import_bytes("model.xml", text.as_bytes(), options).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_root_of_an_xml_file_tells_its_format() {
    let model = mjcf(&free("a", &unit_box("")));
    for head in ["", "\u{feff}", "<?xml version=\"1.0\"?>\n<!-- <robot> -->\n"] {
        let text = format!("{head}{model}");
        for name in ["a.xml", "a.mjcf", "a"] {
            let imported = import(name, &text).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert!(imported.scene.source.contains("MJCF"), "{}", imported.scene.source);
        }
    }
    for root in ["COLLADA", "mujocoinclude"] {
        let error = import("a.xml", format!("<{root}><worldbody/></{root}>")).expect_err(root);
        assert!(error.to_string().contains("format is unknown"), "{error}");
    }
}

#[test]
fn a_density_given_keeps_the_frictions_of_materials() {
    let text = mjcf(
        &(free("a", &unit_box("friction=\"0.2\" density=\"700\""))
            + &free("b", &unit_box("friction=\"0.8\" mass=\"3\""))
            + &free("c", "<geom size=\"1\" friction=\"2\"/>")),
    );
    let options = ImportOptions { density: Some(1234.0), ..ImportOptions::default() };
    let given = read(&text, &options).scene;
    let own = read(&text, &ImportOptions::default()).scene;
    for (a, b, mu) in [
        ("a", "floor", 1.0),
        ("a", "b", 0.8),
        ("b", "b", 0.8),
        ("a", "a", 0.2),
        ("c", "floor", 2.0),
    ] {
        assert_eq!(friction(&own, a, b), Friction::Coefficient(mu), "{a} {b}");
        assert_eq!(friction(&given, a, b), Friction::Coefficient(mu), "{a} {b}");
    }
    for block in &given.blocks {
        assert!(block.density.is_none() && block.mass.is_none());
        assert_eq!(given.materials[block.material.as_ref().unwrap()].density, 1234.0);
    }
    assert!(
        given
            .joints
            .overrides
            .iter()
            .all(|o| { o.between.iter().flatten().all(|name| given.materials.contains_key(name)) })
    );
    // Friction given is that of every joint.
    let mu = Some(Friction::Coefficient(0.5));
    let plain = read(&text, &ImportOptions { friction: mu, ..options }).scene;
    assert!(plain.joints.overrides.is_empty() && plain.joints.default.friction == mu);
}

#[test]
fn shapes_that_touch_nothing_weigh_and_are_left_out() {
    let ghost = "<geom type=\"sphere\" size=\"0.1\" pos=\"0 0 1\" mass=\"2\" contype=\"0\" conaffinity=\"0\"/>";
    let imported =
        read(&mjcf(&free("a", &(unit_box("mass=\"6\"") + ghost))), &ImportOptions::default());
    finding(&imported, FindingCode::LeftOut, &["touch nothing"]);
    let block = imported.scene.blocks.iter().find(|b| b.id == "a").expect("there");
    assert_eq!((block.mass, block.centroid), (Some(8.0), Some([0.0, 0.0, 0.25])));
}

#[test]
fn what_no_block_can_be_is_refused_by_name() {
    let cases = [
        (free("a", &(unit_box("") + "<geom size=\"1\"/>")), "spheres beside other shapes"),
        (free("a", "<geom type=\"plane\" size=\"1 1 1\"/>"), "a plane on a body that moves"),
        (free("a", "<geom type=\"ellipsoid\" size=\"1 1 2\"/>"), "ellipsoid"),
        (free("a", &unit_box("mass=\"0\"")), "no mass"),
        (free("a", &unit_box("density=\"-1\"")), "below zero"),
        (free("a", &unit_box("friction=\"-1\"")), "friction must be >= 0"),
        (free("a", &unit_box("class=\"none\"")), "no default class"),
        (free("a", "<geom type=\"box\" size=\"1 1\"/>"), "a size of 2 numbers"),
        (free("a", "<geom type=\"mesh\" mesh=\"m\"/>"), "no mesh is called \"m\""),
        (free("a", &free("b", &unit_box(""))), "not in the world itself"),
        ("<replicate count=\"3\"/>".into(), "<replicate> is not read"),
        ("<body><joint type=\"ball\"/></body>".into(), "turns or slides (ball)"),
    ];
    for (world, words) in cases {
        let error = import("model.xml", mjcf(&world)).expect_err(words);
        assert!(error.to_string().contains(words) && error.hint.is_some(), "{words}: {error}");
        assert_eq!(error.position.map(|p| p.0), Some(1), "{error}");
    }
}

#[test]
fn deep_files_and_files_with_entities_are_refused() {
    let deep = mjcf(&("<body>".repeat(100_000) + &"</body>".repeat(100_000)));
    let error = import("model.xml", deep).expect_err("deep");
    assert!(error.to_string().contains("deep in each other"), "{error}");
    let open = "<mujoco>".repeat(100_000);
    assert!(import("model.xml", open).is_err());
    // What only looks deep is not.
    let flat = format!(
        "<!-- {0} --><mujoco><worldbody><![CDATA[{0}]]><body name='{1}'/>",
        "<a>".repeat(1000),
        "&lt;".repeat(500)
    );
    let text = format!("{flat}{}</worldbody></mujoco>", free("a", &unit_box("")));
    assert_eq!(ids(&read(&text, &ImportOptions::default())), ["a"]);
    let bomb = "<!DOCTYPE m [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]><mujoco>&b;</mujoco>";
    let error = import("model.xml", bomb).expect_err("entities");
    assert!(error.to_string().contains("DOCTYPE") || error.to_string().contains("DTD"), "{error}");
}

#[test]
fn a_mesh_stays_in_the_folder_of_its_model() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    };
    let model = |file: &str| {
        format!(
            "<mujoco><compiler meshdir=\"m\"/><asset><mesh name=\"s\" file=\"{file}\"/></asset><worldbody>{}</worldbody></mujoco>",
            free("a", "<geom type=\"mesh\" mesh=\"s\"/>")
        )
    };
    write("m/stone.obj", obj_box([0.0; 3], |i| i.to_string()));
    write("stone.obj", obj_box([0.0; 3], |i| i.to_string()));
    let path = write("scene/model.xml", model("../../stone.obj"));
    let error = import_file(&path, &ImportOptions::default()).expect_err("outside");
    assert!(error.to_string().contains("leaves the folder"), "{error}");
    let path = write("model.xml", model("stone.obj"));
    let imported = import_file(&path, &ImportOptions::default()).expect("fine");
    assert!((volume(&imported.scene.blocks[0]) - 6.0).abs() < 1e-12);
    let error = import("model.xml", model("stone.obj")).expect_err("from memory");
    assert!(error.to_string().contains("not at hand"), "{error}");
}

/// Lengths, places and directions turn and grow together.
#[test]
fn models_are_scaled_and_turned_like_all_others() {
    let text = mjcf(&free("a", "<geom size=\"0.5\" pos=\"1 2 3\"/>"));
    let options = ImportOptions { scale: Some(2.0), up: Some(Up::X), ..ImportOptions::default() };
    let scene = read(&text, &options).scene;
    assert_eq!(scene.blocks[0].shape, Shape::Sphere { radius: 1.0 });
    assert_eq!(scene.blocks[0].at, [-6.0, 4.0, 2.0]);
    assert_eq!(scene.gravity, [9.81, 0.0, 0.0]);
    let plane = scene.blocks.iter().find(|b| b.id == "floor").expect("there");
    assert_eq!(plane.shape, Shape::Plane { normal: [-1.0, 0.0, 0.0] });
}

/// Mass and centre of a body do not depend on how it is turned.
#[test]
fn a_cylinder_has_its_exact_mass_wherever_it_lies() {
    for quat in ["1 0 0 0", "0.1 0.2 -0.3 0.4"] {
        let geom =
            format!("<geom type=\"cylinder\" size=\"0.3 0.7\" density=\"1500\" quat=\"{quat}\"/>");
        let imported = read(&mjcf(&free("a", &geom)), &ImportOptions::default());
        let block = &imported.scene.blocks[0];
        let mass = 1500.0 * std::f64::consts::PI * 0.09 * 1.4;
        assert!((block.mass.expect("a mass") / mass - 1.0).abs() < 1e-14);
        assert!((volume(block) * 1500.0 / mass - 1.0).abs() < 2e-4);
        finding(&imported, FindingCode::Converted, &["cylinders", "\"a\" ("]);
    }
}

/// A scene in glTF by hand: its exact shape, drawn in single precision at `drawn`.
fn with_extras(drawn: [f32; 3]) -> String {
    let third = 1.0 / 3.0;
    let exact: Vec<[f64; 3]> = corners([third; 3]).iter().map(|c| Up::MinusY.rotate(*c)).collect();
    let bytes: Vec<u8> = exact
        .iter()
        .flat_map(|c| [0, 1, 2].map(|k| (c[k] as f32 + drawn[k]).to_le_bytes()).concat())
        .collect();
    let faces: Vec<u8> =
        FACES.iter().flat_map(|f| [f[0], f[1], f[2], f[0], f[2], f[3]]).map(|i| i as u8).collect();
    let data = data_encoding::BASE64.encode(&[&bytes[..], &faces[..]].concat());
    serde_json::json!({
        "asset": { "version": "2.0" }, "nodes": [
            { "name": "root", "children": [1], "extras": { "gravity_m_s2": 9.5 } },
            { "name": "a", "mesh": 0, "extras": {
                "support": false, "mass_kg": 3.0, "material": "stone",
                "exact": { "vertices": exact, "faces": FACES, "centroid": [9.0, 9.0, 9.0] } } }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5121, "count": 36, "type": "SCALAR" }],
        "bufferViews": [
            { "buffer": 0, "byteLength": 96 }, { "buffer": 0, "byteOffset": 96, "byteLength": 36 }],
        "buffers": [{ "byteLength": 132, "uri": format!("data:application/octet-stream;base64,{data}") }],
    })
    .to_string()
}

#[test]
fn exact_shapes_are_read_while_they_are_what_is_drawn() {
    let of = |drawn| import("a.gltf", with_extras(drawn)).unwrap_or_else(|e| panic!("{e}"));
    let exact = of([0.0; 3]);
    let (vertices, _) = mesh(&exact.scene.blocks[0]);
    assert_eq!(vertices, corners([1.0 / 3.0; 3]));
    assert_eq!(exact.scene.blocks[0].centroid, Some(Up::Y.rotate([9.0; 3])));
    assert_eq!(exact.scene.gravity, [0.0, 0.0, -9.5]);
    assert_eq!((exact.scene.blocks[0].mass, exact.scene.materials.len()), (Some(3.0), 1));
    for moved in [[0.0, 0.01, 0.0], [3.0, 0.0, 0.0]] {
        let changed = of(moved);
        finding(&changed, FindingCode::Converted, &["drawn otherwise", "\"a\""]);
        let (vertices, _) = mesh(&changed.scene.blocks[0]);
        let by = Vector3::from(vertices[0]).add_scalar(-1.0 / 3.0);
        assert!((by - Vector3::from(Up::Y.rotate(moved.map(f64::from)))).norm() < 1e-6, "{by}");
        assert_eq!(changed.scene.blocks[0].centroid, None);
    }
}

/// Nodes are placed in double precision: numbers of surveys keep their millimetres.
#[test]
fn places_of_nodes_keep_their_digits() {
    let text = with_extras([0.0; 3])
        .replace("\"children\":[1]", "\"children\":[1],\"translation\":[4500000.125,0,0]");
    let scene = import("a.gltf", text).expect("fine").scene;
    let (vertices, _) = mesh(&scene.blocks[0]);
    let off = vertices[0][0] - 4_500_000.125 - 1.0 / 3.0;
    assert!(off.abs() < 1e-7, "{off}");
}

/// Damaged files are errors or scenes, and never panic or hang: single bytes and words of every file of
/// the corpus are changed, cut and doubled in an order that is always the same.
#[test]
fn damaged_files_never_panic() {
    let mut state = 7_u64;
    let mut next = |below: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below.max(1)
    };
    let words: [&[u8]; 12] = [
        b"0",
        b"-1",
        b"1e308",
        b"1e-308",
        b"nan",
        b"<",
        b">",
        b"\"",
        b"99999999999",
        b"{",
        b"]",
        b"</",
    ];
    for format in ["mjcf", "urdf", "sdf", "gltf"] {
        for entry in std::fs::read_dir(folder(format)).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            if path.is_dir() || name == "expected.json" || name.ends_with(".bin") {
                continue;
            }
            let whole = std::fs::read(&path).expect("readable");
            for _ in 0..120 {
                let mut bytes = whole.clone();
                for _ in 0..=next(3) {
                    let at = next(bytes.len());
                    match next(5) {
                        0 => bytes.truncate(at),
                        1 => bytes[at] = next(256) as u8,
                        2 => {
                            let word = words[next(words.len())];
                            bytes.splice(at..at, word.iter().copied());
                        }
                        3 => {
                            let end = (at + next(40)).min(bytes.len());
                            bytes.drain(at..end);
                        }
                        _ => {
                            let end = (at + next(80)).min(bytes.len());
                            let part = bytes[at..end].to_vec();
                            bytes.splice(at..at, part);
                        }
                    }
                    if bytes.is_empty() {
                        break;
                    }
                }
                match import(&name, &bytes) {
                    Err(e) => assert!(!e.message.is_empty() && e.to_string().len() < 20_000),
                    Ok(imported) => {
                        let text = serde_json::to_string(&imported.scene).expect("JSON");
                        assert!(
                            serde_json::from_str::<Scene>(&text).expect("a scene")
                                == imported.scene,
                            "{name}"
                        );
                    }
                }
            }
        }
    }
}

/// The frame of a file does not matter: a body that is turned as a whole has the same corners, turned.
#[test]
fn euler_angles_and_axes_agree() {
    let axis = Unit::new_normalize(Vector3::new(1.0, -2.0, 0.5));
    let turn = Rotation3::from_axis_angle(&axis, 0.7);
    let (roll, pitch, yaw) = turn.euler_angles();
    let says = [
        format!("axisangle=\"{} {} {} 0.7\"", axis.x, axis.y, axis.z),
        // About axes that stay: roll, pitch and yaw.
        format!("euler=\"{roll} {pitch} {yaw}\""),
        format!(
            "xyaxes=\"{} {} {} {} {} {}\"",
            turn[(0, 0)],
            turn[(1, 0)],
            turn[(2, 0)],
            turn[(0, 1)],
            turn[(1, 1)],
            turn[(2, 1)]
        ),
    ];
    let all: Vec<Vec<Vector3<f64>>> = says
        .iter()
        .map(|say| {
            let geom = format!("<geom type=\"box\" size=\"1 2 3\" {say}/>");
            let text = mjcf(&free("a", &geom))
                .replace("<worldbody>", "<compiler angle=\"radian\" eulerseq=\"XYZ\"/><worldbody>");
            body(&read(&text, &ImportOptions::default()).scene.blocks[0]).0
        })
        .collect();
    for other in &all[1..] {
        assert!(all[0].iter().zip(other).all(|(p, q)| (p - q).norm() < 1e-12));
    }
}
