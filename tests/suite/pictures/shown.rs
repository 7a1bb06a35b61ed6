//! What drawings leave out and look through, and what a heap shows.

use super::assessed;
use crate::ask::{cuboid, fixed, ground, model, scene, sphere};
use nalgebra::Vector3;
use serde_json::{Value, json};
use voussoir::{
    analysis::repose::profile,
    report::{
        drawing::{Aspect, printed, svg},
        view::View,
    },
    scene::Protocol,
};

/// A support before a ball is glass where it hides the ball, and solid where it does not.
#[test]
fn walls_are_glass_where_they_hide() {
    let wall = fixed(cuboid("wall", [3.0, 0.2, 2.0], [0.0, -1.5, 0.0]));
    let s = scene(0.6, json!([ground(), sphere("ball", 0.4, [0.0, 0.0, 0.4]), wall]), json!({}));
    let view = View::bare(&model(&s));
    assert!(
        view.walled(&-Vector3::y()) && !view.walled(&Vector3::y()) && !view.walled(&Vector3::x())
    );
    for (from, glass) in [(Aspect::Front, true), (Aspect::Back, false), (Aspect::Right, false)] {
        assert_eq!(svg(&view, from).contains("class=\"support glass\""), glass, "{from:?}");
    }
    let mut view = view;
    view.hides_supports = true;
    let text = svg(&view, Aspect::Front);
    assert!(!text.contains("class=\"support") && text.contains("<title>ball</title>"));
    assert!(!text.contains("<title>wall</title>"));
}

/// Below a wall stands what carries it: nothing is glass.
#[test]
fn what_stands_on_supports_is_not_behind_them() {
    let (_, view) = assessed(&super::arch(0.2, 1.0, json!({})));
    for eye in [-Vector3::y(), Vector3::x(), Vector3::new(0.5, -0.75, 0.45).normalize()] {
        assert!(!view.walled(&eye), "{eye}");
    }
}

/// Grains on a slope of 1 : 2: the drawing shows the line at its angle, from the side, unasked.
#[test]
fn a_heap_shows_its_slope() {
    let protocol = Protocol { diameter: 1.0, ..Protocol::default() };
    let grains: Vec<Value> = (0..14)
        .flat_map(|i| (0..8).map(move |j| (i, j)))
        .map(|(i, j)| {
            let (x, y) = (f64::from(i) + 0.5, f64::from(j) - 3.5);
            sphere(&format!("g{i}-{j}"), 0.5, [x, y, 8.0 - 0.5 * x])
        })
        .chain([ground()])
        .collect();
    let m = model(&scene(0.5, json!(grains), json!({})));
    let mut view = View::bare(&m);
    view.slope = profile(&protocol, &m.assembly).map(Into::into);
    let slope = view.slope.as_ref().expect("a slope");
    assert!((slope.angle_deg - 0.5f64.atan().to_degrees()).abs() < 1e-9, "{slope:?}");
    for p in slope.surface.iter().chain(&slope.line) {
        assert!((p.z - (8.5 - 0.5 * p.x)).abs() < 1e-9 && p.y == 0.0, "{p}");
    }
    let text = svg(&view, Aspect::Auto);
    assert_eq!(text, svg(&view, Aspect::Front));
    assert!(text.contains("straight line through them, 26.6°"), "{text}");
    let line = text.split("class=\"fitted\" d=\"M").nth(1).unwrap().split('"').next().unwrap();
    let at: Vec<f64> = line.split([' ', 'L']).map(|w| w.parse().unwrap()).collect();
    let drawn = ((at[3] - at[1]) / (at[2] - at[0])).atan().to_degrees();
    assert!((drawn - slope.angle_deg).abs() < 0.05, "{line}");
}

/// What is printed is light whatever the page is, and its style holds inside it alone.
#[test]
fn a_drawing_in_a_record_keeps_its_style_to_itself() {
    let (_, view) = assessed(&super::arch(0.2, 1.0, json!({})));
    let text = printed(&view, Aspect::Auto);
    let style = text.split("<style>").nth(1).unwrap().split("</style>").next().unwrap();
    assert!(!style.contains("@media"));
    for rule in style.split('}').filter(|r| !r.trim().is_empty()) {
        let names = rule.split('{').next().unwrap();
        assert!(names.split(',').all(|n| n.starts_with(".sheet ")), "{rule}");
    }
    assert!(text.starts_with("<svg") && text.contains("class=\"sheet\""));
    let (_, plain) = assessed(&scene(
        0.5,
        json!([ground(), cuboid("b", [1.0, 1.0, 1.0], [0.0, 0.0, 0.0])]),
        json!({}),
    ));
    assert!(svg(&plain, Aspect::Auto).contains("@media"));
}
