//! Joints that yield: closed forms of a bed that cannot pull, of Hertz and of Mindlin, a pile by
//! another method, what stiffness must not change, forged results, bad input.

use crate::ask::prove;
use proptest::prelude::*;
use serde_json::{Value, json};
use voussoir::{
    analysis::{Answer, Control, ControlPoint, Question, StateOptions, ask, assess, coulomb},
    elastic::{EventKind, Grip, PathEnd, Quadrature, Touch},
    interface::prepare,
    proof::{
        ResultFile, saved,
        state::{Displacement, StateAnswer},
    },
    report::{drawing, view::View},
    scene::{Scene, read_str},
    sweep::{RowAnswer, RowStatus},
    verdict::Verdict,
};

fn scene(value: Value) -> Scene {
    read_str("scene.json".to_string(), value.to_string()).unwrap_or_else(|e| panic!("{e}")).0
}

/// The result, written, read back and proved.
fn result(scene: &Scene, options: StateOptions) -> ResultFile {
    let model = prepare(scene).unwrap();
    let question = Question::State(options);
    let answer = ask(&question, scene, &model, &Control::default()).unwrap();
    assert!(matches!(answer, Answer::State(_)));
    let file = saved::of_question(&question, scene, &model, &answer, &Control::default()).unwrap();
    prove(scene, &file);
    file
}

fn state(value: Value) -> StateAnswer {
    result(&scene(value), StateOptions::default()).answer.state().unwrap().clone()
}

fn of<'a>(a: &'a StateAnswer, block: &str) -> &'a Displacement {
    a.displacements.iter().find(|d| d.block == block).unwrap()
}

/// A block of width 1 m, depth 1 m and height 2 m on a bed, 2000 kg/m³.
fn bed(normal: f64, shear: f64, loads: Value) -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "stone": { "density": 2000 } },
        "joints": { "default": { "friction": 0.7, "normal_stiffness": normal, "shear_stiffness": shear } },
        "blocks": [
            { "id": "floor", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "block", "shape": { "box": { "size": [1, 1, 2] } }, "at": [0, 0, 1], "material": "stone" }
        ],
        "loads": loads
    })
}

const N: f64 = 2000.0 * 2.0 * 9.81;

/// Winkler foundation without tension: M = k b³ θ / 12 up to θ = 2 N / (k b²), then M = N (b/2 − ⅓ √(2 N
/// / (k θ))); to 1e-6.
#[test]
fn a_block_on_a_bed_turns_by_the_closed_form() {
    let k = 1e9;
    let live = json!({ "live": [{ "block": "block", "moment": [0, 1000, 0] }] });
    let a = state(bed(k, 4e8, live));
    assert!(a.curve.len() > 20);
    for p in &a.curve {
        let (theta, moment) = (p.rotation[1], 1000.0 * p.load_factor);
        let exact = if theta <= 2.0 * N / k {
            k * theta / 12.0
        } else {
            N * (0.5 - (2.0 * N / (k * theta)).sqrt() / 3.0)
        };
        assert!((moment - exact).abs() <= 1e-9 * N, "{moment} {exact}");
    }
    // It opens at N b / 6, and falls at N b / 2.
    let l = a.load_factor.unwrap();
    assert!((a.events[0].load_factor - N / 6000.0).abs() < 1e-5 * N / 6000.0, "{:?}", a.events);
    assert_eq!(l.end, PathEnd::Bound);
    assert!((l.value.unwrap() - N / 2000.0).abs() < 1e-6 * N / 2000.0 && !l.slides);
    // Vertical frequency √(k A / m) / 2π.
    let vertical = (k / 4000.0_f64).sqrt() / std::f64::consts::TAU;
    assert!(
        a.frequencies.iter().any(|f| (f - vertical).abs() < 1e-9 * vertical),
        "{:?}",
        a.frequencies
    );
}

/// At the corners alone a square is three times as stiff against turning: M = k b³ θ / 4.
#[test]
fn corners_are_three_times_too_stiff() {
    let turned = |quadrature| {
        let dead = json!({ "dead": [{ "block": "block", "moment": [0, 1000, 0] }] });
        let options = StateOptions { quadrature, ..Default::default() };
        let file = result(&scene(bed(1e9, 1e9, dead)), options);
        of(file.answer.state().unwrap(), "block").rotation[1]
    };
    let (area, corners) = (turned(Quadrature::Area), turned(Quadrature::Corners));
    assert!(
        (area - 12.0 * 1000.0 / 1e9).abs() < 1e-12 * area && (area / corners - 3.0).abs() < 1e-9
    );
}

