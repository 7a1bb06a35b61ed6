//! Ties, struts, tendons, strips, dowels, soil, grips and toothed corners: published values and
//! closed forms, with proof; forged forces and rates are refused; units, density, rotation and order
//! change nothing.

use crate::ask::{
    cuboid, fixed, ground, model, outcome, prism, prove, push, scene, survives, template, verdict,
};
use nalgebra::{Rotation3, Unit, Vector3};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::PI;
use voussoir::{
    analysis::{
        self, Control, Law, Limited, Outcome, Question, ThrustOptions,
        critical::Range,
        thrust::{self, Ends},
    },
    dynamics::Fate,
    interface,
    proof::{member::MemberState, saved},
    scene::{Scene, read_str},
    verdict::{Verdict, mechanism::MemberMotion},
};

const NO_SLIDING: f64 = f64::INFINITY;

fn associative() -> Control {
    Control { law: Law::Associative, ..Control::default() }
}

fn close(what: &str, got: f64, want: f64, relative: f64) {
    assert!((got - want).abs() <= relative * want.abs(), "{what}: {got} expected {want}");
}

/// The load factor, with proof.
fn lambda(scene: &Scene) -> f64 {
    let (outcome, value) = outcome(scene);
    assert_eq!(outcome, Outcome::Found, "{}", scene.name);
    value.unwrap()
}

/// Least and greatest force in a member, with proof; none where there is no end.
fn range(scene: &Scene, member: &str) -> [Option<f64>; 2] {
    range_along(scene, member, None)
}

fn range_along(scene: &Scene, member: &str, along: Option<[f64; 3]>) -> [Option<f64>; 2] {
    let m = model(scene);
    let at = thrust::member(&m, member, along).unwrap();
    let answer = thrust::answer(&m, at, Ends::Both, &associative());
    let file = saved::thrust(scene, &m, &answer).unwrap();
    prove(scene, &file);
    let t = file.answer.thrust().expect("it stands").clone();
    [t.least, t.greatest].map(|e| {
        assert!(matches!(e.status, Outcome::Found | Outcome::Unbounded), "{t:?}");
        e.value
    })
}

/// The value at which the scene begins to stand, by the default law.
fn least(scene: &Scene, pointer: &str, between: [f64; 2], law: Law) -> f64 {
    let range = Range { pointer: pointer.into(), from: between[0], to: between[1], scan: Some(9) };
    let answer = analysis::critical(scene, &range, &Control { law, ..Control::default() }).unwrap();
    let [flip] = &answer.changes[..] else { panic!("{} flips", answer.changes.len()) };
    assert_eq!(flip.above.assessment.verdict, Verdict::Stable);
    flip.value
}

/// An arch of 16 voussoirs, t/R 0.15, on two piers, with a tie at the springings.
fn tied_arch(width: f64, strength: Value, live: bool) -> Scene {
    let arch = json!({ "arch": { "radius": 1, "thickness": 0.15, "depth": 1, "voussoirs": 16,
        "buttresses": { "width": width, "height": 2 } } });
    let mut more = if live { push([1.0, 0.0, 0.0]) } else { json!({}) };
    if !strength.is_null() {
        more["members"] = json!([{ "id": "tie", "tie": { "between": [
            { "block": "buttress_left", "at": [-0.925, 0, 0] },
            { "block": "buttress_right", "at": [0.925, 0, 0] } ], "strength": strength } }]);
    }
    template(NO_SLIDING, arch, more)
}

/// A public case, TI01: an arch on slender piers.
#[test]
fn a_tie_holds_an_arch_on_slender_piers() {
    for (width, load_factor, greatest) in [
        (0.3, 0.1140764611, 0.1693663739),
        (0.35, 0.1335267752, 0.1856163739),
        (0.4, 0.1499692359, 0.2043663739),
        (0.5, 0.1499692359, 0.2493663739),
    ] {
        close("λ", lambda(&tied_arch(width, json!("infinite"), true)), load_factor, 2e-8);
        let still = tied_arch(width, json!("infinite"), false);
        let [low, high] = range(&still, "tie");
        close("greatest", high.unwrap(), greatest, 2e-8);
        let least = if width < 0.35 { 0.013134174 } else { 0.0 };
        assert!((low.unwrap() - least).abs() < 1e-9, "least {low:?}");
    }
    for (width, load_factor) in [(0.35, 0.0145057147), (0.4, 0.0503545352)] {
        close("without", lambda(&tied_arch(width, Value::Null, true)), load_factor, 2e-8);
    }
    let weak = tied_arch(0.3, json!(0.013), true);
    assert_eq!(outcome(&tied_arch(0.3, Value::Null, true)).0, Outcome::Impossible);
    assert_eq!(verdict(&tied_arch(0.3, json!("infinite"), false), Law::Coulomb), Verdict::Stable);
    assert_eq!(verdict(&weak, Law::Coulomb), Verdict::Unstable);
    let s = tied_arch(0.3, json!(1.0), false);
    let found = least(&s, "/members/0/tie/strength", [0.0, 0.1], Law::Coulomb);
    close("critical", found, 0.013134174, 2e-8);
}

