//! Mechanisms on ground that moves: rows over pulses and records, fragility, saved results.

use super::{plan, sweep};
use serde_json::{Value, json};
use std::{collections::BTreeMap, fs, path::Path};
use voussoir::{
    analysis::{Answer, Control, Question, ask},
    ground::{Pulse, Record},
    interface::prepare,
    proof::{Answer as Said, ResultFile, saved, verify},
    rocking::{RunSettings, Search, run as run_machine, scan},
    scene::Scene,
    sweep::{
        Folder, LognormalFit, RowAnswer, RowStatus, RunOptions, Shard, Sweep, open, open_bytes,
        run, summarize,
    },
};

const RECORD: &str = "/question/rock/ground/record";

fn block() -> Value {
    serde_json::from_str(&fs::read_to_string("structures/slender-block.json").unwrap()).unwrap()
}

fn scene() -> Scene {
    serde_json::from_value(block()).unwrap()
}

/// Lines by row, without the time, which stands last.
fn lines(path: &Path) -> BTreeMap<u64, String> {
    let row = |line: &str| {
        let row: Value = serde_json::from_str(line).unwrap();
        (row["row"].as_u64().unwrap(), line.rsplit_once(",\"seconds\":").unwrap().0.to_string())
    };
    fs::read_to_string(path).unwrap().lines().skip(1).map(row).collect()
}

fn pulses(count: usize) -> Sweep {
    let pulse = json!({ "half_sine": { "acceleration": 3, "frequency": 1 } });
    let at = |key: &str| format!("/question/rock/ground/pulse/half_sine/{key}");
    sweep(
        block(),
        json!({ "rock": { "ground": { "pulse": pulse } } }),
        json!([
            { "pointer": at("frequency"), "from": 0.5, "to": 2, "count": count },
            { "pointer": at("acceleration"), "from": 2, "to": 8, "count": count }
        ]),
        json!({ "grid": {} }),
    )
}

fn built() -> std::sync::Arc<voussoir::analysis::follow::machine::Built> {
    let scene = scene();
    let question = serde_json::from_value(json!({ "rock": { "from": 0.5 } })).unwrap();
    let answer = ask(&question, &scene, &prepare(&scene).unwrap(), &Control::default()).unwrap();
    let Answer::Rock(rocking) = answer else { panic!("another answer") };
    rocking.built
}

#[test]
fn rows_over_pulses_are_those_of_the_machine() {
    let sweep = pulses(4);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.jsonl");
    let done = run(&sweep, &path, &RunOptions { threads: Some(2), ..Default::default() }, &|_| {})
        .unwrap();
    let built = built();
    let mut overturned = 0;
    for row in &done.rows {
        let [f, acceleration] = [0, 1].map(|k| row.parameters[k].number().unwrap());
        let motion = Pulse::HalfSine { acceleration, duration: 0.5 / f }.motion();
        let history = run_machine(&built.machine, &motion, &RunSettings::default());
        let want = if history.overturned() { RowStatus::Unstable } else { RowStatus::Stable };
        assert_eq!(row.answer.status, want, "{row:?}");
        overturned += usize::from(history.overturned());
    }
    assert!((3..14).contains(&overturned), "{overturned}");
    // A grid of pulses is a sample of nothing.
    assert!(summarize(&done.header, &done.rows).fragility.is_none());
}

