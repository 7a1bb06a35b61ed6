//! Drawings, VTK files and tables are read back, and what they say is compared with the mechanics.

mod loads;
mod models;
mod round_trips;
mod shown;
mod svg;
mod table;
mod vtk;

use crate::ask::{cuboid, ground, model, push, scene, sphere, template};
use roxmltree::{Document, Node};
use serde_json::json;
use voussoir::{
    analysis::{Control, Law, assess, limit},
    interface::Model,
    proof::saved,
    report::view::View,
    scene::Scene,
};

fn control() -> Control {
    Control { law: Law::Associative, ..Control::default() }
}

/// An arch with a live load sideways, `size` in radius, so many times as dense as 1.
fn arch(thickness: f64, size: f64, more: serde_json::Value) -> Scene {
    let mut keys = push([1.0, 0.0, 0.0]);
    more.as_object().unwrap().iter().for_each(|(k, v)| keys[k] = v.clone());
    let arch = json!({ "arch": { "radius": size, "thickness": thickness * size, "depth": size, "voussoirs": 16 } });
    template(0.8, arch, keys)
}

fn assessed(scene: &Scene) -> (Model, View) {
    let m = model(scene);
    let file = saved::assessment(scene, &m, &assess(&m, &control())).unwrap();
    let view = View::new(&m, &file, Vec::new()).unwrap();
    (m, view)
}

fn limited(scene: &Scene) -> (Model, View) {
    let m = model(scene);
    let file = saved::load_factor(scene, &m, &limit(&m, &control()).into()).unwrap();
    let view = View::new(&m, &file, Vec::new()).unwrap();
    (m, view)
}

/// A ball on a box on the ground.
fn ball_on_box() -> Scene {
    scene(
        0.6,
        json!([
            ground(),
            cuboid("box", [1.0, 2.0, 0.5], [0.0, 0.0, 0.0]),
            sphere("ball", 0.4, [0.1, 0.0, 0.9])
        ]),
        json!({}),
    )
}

fn parsed(text: &str) -> Document<'_> {
    Document::parse(text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Elements with a name below a node.
fn all<'a>(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.descendants().filter(move |n| n.has_tag_name(name))
}

/// Numbers of a text, wherever anything else stands between them.
fn numbers(text: &str) -> Vec<f64> {
    text.split(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c)))
        .filter_map(|w| w.parse().ok())
        .collect()
}
