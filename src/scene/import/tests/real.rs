//! Files of other projects (`tests/cases/README.md`).

use super::*;
use std::path::PathBuf;

fn path(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/cases/compas").join(file)
}

fn real(file: &str, options: &ImportOptions) -> Imported {
    let imported = import_file(&path(file), options).unwrap_or_else(|e| panic!("{e}"));
    check(&imported.scene);
    imported
}

#[test]
fn compas_assemblies_have_their_blocks_supports_and_interfaces() {
    for (file, blocks, supported, interfaces) in [
        ("assembly-crossvault.json", 184, 4, 488),
        ("assembly-wall.json", 52, 10, 80),
        ("assembly-stack.json", 10, 1, 9),
        ("cra-armadillo.json", 399, 0, 0),
        ("cra-cubes.json", 3, 0, 0),
        ("cra-H.json", 3, 0, 0),
        ("cra-type-b.json", 3, 0, 0),
        ("cra-bridge.json", 16, 0, 0),
        ("cra-shelf.json", 11, 0, 0),
        ("cra-shelf-stable.json", 9, 0, 0),
    ] {
        let imported = real(file, &ImportOptions::default());
        let scene = &imported.scene;
        assert_eq!(
            (scene.blocks.len(), supports(&imported).len(), scene.interfaces.len()),
            (blocks, supported, interfaces),
            "{file}"
        );
        assert!(
            scene.blocks.iter().enumerate().all(|(i, b)| b.id == i.to_string()),
            "{file}: ids are the keys, in numeric order"
        );
        assert!(scene.blocks.iter().all(|b| volume(b) > 0.0), "{file}: faces look outward");
        if supported == 0 {
            finding(&imported, FindingCode::Missing, &["no block is a support"]);
        }
    }
}

#[test]
fn stored_normals_point_from_the_first_block_into_the_second() {
    let centre = |block: &BlockSpec| {
        let (vertices, _) = mesh(block);
        vertices.iter().map(|v| nalgebra::Vector3::from(*v)).sum::<nalgebra::Vector3<f64>>()
            / vertices.len() as f64
    };
    for file in ["assembly-crossvault.json", "assembly-wall.json", "assembly-stack.json"] {
        let imported = real(file, &ImportOptions::default());
        let block = |id: &str| imported.scene.blocks.iter().find(|b| b.id == id).expect("checked");
        for interface in &imported.scene.interfaces {
            let [a, b] = &interface.between;
            let normal = nalgebra::Vector3::from(interface.normal.expect("stored with a frame"));
            assert!(normal.dot(&(centre(block(b)) - centre(block(a)))) > 0.0, "{file}: {a}–{b}");
        }
        assert!(
            imported.findings.iter().all(|f| f.code != FindingCode::LeftOut),
            "{file}: {:?}",
            imported.findings
        );
    }
}

#[test]
fn supports_can_be_named_by_node_key() {
    let options =
        ImportOptions { supports: ["0", "1"].map(String::from).into(), ..ImportOptions::default() };
    assert_eq!(supports(&real("cra-bridge.json", &options)), ["0", "1"]);
}

#[test]
fn the_proposed_supports_are_those_the_structures_have() {
    let armadillo: Vec<usize> = (0..=7).chain(79..=88).chain(217..=227).chain(328..=331).collect();
    for (file, expected) in [
        ("cra-H.json", vec![0, 1]),
        ("cra-bridge.json", vec![0, 1]),
        ("cra-cubes.json", vec![0]),
        ("cra-armadillo.json", armadillo),
    ] {
        let imported = real(file, &ImportOptions::default());
        let text = finding(&imported, FindingCode::Missing, &["--support-below"]);
        let height = text
            .split("--support-below ")
            .nth(1)
            .and_then(|t| t.split('`').next())
            .expect("proposed")
            .parse()
            .expect("a number");
        let again =
            real(file, &ImportOptions { support_below: Some(height), ..ImportOptions::default() });
        assert_eq!(
            supports(&again),
            expected.iter().map(usize::to_string).collect::<Vec<_>>(),
            "{file}"
        );
    }
}

#[test]
fn a_height_selects_the_supports_stored_in_the_wall() {
    // The wall's own supports are its first course.
    let imported = real("assembly-wall.json", &ImportOptions::default());
    let stored = supports(&imported);
    let options = ImportOptions { support_below: Some(0.01), ..ImportOptions::default() };
    assert_eq!(supports(&real("assembly-wall.json", &options)), stored);
}

#[test]
fn obj_files_have_one_block_per_object() {
    for (file, blocks, first) in
        [("dem-crossvault.obj", 184, "Mesh 0"), ("dem-wall.obj", 38, "Mesh_0")]
    {
        let imported = real(file, &ImportOptions::default());
        assert_eq!((imported.scene.blocks.len(), ids(&imported)[0]), (blocks, first), "{file}");
    }
}

#[test]
fn the_pavilion_vault_comes_in_two_files() {
    let (blocks, ground) =
        (path("dem-pavillionvault/blocks.json"), path("dem-pavillionvault/supports.json"));
    let imported = import_file(
        &blocks,
        &ImportOptions { support_files: vec![ground], ..ImportOptions::default() },
    )
    .unwrap_or_else(|e| panic!("{e}"));
    check(&imported.scene);
    assert_eq!((imported.scene.blocks.len(), supports(&imported).len()), (387, 10));
    assert!(supports(&imported).iter().all(|id| id.starts_with("supports-")));
}

#[test]
fn stones_keep_their_faces_as_they_are() {
    for (file, vertices, faces) in [
        ("rb3d-stones/stone_0.ply", 196, 388),
        ("rb3d-stones/stone_1.ply", 366, 728),
        ("rb3d-stones/stone_2.ply", 286, 568),
        ("rb3d-stones/stone_10.ply", 94, 184),
    ] {
        let imported = real(file, &ImportOptions::default());
        let block = &imported.scene.blocks[0];
        assert_eq!((mesh(block).0.len(), mesh(block).1.len()), (vertices, faces), "{file}");
        assert!(volume(block) < 0.0, "{file}: inward, and left for the judge of solids");
    }
}
