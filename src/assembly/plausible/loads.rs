//! Loads: where they act, and whether they say what somebody meant.

use super::{Weights, bounds, short};
use crate::{
    assembly::{Assembly, Block},
    error::{InputError, JsonPath},
    scene::{At, Load, Scene},
};
use nalgebra::Vector3;

/// What looks like a slip in the loads of a resolved scene.
pub(super) fn slips(scene: &Scene, assembly: &Assembly) -> Vec<String> {
    let path = JsonPath::root().key("loads");
    let mut texts = Vec::new();
    for (i, load) in scene.loads.dead.iter().enumerate() {
        let path = path.key("dead").index(i);
        texts.extend(off(load, assembly).map(|off| off.told(&path)));
        texts.extend(again(load, assembly, &path));
        texts.extend(weight(load, &path));
        texts.extend(force(load, assembly, &path));
    }
    for (i, load) in scene.loads.live.iter().enumerate() {
        let path = path.key("live").index(i);
        texts.extend(off(load, assembly).map(|off| off.told(&path)));
        texts.extend(weight(load, &path));
    }
    texts
}

/// A force that acts off its block.
struct Off {
    /// How far.
    what: String,
    /// What may have been meant.
    meant: Option<String>,
    /// Distance over the block's size.
    far: f64,
}

/// Refuses a force that acts far off its block, where no arm is said to carry it; `path` is that of the load.
///
/// # Errors
/// It does.
pub(in crate::assembly) fn place(load: &Load, assembly: &Assembly, path: &JsonPath) -> Result<(), InputError> {
    match off(load, assembly) {
        Some(off) if off.far > bounds::FAR_OFF => {
            let meant = off.meant.map_or(String::new(), |meant| format!("{meant}; "));
            Err(InputError::at(path.key("at"), off.what).hint(format!("{meant}where an arm carries it that far, say \"arm\": true")))
        }
        _ => Ok(()),
    }
}

fn off(load: &Load, assembly: &Assembly) -> Option<Off> {
    let (Some(id), Some(At::Point(point)), false) = (&load.block, load.at, load.arm) else { return None };
    let block = &assembly.blocks[assembly.find(id)?];
    let point = Vector3::from(point);
    let distance = block.solid.distance(point);
    let on = |b: &Block, p: Vector3<f64>| b.solid.distance(p) <= bounds::ON_THE_BLOCK * b.size;
    if distance <= bounds::ON_THE_BLOCK * block.size {
        return None;
    }
    // A point near the origin is near it in any unit.
    let meant = if distance > bounds::FAR_OFF * block.size && on(block, point / 1e3) {
        Some("in millimetres the point would lie on it: lengths are in m".to_string())
    } else {
        let other = assembly.blocks.iter().find(|b| on(b, point));
        other.map(|b| format!("the point lies on block {:?}: is that the one that is meant?", b.id))
    };
    let what = format!("the force acts {} m off block {id:?}, which measures {} m", short(distance), short(block.size));
    Some(Off { what, meant, far: distance / block.size })
}

impl Off {
    fn told(self, path: &JsonPath) -> String {
        let remedy =
            self.meant.unwrap_or_else(|| "\"at\" is a point of the scene, in m; where an arm carries the load, say \"arm\": true".into());
        format!("{path}: {}; {remedy}", self.what)
    }
}

/// A dead load that is the own weight once more.
fn again(load: &Load, assembly: &Assembly, path: &JsonPath) -> Option<String> {
    let gravity = assembly.gravity;
    let same = |v: [f64; 3], w: Vector3<f64>| (Vector3::from(v) - w).norm() <= bounds::SAME * w.norm();
    let by_weight = load.weight.is_some_and(|w| same(w, gravity / gravity.norm()));
    (by_weight || load.acceleration.is_some_and(|a| same(a, gravity))).then(|| {
        format!("{path} is the blocks' own weight once more: it counts by itself, and doubled with this. Leave the load out, or raise the density")
    })
}

/// Multiples of the weight that are an acceleration.
fn weight(load: &Load, path: &JsonPath) -> Option<String> {
    let norm = Vector3::from(load.weight?).norm();
    bounds::WEIGHT_IN_ACCELERATION.contains(&norm).then(|| {
        let path = path.key("weight");
        format!(
            "{path} is {} times the weight. It looks like m/s²: write \"acceleration\" in place of \"weight\", or 1 for once the weight",
            short(norm)
        )
    })
}

/// A dead force that does nothing.
fn force(load: &Load, assembly: &Assembly, path: &JsonPath) -> Option<String> {
    Weights::of(assembly)?;
    let force = Vector3::from(load.force?).norm();
    let block = assembly.find(load.block.as_ref()?)?;
    let weight = assembly.weight(block);
    (bounds::FORCE_IN_KILONEWTONS.contains(&force) && force < bounds::LEAST_DEAD_FORCE * weight).then(|| {
        format!(
            "{} is {} N on a block that weighs {} N: it does next to nothing. It looks like kN: forces are in N, write {:e}",
            path.key("force"),
            short(force),
            short(weight),
            force * 1e3
        )
    })
}
