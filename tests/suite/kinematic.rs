//! Mechanisms under earthquakes (Circolare 21 January 2019 n. 7, C8.7.1.2.1): closed forms of walls
//! that turn about an edge, with floors and ties; what changes nothing; results that were edited.

use crate::ask::{cuboid, fixed, ground, model, prove, scene, template};
use serde_json::{Value, json};
use std::process::{Command, Output};
use voussoir::{
    analysis::{Control, ControlPoint, KinematicOptions, Law, PushOptions, Question, ask},
    kinematic::Unique,
    proof::{
        Answer, ResultFile, answer::FactorStatus, kinematic::KinematicAnswer, path::PathStatus,
        saved,
    },
    scene::Scene,
};

const G: f64 = 9.81;

fn close(value: f64, expected: f64, relative: f64) {
    let off = (value - expected).abs();
    assert!(off <= relative * expected.abs(), "{value} instead of {expected}");
}

fn options(toward: [f64; 3]) -> KinematicOptions {
    KinematicOptions { toward: vec![toward], ..KinematicOptions::default() }
}

fn file_of(scene: &Scene, options: KinematicOptions) -> ResultFile {
    let model = model(scene);
    let question = Question::Kinematic(options);
    let answer = ask(&question, scene, &model, &Control::default()).expect("an answer");
    saved::of(&question, scene, &model, &answer).expect("a result")
}

/// Asks, and proves the result from the scene alone.
fn asked(scene: &Scene, options: KinematicOptions) -> ResultFile {
    let file = file_of(scene, options);
    prove(scene, &file);
    file
}

fn said(file: &ResultFile) -> &KinematicAnswer {
    file.answer.kinematic().expect("an answer to the question")
}

fn read(value: &Value) -> Scene {
    voussoir::scene::read_str("test", value.to_string())
        .unwrap_or_else(|e| panic!("{e}\n{value}"))
        .0
}

/// A wall of 19 kN/m³ that stands on the ground behind its toe at the origin, 1 m long.
fn wall(height: f64, thickness: f64, more: Value) -> Value {
    let mut value = json!({
        "format": "voussoir-scene/1",
        "materials": { "masonry": { "density": 19000.0 / G } },
        "joints": { "default": { "friction": 0.7 } },
        "blocks": [
            { "id": "ground", "support": true, "shape": { "box": { "size": [30, 30, 1] } }, "at": [0, 0, -0.5] },
            { "id": "wall", "material": "masonry", "shape": { "box": { "size": [thickness, 1, height] } },
              "at": [-0.5 * thickness, 0, 0.5 * height] }
        ]
    });
    for (key, part) in more.as_object().expect("an object") {
        value[key] = part.clone();
    }
    value
}

fn floor() -> Value {
    json!({ "dead": [{ "block": "wall", "force": [0, 0, -40e3], "at": [-0.4, 0, 6] }] })
}

fn tie(strength: f64) -> Value {
    json!([{ "id": "tie", "tie": {
        "between": [{ "block": "wall", "at": [-0.6, 0, 5.5] }, { "ground": [-5.6, 0, 5.5] }],
        "strength": strength
    } }])
}

fn control(point: [f64; 3]) -> Option<ControlPoint> {
    Some(ControlPoint { block: "wall".into(), point })
}

/// Simple overturning: closed form, α(d) = (b − d) / √(R² − (b − d)²) with b half the thickness.
#[test]
fn a_wall_that_overturns() {
    let scene = read(&wall(6.0, 0.6, json!({})));
    let file = asked(&scene, options([1.0, 0.0, 0.0]));
    let a = said(&file);
    let p = a.numbers.participation.as_ref().expect("masses");
    close(a.alpha0.value.expect("a value"), 0.1, 1e-8);
    close(p.e_star, 1.0, 1e-9);
    close(p.mass, 6972.477064, 1e-9);
    close(a.numbers.a0.expect("a0"), 0.7266666667, 1e-8);
    assert_eq!(a.numbers.unique, Some(Unique::Only));
    let c = a.numbers.capacity.expect("a curve");
    close(c.d0, 0.3, 1e-9);
    let exact = c.exact.expect("points at the limit states");
    for (s, want) in [
        (c.straight.slv, [0.12, 0.436, 2.7688953]),
        (c.straight.slc, [0.18, 0.2906667, 3.8566756]),
        (exact.slv, [0.12, 0.4346115, 2.7733149]),
        (exact.slc, [0.18, 0.2894535, 3.8647492]),
    ] {
        [s.d, s.a, s.period].iter().zip(want).for_each(|(v, w)| close(*v, w, 2e-7));
    }
    let gravity = |p: &voussoir::proof::path::PathPoint| {
        let alpha = p.load_factor.expect("a load factor");
        let d = 0.3 - p.value;
        assert!((alpha - d / (9.09 - d * d).sqrt()).abs() < 1e-8, "{alpha} at {}", p.value);
    };
    file.path.as_ref().expect("a curve").points.iter().for_each(gravity);
    // Another factor of confidence divides accelerations alone.
    let other = asked(&scene, KinematicOptions { fc: Some(1.0), ..options([1.0, 0.0, 0.0]) });
    close(said(&other).numbers.a0.expect("a0"), 0.981, 1e-8);
    close(said(&other).numbers.capacity.expect("a curve").d0, 0.3, 1e-9);
}

