//! SVG: outlines of a plane drawing.

use super::{dxf::volume, *};

fn deep() -> ImportOptions {
    ImportOptions { depth: Some(0.5), ..ImportOptions::default() }
}

fn drawing(content: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"2000mm\" height=\"1000mm\" viewBox=\"0 0 200 100\">{content}</svg>"
    )
}

/// In a drawing of 1 : 10 in millimetres.
#[test]
fn outlines_of_every_kind_stand_upright_in_metres() {
    let text = drawing(
        "<g inkscape:groupmode='layer' inkscape:label='stone'><rect id='a' x='0' y='50' width='20' height='50'/>
        <g transform='translate(20 0)'><path id='b' d='M0,50 h20 v50 h-20 z m40 0 l10 0 0 10z'/></g>
        <polygon id='c' points='100,100 120,100 120,50 100,50'/><path id='e' d='M 0 0 L 5 5 L 5 9'/></g>
        <g id='ground' transform='matrix(1 0 0 -1 0 100)'><polyline id='d' points='0,0 10,0 10,-10 0,-10 0,0'/><text>A</text><circle id='k' cx='150' cy='0' r='10'/></g>",
    );
    for name in ["w.svg", "w"] {
        let imported = import_bytes(name, text.as_bytes(), &deep()).expect("fine");
        check(&imported.scene);
        assert_eq!(
            ids(&imported),
            ["stone-a", "stone-b", "stone-b-2", "stone-c", "ground-d", "ground-k"]
        );
        let volumes: Vec<f64> = imported.scene.blocks.iter().map(volume).collect();
        for (v, exact) in volumes.iter().zip([0.05, 0.05, 0.0025, 0.05, 0.005]) {
            assert!((v - exact).abs() < 1e-12, "{volumes:?}");
        }
        let circle = std::f64::consts::PI * 0.01 * 0.5;
        assert!((volumes[5] / circle - 1.0).abs() < 1e-3 && volumes[5] < circle, "{volumes:?}");
        let a = mesh(&imported.scene.blocks[0]).0;
        let top = a.iter().map(|v| v[2]).fold(f64::NEG_INFINITY, f64::max);
        assert!((top - 0.5).abs() < 1e-12 && a.iter().any(|v| v[2].abs() < 1e-12));
        let said: Vec<&str> = imported.findings.iter().map(|f| f.text.as_str()).collect();
        let said = said.join("\n");
        for part in
            ["1 = 0.01 m", "text 1", "\"stone-e\" at (0, 100), line 3", "\"ground\" 2 outlines"]
        {
            assert!(said.contains(part), "{part}: {said}");
        }
    }
}

/// Older programs declare the type of their documents.
#[test]
fn a_document_type_is_no_obstacle() {
    let text = format!(
        "<?xml version=\"1.0\"?>\n<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\">\n{}",
        drawing("<rect id='a' width='20' height='50'/>")
    );
    let imported = import_bytes("w", text.as_bytes(), &deep()).expect("fine");
    assert_eq!(ids(&imported), ["drawing-a"]);
}

/// Arcs are as round as those of a DXF: absolute or relative, and curves that mean the same.
#[test]
fn arcs_are_round() {
    let ring = |d: &str| {
        let text = drawing(&format!("<path d='{d}'/>"));
        volume(&import_bytes("w.svg", text.as_bytes(), &deep()).expect("fine").scene.blocks[0])
    };
    let exact = std::f64::consts::PI / 2.0 * (0.5_f64.powi(2) - 0.4_f64.powi(2)) * 0.5;
    for d in [
        "M 50 100 A 50 50 0 0 1 150 100 L 140 100 A 40 40 0 0 0 60 100 Z",
        "m 50,100 a 50,50 0 0 1 100,0 h -10 a 40 40 0 0 0 -80 0 z",
        "m 150,100 h -10 a 40 40 0 0 0 -80 0 h -10 a 50,50 0 0 1 100,0",
    ] {
        assert!((ring(d) / exact - 1.0).abs() < 1e-4, "{d}: {}", ring(d) / exact);
    }
    let [one, other] = [
        "M 0 0 Q 10 20 20 0 T 40 0 L 40 50 L 0 50 Z",
        "M 0 0 Q 10 20 20 0 Q 30 -20 40 0 L 40 50 L 0 50 Z",
    ]
    .map(ring);
    assert!((one - other).abs() < 1e-12);
}