#[test]
fn a_machine_is_made_once_for_all_motions_of_its_ground() {
    let pulse = json!({ "half_sine": { "acceleration": 3, "frequency": 1 } });
    let sweep = sweep(
        block(),
        json!({ "rock": { "ground": { "pulse": pulse }, "restitution": 0.9 } }),
        json!([
            { "pointer": "/question/rock/ground/pulse/half_sine/acceleration", "values": [2, 4, 6] },
            { "pointer": "/question/rock/restitution", "values": [0.8, 0.9] },
            { "pointer": "/blocks/1/shape/prism/polygon/2/0", "values": [0.2, 0.19] },
            { "pointer": "/materials/stone/density", "values": [2000, 2400] },
            { "pointer": "/joints/default/friction", "values": [0.1, 0.7] }
        ]),
        json!({ "grid": {} }),
    );
    let folder = tempfile::tempdir().unwrap();
    let options = RunOptions { threads: Some(2), ..Default::default() };
    let done = run(&sweep, &folder.path().join("rows.jsonl"), &options, &|_| {}).unwrap();
    // What fails is asked again in every row: at a friction of 0.1 the block slides.
    let failed = done.rows.iter().filter(|row| row.answer.status == RowStatus::Error).count();
    assert_eq!((done.rows.len(), failed, done.computed), (48, 24, [4, 2, 8 + 24]));
    for row in done.rows {
        let scene = sweep.scene_with(&row.parameters).unwrap();
        let question = sweep.question_with(&row.parameters).unwrap().for_one_number();
        let alone = ask(&question, &scene, &prepare(&scene).unwrap(), &Control::default());
        match alone {
            Ok(answer) => assert_eq!(row.answer, RowAnswer::of_answer(&answer), "row {}", row.row),
            Err(e) => assert_eq!(row.error, Some(e.to_string())),
        }
    }
}

#[test]
fn cut_at_any_byte_and_continued_rows_are_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let (path, again) = (folder.path().join("rows.jsonl"), folder.path().join("again.jsonl"));
    let sweep = pulses(4);
    run(&sweep, &path, &RunOptions { threads: Some(1), ..Default::default() }, &|_| {}).unwrap();
    let (whole, text) = (lines(&path), fs::read(&path).unwrap());
    let head = text.iter().position(|b| *b == b'\n').unwrap() + 1;
    for k in 0..7 {
        let cut = head + (text.len() - head) * (k * k + 3) / 50;
        fs::write(&again, &text[..cut]).unwrap();
        let options = RunOptions { threads: Some(2), ..Default::default() };
        run(&sweep, &again, &options, &|_| {}).unwrap();
        assert_eq!(lines(&again), whole, "cut at byte {cut}");
    }
}

fn records(folder: &Path) -> Sweep {
    for name in ["bursts.asc", "chords.at2", "ricker.csv"] {
        fs::copy(Path::new("structures/records").join(name), folder.join(name)).unwrap();
    }
    fs::create_dir(folder.join("plans")).unwrap();
    fs::write(folder.join("scene.json"), block().to_string()).unwrap();
    let plan = json!({
        "format": "voussoir-sweep/1", "scene": "../scene.json",
        "question": { "rock": { "ground": { "record": "../ricker.csv" } } },
        "vary": [
            { "pointer": RECORD, "folder": ".." },
            { "pointer": "/question/rock/ground/scale", "from": 0.5, "to": 4, "count": 8 }
        ]
    });
    let path = folder.join("plans/plan.json");
    fs::write(&path, plan.to_string()).unwrap();
    open(&path).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn records_of_a_folder_and_their_fragility() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = records(folder.path());
    assert_eq!((sweep.rows(), sweep.plan.records.len()), (24, 3));
    let path = folder.path().join("rows.jsonl");
    // Rows need no file.
    for name in ["bursts.asc", "chords.at2", "ricker.csv", "scene.json"] {
        fs::remove_file(folder.path().join(name)).unwrap();
    }
    let done = run(&sweep, &path, &RunOptions::default(), &|_| {}).unwrap();
    let built = built();
    let mut fates = Vec::new();
    for row in &done.rows {
        let name = row.parameters[0].to_string().replace("../", "structures/records/");
        let motion = Record::read(&[Path::new(&name)], None).unwrap().motion();
        let scale = row.parameters[1].number().unwrap();
        let history = run_machine(&built.machine, &motion.scaled(scale), &RunSettings::default());
        let want = if history.overturned() { RowStatus::Unstable } else { RowStatus::Stable };
        assert_eq!(row.answer.status, want, "{row:?}");
        fates.push((scale, history.overturned()));
    }
    let summary = summarize(&done.header, &done.rows);
    let fragility = summary.fragility.expect("records are a sample");
    assert_eq!(fragility.points.len(), 8);
    for (scale, share) in &fragility.points {
        let own: Vec<bool> =
            fates.iter().filter(|f| (f.0 - scale).abs() < 1e-9).map(|f| f.1).collect();
        assert_eq!((share.of, share.failed), (3, own.iter().filter(|f| **f).count()));
    }
    assert_eq!(fragility.lognormal, LognormalFit::of_fates(&fates).ok());
    assert_eq!(fragility.lognormal.is_none(), fragility.no_lognormal.is_some());
    // A folder of rows, as clusters have them, holds the records as well.
    let place = folder.path().join("cluster");
    Folder::create(&place, &sweep.header(Shard::ALL)).unwrap();
    let other = Folder::open(&place).unwrap().sweep().unwrap();
    let row = sweep.parameters(17);
    assert_eq!(other.question_with(&row).unwrap(), sweep.question_with(&row).unwrap());
}

