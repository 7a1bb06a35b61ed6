//! What the user adds: supports, scale, rotation, several files.

use super::*;
use crate::Friction;

/// Three boxes of 1 × 2 × 3, side by side or on top of each other: two at height 0, one at 3.
fn three() -> String {
    let at = [[0.0; 3], [5.0, 0.0, 0.0], [0.0, 0.0, 3.0]];
    let boxes = at
        .iter()
        .enumerate()
        .map(|(n, &o)| format!("o b{n}\n{}", obj_box(o, |i| (i + 8 * n).to_string())));
    boxes.collect()
}

fn with(options: ImportOptions) -> Result<Imported, InputError> {
    import_bytes("x.obj", three().as_bytes(), &options)
}

#[test]
fn without_supports_the_lowest_blocks_are_proposed_and_the_proposal_works() {
    let imported = with(ImportOptions::default()).expect("no support is no error");
    let text = finding(
        &imported,
        FindingCode::Missing,
        &["lowest blocks are 2 (\"b0\", \"b1\")", "--support ID"],
    );
    let height = text
        .split("--support-below ")
        .nth(1)
        .and_then(|t| t.split('`').next())
        .expect("a height is proposed");
    assert!(height.len() <= 4, "{height} has more digits than it needs");
    let height = height.parse().expect("a number");
    assert_eq!(
        supports(
            &with(ImportOptions { support_below: Some(height), ..ImportOptions::default() })
                .expect("works")
        ),
        ["b0", "b1"]
    );
    finding(&imported, FindingCode::Missing, &["friction"]);
}

#[test]
fn supports_by_name_and_by_height_add_up() {
    let by_name = with(ImportOptions { supports: vec!["b2".into()], ..ImportOptions::default() })
        .expect("b2 is there");
    assert_eq!(supports(&by_name), ["b2"]);
    let both = ImportOptions {
        supports: vec!["b2".into()],
        support_below: Some(1e-9),
        ..ImportOptions::default()
    };
    let both = with(both).expect("fine");
    assert_eq!(supports(&both), ["b0", "b1", "b2"]);
    finding(&both, FindingCode::Missing, &["every block is a support"]);
    let none = with(ImportOptions { support_below: Some(0.0), ..ImportOptions::default() })
        .expect("below means below");
    assert!(supports(&none).is_empty());
    finding(&none, FindingCode::Missing, &["no block lies below 0 m", "lowest corner is at 0 m"]);
}

#[test]
fn a_support_that_is_not_there_is_an_error_with_the_names_there_are() {
    let error = with(ImportOptions { supports: vec!["b7".into()], ..ImportOptions::default() })
        .expect_err("no b7")
        .to_string();
    assert!(error.contains("\"b7\"") && error.contains("\"b0\", \"b1\", \"b2\""), "{error}");
}

#[test]
fn scale_and_height_are_in_the_units_of_the_scene() {
    let imported = with(ImportOptions {
        scale: Some(0.001),
        support_below: Some(0.002),
        ..ImportOptions::default()
    })
    .expect("fine");
    assert_eq!(supports(&imported), ["b0", "b1"], "b2 starts at 3 mm");
    assert!((volume(&imported.scene.blocks[0]) - 6e-9).abs() < 1e-20);
    assert!(imported.scene.source.contains("× 0.001"), "{}", imported.scene.source);
}

#[test]
fn every_up_is_a_proper_rotation_that_brings_its_axis_to_z() {
    let axes = [
        (Up::X, [1, 0, 0]),
        (Up::Y, [0, 1, 0]),
        (Up::Z, [0, 0, 1]),
        (Up::MinusX, [-1, 0, 0]),
        (Up::MinusY, [0, -1, 0]),
        (Up::MinusZ, [0, 0, -1]),
    ];
    for (up, axis) in axes {
        assert_eq!(up.rotate(axis.map(f64::from)), [0.0, 0.0, 1.0], "{up:?}");
        let column = |i: usize| {
            nalgebra::Vector3::from(up.rotate([0, 1, 2].map(|j| f64::from(u8::from(i == j)))))
        };
        let matrix = nalgebra::Matrix3::from_columns(&[column(0), column(1), column(2)]);
        assert_eq!(matrix.determinant(), 1.0, "{up:?}");
        assert_eq!(matrix * matrix.transpose(), nalgebra::Matrix3::identity(), "{up:?}");
        let imported =
            with(ImportOptions { up: Some(up), ..ImportOptions::default() }).expect("fine");
        check(&imported.scene);
        assert!(
            (volume(&imported.scene.blocks[0]) - 6.0).abs() < 1e-12,
            "{up:?}: outside stays outside"
        );
    }
}

