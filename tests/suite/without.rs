//! Which single blocks may be taken out: single verdicts say the same, mirror images and other units
//! too, and evidence that is touched is refused.

use crate::ask::{cuboid, fixed, prove, scene, template};
use serde_json::json;
use voussoir::{
    analysis::{Answer as Found, Control, Question, WithoutOptions, ask, assess},
    interface::{Model, prepare},
    proof::{Answer, ResultFile, saved, without::WithoutAnswer},
    scene::Scene,
    sweep::{RowAnswer, RowStatus},
    verdict::Verdict,
};

/// The result, written, read back and proved.
fn result(scene: &Scene) -> ResultFile {
    let model = prepare(scene).unwrap();
    let question = Question::from(WithoutOptions::default());
    let answer = ask(&question, scene, &model, &Control::default()).unwrap();
    assert!(matches!(answer, Found::Without(_)));
    let file = saved::of_question(&question, scene, &model, &answer, &Control::default()).unwrap();
    prove(scene, &file);
    file
}

fn said(file: &ResultFile) -> &WithoutAnswer {
    match &file.answer {
        Answer::Without(a) => a,
        other => panic!("{other:?}"),
    }
}

/// Posts at these places under a lintel; `size` metres are one.
fn posts(places: &[f64], size: f64) -> Scene {
    let block = |id: &str, [x, y, z]: [f64; 3], [a, b, c]: [f64; 3]| {
        cuboid(id, [x * size, y * size, z * size], [a * size, b * size, c * size])
    };
    let mut blocks = vec![fixed(block("ground", [8.0, 2.0, 1.0], [0.0, 0.0, -1.0]))];
    for (id, &x) in ["left", "middle", "right"].iter().zip(places) {
        blocks.push(block(id, [0.5, 1.0, 1.0], [x, 0.0, 0.0]));
    }
    blocks.push(block("lintel", [2.5, 1.0, 0.3], [0.0, 0.0, 1.0]));
    scene(0.6, json!(blocks), json!({}))
}

/// The verdict on a scene without a block, asked by itself.
fn alone(scene: &Scene, gone: &str) -> Verdict {
    let whole = prepare(scene).unwrap();
    let mut model = whole.without(&[whole.assembly.find(gone).unwrap()]);
    let free: Vec<bool> = model.assembly.blocks.iter().map(|b| !b.support).collect();
    model.interfaces.list.retain(|f| free[f.a] || free[f.b]);
    assess(&Model::new(model.assembly, model.interfaces), &Control::default()).verdict
}

#[test]
fn what_may_go_is_what_single_verdicts_say() {
    let scene = posts(&[-1.0, 0.4, 1.0], 1.0);
    let file = result(&scene);
    let a = said(&file);
    // Without the left post the lintel's middle lies beside the two others.
    assert_eq!(a.removable, ["middle", "right", "lintel"]);
    for w in &a.each {
        assert_eq!(alone(&scene, &w.block), w.left.verdict, "{}", w.block);
    }
    assert_eq!(a.each[0].moving, ["lintel"]);
    let arch = template(
        0.7,
        json!({ "arch": { "radius": 1.0, "thickness": 0.2, "depth": 1.0, "voussoirs": 9 } }),
        json!({}),
    );
    assert!(said(&result(&arch)).removable.is_empty());
}

#[test]
fn mirror_images_and_units_say_the_same() {
    let names = |a: &WithoutAnswer| a.each.iter().map(|w| w.left.verdict).collect::<Vec<_>>();
    let here = result(&posts(&[-1.0, 0.4, 1.0], 1.0));
    let mut mirrored = names(said(&result(&posts(&[-1.0, -0.4, 1.0], 1.0))));
    mirrored[..3].reverse();
    assert_eq!(names(said(&here)), mirrored);
    for size in [1e-3, 1e3] {
        let other = result(&posts(&[-1.0, 0.4, 1.0], size));
        assert_eq!(names(said(&here)), names(said(&other)), "{size}");
    }
}

#[test]
fn a_row_counts_what_may_go() {
    let scene = posts(&[-1.0, 0.4, 1.0], 1.0);
    let question = Question::from(WithoutOptions::default());
    question.check_for_one_number().unwrap();
    let model = prepare(&scene).unwrap();
    let answer = ask(&question.for_one_number(), &scene, &model, &Control::default()).unwrap();
    let RowAnswer { status, value, .. } = RowAnswer::of_answer(&answer);
    assert_eq!((status, value), (RowStatus::Found, Some(3.0)));
}

#[test]
fn touched_evidence_is_refused() {
    let scene = posts(&[-1.0, 0.4, 1.0], 1.0);
    let good = result(&scene);
    crate::ask::leaves_hold(&good);
    let edits: [crate::ask::Edit; 3] = [
        ("another's proof", &|v| {
            let left = &mut v["evidence"]["without"]["left"];
            left[0] = left[1].clone();
        }),
        ("that of another order", &|v| {
            v["evidence"]["without"]["left"].as_array_mut().unwrap().reverse();
        }),
        ("one more", &|v| {
            let left = v["evidence"]["without"]["left"].as_array_mut().unwrap();
            left.push(left[0].clone());
        }),
    ];
    crate::ask::edits_are_refused(&scene, &good, &edits);
    // What has no evidence is undecided, and makes no block one that may go.
    let mut value = good.to_value().unwrap();
    value["evidence"]["without"]["left"].as_array_mut().unwrap().truncate(1);
    crate::ask::told(&mut value);
    assert_eq!(value["answer"]["without"]["removable"], json!([]));
    assert_eq!(value["answer"]["without"]["each"][1]["verdict"], "undecided");
}

#[test]
fn one_block_leaves_nothing_to_ask() {
    let blocks = json!([
        fixed(cuboid("ground", [6.0, 2.0, 1.0], [0.0, 0.0, -1.0])),
        cuboid("block", [0.5, 1.0, 1.0], [0.0, 0.0, 0.0]),
    ]);
    let scene = scene(0.6, blocks, json!({}));
    let model = prepare(&scene).unwrap();
    let e = ask(&WithoutOptions::default().into(), &scene, &model, &Control::default());
    assert!(e.unwrap_err().to_string().contains("voussoir assess"));
}
