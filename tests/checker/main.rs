//! The checker by itself, on results that the whole program saved (the command stands beside each):
//! what is proved is proved without a solver, what is forged is refused, and what only a solver
//! could compute again is said to be unchecked. The suite has the same files verified by the whole.

// A test ends where something is not as it should be, in its helpers too.
#![allow(clippy::expect_used, clippy::panic)]

use serde_json::{Value, json};
use voussoir_check::proof::{read::read_str, recompute::Nothing, verify, verify::Verified};

const FALLS: &str = include_str!("falls.json"); // assess structures/semicircular-arch-thin.json
const STANDS: &str = include_str!("stands.json"); // assess structures/semicircular-arch-thick.json
const COLUMN: &str = include_str!("column.json"); // assess structures/two-block-column.json
const PRESTRESS: &str = include_str!("prestress.json"); // assess structures/squeezed-block.json
const LIMIT: &str = include_str!("limit.json"); // limit structures/oppenheim-arch.json
const TILT: &str = include_str!("tilt.json"); // tilt structures/block-in-groove.json --toward 1,0,0
const THRUST: &str = include_str!("thrust.json"); // thrust structures/flat-arch.json
const CRITICAL: &str = include_str!("critical.json"); // critical structures/semicircular-arch-thick.json --vary /templates/0/arch/thickness --between 0.05 0.3 --scan 5

fn checked(text: &str) -> Verified {
    let file = read_str("result.json", text).expect("a result");
    let scene = file.scene.clone();
    verify(&file, &scene, &Nothing).expect("a scene")
}

/// The result with some value replaced.
fn edited(text: &str, pointer: &str, edit: impl Fn(&Value) -> Value) -> String {
    let mut file: Value = serde_json::from_str(text).expect("JSON");
    let place = file.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer} is there"));
    *place = edit(place);
    file.to_string()
}

fn scaled(v: &Value, by: f64) -> Value {
    json!(v.as_f64().expect("a number") * by)
}

fn without_the_second(list: &Value) -> Value {
    let mut list = list.as_array().expect("a list").clone();
    list.remove(1);
    json!(list)
}

#[test]
fn what_is_proved_needs_no_solver() {
    for (name, text) in [("falls", FALLS), ("column", COLUMN), ("prestress", PRESTRESS)] {
        let v = checked(text);
        assert!(v.proved() && v.unchecked().next().is_none(), "{name}: {:?}", v.parts);
    }
}

#[test]
fn what_only_a_solver_can_compute_is_said_to_be_unchecked() {
    for (name, text) in [
        ("stands", STANDS),
        ("limit", LIMIT),
        ("tilt", TILT),
        ("thrust", THRUST),
        ("critical", CRITICAL),
    ] {
        let v = checked(text);
        assert!(!v.refuted(), "{name}: {:?}", v.parts);
        assert!(v.claimed, "{name}");
        assert!(!v.proved() && v.unchecked().next().is_some(), "{name}: {:?}", v.parts);
        assert!(v.computed(), "{name}");
    }
}

#[test]
fn forged_results_are_refused() {
    let forged = [
        edited(FALLS, "/answer/verdict", |_| json!("stable")),
        edited(FALLS, "/evidence/assess/standing/certificate/rates", |_| json!([])),
        edited(FALLS, "/evidence/assess/standing/certificate/rates/0/velocity", |v| {
            json!([v[2].as_f64(), v[0].as_f64(), v[1].as_f64()])
        }),
        edited(STANDS, "/evidence/assess/standing/certificate/forces/0/forces/0/2", |v| {
            scaled(v, 1.001)
        }),
        edited(STANDS, "/scene/templates/0/arch/thickness", |_| json!(0.1)),
        edited(COLUMN, "/answer/equilibrium_error/upper", |_| json!(-1.0)),
        edited(PRESTRESS, "/answer/verdict", |_| json!("stable")),
        edited(LIMIT, "/answer/load_factor/value", |v| scaled(v, 1.001)),
        edited(LIMIT, "/evidence/limit/factor/bound/claim/load_factor/upper", |v| scaled(v, 0.9)),
        edited(TILT, "/answer/tilt_deg/value", |v| scaled(v, 1.1)),
        edited(THRUST, "/answer/thrust/least/value", |v| scaled(v, 0.9)),
        edited(CRITICAL, "/answer/critical/0/value", |v| scaled(v, 1.1)),
        // Values nobody looked at, in evidence and answer alike.
        edited(
            &edited(CRITICAL, "/evidence/critical/scan", without_the_second),
            "/answer/search/scan",
            without_the_second,
        ),
        edited(CRITICAL, "/question/critical/scan", |_| json!(33)),
    ];
    for (k, text) in forged.iter().enumerate() {
        let v = checked(text);
        assert!(v.refuted() && !v.proved(), "forgery {k}: {:?}", v.parts);
    }
}

#[test]
fn a_result_of_another_scene_is_refused() {
    let file = read_str("result.json", FALLS).expect("a result");
    let other = read_str("result.json", STANDS).expect("a result").scene;
    assert!(verify(&file, &other, &Nothing).expect("a scene").refuted());
}

/// What was found on one scene says nothing about another.
#[test]
fn a_result_is_checked_anew_on_every_scene() {
    let file = read_str("result.json", STANDS).expect("a result");
    assert!(!verify(&file, &file.scene, &Nothing).expect("a scene").refuted());
    let smooth = file.scene.with_field("/joints/default/friction", 0.01).expect("a scene");
    assert!(verify(&file, &smooth, &Nothing).expect("a scene").refuted());
    assert!(!verify(&file, &file.scene, &Nothing).expect("a scene").refuted());
}
