//! DXF: plane drawings.

use super::*;
use std::collections::BTreeMap;

fn poly(handle: &str, layer: &str, flag: u8, corners: &str) -> String {
    let points: String = corners
        .split_whitespace()
        .map(|w| w.split_once(',').expect("x,y"))
        .map(|(x, y)| format!("10\n{x}\n20\n{y}\n"))
        .collect();
    format!("0\nLWPOLYLINE\n5\n{handle}\n8\n{layer}\n70\n{flag}\n{points}")
}

fn drawing(unit: u8, entities: &str) -> String {
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    )
}

fn deep() -> ImportOptions {
    ImportOptions { depth: Some(0.5), ..ImportOptions::default() }
}

fn rules(texts: &[&str]) -> BTreeMap<String, LayerRule> {
    let rule = |text: &&str| {
        let (name, rule) = text.split_once('=').expect("NAME=RULE");
        (name.to_string(), rule.parse().expect("a rule"))
    };
    texts.iter().map(rule).collect()
}

pub(super) fn volume(block: &BlockSpec) -> f64 {
    let (v, faces) = mesh(block);
    let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let fan =
        |f: &Vec<usize>| -> f64 { f.windows(2).map(|w| det(v[f[0]], v[w[0]], v[w[1]])).sum() };
    faces.iter().map(fan).sum::<f64>() / 6.0
}

#[test]
fn outlines_are_prisms_in_metres_whichever_way_they_turn() {
    let text = drawing(
        4,
        &(poly("A1", "stone", 1, "0,0 2000,0 2000,1000 0,1000")
            + &poly("A2", "ground", 1, "0,0 0,-1000 2000,-1000 2000,0")),
    );
    let options = ImportOptions { layers: rules(&["ground=support"]), ..deep() };
    for name in ["wall.dxf", "wall"] {
        let imported = import_bytes(name, text.as_bytes(), &options).expect("fine");
        check(&imported.scene);
        assert_eq!(ids(&imported), ["stone-A1", "ground-A2"]);
        for block in &imported.scene.blocks {
            assert!((volume(block) - 1.0).abs() < 1e-9, "{}", volume(block));
        }
        assert_eq!(
            imported.scene.blocks.iter().map(|b| b.support).collect::<Vec<_>>(),
            [false, true]
        );
    }
}

#[test]
fn a_bulge_is_an_arc() {
    let circle = poly("C", "s", 1, "-1,0 1,0").replace("20\n0\n", "20\n0\n42\n1\n");
    let imported = import_bytes("c.dxf", drawing(6, &circle).as_bytes(), &deep()).expect("fine");
    let exact = std::f64::consts::PI / 2.0;
    let error = 1.0 - volume(&imported.scene.blocks[0]) / exact;
    assert!(error > 0.0 && error < 1e-4, "{error}");
}

