//! Loads are drawn where they act, each by itself, and lines of thrust end on their lines of
//! action.

use super::{assessed, limited};
use crate::ask::{cuboid, ground, model, scene};
use nalgebra::Vector3;
use serde_json::json;
use voussoir::report::{view::View, vtk::vtp};

/// A cube on the ground with as much as it weighs on it, off its middle.
fn loaded(live: bool) -> voussoir::scene::Scene {
    let force = |x: f64, by: f64| json!({ "block": "cube", "force": [0, 0, -by], "at": [x, 0, 1] });
    let loads = if live {
        json!({ "live": [force(0.3, 1.0), force(-0.4, 0.5)] })
    } else {
        json!({ "dead": [force(0.3, 1.0)] })
    };
    scene(
        0.7,
        json!([ground(), cuboid("cube", [1.0, 1.0, 1.0], [0.0; 3])]),
        json!({ "gravity": [0, 0, -1], "loads": loads }),
    )
}

#[test]
fn each_load_is_drawn_where_it_acts() {
    let scene = loaded(true);
    let view = View::bare(&model(&scene));
    let places: Vec<f64> = view.loads.iter().map(|l| l.at.x).collect();
    assert_eq!(places, [0.3, -0.4]);
    assert!(view.loads.iter().all(|l| l.live && l.at.z == 1.0));
    let (_, view) = limited(&scene);
    let file = vtp(&view);
    assert!(file.contains("Name=\"load\""), "VTK has the loads");
    let parts = file.split("Name=\"part\"").nth(1).unwrap().split("</DataArray>").next().unwrap();
    let numbers = parts.split('>').nth(1).unwrap().split_whitespace();
    assert_eq!(numbers.filter(|p| *p == "6").count(), 2);
}

#[test]
fn a_line_of_thrust_ends_on_the_line_of_action() {
    let (_, view) = assessed(&loaded(false));
    // Weight in the middle and as much at 0.3: together at 0.15.
    let [part] = view.states[0].line[..] else { panic!("one joint presses") };
    let (from, to): (Vector3<f64>, Vector3<f64>) = (part.from, part.to);
    assert!(
        (from.x - 0.15).abs() < 1e-6 && (to.x - 0.15).abs() < 1e-6 && to.z > 0.4,
        "{from} {to}"
    );
}
