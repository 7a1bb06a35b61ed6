//! Stages of construction: how many voussoirs stand without centring, rings and centring against
//! single verdicts, what is held; invariance, forged results, bad input.

use crate::ask::{cuboid, fixed, prove, scene, template};
use serde_json::{Value, json};
use voussoir::{
    analysis::{Answer, Control, Question, StagesOptions, ask, assess},
    assembly,
    interface::{self, Model, prepare},
    proof::{self, ResultFile, answer::FactorStatus, saved, stages::StageResult},
    scene::{Scene, read_str},
    sweep::{RowAnswer, RowStatus},
    verdict::Verdict,
};

fn options() -> StagesOptions {
    StagesOptions { toward: vec![[1.0, 0.0, 0.0]], ..Default::default() }
}

fn bare() -> StagesOptions {
    StagesOptions { skip_margin: true, skip_held: true, ..Default::default() }
}

/// The result, written, read back and proved.
pub fn result(scene: &Scene, options: StagesOptions) -> ResultFile {
    let model = prepare(scene).unwrap();
    let question = Question::Stages(options);
    let answer = ask(&question, scene, &model, &Control::default()).unwrap();
    assert!(matches!(answer, Answer::Stages(_)));
    let file = saved::of_question(&question, scene, &model, &answer, &Control::default()).unwrap();
    prove(scene, &file);
    file
}

fn list(file: &ResultFile) -> &[StageResult] {
    &file.stages.as_ref().unwrap().list
}

fn verdicts(file: &ResultFile) -> Vec<Verdict> {
    list(file).iter().map(StageResult::stands).collect()
}

fn open(name: &str) -> Scene {
    let path = format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"));
    crate::ask::open(path.as_ref())
}

fn arch(voussoirs: usize, thickness: f64, friction: f64, embrace_deg: f64, length: f64) -> Scene {
    let arch = json!({ "radius": length, "thickness": thickness * length, "depth": length,
        "voussoirs": voussoirs, "embrace_deg": embrace_deg });
    let stages = json!([{ "add_one_by_one": ["v*"] }]);
    template(friction, json!({ "arch": arch }), json!({ "stages": stages }))
}

/// Frontier case AS01 (linear programming, every stage): voussoirs of 9° from one springing.
#[test]
fn so_many_voussoirs_stand_without_centring() {
    for (friction, rows) in [(0.7, [4, 4, 4]), (1000.0, [4, 4, 5])] {
        for (thickness, first) in [0.15, 0.2, 0.3].into_iter().zip(rows) {
            let file = result(&arch(20, thickness, friction, 180.0, 1.0), bare());
            let said = file.answer.stages().unwrap();
            assert_eq!((said.stages, said.stand_first), (20, first), "{friction} {thickness}");
            assert_eq!(said.verdict, Verdict::Unstable);
            assert_eq!(said.worst, format!("add v{first:02}"));
        }
    }
}

/// Rows of a sweep have no margins, and count the stages that stand.
#[test]
fn a_row_counts_the_stages_that_stand() {
    let row = |scene: &Scene| {
        let question = Question::Stages(StagesOptions::default());
        question.check_for_one_number().unwrap();
        let model = prepare(scene).unwrap();
        let question = question.for_one_number();
        RowAnswer::of_answer(&ask(&question, scene, &model, &Control::default()).unwrap())
    };
    let arch = arch(20, 0.3, 1000.0, 180.0, 1.0);
    let RowAnswer { status, value, .. } = row(&arch);
    assert_eq!((status, value), (RowStatus::Found, Some(5.0)));
    for (key, value) in
        [("skip_margin", json!(true)), ("skip_held", json!(true)), ("all", json!(4))]
    {
        let mut question = json!({ "stages": {} });
        question["stages"][key] = value;
        let question: Question = serde_json::from_value(question).unwrap();
        assert!(question.check_for_one_number().is_err(), "{key}");
    }
}

/// A stage is the scene that has these blocks and no others.
fn alone(scene: &Scene, present: &dyn Fn(&str) -> bool, held: &[&str]) -> Verdict {
    let whole = prepare(&Scene { stages: Vec::new(), ..scene.clone() }).unwrap();
    let ids = whole.assembly.blocks.iter().map(|b| b.id.clone());
    let gone: Vec<usize> = ids.enumerate().filter(|(_, id)| !present(id)).map(|(i, _)| i).collect();
    let mut model = whole.without(&gone);
    for id in held {
        let i = model.assembly.find(id).unwrap();
        model.assembly.blocks[i].support = true;
        model.assembly.dead[i] = assembly::Wrench::zero();
    }
    let free: Vec<bool> = model.assembly.blocks.iter().map(|b| !b.support).collect();
    model.interfaces.list.retain(|f| free[f.a] || free[f.b]);
    assess(&Model::new(model.assembly, model.interfaces), &Control::default()).verdict
}

