//! Every cause for which an answer can be undecided, with what speaks for it and what to do next.
//!
//! Scenes on which a solver fails do not stay so for long: answers are made undecided here, each in
//! the way that its cause leaves behind, and asked why.

use crate::ask::{cuboid, ground, model, push, scene, template};
use serde_json::json;
use std::ops::ControlFlow;
use voussoir::{
    analysis::{
        Answer, Assessment, Control, CriticalOptions, DoubtCause, Limited, LoadFactor, Outcome,
        Proved, Question, ask, assess, coulomb, doubt, limit,
    },
    dynamics::{SimulationSettings, simulate},
    interface::Model,
    terms::{Fate, Found, StateMotion, Stop},
    verdict::Verdict,
};

fn block(density: f64) -> Model {
    let mut block = cuboid("block", [1.0, 1.0, 1.0], [0.0; 3]);
    block["density"] = json!(density);
    let beside = cuboid("beside", [1.0, 1.0, 1.0], [3.0, 0.0, 0.0]);
    model(&scene(0.5, json!([ground(), block, beside]), push([1.0, 0.0, 0.0])))
}

#[track_caller]
fn why(answer: &Answer, model: &Model) -> (DoubtCause, String, String) {
    let doubt = doubt(answer, model, &Control::default()).expect("a doubt");
    (doubt.cause, doubt.evidence, doubt.next)
}

/// A load factor as an attempt leaves it that came to nothing.
fn undecided(model: &Model, change: impl FnOnce(&mut LoadFactor)) -> Answer {
    let mut factor = LoadFactor::clone(&limit(model, &Control::default()));
    assert_eq!(factor.outcome, Outcome::Found);
    change(&mut factor);
    Answer::Limit(Box::new(Limited::from(Proved::new(model, factor))))
}

fn verdict(model: &Model, change: impl FnOnce(&mut Assessment)) -> Answer {
    let mut a = Assessment::clone(&assess(model, &Control::default()));
    a.verdict = Verdict::Undecided;
    change(&mut a);
    Answer::Assess(Proved::new(model, a))
}

#[test]
fn what_its_own_check_refused_is_named_first() {
    let model = block(1.0);
    let answer = undecided(&model, |l| {
        l.value = l.value.map(|v| 2.0 * v);
        l.bracket.lower *= 2.0;
        l.bracket.upper *= 2.0;
    });
    let (cause, evidence, next) = why(&answer, &model);
    assert_eq!(cause, DoubtCause::Refused);
    assert!(evidence.starts_with("the result failed its own check: "), "{evidence}");
    assert!(next.contains("--keep-all"), "{next}");
}

#[test]
fn numbers_that_are_spread_wide_are_named() {
    for (model, words) in [
        (block(1e-9), "the blocks' loads in N range from "),
        (
            self::model(&scene(
                1e3,
                json!([ground(), cuboid("block", [1.0; 3], [0.0; 3])]),
                push([1.0, 0.0, 0.0]),
            )),
            "a coefficient of friction is 1000",
        ),
    ] {
        let (cause, evidence, next) =
            why(&undecided(&model, |l| l.outcome = Outcome::Undecided), &model);
        assert_eq!(cause, DoubtCause::WideNumbers);
        assert!(evidence.starts_with(words), "{evidence}");
        assert!(next.starts_with("leave out blocks"), "{next}");
    }
}

/// A bracket that closed in part is worth its safe end; none at all is worth no number.
#[test]
fn a_bracket_that_stayed_open_gives_its_safe_end() {
    let model = block(1.0);
    let answer = undecided(&model, |l| {
        l.outcome = Outcome::Undecided;
        (l.bracket.lower, l.bracket.upper) = (0.4, 0.6);
    });
    let (cause, evidence, next) = why(&answer, &model);
    assert_eq!(cause, DoubtCause::OpenBracket);
    assert!(evidence.contains("it is only known to lie between 0.4 and 0.6"), "{evidence}");
    assert!(next.ends_with("until then use the end on the safe side"), "{next}");
    let answer = undecided(&model, |l| {
        l.outcome = Outcome::Undecided;
        (l.bracket.lower, l.bracket.upper) = (f64::NEG_INFINITY, f64::INFINITY);
    });
    let (cause, evidence, next) = why(&answer, &model);
    assert_eq!(cause, DoubtCause::NoAttempt);
    assert!(evidence.contains("gave both ends"), "{evidence}");
    assert_eq!(next, "run again with --keep-all");
}

