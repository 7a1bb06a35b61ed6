//! Combinations of actions, what is required, and the value of a number at which it is met: published
//! examples by hand, exact answers, other units, evidence that is touched.

use crate::ask::{asked, cuboid, edits_are_refused, fixed, leaves_hold, model};
use serde_json::{Value, json};
use voussoir::{
    analysis::{
        CombinationsOptions, KinematicOptions, LimitOptions, MeetOptions, Question, ThrustOptions,
    },
    interface::prepare,
    proof::{
        Answer, ResultFile, answer::Quantity, combinations::CombinationsAnswer, meet::MeetAnswer,
    },
    question::Verification,
    scene::{Scene, preset::PRESETS, read_str, vehicle::vehicles},
};

fn read(value: &Value) -> Scene {
    read_str("test", value.to_string()).unwrap_or_else(|e| panic!("{e}\n{value}")).0
}

fn file(scene: &Scene, question: Question) -> ResultFile {
    asked(scene, &question)
}

fn limits() -> Question {
    let ask = Box::new(LimitOptions { skip_dead: true, ..LimitOptions::default() }.into());
    CombinationsOptions { ask, only: Vec::new() }.into()
}

fn said(file: &ResultFile) -> &CombinationsAnswer {
    match &file.answer {
        Answer::Combinations(a) => a,
        other => panic!("{other:?}"),
    }
}

/// The load factor in a combination.
fn lambda(file: &ResultFile, name: &str) -> f64 {
    let one = said(file).list.iter().find(|c| c.name == name).expect("a combination");
    one.own.answer.load_factor().and_then(|l| l.value).expect("a load factor")
}

fn close(what: &str, value: f64, wanted: f64, within: f64) {
    assert!((value - wanted).abs() <= within, "{what}: {value} instead of {wanted}");
}

/// One block of a weight (kN) on the ground, g = 10 m/s²; forces in kN.
fn block(width: f64, weight: f64, friction: Value, loads: Value, combinations: Value) -> Value {
    let mut wall = cuboid("wall", [width, 1.0, 4.0], [0.0; 3]);
    wall["mass"] = json!(100.0 * weight);
    json!({
        "format": "voussoir-scene/1", "gravity": [0, 0, -10],
        "joints": { "default": { "friction": friction } },
        "blocks": [fixed(cuboid("ground", [40.0, 40.0, 1.0], [0.0, 0.0, -1.0])), wall],
        "loads": loads, "combinations": combinations,
    })
}

fn push(action: &str, kilonewtons: f64, height: f64) -> Value {
    json!({ "block": "wall", "action": action, "force": [1000.0 * kilonewtons, 0, 0],
            "at": [0, 0, height], "arm": true })
}

fn weigh(action: &str, kilonewtons: f64) -> Value {
    json!({ "block": "wall", "action": action, "force": [0, 0, -1000.0 * kilonewtons] })
}

/// Design values by eq. 6.10: 35, 20 and 3 kN give 80.4 kN (steelcalculator.pages.dev,
/// uk-load-combinations); 5553.6, 1342.5 and 42 kN give 9555.3 kN from rounded parts (eurocode.us, design
/// axial load of a column).
#[test]
fn a_preset_gives_the_published_sums() {
    for (dead, leading, other, wanted, within) in
        [(35.0, 20.0, 3.0, 80.4, 1e-9), (5553.6, 0.6 * (2279.5 - 42.0), 42.0, 9555.3, 0.15)]
    {
        let loads = json!({ "dead": [weigh("roof", other)], "live": [weigh("floors", leading)] });
        let combinations =
            json!([{ "name": "STR", "preset": "en1990_building_str", "psi": { "roof": 0.7 } }]);
        let scene = read(&block(4.0, dead, json!(0.5), loads, combinations));
        let model = model(&scene.in_combination("STR").unwrap());
        let wall = model.assembly.find("wall").unwrap();
        let down =
            -(model.assembly.dead[wall].force.z + model.assembly.live[wall].force.z) / 1000.0;
        close("design value", down, wanted, within);
        assert!(model.assembly.findings.iter().any(|f| f.text.contains("roof × 1.05")));
    }
}

