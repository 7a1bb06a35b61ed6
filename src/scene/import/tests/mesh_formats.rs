//! OBJ, PLY and STL.

use super::*;

#[test]
fn obj_objects_are_blocks_and_corners_are_written_in_any_of_the_four_ways() {
    let second = |i: usize| {
        [
            format!("{}", i + 8),
            format!("{}/1", i + 8),
            format!("{}//1", i + 8),
            format!("{}/1/1", i + 8),
        ][i % 4]
            .clone()
    };
    let text = format!(
        "# two boxes\nmtllib none.mtl\no lower one\n{}o upper\nusemtl grey\ng front\nvt 0 0\nvn 0 0 1\ns off\n{}o third\n{}",
        obj_box([0.0; 3], |i| i.to_string()),
        obj_box([0.0, 0.0, 3.0], second),
        obj_box([0.0, 0.0, 6.0], |i| format!("{}", i as i64 - 9)),
    );
    let imported = good("wall.obj", text.replace('\n', "\r\n"));
    assert_eq!(ids(&imported), ["lower one", "upper", "third"]);
    for (block, z) in imported.scene.blocks.iter().zip([0.0, 3.0, 6.0]) {
        assert_eq!(mesh(block).0, corners([0.0, 0.0, z]));
        assert_eq!(mesh(block).1, FACES, "faces stay as they are");
    }
    assert_eq!(imported.scene.name, "wall");
    assert!(
        imported.findings.iter().all(|f| f.code == FindingCode::Missing),
        "{:?}",
        imported.findings
    );
}

#[test]
fn obj_groups_are_blocks_where_there_are_no_objects() {
    let text = format!(
        "{}g b\n{}g a\n",
        obj_box([0.0; 3], |i| i.to_string()).replace("f 1 4 3 2", "g a\nf 1 4 3 2"),
        { obj_box([0.0, 0.0, 3.0], |i| (i + 8).to_string()) }
    );
    let imported = good("x.obj", text);
    assert_eq!(ids(&imported), ["a", "b"]);
    finding(&imported, FindingCode::Converted, &["groups (`g`)", "2 in all"]);
}

#[test]
fn obj_without_names_is_split_where_it_does_not_hang_together() {
    let text =
        obj_box([0.0; 3], |i| i.to_string()) + &obj_box([0.0, 0.0, 3.0], |i| (i + 8).to_string());
    let imported = good("pile.obj", text);
    assert_eq!(ids(&imported), ["pile-0", "pile-1"]);
    assert!(imported.scene.blocks.iter().all(|b| volume(b) == 6.0));
    finding(&imported, FindingCode::Converted, &["connected parts", "2 in all"]);
}

/// Programs that write corners once for every face: what is left of a body belongs to it, and a
/// body that is whole stays one although another has a corner at the same place.
#[test]
fn obj_faces_with_corners_of_their_own_are_a_body() {
    let corner_by_face = |at: [f64; 3], first: usize| {
        let text = obj_box(at, |i| i.to_string());
        let points: Vec<&str> = text.lines().filter(|l| l.starts_with('v')).collect();
        let faces = text.lines().filter(|l| l.starts_with('f'));
        let mut own = String::new();
        let mut next = first;
        for face in faces {
            let corners =
                face.split_whitespace().skip(1).map(|c| points[c.parse::<usize>().unwrap() - 1]);
            let corners: Vec<&str> = corners.collect();
            own += &format!("{}\n", corners.join("\n"));
            let numbers: Vec<String> =
                (next..next + corners.len()).map(|i| i.to_string()).collect();
            own += &format!("f {}\n", numbers.join(" "));
            next += corners.len();
        }
        own
    };
    let imported = good("cube.obj", corner_by_face([0.0; 3], 1));
    assert_eq!(volume(&imported.scene.blocks[0]), 6.0);
    let whole = obj_box([0.0; 3], |i| i.to_string());
    let above = |z: f64| corner_by_face([0.0, 0.0, z], 9);
    assert_eq!(ids(&good("pile.obj", whole.clone() + &above(5.0))), ["pile-0", "pile-1"]);
    let beside = whole + &obj_box([0.0, 0.0, 3.0], |i| (i + 8).to_string());
    assert_eq!(ids(&good("pile.obj", beside)), ["pile-0", "pile-1"]);
}

