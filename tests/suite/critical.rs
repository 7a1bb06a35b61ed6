//! Critical values: least thickness, least friction, least width, against closed forms and linear
//! programming.

use crate::ask::{model, prove, template};
use serde_json::{Value, json};
use voussoir::{
    analysis::{
        Control, Critical, Law, critical,
        critical::{Method, Range},
    },
    proof::{ResultFile, saved},
    scene::Scene,
    verdict::Verdict,
};

const NO_SLIDING: f64 = f64::INFINITY;
const THICKNESS: &str = "/templates/0/arch/thickness";
const FRICTION: &str = "/joints/default/friction";

/// Asks by the associative law, and proves the answer from the scene alone.
fn ask(scene: &Scene, pointer: &str, from: f64, to: f64, scan: usize) -> (Critical, ResultFile) {
    let control = Control { law: Law::Associative, ..Control::default() };
    let range = Range { pointer: pointer.into(), from, to, scan: Some(scan) };
    let answer = critical(scene, &range, &control).unwrap_or_else(|e| panic!("{e}"));
    let file = saved::critical(scene, &model(scene), &answer).unwrap();
    prove(scene, &file);
    (answer, file)
}

/// The only flip in a range of half to twice the value: falls below, stands above.
fn least(what: &str, scene: &Scene, pointer: &str, want: f64, tolerance: f64) -> f64 {
    let (_, file) = ask(scene, pointer, 0.5 * want, 2.0 * want, 7);
    let [found] = file.answer.critical().unwrap() else { panic!("{what}: {:?}", file.answer) };
    println!(
        "{what}: {:.14}, expected {want:.14}: off by {:.1e}; {} to {}",
        found.value,
        found.value - want,
        found.lower,
        found.upper
    );
    assert_eq!((found.below, found.above), (Verdict::Unstable, Verdict::Stable), "{what}");
    assert!((found.value - want).abs() <= tolerance, "{what}: {} expected {want}", found.value);
    assert!(found.lower < want + tolerance && want - tolerance < found.upper, "{what}: {found:?}");
    assert_eq!(file.critical.as_ref().unwrap().flips[0].method, Method::Margin, "{what}");
    found.value
}

fn arch(friction: f64, parameters: Value) -> Scene {
    let mut arch = json!({ "radius": 1, "thickness": 0.15, "depth": 1 });
    for (key, value) in parameters.as_object().unwrap() {
        arch[key] = value.clone();
    }
    template(friction, json!({ "arch": arch }), json!({}))
}

/// The value of a case is the one that the reference file has.
fn reference(case: &str, value: f64) {
    let file = crate::reference::cases();
    let expected =
        &file["cases"].as_array().unwrap().iter().find(|c| c["id"] == case).unwrap()["expected"];
    let there = ["critical", "value", "min"].iter().find_map(|k| expected[*k].as_f64()).unwrap();
    assert_eq!(value, there, "{case}: transcribed");
}

#[test]
fn least_thickness_of_circular_arches() {
    // Five-hinge closed form (even N) and linear programming (odd N) for straight chords;
    // Milankovitch, Zeitschrift für Mathematik und Physik 55 (1907): 0.107478038 for a semicircle
    // of infinitely many voussoirs.
    for (case, voussoirs, embrace_deg, value) in [
        ("B08", 7, 180.0, 0.09570345392150328),
        ("B01", 8, 180.0, 0.09997167404660162),
        ("B02", 16, 180.0, 0.10707620314306167),
        ("B06", 24, 180.0, 0.1070963827484465),
        ("B09", 27, 180.0, 0.10672090355137132),
        ("B03", 32, 180.0, 0.10719700209534225),
        ("B04", 64, 180.0, 0.10738320250302051),
        ("B12", 14, 157.5, 0.06332773901334111),
    ] {
        reference(case, value);
        let scene = arch(NO_SLIDING, json!({ "voussoirs": voussoirs, "embrace_deg": embrace_deg }));
        let found = least(case, &scene, THICKNESS, value, 1e-9 * value);
        let limit = if embrace_deg == 180.0 { 0.10747803810747632 } else { 0.06465585771655445 };
        assert!(
            (found - limit).abs() < 2.0 / f64::from(voussoirs),
            "{case}: {found} against {limit} for infinitely many"
        );
    }
}