/// Dead loads stay vertical and follow the points where they act; hand formula and root finding.
#[test]
fn a_wall_with_an_eccentric_floor() {
    let scene = read(&wall(6.0, 0.6, json!({ "loads": floor() })));
    let file = asked(
        &scene,
        KinematicOptions { control: control([0.0, 0.0, 6.0]), ..options([1.0, 0.0, 0.0]) },
    );
    let a = said(&file);
    let p = a.numbers.participation.as_ref().expect("masses");
    close(a.alpha0.value.expect("a value"), 0.08203054807, 1e-8);
    close(p.e_star, 0.8894927653, 1e-9);
    close(p.mass, 9828.849721, 1e-9);
    close(a.numbers.a0.expect("a0"), 0.6701444604, 1e-8);
    let c = a.numbers.capacity.expect("a curve");
    close(c.d_over_control, 0.769541779, 1e-9);
    close(c.control_d0, 0.4905356457, 1e-8);
    close(c.d0, 0.3774876734, 1e-8);
    let exact = c.exact.expect("points at the limit states");
    for (s, want) in [
        (exact.slv, [0.1509950694, 0.4017627175, 3.235606662]),
        (exact.slc, [0.2264926041, 0.2678417393, 4.506738459]),
    ] {
        [s.d, s.a, s.period].iter().zip(want).for_each(|(v, w)| close(*v, w, 1e-7));
    }
}

/// α of the wall with its floor and its tie of 15 kN, when the top of its outer face has gone this
/// far: it turns about its toe at the origin.
fn alpha_with_tie(way: f64) -> f64 {
    let turn = (way / 6.0).asin();
    let place = |x: f64, z: f64| [x * turn.cos() + z * turn.sin(), z * turn.cos() - x * turn.sin()];
    let ([wx, wz], [fx, fz]) = (place(-0.3, 3.0), place(-0.4, 6.0));
    let [tx, tz] = place(-0.6, 5.5);
    let (dx, dz) = (-5.6 - tx, 5.5 - tz);
    let tie = 15e3 / dx.hypot(dz);
    // Moments about the toe that turn it back.
    let back = -68.4e3 * wx - 40e3 * fx - tie * (tz * dx - tx * dz);
    back / (68.4e3 * wz + 40e3 * fz)
}

/// A tie of 15 kN/m yields at 5.5 m: it holds the start, and nothing that lasts.
#[test]
fn a_wall_with_a_tie() {
    let with = |strength: f64| {
        let scene = read(&wall(6.0, 0.6, json!({ "loads": floor(), "members": tie(strength) })));
        asked(
            &scene,
            KinematicOptions { control: control([0.0, 0.0, 6.0]), ..options([1.0, 0.0, 0.0]) },
        )
    };
    let file = with(15e3);
    let a = said(&file);
    close(a.alpha0.value.expect("a value"), 0.2673405211, 1e-8);
    close(a.numbers.a0.expect("a0"), 2.184025019, 1e-8);
    assert!(a.without_members && a.no_curve.is_none());
    let c = a.numbers.capacity.expect("a curve of what lasts");
    close(c.d0, 0.3774876734, 1e-8);
    close(c.a0, 0.6701444604, 1e-8);
    // The curve with the tie: 15 kN at 5.5 m while the wall turns about its toe, the tie along the
    // line from where it is fastened to where that point of the wall has gone.
    let with_tie = file.path_with_members.as_ref().expect("a curve with the tie");
    // It goes on holding, however far it has stretched, until the wall is down.
    let c = a.curve_with_members.as_ref().expect("a curve with the tie");
    assert_eq!(c.status, PathStatus::Vanishes);
    assert!(c.value.is_some_and(|way| way > 4.0 * 0.3774876734), "{c:?}");
    assert!(with_tie.points.len() > 4, "{}", with_tie.points.len());
    for p in &with_tie.points {
        let (here, exact) = (p.load_factor.expect("a load factor"), alpha_with_tie(p.value));
        assert!((here - exact).abs() < 1e-8, "{}: {here} instead of {exact}", p.value);
    }
    // With a strong tie it slides out below instead: the curve without the tie is not one of that.
    let strong = with(200e3);
    let a = said(&strong);
    assert!(a.numbers.capacity.is_none() && a.curve.is_none());
    assert!(a.no_curve.as_ref().is_some_and(|why| why.contains("another mechanism")), "{a:?}");
}