/// JRC report 85029, example A.4 (Eurocode 7, design approach 2): a wall with a heel slides with a
/// utilisation of 0.730. Thrust of 201 and 13.9 kN at 20°, weights of 183 and 274 kN, tan 30° / 1.1.
#[test]
fn a_wall_with_a_heel_slides_as_published() {
    let (sine, cosine) = 20f64.to_radians().sin_cos();
    let loads = json!({
        "dead": [weigh("earth", 201.0 * sine), weigh("surcharge", 13.9 * sine)],
        "live": [push("earth", 201.0 * cosine, 0.0), push("surcharge", 13.9 * cosine, 0.0)],
    });
    let combinations = json!([{ "name": "DA2", "source": "EN 1997-1, A1 + M1 + R2",
        "factors": { "dead": 1.35, "earth": 1.35, "surcharge": 1.5 },
        "materials": { "friction": 1.1 } }]);
    let friction = json!(30f64.to_radians().tan());
    let file = file(&read(&block(3.9, 457.0, friction, loads, combinations)), limits());
    close("utilisation", 1.0 / lambda(&file, "DA2"), 0.730, 5e-4);
    assert_eq!(said(&file).list[0].own.holds(), Some(true));
}

/// A gravity wall by EN 1997-1 (test_gravity_wall_01 of xcfem/xc, after a worked example): sliding
/// 1.2600 (DA1-1) and 1.0643 (DA1-2), overturning 0.9 W / (1.1 M_G + 1.5 M_Q) = 1.425 (EQU). Coulomb's
/// coefficients with δ = φ as a horizontal thrust; the wall weighs 283.2 kN, 1.405 m behind its toe.
#[test]
fn a_gravity_wall_slides_and_tips_as_published() {
    // Thrusts (kN) and their heights (m) of earth and surcharge, friction angles divided by γφ.
    let thrust = |by: f64| {
        let k = |angle: f64| {
            let p = (angle.to_radians().tan() / by).atan();
            let root = ((2.0 * p).sin() * p.sin() / p.cos()).sqrt();
            p.cos().powi(2) / (p.cos() * (1.0 + root).powi(2))
        };
        let (upper, lower) = (k(34.0), k(29.0));
        let earth = [
            (0.5 * 4.0 * 72.0 * upper, 1.0 + 4.0 / 3.0),
            (72.0 * lower, 0.5),
            (10.0 * lower, 1.0 / 3.0),
        ];
        (earth, [(4.0 * 20.0 * upper, 3.0), (20.0 * lower, 0.5)])
    };
    let scene = |by: f64, high: bool, friction: Value, combination: Value| {
        let (earth, surcharge) = thrust(by);
        let at = |h: f64| if high { h } else { 0.0 };
        let live: Vec<Value> = earth
            .iter()
            .map(|(f, h)| push("earth", *f, at(*h)))
            .chain(surcharge.iter().map(|(f, h)| push("surcharge", *f, at(*h))))
            .collect();
        read(&block(2.0 * 1.405, 283.2, friction, json!({ "live": live }), json!([combination])))
    };
    let friction = json!(29f64.to_radians().tan());
    let first = json!({ "name": "c", "factors": { "dead": 1.0, "earth": 1.35, "surcharge": 1.5 } });
    let second = json!({ "name": "c", "factors": { "dead": 1.0, "earth": 1.0, "surcharge": 1.3 },
                         "materials": { "friction": 1.25 } });
    let third = json!({ "name": "c", "factors": { "dead": 0.9, "earth": 1.1, "surcharge": 1.5 } });
    for (scene, wanted, within) in [
        (scene(1.0, false, friction.clone(), first), 1.2600, 1e-4),
        (scene(1.25, false, friction, second), 1.0643, 1e-4),
        (scene(1.25, true, json!("infinite"), third), 1.425, 2e-3),
    ] {
        close("load factor", lambda(&file(&scene, limits()), "c"), wanted, within);
    }
}

/// A tower of two materials with ties, given interfaces and every kind of load.
fn tower() -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "stone": { "density": 2400 }, "finish": { "density": 1800, "action": "finish" } },
        "joints": { "default": { "friction": 0.6, "cohesion": 1e3, "tension": 5e2, "compression": 2e6 } },
        "blocks": [
            fixed(cuboid("ground", [6.0, 6.0, 1.0], [0.0, 0.0, -1.0])),
            { "id": "low", "material": "stone", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 0.5] },
            { "id": "top", "material": "finish", "shape": { "box": { "size": [1, 1, 0.5] } }, "at": [0, 0, 1.25] },
        ],
        "interfaces": [{ "between": ["low", "top"], "friction": 0.4, "normal": [0, 0, 1],
            "points": [[-0.5, -0.5, 1], [0.5, -0.5, 1], [0.5, 0.5, 1], [-0.5, 0.5, 1]] }],
        "members": [{ "id": "tie", "tie": { "between": [{ "block": "top", "at": [0.5, 0, 1.25] }, { "ground": [2, 0, 0] }], "strength": 900 } }],
        "loads": {
            "dead": [{ "block": "top", "action": "water", "force": [100, 0, -200], "at": [0.2, 0, 1.5] }],
            "live": [{ "weight": [-0.3, 0, 0] }, { "block": "top", "action": "wind", "force": [-50, 0, 0] }],
        },
        "combinations": [
            { "name": "one", "factors": { "dead": 1.2, "finish": 0.9, "water": 1.5, "wind": 1.4, "live": 1.1 },
              "materials": { "friction": 1.25, "cohesion": 1.6, "tension": 2, "compression": 1.5, "members": 1.15 } },
            { "name": "two", "factors": { "dead": 1, "finish": 1, "live": 1, "wind": 1 }, "without": ["water"] },
        ],
    })
}