/// The mechanism says which members yield and which go slack, and the answer how they carry.
#[test]
fn mechanisms_and_answers_name_the_members() {
    let s = tied_arch(0.3, json!(0.02), true);
    let m = model(&s);
    let bound = analysis::limit(&m, &associative());
    let mechanism = bound.mechanism.as_ref().unwrap();
    assert_eq!(mechanism.members.len(), 1);
    assert_eq!(mechanism.members[0].motion, MemberMotion::Yields);
    let file = saved::load_factor(&s, &m, &bound.into()).unwrap();
    let [line] = &file.members[..] else { panic!("{:?}", file.members) };
    assert_eq!(line.state, MemberState::AtStrength);
    close("force", line.force, 0.02, 1e-6);
}

/// A wall of 6 m with an eccentric floor, toe at x = 0, pushed towards +x.
fn wall(members: Value) -> Scene {
    let weight = 19000.0 * 0.6 * 6.0;
    let more = json!({ "loads": {
        "dead": [{ "block": "wall", "force": [0, 0, -40000], "at": [-0.4, 0, 6] }],
        "live": [{ "block": "wall", "force": [weight, 0, 0], "at": [-0.3, 0, 3] },
                 { "block": "wall", "force": [40000, 0, 0], "at": [-0.4, 0, 6] }] },
        "materials": { "unit": { "density": 19000 } }, "members": members });
    scene(NO_SLIDING, json!([ground(), cuboid("wall", [0.6, 1.0, 6.0], [-0.3, 0.0, 0.0])]), more)
}

/// Public cases SK02 and SK04 (the tie), SK06 (the friction of a toothed corner).
#[test]
fn a_facade_is_held_by_a_tie_or_by_its_toothing() {
    close("SK02", lambda(&wall(json!([]))), 0.08203054807, 1e-8);
    let tie = json!([{ "id": "tie", "tie": { "strength": 15000, "between": [
        { "block": "wall", "at": [-0.3, 0, 5.5] }, { "ground": [-6, 0, 5.5] } ] } }]);
    close("SK04", lambda(&wall(tie)), 0.2673405211, 1e-8);
    let corner = json!([{ "id": "corner", "toothing": { "block": "wall", "courses": 12,
        "block_height": 0.2, "overlap": 0.15, "friction": 0.577, "thickness": 0.5,
        "unit_weight": 19000, "height": 2, "direction": [-1, 0, 0] } }]);
    let s = wall(corner);
    let strength = model(&s).interfaces.members[0].greatest;
    close("SK06", strength, 10261.368, 1e-7);
    let said = model(&s).findings().any(|f| f.text.contains("corner") && f.text.contains("10261"));
    assert!(said, "the strength is said");
    let (w, p) = (68400.0, 40000.0);
    let want = (w * 0.3 + p * 0.4 + strength * 2.0) / (w * 3.0 + p * 6.0);
    close("toothed", lambda(&s), want, 1e-8);
}

/// A public case, TI03: a strip on either face of an arch, springings included.
#[test]
fn a_bonded_strip_strengthens_every_joint() {
    let area = 16.0 * 0.5 * (PI / 16.0).sin() * (1.075f64.powi(2) - 0.925f64.powi(2));
    let strip = |face: &str, share: f64, live: Value| {
        let mut run = vec!["springer_left".to_string()];
        run.extend((0..16).map(|k| format!("v{k:02}")));
        run.push("springer_right".into());
        let arch =
            json!({ "arch": { "radius": 1, "thickness": 0.15, "depth": 1, "voussoirs": 16 } });
        let members = json!([{ "id": "strip", "strip": { "blocks": run, "face": face, "width": 0.5,
            "strength": 2.0 * share * area } }]);
        template(NO_SLIDING, arch, json!({ "loads": { "live": [live] }, "members": members }))
    };
    for face in ["extrados", "intrados"] {
        for (share, body, point) in [
            (0.01, 0.1620325693, 0.8148209124),
            (0.05, 0.2102859031, 0.9174779241),
            (0.1, 0.2651171658, 1.0457991888),
        ] {
            let sideways = json!({ "weight": [1, 0, 0] });
            close(face, lambda(&strip(face, share, sideways)), body, 2e-8);
            let down = json!({ "block": "v03", "force": [0, 0, -area] });
            close(face, lambda(&strip(face, share, down)), point, 2e-8);
        }
    }
    let s = strip("extrados", 0.01, json!({ "weight": [1, 0, 0] }));
    assert_eq!(model(&s).interfaces.members.len(), 17);
}

/// A cube held by two opposed fingers, a ball by three around it; density 1, gravity 1.
fn gripped(fingers: usize, friction: f64, strength: f64) -> (Scene, f64) {
    let around = |k: usize| {
        let (sin, cos) = (2.0 * PI * k as f64 / fingers as f64).sin_cos();
        json!({ "at": [cos, sin, 0], "normal": [-cos, -sin, 0] })
    };
    let list: Vec<Value> = (0..fingers).map(around).collect();
    let members = json!([{ "id": "hand", "grip": { "block": "part", "fingers": list,
        "friction": friction, "strength": strength } }]);
    let (part, weight) = if fingers == 2 {
        (cuboid("part", [2.0, 2.0, 2.0], [0.0, 0.0, -1.0]), 8.0)
    } else {
        (crate::ask::sphere("part", 1.0, [0.0; 3]), 4.0 / 3.0 * PI)
    };
    let table = fixed(cuboid("table", [9.0, 9.0, 1.0], [0.0, 0.0, -9.0]));
    (scene(0.5, json!([table, part]), json!({ "members": members })), weight)
}