#[test]
fn least_thickness_goes_to_that_of_the_ring() {
    // B15: rings of infinitely many voussoirs by half opening angle, after Milankovitch; 96
    // straight voussoirs.
    for (half, value) in
        [(45.0, 0.007496123448368602), (60.0, 0.02284890993937951), (90.0, 0.10747803810747632)]
    {
        let scene = arch(NO_SLIDING, json!({ "voussoirs": 96, "embrace_deg": 2.0 * half }));
        let (_, file) = ask(&scene, THICKNESS, 0.5 * value, 2.0 * value, 5);
        let found = file.answer.critical().unwrap()[0].value;
        println!("half angle {half}: {found} for 96 voussoirs, {value} for infinitely many");
        assert!((found / value - 1.0).abs() < 5e-3, "{found} against {value}");
    }
}

#[test]
fn least_friction_of_semicircles() {
    // Linear programming. For infinitely many voussoirs of a thick ring 0.309215 (Cocchetti &
    // Rizzi, Frattura ed Integrità Strutturale 51, 2020).
    for (case, voussoirs, thickness, value) in [
        ("B20", 16, 0.15, 0.35313179457625665),
        ("B21", 32, 0.25, 0.30918286138421536),
        ("B22", 16, 0.2, 0.30790408345637843),
    ] {
        reference(case, value);
        let scene = arch(0.5, json!({ "voussoirs": voussoirs, "thickness": thickness }));
        least(case, &scene, FRICTION, value, 1e-8);
    }
    let scene = arch(0.5, json!({ "voussoirs": 64, "thickness": 0.25 }));
    let (_, file) = ask(&scene, FRICTION, 0.2, 0.5, 4);
    // B25.
    assert!((file.answer.critical().unwrap()[0].value - 0.309215444330229).abs() < 1e-4);
}

#[test]
fn least_thickness_of_other_arches() {
    // B26: configuration of Gilbert, Casapulla & Ahmed (2006). B32: two centres, e / R = 0.25
    // (class of Makris & Nikolic 2017). B34: b / a = 0.8 (class of Alexakis & Makris 2013). B43:
    // vertical joints (class of Makris & Alexakis 2013). Linear programming.
    for (case, friction, parameters, value) in [
        ("B26", 0.36, json!({ "voussoirs": 27 }), 0.1408908492734099),
        (
            "B32",
            NO_SLIDING,
            json!({ "voussoirs": 16, "profile": "pointed", "eccentricity": 0.25 }),
            0.06343091660240589,
        ),
        (
            "B34",
            NO_SLIDING,
            json!({ "voussoirs": 16, "profile": "elliptical", "radius": null, "span": 2, "rise": 0.8 }),
            0.10746235331988147,
        ),
        (
            "B43",
            NO_SLIDING,
            json!({ "voussoirs": 24, "joints": "vertical", "thickness_along": "normal" }),
            0.10894485320760622,
        ),
    ] {
        reference(case, value);
        least(case, &arch(friction, parameters), THICKNESS, value, 1e-8);
    }
    let pointed = arch(0.5, json!({ "voussoirs": 16, "profile": "pointed", "eccentricity": 0.25 }));
    least("B32, least friction at 0.15", &pointed, FRICTION, 0.2463544710444694, 1e-8);
}

#[test]
fn least_width_of_buttresses() {
    // B39: class of Ochsendorf (2002); linear programming; the same without sliding.
    reference("B39", 0.6607716013125127);
    for friction in [0.6, NO_SLIDING] {
        let scene = arch(
            friction,
            json!({ "radius": 2, "thickness": 0.3, "voussoirs": 16, "buttresses": { "width": 1, "height": 4 } }),
        );
        least("B39", &scene, "/templates/0/arch/buttresses/width", 0.6607716013125127, 1e-8);
    }
}

#[test]
fn a_greatest_value_is_found_as_well() {
    // A block of width 1 on a slope given by gravity (x, −1) slides at x = μ; the range is given
    // downwards.
    let scene = crate::ask::scene(
        0.5,
        json!([
            crate::ask::ground(),
            crate::ask::cuboid("block", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0])
        ]),
        json!({}),
    );
    let (_, file) = ask(&scene, "/gravity/0", 2.0, 0.0, 6);
    let found = file.answer.critical().unwrap()[0];
    assert!((found.value - 0.5).abs() < 1e-9, "{}", found.value);
    assert_eq!((found.below, found.above), (Verdict::Stable, Verdict::Unstable));
}

#[test]
fn every_flip_of_the_scan_is_found() {
    // The same slope on both sides: it slides at −μ and at μ.
    let scene = crate::ask::scene(
        0.5,
        json!([
            crate::ask::ground(),
            crate::ask::cuboid("block", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0])
        ]),
        json!({}),
    );
    let (_, file) = ask(&scene, "/gravity/0", -1.0, 2.0, 10);
    let values: Vec<f64> = file.answer.critical().unwrap().iter().map(|c| c.value).collect();
    assert_eq!(values.len(), 2);
    assert!((values[0] + 0.5).abs() < 1e-9 && (values[1] - 0.5).abs() < 1e-9, "{values:?}");
}