/// A block pushed at its base slides at λ = μ and not before; until then it moves by H / (k A).
#[test]
fn a_block_slides_at_its_friction() {
    let live = json!({ "live": [{ "block": "block", "force": [N, 0, 0], "at": [0, 0, 0] }] });
    let a = state(bed(1e9, 4e8, live));
    let l = a.load_factor.unwrap();
    assert!(
        (l.value.unwrap() - 0.7).abs() < 1e-6 && l.value.unwrap() <= l.associative.upper.unwrap()
    );
    for p in &a.curve {
        // The control point is the centre of mass, and nothing turns.
        let exact = p.load_factor * N / 4e8;
        assert!((p.displacement[0] - exact).abs() <= 1e-9 * exact + 1e-18, "{p:?}");
    }
}

const E: f64 = 70e9;
const NU: f64 = 0.22;

/// A sphere on a fixed one, pressed by `press` and its weight, with loads at the point of contact.
fn spheres(press: f64, dead: [f64; 2], live: f64) -> (Value, f64) {
    let weight = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.02_f64.powi(3) * 9.81;
    let at = json!([0, 0, 0.02]);
    let value = json!({
        "format": "voussoir-scene/1",
        "materials": { "glass": { "density": 2500, "young": E, "poisson": NU } },
        "joints": { "default": { "friction": 0.3 } },
        "blocks": [
            { "id": "low", "shape": { "sphere": { "radius": 0.01 } }, "at": [0, 0, 0.01], "support": true, "material": "glass" },
            { "id": "top", "shape": { "sphere": { "radius": 0.02 } }, "at": [0, 0, 0.04], "material": "glass" }
        ],
        "loads": {
            "dead": [{ "block": "top", "force": [0, 0, -press] }]
        }
    });
    let across = |[x, y]: [f64; 2]| json!({ "block": "top", "force": [x, y, 0], "at": at });
    let mut value = value;
    if dead != [0.0; 2] {
        value["loads"]["dead"].as_array_mut().unwrap().push(across(dead));
    }
    if live > 0.0 {
        value["loads"]["live"] = json!([across([live, 0.0])]);
    }
    (value, press + weight)
}

/// 1/R, 1/E*, 1/G* of two spheres of one material.
fn hertz() -> [f64; 3] {
    let shear = E / (2.0 * (1.0 + NU));
    [1.0 / (1.0 / 0.01 + 1.0 / 0.02), E / (2.0 * (1.0 - NU * NU)), shear / (2.0 * (2.0 - NU))]
}

/// Johnson, Contact Mechanics, eq. 4.23.
#[test]
fn spheres_approach_by_hertz() {
    for press in [1e-3, 1.0, 100.0] {
        let (value, force) = spheres(press, [0.0; 2], 0.0);
        let a = state(value);
        let [radius, modulus, _] = hertz();
        let exact = (9.0 * force * force / (16.0 * modulus * modulus * radius)).cbrt();
        let approach = -of(&a, "top").displacement[2];
        assert!((approach - exact).abs() < 1e-10 * exact, "{approach} {exact}");
        assert!((a.joints[0].closing - exact).abs() < 1e-10 * exact);
        // Eq. 4.24: greatest pressure 3 F / 2 π a².
        let circle = std::f64::consts::PI * radius * exact;
        assert!(
            (a.joints[0].greatest_pressure - 1.5 * force / circle).abs()
                < 1e-8 * a.joints[0].greatest_pressure
        );
    }
}

/// Mindlin: at a constant normal force P, δ = 3 μ P / (16 a G*) (1 − (1 − Q/μP)^(2/3)), whatever the steps.
#[test]
fn spheres_are_sheared_by_mindlin() {
    let (value, force) = spheres(100.0, [0.0; 2], 1.0);
    let [radius, modulus, shear] = hertz();
    let contact = (3.0 * force * radius / (4.0 * modulus)).cbrt();
    let model = scene(value);
    for q in [1.0, 10.0, 25.0, 30.0] {
        // One step fewer or more changes nothing: the path ends at the last load factor asked for.
        let options = StateOptions { at: vec![0.5 * q, q], ..Default::default() };
        let file = result(&model, options);
        let a = file.answer.state().unwrap();
        let p = a.curve.iter().find(|p| p.load_factor == q).unwrap();
        // At the point of contact; the sphere may roll.
        let way = p.displacement[0] - 0.02 * p.rotation[1];
        let most = 0.3 * force;
        let exact =
            3.0 * most / (16.0 * contact * shear) * (1.0 - (1.0 - q / most).powf(2.0 / 3.0));
        assert!((way - exact).abs() < 1e-8 * exact, "{q}: {way} {exact}");
    }
}

