//! Ties, struts, bars and tendons of known stiffness in the state of joints that yield: closed forms,
//! strengths, prestress, forged results, bad input.

use crate::ask::prove;
use serde_json::{Value, json};
use voussoir::{
    analysis::{Control, Question, StateOptions, ask},
    elastic::EventKind,
    interface::prepare,
    proof::{ResultFile, member::MemberState, saved, state::StateAnswer},
    scene::{Scene, read_str},
};

fn scene(value: &Value) -> Scene {
    read_str("scene.json".to_string(), value.to_string()).unwrap_or_else(|e| panic!("{e}")).0
}

fn result(value: &Value, options: StateOptions) -> ResultFile {
    let scene = scene(value);
    let model = prepare(&scene).unwrap();
    let question = Question::State(options);
    let answer = ask(&question, &scene, &model, &Control::default()).unwrap();
    let file = saved::of_question(&question, &scene, &model, &answer, &Control::default()).unwrap();
    prove(&scene, &file);
    file
}

fn asked(value: &Value) -> ResultFile {
    result(value, StateOptions::default())
}

fn answer(file: &ResultFile) -> &StateAnswer {
    file.answer.state().unwrap()
}

fn tension(file: &ResultFile, member: &str) -> f64 {
    file.members.iter().find(|l| l.member == member).unwrap().force
}

fn sinks(file: &ResultFile, block: &str) -> f64 {
    -answer(file).displacements.iter().find(|d| d.block == block).unwrap().displacement[2]
}

#[track_caller]
fn near(got: f64, want: f64, by: f64) {
    assert!((got - want).abs() <= by * want.abs(), "{got}, not {want}");
}

/// Weight of a cube of 1 m of 2000 kg/m³, N.
const W: f64 = 2000.0 * 9.81;
/// Stiffness of the members, N/m.
const K: f64 = 2e6;

/// A cube at (0, 0, 3), on nothing, and a floor that it does not touch.
fn hung(members: Value) -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "stone": { "density": 2000 } },
        "joints": { "default": { "friction": 0.5, "normal_stiffness": 1e9 } },
        "blocks": [
            { "id": "floor", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "cube", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 3], "material": "stone" }
        ],
        "members": members
    })
}

/// A cube on the floor, with a live load of its weight to the right through its centre.
fn pulled(friction: f64, members: Value) -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "stone": { "density": 2000 } },
        "joints": { "default": { "friction": friction, "normal_stiffness": 1e9, "shear_stiffness": 4e8 } },
        "blocks": [
            { "id": "floor", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "cube", "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, 0.5], "material": "stone" }
        ],
        "members": members,
        "loads": { "live": [{ "block": "cube", "force": [W, 0, 0], "at": [0, 0, 0] }] }
    })
}

fn tie(id: &str, at: [f64; 3], ground: [f64; 3], more: Value) -> Value {
    let mut line = json!({ "between": [{ "block": "cube", "at": at }, { "ground": ground }], "strength": "infinite", "stiffness": K });
    for (key, value) in more.as_object().unwrap() {
        line[key] = value.clone();
    }
    json!({ "id": id, "tie": line })
}

/// Two ties carry half of it each, W / 2 k longer; leaning by an angle they sink by W / (2 k cos²).
#[test]
fn a_block_hangs_from_two_springs() {
    let upright = json!([
        tie("left", [-0.5, 0.0, 3.5], [-0.5, 0.0, 6.0], json!({})),
        tie("right", [0.5, 0.0, 3.5], [0.5, 0.0, 6.0], json!({}))
    ]);
    let file = asked(&hung(upright));
    near(sinks(&file, "cube"), W / (2.0 * K), 1e-9);
    near(tension(&file, "left"), 0.5 * W, 1e-9);
    // It swings freely, and bounces with √(2k/m) / 2π.
    let bounces = (2.0 * K / 2000.0_f64).sqrt() / std::f64::consts::TAU;
    let f = &answer(&file).frequencies;
    assert!(f.iter().any(|f| (f - bounces).abs() < 1e-6 * bounces) && f[0] == 0.0, "{f:?}");
    let cos = 2.5 / 2.5_f64.hypot(1.5);
    let leaning = json!([
        tie("left", [-0.5, 0.0, 3.5], [-2.0, 0.0, 6.0], json!({})),
        tie("right", [0.5, 0.0, 3.5], [2.0, 0.0, 6.0], json!({}))
    ]);
    let file = asked(&hung(leaning));
    near(tension(&file, "right"), 0.5 * W / cos, 1e-9);
    near(sinks(&file, "cube"), W / (2.0 * K * cos * cos), 1e-9);
}

