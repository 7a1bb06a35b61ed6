//! Orders in which a structure can be built: against all orders tried one by one, against what is
//! known of arches, forged, and asked wrongly.

use crate::{
    ask::{cuboid, fixed, scene, template},
    stages::result,
};
use serde_json::{Value, json};
use std::{collections::BTreeMap, process::Command};
use voussoir::{
    analysis::{Control, Question, StagesOptions, ask, assess},
    assembly::Stage,
    interface::{at_stage, prepare},
    proof::ResultFile,
    scene::Scene,
    sweep::{RowAnswer, RowStatus},
    verdict::Verdict,
};

fn any() -> StagesOptions {
    StagesOptions { any_order: true, skip_held: true, ..Default::default() }
}

/// The least and the most blocks that are held at a time, as the answer has them.
fn held(file: &ResultFile) -> (usize, usize) {
    let said = file.answer.stages().unwrap();
    assert_eq!(said.verdict, Verdict::Stable);
    (said.least_held.unwrap(), said.most_held.unwrap())
}

fn arch(voussoirs: usize) -> Scene {
    let arch = json!({ "radius": 1.0, "thickness": 0.2, "depth": 1.0,
        "voussoirs": voussoirs, "embrace_deg": 180.0 });
    template(0.7, json!({ "arch": arch }), json!({}))
}

/// Blocks on a ledge: `shelf` reaches out too far for itself, `weight` holds its tail down, `cap`
/// lies on its tip.
fn ledge() -> Scene {
    let blocks = json!([
        fixed(cuboid("ground", [2.0, 1.0, 1.0], [0.0, 0.0, -1.0])),
        cuboid("shelf", [2.0, 1.0, 0.2], [1.1, 0.0, 0.0]),
        cuboid("weight", [0.5, 1.0, 2.0], [0.4, 0.0, 0.2]),
        cuboid("cap", [0.4, 1.0, 0.2], [1.8, 0.0, 0.2]),
        cuboid("beside", [0.3, 1.0, 0.3], [-0.7, 0.0, 0.0]),
    ]);
    scene(0.6, blocks, json!({}))
}

/// The least number of blocks to hold at a time over all orders, every set and every hold asked.
fn by_trying_all(scene: &Scene) -> usize {
    let model = prepare(scene).unwrap();
    let free: Vec<usize> = model.assembly.free().collect();
    let n = free.len();
    let stands = |set: usize, hold: usize| {
        let mut stage = Stage::whole(model.assembly.blocks.len());
        for (k, &i) in free.iter().enumerate() {
            stage.present[i] = set >> k & 1 == 1;
            stage.held[i] = hold >> k & 1 == 1;
        }
        let there = at_stage(scene, &model, &stage).unwrap();
        set == hold || assess(&there, &Control::default()).verdict == Verdict::Stable
    };
    let needs = |set: usize| {
        let holds = (0..1usize << n).filter(|h| h & !set == 0 && stands(set, *h));
        holds.map(usize::count_ones).min().unwrap() as usize
    };
    let mut best: BTreeMap<usize, usize> = BTreeMap::from([(0, 0)]);
    for set in 1..1usize << n {
        let before = (0..n).filter(|k| set >> k & 1 == 1).map(|k| best[&(set & !(1 << k))]);
        let least = before.min().unwrap();
        best.insert(set, least.max(needs(set)));
    }
    best[&((1 << n) - 1)]
}

#[test]
fn the_least_holds_are_those_of_all_orders_tried() {
    for (name, scene) in [("ledge", ledge()), ("arch", arch(5))] {
        let file = result(&scene, any());
        let want = by_trying_all(&scene);
        assert_eq!(held(&file), (want, want), "{name}");
    }
    // The weight first would have nothing below it; the shelf is held until the weight is there.
    assert_eq!(held(&result(&ledge(), any())), (1, 1));
}

#[test]
fn an_arch_is_built_with_one_hand_and_a_wall_with_none() {
    let file = result(&arch(12), any());
    assert_eq!(held(&file), (1, 1));
    let placed = &file.stages.as_ref().unwrap().order.as_ref().unwrap().placed;
    assert_eq!(placed.len(), 12);
    assert!(placed.last().unwrap().held.is_empty(), "the arch stands by itself at the end");
    // Laid from both springings in turn, both halves need a hand.
    let turns = (0..6).flat_map(|k| [format!("v{k:02}"), format!("v{:02}", 11 - k)]);
    let both = StagesOptions { any_order: false, order: turns.collect(), ..any() };
    assert_eq!(held(&result(&arch(12), both)), (2, 2));
    let one = StagesOptions { any_order: false, order: vec!["v*".into()], ..any() };
    assert_eq!(held(&result(&arch(12), one)), (1, 1));
    let wall = template(
        0.6,
        json!({ "wall": { "size": [1.2, 0.2, 0.6], "courses": 4, "blocks": 3 } }),
        json!({}),
    );
    assert_eq!(held(&result(&wall, any())), (0, 0));
}