#[test]
fn normals_of_stored_interfaces_turn_with_the_blocks_and_do_not_scale() {
    let seam = serde_json::json!({"points": [[0, 0, 3], [1, 0, 3], [1, 2, 3]], "frame": {"xaxis": [2, 0, 0], "yaxis": [0, 2, 0]}});
    let node = |z: f64| serde_json::json!({"block": compas_mesh([0.0, 0.0, z])});
    let text =
        serde_json::json!({"graph": {"node": {"0": node(0.0), "1": node(3.0)}, "edge": {"0": {"1": {"interfaces": [seam]}}}}}).to_string();
    let options = ImportOptions { up: Some(Up::Y), scale: Some(10.0), ..ImportOptions::default() };
    let imported = import_bytes("x.json", text.as_bytes(), &options).expect("fine");
    assert_eq!(imported.scene.interfaces[0].normal, Some([0.0, -1.0, 0.0]));
    assert_eq!(
        imported.scene.interfaces[0].points,
        [[0.0, -30.0, 0.0], [10.0, -30.0, 0.0], [10.0, -30.0, 20.0]]
    );
    let without = import_bytes(
        "x.json",
        text.as_bytes(),
        &ImportOptions { stored_interfaces: false, ..options },
    )
    .expect("fine");
    assert!(without.scene.interfaces.is_empty());
    finding(&without, FindingCode::LeftOut, &["left out as asked", ": 1"]);
}

#[test]
fn friction_density_and_gap_go_into_the_scene() {
    let options = ImportOptions {
        friction: Some(Friction::Coefficient(0.6)),
        density: Some(2400.0),
        gap: Some(1e-3),
        ..ImportOptions::default()
    };
    let imported = with(options).expect("fine");
    check(&imported.scene);
    assert_eq!(imported.scene.joints.default.friction, Some(Friction::Coefficient(0.6)));
    assert_eq!(imported.scene.contact.gap, 1e-3);
    let density = |b: &BlockSpec| {
        imported.scene.materials[b.material.as_deref().expect("a material")].density
    };
    assert!(imported.scene.blocks.iter().all(|b| density(b) == 2400.0));
    assert!(imported.findings.iter().all(|f| !f.text.contains("friction")));
}

#[test]
fn options_out_of_range_are_refused_before_reading() {
    let d = ImportOptions::default;
    for (options, word) in [
        (ImportOptions { scale: Some(0.0), ..d() }, "scale"),
        (ImportOptions { scale: Some(-1.0), ..d() }, "scale"),
        (ImportOptions { scale: Some(f64::NAN), ..d() }, "scale"),
        (ImportOptions { density: Some(-1.0), ..d() }, "density"),
        (ImportOptions { gap: Some(-1.0), ..d() }, "gap"),
        (ImportOptions { support_below: Some(f64::NAN), ..d() }, "support below"),
        (ImportOptions { friction: Some(Friction::Coefficient(-0.1)), ..d() }, "friction"),
    ] {
        let error =
            import_file(Path::new("no such file"), &options).expect_err("refused").to_string();
        assert!(error.starts_with(word) && error.contains("hint:"), "{error}");
    }
    let error =
        with(ImportOptions { scale: Some(1e308), ..d() }).expect_err("overflow").to_string();
    assert!(error.contains("inf") && error.contains("hint:"), "{error}");
}

#[test]
fn several_files_are_one_scene_and_support_files_are_supports() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a parent"))
            .and_then(|()| std::fs::write(&path, text))
            .expect("written");
        path
    };
    let list = |z: f64| {
        serde_json::json!([[compas_mesh([0.0, 0.0, z])], [compas_mesh([9.0, 0.0, z])]]).to_string()
    };
    let blocks = write("blocks.json", list(3.0));
    let ground = write("supports.json", list(0.0));
    let options = ImportOptions { support_files: vec![ground], ..ImportOptions::default() };
    let imported = import_file(&blocks, &options).expect("fine");
    check(&imported.scene);
    assert_eq!(ids(&imported), ["blocks-0", "blocks-1", "supports-0", "supports-1"]);
    assert_eq!(supports(&imported), ["supports-0", "supports-1"]);
    finding(
        &imported,
        FindingCode::Converted,
        &["two files have a block \"0\"", "blocks, supports"],
    );

    let stones = ["a/stone.ply", "b/stone.ply", "rock.ply"].map(|name| write(name, ply_box()));
    assert_eq!(
        ids(&import_files(&stones, &ImportOptions::default()).expect("fine")),
        ["stone", "stone2", "rock"]
    );
    assert_eq!(
        ids(&import_files(&stones[1..], &ImportOptions::default()).expect("fine")),
        ["stone", "rock"],
        "no clash, no prefix"
    );
}