#[test]
fn the_least_grip_that_holds() {
    for fingers in [2, 3] {
        for friction in [0.3, 0.5, 0.9] {
            let (s, weight) = gripped(fingers, friction, 1.0);
            let want = weight / (fingers as f64 * friction);
            for law in [Law::Coulomb, Law::Associative] {
                let range = [0.4 * want, 2.1 * want];
                let found = least(&s, "/members/0/grip/strength", range, law);
                close("least grip", found, want, 1e-8);
            }
            // At less friction more is needed: the lower end of a range is the worst.
            let (s, _) = gripped(fingers, friction, 1.01 * want);
            assert_eq!(verdict(&s, Law::Coulomb), Verdict::Stable);
            let (s, _) = gripped(fingers, 0.9 * friction, 1.01 * want);
            assert_eq!(verdict(&s, Law::Coulomb), Verdict::Unstable);
        }
    }
    // The range of what one finger presses with: all of them up to the strength.
    let (s, weight) = gripped(2, 0.5, 10.0);
    let [low, high] = range(&s, "hand/1").map(Option::unwrap);
    close("least", low, weight, 1e-8);
    close("greatest", high, 10.0, 1e-8);
}

/// Fingers apply their force: two that do not balance move the block, whatever could be.
#[test]
fn fingers_that_do_not_balance_move_the_block() {
    let grip = |id: &str, x: f64, strength: f64| {
        json!({ "id": id, "grip": { "block": "part",
        "at": [x, 0, 0], "normal": [-x, 0, 0], "friction": 0.5, "strength": strength } })
    };
    let table = fixed(cuboid("table", [9.0, 9.0, 1.0], [0.0, 0.0, -9.0]));
    let part = cuboid("part", [2.0, 2.0, 2.0], [0.0, 0.0, -1.0]);
    let members = json!({ "members": [grip("a", 1.0, 12.0), grip("b", -1.0, 24.0)] });
    let s = scene(0.5, json!([table, part]), members);
    assert_eq!(verdict(&s, Law::Associative), Verdict::Stable);
    assert_eq!(verdict(&s, Law::Coulomb), Verdict::Conditional);
}

/// What fingers hold beside a block that slides stands on forces with which they press with all their
/// strength: others refuted the load factor of the block.
#[test]
fn what_slides_beside_a_grip_has_its_load_factor() {
    let finger = |x: f64| json!({ "at": [x, 0, 0], "normal": [-x, 0, 0] });
    let grip = json!({ "id": "gripper", "grip": {
        "block": "held", "friction": 0.5, "strength": 20.0, "fingers": [finger(1.0), finger(-1.0)] } });
    let blocks = json!([
        fixed(cuboid("table", [9.0, 9.0, 1.0], [0.0, 0.0, -9.0])),
        cuboid("held", [2.0, 2.0, 2.0], [0.0, 0.0, -1.0]),
        cuboid("slab", [1.0, 1.0, 0.2], [3.0, 0.0, -8.0]),
    ]);
    let live = json!([{ "block": "slab", "weight": [1, 0, 0] }]);
    let s = scene(0.4, blocks, json!({ "members": [grip], "loads": { "live": live } }));
    let m = model(&s);
    let bound = analysis::limit(&m, &Control::default());
    let dry = analysis::coulomb::load_factor(&m, &bound, &Control::default());
    close("λ", dry.value.unwrap(), 0.4, 1e-6);
    let limited = Limited { dry: Some(dry), ..bound.into() };
    prove(&s, &saved::load_factor(&s, &m, &limited).unwrap());
}

/// A unit cube on the ground, pushed along x by its weight.
fn cube(friction: f64, members: Value) -> Scene {
    let mut more = push([1.0, 0.0, 0.0]);
    more["members"] = members;
    scene(friction, json!([ground(), cuboid("a", [1.0, 1.0, 1.0], [0.0; 3])]), more)
}

#[test]
fn closed_forms_of_every_kind() {
    let end = |x: f64, z: f64| json!({ "block": "a", "at": [x, 0, z] });
    let ground = |x: f64, z: f64| json!({ "ground": [x, 0, z] });
    let line = |kind: &str, ends: [Value; 2], strength: f64| {
        let mut m = json!({ "id": "m" });
        m[kind] = json!({ "between": ends, "strength": strength });
        json!([m])
    };
    // Topples about (0.5, 0): λ × 0.5 = 0.5 + moment of the member.
    let tie = line("tie", [end(-0.5, 1.0), ground(-2.0, 1.0)], 0.1);
    close("tie", lambda(&cube(NO_SLIDING, tie)), 1.2, 1e-8);
    let slack = line("tie", [end(0.5, 1.0), ground(2.0, 1.0)], 0.1);
    close("a tie does not push", lambda(&cube(NO_SLIDING, slack)), 1.0, 1e-8);
    let strut = line("strut", [end(0.5, 1.0), ground(2.0, 1.0)], 0.1);
    close("strut", lambda(&cube(NO_SLIDING, strut)), 1.2, 1e-8);
    let bar = |x: f64| {
        let to = ground(if x > 0.0 { 2.0 } else { -2.0 }, 1.0);
        json!([{ "id": "m", "bar": { "between": [end(x, 1.0), to], "tension": 0.1, "compression": 0.2 } }])
    };
    close("bar pulls", lambda(&cube(NO_SLIDING, bar(-0.5))), 1.2, 1e-8);
    close("bar pushes", lambda(&cube(NO_SLIDING, bar(0.5))), 1.4, 1e-8);
    // From the ground over the top of the block and down again: it presses with 2 T on the corners.
    let tendon = json!([{ "id": "m", "tendon": { "strength": 0.1, "through": [
        { "ground": [-0.5, 0, -1] }, { "block": "a", "at": [-0.5, 0, 1] },
        { "block": "a", "at": [0.5, 0, 1] }, { "ground": [0.5, 0, -1] } ] } }]);
    close("tendon", lambda(&cube(NO_SLIDING, tendon)), 1.2, 1e-8);
    let dowel = json!([{ "id": "m", "dowel": { "blocks": ["ground", "a"], "at": [0, 0, 0], "strength": 0.1 } }]);
    close("dowel", lambda(&cube(0.3, dowel)), 0.4, 1e-8);
    // K γ z A of 0.1 at half the height, against the push.
    let soil = json!([{ "id": "m", "soil": { "block": "a", "face": "+x", "direction": [-1, 0, 0],
        "surface": 1.0, "unit_weight": 0.1, "k": 2.0 } }]);
    close("soil", lambda(&cube(NO_SLIDING, soil)), 1.1, 1e-8);
    let finger = json!([{ "id": "m", "grip": { "block": "a", "at": [0, 0, 1], "normal": [0, 0, -1],
        "friction": 0, "strength": 0.5 } }]);
    close("finger", lambda(&cube(NO_SLIDING, finger)), 1.5, 1e-8);
    let idle = line("tie", [end(-0.5, 1.0), ground(-2.0, 1.0)], 0.0);
    close("no strength", lambda(&cube(NO_SLIDING, idle)), 1.0, 1e-8);
}