#[test]
fn obj_faces_may_come_before_their_corners_and_lines_may_be_continued() {
    let text = obj_box([0.0; 3], |i| i.to_string());
    let (v, f): (Vec<&str>, Vec<&str>) = text.lines().partition(|l| l.starts_with('v'));
    let text = format!(
        "o b\n{}\n{}\n",
        f.join("\n").replace("f 1 4 3 2", "f 1 4 \\\n 3 2 # a comment"),
        v.join("\n")
    );
    assert_eq!(volume(&good("x.obj", text).scene.blocks[0]), 6.0);
}

#[test]
fn obj_names_that_repeat_are_numbered_and_it_is_said() {
    let text = format!(
        "o b\n{}o b\n{}",
        obj_box([0.0; 3], |i| i.to_string()),
        obj_box([0.0, 0.0, 3.0], |i| (i + 8).to_string())
    );
    let imported = good("x.obj", text);
    assert_eq!(ids(&imported), ["b", "b-2"]);
    finding(&imported, FindingCode::Converted, &["renamed: 1 ", "\"b\" → \"b-2\""]);
}

#[test]
fn one_object_of_two_parts_stays_one_block_and_it_is_said() {
    let text = format!(
        "o b\n{}{}",
        obj_box([0.0; 3], |i| i.to_string()),
        obj_box([0.0, 0.0, 3.0], |i| (i + 8).to_string())
    );
    let imported = good("x.obj", text);
    assert_eq!(ids(&imported), ["b"]);
    finding(&imported, FindingCode::Converted, &["2 parts", "separate objects"]);
}

#[test]
fn ply_in_all_three_encodings_is_the_same_block() {
    let ascii = good("stone.ply", ply_box());
    assert_eq!(ids(&ascii), ["stone"]);
    assert_eq!(mesh(&ascii.scene.blocks[0]), (&corners([0.0; 3])[..], &FACES.map(Vec::from)[..]));
    for little in [true, false] {
        assert_eq!(good("stone.ply", ply_box_binary(little)).scene, ascii.scene);
    }
}

#[test]
fn stl_ascii_and_binary_are_the_same_block_with_shared_corners() {
    let ascii = good("stone.stl", stl_ascii(""));
    let (vertices, faces) = mesh(&ascii.scene.blocks[0]);
    assert_eq!((vertices.len(), faces.len(), volume(&ascii.scene.blocks[0])), (8, 12, 6.0));
    for title in ["", "solid although it is binary"] {
        assert_eq!(good("stone.stl", stl_binary(title)).scene, ascii.scene, "{title:?}");
    }
}

#[test]
fn stl_solids_are_blocks() {
    let imported =
        good("x.stl", stl_ascii("a") + &stl_ascii("b c").to_uppercase() + &stl_ascii("a"));
    assert_eq!(ids(&imported), ["a", "B C", "a-2"]);
}

#[test]
fn formats_are_told_by_content_where_the_extension_says_nothing() {
    let obj = format!("# no object\n{}", obj_box([0.0; 3], |i| i.to_string()));
    let json = serde_json::json!([compas_mesh([0.0; 3])]).to_string();
    for (bytes, format) in [
        (obj.clone().into_bytes(), "(OBJ)"),
        (ply_box().into_bytes(), "(PLY)"),
        (stl_binary("solid"), "(STL)"),
        (stl_ascii("").into_bytes(), "(STL)"),
        (json.into_bytes(), "(COMPAS JSON)"),
    ] {
        let scene = good("file.dat", bytes).scene;
        assert_eq!(volume(&scene.blocks[0]), 6.0);
        assert_eq!(scene.source, format!("imported from file.dat {format}"));
    }
    let asked = ImportOptions { format: Some(Format::Obj), ..ImportOptions::default() };
    assert_eq!(
        import_bytes("wrong.ply", obj.as_bytes(), &asked)
            .expect("asked for OBJ")
            .scene
            .blocks
            .len(),
        1
    );
}