#[test]
fn faults_are_told_with_their_place() {
    let square = "0,0 1,0 1,1 0,1";
    let text = drawing(
        0,
        &(poly("A", "s", 1, square)
            + &poly("B", "s", 1, square)
            + &poly("C", "s", 0, "7,8 9,8")
            + "0\nLINE\n8\ns\n"),
    );
    let imported = import_bytes("w.dxf", text.as_bytes(), &deep()).expect("fine");
    let said: Vec<&str> = imported.findings.iter().map(|f| f.text.as_str()).collect();
    let said = said.join("\n");
    for part in [
        "\"s-B\" over \"s-A\" at (0, 0)",
        "\"s-C\" at (7, 8)",
        "LINE 1",
        "no unit",
        "\"s\" 2 outlines",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let error = import("w.dxf", text).expect_err("no depth");
    assert!(error.to_string().contains("no depth"), "{error}");
    for cut in ["0\nSECTION\n2", "x\ny\n", "AutoCAD Binary DXF\r\n"] {
        assert!(import("w.dxf", cut).is_err(), "{cut}");
    }
}

/// Drawings of ezdxf: `tests/formats/make.py`.
fn drawn(name: &str, options: &ImportOptions) -> Imported {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/formats/");
    let bytes = std::fs::read(format!("{folder}{name}")).expect("a drawing of the repository");
    import_bytes(name, &bytes, options).expect("a scene")
}

#[test]
fn drawings_of_another_program_are_read_in_metres() {
    let grounded = ImportOptions { layers: rules(&["GROUND=support"]), ..deep() };
    let in_metres = ImportOptions { scale: Some(1.0), ..grounded.clone() };
    let [modern, old] = [("wall-2010-mm.dxf", &grounded), ("wall-r12.dxf", &in_metres)]
        .map(|(name, options)| drawn(name, options).scene);
    check(&modern);
    assert_eq!(modern.blocks.len(), 10);
    for (a, b) in modern.blocks.iter().zip(&old.blocks) {
        let exact = if a.support { 1.6 * 0.2 * 0.5 } else { 0.4 * 0.2 * 0.5 };
        assert!((volume(a) - exact).abs() < 1e-12 && (volume(b) - exact).abs() < 1e-12);
        assert_eq!((a.support, &a.material), (b.support, &b.material));
    }
    assert_eq!(modern.blocks.iter().filter(|b| b.support).count(), 1);

    let arch = drawn("arch-2018-m.dxf", &grounded).scene;
    let voussoirs: Vec<_> = arch.blocks.iter().filter(|b| !b.support).collect();
    assert_eq!((voussoirs.len(), arch.blocks.len()), (9, 11));
    let exact = (25.0 - 16.0) / 2.0 * std::f64::consts::PI / 9.0 * 0.5;
    for v in voussoirs {
        assert!((volume(v) / exact - 1.0).abs() < 1e-4, "{} for {exact}", volume(v));
    }
}

#[test]
fn faults_of_a_drawing_of_another_program_have_their_place() {
    let imported = drawn("faults-2000-cm.dxf", &deep());
    let said: Vec<&str> = imported.findings.iter().map(|f| f.text.as_str()).collect();
    let said = said.join("\n");
    for part in
        ["at (300, 0)", "at (0, 0)); delete", "HATCH 1", "LINE 1", "TEXT 1", "cm, 1 = 0.01 m"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
}

/// A circle of any radius takes as many corners; bulges that are next to nothing or beyond all measure
/// take none.
#[test]
fn arcs_take_corners_by_their_size() {
    let corners = |text: String| {
        mesh(&import_bytes("a.dxf", text.as_bytes(), &deep()).unwrap().scene.blocks[0]).0.len() / 2
    };
    let bent = |side: &str, bulge: &str| {
        let points = format!("-{side},0 {side},0 {side},-{side} -{side},-{side}");
        poly("A", "s", 1, &points).replacen("20\n0\n", &format!("20\n0\n42\n{bulge}\n"), 1)
    };
    let of = |side, bulge| corners(drawing(6, &bent(side, bulge)));
    assert_eq!(of("1", "-1"), of("1000", "-1"));
    assert!((20..300).contains(&of("1", "-1")), "{}", of("1", "-1"));
    assert!(of("1", "-1000") < 500);
    for bulge in ["0", "1e-300", "1e-14"] {
        assert_eq!(of("1", bulge), 4, "{bulge}");
    }
    assert!(of("1", "1e308") < 500);
}

/// A polyline that ends where it began is closed, whatever its flag says.
#[test]
fn a_polyline_that_comes_back_is_closed() {
    let text = drawing(6, &poly("A", "s", 0, "0,0 1,0 1,1 0,1 0,0"));
    let imported = import_bytes("a.dxf", text.as_bytes(), &deep()).expect("fine");
    assert_eq!(volume(&imported.scene.blocks[0]), 0.5);
}

/// A scale goes before the unit of the drawing, also 1.
#[test]
fn a_scale_goes_before_the_unit() {
    let text = drawing(4, &poly("A", "s", 1, "0,0 1,0 1,1 0,1"));
    let of = |scale| import_bytes("a.dxf", text.as_bytes(), &ImportOptions { scale, ..deep() });
    for (scale, side) in [(None, 1e-3), (Some(1.0), 1.0), (Some(0.1), 0.1)] {
        let size = volume(&of(scale).expect("fine").scene.blocks[0]);
        assert!((size / (0.5 * side * side) - 1.0).abs() < 1e-12, "{scale:?} {size}");
    }
}

/// Entities of a block, and where it is inserted.
fn inserted(block: &str, inserts: &str) -> String {
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n10\n1\n20\n0\n30\n0\n{block}0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{inserts}0\nENDSEC\n0\nEOF\n"
    )
}

fn insert(handle: &str, layer: &str, more: &str) -> String {
    format!("0\nINSERT\n5\n{handle}\n8\n{layer}\n2\nB\n{more}")
}

#[test]
fn inserted_blocks_stand_where_they_are_inserted() {
    let brick = poly("A", "0", 1, "1,0 3,0 3,1 1,1");
    let turned = insert("I", "stone", "10\n5\n20\n7\n41\n2\n42\n3\n50\n90\n");
    let rows = insert("J", "ground", "10\n0\n20\n-1\n70\n2\n71\n3\n44\n4\n45\n-2\n");
    let text = inserted(&brick, &(turned + &rows));
    let imported = import_bytes("w.dxf", text.as_bytes(), &deep()).expect("fine");
    check(&imported.scene);
    let place = |b: &BlockSpec| {
        let ends = |k: usize| {
            let all = mesh(b).0.iter().map(move |v| v[k]);
            (all.clone().fold(f64::INFINITY, f64::min), all.fold(f64::NEG_INFINITY, f64::max))
        };
        (ends(0), ends(2))
    };
    let blocks = &imported.scene.blocks;
    assert_eq!(blocks.len(), 7);
    assert_eq!(
        (blocks[0].id.as_str(), blocks[0].material.as_deref()),
        ("stone-I-A", Some("stone"))
    );
    // The brick from its base: (0, 0) to (2, 1); twice as long, three times as high, turned left.
    assert_eq!(place(&blocks[0]), ((2.0, 5.0), (7.0, 11.0)));
    assert_eq!(blocks[6].id, "ground-J-6-A");
    assert_eq!(place(&blocks[6]), ((4.0, 6.0), (-5.0, -4.0)));
    assert!(blocks.iter().skip(1).all(|b| (volume(b) - 1.0).abs() < 1e-12));
}

#[test]
fn inserted_blocks_that_do_not_end_are_refused() {
    let itself = inserted(&insert("I", "0", ""), &insert("J", "0", ""));
    let error = import("w.dxf", itself).expect_err("no end");
    assert!(error.to_string().contains("within itself"), "{error}");
    let many = insert("J", "0", "70\n32767\n71\n32767\n");
    for block in ["", &poly("A", "0", 1, "0,0 1,0 1,1")] {
        let error = import_bytes("w.dxf", inserted(block, &many).as_bytes(), &deep());
        assert!(error.expect_err("too many").to_string().contains("more than 1000000"));
    }
    let missing =
        inserted("", "").replace("0\nEOF", "") + "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n";
    assert!(import("w.dxf", missing).is_err());
}

/// The six faces of a box, a 3DFACE each.
fn faces(layer: &str, low: [f64; 3], size: [f64; 3]) -> String {
    let corner = |k: usize| -> [f64; 3] {
        std::array::from_fn(|i| low[i] + if k >> i & 1 == 1 { size[i] } else { 0.0 })
    };
    let face = |ring: [usize; 4]| {
        let points: String = ring
            .iter()
            .enumerate()
            .map(|(i, &k)| {
                let [x, y, z] = corner(k);
                format!("{}\n{x}\n{}\n{y}\n{}\n{z}\n", 10 + i, 20 + i, 30 + i)
            })
            .collect();
        format!("0\n3DFACE\n8\n{layer}\n{points}")
    };
    let rings =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    rings.map(face).concat()
}

/// Boxes that share a face, whose corners are the same, are two bodies.
#[test]
fn bodies_of_faces_that_touch_stay_apart() {
    let text = drawing(
        6,
        &(faces("a", [0.0; 3], [1.0; 3])
            + &faces("a", [1.0, 0.0, 0.0], [1.0, 1.0, 2.0])
            + &faces("b", [0.0, 0.0, 1.0], [1.0; 3])),
    );
    let imported = import_bytes("w.dxf", text.as_bytes(), &ImportOptions::default()).expect("fine");
    check(&imported.scene);
    let volumes: Vec<f64> = imported.scene.blocks.iter().map(volume).collect();
    assert_eq!(volumes, [1.0, 2.0, 1.0]);
    let layers: Vec<_> = imported.scene.blocks.iter().map(|b| b.material.as_deref()).collect();
    assert_eq!(layers, [Some("a"), Some("a"), Some("b")]);
}

#[test]
fn layers_are_ties_and_loads() {
    let text = drawing(
        4,
        &(poly("A", "stone", 1, "0,0 1000,0 1000,1000 0,1000")
            + &poly("B", "stone", 1, "3000,0 4000,0 4000,1000 3000,1000")
            + &poly("C", "plan", 1, "0,0 9000,0 9000,9000")
            + "0\nLINE\n5\nT\n8\nrod\n10\n500\n20\n900\n11\n3500\n21\n900\n"
            + "0\nLINE\n5\nU\n8\nrod\n10\n500\n20\n900\n11\n2500\n21\n900\n"
            + "0\nPOINT\n5\nP\n8\npush\n10\n500\n20\n1000\n"),
    );
    let layers = rules(&[
        "stone=block,density=2000,depth=2",
        "rod=tie,strength=5e4",
        "push=load,force=10:-3",
        "plan=ignore",
    ]);
    let options = ImportOptions { layers, ..ImportOptions::default() };
    let imported = import_bytes("w.dxf", text.as_bytes(), &options).expect("fine");
    let scene = &imported.scene;
    check(scene);
    assert_eq!(ids(&imported), ["stone-A", "stone-B"]);
    assert_eq!(scene.materials["stone"].density, 2000.0);
    assert_eq!(scene.members.len(), 1);
    let tie = scene.members[0].tie.as_ref().expect("a tie");
    assert_eq!(tie.between[1].block.as_deref(), Some("stone-B"));
    assert_eq!(tie.between[1].at, Some([3.5, 1.0, 0.9]));
    let load = &scene.loads.live[0];
    assert_eq!((load.block.as_deref(), load.force), (Some("stone-A"), Some([10.0, 0.0, -3.0])));
    assert_eq!(load.at, Some(crate::At::Point([0.5, 1.0, 1.0])));
    let said: Vec<&str> = imported.findings.iter().map(|f| f.text.as_str()).collect();
    assert!(said.iter().any(|t| t.contains("\"rod-U\": (2500, 900) is in no outline")), "{said:?}");
    for (bad, why) in [
        ("tie", "strength"),
        ("load", "force"),
        ("block,strength=3", "only of a tie"),
        ("block,density=-1", "> 0"),
        ("wall", "unknown variant"),
        ("block,height=2", "unknown field"),
        ("block,density", "KEY=VALUE"),
    ] {
        let error = bad.parse::<LayerRule>().expect_err(bad);
        assert!(error.contains(why), "{bad}: {error}");
    }
    let layers = rules(&["rood=support"]);
    let error = import_bytes("w.dxf", text.as_bytes(), &ImportOptions { layers, ..deep() });
    assert!(error.expect_err("no such layer").to_string().contains("rood"));
}

#[test]
fn bodies_in_space_are_read_from_binary_files() {
    let layers = rules(&["GROUND=support"]);
    let imported =
        drawn("trilithon-2013-m.dxf", &ImportOptions { layers, ..ImportOptions::default() });
    check(&imported.scene);
    let blocks = &imported.scene.blocks;
    let mut volumes: Vec<(bool, f64)> = blocks.iter().map(|b| (b.support, volume(b))).collect();
    volumes.sort_by(|a, b| a.1.total_cmp(&b.1));
    assert_eq!(volumes, [(false, 0.5), (false, 0.5), (false, 0.625), (true, 3.5)]);

    let broken = drawn("faults-r12-binary.dxf", &ImportOptions::default());
    assert_eq!(broken.scene.blocks.iter().map(|b| mesh(b).1.len()).collect::<Vec<_>>(), [6, 5]);
    let said: Vec<&str> = broken.findings.iter().map(|f| f.text.as_str()).collect();
    assert!(said.iter().any(|t| t.contains("INSERT of \"LOST\"")), "{said:?}");
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/formats/");
    let bytes = std::fs::read(format!("{folder}trilithon-2013-m.dxf")).expect("a drawing");
    for end in [25, 400, bytes.len() / 2, bytes.len() - 1] {
        let cut = import_bytes("t.dxf", &bytes[..end], &ImportOptions::default());
        assert!(cut.is_err() || end > bytes.len() / 4, "{end}");
    }
}

#[test]
fn bricks_that_are_one_block_are_read_where_they_stand() {
    let layers = rules(&["GROUND=support", "BRICK=block,density=1800"]);
    let imported = drawn("mortar-2007-mm.dxf", &ImportOptions { layers, ..deep() });
    check(&imported.scene);
    let blocks = &imported.scene.blocks;
    assert_eq!(blocks.len(), 10);
    let base = blocks.iter().find(|b| b.support).expect("the base");
    let top = mesh(base).0.iter().map(|v| v[2]).fold(f64::NEG_INFINITY, f64::max);
    assert!((top + 0.01).abs() < 1e-12, "{top}");
    let wide = |b: &BlockSpec| (volume(b) / (0.24 * 0.065 * 0.5) - 1.0).abs() < 1e-9;
    assert_eq!(blocks.iter().filter(|b| wide(b)).count(), 9);
}
