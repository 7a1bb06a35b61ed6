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
