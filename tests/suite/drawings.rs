//! Drawings become scenes whose joints close.

use std::f64::consts::PI;
use voussoir::{
    error::FindingCode,
    import::{ImportOptions, import_bytes},
    interface::{Model, prepare},
    scene::Friction,
};

/// A closed polyline: corners with the bulge after each.
fn outline(layer: &str, handle: &str, corners: &[(f64, f64, f64)]) -> String {
    let points: String =
        corners.iter().map(|(x, y, b)| format!("10\n{x}\n20\n{y}\n42\n{b}\n")).collect();
    format!("0\nLWPOLYLINE\n5\n{handle}\n8\n{layer}\n70\n1\n{points}")
}

/// A ring of a semicircular arch; its faces are arcs.
fn ring(name: &str, voussoirs: usize, inner: f64, outer: f64) -> String {
    let step = PI / voussoirs as f64;
    let bulge = (step / 4.0).tan();
    let voussoir = |k: usize| {
        let (a, b) = (k as f64 * step, (k + 1) as f64 * step);
        let at = |r: f64, t: f64, bulge: f64| (r * t.cos(), r * t.sin(), bulge);
        let corners =
            [at(inner, b, -bulge), at(inner, a, 0.0), at(outer, a, bulge), at(outer, b, 0.0)];
        outline(name, &format!("{k}"), &corners)
    };
    (0..voussoirs).map(voussoir).collect()
}

/// Two rings on two springers, in units of so many metres.
fn rings(inner: usize, outer: usize, unit: (u8, f64)) -> Model {
    let (code, metres) = unit;
    let length = |m: f64| m / metres;
    let springer = |name: &str, x: f64| {
        let [x, w] = [x, 1.0].map(length);
        outline("ground", name, &[(x, -w, 0.0), (x + w, -w, 0.0), (x + w, 0.0, 0.0), (x, 0.0, 0.0)])
    };
    let [a, b, c] = [4.0, 4.5, 5.0].map(length);
    let text = format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{code}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}{}{}{}0\nENDSEC\n0\nEOF\n",
        ring("inner", inner, a, b),
        ring("outer", outer, b, c),
        springer("l", -5.0),
        springer("r", 4.0),
    );
    let options = ImportOptions {
        depth: Some(0.5),
        layers: [("ground".into(), "support".parse().expect("a rule"))].into(),
        friction: Some(Friction::Coefficient(0.6)),
        ..ImportOptions::default()
    };
    let scene = import_bytes("rings.dxf", text.as_bytes(), &options).expect("a scene").scene;
    prepare(&scene).expect("a model")
}

/// Rings of voussoirs of other lengths meet on an arc: chords lie so near to it that all that face each
/// other touch, in any unit.
#[test]
fn rings_of_other_division_touch_all_along() {
    for (inner, outer) in [(9, 9), (9, 7), (9, 23)] {
        for unit in [(6, 1.0), (4, 1e-3)] {
            let model = rings(inner, outer, unit);
            let ids = |i: usize| model.assembly.blocks[i].id.as_str();
            for k in 0..inner {
                for l in 0..outer {
                    let [a, b] = [k, l].map(|k| k as f64);
                    let [n, m] = [inner, outer].map(|n| n as f64);
                    let common = ((a + 1.0) / n).min((b + 1.0) / m) - (a / n).max(b / m);
                    let [one, two] = [format!("inner-{k}"), format!("outer-{l}")];
                    let area: f64 = model
                        .interfaces
                        .list
                        .iter()
                        .filter(|f| {
                            let pair = [ids(f.a), ids(f.b)];
                            pair.contains(&one.as_str()) && pair.contains(&two.as_str())
                        })
                        .map(|f| f.area)
                        .sum();
                    let exact = common.max(0.0) * PI * 4.5 * 0.5;
                    assert!((area - exact).abs() < 1e-3, "{one} {two}: {area} for {exact}");
                }
            }
            let near = |c: FindingCode| matches!(c, FindingCode::NearMiss | FindingCode::Overlap);
            let missed: Vec<_> = model.findings().filter(|f| near(f.code)).collect();
            assert!(missed.is_empty(), "{missed:?}");
        }
    }
}