/// In the state under dry friction as well, prestress and all, with one proof for each.
#[test]
fn prestress_is_no_condition() {
    for prestress in [0.0, 0.05, 0.1] {
        let members = json!([{ "id": "m", "tie": { "strength": 0.1, "prestress": prestress, "stiffness": 3.0,
            "between": [{ "block": "a", "at": [-0.5, 0, 1] }, { "ground": [-2, 0, 1] }] } }]);
        let s = cube(0.7, members);
        assert_eq!(verdict(&s, Law::Coulomb), Verdict::Stable);
        close("λ", lambda(&s), 0.8, 1e-8);
        let limited = analysis::ask(
            &Question::Limit(Default::default()),
            &s,
            &model(&s),
            &Control::default(),
        )
        .unwrap();
        let analysis::Answer::Limit(limited) = limited else { panic!() };
        let dry = limited.dry.as_ref().unwrap().value.unwrap();
        close("dry", dry, 0.8, 1e-6);
    }
}

/// A strut never yields: it is as good as a bar block between two pins.
#[test]
fn a_strut_is_a_bar_block_between_two_pins() {
    let leaning = |members: Value, more: Option<Value>| {
        let left = prism("left", &[[-2.0, 0.0], [-1.5, 0.0], [-0.7, 4.0], [-1.2, 4.0]]);
        let right = prism("right", &[[1.5, 0.0], [2.0, 0.0], [1.2, 4.0], [0.7, 4.0]]);
        let mut blocks = vec![ground(), left, right];
        let mut rest = push([1.0, 0.0, 0.0]);
        rest["members"] = members;
        if let Some(bar) = more {
            blocks.push(bar);
            let pin = |a: &str, b: &str, x: f64, n: f64| {
                json!({ "between": [a, b],
                "points": [[x, 0, 3.0]], "normal": [n, 0, 0] })
            };
            rest["interfaces"] =
                json!([pin("left", "bar", -0.9, 1.0), pin("bar", "right", 0.9, 1.0)]);
        }
        scene(NO_SLIDING, json!(blocks), rest)
    };
    let strut = json!([{ "id": "s", "strut": { "strength": "infinite", "between": [
        { "block": "left", "at": [-0.9, 0, 3] }, { "block": "right", "at": [0.9, 0, 3] } ] } }]);
    let mut bar = cuboid("bar", [1.8, 0.1, 0.1], [0.0, 0.0, 2.95]);
    bar["mass"] = json!(1e-9);
    let with_bar = leaning(json!([]), Some(bar));
    close("bar block", lambda(&with_bar), lambda(&leaning(strut, None)), 1e-6);
}

#[test]
fn a_member_joins_parts_and_the_ground_does_not() {
    let two = |members: Value| {
        let blocks = json!([
            ground(),
            cuboid("a", [1.0, 1.0, 1.0], [0.0; 3]),
            cuboid("b", [1.0, 1.0, 1.0], [5.0, 0.0, 0.0])
        ]);
        model(&scene(0.5, blocks, json!({ "members": members })))
    };
    let parts = |members: Value| interface::parts(&two(members)).len();
    assert_eq!(parts(json!([])), 2);
    let tie = |to: Value| json!([{ "id": "t", "tie": { "strength": 1, "between": [{ "block": "a", "at": [0.5, 0, 0.5] }, to] } }]);
    assert_eq!(parts(tie(json!({ "block": "b", "at": [4.5, 0, 0.5] }))), 1);
    assert_eq!(parts(tie(json!({ "ground": [4.5, 0, 0.5] }))), 2);
}

