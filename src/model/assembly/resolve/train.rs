//! A train that means something: axles that press down, and a way with positions on the bridge.

use super::check;
use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use scene::{Axle, AxleForce, OnRoad, Scene, generate};

/// How far a force may lean, over itself. Larger: a braking force would pass in silence. Smaller:
/// components written to nine digits would not.
const ALONG: f64 = 1e-9;

/// Refuses a train that cannot drive over the scene.
pub(super) fn resolve(
    scene: &Scene,
    gravity: Vector3<f64>,
    path: &JsonPath,
) -> Result<(), InputError> {
    let Some(train) = &scene.train else { return Ok(()) };
    if train.axles.is_empty() {
        return Err(InputError::at(path.key("axles"), "the train has no axles")
            .hint("add one: { \"at\": 0, \"force\": 100000 }, in m and N"));
    }
    for (k, a) in train.axles.iter().enumerate() {
        axle(a, &gravity.normalize(), &path.key("axles").index(k))?;
    }
    check::positive(train.step, &path.key("step"), "m")?;
    let here = path.key("path");
    if !train.path.iter().all(|x| x.is_finite()) {
        return Err(InputError::at(here, "must be two finite numbers")
            .hint("x of the train's origin at the start and the end of its path, m"));
    }
    let [from, to] = train.path;
    if from > to {
        return Err(InputError::at(
            here,
            format!("the path must run from the smaller x to the greater, got {from} to {to}"),
        )
        .hint("exchange them: both directions of travel are computed anyway"));
    }
    if (to - from) / train.step >= MOST_STEPS {
        return Err(InputError::at(
            path.key("step"),
            format!("makes more than {MOST_STEPS} positions on a path of {} m", to - from),
        )
        .hint("usual steps are a hundredth to a tenth of the clear span"));
    }
    let bridges: Vec<_> = scene.templates.iter().filter(|t| t.name() == "bridge").collect();
    if bridges.is_empty() {
        return Err(InputError::at(path.clone(), "the scene has no road for the train")
            .hint("add a template \"bridge\": the train drives over its road"));
    }
    // The widest reach of any axle to either side; a bridge lies within it or is passed by.
    let reach = train.axles.iter().map(|a| a.at.abs() + 0.5 * a.patch).fold(0.0, f64::max);
    let probe = |x: f64, patch: f64| {
        let on = OnRoad { x, patch, across: None };
        let force = (gravity.normalize()).into();
        bridges.iter().any(|t| generate::on_road(t, on, force).is_some())
    };
    if !probe(0.5 * (from + to), (to - from) + 2.0 * reach) {
        let middles: Vec<String> = bridges.iter().map(|t| t.place().1[0].to_string()).collect();
        return Err(InputError::at(here, "no axle reaches a span")
            .hint(format!("the middle of the bridge lies at x = {}", middles.join(" and "))));
    }
    Ok(())
}

/// Most steps on a way. More: a step in another unit than the way fills the memory.
const MOST_STEPS: f64 = 10_000.0;

fn axle(axle: &Axle, down: &Vector3<f64>, path: &JsonPath) -> Result<(), InputError> {
    if !axle.at.is_finite() {
        return Err(InputError::at(path.key("at"), "must be a finite number").hint("in m"));
    }
    check::positive(axle.patch, &path.key("patch"), "m")?;
    if let Some(across) = axle.across {
        check::positive(across, &path.key("across"), "m")?;
    }
    let here = path.key("force");
    match axle.force {
        AxleForce::Down(force) => check::positive(force, &here, "N").map(|_| ()),
        AxleForce::Vector(v) => {
            let v = check::vector(v, &here)?;
            let along = v.dot(down);
            if !(along > 0.0 && (v - down * along).norm() <= ALONG * v.norm()) {
                return Err(InputError::at(here, "an axle must press down")
                    .hint("give its force as a number in N, or as [0, 0, -force]"));
            }
            Ok(())
        }
    }
}
