//! Thrusts on supports, lines of thrust and geometric safety factors: closed forms and linear
//! programming, with proof.

use crate::ask::{close, cuboid, fixed, model, prism, prove, scene, template};
use serde_json::{Value, json};
use voussoir::{
    analysis::{
        Control, Law, Outcome,
        thrust::{Ends, answer, bearing_supports, outwards},
    },
    proof::{ResultFile, saved, thrust::ThrustAnswer},
    report::{drawing, view::View},
    scene::Scene,
    verdict::{Verdict, thrust::ThrustAt},
};

const NO_SLIDING: f64 = f64::INFINITY;

fn associative() -> Control {
    Control { law: Law::Associative, ..Control::default() }
}

/// The answer about a support (the first, outwards, where nothing is said), proved from the scene
/// alone.
fn ask_at(
    scene: &Scene,
    support: Option<&str>,
    direction: Option<[f64; 3]>,
    control: &Control,
) -> ResultFile {
    let m = model(scene);
    let support = support
        .map_or_else(|| bearing_supports(&m).first().copied(), |id| m.assembly.find(id))
        .expect("a support");
    let direction = direction.unwrap_or_else(|| outwards(&m, support).expect("a direction").into());
    let file =
        saved::thrust(scene, &m, &answer(&m, ThrustAt { support, direction }, Ends::Both, control))
            .unwrap();
    prove(scene, &file);
    file
}

fn ask(scene: &Scene) -> ThrustAnswer {
    ask_at(scene, None, None, &associative()).answer.thrust().expect("it stands").clone()
}

/// Least and greatest thrust, which must both be found.
fn range(scene: &Scene) -> [f64; 2] {
    let t = ask(scene);
    [t.least, t.greatest].map(|e| e.value.unwrap_or_else(|| panic!("{t:?}")))
}

fn arch(friction: f64, parameters: Value) -> Scene {
    let mut arch = json!({ "radius": 1, "thickness": 0.15, "depth": 1, "voussoirs": 16 });
    for (key, value) in parameters.as_object().unwrap() {
        arch[key] = value.clone();
    }
    template(friction, json!({ "arch": arch }), json!({}))
}

fn flat_arch(friction: f64, center_depth: Option<f64>) -> Scene {
    let mut arch = json!({ "span": 3, "height": 1, "depth": 1, "voussoirs": 3 });
    if let Some(depth) = center_depth {
        arch["center_depth"] = json!(depth);
    }
    template(friction, json!({ "flat_arch": arch }), json!({}))
}

#[test]
fn thrust_of_arches() {
    // B28: semicircle; B32: two centres, e / R = 0.25. Linear programming; the concept: Heyman
    // (1966).
    for (case, parameters, least, greatest) in [
        ("B28", json!({}), 0.08267111462200738, 0.10680824496837434),
        (
            "B32",
            json!({ "profile": "pointed", "eccentricity": 0.25 }),
            0.04421605282336581,
            0.0750615919098961,
        ),
    ] {
        let [low, high] = range(&arch(NO_SLIDING, parameters));
        close(case, low, least, 1e-8);
        close(case, high, greatest, 1e-8);
    }
}

#[test]
fn thrust_of_flat_arches() {
    // A27, A28: with vertical joints max(w L² / (9 t), w L / (2 μ)); nothing limits it from above.
    for (friction, least) in [(2.0, 1.0), (0.6, 2.5)] {
        let t = ask(&flat_arch(friction, None));
        close("A27, A28", t.least.value.unwrap(), least, 1e-8);
        assert_eq!((t.greatest.status, t.greatest.value), (Outcome::Unbounded, None));
        // The line of thrust of an endless thrust is straight.
        let factor = t.geometric_factor.unwrap();
        assert!(factor.value.is_none() && factor.lower >= 999.0, "{factor:?}");
    }
    // A29: joints through one point 2 m below: without friction the thrust is w c, the only one;
    // with friction it may be less.
    let [low, high] = range(&flat_arch(0.0, Some(2.0)));
    close("A29", low, 2.0, 1e-8);
    close("A29", high, 2.0, 1e-8);
    close("A29, friction 0.5", range(&flat_arch(0.5, Some(2.0)))[0], 0.75, 1e-8);
}

#[test]
fn thrust_of_a_flying_buttress() {
    // B41: a straight bar of vertical depth τ over a span L: w L² / (8 τ) with w = τ, whatever its
    // slope (Heyman 1966).
    let part = |from: f64, to: f64| {
        [[from, 0.6 * from], [to, 0.6 * to], [to, 0.6 * to + 0.7], [from, 0.6 * from + 0.7]]
    };
    let mut blocks =
        vec![fixed(prism("left", &part(-1.0, 0.0))), fixed(prism("right", &part(6.0, 7.0)))];
    blocks.extend((0..6).map(|k| prism(&format!("b{k}"), &part(f64::from(k), f64::from(k + 1)))));
    let t = ask(&scene(NO_SLIDING, json!(blocks), json!({})));
    close("B41", t.least.value.unwrap(), 4.5, 1e-8);
    assert_eq!(t.direction, Some([-1.0, 0.0, 0.0]));
}