/// A block that hangs on cables alone; one cable is enough below, two that spread hold it aside.
#[test]
fn a_block_hangs_on_cables() {
    let hung = |strength: f64| {
        let tie = |id: &str, x: f64| {
            json!({ "id": id, "tie": { "strength": strength, "between": [
            { "block": "a", "at": [0, 0, 1] }, { "ground": [x, 0, 2] } ] } })
        };
        let roof = fixed(cuboid("roof", [9.0, 9.0, 1.0], [0.0, 0.0, 8.0]));
        let a = cuboid("a", [1.0, 1.0, 1.0], [0.0; 3]);
        scene(0.5, json!([roof, a]), json!({ "members": [tie("p", -1.0), tie("q", 1.0)] }))
    };
    let want = 0.5f64.sqrt();
    assert_eq!(verdict(&hung(1.001 * want), Law::Coulomb), Verdict::Stable);
    assert_eq!(verdict(&hung(0.999 * want), Law::Coulomb), Verdict::Unstable);
    let [low, high] = range(&hung(2.0), "p").map(Option::unwrap);
    close("least", low, want, 1e-8);
    close("greatest", high, want, 1e-8);
    assert_eq!(outcome(&cube(0.5, json!([]))).0, Outcome::Found);
}

#[test]
fn forged_members_are_refused() {
    let s = tied_arch(0.3, json!(0.1), false);
    let m = model(&s);
    let file = saved::assessment(&s, &m, &analysis::assess(&m, &Control::default())).unwrap();
    assert!(survives(&s, &file, |_| {}));
    let force = "/evidence/assess/standing/certificate/members/0/force/0";
    type Edit<'a> = (&'a str, &'a dyn Fn(&mut Value));
    let edits: [Edit; 6] = [
        ("beyond its strength", &|v| *v.pointer_mut(force).unwrap() = json!(0.2)),
        ("a tie that pushes", &|v| *v.pointer_mut(force).unwrap() = json!(-0.05)),
        ("another force", &|v| {
            let x = v.pointer(force).unwrap().as_f64().unwrap();
            *v.pointer_mut(force).unwrap() = json!(1.001 * x);
        }),
        ("no force", &|v| {
            v["evidence"]["assess"]["standing"]["certificate"]["members"] = json!([])
        }),
        ("two amounts", &|v| {
            v["evidence"]["assess"]["standing"]["certificate"]["members"][0]["force"] =
                json!([0.05, 0.0])
        }),
        ("the line says more", &|v| v["answer"]["members"][0]["force"] = json!(0.09)),
    ];
    for (what, edit) in edits {
        assert!(!survives(&s, &file, edit), "{what}");
    }
    // A mechanism that lengthens a tie as if it were not there, and one that calls it slack.
    let s = tied_arch(0.3, json!(0.013), false);
    let m = model(&s);
    let file = saved::assessment(&s, &m, &analysis::assess(&m, &Control::default())).unwrap();
    assert!(survives(&s, &file, |_| {}));
    let mut strong = s.clone();
    strong.members[0].tie.as_mut().unwrap().strength = voussoir::scene::member::Strength::Infinite;
    assert!(!survives(&strong, &file, |_| {}), "the tie never yields");
    assert!(!survives(&s, &file, |v| v["answer"]["mechanism"]["members"] = json!([])), "unnamed");
    // A range that claims more than it proves.
    let s = tied_arch(0.3, json!("infinite"), false);
    let m = model(&s);
    let at = thrust::member(&m, "tie", None).unwrap();
    let file = saved::thrust(&s, &m, &thrust::answer(&m, at, Ends::Both, &associative())).unwrap();
    assert!(survives(&s, &file, |_| {}));
    for (k, end) in ["least", "greatest"].into_iter().enumerate() {
        let forged = |v: &mut Value| {
            for place in [
                format!("/answer/thrust/{end}"),
                format!("/evidence/thrust/ends/{k}/claim/member_force"),
            ] {
                for key in ["value", "lower", "upper"] {
                    let number = v.pointer_mut(&format!("{place}/{key}")).unwrap();
                    *number = json!(number.as_f64().unwrap() * 1.01);
                }
            }
        };
        assert!(!survives(&s, &file, forged), "{end}");
    }
}

/// A unit cube of weight 1 on the ground at friction 0.3, with a load of 0.35 in its joint and a
/// dowel in the middle of it: shears `d` with ‖d‖ ≤ R and ‖d + load‖ ≤ 0.3.
fn doweled(strength: Value, load: [f64; 2]) -> Scene {
    let dowel = json!({ "id": "d", "dowel": { "blocks": ["ground", "a"], "at": [0, 0, 0], "strength": strength } });
    let dead = json!([{ "block": "a", "force": [load[0], load[1], 0], "at": [0, 0, 0] }]);
    let more = json!({ "members": [dowel], "loads": { "dead": dead } });
    scene(0.3, json!([ground(), cuboid("a", [1.0, 1.0, 1.0], [0.0; 3])]), more)
}

#[test]
fn the_shear_of_a_dowel_has_ends_in_every_direction() {
    let (load, friction): (f64, f64) = (0.35, 0.3);
    for strength in [0.1, 0.2, 0.4, f64::INFINITY] {
        let given = if strength.is_finite() { json!(strength) } else { json!("infinite") };
        for turn in [0.0, 0.4, 1.1] {
            let s = doweled(given.clone(), [load * f64::cos(turn), load * f64::sin(turn)]);
            for angle in [0.0, 0.3, 1.3, PI / 2.0, 2.8] {
                let along = [f64::cos(angle), f64::sin(angle), 0.0];
                // In axes along the load: two discs. An extreme of what they have in common is the
                // far point of one that lies in the other, or where their edges cross.
                let (x, y) = (f64::cos(angle - turn), f64::sin(angle - turn));
                let mut points = Vec::new();
                for sign in [-1.0, 1.0] {
                    if strength.is_finite() {
                        points.push((sign * strength * x, sign * strength * y));
                    }
                    points.push((sign * friction * x - load, sign * friction * y));
                    let cross =
                        (friction * friction - load * load - strength * strength) / (2.0 * load);
                    points.push((cross, sign * (strength * strength - cross * cross).sqrt()));
                }
                let common = points.into_iter().filter(|(a, b)| {
                    a.hypot(*b) <= strength + 1e-12 && (a + load).hypot(*b) <= friction + 1e-12
                });
                let ends = common.map(|(a, b)| a * x + b * y);
                let (low, high) = ends
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                        (low.min(v), high.max(v))
                    });
                let [least, greatest] = range_along(&s, "d", Some(along)).map(Option::unwrap);
                assert!((least - low).abs() <= 2e-7, "{strength} {turn} {angle}: {least} {low}");
                assert!(
                    (greatest - high).abs() <= 2e-7,
                    "{strength} {turn} {angle}: {greatest} {high}"
                );
            }
        }
    }
}