/// The curve is that of `push` under the same load, point by point.
#[test]
fn the_curve_is_that_of_push() {
    let arch =
        json!({ "radius": 1, "thickness": 0.15, "depth": 1, "voussoirs": 7, "embrace_deg": 157.5 });
    let more = json!({ "loads": { "live": [{ "weight": [1, 0, 0] }] } });
    let scene = template(f64::INFINITY, json!({ "arch": arch }), more);
    let model = model(&scene);
    let v02 = model.assembly.find("v02").expect("a voussoir");
    let point: [f64; 3] = model.assembly.blocks[v02].centroid.into();
    let control = ControlPoint { block: "v02".into(), point };
    let file = asked(
        &scene,
        KinematicOptions {
            control: Some(control.clone()),
            at: vec![0.01],
            ..options([1.0, 0.0, 0.0])
        },
    );
    close(said(&file).alpha0.value.expect("a value"), 0.3736116923, 1e-7);
    let kinematic = file.path.clone().expect("a curve");
    let at: Vec<f64> = kinematic.points.iter().map(|p| p.value).collect();
    let question = Question::Push(PushOptions {
        control,
        toward: [1.0, 0.0, 0.0],
        at: at[1..].to_vec(),
        from: Vec::new(),
    });
    let answer = ask(&question, &scene, &model, &Control::default()).expect("an answer");
    let pushed = saved::of(&question, &scene, &model, &answer)
        .expect("a result")
        .path
        .clone()
        .expect("a curve");
    assert!(pushed.events.len() == kinematic.events.len() && !pushed.events.is_empty());
    let mut compared = 0;
    for p in &kinematic.points {
        let same = pushed.points.iter().find(|q| (q.value - p.value).abs() <= 1e-12);
        if let Some((a, b)) = same.and_then(|q| q.load_factor).zip(p.load_factor) {
            // Two points lie at the value of the jump.
            compared += usize::from((a - b).abs() <= 1e-8);
        }
    }
    assert!(compared + 2 >= kinematic.points.len(), "{compared} of {}", kinematic.points.len());
    let [e, f] = [&pushed.events[0], &kinematic.events[0]];
    close(e.value, f.value, 1e-9);
    close(pushed.points.last().unwrap().value, kinematic.points.last().unwrap().value, 1e-9);
}

/// Two storeys, a mass that rests, one that only pushes, and a thrust that no earthquake pushes:
/// virtual work by hand about the toe.
#[test]
fn masses_of_all_kinds() {
    let storey = |id: &str, z: f64| json!({ "id": id, "material": "masonry", "shape": { "box": { "size": [0.5, 1, 3] } }, "at": [-0.25, 0, z] });
    let mut value = wall(6.0, 0.5, json!({}));
    value["blocks"] = json!([value["blocks"][0], storey("low", 1.5), storey("high", 4.5)]);
    value["loads"] = json!({
        "dead": [
            { "block": "high", "force": [0, 0, -10e3], "at": [-0.3, 0, 6] },
            { "block": "low", "force": [0, 0, -4e3], "at": [-0.2, 0, 3], "massless": true },
            { "block": "low", "force": [500, 0, 0], "at": [-0.5, 0, 3] }
        ],
        "masses": [{ "block": "high", "at": [-0.25, 0, 5], "mass": 500 }]
    });
    let scene = read(&value);
    let file = asked(&scene, options([1.0, 0.0, 0.0]));
    let (w, q) = (0.5 * 3.0 * 19e3, 500.0 * G);
    let holds = 2.0 * w * 0.25 + 10e3 * 0.3 + 4e3 * 0.2 - 500.0 * 3.0;
    let masses = [(w, 1.5), (w, 4.5), (10e3, 6.0), (q, 5.0)];
    let sum = |f: &dyn Fn(f64, f64) -> f64| masses.iter().map(|&(p, z)| f(p, z)).sum::<f64>();
    let first = sum(&|p, z| p * z);
    let e_star = first * first / (sum(&|p, _| p) * sum(&|p, z| p * z * z));
    let a = said(&file);
    let p = a.numbers.participation.as_ref().expect("masses");
    close(a.alpha0.value.expect("a value"), holds / first, 1e-8);
    close(p.e_star, e_star, 1e-9);
    close(p.weight, sum(&|p, _| p), 1e-12);
    close(a.numbers.a0.expect("a0"), holds / first * G / (e_star * 1.35), 1e-8);
    // Storeys that move as one are one wall: its centre at half its height.
    let joined = first * first / (sum(&|p, _| p) * (2.0 * w * 9.0 + 10e3 * 36.0 + q * 25.0));
    close(p.e_star_of_bodies, joined, 1e-9);
    close(a.numbers.a0_of_bodies.expect("less"), holds / first * G / (joined * 1.35), 1e-8);
    // Without the key the thrust counts as a weight, and it starts earlier: the safe reading.
    value["loads"]["dead"][1].as_object_mut().unwrap().remove("massless");
    let all = file_of(&read(&value), options([1.0, 0.0, 0.0]));
    close(said(&all).alpha0.value.expect("a value"), holds / (first + 4e3 * 3.0), 1e-8);
    // Other questions do not see masses that only push.
    let mut without = value.clone();
    without["loads"].as_object_mut().unwrap().remove("masses");
    let verdict = |v: &Value| crate::ask::verdict(&read(v), Law::Associative);
    assert_eq!(verdict(&value), verdict(&without));
}

