//! Loads: where they act, and whether they say what somebody meant.

use super::{Told, Weights, bounds, short};
use crate::assembly::{Assembly, Block};
use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use scene::{At, Load, PushingMass, Scene};
use std::collections::HashMap;

/// What looks like a mistake in the loads of a resolved scene.
pub(super) fn mistakes(scene: &Scene, assembly: &Assembly) -> Vec<String> {
    let path = JsonPath::root().key("loads");
    let index: HashMap<&str, usize> =
        assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    let on_earth = Weights::of(assembly).is_some();
    let mut told = Told::default();
    for (key, loads) in [("dead", &scene.loads.dead), ("live", &scene.loads.live)] {
        for (i, load) in loads.iter().enumerate() {
            let path = path.key(key).index(i);
            let block =
                load.block.as_deref().and_then(|id| index.get(id)).map(|&i| &assembly.blocks[i]);
            if let Some((block, off)) = block.and_then(|block| Some((block, Off::of(load, block)?)))
            {
                told.add("off", || off.told(("the force", "the load"), block, assembly, &path));
            }
            if let Some(text) = weight(load, &path) {
                told.add("weight", || text);
            }
            if key == "live" {
                continue;
            }
            if let Some(text) = again(load, assembly, &path) {
                told.add("again", || text);
            }
            if let Some(text) =
                block.filter(|_| on_earth).and_then(|block| force(load, block, assembly, &path))
            {
                told.add("force", || text);
            }
        }
    }
    told.texts("loads")
}

/// Refuses a force that acts far off its block, where no arm is said to carry it; `path` is that of
/// the load.
///
/// # Errors
/// It does.
pub(in crate::assembly) fn place(
    load: &Load,
    block: &Block,
    assembly: &Assembly,
    path: &JsonPath,
) -> Result<(), InputError> {
    match Off::of(load, block) {
        Some(off) if off.distance > bounds::FAR_OFF * block.size => {
            let meant =
                off.meant(block, assembly).map_or(String::new(), |meant| format!("{meant}; "));
            let hint = format!("{meant}if an arm carries it that far, set \"arm\": true");
            Err(InputError::at(path.key("at"), off.words("the force", block)).hint(hint))
        }
        _ => Ok(()),
    }
}

/// The same for a mass that an earthquake pushes.
///
/// # Errors
/// As [`place`].
pub(in crate::assembly) fn mass_place(
    mass: &PushingMass,
    block: &Block,
    assembly: &Assembly,
    path: &JsonPath,
) -> Result<(), InputError> {
    match Off::at(mass.at.into(), false, block) {
        Some(off) if off.distance > bounds::FAR_OFF * block.size => {
            let at = InputError::at(path.key("at"), off.words("the mass", block));
            Err(at.hint(off.meant(block, assembly).unwrap_or_else(|| {
                "\"at\" is where the mass pushes the block: a point of the scene, in m".into()
            })))
        }
        _ => Ok(()),
    }
}

/// A force that acts off its block.
pub(super) struct Off {
    /// Where, m.
    point: Vector3<f64>,
    /// How far off, m.
    pub distance: f64,
}

impl Off {
    fn of(load: &Load, block: &Block) -> Option<Self> {
        let Some(At::Point(point)) = load.at else { return None };
        Self::at(point.into(), load.arm, block)
    }

    /// A point off its block, where no arm carries the force.
    pub fn at(point: Vector3<f64>, arm: bool, block: &Block) -> Option<Self> {
        if arm {
            return None;
        }
        let distance = block.solid.distance(point);
        (distance > bounds::ON_THE_BLOCK * block.size).then_some(Self { point, distance })
    }

    /// `what` acts there.
    pub fn words(&self, what: &str, block: &Block) -> String {
        format!(
            "{what} acts {} m off block {:?}, which measures {} m",
            short(self.distance),
            block.id,
            short(block.size)
        )
    }

    /// What may have been meant.
    pub fn meant(&self, block: &Block, assembly: &Assembly) -> Option<String> {
        let on = |b: &Block, p: Vector3<f64>| b.solid.distance(p) <= bounds::ON_THE_BLOCK * b.size;
        // A point near the origin is near it in any unit.
        if self.distance > bounds::FAR_OFF * block.size && on(block, self.point / 1e3) {
            return Some("in millimetres the point would lie on it: lengths are in m".into());
        }
        let other = assembly.blocks.iter().find(|b| on(b, self.point));
        other.map(|b| format!("the point lies on block {:?}: was that block meant?", b.id))
    }

    /// `what` acts there, where an arm could carry `carried`.
    pub fn told(
        &self,
        (what, carried): (&str, &str),
        block: &Block,
        assembly: &Assembly,
        path: &JsonPath,
    ) -> String {
        let remedy = self
            .meant(block, assembly)
            .unwrap_or_else(|| format!("\"at\" is a point of the scene, in m; if an arm carries {carried}, set \"arm\": true"));
        format!("{path}: {}; {remedy}", self.words(what, block))
    }
}

/// A dead load that is the own weight once more.
fn again(load: &Load, assembly: &Assembly, path: &JsonPath) -> Option<String> {
    let gravity = assembly.gravity;
    let same =
        |v: [f64; 3], w: Vector3<f64>| (Vector3::from(v) - w).norm() <= bounds::SAME * w.norm();
    let by_weight = load.weight.is_some_and(|w| same(w, gravity / gravity.norm()));
    (by_weight || load.acceleration.is_some_and(|a| same(a, gravity))).then(|| {
        format!("{path} repeats the blocks' own weight, which always acts and would count twice. Leave the load out, or raise the density")
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
fn force(load: &Load, block: &Block, assembly: &Assembly, path: &JsonPath) -> Option<String> {
    let force = Vector3::from(load.force?).norm();
    let weight = block.mass * assembly.gravity.norm();
    (bounds::FORCE_IN_KILONEWTONS.contains(&force) && force < bounds::LEAST_DEAD_FORCE * weight).then(|| {
        format!(
            "{} is {} N on a block that weighs {} N: it has almost no effect. It looks like kN: forces are in N, write {:e}",
            path.key("force"),
            short(force),
            short(weight),
            force * 1e3
        )
    })
}