/// Two stones that wedge each other: they fall, stand only with self-stress and stand within a tenth
/// of a thousandth of friction, between two values of the scan.
#[test]
fn two_flips_between_neighbours_of_the_scan_are_both_found() {
    let c01 = json!({ "id": "c01", "density": 2000, "shape": { "polyhedron": {
        "vertices": [[0.0, 1.4, 0.3], [0.0, 1.4, 0.0], [0.0, 1.0, 0.0], [2.8, 0.9, 0.0],
            [2.8, 1.4, 0.0], [2.8, 1.4, 0.4], [1.1, 0.0, 0.0], [1.8, 0.0, 0.0], [1.5, 0.0, 0.2],
            [1.7, 1.4, 1.2]],
        "faces": [[0, 1, 2], [3, 4, 5], [6, 7, 8], [1, 0, 9, 5, 4], [2, 1, 4, 3, 7, 6],
            [5, 9, 8, 7, 3], [2, 6, 8, 9, 0]] } } });
    let c03 = json!({ "id": "c03", "density": 2000, "shape": { "polyhedron": {
        "vertices": [[2.8, 0.0, 0.0], [2.8, 0.9, 0.0], [2.8, 1.0, 0.1], [2.8, 0.0, 1.6],
            [1.8, 0.0, 0.0], [2.6, 0.0, 1.7], [2.4, 0.0, 1.7], [1.5, 0.0, 0.2], [2.4, 0.1, 1.7],
            [1.3, 0.8, 1.0]],
        "faces": [[0, 1, 2, 3], [4, 0, 3, 5, 6, 7], [1, 0, 4], [6, 5, 8], [1, 4, 7, 9, 2],
            [7, 6, 8, 9], [2, 9, 8, 5, 3]] } } });
    let ground = crate::ask::fixed(crate::ask::cuboid("G", [4.8, 3.4, 1.0], [1.4, 0.7, -1.0]));
    let loads = json!({ "loads": { "dead": [{ "weight": [-0.4, 0.0, 0.0] }] } });
    let scene = crate::ask::scene(0.6, json!([ground, c01, c03]), loads);
    let range =
        Range { pointer: "/joints/default/friction".into(), from: 0.02, to: 1.2, scan: Some(9) };
    let answer = critical(&scene, &range, &Control::default()).unwrap();
    let file = saved::critical(&scene, &model(&scene), &answer).unwrap();
    prove(&scene, &file);
    let found = file.answer.critical().unwrap();
    let turns: Vec<[Verdict; 2]> = found.iter().map(|c| [c.below, c.above]).collect();
    assert_eq!(
        turns,
        [[Verdict::Unstable, Verdict::Conditional], [Verdict::Conditional, Verdict::Stable]]
    );
    assert!((found[0].value - 0.402625350).abs() < 1e-8 && found[1].value < 0.4029, "{found:?}");
}

/// A load of exactly zero makes no scene: that value is left out, and no end of the range.
#[test]
fn one_value_that_makes_no_scene_is_left_out() {
    let scene = crate::ask::scene(
        0.5,
        json!([
            crate::ask::ground(),
            crate::ask::cuboid("block", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0])
        ]),
        json!({ "loads": { "dead": [{ "weight": [0.1, 0.0, 0.0] }] } }),
    );
    let (answer, file) = ask(&scene, "/loads/dead/0/weight/0", -0.3, 0.3, 7);
    assert_eq!(answer.scan.iter().filter(|s| s.outcome.is_err()).count(), 1);
    assert_eq!(file.critical.as_ref().unwrap().exhausted(), Some(Verdict::Stable));
}

#[test]
fn a_window_between_the_values_of_the_scan_is_not_missed() {
    // Stands between −0.02 and 0.02 only; the scan hits −1, −0.2, 0.6 and 1.4.
    let scene = crate::ask::scene(
        0.02,
        json!([
            crate::ask::ground(),
            crate::ask::cuboid("block", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0])
        ]),
        json!({}),
    );
    let (answer, file) = ask(&scene, "/gravity/0", -1.0, 1.4, 4);
    assert!(answer.scan.iter().all(|s| matches!(s.outcome, Ok((Verdict::Unstable, _)))));
    let values: Vec<f64> = file.answer.critical().unwrap().iter().map(|c| c.value).collect();
    assert!(
        values.len() == 2 && (values[0] + 0.02).abs() < 1e-9 && (values[1] - 0.02).abs() < 1e-9,
        "{values:?}"
    );
}