fn site() -> Value {
    json!({
        "slv": { "a_g": 0.3 * G, "f_0": 2.4, "s": 1, "t_c": 0.45 },
        "building": { "t_1": 0.3, "storeys": 3, "height": 9, "z": 6 },
        "damping_percent": 8
    })
}

/// Floors: γ1 and a_Z with ξ of the building in percent. Beyond period 0 nothing is said unless the
/// scene says how floors amplify.
#[test]
fn accelerations_of_floors() {
    let mut value = wall(6.0, 0.6, json!({ "site": site() }));
    let file = asked(&read(&value), options([1.0, 0.0, 0.0]));
    let d = said(&file).numbers.demand.as_ref().expect("a demand");
    close(d.gamma_1.expect("γ1"), 1.2857142857, 1e-9);
    close(d.a_z.expect("a_Z") / G, 0.6202209, 1e-6);
    assert!(d.left_out.iter().any(|t| t.contains("amplif")), "{:?}", d.left_out);
    assert!(d.checks.iter().all(|c| !c.what.contains("S_eZ")));
    let linear = d.checks.iter().find(|c| c.what.contains("a_Z / q")).expect("a check");
    close(linear.ratio, 0.7266666667 / (0.6202209 * G / 2.0), 1e-6);
    // SLV of the exact curve on the ground: T beyond T_C, η(8 %) = √(10/13), T_D = 4 × 0.3 + 1.6 =
    // 2.8.
    let (t, tau) = (2.7733149_f64, std::f64::consts::TAU);
    let top = 0.3 * G * (10.0_f64 / 13.0).sqrt() * 2.4;
    let demand = top * 0.45 / t * (t / tau).powi(2);
    let slv = d.checks.iter().find(|c| c.what.contains("exact") && c.what.contains("SLV"));
    close(slv.expect("a check").demand, demand, 1e-6);
    close(d.ratio, d.checks.iter().map(|c| c.ratio).fold(f64::INFINITY, f64::min), 1e-12);
    value["site"]["building"]["amplification"] = json!(1.1 / 0.05_f64.sqrt());
    let file = asked(&read(&value), options([1.0, 0.0, 0.0]));
    let d = said(&file).numbers.demand.as_ref().expect("a demand");
    assert!(d.checks.iter().any(|c| c.what.contains("S_eZ")));
}

/// A site is asked for by this verb alone.
#[test]
fn a_site_changes_no_other_answer() {
    let live = json!({ "live": [{ "weight": [1, 0, 0] }] });
    let plain = wall(6.0, 0.6, json!({ "loads": live }));
    let mut with = plain.clone();
    with["site"] = site();
    for question in [Question::Limit(Default::default()), Question::Assess(Default::default())] {
        let [a, b] = [&plain, &with].map(|v| {
            let scene = read(v);
            let model = model(&scene);
            let answer = ask(&question, &scene, &model, &Control::default()).expect("an answer");
            let file = saved::of(&question, &scene, &model, &answer).expect("a result");
            (file.answer.clone(), file.warnings().cloned().collect::<Vec<_>>())
        });
        assert_eq!(a, b);
    }
}