#[test]
fn rings_of_a_dome_stand_as_single_verdicts_say() {
    let scene = open("dome-ring-by-ring");
    let file = result(&scene, StagesOptions { skip_margin: true, ..Default::default() });
    let half: Vec<String> = (0..6).map(|k| format!("r05_{k:02}")).collect();
    let half: Vec<&str> = half.iter().map(String::as_str).collect();
    let ring = |id: &str| id.get(1..3).and_then(|n| n.parse::<usize>().ok());
    let up_to =
        |n: usize| move |id: &str| id.starts_with("springer") || ring(id).is_some_and(|r| r < n);
    let mut here: Vec<Verdict> = (1..=5).map(|n| alone(&scene, &up_to(n), &[])).collect();
    let with_half = |id: &str| up_to(5)(id) || half.contains(&id);
    here.push(alone(&scene, &with_half, &half));
    here.extend((6..=7).map(|n| alone(&scene, &up_to(n), &[])));
    here.push(alone(&scene, &|_| true, &[]));
    assert_eq!(verdicts(&file), here);
    assert!(here.iter().all(|v| *v == Verdict::Stable));
    // What is held is named, with what it must be held with at least, and nowhere else.
    for (k, stage) in list(&file).iter().enumerate() {
        assert_eq!(stage.held.len(), if k == 5 { 6 } else { 0 });
        assert_eq!(!stage.least_forces.is_empty(), k == 5);
        assert!(stage.least_forces.iter().all(|f| f.needed.is_some_and(|v| v >= 0.0)));
    }
}

#[test]
fn a_barrel_falls_where_its_centring_is_struck_too_early() {
    let scene = open("barrel-on-centring");
    let file = result(&scene, options());
    let said = file.answer.stages().unwrap();
    assert_eq!((said.verdict, said.stages, said.stand_first), (Verdict::Stable, 8, 8));
    assert_eq!(said.least_load_factor.as_ref().unwrap().stage, "a cart on the haunch");
    assert_eq!(said.least_tilt_deg.as_ref().unwrap().stage, "centring struck");
    // What stages have in common is answered once: to the last bit as each by itself.
    let whole = prepare(&scene).unwrap();
    let stages = assembly::stages(&scene, &whole.assembly).unwrap();
    for (stage, said) in stages.iter().zip(list(&file)) {
        let model = interface::at_stage(&scene, &whole, stage).unwrap();
        let own = saved::assessment(&scene, &model, &assess(&model, &Control::default())).unwrap();
        assert_eq!(own.certificate.forces, said.verdict.certificate.forces, "{}", stage.name);
        assert_eq!(own.answer, said.verdict.answer);
    }
    let mut early = scene.clone();
    // Struck before the key row is there.
    let strike = early.stages.remove(6);
    early.stages.insert(5, strike);
    let file = result(&early, bare());
    let said = file.answer.stages().unwrap();
    assert_eq!((said.verdict, said.worst.as_str()), (Verdict::Unstable, "centring struck"));
    assert_eq!((said.stand_first, said.stand), (5, 7));
    let left =
        |id: &str| !["centring"].contains(&id) && !id.starts_with("v05") && !id.starts_with("v06");
    assert_eq!(alone(&scene, &left, &[]), Verdict::Unstable);
}

/// A block of weight 1 that overhangs by 0.6 of its half length is held at its far end, or rests
/// on a prop; closed forms of a lever.
fn lever(stages: Value) -> Scene {
    let blocks = json!([
        fixed(cuboid("ground", [4.0, 1.0, 1.0], [-2.0, 0.0, -1.0])),
        cuboid("beam", [2.0, 1.0, 0.5], [0.6, 0.0, 0.0]),
        cuboid("stone", [1.0, 1.0, 1.0], [1.1, 0.0, 0.5]),
    ]);
    scene(0.6, blocks, json!({ "stages": stages }))
}