/// A combination is the scene with its numbers multiplied by hand.
#[test]
fn a_combination_is_the_scene_with_its_numbers_changed() {
    let scene = read(&tower());
    let by_hand = {
        let mut v = tower();
        v["materials"]["stone"]["density"] = json!(2400.0 * 1.2);
        v["materials"]["finish"]["density"] = json!(1800.0 * 0.9);
        v["joints"]["default"] = json!({ "friction": 0.6 / 1.25, "cohesion": 1e3 / 1.6,
            "tension": 250.0, "compression": 2e6 / 1.5 });
        v["interfaces"][0]["friction"] = json!(0.4 / 1.25);
        v["members"][0]["tie"]["strength"] = json!(900.0 / 1.15);
        v["loads"]["dead"][0]["force"] = json!([150, 0, -300]);
        // Multiples of the weight are those of the characteristic one.
        v["loads"]["live"] = json!([
            { "block": "low", "weight": [-0.33 / 1.2, 0, 0] },
            { "block": "top", "weight": [-0.33 / 0.9, 0, 0] },
            { "block": "top", "force": [-70, 0, 0] },
        ]);
        v.as_object_mut().unwrap().remove("combinations");
        read(&v)
    };
    let file_of = |scene: &Scene| file(scene, LimitOptions::default().into());
    let (ours, theirs) = (file_of(&scene.in_combination("one").unwrap()), file_of(&by_hand));
    let value = |f: &ResultFile| f.answer.load_factor().and_then(|l| l.value).unwrap();
    close("by hand", value(&ours), value(&theirs), 1e-6 * value(&theirs));
    // Asked among others from contacts that are known, it is the same.
    let all = file(&scene, limits());
    close("among others", lambda(&all, "one"), value(&ours), 1e-6);
    assert!(lambda(&all, "two") != lambda(&all, "one"));
    assert_eq!(said(&all).list.len(), 2);
}

/// What shares contacts is what is prepared by itself.
#[test]
fn what_is_alike_is_what_is_prepared_anew() {
    let scene = read(&tower());
    let there = scene.in_combination("one").unwrap();
    let alike = model(&scene).alike(&there).unwrap();
    let anew = prepare(&there).unwrap();
    let laws = |m: &voussoir::interface::Model| {
        m.interfaces.list.iter().map(|f| (f.a, f.b, f.law)).collect::<Vec<_>>()
    };
    assert_eq!(laws(&alike), laws(&anew));
    assert_eq!(alike.assembly.dead, anew.assembly.dead);
    assert_eq!(alike.assembly.live, anew.assembly.live);
    assert_eq!(alike.interfaces.members, anew.interfaces.members);
}

#[test]
fn combinations_that_mean_nothing_are_refused_with_their_place() {
    let all = json!({ "dead": 1, "finish": 1, "water": 1, "wind": 1, "live": 1 });
    let with = |key: &str, value: Value| {
        let mut c = json!({ "name": "one", "factors": all });
        c[key] = value;
        json!([c])
    };
    let factor = |action: &str, value: Value| {
        let mut list = all.clone();
        list[action] = value;
        with("factors", list)
    };
    for (combinations, says) in [
        (factor("traffic", json!(1.5)), "combinations[0].factors.traffic"),
        (factor("watr", json!(1.5)), "water"),
        (factor("wind", json!(0)), "combinations[0].factors.wind"),
        (factor("wind", json!(-1)), "without"),
        (factor("wind", json!("1.5 kN")), "combinations[0].factors.wind"),
        (with("factors", json!({ "dead": 1 })), "says nothing of the action \"finish\""),
        (with("without", json!(["wind"])), "has a factor as well"),
        (with("without", json!(["dead"])), "weights always act"),
        (with("preset", json!("en1990_bulding_str")), "en1990_building_str"),
        (with("favourable", json!(["dead"])), "without a preset"),
        (with("materials", json!({ "friction": 0 })), "materials.friction"),
        (with("name", json!(" ")), "combinations[0].name"),
        (
            json!([{ "name": "a", "factors": all }, { "name": "a", "factors": all }]),
            "combinations[1].name",
        ),
    ] {
        let mut scene = tower();
        scene["combinations"] = combinations;
        let error = match read_str("test", scene.to_string()) {
            Ok((scene, _)) => prepare(&scene).err(),
            Err(error) => Some(error),
        };
        let error = error.unwrap_or_else(|| panic!("{says}: accepted")).to_string();
        assert!(error.contains(says), "{error} does not say {says}");
    }
    let scene = read(&tower());
    assert!(scene.in_combination("tow").unwrap_err().to_string().contains("two"));
}