/// In proportional loading below μ nothing slides: δ = 3 Q / (16 a G*).
#[test]
fn spheres_loaded_in_proportion_stick() {
    for [x, y] in [[5.0, 0.0], [12.0, -16.0]] {
        let (value, force) = spheres(100.0, [x, y], 0.0);
        let [radius, modulus, shear] = hertz();
        let contact = (3.0 * force * radius / (4.0 * modulus)).cbrt();
        let a = state(value);
        let exact = 3.0 * x.hypot(y) / (16.0 * contact * shear);
        let way = a.joints[0].shear_displacement;
        assert!((way - exact).abs() < 1e-8 * exact, "{way} {exact}");
        assert_eq!((a.joints[0].grip, a.joints[0].touch), (Grip::Sticks, Touch::Pressed));
    }
}

/// A triangle of equal spheres, the lower two fixed, against halving on the approach: each contact has δn =
/// u cos 30° and δt = u sin 30°, N by Hertz, Q by the smaller of proportional loading and μ N.
#[test]
fn a_pile_of_equal_spheres_sinks_as_by_halving() {
    for mu in [0.05, 0.6] {
        let r = 0.01;
        let high = 3.0_f64.sqrt() * r + r;
        let ball = |id: &str, at: [f64; 3], support: bool| json!({ "id": id, "shape": { "sphere": { "radius": r } }, "at": at, "support": support, "material": "glass" });
        let a = state(json!({
            "format": "voussoir-scene/1",
            "materials": { "glass": { "density": 2500, "young": E, "poisson": NU } },
            "joints": { "default": { "friction": mu } },
            "blocks": [ball("a", [-r, 0.0, r], true), ball("b", [r, 0.0, r], true), ball("c", [0.0, 0.0, high], false)]
        }));
        let weight = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * r.powi(3) * 9.81;
        let (radius, [_, modulus, shear]) = (r / 2.0, hertz());
        let (cos, sin) = (3.0_f64.sqrt() / 2.0, 0.5);
        let carried = |u: f64| {
            let (depth, way) = (u * cos, u * sin);
            let normal = 4.0 / 3.0 * modulus * radius.sqrt() * depth.powf(1.5);
            let contact = (radius * depth).sqrt();
            let across = (16.0 * contact * shear * way / 3.0).min(mu * normal);
            2.0 * (normal * cos + across * sin)
        };
        let (mut low, mut high) = (0.0, 1e-4);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if carried(middle) < weight { low = middle } else { high = middle }
        }
        let sinks = -of(&a, "c").displacement[2];
        assert!((sinks - low).abs() < 1e-8 * low, "{mu}: {sinks} {low}");
    }
}

/// A pyramid of layers in squares on its fixed lowest one.
fn pyramid(layers: usize, mu: f64) -> Value {
    let r = 0.01;
    let mut blocks = Vec::new();
    for l in 0..layers {
        let m = layers - l;
        for (i, j) in (0..m * m).map(|k| (k / m, k % m)) {
            let across = |i: usize| (2.0 * i as f64 - (m - 1) as f64) * r;
            let at = [across(i), across(j), r + l as f64 * r * 2.0_f64.sqrt()];
            blocks.push(json!({ "id": format!("{l}/{i}/{j}"), "shape": { "sphere": { "radius": r } }, "at": at, "support": l == 0, "material": "glass" }));
        }
    }
    json!({
        "format": "voussoir-scene/1",
        "materials": { "glass": { "density": 2500, "young": E, "poisson": NU } },
        "joints": { "default": { "friction": mu } },
        "blocks": blocks
    })
}