#[test]
fn a_block_wedged_between_two_walls() {
    // Two faces of 1 m² hold the weight 1: 2 (μ N + c A) ≥ W.
    for (friction, cohesion) in [(0.5, 0.0), (0.5, 0.2)] {
        let wall = |id: &str, x: f64| fixed(cuboid(id, [1.0, 1.0, 1.0], [x, 0.0, 0.0]));
        let blocks = json!([
            wall("left", -1.0),
            wall("right", 1.0),
            cuboid("block", [1.0, 1.0, 1.0], [0.0, 0.0, 0.0])
        ]);
        let more =
            json!({ "joints": { "default": { "friction": friction, "cohesion": cohesion } } });
        let t = ask(&scene(friction, blocks, more));
        close(
            "wedged block",
            t.least.value.unwrap(),
            (1.0 - 2.0 * cohesion) / (2.0 * friction),
            1e-7,
        );
        assert_eq!(t.greatest.status, Outcome::Unbounded);
        assert_eq!(t.geometric_factor.is_some(), cohesion == 0.0);
    }
}

#[test]
fn a_line_of_thrust_by_hand() {
    // A block of width b and height h, pushed sideways by H at its top: e = H h / W at the bottom,
    // factor (b / 2) / e.
    let (b, h, push) = (1.0, 2.0, 0.3);
    let load = json!({ "loads": { "dead": [{ "block": "block", "force": [push, 0, 0], "at": [0, 0, h] }] } });
    let ground = crate::ask::ground();
    let s = scene(1.0, json!([ground, cuboid("block", [b, 1.0, h], [0.0, 0.0, 0.0])]), load);
    let file = ask_at(&s, Some("ground"), Some([1.0, 0.0, 0.0]), &associative());
    let t = file.answer.thrust().unwrap().clone();
    close("statically determinate", t.least.value.unwrap(), push, 1e-9);
    close("statically determinate", t.greatest.value.unwrap(), push, 1e-9);
    let e = push * h / (b * h);
    close("factor", t.geometric_factor.unwrap().value.unwrap(), 0.5 * b / e, 1e-8);
    let line = file.thrust.clone().unwrap().sections[0].least.unwrap();
    close("eccentricity", line.eccentricity, e, 1e-9);
    close("used", line.used, e / (0.5 * b), 1e-9);
    close("normal", line.normal, b * h, 1e-9);
    close("shear", line.shear, push, 1e-9);
    assert!(line.inside && !line.in_kern && (line.at[0] - e).abs() < 1e-9, "{line:?}");
}

#[test]
fn the_factor_of_an_arch_is_its_thickness_over_the_least() {
    // At its least thickness 0.107076203 the factor is 1; near it the weights hardly differ from
    // those of the thinner arch.
    for thickness in [0.1075, 0.12] {
        let factor = ask(&arch(NO_SLIDING, json!({ "thickness": thickness })))
            .geometric_factor
            .unwrap()
            .value
            .unwrap();
        let ratio = thickness / 0.10707620314306167;
        assert!((factor / ratio - 1.0).abs() < 0.01 * (ratio - 1.0), "{factor} against {ratio}");
    }
}

#[test]
fn hinges_alternate_where_the_thrust_is_least() {
    // Least: crown at the extrados, haunches at the intrados (Heyman 1966); the horizontal force is
    // the same at every section.
    let file = ask_at(&arch(NO_SLIDING, json!({})), None, None, &associative());
    let least = file.answer.thrust().unwrap().least.value.unwrap();
    let sections = file.thrust.clone().unwrap().sections;
    let hinges: Vec<_> =
        sections.iter().filter_map(|s| s.least).filter(|l| l.used > 1.0 - 1e-4).collect();
    assert!(hinges.len() >= 3, "{}", hinges.len());
    for l in &hinges {
        let radius = l.at[0].hypot(l.at[2]);
        let crown = l.at[2] > 0.95;
        assert_eq!(radius > 1.0, crown, "{l:?}");
    }
    for l in sections.iter().filter_map(|s| s.least) {
        assert!(l.inside && l.normal.hypot(l.shear) >= least * (1.0 - 1e-9), "{l:?}");
    }
}

#[test]
fn every_equilibrium_lies_in_the_range() {
    let s = arch(0.7, json!({}));
    let m = model(&s);
    let [low, high] = range(&s);
    let support = bearing_supports(&m).first().copied().unwrap();
    let at = ThrustAt { support, direction: outwards(&m, support).unwrap().into() };
    let some = voussoir::analysis::assess(&m, &associative());
    let value = at.value(&m.interfaces, &some.forces);
    assert!(low <= value && value <= high, "{value} in {low} to {high}");
}