/// What slides is said, and no curve is made up.
#[test]
fn walls_that_slide() {
    let mut value = wall(2.0, 0.6, json!({}));
    value["joints"]["default"]["friction"] = json!(0.2);
    let scene = read(&value);
    let file = asked(&scene, options([1.0, 0.0, 0.0]));
    let a = said(&file);
    close(a.alpha0.value.expect("a value"), 0.2, 1e-4);
    assert!(a.numbers.a0.is_some() && a.numbers.capacity.is_none());
    assert!(a.curve.is_some() || a.no_curve.is_some());
    let said = voussoir::report::text::render(
        &file,
        voussoir::report::text::Asked { scene: "s", options: "", ..Default::default() },
        Default::default(),
        Default::default(),
    );
    assert!(said.to_string().contains("no straight line is drawn in its place"), "{said}");
}

/// Turned about the vertical, at survey coordinates, in other units of length and weight, beside a
/// heavy stranger: the same.
#[test]
fn what_changes_nothing() {
    let scene = read(&wall(6.0, 0.6, json!({ "loads": floor() })));
    let numbers = |file: &ResultFile| {
        let n = &said(file).numbers;
        let c = n.capacity.expect("a curve");
        let slv = c.exact.expect("limit states").slv;
        [
            said(file).alpha0.value.expect("a value"),
            n.participation.as_ref().expect("masses").e_star,
            n.a0.expect("a0"),
            c.d0,
            slv.a,
            slv.period,
        ]
    };
    let alone = numbers(&asked(&scene, options([1.0, 0.0, 0.0])));
    let same = |file: &ResultFile, lengths: f64, what: &str| {
        // α and e* are numbers; accelerations are those of gravity; periods go with √length.
        let scale = [1.0, 1.0, 1.0, lengths, 1.0, lengths.sqrt()];
        for ((v, w), s) in numbers(file).iter().zip(alone).zip(scale) {
            assert!((v - w * s).abs() <= 1e-6 * w * s, "{what}: {v} instead of {}", w * s);
        }
    };
    for angle in [0.3_f64, 1.234, 2.9, -0.77] {
        for shift in [[0.0, 0.0, 0.0], [412_000.0, 5_231_000.0, 480.0]] {
            let (s, c) = angle.sin_cos();
            let at = |x: f64, z: f64| [c * x + shift[0], s * x + shift[1], z + shift[2]];
            let mut value = wall(6.0, 0.6, json!({}));
            for (k, (x, z)) in [(0.0, -0.5), (-0.3, 3.0)].into_iter().enumerate() {
                value["blocks"][k]["at"] = json!(at(x, z));
                value["blocks"][k]["rotation_deg"] =
                    json!({ "axis": [0, 0, 1], "angle": angle.to_degrees() });
            }
            value["loads"] = json!({ "dead": [{ "block": "wall", "force": [0, 0, -40e3], "at": at(-0.4, 6.0) }] });
            let file = asked(&read(&value), options([c, s, 0.0]));
            same(&file, 1.0, &format!("turned by {angle}, shifted by {shift:?}"));
        }
    }
    for (lengths, weights) in [(1000.0, 1e9), (0.01, 1e-3), (1.0, 1e6)] {
        let mut value = wall(6.0 * lengths, 0.6 * lengths, json!({}));
        for key in ["ground", "wall"] {
            let k = usize::from(key == "wall");
            value["blocks"][k].as_object_mut().unwrap().remove("material");
        }
        value["blocks"][0]["shape"]["box"]["size"] =
            json!([30.0 * lengths, 30.0 * lengths, lengths]);
        value["blocks"][0]["at"] = json!([0, 0, -0.5 * lengths]);
        value["blocks"][1]["shape"]["box"]["size"] = json!([0.6 * lengths, lengths, 6.0 * lengths]);
        value["blocks"][1]["mass"] = json!(68400.0 / G * weights);
        value["loads"] = json!({ "dead": [{
            "block": "wall", "force": [0, 0, -40e3 * weights],
            "at": [-0.4 * lengths, 0, 6.0 * lengths]
        }] });
        let file = asked(&read(&value), options([1.0, 0.0, 0.0]));
        same(&file, lengths, &format!("lengths × {lengths}, weights × {weights}"));
    }
    for (x, size, density) in [(10.0, 3.0, 1e9), (-9.0, 0.1, 1e-6), (12.0, 5.0, 2000.0)] {
        let mut value = wall(6.0, 0.6, json!({ "loads": floor() }));
        let stranger = json!({ "id": "stranger", "density": density, "shape": { "box": { "size": [size, size, size] } }, "at": [x, 0, 0.5 * size] });
        value["blocks"].as_array_mut().unwrap().push(stranger);
        let file = asked(&read(&value), options([1.0, 0.0, 0.0]));
        same(&file, 1.0, &format!("a stranger of {density} kg/m³"));
        let p = said(&file).numbers.participation.as_ref().unwrap();
        assert!(p.masses.iter().all(|m| m.block == "wall"));
    }
}

