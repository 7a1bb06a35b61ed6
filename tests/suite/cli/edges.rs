//! At the edges of what is asked: odd directions, load factors of exactly zero, dead loads next to
//! their limit. What is saved there is proved, verbs agree, and exit codes say what lines say.

use super::*;

fn structure(name: &str) -> String {
    format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

/// A block on a ground, with loads.
fn block(size: [f64; 3], friction: f64, gravity: [f64; 3], loads: &Value) -> Value {
    json!({
        "format": "voussoir-scene/1",
        "gravity": gravity,
        "joints": { "default": { "friction": friction } },
        "blocks": [
            { "id": "ground", "shape": { "box": { "size": [20, 20, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "block", "shape": { "box": { "size": size } }, "at": [0, 0, 0.5 * size[2]], "density": 2000 }
        ],
        "loads": loads
    })
}

/// A slope as gravity: the tangent of its angle, times cos = 2 / √5.
fn slope(tangent: f64) -> [f64; 3] {
    let cos = 1.0 / 1.0_f64.hypot(tangent);
    [9.81 * tangent * cos, 0.0, -9.81 * cos]
}

impl Desk {
    /// Asks, saves and checks.
    #[track_caller]
    fn proved(&self, wanted: i32, question: &[&str]) -> Value {
        let saved = self.saved(wanted, question);
        expect(YES, voussoir(&["check", &self.at("saved.json")]));
        saved
    }
}

#[test]
fn what_is_saved_of_odd_directions_is_proved() {
    let desk = Desk::new();
    // One slides, the other tips.
    let pushed = json!({ "live": [{ "weight": [1, 0, 0] }] });
    let mut two = block([1.0, 1.0, 1.0], 0.5, slope(0.0), &pushed);
    let tall = json!({ "id": "tall", "shape": { "box": { "size": [0.2, 1, 2] } }, "at": [5, 0, 1], "density": 2000 });
    two["blocks"].as_array_mut().unwrap().push(tall);
    let two = desk.write("two.json", &two);
    for toward in ["1,0.3", "1,1", "-0.3,1", "1,2", "1,0"] {
        let toward = format!("--toward={toward}");
        desk.proved(YES, &["kinematic", &two, &toward]);
        desk.proved(YES, &["tilt", &structure("rock-wedge"), &toward]);
        // Zero: nothing may be added to the dead load.
        desk.proved(YES, &["tilt", &structure("a-frame-stands"), &toward]);
    }
}

/// Fingers at their strength, which grows with the tilt: forces are cut to what they hold at the
/// tilt that is said, and what is undecided is about the scene as it stands.
#[test]
fn what_is_saved_of_grips_is_proved() {
    let desk = Desk::new();
    let saved = desk.proved(YES, &["tilt", &structure("grip-two-fingers"), "--toward=-0.1,-1"]);
    assert!(
        saved["answer"]["members"][0]["state"] == "at_strength",
        "{}",
        saved["answer"]["members"]
    );
    desk.proved(YES, &["tilt", &structure("grip-three-fingers"), "--toward=-0.1,-1"]);
    voussoir(&[
        "tilt",
        &structure("grip-three-fingers"),
        "--toward=0.3,1",
        "--save",
        &desk.at("saved.json"),
    ]);
    let said = voussoir(&["check", &desk.at("saved.json")]);
    assert!(!out(&said).contains("refuted"), "{}", out(&said));
}

#[test]
fn a_load_factor_of_zero_is_proved() {
    let desk = Desk::new();
    let lifted = json!({ "live": [{ "weight": [0, 0, 1] }] });
    let at_rest = desk.write("edge.json", &block([1.0, 1.0, 0.5], 0.5, slope(0.5), &lifted));
    voussoir(&["limit", &at_rest, "--save", &desk.at("saved.json")]);
    expect(YES, voussoir(&["check", &desk.at("saved.json")]));
}

/// A block pushed sideways by 0.9999 of what it bears, and lifted: its contacts close no chain, and
/// `assess` and `limit` say the same of it.
#[test]
fn limit_says_what_assess_says_of_a_block_next_to_its_limit() {
    let desk = Desk::new();
    let push = json!({
        "block": "block", "force": [4427.771338734941, 1328.3314016204824, 0.0], "at": [0.1, 0.3, 0.1]
    });
    let scene = |loads: &Value| block([1.3, 0.7, 0.4], 0.7, [0.0, 0.0, -9.81], loads);
    let live = json!({ "dead": [push], "live": [{ "weight": [0, 0, 1] }] });
    let saved = desk.proved(YES, &["limit", &desk.write("lifted.json", &scene(&live))]);
    let value = saved["answer"]["load_factor"]["value"].as_f64().unwrap();
    let weight = 1.3 * 0.7 * 0.4 * 2000.0 * 9.81;
    for (share, wanted) in [(0.1, YES), (0.9, YES), (0.999, YES), (1.1, NO)] {
        let lift = [0.0, 0.0, share * value * weight];
        let lift = json!({ "block": "block", "force": lift, "at": [0, 0, 0.2] });
        let at = scene(&json!({ "dead": [push, lift] }));
        expect(wanted, voussoir(&["assess", &desk.write("at.json", &at)]));
    }
}

#[test]
fn exit_codes_at_the_edges() {
    let desk = Desk::new();
    // Undecided is no no: steeper than its angle of friction by what rounding cannot tell.
    let across = json!({ "live": [{ "weight": [0, 1, 0] }] });
    let gravity = [4.3871653753643205, 0.0, -8.774330741954309];
    let edge = desk.write("edge.json", &block([1.0, 1.0, 0.5], 0.5, gravity, &across));
    let said = expect(UNDECIDED, voussoir(&["limit", &edge, "-q"]));
    assert!(out(&said).contains("undecided"), "{}", out(&said));
    // A fall is a no to whoever asks how steep it may be.
    for name in ["block-on-incline-slides", "pushed-uphill"] {
        expect(NO, voussoir(&["repose", &structure(name), "--toward", "1,0"]));
        expect(NO, voussoir(&["tilt", &structure(name), "--toward", "1,0"]));
    }
}

/// The curve of an arch whose load factor falls below zero at once ends before.
#[test]
fn a_load_factor_that_jumps_below_zero_has_not_vanished() {
    let desk = Desk::new();
    let question = ["kinematic", &structure("arch-with-point-load")];
    desk.proved(YES, &question);
}

/// Across its plane an arch has several motions that begin at the same load factor.
#[test]
fn a_curve_holds_no_pose_in_which_blocks_overlap() {
    let desk = Desk::new();
    let saved = desk.proved(YES, &["kinematic", &structure("oppenheim-arch")]);
    assert!(saved["answer"]["kinematic"]["toward"] == json!([0.0, 1.0, 0.0]));
}
