//! The road of a bridge, the fill below it, and what stands on it.

use base::number::short;
use check::proof::moving::MovingAnswer;
use model::{interface::Model, train::Standing};
use nalgebra::Vector3;
use scene::{Load, OnRoad, Scene, generate::Road};

/// Radius of a wheel, m.
pub const WHEEL: f64 = 0.45;

/// The road of a bridge.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewRoad {
    /// The upper surface of the structure from left to right, m.
    pub below: Vec<Vector3<f64>>,
    /// Both ends of the road above it; nothing where there is no fill.
    pub line: Vec<Vector3<f64>>,
    /// Of every span both springings and the crown of the intrados, and the extrados over it, m.
    pub openings: Vec<[Vector3<f64>; 4]>,
    /// What stands on it.
    pub wheels: Vec<ViewWheel>,
}

/// An axle of a train, or a load on the road.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewWheel {
    /// Where it touches the road, m.
    pub at: Vector3<f64>,
    /// Which it is, where, and how heavy.
    pub name: String,
}

impl ViewRoad {
    /// Points that a drawing has to have room for: the road, and the wheels on it.
    pub fn points(&self, up: Vector3<f64>) -> impl Iterator<Item = Vector3<f64>> {
        let tops = self.wheels.iter().map(move |w| w.at + up * (2.5 * WHEEL));
        self.line.iter().copied().chain(tops)
    }
}

/// The roads of a scene; on them the axles of its train where the answer has them, else its loads.
pub fn of(scene: &Scene, model: &Model, train: Option<&MovingAnswer>) -> Vec<ViewRoad> {
    let mut left = match train {
        Some(answer) => axles(scene, answer),
        None => loads(scene, model),
    };
    let mut list = Vec::new();
    for road in scene.templates.iter().filter_map(Road::of) {
        let [below, line] = road.outline().map(|l| l.into_iter().map(Vector3::from).collect());
        // It stands on the first road that it is on.
        let (here, others): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|(on, _)| road.under(*on, [0.0, 0.0, -1.0]).is_some());
        left = others;
        let wheel = |(on, name): (OnRoad, String)| ViewWheel { at: road.on(on.x).into(), name };
        let wheels = here.into_iter().map(wheel).collect();
        let openings = road.openings().map(|o| o.map(Vector3::from)).collect();
        list.push(ViewRoad { below, line, openings, wheels });
    }
    list
}

/// The axles that stand on a span.
fn axles(scene: &Scene, answer: &MovingAnswer) -> Vec<(OnRoad, String)> {
    let axle = |s: &Standing| {
        let own = scene.train.as_ref()?.axles.get(s.axle)?;
        let on = OnRoad { x: s.x, patch: own.patch, across: own.across };
        Some((on, named(&format!("axle {}", s.axle + 1), s.x, s.force)))
    };
    answer.axles.iter().filter_map(axle).collect()
}

/// The loads on roads.
fn loads(scene: &Scene, model: &Model) -> Vec<(OnRoad, String)> {
    let down = model.assembly.gravity.normalize();
    let on = |l: &Load| {
        let (on, force) = (l.road?, Vector3::from(l.force?));
        Some((on, named("load", on.x, force.dot(&down))))
    };
    scene.loads.dead.iter().chain(&scene.loads.live).filter_map(on).collect()
}

fn named(what: &str, x: f64, force: f64) -> String {
    format!("{what} at x = {} m, {} N", short(x), short(force))
}
