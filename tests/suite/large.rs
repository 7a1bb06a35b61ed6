//! Large programs take the engine that is written for them; what it finds is proved like any other
//! answer.

use crate::ask::template;
use serde_json::json;
use voussoir::{
    analysis::{self, Control, Law, Outcome, limit::Formulation},
    deadline::{Cancel, Deadline},
    interface::{Model, prepare, prepare_until},
    program::Unknowns,
    scene::read_str,
    solve::Engine,
    verdict::Verdict,
};

fn wall(courses: usize, length: usize, push: [f64; 3]) -> Model {
    let text = format!(
        r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": 0.6 }} }},
        "templates": [ {{ "wall": {{ "size": [1, 0.5, 0.4], "courses": {courses}, "blocks": {length}, "first": "half", "base": "course" }} }} ],
        "loads": {{ "live": [ {{ "weight": {push:?} }} ] }} }}"#
    );
    prepare(&read_str("wall", text).unwrap().0).unwrap()
}

#[test]
fn load_factors_are_proved_and_agree_with_the_other_engine() {
    // In its plane as a linear program; out of it with round friction cones and an exact answer,
    // thickness over height.
    for (push, exact) in [([1.0, 0.0, 0.0], None), ([0.0, 1.0, 0.0], Some(0.5 / (20.0 * 0.4)))] {
        let model = &wall(20, 20, push);
        let answer = analysis::limit(model, &Control::default());
        assert_eq!(answer.outcome, Outcome::Found);
        assert_eq!(answer.attempts.len(), 1, "{:?}", answer.attempts);
        assert_eq!(answer.attempts[0].engine, Engine::Interior);
        assert!(answer.claim().is_some());
        let other = exact.unwrap_or_else(|| {
            analysis::limit::attempt(model, &Formulation::usual(Unknowns::Rates)).value.unwrap()
        });
        let value = answer.found().unwrap();
        assert!((value / other - 1.0).abs() < 1e-6, "{value} {other}");
    }
}

#[test]
fn verdicts_are_proved() {
    // Large even as one half of itself.
    let model = wall(30, 30, [1.0, 0.0, 0.0]);
    let answer = analysis::assess(&model, &Control { law: Law::Associative, ..Control::default() });
    assert_eq!(answer.verdict, Verdict::Stable);
    assert_eq!(answer.attempts.len(), 1, "{:?}", answer.attempts);
    assert_eq!(answer.attempts[0].engine, Engine::Interior);
    assert!(answer.claim().is_some());
}

#[test]
fn a_light_or_heavy_block_that_falls_off_a_large_wall_is_proved_to() {
    let (length, courses) = (20, 20);
    let block = |id: String, x: f64, course: i32, density: f64| {
        json!({ "id": id, "shape": { "box": { "size": [1, 0.5, 0.4] } }, "density": density,
            "at": [x, 0.25, 0.4 * f64::from(course) + 0.2], "support": course == 0 })
    };
    for density in [2e-3, 2e3, 2e9] {
        let mut blocks: Vec<_> = (0..length * courses)
            .map(|k| (k % length, k / length))
            .map(|(k, c)| {
                block(format!("{c}-{k}"), f64::from(k) + 0.5 * f64::from(c % 2), c, 2000.0)
            })
            .collect();
        // A hair more than half of it is in the air.
        let end = f64::from(length) - 0.5 + 0.5 * f64::from((courses - 1) % 2);
        blocks.push(block("loose".into(), end + 0.001, courses, density));
        let scene = json!({ "format": "voussoir-scene/1", "blocks": blocks,
            "joints": { "default": { "friction": 0.6 } } });
        let model = prepare(&read_str("wall", scene.to_string()).unwrap().0).unwrap();
        let control = Control { law: Law::Associative, ..Control::default() };
        let answer = analysis::assess(&model, &control);
        assert_eq!(answer.verdict, Verdict::Unstable, "{density}");
        assert!(answer.claim().is_some(), "{density}");
        assert_eq!(answer.attempts[0].engine, Engine::Interior);
    }
}

#[test]
fn small_programs_begin_with_the_usual_engine() {
    let model = wall(5, 5, [1.0, 0.0, 0.0]);
    let answer = analysis::limit(&model, &Control::default());
    assert_eq!(answer.attempts[0].engine, Engine::Clarabel);
}

#[test]
fn a_time_limit_holds_and_what_is_given_is_true() {
    let model = &wall(20, 20, [1.0, 0.0, 0.0]);
    let exact = analysis::limit(model, &Control::default()).found().unwrap();
    for seconds in [0.0, 0.05, 0.2] {
        let answer = analysis::limit(
            model,
            &Control { deadline: Deadline::within(seconds), ..Control::default() },
        );
        assert!(
            matches!(answer.outcome, Outcome::Found | Outcome::Undecided),
            "{:?}",
            answer.outcome
        );
        let room = 2e-6 * exact;
        assert!(
            answer.bracket.lower <= exact + room && answer.bracket.upper >= exact - room,
            "{:?} {exact}",
            answer.bracket
        );
    }
}

#[test]
fn a_cancelled_question_claims_nothing_and_a_lowered_flag_lets_the_next_one_go_on() {
    let model = &wall(6, 6, [1.0, 0.0, 0.0]);
    let flag = Cancel::new();
    let control = Control { deadline: Deadline::NEVER.or_when(flag), ..Control::default() };
    flag.raise();
    assert_eq!(analysis::limit(model, &control).outcome, Outcome::Undecided);
    assert_eq!(analysis::assess(model, &control).verdict, Verdict::Undecided);
    flag.lower();
    let found = analysis::limit(model, &control);
    assert_eq!(found.outcome, Outcome::Found);
    assert_eq!(found.value, analysis::limit(model, &Control::default()).value);
}

/// Who cancels, or is out of time, does not wait for blocks and contacts.
#[test]
fn resolving_and_detection_end_when_they_are_told_to() {
    let wall = json!({ "wall": { "size": [1, 0.5, 0.4], "courses": 6, "blocks": 6 } });
    let scene = template(0.6, wall, json!({}));
    let asked = std::cell::Cell::new(0);
    let after = |n: usize| {
        asked.set(0);
        move |asked: &std::cell::Cell<usize>| {
            asked.set(asked.get() + 1);
            asked.get() > n
        }
    };
    let free = after(usize::MAX);
    prepare_until(&scene, &|| free(&asked)).expect("a model");
    let times = asked.get();
    assert!(times > 60, "{times}");
    for n in [0, 10, times - 1] {
        let ends = after(n);
        let error = prepare_until(&scene, &|| ends(&asked)).expect_err("given up").to_string();
        assert!(error.contains("time limit reached after"), "{n}: {error}");
        assert_eq!(asked.get(), n + 1);
    }
}