/// A tendon under the block carries half of it, and grows by twice its way; two struts below it are
/// shortened.
#[test]
fn tendons_and_struts_carry_as_ties_do() {
    let ends = json!([{ "ground": [-0.5, 0, 6] }, { "block": "cube", "at": [-0.5, 0, 2.5] }, { "block": "cube", "at": [0.5, 0, 2.5] }, { "ground": [0.5, 0, 6] }]);
    let tendon = json!([{ "id": "loop", "tendon": { "through": ends, "strength": "infinite", "stiffness": K } }]);
    let file = asked(&hung(tendon));
    near(tension(&file, "loop"), 0.5 * W, 1e-9);
    near(sinks(&file, "cube"), W / (4.0 * K), 1e-9);
    let strut = |id: &str, x: f64, y: f64| json!({ "id": id, "strut": { "between": [{ "block": "cube", "at": [x, y, 2.5] }, { "ground": [x, y, 0] }], "strength": "infinite", "stiffness": K } });
    let file = asked(&hung(json!([
        strut("a", -0.4, -0.4),
        strut("b", 0.4, -0.4),
        strut("c", -0.4, 0.4),
        strut("d", 0.4, 0.4)
    ])));
    near(tension(&file, "c"), -0.25 * W, 1e-9);
    near(sinks(&file, "cube"), W / (4.0 * K), 1e-9);
}

/// A block that slides against a spring: it goes λ W / (k + k_t A) while it sticks, and from λ W = μ W +
/// T on T / k with T = λ W − μ W; a tie that is pushed together goes slack.
#[test]
fn a_block_slides_against_a_spring() {
    let spring = |strength: Value| {
        json!([
            tie("spring", [-0.5, 0.0, 0.0], [-2.0, 0.0, 0.0], json!({ "strength": strength })),
            tie("idle", [0.5, 0.0, 0.0], [2.0, 0.0, 0.0], json!({}))
        ])
    };
    let file = result(
        &pulled(0.5, spring(json!(0.75 * W))),
        StateOptions { at: vec![0.4, 0.8, 1.2], ..Default::default() },
    );
    let a = answer(&file);
    let way = |at: f64| a.curve.iter().find(|p| p.load_factor == at).unwrap().displacement[0];
    near(way(0.4), 0.4 * W / (K + 4e8), 1e-9);
    near(way(0.8), 0.3 * W / K, 1e-9);
    near(way(1.2), 0.7 * W / K, 1e-9);
    // It yields as the load reaches μ + 3/4.
    let l = a.load_factor.unwrap();
    near(l.reached, 1.25, 1e-6);
    assert!(l.slides && l.value.is_some());
    let end = |id: &str| a.members_at_end.iter().find(|m| m.member == id).unwrap();
    near(end("spring").force, 0.75 * W, 1e-5);
    assert_eq!(end("idle").state, MemberState::Slack);
    let slides = a.events.iter().find(|e| e.kind == EventKind::Slides).unwrap();
    // The greatest force of friction is reached where the tie has stretched by μ W / (k_t A).
    near(slides.load_factor, 0.5 * (1.0 + K / 4e8), 1e-5);
}

/// A tie gives way at its strength and stays longer: what comes after is carried by the other.
#[test]
fn a_tie_yields_at_its_strength() {
    let members = json!([
        tie("weak", [-0.5, 0.0, 0.0], [-2.0, 0.0, 0.0], json!({ "strength": 0.1 * W })),
        tie("strong", [-0.5, 0.0, 0.0], [-3.0, 0.0, 0.0], json!({ "strength": 0.5 * W }))
    ]);
    let mut value = pulled(0.0, members);
    value["joints"]["default"] = json!({ "friction": 0, "normal_stiffness": 1e9 });
    let file = result(&value, StateOptions { at: vec![0.1, 0.4], ..Default::default() });
    let a = answer(&file);
    let way = |at: f64| a.curve.iter().find(|p| p.load_factor == at).unwrap().displacement[0];
    near(way(0.1), 0.1 * W / (2.0 * K), 1e-9);
    near(way(0.4), 0.3 * W / K, 1e-9);
    let yields = a.events.iter().find(|e| e.kind == EventKind::Yields).unwrap();
    assert_eq!((yields.member.as_deref(), &yields.between), (Some("weak"), &None));
    near(yields.load_factor, 0.2, 1e-6);
    // The bound is both strengths.
    near(a.load_factor.unwrap().associative.value.unwrap(), 0.6, 1e-8);
}