#[test]
fn a_dowels_direction_is_in_its_joint() {
    let s = doweled(json!(0.1), [0.35, 0.0]);
    let m = model(&s);
    // A plane scene has one direction; the part along the joint of one that is given counts.
    let [least, greatest] = range(&s, "d").map(Option::unwrap);
    close("greatest by size", least.abs().max(greatest.abs()), 0.1, 2e-7);
    close("least by size", least.abs().min(greatest.abs()), 0.05, 2e-6);
    let steep = range_along(&s, "d", Some([1.0, 0.0, 5.0])).map(Option::unwrap);
    close("least", steep[0], -0.1, 2e-7);
    close("greatest", steep[1], -0.05, 2e-6);
    let error = thrust::member(&m, "d", Some([0.0, 0.0, 2.0])).unwrap_err().to_string();
    assert!(error.contains("parallel to the normal"), "{error}");
    let s = doweled(json!(0.1), [0.3, 0.15]);
    let error = thrust::member(&model(&s), "d", None).unwrap_err().to_string();
    assert!(error.contains("--direction"), "{error}");
    let tie = tied_arch(0.3, json!(0.013), false);
    let error = thrust::member(&model(&tie), "tie", Some([1.0, 0.0, 0.0])).unwrap_err().to_string();
    assert!(error.contains("already has a direction"), "{error}");
    // Numbers, direction and claim of a saved range are held together.
    let along = Some([1.0, 0.0, 0.0]);
    let answer =
        thrust::answer(&m, thrust::member(&m, "d", along).unwrap(), Ends::Both, &associative());
    let s = doweled(json!(0.1), [0.35, 0.0]);
    let file = saved::thrust(&s, &m, &answer).unwrap();
    assert!(survives(&s, &file, |_| {}));
    assert!(!survives(&s, &file, |v| v["answer"]["thrust"]["direction"] = json!([-1, 0, 0])));
    assert!(!survives(&s, &file, |v| {
        v["answer"]["thrust"]["direction"] = json!([0, 1, 0]);
        for end in [0, 1] {
            v["evidence"]["thrust"]["ends"][end]["claim"]["member_force"]["along"] =
                json!([0, 1, 0]);
        }
    }));
    assert!(!survives(&s, &file, |v| {
        v["answer"]["thrust"]["direction"] = json!([2, 0, 0]);
        for end in [0, 1] {
            v["evidence"]["thrust"]["ends"][end]["claim"]["member_force"]["along"] =
                json!([2, 0, 0]);
        }
    }));
    for (k, end) in ["least", "greatest"].into_iter().enumerate() {
        assert!(!survives(&s, &file, |v| {
            for place in [
                format!("/answer/thrust/{end}"),
                format!("/evidence/thrust/ends/{k}/claim/member_force"),
            ] {
                for key in ["value", "lower", "upper"] {
                    let number = v.pointer_mut(&format!("{place}/{key}")).unwrap();
                    *number = json!(number.as_f64().unwrap() * 0.99);
                }
            }
        }));
    }
}