#[test]
fn what_is_held_is_held_with_the_least_force_of_statics() {
    // The stone's middle is 0.1 inside the beam's end and hangs 1.1 beyond the edge at x = 0; the
    // beam's middle 0.6 beyond it. Held, the beam carries the stone and itself.
    let file = result(
        &lever(json!([
            { "name": "beam held", "hold": ["beam"] },
            { "name": "let go", "release": ["beam"] },
        ])),
        options(),
    );
    assert_eq!(verdicts(&file), [Verdict::Stable, Verdict::Unstable]);
    let down = &list(&file)[0].least_forces[0];
    assert_eq!((down.block.as_str(), down.direction), ("beam", [0.0, 0.0, -1.0]));
    // Beam and stone weigh 1 each (density 1, gravity 1): nothing below carries the stone.
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a} instead of {b}");
    close(down.least.value.unwrap(), 1.0);
    close(down.weight, 1.0);
    close(down.needed.unwrap(), 2.0);
    let on = list(&file)[0].reactions.iter().find(|r| r.support == "beam").unwrap();
    close(on.force[2], -1.0);
    assert_eq!(file.answer.stages().unwrap().stand_first, 1);
}

#[test]
fn loads_and_members_come_and_go() {
    let blocks = json!([
        fixed(cuboid("ground", [4.0, 4.0, 1.0], [0.0, 0.0, -1.0])),
        cuboid("block", [1.0, 1.0, 1.0], [0.0, 0.0, 0.0]),
    ]);
    let pull = json!({ "id": "pull", "block": "block", "force": [0.9, 0, 0] });
    let tie = json!({ "id": "tie", "tie": { "strength": "infinite",
        "between": [{ "block": "block", "at": [-0.5, 0, 0.5] }, { "ground": [-3, 0, 0.5] }] } });
    let push = json!({ "id": "wind", "block": "block", "force": [0.1, 0, 0] });
    let stages = json!([
        { "name": "alone", "remove": ["pull"] },
        { "name": "tied", "add": ["tie"] },
        { "name": "pulled", "add": ["pull"] },
        { "name": "cut", "remove": ["tie"] },
        { "name": "wind", "remove": ["pull"], "add": ["wind"] },
    ]);
    let scene = scene(
        0.6,
        blocks,
        json!({ "loads": { "dead": [pull], "live": [push] }, "members": [tie], "stages": stages }),
    );
    let file = result(&scene, options());
    use Verdict::{Stable, Unstable};
    assert!(list(&file)[2].no_margin.as_ref().unwrap().contains("not a weight along gravity"));
    assert_eq!(verdicts(&file), [Stable, Stable, Stable, Unstable, Stable]);
    // The weight is 1: it tips under a force of 1 at half its height, and slides under 0.6.
    let last = list(&file)[4].load_factor().unwrap();
    assert_eq!(last.status, FactorStatus::Found);
    assert!((last.value.unwrap() - 6.0).abs() < 1e-5);
    let tilt = list(&file)[0].tilt_deg().unwrap();
    assert!((tilt.value.unwrap() - 0.6_f64.atan().to_degrees()).abs() < 1e-4);
}

#[test]
fn units_shift_and_other_blocks_do_not_change_how_many_stand() {
    let first = |scene: &Scene| result(scene, bare()).answer.stages().unwrap().stand_first;
    for (n, thickness, friction, embrace) in [(9, 0.2, 0.7, 180.0), (12, 0.25, 0.5, 150.0)] {
        let usual = first(&arch(n, thickness, friction, embrace, 1.0));
        assert!(usual > 0 && usual < n);
        for length in [1e-3, 1e3] {
            assert_eq!(first(&arch(n, thickness, friction, embrace, length)), usual);
        }
        let mut far = arch(n, thickness, friction, embrace, 1.0);
        let ground = json!([
            fixed(cuboid("rock", [1.0, 1.0, 1.0], [500.0, 0.0, -1.0])),
            cuboid("pebble", [0.1, 0.1, 0.1], [500.0, 0.0, 0.0]),
        ]);
        let with = scene(friction, ground, json!({}));
        far.blocks = with.blocks;
        assert_eq!(first(&far), usual);
    }
}