/// Of a heap of hundreds of spheres, half of whose contacts open or slide, the state is found and proved;
/// it is as symmetric as the heap, and the fixed layer carries all of it.
#[test]
fn a_heap_comes_to_rest() {
    let a = state(pyramid(9, 0.8));
    assert!(a.residuals.unwrap().worst() < 1e-10, "{:?}", a.residuals);
    let slides = a.joints.iter().filter(|j| j.grip == Grip::Slides).count();
    let open = a.joints.iter().filter(|j| j.touch == Touch::Open).count();
    assert!(4 * slides > a.joints.len() && open > 0, "{slides} {open} {}", a.joints.len());
    let weight = 204.0 * 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-6 * 9.81;
    let carried: f64 =
        a.joints.iter().filter(|j| j.between[0].starts_with("0/")).map(|j| j.force[2]).sum();
    assert!((carried - weight).abs() < 1e-9 * weight, "{carried} {weight}");
    let scale = a.greatest.as_ref().unwrap().displacement;
    for l in 1..9 {
        let m = 9 - l;
        for (i, j) in (0..m * m).map(|k| (k / m, k % m)) {
            let down = |i, j| of(&a, &format!("{l}/{i}/{j}")).displacement[2];
            for other in [down(m - 1 - i, j), down(j, i)] {
                assert!((down(i, j) - other).abs() < 1e-6 * scale, "{l} {i} {j}");
            }
        }
    }
}

/// A tetrahedron of close-packed spheres on its fixed lowest layer, whose contacts stick and slide by
/// turns under steps that follow Coulomb's law alone: the state is found and proved.
#[test]
fn a_heap_that_sticks_and_slides_by_turns_comes_to_rest() {
    let (r, layers) = (0.01, 18);
    let mut scene = pyramid(2, 0.5);
    let mut blocks = Vec::new();
    for l in 0..layers {
        for (i, j) in (0..layers - l).flat_map(|i| (0..layers - l - i).map(move |j| (i, j))) {
            let (a, b, c) = (i as f64, j as f64, l as f64);
            let at = [2.0 * a + b + c, (3.0 * b + c) / 3.0_f64.sqrt(), c * (8.0_f64 / 3.0).sqrt()];
            blocks.push(json!({ "id": format!("{l}/{i}/{j}"), "shape": { "sphere": { "radius": r } }, "at": at.map(|x| r * x), "support": l == 0, "material": "glass" }));
        }
    }
    scene["blocks"] = blocks.into();
    let a = state(scene);
    assert!(a.residuals.unwrap().worst() < 1e-10, "{:?}", a.residuals);
}

/// A block on a floor far away changes nothing of a heap.
#[test]
fn what_stands_beside_a_heap_changes_nothing() {
    let alone = pyramid(9, 0.8);
    let mut beside = alone.clone();
    let block = |id: &str, z: f64, support: bool| json!({ "id": id, "shape": { "box": { "size": [0.1, 0.1, 0.02] } }, "at": [1.0, 0.0, z], "support": support });
    let blocks = beside["blocks"].as_array_mut().unwrap();
    blocks.extend([block("floor", 0.01, true), block("slab", 0.03, false)]);
    beside["joints"]["overrides"] =
        json!([{ "blocks": ["floor", "slab"], "normal_stiffness": 1e11, "shear_stiffness": 1e11 }]);
    let (alone, beside) = (state(alone), state(beside));
    let scale = alone.greatest.as_ref().unwrap().displacement;
    for own in &alone.displacements {
        let other = of(&beside, &own.block);
        for k in 0..3 {
            let off = (own.displacement[k] - other.displacement[k]).abs();
            assert!(off < 1e-6 * scale, "{}: {off}", own.block);
        }
    }
}

/// An arch of eleven voussoirs whose joints yield.
fn arch(normal: f64, shear: f64) -> Value {
    json!({
        "format": "voussoir-scene/1",
        "joints": { "default": { "friction": 0.6, "normal_stiffness": normal, "shear_stiffness": shear } },
        "templates": [{ "arch": { "radius": 5, "thickness": 0.9, "depth": 1, "voussoirs": 11 } }]
    })
}