/// An arch, of which friction alone does not tell which forces its weight produces.
fn arch() -> Model {
    let arch = json!({ "arch": { "radius": 10, "thickness": 1.5, "voussoirs": 15, "depth": 1 } });
    model(&template(0.7, arch, json!({})))
}

#[test]
fn a_state_that_neither_rests_nor_moves_is_named() {
    let model = arch();
    let (cause, evidence, next) = why(
        &verdict(&model, |a| a.state.as_mut().expect("a state").motion = StateMotion::Undecided),
        &model,
    );
    assert_eq!(cause, DoubtCause::DryFriction);
    assert!(evidence.contains("neither come to rest nor start a motion: "), "{evidence}");
    assert_eq!(next, "run `voussoir simulate`, which follows the blocks in time");

    // Of a load factor: friction limits that did not settle.
    let model = block(1.0);
    let bound = limit(&model, &Control::default());
    let mut dry =
        coulomb::DryLoadFactor::clone(&coulomb::load_factor(&model, &bound, &Control::default()));
    (dry.found, dry.value, dry.rests_at) = (Found::Undecided, None, Some(0.25));
    let answer = Limited { dry: Some(Proved::new(&model, dry)), ..Limited::from(bound) };
    let (cause, evidence, next) = why(&Answer::Limit(Box::new(answer)), &model);
    assert_eq!(cause, DoubtCause::DryFriction);
    assert!(evidence.ends_with("; at rest up to 0.25"), "{evidence}");
    assert!(next.starts_with("simulate the load in question"), "{next}");
}

#[test]
fn what_lies_on_the_line_says_so() {
    let model = block(1.0);
    let answer =
        verdict(&model, |a| (a.equilibrium_error.lower, a.equilibrium_error.upper) = (0.0, 2e-8));
    let (cause, evidence, next) = why(&answer, &model);
    assert_eq!(cause, DoubtCause::OnTheLine);
    assert!(evidence.contains("between 0e0 and 2e-8 of the weight"), "{evidence}");
    assert!(next.contains("by 1 % to either side"), "{next}");
}

/// Boxes without a size are no scenes; where nothing else flips, that is why.
#[test]
fn a_range_without_scenes_says_how_many() {
    let scene = scene(0.5, json!([ground(), cuboid("block", [1.0; 3], [0.0; 3])]), json!({}));
    let model = model(&scene);
    let options = CriticalOptions {
        law: Default::default(),
        vary: "/blocks/1/shape/box/size/0".into(),
        between: [-1.0, 1.0],
        scan: Some(5),
    };
    let answer = ask(&Question::Critical(options), &scene, &model, &Control::default()).unwrap();
    let (cause, evidence, next) = why(&answer, &model);
    assert_eq!(cause, DoubtCause::Range);
    assert_eq!(evidence, "of 5 values 0 are undecided and 3 give no valid scene");
    assert_eq!(next, "narrow --between to values that give valid scenes");
}

#[test]
fn a_simulation_says_why_it_did_not_end() {
    let model = block(1.0);
    let settings = SimulationSettings::default();
    let outcome = simulate(&model, &settings, &mut |_| ControlFlow::Continue(())).unwrap();
    for (stop, cause, wanted) in [
        (Stop::Broken, DoubtCause::BrokeOff, "needs no time steps"),
        (Stop::Stopped, DoubtCause::TimeLimit, "raise --time-limit"),
        (Stop::Rest, DoubtCause::StillMoving, "look at what slipped"),
        (Stop::Horizon, DoubtCause::StillMoving, "simulate longer: --seconds "),
    ] {
        let mut outcome = outcome.clone();
        outcome.fate = Fate::Undecided;
        outcome.runs.last_mut().unwrap().stop = stop;
        let (found, evidence, next) = why(&Answer::Simulate(Box::new(outcome)), &model);
        assert_eq!(found, cause, "{stop:?}");
        assert!(!evidence.is_empty() && next.contains(wanted), "{stop:?}: {evidence}; {next}");
    }
}
