//! Load specs → one dead and one live [`Wrench`] per block, about its centre of mass.
//!
//! A load is of exactly one kind: `force` and/or `moment` on a `block` (the force `at` a point,
//! else at the centre of mass), `acceleration` a: m·a, or `weight` w: m·|g|·w. The last two act on
//! one block or on every free block, at the centre of mass.

use super::{Names, check};
use crate::assembly::{AppliedForce, Assembly, Wrench, plausible};
use base::error::{Finding, FindingCode, InputError, JsonPath};
use nalgebra::Vector3;
use scene::{
    At, DEAD, LIVE, Load, OnRoad, PushingMass, Scene,
    generate::{self, Spread},
};

/// The loads of an assembly, per block.
pub(super) struct Resolved {
    /// Dead loads, own weight included.
    pub dead: Vec<Wrench>,
    /// Live loads.
    pub live: Vec<Wrench>,
    /// Dead forces off the centre of mass, contained in `dead`.
    pub dead_forces: Vec<AppliedForce>,
    /// Live forces off the centre of mass, contained in `live`.
    pub live_forces: Vec<AppliedForce>,
    /// What of them has no effect.
    pub findings: Vec<Finding>,
}

/// A share of a load on a road beside the spans that is no rounding. Larger: a part is lost in silence.
/// Smaller: loads whose spread ends at a springing are told.
const BESIDE: f64 = 1e-9;

/// Resolves dead and live loads.
pub(super) fn resolve(
    scene: &Scene,
    assembly: &Assembly,
    names: &Names,
) -> Result<Resolved, InputError> {
    let path = JsonPath::root().key("loads");
    let factors = scene.factors()?;
    let mut dead: Vec<Wrench> =
        (0..assembly.blocks.len()).map(|i| assembly.self_weight(i)).collect();
    let mut live = vec![Wrench::zero(); assembly.blocks.len()];
    let (mut dead_forces, mut live_forces) = (Vec::new(), Vec::new());
    let mut findings = Vec::new();
    for (key, loads, sum, forces) in [
        (DEAD, &scene.loads.dead, &mut dead, &mut dead_forces),
        (LIVE, &scene.loads.live, &mut live, &mut live_forces),
    ] {
        for (i, load) in loads.iter().enumerate() {
            let path = path.key(key).index(i);
            massless(load, key == LIVE, assembly, &path)?;
            // What does not act is checked all the same.
            let factor = factors.of(load.action.as_deref(), key);
            if let Some(on) = load.road {
                let spread = on_road(load, on, scene, assembly, &path)?;
                if spread.beside > BESIDE {
                    findings.push(Finding::new(
                        FindingCode::WithoutEffect,
                        format!(
                            "{path}: {:.1} % of it acts beside the spans and is ignored",
                            100.0 * spread.beside
                        ),
                    ));
                }
                for part in spread.loads {
                    forces.extend(add((&part, factor), assembly, names, sum, &path)?);
                }
                continue;
            }
            forces.extend(add((load, factor), assembly, names, sum, &path)?);
        }
    }
    for (k, template) in scene.templates.iter().enumerate() {
        let path = JsonPath::root().key("templates").index(k);
        for load in generate::loads(template) {
            let factor = factors.of(load.action.as_deref(), DEAD);
            dead_forces.extend(add((&load, factor), assembly, names, &mut dead, &path)?);
        }
    }
    for (i, mass) in scene.loads.masses.iter().enumerate() {
        pushing(mass, assembly, names, &path.key("masses").index(i))?;
    }
    let finite = |w: &Wrench| w.force.iter().chain(&w.moment).all(|x| x.is_finite());
    if let Some(i) = (0..dead.len()).find(|&i| !finite(&dead[i]) || !finite(&live[i])) {
        return Err(InputError::at(
            path,
            format!("the load on block {:?} is too large to compute", assembly.blocks[i].id),
        )
        .hint("forces are in N, lengths in m, masses in kg"));
    }
    Ok(Resolved { dead, live, dead_forces, live_forces, findings })
}

/// Refuses `massless` where it says nothing: an earthquake pushes no other loads anyway.
fn massless(
    load: &Load,
    live: bool,
    assembly: &Assembly,
    path: &JsonPath,
) -> Result<(), InputError> {
    let down = assembly.gravity.normalize();
    let pulls = [load.force, load.acceleration, load.weight]
        .into_iter()
        .flatten()
        .any(|v| Vector3::from(v).dot(&down) > 0.0);
    if load.massless && (live || !pulls) {
        let what = if live { "a live load" } else { "a load that does not pull down" };
        return Err(InputError::at(
            path.key("massless"),
            format!("{what} has no mass in an earthquake anyway"),
        )
        .hint("remove \"massless\""));
    }
    Ok(())
}

/// Checks a mass that is pushed without resting.
fn pushing(
    mass: &PushingMass,
    assembly: &Assembly,
    names: &Names,
    path: &JsonPath,
) -> Result<(), InputError> {
    let i = names.find(&mass.block, &path.key("block"))?;
    if assembly.blocks[i].support {
        return Err(InputError::at(
            path.key("block"),
            format!("{:?} is a support: a mass on it changes nothing", mass.block),
        )
        .hint("remove the mass"));
    }
    check::vector(mass.at, &path.key("at"))?;
    check::positive(mass.mass, &path.key("mass"), "kg")?;
    plausible::mass_place(mass, &assembly.blocks[i], assembly, path)
}