/// Directions come worst first, each with its own proof.
#[test]
fn directions_come_worst_first() {
    let scene = read(&wall(6.0, 0.6, json!({ "loads": floor() })));
    let file = asked(&scene, KinematicOptions { all: Some(5), ..KinematicOptions::default() });
    let a0 = |a: &Answer| a.kinematic().and_then(|k| k.numbers.a0).expect("a0");
    let order: Vec<f64> = file.directions.iter().map(|d| a0(&d.answer)).collect();
    assert_eq!(order.len(), 5);
    assert!(order.windows(2).all(|w| w[0] <= w[1]) && a0(&file.answer) == order[0]);
    // Backwards the floor is nearer to the edge: 0.2 m for 0.4 m.
    let back = said(&file).toward;
    assert!(back[0] < 0.0, "{back:?}");
    crate::ask::edits_are_refused(
        &scene,
        &file,
        &[("directions swapped", &|v| {
            v["evidence"]["kinematic"]["directions"].as_array_mut().unwrap().swap(0, 1);
        })],
    );
}

#[test]
fn edited_results_are_refused() {
    let mut value = wall(6.0, 0.6, json!({ "loads": floor(), "site": site() }));
    value["site"]["slc"] = json!({ "a_g": 3.5, "f_0": 2.5, "s": 1, "t_c": 0.5 });
    let scene = read(&value);
    let honest = asked(&scene, options([1.0, 0.0, 0.0]));
    crate::ask::leaves_hold(&honest);
    type Edit<'a> = (&'a str, &'a dyn Fn(&mut Value));
    let edits: [Edit; 5] = [
        ("another direction", &|v| v["question"]["kinematic"]["toward"][0] = json!([0, 1, 0])),
        ("a point moved", &|v| {
            let value = &mut v["evidence"]["kinematic"]["curve"]["points"][3]["value"];
            *value = json!(value.as_f64().unwrap() * 1.001);
        }),
        ("another mechanism", &|v| {
            let rates = &mut v["evidence"]["kinematic"]["directions"][0]["bound"]["rates"];
            for rate in rates.as_array_mut().unwrap() {
                rate["velocity"][0] = json!(rate["velocity"][0].as_f64().unwrap() * 1.01);
            }
        }),
        ("another control point", &|v| {
            v["evidence"]["kinematic"]["control"]["point"] = json!([0.0, 0.0, 3.0]);
        }),
        ("less confidence", &|v| v["question"]["kinematic"]["fc"] = json!(0.9)),
    ];
    crate::ask::edits_are_refused(&scene, &honest, &edits);
}

fn run(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_voussoir"))
        .args(args)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// One wall drawn as six courses: what it meets only block by block is no yes, and the first number
/// is that of the wall.
#[test]
fn a_wall_in_courses_is_not_stronger_than_the_wall() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = format!("{}/structures/overturning-wall.json", env!("CARGO_MANIFEST_DIR"));
    let mut value: Value =
        serde_json::from_str(&std::fs::read_to_string(&whole).expect("a scene")).expect("JSON");
    let wall = value["blocks"][1].clone();
    let course = |k: u32| {
        let (mut block, [low, high]) = (wall.clone(), [k, k + 1].map(f64::from));
        block["id"] = json!(format!("course_{k}"));
        block["shape"]["prism"]["polygon"] =
            json!([[-0.6, low], [0, low], [0, high], [-0.6, high]]);
        block
    };
    value["blocks"] =
        std::iter::once(value["blocks"][0].clone()).chain((0..6).map(course)).collect();
    let path = folder.path().join("courses.json").display().to_string();
    std::fs::write(&path, value.to_string()).expect("written");
    let asked = run(&["kinematic", &path, "--toward", "1,0", "-q"]);
    assert_eq!(asked.status.code(), Some(3), "{}", text(&asked.stdout));
    let said = text(&asked.stdout);
    let of =
        |line: &str| line.split("a0 = ").nth(1).map(|t| t.split(' ').next().unwrap().to_string());
    let one = text(&run(&["kinematic", &whole, "--toward", "1,0", "-q"]).stdout);
    assert_eq!(of(&said), of(&one), "{said}");
    let met = |line: &str| line.split("linear check ").nth(1).map(|t| t[..6].to_string());
    assert_eq!(met(&said), met(&one), "{said}");
    assert!(said.contains("block by block"), "{said}");
}

