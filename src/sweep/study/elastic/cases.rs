//! Scenes of elastic joints with closed forms.

use base::error::{InputError, JsonPath};
use check::verdict::Rate;
use model::interface::Model;
use nalgebra::Vector3;
use scene::Scene;
use serde_json::{Value, json};

/// Where one looks.
#[derive(Clone, Debug, PartialEq)]
pub enum ElasticWay {
    /// Rotation about y, rad.
    Turn,
    /// Way of a point of the block along an axis, m.
    Along(Vector3<f64>, Vector3<f64>),
}

impl ElasticWay {
    /// How far the last block has gone.
    pub fn of(&self, model: &Model, displaced: &[Rate]) -> f64 {
        let Some((block, q)) = model.assembly.blocks.last().zip(displaced.last()) else {
            return f64::NAN;
        };
        match self {
            Self::Turn => q.spin.y,
            Self::Along(at, axis) => (q.velocity + q.spin.cross(&(at - block.centroid))).dot(axis),
        }
    }
}

/// What is known.
#[derive(Clone, Debug, PartialEq)]
pub enum ElasticQuantity {
    /// A way under the dead load.
    Dead(ElasticWay),
    /// A way at the load factor 1.
    Live(ElasticWay),
    /// The dry load factor.
    LoadFactor,
}

/// A scene with a value that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticCase {
    /// Its name.
    pub name: String,
    /// The scene; what moves is its last block.
    pub scene: Scene,
    /// What is known.
    pub quantity: ElasticQuantity,
    /// The value.
    pub truth: f64,
    /// Whether its joints have an area.
    pub has_area: bool,
}

/// Weight of the block of 1 × 1 × 2 m, N.
const N: f64 = 2000.0 * 2.0 * 9.81;
/// Stiffness of its joint, Pa/m.
const NORMAL: f64 = 1e9;
const SHEAR: f64 = 4e8;
/// Stiffness of the spring, N/m.
const SPRING: f64 = 2e7;
/// Young's modulus and Poisson's ratio of the spheres, and their radius, m.
const YOUNG: f64 = 70e9;
const POISSON: f64 = 0.22;
const RADIUS: f64 = 0.01;

fn scene(value: Value) -> Result<Scene, InputError> {
    Scene::from_value(value).map_err(|e| InputError::at(JsonPath::root(), e.to_string()))
}