#[test]
fn units_directions_and_reductions_do_not_change_a_thrust() {
    let base = range(&arch(0.7, json!({})));
    let near = |what: &str, got: [f64; 2], want: [f64; 2]| {
        assert!(
            (0..2).all(|k| (got[k] - want[k]).abs() <= 1e-8 * want[k].abs()),
            "{what}: {got:?} expected {want:?}"
        );
    };
    let large = range(&arch(0.7, json!({ "radius": 1e3, "thickness": 150, "depth": 1e3 })));
    near("size", large.map(|v| v * 1e-9), base);
    let mut heavy = arch(0.7, json!({}));
    heavy.materials.values_mut().for_each(|m| m.density = 1e6);
    near("density", range(&heavy).map(|v| v * 1e-6), base);
    let ends = |file: ResultFile| {
        let t = file.answer.thrust().unwrap().clone();
        [t.least.value.unwrap(), t.greatest.value.unwrap()]
    };
    let s = arch(0.7, json!({}));
    near("the other support", ends(ask_at(&s, Some("springer_right"), None, &associative())), base);
    let inwards = ends(ask_at(&s, None, Some([1.0, 0.0, 0.0]), &associative()));
    near("inwards", [-inwards[1], -inwards[0]], base);
    let full = ends(ask_at(&s, None, None, &Control { keep_all: true, ..associative() }));
    near("in full", full, base);
    // Across the arch only friction between its two springers can act.
    let across = ends(ask_at(&s, None, Some([0.0, 1.0, 0.0]), &associative()));
    assert!((across[0] + across[1]).abs() < 1e-6 && across[1] > 0.0, "{across:?}");
}

#[test]
fn what_falls_has_no_thrust() {
    let file = ask_at(&arch(NO_SLIDING, json!({ "thickness": 0.1 })), None, None, &associative());
    assert!(file.answer.thrust().is_none() && file.answer.verdict() == Some(Verdict::Unstable));
}

#[test]
fn forged_thrusts_are_refused() {
    let s = arch(NO_SLIDING, json!({ "voussoirs": 8 }));
    let file = ask_at(&s, None, None, &associative());
    crate::ask::leaves_hold(&file);
    let ends = |v: &mut Value, k: usize| v["evidence"]["thrust"]["ends"][k].take();
    let edits: [crate::ask::Edit; 6] = [
        ("the support", &|v| v["question"]["thrust"]["support"] = json!("springer_right")),
        ("the direction", &|v| v["question"]["thrust"]["direction"] = json!([1.0, 0.0, 0.0])),
        ("forces", &|v| {
            let mut own = ends(v, 0);
            let force = &mut own["forces"][2]["forces"][0][2];
            *force = json!(force.as_f64().unwrap() * 1.001);
            v["evidence"]["thrust"]["ends"][0] = own;
        }),
        ("rates", &|v| {
            let mut own = ends(v, 1);
            let rate = &mut own["rates"][3]["velocity"][0];
            *rate = json!(rate.as_f64().unwrap() + 0.1);
            v["evidence"]["thrust"]["ends"][1] = own;
        }),
        ("the other end", &|v| {
            v["evidence"]["thrust"]["ends"][1] = v["evidence"]["thrust"]["ends"][0].clone();
        }),
        ("the shrunk sections", &|v| {
            v["evidence"]["thrust"]["shrunk"][1]["value"] = json!(0.3);
        }),
    ];
    crate::ask::edits_are_refused(&s, &file, &edits);
    prove(&s, &file);
    // A factor beside the sections that were shrunk is none.
    let mut value = file.to_value().unwrap();
    value["evidence"]["thrust"]["factor"] = json!(3.0);
    crate::ask::told(&mut value);
    assert!(value["answer"]["thrust"]["geometric_factor"].get("value").is_none());
}

#[test]
fn drawings_hold_every_block_and_both_lines() {
    let mut s = arch(NO_SLIDING, json!({ "voussoirs": 8 }));
    s.name = "a < b & c".into();
    let m = model(&s);
    let support = bearing_supports(&m).first().copied().unwrap();
    let at = ThrustAt { support, direction: outwards(&m, support).unwrap().into() };
    let file = saved::thrust(&s, &m, &answer(&m, at, Ends::Both, &associative())).unwrap();
    let text = drawing::svg(&View::new(&m, &file, Vec::new()).unwrap(), Default::default());
    assert_eq!(text.matches("<g class=\"block\">").count(), 8);
    assert_eq!(text.matches("<g class=\"support\">").count(), 2);
    assert!(
        text.contains("a &lt; b &amp; c")
            && text.contains("class=\"line one\"")
            && text.contains("class=\"line two\"")
    );
    assert!(
        !text.contains("NaN")
            && !text.contains("inf")
            && text.matches("class=\"pin one\"").count() >= 3
    );
    // Every element that is opened is closed.
    assert_eq!(text.matches("<g ").count(), text.matches("</g>").count());
}
