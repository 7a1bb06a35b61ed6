//! DXF: plane drawings.

use super::*;

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

fn volume(block: &BlockSpec) -> f64 {
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
    let options = ImportOptions { support_layers: vec!["ground".into()], ..deep() };
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
    for part in ["\"s-B\" over \"s-A\" at (0, 0)", "\"s-C\" at (7, 8)", "LINE 1", "no unit", "s 2"]
    {
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
    let grounded = ImportOptions { support_layers: vec!["GROUND".into()], ..deep() };
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