#[test]
fn members_that_mean_nothing_are_refused_with_place_and_remedy() {
    let ask = |member: Value| {
        let text = json!({ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.5 } },
            "blocks": [ground(), cuboid("a", [1.0, 1.0, 1.0], [0.0; 3])], "members": [member] });
        let (s, _) = match read_str("test", text.to_string()) {
            Ok(read) => read,
            Err(e) => return e.to_string(),
        };
        interface::prepare(&s).map_or_else(|e| e.to_string(), |_| "accepted".into())
    };
    let tie =
        |a: Value, b: Value| json!({ "id": "t", "tie": { "strength": 1, "between": [a, b] } });
    let on = |at: [f64; 3]| json!({ "block": "a", "at": at });
    let ground = json!({ "ground": [3, 0, 0] });
    for (member, says) in [
        (json!({ "id": "t" }), ["members[0]", "no kind"]),
        (
            json!({ "id": "", "tie": { "strength": 1, "between": [on([0.0; 3]), ground] } }),
            ["members[0].id", "empty"],
        ),
        (tie(on([0.0, 0.0, 0.5]), json!({})), ["tie.between[1]", "ground"]),
        (
            tie(json!({ "block": "b", "at": [0, 0, 0] }), ground.clone()),
            ["between[0].block", "no block"],
        ),
        (tie(on([0.0, 0.0, 900.0]), ground.clone()), ["between[0].at", "arm"]),
        (tie(ground.clone(), json!({ "ground": [1, 0, 0] })), ["tie.between", "free block"]),
        (tie(on([3.0, 0.0, 0.0]), ground.clone()), ["between[1]", "same place"]),
        (tie(on([0.0; 3]), on([0.0, 0.0, 1.0])), ["tie.between", "same block"]),
        (
            json!({ "id": "t", "tie": { "strength": -1, "between": [on([0.0; 3]), ground] } }),
            ["tie.strength", ">= 0"],
        ),
        (
            json!({ "id": "t", "tie": { "strength": 1, "prestress": 2, "between": [on([0.0; 3]), ground] } }),
            ["tie.prestress", "strength 1"],
        ),
        (
            json!({ "id": "t", "soil": { "block": "a", "face": "extrados", "direction": [1, 0, 0], "surface": 1, "unit_weight": 1, "k": 1 } }),
            ["soil.face", "near"],
        ),
        (
            json!({ "id": "t", "soil": { "block": "a", "face": "+x", "direction": [1, 0, 0], "surface": 1, "unit_weight": 1, "k": 1 } }),
            ["soil.direction", "into the face"],
        ),
        (
            json!({ "id": "t", "grip": { "block": "a", "at": [0, 0, 1], "normal": [0, 0, -1], "friction": 0.5, "strength": "infinite" } }),
            ["grip.strength", "number"],
        ),
        (
            json!({ "id": "t", "grip": { "block": "a", "friction": 0.5, "strength": 1 } }),
            ["members[0].grip", "fingers"],
        ),
        (
            json!({ "id": "t", "strip": { "blocks": ["ground", "a"], "face": "+x", "width": 1, "strength": 1 } }),
            ["strip.blocks[1]", "no edge"],
        ),
        (json!({ "id": "t", "rope": {} }), ["members[0]", "unknown key"]),
    ] {
        let error = ask(member.clone());
        assert!(says.iter().all(|s| error.contains(s)), "{member}: {error}");
    }
    // Off its block, but not far: a finding, unless an arm is said to carry it.
    let off = |arm: bool| {
        let end = json!({ "block": "a", "at": [0, 0, 3], "arm": arm });
        let s = scene(
            0.5,
            json!([crate::ask::ground(), cuboid("a", [1.0, 1.0, 1.0], [0.0; 3])]),
            json!({ "members": [tie(end, json!({ "ground": [3, 0, 3] }))] }),
        );
        model(&s).findings().any(|f| f.text.contains("off block"))
    };
    assert!(off(false) && !off(true));
}

/// What becomes of a scene in time.
fn simulated(scene: &Scene) -> voussoir::dynamics::SimulationOutcome {
    let question = Question::Simulate(Default::default());
    let answer = analysis::ask(&question, scene, &model(scene), &Control::default()).unwrap();
    let analysis::Answer::Simulate(outcome) = answer else { panic!() };
    (*outcome).clone()
}

/// Away from its limits each kind of member does in time what the proof says.
#[test]
fn simulations_agree_with_the_proofs() {
    let weight = 1.0;
    let pushed = |friction: f64, by: f64, member: Value| {
        let more = json!({ "members": [member],
            "loads": { "dead": [{ "block": "a", "force": [by * weight, 0, 0] }] } });
        scene(friction, json!([ground(), cuboid("a", [1.0, 1.0, 1.0], [0.0; 3])]), more)
    };
    // A cube that would turn over, held at its top.
    let held = |kind: &str, side: f64, strength: f64| {
        let mut member = json!({ "id": "m" });
        member[kind] = json!({ "strength": strength, "between": [
            { "block": "a", "at": [0.5 * side, 0, 1] }, { "ground": [2.0 * side, 0, 1] } ] });
        pushed(2.0, 1.3, member)
    };
    // A cube that would slide, with earth behind it.
    let soil = |k: f64| {
        let member = json!({ "id": "m", "soil": { "block": "a", "face": "+x",
            "direction": [-1, 0, 0], "surface": 1.0, "unit_weight": weight, "k": k } });
        pushed(0.5, 0.8, member)
    };
    let needed = 0.15 * weight;
    // The least force in the tie of TI01, where a unit of volume weighs one.
    let least = 0.013134174;
    let cases = [
        ("tie", held("tie", -1.0, 1.3 * needed)),
        ("tie that yields", held("tie", -1.0, 0.7 * needed)),
        ("strut", held("strut", 1.0, 1.3 * needed)),
        ("strut that yields", held("strut", 1.0, 0.7 * needed)),
        ("soil", soil(2.0)),
        ("soil that yields", soil(0.2)),
        ("tied arch", tied_arch(0.3, json!("infinite"), false)),
        ("arch without its tie", tied_arch(0.3, Value::Null, false)),
        ("tied arch at 1.3 of what it needs", tied_arch(0.3, json!(1.3 * least), false)),
        ("tied arch at 0.7 of what it needs", tied_arch(0.3, json!(0.7 * least), false)),
    ];
    let mut seen = [0, 0];
    for (name, s) in cases {
        let stands = match verdict(&s, Law::Coulomb) {
            Verdict::Stable => Fate::Stands,
            Verdict::Unstable => Fate::Falls,
            other => panic!("{name}: {other:?}"),
        };
        let outcome = simulated(&s);
        println!("{name}: {:?}, {:?}", outcome.fate, outcome.runs.last());
        assert_eq!(outcome.fate, stands, "{name}");
        seen[usize::from(stands == Fate::Stands)] += 1;
    }
    assert!(seen.iter().all(|&n| n >= 4), "{seen:?}");
}