/// With a prestress T₀ to the ground below, the block sinks by (W + T₀) / (k_n A + k).
#[test]
fn a_prestress_presses() {
    let member = tie("anchor", [0.0, 0.0, 0.5], [0.0, 0.0, -2.0], json!({ "prestress": 3.0 * W }));
    let mut value = pulled(0.5, json!([member]));
    value["loads"] = json!({});
    let file = asked(&value);
    let by = 4.0 * W / (1e9 + K);
    near(sinks(&file, "cube"), by, 1e-9);
    near(tension(&file, "anchor"), 3.0 * W - K * by, 1e-9);
    near(answer(&file).joints[0].normal_force, 1e9 * by, 1e-9);
}

/// The tie of an arch on ice takes its whole thrust, and has grown by thrust / k.
#[test]
fn an_arch_is_held_by_its_tie() {
    let value = json!({
        "format": "voussoir-scene/1",
        "joints": {
            "default": { "friction": 0.7, "normal_stiffness": 1e9, "shear_stiffness": 4e8 },
            "overrides": [{ "blocks": ["springer_left", "v00"], "friction": 0 }, { "blocks": ["v10", "springer_right"], "friction": 0 }]
        },
        "templates": [{ "arch": { "radius": 5, "thickness": 0.9, "depth": 1, "voussoirs": 11 } }]
    });
    let mut tied = value;
    tied["members"] = json!([{ "id": "tie", "tie": { "between": [{ "block": "v00", "at": [-5, 0, 0.1] }, { "block": "v10", "at": [5, 0, 0.1] }], "strength": "infinite", "stiffness": 1e7 } }]);
    let file = asked(&tied);
    let a = answer(&file);
    let crown = a.joints.iter().find(|j| j.between.contains(&"v05".to_string())).unwrap();
    near(tension(&file, "tie"), crown.force[0].abs(), 1e-9);
    let end = |id: &str| {
        let d = a.displacements.iter().find(|d| d.block == id).unwrap();
        let scene = prepare(&scene(&tied)).unwrap();
        let block = scene.assembly.blocks.iter().find(|b| b.id == id).unwrap();
        d.displacement[0] + d.rotation[1] * (0.1 - block.centroid.z)
    };
    near(tension(&file, "tie"), 1e7 * (end("v10") - end("v00")), 1e-8);
}

/// Tensions that are changed are refused.
#[test]
fn forged_tensions_are_refused() {
    let members = json!([tie(
        "spring",
        [-0.5, 0.0, 0.0],
        [-2.0, 0.0, 0.0],
        json!({ "strength": W, "prestress": 100.0 })
    )]);
    let value = pulled(0.5, members);
    let file = asked(&value);
    crate::ask::leaves_hold(&file);
    let mut softer = scene(&value);
    softer.members[0].tie.as_mut().unwrap().stiffness = Some(0.9 * K);
    assert!(!crate::ask::check(&softer, &file).proved());
}

/// Without a stiffness the key is named; of other kinds what to do.
#[test]
fn members_without_an_answer_are_refused() {
    let refused = |value: &Value, words: &[&str]| {
        let scene = scene(value);
        let model = prepare(&scene).unwrap();
        let asked = Question::State(StateOptions::default());
        let Err(e) = ask(&asked, &scene, &model, &Control::default()) else { panic!("{words:?}") };
        let said = format!("{} {} {}", e.path, e.message, e.hint.unwrap_or_default());
        for word in words {
            assert!(said.contains(word), "{said}");
        }
    };
    let mut stiff = tie("tie", [-0.5, 0.0, 3.5], [-0.5, 0.0, 6.0], json!({}));
    stiff["tie"].as_object_mut().unwrap().remove("stiffness");
    refused(&hung(json!([stiff])), &["members[0].tie.stiffness", "EA / l", "N/m"]);
    let soil = json!([{ "id": "backfill", "soil": { "block": "cube", "face": "-x", "direction": [1, 0, 0], "surface": 4, "unit_weight": 18000, "k": 1.5 } }]);
    refused(&hung(soil), &["members[0].soil", "soil", "ties, struts, bars and tendons"]);
}