#[test]
fn units_do_not_change_a_critical_value() {
    let base = json!({ "voussoirs": 16 });
    let value = |density: f64, scale: f64| {
        let mut parameters = base.clone();
        (parameters["radius"], parameters["thickness"], parameters["depth"]) =
            (json!(scale), json!(0.2 * scale), json!(scale));
        let mut scene = arch(NO_SLIDING, parameters);
        for material in scene.materials.values_mut() {
            material.density = density;
        }
        let (_, file) = ask(&scene, THICKNESS, 0.05 * scale, 0.3 * scale, 5);
        file.answer.critical().unwrap()[0].value / scale
    };
    let here = value(1.0, 1.0);
    for (density, scale) in [(2400.0, 1.0), (1.0, 1e3), (1e-3, 1e-3)] {
        let there = value(density, scale);
        assert!(
            (there / here - 1.0).abs() < 1e-9,
            "density {density}, scale {scale}: {there} against {here}"
        );
    }
}

#[test]
fn counts_are_counted() {
    // Least thickness by number of voussoirs: 7 0.0957, 8 0.09997, 16 0.1071 (tables above): at
    // 0.097 it falls from 8 on.
    let scene = arch(NO_SLIDING, json!({ "voussoirs": 7, "thickness": 0.097 }));
    let control = Control { law: Law::Associative, ..Control::default() };
    let range =
        Range { pointer: "/templates/0/arch/voussoirs".into(), from: 7.0, to: 12.0, scan: None };
    let answer = critical(&scene, &range, &control).unwrap();
    assert!(answer.whole && answer.scan.len() == 6);
    let file = saved::critical(&scene, &model(&scene), &answer).unwrap();
    prove(&scene, &file);
    let found = file.answer.critical().unwrap();
    assert_eq!((found[0].lower, found[0].upper), (7.0, 8.0), "{found:?}");
}

#[test]
fn without_a_flip_both_ends_are_proved() {
    let scene = arch(NO_SLIDING, json!({ "voussoirs": 16 }));
    let (_, file) = ask(&scene, THICKNESS, 0.12, 0.2, 3);
    assert_eq!(file.answer.critical(), Some(&[][..]));
    assert_eq!(file.critical.as_ref().unwrap().exhausted(), Some(Verdict::Stable));
}

#[test]
fn values_without_a_scene_are_told() {
    // An arch as thick as its diameter is none.
    let scene = arch(NO_SLIDING, json!({ "voussoirs": 8 }));
    let (answer, file) = ask(&scene, THICKNESS, 0.05, 4.0, 9);
    assert!(answer.scan.iter().any(|s| s.outcome.is_err()));
    assert_eq!(file.answer.critical().unwrap().len(), 1);
    let control = Control::default();
    let range =
        |pointer: &str| Range { pointer: pointer.into(), from: 5.0, to: 6.0, scan: Some(3) };
    assert!(critical(&scene, &range(THICKNESS), &control).is_err());
    assert!(critical(&scene, &range("/templates/0/arch/thicknes"), &control).is_err());
}

#[test]
fn forged_critical_values_are_refused() {
    let scene = arch(NO_SLIDING, json!({ "voussoirs": 8 }));
    let (_, file) = ask(&scene, THICKNESS, 0.05, 0.2, 4);
    crate::ask::leaves_hold(&file);
    let flip = |v: &mut Value| v["evidence"]["critical"]["flips"][0].take();
    crate::ask::edits_are_refused(
        &scene,
        &file,
        &[
            ("a side", &|v| v["evidence"]["critical"]["flips"][0]["below"]["value"] = json!(0.15)),
            ("the sides", &|v| {
                let mut own = flip(v);
                own["below"]["standing"] = own["above"]["standing"].clone();
                v["evidence"]["critical"]["flips"][0] = own;
            }),
            ("forces", &|v| {
                let mut own = flip(v);
                let certificate = &mut own["above"]["standing"]["certificate"];
                let force = &mut certificate["forces"][0]["forces"][0][2];
                *force = json!(force.as_f64().unwrap() * 1.01);
                v["evidence"]["critical"]["flips"][0] = own;
            }),
            ("the pointer", &|v| {
                v["question"]["critical"]["vary"] = json!("/templates/0/arch/radius");
            }),
            ("a value of the scan", &|v| {
                v["evidence"]["critical"]["scan"][0]["verdict"] = json!("stable");
            }),
        ],
    );
    let other = arch(NO_SLIDING, json!({ "voussoirs": 16 }));
    assert!(!crate::ask::check(&other, &file).proved());
}