/// Marks and line ends of other editors: the same blocks as without them, in every format.
#[test]
fn a_byte_order_mark_and_old_line_ends_do_no_harm() {
    let obj = format!(
        "o stone\n{}o other\n{}",
        obj_box([0.0; 3], |i| i.to_string()),
        obj_box([0.0, 0.0, 3.0], |i| (i + 8).to_string())
    );
    let ply = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n".to_string();
    let facet = |a: &str, b: &str, c: &str| {
        format!(
            "facet normal 0 0 0\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n"
        )
    };
    let [o, x, y, z] = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"];
    let stl = format!(
        "solid s\n{}{}{}{}endsolid s\n",
        facet(o, y, x),
        facet(o, x, z),
        facet(o, z, y),
        facet(x, y, z)
    );
    for (name, text) in [("a.obj", obj), ("a.ply", ply), ("a.stl", stl)] {
        let plain = good(name, &text);
        for changed in [
            format!("\u{feff}{text}"),
            text.replace('\n', "\r"),
            text.replace('\n', "\r\n"),
            format!("\u{feff}{}", text.replace('\n', "\r")),
        ] {
            let read = good(name, &changed);
            assert_eq!(read.scene.blocks, plain.scene.blocks, "{name}");
            // Lines are counted as an editor counts them.
            assert_eq!(read.origins, plain.origins, "{name}");
            let by_content = import("blocks", &changed).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(by_content.scene.blocks.len(), plain.scene.blocks.len(), "{name}");
        }
    }
    let list = serde_json::to_string(&serde_json::json!([])).unwrap();
    let said = |text: &str| import("x.json", text).unwrap_err().to_string();
    assert_eq!(said(&list), said(&format!("\u{feff}{list}")));
}

/// Numbers in binary after a header of old line ends stay as they are.
#[test]
fn a_binary_ply_may_have_a_header_with_old_line_ends() {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n".to_vec();
    let header = bytes.len();
    // The double 13.0 and the byte 13 are no line ends.
    for point in [
        [0.0, 0.0, 0.0],
        [13.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, f64::from_bits(0x400d_0d0d_0d0d_0d0d)],
    ] {
        point.iter().for_each(|c: &f64| bytes.extend(c.to_le_bytes()));
    }
    for face in [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] {
        bytes.push(3);
        face.iter().for_each(|i: &i32| bytes.extend(i.to_le_bytes()));
    }
    let plain = good("a.ply", &bytes);
    bytes[..header].iter_mut().filter(|b| **b == b'\n').for_each(|b| *b = b'\r');
    assert_eq!(good("a.ply", &bytes).scene.blocks, plain.scene.blocks);
}

/// Rules make layers of the groups of an OBJ file; formats without layers refuse them.
#[test]
fn groups_of_objects_are_layers_where_rules_are_given() {
    let cube = |name: &str, layer: &str, z: f64, first: usize| {
        let corner = |k: usize| format!("v {} {} {}\n", k & 1, k >> 1 & 1, z + (k >> 2) as f64);
        let faces =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let face = |f: &[usize; 4]| format!("f {}\n", f.map(|k| (first + k).to_string()).join(" "));
        let corners: String = (0..8).map(corner).collect();
        format!("o {name}\ng {layer}\n{corners}{}", faces.iter().map(face).collect::<String>())
    };
    let text = cube("a", "base", 0.0, 1) + &cube("b", "stone", 1.0, 9);
    let rules = [("base", "support"), ("stone", "block,density=2000")];
    let layers = rules.map(|(l, r)| (l.to_string(), r.parse().expect("a rule"))).into();
    let options = ImportOptions { layers, ..ImportOptions::default() };
    let imported = import_bytes("m.obj", text.as_bytes(), &options).expect("a scene");
    assert_eq!(ids(&imported), ["a", "b"]);
    assert_eq!(imported.scene.blocks.iter().map(|b| b.support).collect::<Vec<_>>(), [true, false]);
    assert_eq!(imported.scene.materials["stone"].density, 2000.0);
    assert_eq!(ids(&good("m.obj", &text)), ["a", "b"]);
    for (name, text) in
        [("m.obj", text.replace("g ", "# ")), ("p.csv", "l,w,h,x,y,z\n1,1,1,0,0,0\n".into())]
    {
        let error = import_bytes(name, text.as_bytes(), &options).expect_err(name);
        assert!(error.to_string().contains("rules for layers"), "{error}");
    }
}