#[test]
fn forged_combinations_are_refused() {
    let scene = read(&tower());
    let good = file(&scene, limits());
    leaves_hold(&good);
    let edits: [crate::ask::Edit; 3] = [
        ("the proof of another combination", &|v| {
            let list = &mut v["evidence"]["combinations"]["list"];
            list[0] = list[1].clone();
        }),
        ("one combination less", &|v| {
            v["evidence"]["combinations"]["list"].as_array_mut().unwrap().pop();
        }),
        ("another question", &|v| {
            v["evidence"]["combinations"]["list"][0]["question"]["limit"]["require"] = json!(0.1);
        }),
    ];
    edits_are_refused(&scene, &good, &edits);
}

/// A façade that overturns, held by a tie, at a site; lengths in units of `size` metres.
fn facade(size: f64) -> Value {
    let s = |v: f64| v * size;
    json!({
        "format": "voussoir-scene/1", "gravity": [0, 0, -s(9.81)],
        "materials": { "masonry": { "density": 1900.0 / size.powi(3) } },
        "joints": { "default": { "friction": 0.6 } },
        "blocks": [
            fixed(cuboid("ground", [s(12.0), s(10.0), s(1.0)], [s(-2.0), 0.0, s(-1.0)])),
            { "id": "wall", "material": "masonry", "shape": { "box": { "size": [s(0.8), s(8.0), s(7.0)] } }, "at": [s(-0.4), 0, s(3.5)] },
        ],
        "members": [{ "id": "tie", "tie": { "between": [
            { "block": "wall", "at": [s(-0.8), 0, s(6.2)] }, { "ground": [s(-7.8), 0, s(6.2)] }],
            "strength": s(50_000.0) } }],
        "site": { "slv": { "a_g": s(1.766), "f_0": 2.45, "s": 1.43, "t_c_star": 0.33, "c_c": 1.4, "t_d": 2.32 } },
    })
}

fn sized(scene: &Scene, between: [f64; 2]) -> ResultFile {
    let ask = KinematicOptions {
        toward: vec![[1.0, 0.0, 0.0]],
        linear: true,
        verify: Some(Verification::Linear),
        ..KinematicOptions::default()
    };
    let vary = "/members/0/tie/strength".to_string();
    file(scene, MeetOptions { ask: Box::new(ask.into()), vary, between, scan: None }.into())
}

fn met(file: &ResultFile) -> &MeetAnswer {
    match &file.answer {
        Answer::Meet(a) => a,
        other => panic!("{other:?}"),
    }
}

/// The tie that meets the demand: moments about the toe, α0 = a_g S FC / (q g).
#[test]
fn the_least_tie_for_the_site_is_that_of_the_moments() {
    let weight = 0.8 * 8.0 * 7.0 * 1900.0 * 9.81;
    let alpha = 1.766 * 1.43 * 1.35 / (2.0 * 9.81);
    let exact = weight * (alpha * 3.5 - 0.4) / 6.2;
    let mut values = Vec::new();
    for size in [1.0, 1e-3] {
        let scene = read(&facade(size));
        let file = sized(&scene, [100.0 * size, 1e5 * size]);
        let [change] = &met(&file).changes[..] else { panic!("{:?}", met(&file)) };
        let (at, beside) = (change.met_at / size, change.not_met_at / size);
        assert!(beside < exact && exact <= at * (1.0 + 1e-9), "{beside} {exact} {at}");
        assert!((at - beside) / exact < 2e-6, "{beside} {at}");
        values.push(at);
    }
    close("other units", values[1], values[0], 2e-6 * exact);
}