#[test]
fn exit_codes_and_files() {
    let wall = "structures/overturning-wall-with-floor.json";
    let code = |args: &[&str]| run(args).status.code();
    let toward = ["--toward", "1,0"];
    let with = |more: &[&'static str]| [&["kinematic", wall][..], &toward, more].concat();
    assert_eq!(code(&with(&["-q"])), Some(0));
    assert_eq!(code(&with(&["--linear", "--require", "0.08"])), Some(0));
    assert_eq!(code(&with(&["--linear", "--require", "0.09"])), Some(1));
    assert_eq!(code(&with(&["--fc", "0.5"])), Some(2));
    assert_eq!(code(&with(&["--control", "wall=0,0,99"])), Some(2));
    assert_eq!(code(&["kinematic", wall, "--toward", "0,0,1"]), Some(2));
    // The site of this one demands more than its linear check gives.
    assert_eq!(
        code(&["kinematic", "structures/overturning-wall.json", "--toward", "1,0"]),
        Some(1)
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let [csv, svg, page, saved] = ["c.csv", "c.svg", "c.html", "r.json"].map(path);
    let made = run(&[
        "kinematic",
        wall,
        "--toward",
        "1,0",
        "--csv",
        &csv,
        "--svg",
        &svg,
        "--report",
        &page,
        "--save",
        &saved,
    ]);
    assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
    let read = |path: &str| std::fs::read_to_string(path).expect("it is written");
    let table = read(&csv);
    assert!(
        table.contains("direction")
            && table.contains("exact SLV")
            && table.contains("straight SLC")
    );
    assert!(read(&svg).contains("straight line from a0 to d0"));
    for words in ["Circolare 7/2019", "Capacity curve", "FC = 1.35"] {
        assert!(read(&page).contains(words), "{words}");
    }
    let checked = run(&["check", &saved]);
    assert_eq!(checked.status.code(), Some(0), "{}", text(&checked.stdout));
    assert!(text(&checked.stdout).contains("recomputed from the mechanism: e* = 0.889492765"));
}

#[test]
fn bad_input_names_place_and_remedy() {
    let error = |edit: &dyn Fn(&mut Value)| {
        let mut value = wall(6.0, 0.6, json!({ "loads": floor(), "site": site() }));
        edit(&mut value);
        match voussoir::scene::read_str("test", value.to_string()) {
            Err(e) => e.to_string(),
            Ok((scene, _)) => match voussoir::interface::prepare(&scene) {
                Err(e) => e.to_string(),
                Ok(_) => panic!("accepted: {value}"),
            },
        }
    };
    for (place, edit) in [
        (
            "site.slv.a_g",
            &(|v: &mut Value| v["site"]["slv"]["a_g"] = json!(-1)) as &dyn Fn(&mut Value),
        ),
        ("site.slv", &|v| {
            v["site"]["slv"].as_object_mut().unwrap().remove("t_c");
        }),
        ("site.slv.t_c", &|v| v["site"]["slv"]["c_c"] = json!(1.2)),
        ("site.slv.t_b", &|v| v["site"]["slv"]["t_b"] = json!(3)),
        ("site.slv.t_d", &|v| v["site"]["slv"]["t_d"] = json!(0.1)),
        ("site.q", &|v| v["site"]["q"] = json!(0.5)),
        ("site.damping_percent", &|v| v["site"]["damping_percent"] = json!(0)),
        ("site.building.z", &|v| v["site"]["building"]["z"] = json!(10)),
        ("site.building.storeys", &|v| v["site"]["building"]["storeys"] = json!(0)),
        ("site.building.amplification", &|v| v["site"]["building"]["amplification"] = json!(0.49)),
        ("loads.dead[0].massless", &|v| {
            v["loads"]["dead"][0]["force"] = json!([1000, 0, 0]);
            v["loads"]["dead"][0]["massless"] = json!(true);
        }),
        ("loads.masses[0].block", &|v| {
            v["loads"]["masses"] = json!([{ "block": "ground", "at": [0, 0, 0], "mass": 1 }]);
        }),
        ("loads.masses[0].mass", &|v| {
            v["loads"]["masses"] = json!([{ "block": "wall", "at": [0, 0, 0], "mass": -1 }]);
        }),
        ("loads.masses[0].at", &|v| {
            v["loads"]["masses"] = json!([{ "block": "wall", "at": [0, 0, 6e3], "mass": 1 }]);
        }),
    ] {
        let said = error(edit);
        assert!(said.contains(place) && said.contains("hint"), "{place}: {said}");
    }
    // Numbers in another unit are said.
    let mut value = wall(6.0, 0.6, json!({ "site": site() }));
    value["site"]["slv"]["a_g"] = json!(0.15);
    let model = model(&read(&value));
    assert!(model.findings().any(|f| f.text.contains("multiples of g")));
}

/// Wedged blocks, and blocks that do not stand: no number is made up.
#[test]
fn no_number_where_there_is_none() {
    let blocks = json!([
        ground(),
        cuboid("wall", [0.4, 1.0, 1.0], [0.0, 0.0, 0.0]),
        fixed(cuboid("left", [0.4, 1.0, 1.0], [-0.4, 0.0, 0.0])),
        fixed(cuboid("right", [0.4, 1.0, 1.0], [0.4, 0.0, 0.0])),
    ]);
    let held = scene(0.5, blocks, json!({}));
    let options = KinematicOptions { law: Law::Associative, ..options([1.0, 0.0, 0.0]) };
    let file = asked(&held, options.clone());
    assert_eq!(said(&file).alpha0.status, FactorStatus::Unbounded);
    assert!(said(&file).numbers.a0.is_none() && said(&file).numbers.capacity.is_none());
    let mut value = wall(6.0, 0.6, json!({}));
    value["loads"] =
        json!({ "dead": [{ "block": "wall", "force": [20e3, 0, 0], "at": [0, 0, 6] }] });
    let falls = file_of(&read(&value), options);
    assert!(said(&falls).numbers.capacity.is_none());
    assert!(said(&falls).alpha0.value.is_none_or(|v| v < 0.0), "{:?}", said(&falls).alpha0);
}

/// Pushed over a corner, a pillar may turn about many axes; over an edge, about one.
#[test]
fn mechanisms_that_are_not_the_only_ones_say_so() {
    let blocks = json!([ground(), cuboid("pillar", [0.5, 0.5, 2.0], [0.0, 0.0, 0.0])]);
    let pillar = scene(0.9, blocks, json!({}));
    let linear = |toward| KinematicOptions { linear: true, ..options(toward) };
    let file = asked(&pillar, linear([1.0, 1.0, 0.0]));
    close(said(&file).alpha0.value.expect("a value"), 0.25 * 2.0_f64.sqrt(), 1e-6);
    assert_eq!(said(&file).numbers.unique, Some(Unique::OneOfSeveral));
    let file = asked(&pillar, linear([1.0, 0.2, 0.0]));
    assert_eq!(said(&file).numbers.unique, Some(Unique::Only));
}

/// Bent between its foot and a floor that holds it without friction, a wall of two blocks opens
/// three hinges: virtual work by hand. Forces of one's own, and no curve where it is not followed.
#[test]
fn a_wall_that_bends_between_floors() {
    let mut value = wall(5.0, 0.5, json!({}));
    let part = |id: &str, h: f64, z: f64| json!({ "id": id, "material": "masonry", "shape": { "box": { "size": [0.5, 1, h] } }, "at": [-0.25, 0, z] });
    let slab = json!({ "id": "slab", "support": true, "shape": { "box": { "size": [1, 1, 0.2] } }, "at": [0.5, 0, 4.9] });
    value["blocks"] =
        json!([value["blocks"][0], slab, part("low", 3.0, 1.5), part("high", 2.0, 4.0)]);
    value["joints"]["overrides"] = json!([{ "blocks": ["slab", "high"], "friction": 0 }]);
    let file = asked(&read(&value), options([1.0, 0.0, 0.0]));
    let a = said(&file);
    // δ of the low part 1.5, of the high one 3 − 5/3; they rise by 0.25 and 0.5 + 5/12.
    let (d1, d2) = (1.5, 3.0 - 5.0 / 3.0);
    let first = 3.0 * d1 + 2.0 * d2;
    let alpha = (3.0 * 0.25 + 2.0 * (0.5 + 5.0 / 12.0)) / first;
    let e_star = first * first / (5.0 * (3.0 * d1 * d1 + 2.0 * d2 * d2));
    close(a.alpha0.value.expect("a value"), alpha, 1e-7);
    close(a.numbers.participation.as_ref().expect("masses").e_star, e_star, 1e-8);
    close(a.numbers.a0.expect("a0"), alpha * G / (e_star * 1.35), 1e-7);
    assert_eq!(a.numbers.unique, Some(Unique::Only));
    assert!(a.numbers.capacity.is_none());
}