#[test]
fn a_simulation_says_that_it_has_no_grips() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let outcome = simulated(&crate::ask::open(&path.join("structures/grip-two-fingers.json")));
    assert_eq!(outcome.fate, Fate::Undecided);
    let said =
        |text: &str| text.contains("cannot model dowels and grips") && text.contains("gripper");
    assert!(outcome.findings.iter().any(|f| said(&f.text)), "{:?}", outcome.findings);
}

#[test]
fn scenes_without_members_say_nothing_of_them() {
    let s = cube(0.5, json!([]));
    let m = model(&s);
    let file = saved::assessment(&s, &m, &analysis::assess(&m, &Control::default())).unwrap();
    assert!(!serde_json::to_string(&file).unwrap().contains("members"));
}

#[test]
fn templates_carry_members() {
    let mut tied = tied_arch(0.3, json!("infinite"), true);
    let want = lambda(&tied);
    let members = std::mem::take(&mut tied.members);
    let voussoir::scene::Template::Arch(arch) = &mut tied.templates[0] else { panic!() };
    (arch.members, arch.prefix, arch.at) = (members, "north_".into(), [3.0, 1.0, 2.0]);
    close("template", lambda(&tied), want, 1e-8);
    assert_eq!(model(&tied).interfaces.members[0].id, "north_tie");
}

#[test]
fn the_same_question_in_a_plan_and_by_hand() {
    let s = tied_arch(0.3, json!("infinite"), false);
    let one = |greatest: bool| {
        let question = Question::Thrust(ThrustOptions {
            member: Some("tie".into()),
            greatest,
            law: Law::Associative,
            ..Default::default()
        });
        match analysis::ask(&question, &s, &model(&s), &Control::default()).unwrap() {
            analysis::Answer::Thrust(t) => t.ends[0].value.unwrap(),
            _ => panic!(),
        }
    };
    close("least", one(false), 0.013134174, 2e-8);
    close("greatest", one(true), 0.1693663739, 2e-8);
    let both = Question::Thrust(ThrustOptions {
        member: Some("tie".into()),
        support: Some("ground".into()),
        ..Default::default()
    });
    assert!(both.check().is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    /// Density with strengths, units, a turn about the vertical, a move, and the order of blocks and
    /// members leave the load factor and the range as they are.
    #[test]
    fn nothing_depends_on_units_places_or_order(
        density in -3.0f64..3.0, length in -2.0f64..2.0, turn in 0.0f64..6.0,
        by in prop::array::uniform3(-50.0f64..50.0), order in any::<bool>(), strength in 0.02f64..0.3,
    ) {
        let (density, size) = (10f64.powf(density), 10f64.powf(length));
        let rotation = Rotation3::from_axis_angle(&Unit::new_unchecked(Vector3::z()), turn);
        let built = |density: f64, size: f64, rotation: Rotation3<f64>, by: [f64; 3], order: bool| {
            let at = |p: [f64; 3]| -> [f64; 3] {
                ((rotation * Vector3::from(p)) * size + Vector3::from(by)).into()
            };
            let block = |id: &str, s: [f64; 3], foot: [f64; 3]| json!({ "id": id,
                "shape": { "box": { "size": s.map(|c| c * size) } },
                "at": at([foot[0], foot[1], foot[2] + s[2] / 2.0]),
                "rotation_deg": { "axis": [0, 0, 1], "angle": rotation.angle().to_degrees() * rotation.axis().map_or(1.0, |a| a.z.signum()) } });
            let force = density * size.powi(3);
            let on = |block: &str, p: [f64; 3]| json!({ "block": block, "at": at(p) });
            let mut blocks = vec![
                fixed(block("base", [8.0, 4.0, 1.0], [0.0, 0.0, -1.0])),
                block("a", [0.6, 1.0, 3.0], [-2.0, 0.0, 0.0]),
                block("b", [0.6, 1.0, 3.0], [2.0, 0.0, 0.0]),
                block("c", [0.6, 1.0, 1.0], [2.0, 0.0, 3.0]),
            ];
            let mut members = vec![
                json!({ "id": "t", "tie": { "strength": strength * force, "between": [on("a", [-1.7, 0.2, 2.8]), on("c", [1.7, 0.2, 3.4])] } }),
                json!({ "id": "s", "strut": { "strength": 2.0 * strength * force, "between": [on("b", [2.3, 0.0, 2.0]), json!({ "ground": at([4.0, 0.0, 0.0]) })] } }),
            ];
            if order {
                blocks[1..].reverse();
                members.reverse();
            }
            let toward: [f64; 3] = (rotation * Vector3::x()).into();
            scene(0.6, json!(blocks), json!({ "materials": { "unit": { "density": density } },
                "loads": { "live": [{ "weight": toward }] }, "members": members }))
        };
        let same = |rotation| built(1.0, 1.0, rotation, [0.0; 3], false);
        let base = same(Rotation3::identity());
        let other = built(density, size, rotation, by, order);
        let (one, two) = (lambda(&base), lambda(&other));
        prop_assert!((one - two).abs() <= 2e-7 * one.abs(), "λ {one} and {two}");
        let force = density * size.powi(3);
        for id in ["t", "s"] {
            let (one, two) = (range(&base, id), range(&other, id));
            for (a, b) in one.iter().zip(&two) {
                let (a, b) = (a.unwrap(), b.unwrap() / force);
                prop_assert!((a - b).abs() <= 1e-7, "{id}: {a} and {b}");
            }
        }
    }
}