/// The parts of a load on the road of a bridge.
fn on_road(
    load: &Load,
    on: OnRoad,
    scene: &Scene,
    assembly: &Assembly,
    path: &JsonPath,
) -> Result<Spread, InputError> {
    let here = path.key("road");
    if load.block.is_some() || load.at.is_some() || load.arm {
        return Err(InputError::at(
            here,
            "already places the load: it cannot be combined with \"block\", \"at\" or \"arm\"",
        )
        .hint("remove \"block\", \"at\" and \"arm\""));
    }
    if load.moment.is_some() || load.acceleration.is_some() || load.weight.is_some() {
        return Err(InputError::at(here, "only a force can act on a road").hint("give \"force\""));
    }
    let Some(force) = load.force else {
        return Err(InputError::at(path.clone(), "the load on the road has no force")
            .hint("add \"force\": [0, 0, -10000], in N"));
    };
    let force = check::vector(force, &path.key("force"))?;
    let down = assembly.gravity.normalize();
    if !(force.dot(&down) > 0.0 && (force - down * force.dot(&down)).norm() <= 1e-9 * force.norm())
    {
        return Err(InputError::at(path.key("force"), "a load on a road must act downward")
            .hint("give a horizontal force as a load on a block"));
    }
    if !on.x.is_finite() {
        return Err(InputError::at(here.key("x"), "must be a finite number").hint("in m"));
    }
    check::positive(on.patch, &here.key("patch"), "m")?;
    if let Some(across) = on.across {
        check::positive(across, &here.key("across"), "m")?;
    }
    let found = scene.templates.iter().find_map(|t| generate::on_road(t, on, force.into()));
    found.ok_or_else(|| {
        let bridges = scene.templates.iter().any(|t| t.name() == "bridge");
        let text = format!("no bridge has its road at x = {}", on.x);
        InputError::at(here.key("x"), text).hint(if bridges {
            "give a place between the springings"
        } else {
            "a load on a road needs a template \"bridge\"; give others a \"block\" and \"at\""
        })
    })
}

/// Adds a factor × one load to `sum`; returns its force where that acts off the centre of mass.
fn add(
    (load, factor): (&Load, f64),
    assembly: &Assembly,
    names: &Names,
    sum: &mut [Wrench],
    path: &JsonPath,
) -> Result<Option<AppliedForce>, InputError> {
    let block = load.block.as_ref().map(|id| names.find(id, &path.key("block"))).transpose()?;
    if let Some(id) =
        load.block.as_ref().filter(|_| block.is_some_and(|i| assembly.blocks[i].support))
    {
        return Err(InputError::at(
            path.key("block"),
            format!("{id:?} is a support: a load on it changes nothing"),
        )
        .hint("remove the load"));
    }
    let given = |key: &str, value: Option<[f64; 3]>| {
        value.map(|v| check::vector(v, &path.key(key))).transpose()
    };
    let (force, moment) = (given("force", load.force)?, given("moment", load.moment)?);
    let (acceleration, weight) =
        (given("acceleration", load.acceleration)?, given("weight", load.weight)?);

    let by_force = force.is_some() || moment.is_some();
    match (by_force, acceleration, weight) {
        (false, None, None) => {
            return Err(InputError::at(path.clone(), "the load has no value")
                .hint("add \"force\", \"moment\", \"acceleration\" or \"weight\""));
        }
        (true, None, None) | (false, Some(_), None) | (false, None, Some(_)) => {}
        _ => {
            return Err(InputError::at(
                path.clone(),
                "one load mixes force or moment, acceleration, and weight",
            )
            .hint("make a load of each"));
        }
    }
    if [force, moment, acceleration, weight].into_iter().flatten().all(|v| v == Vector3::zeros()) {
        return Err(
            InputError::at(path.clone(), "the load is zero: it has no effect").hint("remove it")
        );
    }
    if load.at.is_some() && force.is_none() {
        return Err(
            InputError::at(path.key("at"), "only a force can act at a point").hint("remove \"at\"")
        );
    }

    if load.arm && !matches!(load.at, Some(At::Point(_))) {
        return Err(InputError::at(
            path.key("arm"),
            "only a force at a given point can have an arm",
        )
        .hint("remove \"arm\", or give \"at\""));
    }

    if by_force {
        let Some(i) = block else {
            return Err(InputError::at(path.clone(), "the force or moment has no block to act on")
                .hint("add \"block\": id"));
        };
        let force = force.unwrap_or_default() * factor;
        let arm = match load.at {
            None | Some(At::Centroid(_)) => Vector3::zeros(),
            Some(At::Point(point)) => {
                let point = check::vector(point, &path.key("at"))?;
                plausible::place(load, &assembly.blocks[i], assembly, path)?;
                point - assembly.blocks[i].centroid
            }
        };
        sum[i] += Wrench { force, moment: moment.unwrap_or_default() * factor + arm.cross(&force) };
        let is_eccentric = arm != Vector3::zeros() && factor != 0.0;
        return Ok(is_eccentric.then_some(AppliedForce { block: i, force, arm }));
    }
    let loaded: Vec<usize> = block.map_or_else(|| assembly.free().collect(), |i| vec![i]);
    for i in loaded {
        // Exactly one of the two is there.
        let mass = assembly.characteristic_mass(i) * factor;
        let by_acceleration = acceleration.map(|a| a * mass);
        let by_weight = weight.map(|w| w * (mass * assembly.gravity.norm()));
        sum[i] += Wrench {
            force: by_acceleration.or(by_weight).unwrap_or_default(),
            moment: Vector3::zeros(),
        };
    }
    Ok(None)
}