#[test]
fn the_least_scale_is_that_of_the_scan() {
    let sweep = sweep(
        block(),
        json!({ "rock": { "ground": { "pulse": { "jump": { "velocity": 1 } } }, "scan": [0.1, 2] } }),
        json!([{ "pointer": "/question/rock/ground/pulse/jump/velocity", "values": [0.5, 1, 0.1, 20] }]),
        json!({ "grid": {} }),
    );
    let folder = tempfile::tempdir().unwrap();
    let done =
        run(&sweep, &folder.path().join("rows.jsonl"), &RunOptions::default(), &|_| {}).unwrap();
    // Of the closed form of a block that is pushed by a jump: 0.7340251351 m/s for this one.
    for (row, want) in done.rows.iter().zip([Some(2.0), Some(1.0), None, Some(0.05)]) {
        let a = &row.answer;
        match want {
            Some(0.05) => assert_eq!((a.status, a.value), (RowStatus::Found, Some(0.1))),
            Some(by) => {
                let found = a.value.unwrap();
                assert!((found - 0.734_025_135_1 * by).abs() < 1e-8, "{row:?}");
                assert!(a.lower.unwrap() < found && a.upper == a.value);
            }
            None => assert_eq!((a.status, a.value), (RowStatus::Unbounded, None)),
        }
    }
    let built = built();
    let search = Search { from: 0.1, to: 2.0, steps: 200, width: 1e-9 };
    let seen = scan(
        &built.machine,
        &Pulse::Jump { velocity: 1.0 }.motion(),
        &RunSettings::default(),
        &search,
    );
    assert_eq!(done.rows[1].answer.value, Some(seen.flips[0].overturns_at()));
}

#[test]
fn plans_that_mean_nothing_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), block().to_string()).unwrap();
    fs::write(folder.path().join("bad.csv"), "t,a\n0,1\n0.1,2\n").unwrap();
    fs::create_dir(folder.path().join("empty")).unwrap();
    let at = "/question/rock/ground/scale";
    let record = json!({ "record": "bad.csv" });
    let pulse = json!({ "pulse": { "jump": { "velocity": 1 } } });
    for (ground, vary, word) in [
        (&record, json!({ "pointer": at, "from": 1, "to": 2, "count": 2 }), "gives no unit"),
        (&pulse, json!({ "pointer": RECORD, "values": ["none.csv"] }), "none.csv"),
        (&pulse, json!({ "pointer": RECORD, "folder": "empty" }), "holds no record"),
        (&pulse, json!({ "pointer": at, "folder": "empty" }), "only ground-motion records"),
        (
            &pulse,
            json!({ "pointer": "/question/rock/scal", "from": 1, "to": 2, "count": 2 }),
            "scal",
        ),
        (
            &pulse,
            json!({ "pointer": "/question/rock/restitution", "from": 2, "to": 3, "count": 2 }),
            "between 0 and 1",
        ),
        (&json!({}), json!({ "pointer": at, "from": 1, "to": 2, "count": 2 }), "nothing moves"),
        (
            &json!({ "pulse": { "sine": { "acceleration": 1 } } }),
            json!({ "pointer": at, "from": 1, "to": 2, "count": 2 }),
            "duration",
        ),
    ] {
        let plan = json!({ "format": "voussoir-sweep/1", "scene": "scene.json", "question": { "rock": { "ground": ground } }, "vary": [vary] });
        let error = open_bytes(
            "plan.json",
            plan.to_string().into_bytes(),
            folder.path(),
            Default::default(),
        )
        .expect_err("refused")
        .to_string();
        assert!(error.contains(word), "{error}");
    }
    let mut plan = plan(
        json!({ "rock": { "ground": { "record": "r" } } }),
        json!([{ "pointer": at, "from": 1, "to": 2, "count": 2 }]),
        json!({ "grid": {} }),
    );
    assert!(Sweep::new(plan.clone(), block()).is_err());
    plan.question =
        serde_json::from_value(json!({ "rock": { "from": 0.5, "fate_only": true } })).unwrap();
    assert!(Sweep::new(plan, block()).unwrap_err().to_string().contains("fate_only"));
}