fn greatest(forces: impl Iterator<Item = f64>) -> f64 {
    forces.fold(0.0, |m, v| m.max(v.abs()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Forces stay as they are, displacements go with the inverse.
    #[test]
    fn a_common_factor_on_stiffness_changes_no_force(decades in -3.0..3.0_f64, ratio in 0.2..2.0_f64) {
        let factor = 10f64.powf(decades);
        let (one, other) = (state(arch(1e10, ratio * 1e10)), state(arch(factor * 1e10, factor * ratio * 1e10)));
        let scale = greatest(one.joints.iter().flat_map(|j| j.force));
        for (a, b) in one.joints.iter().zip(&other.joints) {
            for (x, y) in a.force.iter().chain(&a.moment).zip(b.force.iter().chain(&b.moment)) {
                prop_assert!((x - y).abs() <= 1e-9 * scale, "{x} {y}");
            }
        }
        let scale = greatest(one.displacements.iter().flat_map(|d| d.displacement));
        for (a, b) in one.displacements.iter().zip(&other.displacements) {
            for (x, y) in a.displacement.iter().zip(&b.displacement) {
                prop_assert!((x - factor * y).abs() <= 1e-9 * scale, "{x} {y}");
            }
        }
    }
}

/// Neither the place on the map nor the directions of the axes nor what lies beside change it;
/// densities and stiffness in the same measure change forces alone.
#[test]
fn places_directions_neighbours_and_densities_do_not_matter() {
    let load = |force: [f64; 3], at: [f64; 3]| json!({ "live": [{ "block": "block", "force": force, "at": at }] });
    let one = state(bed(1e9, 4e8, load([1000.0, 0.0, 0.0], [0.0, 0.0, 2.0])));
    let way = |a: &StateAnswer, k: usize| a.curve.last().unwrap().displacement[k];
    let same = |what: &str, got: f64, want: f64, scale: f64| {
        assert!((got - want).abs() <= 1e-6 * scale, "{what}: {got} {want}");
    };
    let far = [4.1e4, -2.7e4, 350.0];
    let mut shifted = bed(
        1e9,
        4e8,
        load([1000.0, 0.0, 0.0], std::array::from_fn(|k| far[k] + [0.0, 0.0, 2.0][k])),
    );
    let mut beside = bed(1e9, 4e8, load([1000.0, 0.0, 0.0], [0.0, 0.0, 2.0]));
    for block in shifted["blocks"].as_array_mut().unwrap() {
        for k in 0..3 {
            block["at"][k] = json!(block["at"][k].as_f64().unwrap() + far[k]);
        }
    }
    // A thousand million times as heavy, on a soft joint, and sliding in part under a load of its own.
    beside["blocks"].as_array_mut().unwrap().push(json!({
        "id": "boulder", "shape": { "box": { "size": [1, 1, 1] } }, "at": [1.5, 1.5, 0.5],
        "material": "heavy"
    }));
    beside["materials"]["heavy"] = json!({ "density": 4e12 });
    beside["loads"]["dead"] =
        json!([{ "block": "boulder", "force": [2.4e13, 0, 0], "at": [1.5, 1.5, 0.5] }]);
    beside["joints"]["overrides"] = json!([{ "blocks": ["floor", "boulder"], "normal_stiffness": 1e14, "shear_stiffness": 1e3 }]);
    let across = state(bed(1e9, 4e8, load([0.0, 1000.0, 0.0], [0.0, 0.0, 2.0])));
    let mut dense = bed(1e10, 4e9, load([10000.0, 0.0, 0.0], [0.0, 0.0, 2.0]));
    dense["materials"]["stone"]["density"] = json!(20000);
    let beside_scene = beside.clone();
    let (shifted, beside, dense) = (state(shifted), state(beside), state(dense));
    for (what, other, k) in [
        ("place", &shifted, 0),
        ("neighbour", &beside, 0),
        ("axes", &across, 1),
        ("density", &dense, 0),
    ] {
        let (a, b) = (one.load_factor.unwrap(), other.load_factor.unwrap());
        same(what, b.value.unwrap(), a.value.unwrap(), a.value.unwrap());
        let [x, y] = [&one, other].map(|s| of(s, "block").displacement[2]);
        same(what, y, x, x.abs());
        // The greatest force of a curve at its end depends on where that is; its first way does not.
        let step = |s: &StateAnswer, k: usize| s.curve[1].displacement[k] / s.curve[1].load_factor;
        same(what, step(other, k), step(&one, 0), step(&one, 0).abs());
        assert!(way(other, k) > 0.0);
    }
    assert_eq!(beside.load_factor.unwrap().slides, one.load_factor.unwrap().slides);
    let turns = |s: &Value| state(s.clone()).load_factor.unwrap().slides;
    let moment = json!([{ "block": "block", "moment": [0, 1000, 0] }]);
    let mut turned = beside_scene.clone();
    turned["loads"]["live"] = moment;
    assert!(!turns(&turned), "what slides beside it takes no part");
    // Pressed without an end it is followed as far.
    let down = load([0.0, 0.0, -1000.0], [0.0, 0.0, 2.0]);
    let alone = state(bed(1e9, 4e8, down.clone())).load_factor.unwrap();
    turned["loads"]["live"] = down["live"].clone();
    let reached = state(turned).load_factor.unwrap().reached;
    assert_eq!(alone.end, PathEnd::Unbounded);
    same("end", reached, alone.reached, alone.reached);
    assert!(beside.joints.iter().any(|j| j.grip != Grip::Sticks), "{:?}", beside.joints);
    for f in &one.frequencies {
        assert!(
            beside.frequencies.iter().any(|g| (f - g).abs() <= 1e-6 * f),
            "{f} {:?}",
            beside.frequencies
        );
    }
    let [a, b] = [&one, &dense].map(|s| s.joints[0].normal_force);
    same("force", b, 10.0 * a, b);
}

/// A contact along an edge yields as the joints of its own blocks do, whatever lies elsewhere; where
/// they have none it is refused.
#[test]
fn an_edge_takes_its_share_from_its_own_blocks() {
    // A prism stands on its edge between two blocks that hold it with their faces.
    let scene = |more: bool| {
        let mut value = json!({
            "format": "voussoir-scene/1",
            "joints": { "default": { "friction": 0.7, "normal_stiffness": 1e9, "shear_stiffness": 1e9 } },
            "blocks": [
                { "id": "floor", "shape": { "box": { "size": [9, 9, 1] } }, "at": [0, 0, -0.5], "support": true },
                { "id": "roof", "shape": { "prism": { "polygon": [[-0.4, 0.4], [0, 0], [0.4, 0.4]], "depth": 1 } } },
                { "id": "left", "shape": { "box": { "size": [0.4, 1, 0.4] } }, "at": [-0.6, 0, 0.2] },
                { "id": "right", "shape": { "box": { "size": [0.4, 1, 0.4] } }, "at": [0.6, 0, 0.2] },
                { "id": "slab", "shape": { "box": { "size": [1.6, 1, 0.2] } }, "at": [0, 0, 0.5] }
            ]
        });
        if more {
            value["blocks"].as_array_mut().unwrap().push(json!({
                "id": "field", "shape": { "box": { "size": [3, 3, 1] } }, "at": [3, 3, 0.5]
            }));
        }
        value
    };
    let [one, other] = [false, true].map(|more| state(scene(more)));
    let edge = one.joints.iter().find(|j| j.between == ["floor", "roof"].map(String::from));
    assert!(edge.unwrap().normal_force > 0.0, "{:?}", one.joints);
    for d in &one.displacements {
        let here = of(&other, &d.block).displacement;
        for (a, b) in d.displacement.iter().zip(here) {
            assert!((a - b).abs() <= 1e-9 * d.displacement[2].abs(), "{} {a} {b}", d.block);
        }
    }
}

/// Rows of a sweep show the load factor of the path, or without a live load how far it moves.
#[test]
fn a_row_is_the_load_factor_or_the_displacement() {
    let row = |value: Value| {
        let scene = scene(value);
        let question = Question::State(StateOptions::default()).for_one_number();
        let model = prepare(&scene).unwrap();
        RowAnswer::of_answer(&ask(&question, &scene, &model, &Control::default()).unwrap())
    };
    let live = json!({ "live": [{ "block": "block", "moment": [0, 1000, 0] }] });
    let factor = row(bed(1e9, 4e8, live));
    assert_eq!(factor.status, RowStatus::Found);
    assert!((factor.value.unwrap() - N / 2000.0).abs() < 1e-6 * N / 2000.0);
    let way = row(bed(1e9, 4e8, json!({})));
    assert_eq!(way.status, RowStatus::Found);
    assert!((way.value.unwrap() - N / 1e9).abs() < 1e-9 * N / 1e9);
}

/// With one stiffness everywhere, at corners, the state is that under dry friction of the other questions
/// (program C): there blocks yield as well, by ε, and what is between them falls with it, to 1e-6.
#[test]
fn at_corners_it_is_the_state_under_dry_friction() {
    for friction in [0.6, 0.35] {
        let mut value = arch(1e10, 1e10);
        value["joints"]["default"]["friction"] = json!(friction);
        let scene = scene(value);
        let model = prepare(&scene).unwrap();
        let options = StateOptions { quadrature: Quadrature::Corners, ..Default::default() };
        let file = result(&scene, options);
        let a = file.answer.state().unwrap();
        let slides = a.joints.iter().any(|j| j.grip != Grip::Sticks);
        assert_eq!(slides, friction < 0.5, "{friction}");
        let scale = greatest(a.joints.iter().map(|j| j.normal_force));
        let control = Control { keep_all: true, ..Default::default() };
        let off = |epsilon: f64| {
            let dry = coulomb::refined(&model, &control, epsilon);
            assert_eq!(dry.steps.last().unwrap().epsilon, epsilon);
            greatest(a.joints.iter().zip(&dry.forces).flat_map(|(j, forces)| {
                let sum = |i: usize| forces.iter().map(|w| w.force[i]).sum::<f64>();
                [0, 1, 2].map(|i| (j.force[i] - sum(i)) / scale)
            }))
        };
        let [one, two, last] = [1e-5, 1e-6, 1e-9].map(off);
        println!("{friction}: {one:.2e} {two:.2e} {last:.2e}");
        assert!(two < 0.2 * one && last < 1e-6, "{friction}: {one} {two} {last}");
    }
}

/// What slides on the way to its bound is followed to it: a block pushed at its centre of mass slides in
/// part first, and has μ for its load factor, whatever hardly moves beside it; a sphere whose rim slides
/// first has it, too.
#[test]
fn a_path_that_slides_ends_at_its_dry_load_factor() {
    let push = json!({ "live": [{ "block": "block", "force": [N, 0, 0] }] });
    let mut block = bed(1e9, 4e8, push);
    block["joints"]["default"]["friction"] = json!(0.3);
    let mut beside = block.clone();
    beside["materials"]["light"] = json!({ "density": 2e-6 });
    beside["blocks"].as_array_mut().unwrap().push(json!({
        "id": "feather", "shape": { "box": { "size": [1, 1, 1] } }, "at": [1.5, 1.5, 0.5],
        "material": "light"
    }));
    let (value, force) = spheres(100.0, [0.0; 2], 1.0);
    for (value, exact) in [(block, 0.3), (beside, 0.3), (value, 0.3 * force)] {
        let a = state(value);
        let l = a.load_factor.unwrap();
        assert!(l.slides && l.value == Some(l.reached), "{l:?}");
        let off = exact - l.reached;
        assert!(-1e-12 * exact <= off && off <= 1e-6 * exact, "{l:?} {exact}");
    }
}

/// The ring of a sheared sphere that slides is an event, and so is its end; a sphere pressed alone has
/// none.
#[test]
fn spheres_that_slide_in_part_say_so() {
    let a = state(spheres(100.0, [0.0; 2], 1.0).0);
    assert_eq!(a.joints[0].grip, Grip::Sticks);
    assert_eq!(a.events[0].kind, EventKind::Slips, "{:?}", a.events);
    assert!(a.events[0].load_factor < 1e-3 && a.joints_at_end[0].slip > 0.0);
    assert_eq!(a.joints_at_end[0].grip, Grip::Slips);
}

/// Drawings show pressures and displacements, with the numbers.
#[test]
fn pressure_and_displacement_are_drawn() {
    let file = result(&scene(bed(1e9, 4e8, json!({}))), StateOptions::default());
    let model = prepare(&scene(bed(1e9, 4e8, json!({})))).unwrap();
    let view = View::new(&model, &file, Vec::new()).unwrap();
    // All of the joint presses evenly.
    assert_eq!(view.pressures.len(), 1);
    for p in &view.pressures[0].pressure {
        assert!((p - N).abs() < 1e-9 * N, "{p}");
    }
    assert!((view.motions[0].reach - N / 1e9).abs() < 1e-9 * N / 1e9);
    let svg = drawing::svg(&view, drawing::Aspect::Auto);
    for words in ["pressure, up to 39240 Pa", "displacements under the dead load × "] {
        assert!(svg.contains(words), "{words}");
    }
}

/// Where a rigid scene falls there is no state, and where there is one it stands.
#[test]
fn verdicts_are_those_of_rigid_blocks() {
    for (thickness, stands) in [(0.45, false), (0.6, true), (0.9, true)] {
        let mut value = arch(1e10, 4e9);
        value["templates"][0]["arch"]["thickness"] = json!(thickness);
        value["templates"][0]["arch"]["voussoirs"] = json!(27);
        let scene = scene(value);
        let rigid = assess(&prepare(&scene).unwrap(), &Control::default()).verdict;
        let file = result(&scene, StateOptions::default());
        let a = file.answer.state().unwrap();
        assert_eq!((rigid == Verdict::Stable, a.verdict), (stands, rigid), "{thickness}");
        assert_eq!(a.greatest.is_some(), stands);
    }
}

/// Twice the load is not twice the displacement.
#[test]
fn states_are_not_added_up() {
    let turned = |moment: f64| {
        let dead = json!({ "dead": [{ "block": "block", "moment": [0, moment, 0] }] });
        of(&state(bed(1e9, 4e8, dead)), "block").rotation[1]
    };
    let (one, two) = (turned(6000.0), turned(12000.0));
    assert!(two > 2.2 * one, "{one} {two}");
}

/// Displacements, forces, words: whatever is changed is refused.
#[test]
fn forged_results_are_refused() {
    let live = json!({ "live": [{ "block": "block", "moment": [0, 1000, 0] }] });
    let scene = scene(bed(1e9, 4e8, live));
    let file = result(&scene, StateOptions::default());
    crate::ask::leaves_hold(&file);
    let step = |v: &mut Value, k: usize, key: &str, axis: usize| {
        let own = &mut v["evidence"]["state"]["steps"][k]["displacements"][0][key][axis];
        *own = json!(own.as_f64().unwrap() * 1.001 + 1e-9);
    };
    let edits: [crate::ask::Edit; 3] = [
        ("sunk deeper", &|v| step(v, 0, "displacement", 2)),
        ("turned more", &|v| step(v, 9, "rotation", 1)),
        ("integrated otherwise", &|v| v["question"]["state"]["quadrature"] = json!("corners")),
    ];
    crate::ask::edits_are_refused(&scene, &file, &edits);
    let mut softer = scene.clone();
    softer.joints.default.normal_stiffness = Some(9e8);
    assert!(!crate::ask::check(&softer, &file).proved());
}

/// Errors name place and remedy.
#[test]
fn what_has_no_answer_is_said() {
    let text = |value: Value| read_str("scene.json".to_string(), value.to_string());
    let refused = |value: Value, words: &[&str]| {
        let (s, _) = text(value).unwrap();
        let asked = Question::State(StateOptions::default());
        let answer = prepare(&s).and_then(|m| ask(&asked, &s, &m, &Control::default()));
        let said = match answer {
            Ok(_) => panic!("{words:?}"),
            Err(e) => format!("{} {} {}", e.path, e.message, e.hint.unwrap_or_default()),
        };
        for word in words {
            assert!(said.contains(word), "{said}");
        }
    };
    refused(bed(-1.0, 1.0, json!({})), &["joints.default.normal_stiffness", "> 0", "Pa"]);
    let mut none = bed(1e9, 1e9, json!({}));
    none["joints"]["default"] = json!({ "friction": 0.7 });
    refused(none.clone(), &["no normal_stiffness", "joints.default"]);
    none["joints"]["default"] =
        json!({ "friction": 0.7, "cohesion": 1e5, "normal_stiffness": 1e9 });
    refused(none.clone(), &["cohesion"]);
    none["materials"]["stone"] = json!({ "density": 2000, "young": 1e9 });
    refused(none.clone(), &["materials.stone", "poisson"]);
    none["materials"]["stone"] = json!({ "density": 2000, "young": 1e9, "poisson": 0.7 });
    refused(none, &["materials.stone.poisson", "0.5"]);
    let scene = scene(bed(1e9, 1e9, json!({})));
    let model = prepare(&scene).unwrap();
    let control = Some(ControlPoint { block: "block".into(), point: [0.0, 0.0, 2.0] });
    let asked = Question::State(StateOptions { control, ..Default::default() });
    let error = ask(&asked, &scene, &model, &Control::default()).unwrap_err().to_string();
    assert!(error.contains("live"), "{error}");
}

/// A stiffness in N/mm³ is found out.
#[test]
fn stiffness_in_another_unit_is_a_finding() {
    let said = |k: f64| {
        let model = prepare(&scene(bed(k, 1e9, json!({})))).unwrap();
        model.findings().any(|f| f.text.contains("normal_stiffness"))
    };
    assert!(said(10.0) && said(1e4) && !said(1e9) && !said(1e7));
}