/// A block on a floor.
fn block(friction: f64, loads: Value, members: Value) -> Result<Scene, InputError> {
    scene(json!({
        "format": "voussoir-scene/1", "name": "Block",
        "joints": { "default": { "friction": friction, "normal_stiffness": NORMAL, "shear_stiffness": SHEAR } },
        "blocks": [
            { "id": "floor", "support": true, "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5] },
            { "id": "block", "density": 2000, "shape": { "box": { "size": [1, 1, 2] } }, "at": [0, 0, 1] }
        ],
        "loads": loads, "members": members
    }))
}

/// A sphere on what carries it.
fn sphere(friction: f64, carried: &[Value], at: f64, loads: Value) -> Result<Scene, InputError> {
    let ball = json!({ "id": "ball", "material": "glass", "shape": { "sphere": { "radius": RADIUS } }, "at": [0, 0, at] });
    let blocks: Vec<Value> = carried.iter().cloned().chain([ball]).collect();
    scene(json!({
        "format": "voussoir-scene/1", "name": "Sphere",
        "materials": { "glass": { "density": 2500, "young": YOUNG, "poisson": POISSON } },
        "joints": { "default": { "friction": friction } },
        "blocks": blocks, "loads": loads
    }))
}

/// Hertz: approach under a force, for `1/E*` and `R`.
fn approach(force: f64, modulus: f64, radius: f64) -> f64 {
    (9.0 * force * force / (16.0 * modulus * modulus * radius)).cbrt()
}

/// A block that is turned on a bed that cannot pull, spheres by Hertz and Mindlin, a pile without
/// friction, a block that slides against a spring, a block that tips and one that slides.
///
/// # Errors
/// None that a test would not find.
pub fn elastic_cases() -> Result<Vec<ElasticCase>, InputError> {
    let mut list = Vec::new();
    let mut add = |name: String, scene, quantity, truth, has_area| {
        list.push(ElasticCase { name, scene, quantity, truth, has_area });
    };
    for share in [0.1, 0.25, 0.4, 0.45] {
        let loads = json!({ "dead": [{ "block": "block", "moment": [0, share * N, 0] }] });
        // M = k b³ θ / 12 up to N b / 6, then M = N (b/2 − ⅓ √(2N/(kθ))).
        let turn = if share <= 1.0 / 6.0 {
            12.0 * share * N / NORMAL
        } else {
            2.0 * N / (9.0 * NORMAL * (0.5 - share) * (0.5 - share))
        };
        let name = format!("bed, M = {share} N b");
        let scene = block(0.7, loads, json!([]))?;
        add(name, scene, ElasticQuantity::Dead(ElasticWay::Turn), turn, true);
    }
    let floor = json!({ "id": "floor", "support": true, "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, -0.5] });
    let weight = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3) * 9.81;
    let press = json!({ "block": "ball", "force": [0, 0, -100] });
    let force = 100.0 + weight;
    // The floor is rigid.
    let modulus = YOUNG / (1.0 - POISSON * POISSON);
    let sinks = approach(force, modulus, RADIUS);
    let down = ElasticWay::Along(Vector3::zeros(), -Vector3::z());
    let pressed = sphere(0.3, std::slice::from_ref(&floor), RADIUS, json!({ "dead": [press] }))?;
    add("sphere, Hertz".into(), pressed, ElasticQuantity::Dead(down), sinks, false);
    let shear = YOUNG / (2.0 * (1.0 + POISSON)) / (2.0 - POISSON);
    for share in [0.5, 0.9] {
        let (most, contact) = (0.3 * force, (RADIUS * sinks).sqrt());
        let loads = json!({ "dead": [press], "live": [{ "block": "ball", "force": [share * most, 0, 0], "at": [0, 0, 0] }] });
        let way = 3.0 * most / (16.0 * contact * shear) * (1.0 - (1.0 - share).powf(2.0 / 3.0));
        let across = ElasticWay::Along(Vector3::zeros(), Vector3::x());
        let scene = sphere(0.3, std::slice::from_ref(&floor), RADIUS, loads)?;
        let name = format!("sphere, Mindlin, Q = {share} μ P");
        add(name, scene, ElasticQuantity::Live(across), way, false);
    }
    let cosine = 0.75_f64.sqrt();
    let low = |id: &str, x: f64| json!({ "id": id, "support": true, "material": "glass", "shape": { "sphere": { "radius": RADIUS } }, "at": [x, 0, 0] });
    let pile = sphere(
        0.0,
        &[low("left", -RADIUS), low("right", RADIUS)],
        2.0 * RADIUS * cosine,
        json!({}),
    )?;
    let sinks = approach(0.5 * weight / cosine, 0.5 * modulus, 0.5 * RADIUS) / cosine;
    let way = ElasticWay::Along(Vector3::new(0.0, 0.0, 2.0 * RADIUS * cosine), -Vector3::z());
    add("sphere on two, no friction".into(), pile, ElasticQuantity::Dead(way), sinks, false);
    let push = |height: f64, by: f64| json!({ "live": [{ "block": "block", "force": [by * N, 0, 0], "at": [0, 0, height] }] });
    let spring = json!([{ "id": "spring", "tie": { "between": [{ "block": "block", "at": [-0.5, 0, 0] }, { "ground": [-2, 0, 0] }], "strength": "infinite", "stiffness": SPRING } }]);
    let way = ElasticWay::Along(Vector3::zeros(), Vector3::x());
    let scene = block(0.5, push(0.0, 0.8), spring)?;
    let slid = 0.3 * N / SPRING;
    add("block against a spring".into(), scene, ElasticQuantity::Live(way), slid, true);
    for (name, friction, truth) in [("block that tips", 0.7, 0.5), ("block that slides", 0.3, 0.3)]
    {
        let scene = block(friction, push(1.0, 1.0), json!([]))?;
        add(name.into(), scene, ElasticQuantity::LoadFactor, truth, true);
    }
    Ok(list)
}