fn asked(question: Value) -> (Scene, ResultFile) {
    let scene = scene();
    let question: Question = serde_json::from_value(question).unwrap();
    let model = prepare(&scene).unwrap();
    let answer = ask(&question, &scene, &model, &Control::default()).unwrap();
    let file = saved::of(&question, &scene, &model, &answer).unwrap();
    (scene, file)
}

#[test]
fn saved_histories_are_proved_where_they_start_and_run_again() {
    let record = json!({ "name": "r", "step": 0.25, "components": [[0, 2.5, -4, 3, 0, 0]] });
    let (scene, honest) = asked(
        json!({ "rock": { "ground": { "record": record, "scale": 0.9 }, "scan": [0.5, 3] } }),
    );
    let found = crate::ask::check(&scene, &honest);
    assert!(found.proved() && found.computed(), "{found:?}");
    let Said::Rocking(said) = &honest.answer else { panic!("another answer") };
    assert!(!said.impacts.is_empty() && said.flips.as_ref().is_some_and(|f| !f.is_empty()));
    crate::ask::leaves_hold(&honest);
    let text = honest.to_value().unwrap();
    for (pointer, value) in [
        ("/evidence/rock/history/fate", json!("overturns")),
        ("/evidence/rock/history/greatest/way", json!(0.001)),
        ("/evidence/rock/history/released_at", json!(0.1)),
        ("/evidence/rock/history/impacts/0/time", json!(0.9)),
        ("/evidence/rock/history/flips/0/overturns_at", json!(2.5)),
        ("/evidence/rock/history/flips", json!([])),
        ("/evidence/rock/history/towards/frequency", json!(2.0)),
        ("/evidence/rock/history/against/restitution", json!(0.5)),
        ("/evidence/rock/history/asked/ground/scale", json!(0.5)),
        ("/evidence/rock/history/asked/ground/record/components/0/2", json!(-3.0)),
        ("/evidence/rock/history/asked/restitution", json!(0.9)),
        ("/evidence/rock/history/toward", json!([-1.0, 0.0, 0.0])),
        ("/evidence/rock/history/toward", json!([0.0, 0.0, 0.0])),
        ("/evidence/rock/history/blocks", json!([])),
        ("/evidence/rock/history/blocks", json!(["stranger"])),
        ("/evidence/rock/history/thickness", json!(4.0)),
        ("/evidence/rock/history/idealised", json!("why")),
        ("/evidence/rock/against/rates", json!([])),
        ("/evidence/rock/against/claim", Value::Null),
        ("/evidence/rock/towards/rates", json!([])),
        ("/scene/blocks/1/shape/prism/polygon/2/0", json!(0.3)),
    ] {
        let mut forged = text.clone();
        match forged.pointer_mut(pointer) {
            Some(place) => {
                assert_ne!(*place, value, "{pointer}");
                *place = value;
            }
            None => {
                let (parent, key) = pointer.rsplit_once('/').unwrap();
                forged.pointer_mut(parent).unwrap()[key] = value;
            }
        }
        crate::ask::told(&mut forged);
        // What does not even read is refused as well.
        let Ok(saved) = voussoir::proof::read::read_str("forged", forged.to_string()) else {
            continue;
        };
        let found = verify(&saved, &saved.scene);
        assert!(found.is_err() || found.is_ok_and(|f| f.refuted()), "{pointer} is believed");
    }
}