/// A structure beside it neither adds to what has to be held nor uses its tries up; of what needs a
/// hand for good both do.
#[test]
fn what_stands_beside_changes_no_order() {
    let blocks = |far: f64| -> Vec<Value> {
        let foot = |id: &str, size: [f64; 3], at: [f64; 3]| {
            cuboid(&format!("{id}{far}"), size, [at[0] + far, at[1], at[2]])
        };
        vec![
            fixed(foot("ground", [2.0, 1.0, 1.0], [0.0, 0.0, -1.0])),
            foot("shelf", [2.0, 1.0, 0.2], [1.1, 0.0, 0.0]),
            foot("weight", [0.5, 1.0, 2.0], [0.4, 0.0, 0.2]),
            foot("cap", [0.4, 1.0, 0.2], [1.8, 0.0, 0.2]),
        ]
    };
    let mut both = blocks(0.0);
    both.extend(blocks(50.0));
    // A wall with more sets of blocks than there are tries.
    both.push(fixed(cuboid("road", [20.0, 1.0, 1.0], [-30.0, 0.0, -1.0])));
    both.extend(
        (0..12).map(|k| {
            cuboid(&format!("stone{k}"), [0.5, 1.0, 0.5], [-38.0 + f64::from(k), 0.0, 0.0])
        }),
    );
    let options = StagesOptions { tries: Some(60), ..any() };
    assert_eq!(held(&result(&scene(0.6, json!(both), json!({})), options)), (1, 1));
    // Without their weights each shelf is held for good.
    let light = |list: Vec<Value>| -> Vec<Value> {
        list.into_iter().filter(|b| !b["id"].as_str().unwrap().starts_with("weight")).collect()
    };
    let one = scene(0.6, json!(light(blocks(0.0))), json!({}));
    assert_eq!(held(&result(&one, any())), (1, 1));
    let mut two = light(blocks(0.0));
    two.extend(light(blocks(50.0)));
    let two = scene(0.6, json!(two), json!({}));
    assert_eq!(held(&result(&two, any())), (2, 2));
    let given = StagesOptions { any_order: false, order: vec!["*".into()], ..any() };
    assert_eq!(held(&result(&two, given)), (2, 2));
}

/// Rows of a sweep show how many have to be held.
#[test]
fn a_row_counts_the_blocks_that_are_held() {
    let question = Question::Stages(any()).for_one_number();
    let scene = ledge();
    let model = prepare(&scene).unwrap();
    let answer = ask(&question, &scene, &model, &Control::default()).unwrap();
    let RowAnswer { status, value, .. } = RowAnswer::of_answer(&answer);
    assert_eq!((status, value), (RowStatus::Found, Some(1.0)));
}

#[test]
fn few_tries_give_an_order_and_say_that_fewer_holds_may_do() {
    let file = result(&arch(12), StagesOptions { tries: Some(3), ..any() });
    let (least, most) = held(&file);
    assert!(least == 0 && most >= 1, "{least} {most}");
}

#[test]
fn forged_orders_are_refused() {
    let scene = arch(7);
    let file = result(&scene, any());
    assert_eq!(file.answer.stages().unwrap().least_held, Some(1));
    crate::ask::leaves_hold(&file);
    fn order(v: &mut Value) -> &mut Value {
        &mut v["evidence"]["stages"]["order"]
    }
    let edits: [crate::ask::Edit; 4] = [
        ("nothing is held", &|v| {
            for placed in order(v)["placed"].as_array_mut().unwrap() {
                placed.as_object_mut().unwrap().remove("held");
            }
        }),
        ("more hands than needed are needed", &|v| order(v)["least_held"] = 2.into()),
        ("a block is never placed", &|v| drop(order(v)["placed"].as_array_mut().unwrap().pop())),
        ("a block is placed twice", &|v| {
            order(v)["placed"][1] = order(v)["placed"][0].clone();
        }),
    ];
    crate::ask::edits_are_refused(&scene, &file, &edits);
}

#[test]
fn orders_that_mean_nothing_are_refused_with_their_place() {
    let scene = arch(5);
    let model = prepare(&scene).unwrap();
    for order in [vec!["v00"], vec!["v*", "v00"], vec!["nobody", "v*"], vec!["v*", "springer_left"]]
    {
        let order = order.into_iter().map(String::from).collect();
        let options = StagesOptions { any_order: false, order, ..any() };
        let e = ask(&Question::Stages(options), &scene, &model, &Control::default()).unwrap_err();
        assert!(e.to_string().contains("order"), "{e}");
    }
    for more in [
        json!({ "any_order": true, "order": ["v*"] }),
        json!({ "any_order": true, "toward": [[1, 0, 0]] }),
        json!({ "any_order": true, "all": 4 }),
        json!({ "any_order": true, "tries": 0 }),
        json!({ "any_order": true, "tries": 1_000_000_000_000_u64 }),
        json!({ "hands": 1 }),
        json!({ "tries": 10 }),
    ] {
        let question: Question = serde_json::from_value(json!({ "stages": more })).unwrap();
        assert!(question.check().is_err(), "{more}");
    }
}

/// The exit code says whether the hands that there are will do.
#[test]
fn the_exit_code_is_whether_hands_are_enough() {
    let root = env!("CARGO_MANIFEST_DIR");
    for (hands, code) in [(None, 0), (Some("1"), 0), (Some("0"), 1)] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
        command.current_dir(root).args([
            "stages",
            "structures/arch-without-centring.json",
            "--any-order",
            "--skip-held",
        ]);
        command.args(hands.map(|h| ["--hands", h]).into_iter().flatten());
        let out = command.output().unwrap();
        let text = String::from_utf8_lossy(&out.stdout).into_owned();
        assert_eq!(out.status.code(), Some(code), "{text}");
        assert_eq!(text.contains("cannot be built with 0"), code == 1, "{text}");
    }
}