#[test]
fn faults_are_refused_with_their_line() {
    for (content, why) in [
        ("\n<path d='M 0 0 L x'/>", "d"),
        ("\n<rect width='a'/>", "width"),
        ("\n<g transform='turn(3)'/>", "transform"),
        ("\n<g", "XML"),
    ] {
        let error = import_bytes("w.svg", drawing(content).as_bytes(), &deep()).expect_err(why);
        let text = error.to_string();
        assert!(text.contains(why) && error.position.is_some_and(|p| p.0 == 2), "{text}");
    }
    let nested = drawing(&("<g>".repeat(100_000) + &"</g>".repeat(100_000)));
    assert!(import_bytes("w.svg", nested.as_bytes(), &deep()).is_err());
    let other = import_bytes("w.svg", b"<html><svg/></html>", &deep()).expect_err("no drawing");
    assert!(other.to_string().contains("html"));
    let hidden = drawing(
        "<g style='display: none'><rect width='1' height='1'/></g><rect width='2' height='2'/>",
    );
    let imported = import_bytes("w.svg", hidden.as_bytes(), &deep()).expect("fine");
    assert!(imported.findings.iter().any(|f| f.text.contains("hidden g 1")));
    assert_eq!(imported.scene.blocks.len(), 1);
}

/// Drawings of svgwrite: `tests/formats/make.py`.
#[test]
fn drawings_of_another_program_are_read() {
    let read = |name: &str| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/formats/");
        let bytes = std::fs::read(format!("{folder}{name}")).expect("a drawing of the repository");
        let layers = [("ground".to_string(), "support".parse().expect("a rule"))].into();
        import_bytes(name, &bytes, &ImportOptions { layers, ..deep() })
    };
    let volumes = |name: &str| -> Vec<f64> {
        let scene = read(name).expect("a scene").scene;
        check(&scene);
        assert!(scene.blocks.iter().any(|b| b.support), "{name}");
        scene.blocks.iter().filter(|b| !b.support).map(volume).collect()
    };
    let near = |name: &str, exact: &[f64], share: f64| {
        let all = volumes(name);
        assert_eq!(all.len(), exact.len(), "{name}");
        for (v, e) in all.iter().zip(exact) {
            assert!((v / e - 1.0).abs() < share, "{name}: {v} for {e}");
        }
    };
    // 4000 units are 200 mm: each 0.05 mm.
    near(
        "piers-mm.svg",
        &[0.5 * 500.0 * 1900.0 * 2.5e-9; 2]
            .into_iter()
            .chain([0.5 * 2500.0 * 400.0 * 2.5e-9])
            .collect::<Vec<_>>(),
        1e-12,
    );
    near(
        "arch-cm.svg",
        &[std::f64::consts::PI / 14.0 * (0.25_f64.powi(2) - 0.2_f64.powi(2)) * 0.5; 7],
        1e-4,
    );
    near("turned-mm.svg", &[0.5 * 20.0 * 40.0 * 1e-6], 1e-12);
    let said = |name: &str| -> String {
        let findings = read(name).expect("a scene").findings;
        findings.iter().map(|f| f.text.clone()).collect::<Vec<_>>().join("\n")
    };
    for (name, parts) in [
        ("faults-px.svg", &["in pixels", "drawn twice", "at (10, 290)", "text 1"][..]),
        ("faults-hidden-mm.svg", &["hidden g 1", "rect with round corners 1"]),
    ] {
        let said = said(name);
        parts.iter().for_each(|part| assert!(said.contains(part), "{part}: {said}"));
    }
    let empty = read("faults-empty-mm.svg").expect_err("nothing is closed").to_string();
    assert!(empty.contains("ground"), "{empty}");
}