#[test]
fn forged_sizes_are_refused() {
    let scene = read(&facade(1.0));
    let good = sized(&scene, [100.0, 1e5]);
    leaves_hold(&good);
    let edits: [crate::ask::Edit; 4] = [
        ("a value of the scan", &|v| {
            v["evidence"]["meet"]["scan"][1]["met"] = json!(true);
        }),
        ("a smaller tie", &|v| {
            v["evidence"]["meet"]["sides"][0][1]["value"] = json!(20_000.0);
        }),
        ("both sides from one proof", &|v| {
            let sides = &mut v["evidence"]["meet"]["sides"][0];
            sides[0]["own"] = sides[1]["own"].clone();
        }),
        ("less required", &|v| {
            for k in 0..2 {
                v["evidence"]["meet"]["sides"][0][k]["own"]["question"]["kinematic"]["site"] =
                    json!(0.5);
            }
        }),
    ];
    edits_are_refused(&scene, &good, &edits);
}

/// The verification that governs may be chosen; the share of the earthquake follows it.
#[test]
fn the_verification_that_governs_is_the_one_that_is_chosen() {
    let scene = read(&facade(1.0));
    let by = |verify| {
        let toward = vec![[1.0, 0.0, 0.0]];
        let f =
            file(&scene, KinematicOptions { toward, verify, ..KinematicOptions::default() }.into());
        let r = f.required.expect("a site requires something");
        (r.obtained.expect("a share"), r.met)
    };
    let both = by(None);
    let linear = by(Some(Verification::Linear));
    let displacement = by(Some(Verification::Displacement));
    assert!(linear.1 == Some(true) && linear.0 > 1.0, "{linear:?}");
    assert!(displacement.1 == Some(false) && displacement.0 < 1.0, "{displacement:?}");
    assert_eq!(both, displacement);
}

/// What a scene requires counts where the question says nothing.
#[test]
fn what_the_scene_requires_is_told() {
    let mut scene = tower();
    for (least, wanted) in [(0.01, Some(true)), (1e6, Some(false))] {
        scene["require"] = json!({ "load_factor": least });
        let file = file(&read(&scene), LimitOptions::default().into());
        let r = file.required.expect("the scene requires something");
        assert_eq!((r.least, r.met), (least, wanted));
        let own = LimitOptions { require: Some(0.02), ..LimitOptions::default() };
        assert_eq!(self::file(&read(&scene), own.into()).required.unwrap().least, 0.02);
    }
}

/// Of a thrust it is the geometric safety factor, 1.1243 of this arch: proved on either side.
#[test]
fn a_geometric_safety_factor_may_be_required() {
    let mut scene: Value =
        serde_json::from_str(include_str!("../../structures/semicircular-arch-thick.json"))
            .expect("a scene");
    let question = |require| -> Question {
        ThrustOptions { range: true, require, ..ThrustOptions::default() }.into()
    };
    for (least, wanted) in [(1.1, Some(true)), (1.2, Some(false))] {
        let own = file(&read(&scene), question(Some(least)));
        scene["require"] = json!({ "geometric_factor": least });
        let of_scene = file(&read(&scene), question(None));
        for r in [own, of_scene].map(|f| f.required.expect("something is required")) {
            assert_eq!((r.quantity, r.least, r.met), (Quantity::GeometricFactor, least, wanted));
            close("the factor", r.obtained.expect("a factor"), 1.1243, 1e-4);
        }
    }
    scene["require"] = json!({});
    scene["loads"] = json!({ "dead": [ { "acceleration": [8, 0, 0] } ] });
    let falls = file(&read(&scene), question(Some(1.0)));
    assert_eq!(falls.required.and_then(|r| r.met), Some(false));
    let idle = ThrustOptions { require: Some(2.0), ..ThrustOptions::default() };
    let refused = Question::from(idle).check().expect_err("a thrust alone has no factor");
    assert!(refused.to_string().contains("range"), "{refused}");
}

#[test]
fn vehicles_are_trains_and_presets_name_their_clause() {
    for (name, vehicle) in vehicles().unwrap().as_object().unwrap() {
        let mut train = json!({ "path": [-3, 3], "step": 0.5 });
        train["axles"] = vehicle["axles"].clone();
        let train: voussoir::scene::Train = serde_json::from_value(train).unwrap();
        assert!(train.axles.iter().all(|a| a.force.size() > 1e4), "{name}");
        assert!(vehicle["source"].as_str().unwrap().len() > 10, "{name}");
    }
    for p in PRESETS {
        assert!(p.source.len() > 10, "{}", p.word);
        assert!(p.permanent[0] >= p.permanent[1] && p.superimposed[0] >= p.superimposed[1]);
    }
}