#[test]
fn forged_results_are_refused() {
    let early = arch(12, 0.2, 0.7, 180.0, 1.0);
    let good = result(&early, options());
    // The first that falls.
    let k = good.answer.stages().unwrap().stand_first;
    assert!(k > 1);
    crate::ask::leaves_hold(&good);
    fn stages(v: &mut Value) -> &mut Vec<Value> {
        v["evidence"]["stages"]["stages"].as_array_mut().unwrap()
    }
    let edits: [crate::ask::Edit; 3] = [
        ("another's proof", &|v| stages(v)[k]["standing"] = stages(v)[k - 1]["standing"].clone()),
        ("a stage left out", &|v| drop(stages(v).remove(k))),
        ("another's margin", &|v| stages(v)[0]["tilts"] = stages(v)[1]["tilts"].clone()),
    ];
    crate::ask::edits_are_refused(&early, &good, &edits);
    // Directions that were asked and have no evidence are undecided, and govern.
    let mut value = good.to_value().unwrap();
    drop(stages(&mut value)[0]["tilts"].as_array_mut().unwrap().remove(0));
    crate::ask::told(&mut value);
    let margin = &value["answer"]["each_stage"]["list"][0]["margin"];
    assert_eq!(margin["tilt_deg"]["status"], "undecided", "{margin}");
    // A scene with other stages is another scene.
    let mut scene = early.clone();
    scene.stages = serde_json::from_value(json!([{ "add": ["v*"] }])).unwrap();
    assert!(crate::ask::check(&scene, &good).refuted());
}

#[test]
fn forged_forces_on_what_is_held_are_refused() {
    let scene = lever(json!([{ "name": "held", "hold": ["beam"] }]));
    let good = result(&scene, options());
    crate::ask::leaves_hold(&good);
    fn held(v: &mut Value) -> &mut Value {
        &mut v["evidence"]["stages"]["stages"][0]["least_forces"]
    }
    let edits: [crate::ask::Edit; 2] = [
        ("another block", &|v| held(v)[0]["block"] = json!("stone")),
        ("nothing of it", &|v| *held(v) = json!([])),
    ];
    for (what, edit) in edits {
        let mut value = good.to_value().unwrap();
        edit(&mut value);
        crate::ask::told(&mut value);
        let saved = proof::read::read_str("forged", value.to_string()).unwrap();
        assert!(proof::verify(&saved, &scene).unwrap().refuted(), "{what}");
    }
}

#[test]
fn errors_in_stages_name_place_and_remedy() {
    let refused = |stages: Value, place: &str, words: &str| {
        let scene =
            Scene { stages: serde_json::from_value(stages.clone()).unwrap(), ..lever(json!([])) };
        let error = prepare(&scene).map(|_| ()).unwrap_err();
        let text = error.to_string();
        assert!(text.starts_with(place) && text.contains(words), "{stages}: {text}");
        assert!(error.hint.is_some(), "{text}");
    };
    refused(json!([{}]), "stages[0]", "changes nothing");
    refused(json!([{ "add": ["stne"] }]), "stages[0].add[0]", "did you mean \"stone\"");
    refused(json!([{ "add": ["x*"] }]), "stages[0].add[0]", "no block, member or load");
    refused(
        json!([{ "add": ["stone"] }, { "add": ["stone"] }]),
        "stages[1].add[0]",
        "already in place",
    );
    refused(
        json!([{ "remove": ["stone"] }, { "remove": ["stone"] }]),
        "stages[1].remove[0]",
        "is not in place",
    );
    refused(json!([{ "add": ["stone", "s*"] }]), "stages[0].add[1]", "named twice");
    refused(json!([{ "hold": ["ground"] }]), "stages[0].hold[0]", "held anyway");
    refused(
        json!([{ "hold": ["stone"] }, { "hold": ["stone"] }]),
        "stages[1].hold[0]",
        "held already",
    );
    refused(json!([{ "release": ["stone"] }]), "stages[0].release[0]", "is not held");
    refused(json!([{ "release": ["ground"] }]), "stages[0].release[0]", "cannot be released");
    refused(json!([{ "hold": ["*"] }]), "stages[0].hold[0]", "held anyway");
    refused(json!([{ "hold": ["stone", "beam"] }]), "stages[0]", "no free block");
    refused(
        json!([{ "add": ["stone"], "add_one_by_one": ["beam"] }]),
        "stages[0]",
        "stages of their own",
    );
    refused(
        json!([{ "name": "a", "add": ["stone"] }, { "name": "a", "remove": ["stone"] }]),
        "stages[1].name",
        "two stages are called",
    );
    let misspelt = lever(json!([{ "add": ["stone"] }]));
    let mut value = serde_json::to_value(&misspelt).unwrap();
    value["stages"][0]["ad"] = json!([]);
    let error = read_str("s.json", value.to_string()).unwrap_err().to_string();
    assert!(error.contains("ad"), "{error}");
    // No stages at all.
    let none = lever(json!([]));
    let model = prepare(&none).unwrap();
    let error = ask(&Question::Stages(bare()), &none, &model, &Control::default()).unwrap_err();
    assert!(error.to_string().contains("no stages"), "{error}");
}
