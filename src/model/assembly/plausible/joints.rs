//! Friction and strengths of joints, as the scene gives them.

use super::{Told, Weights, bounds, free, short};
use crate::assembly::Assembly;
use base::error::JsonPath;
use scene::{Friction, JointSpec, Scene};

/// What looks like a mistake in them.
pub(super) fn mistakes(scene: &Scene, assembly: &Assembly) -> Vec<String> {
    let path = JsonPath::root().key("joints");
    let weights = Weights::of(assembly);
    let largest = free(assembly).map(|b| b.size).fold(0.0, f64::max);
    let mut told = Told::default();
    look(&scene.joints.default, &path.key("default"), weights.as_ref(), largest, &mut told);
    for (i, rule) in scene.joints.overrides.iter().enumerate() {
        look(&rule.spec(), &path.key("overrides").index(i), weights.as_ref(), largest, &mut told);
    }
    if weights.is_some() {
        for (name, material) in &scene.materials {
            let path = JsonPath::root().key("materials").key(name.as_str()).key("young");
            if let Some(text) = material.young.and_then(|e| young(e, &path)) {
                told.add("young", || text);
            }
        }
    }
    told.texts("joint rules")
}

fn look(
    spec: &JointSpec,
    path: &JsonPath,
    weights: Option<&Weights>,
    largest: f64,
    told: &mut Told,
) {
    let mut tell = |kind: &'static str, text: Option<String>| {
        if let Some(text) = text {
            told.add(kind, || text);
        }
    };
    tell("friction", spec.friction.and_then(|f| coefficient(f, path)));
    tell("friction_angle_deg", spec.friction_angle_deg.and_then(|a| angle(a, path)));
    if let Some(weights) = weights {
        tell("compression", spec.compression.and_then(|s| compression(s, path, weights)));
        tell("cohesion", spec.cohesion.and_then(|s| bond("cohesion", s, path, weights)));
        tell("tension", spec.tension.and_then(|s| bond("tension", s, path, weights)));
        for (key, value) in
            [("normal_stiffness", spec.normal_stiffness), ("shear_stiffness", spec.shear_stiffness)]
        {
            tell(key, value.and_then(|k| stiffness(key, k, path, weights)));
        }
        tell("pore_pressure", spec.pore_pressure.and_then(|p| pressure(p, path, weights)));
    }
    // An arm longer than the block itself would hold a ball on a wall.
    let arm = spec.rolling_arm.filter(|&arm| arm > largest).map(|arm| {
        let path = path.key("rolling_arm");
        let (arm, largest) = (short(arm), short(largest));
        format!("{path} is {arm} m, more than the largest block measures ({largest} m). It looks like millimetres: it is a length in m")
    });
    tell("rolling_arm", arm);
}

fn coefficient(friction: Friction, path: &JsonPath) -> Option<String> {
    let mu = friction.mu();
    bounds::FRICTION_IN_DEGREES.contains(&mu).then(|| {
        format!(
            "{} is {}, where stone on stone has 0.3 to 1.2. It looks like degrees: write \"friction_angle_deg\": {mu} (a coefficient of {:.2}), or \
             \"infinite\" for no sliding",
            path.key("friction"),
            short(mu),
            mu.to_radians().tan()
        )
    })
}

fn angle(degrees: f64, path: &JsonPath) -> Option<String> {
    bounds::ANGLE_IN_RADIANS.contains(&degrees).then(|| {
        format!(
            "{} is {} degrees, less than ice has. It looks like radians ({:.1}°) or a coefficient (\"friction\": {degrees}, {:.1}°): write degrees",
            path.key("friction_angle_deg"),
            short(degrees),
            degrees.to_degrees(),
            degrees.atan().to_degrees()
        )
    })
}

fn compression(strength: f64, path: &JsonPath, weights: &Weights) -> Option<String> {
    let column = strength / weights.volume;
    if column >= bounds::LEAST_COLUMN {
        return None;
    }
    let (unit, factor) =
        unit(strength, bounds::COMPRESSION_IN_MEGAPASCALS, bounds::COMPRESSION_IN_KILOPASCALS)?;
    Some(format!(
        "{} is {} Pa: a column of this stone {} m high crushes under its own weight. It looks like {unit}: strengths are in Pa, write {:e}",
        path.key("compression"),
        short(strength),
        short(column),
        strength * factor
    ))
}

fn bond(key: &str, strength: f64, path: &JsonPath, weights: &Weights) -> Option<String> {
    let share = strength / (weights.volume * weights.size);
    if share >= bounds::LEAST_BOND {
        return None;
    }
    let (unit, factor) = unit(strength, bounds::BOND_IN_MEGAPASCALS, bounds::BOND_IN_KILOPASCALS)?;
    Some(format!(
        "{} is {} Pa, {} of what a block weighs on its area: it has almost no effect. It looks like {unit}: strengths are in Pa, write {:e}",
        path.key(key),
        short(strength),
        short(share),
        strength * factor
    ))
}

fn pressure(pressure: f64, path: &JsonPath, weights: &Weights) -> Option<String> {
    let small = pressure < bounds::LEAST_BOND * weights.volume * weights.size;
    (small && bounds::PORE_IN_KILOPASCALS.contains(&pressure)).then(|| {
        format!(
            "{} is {} Pa, that of {} mm of water. It looks like kPa: pressures are in Pa, one metre of water is 9810; write {:e}",
            path.key("pore_pressure"),
            short(pressure),
            short(pressure / 9.81),
            pressure * 1e3
        )
    })
}

fn stiffness(key: &str, stiffness: f64, path: &JsonPath, weights: &Weights) -> Option<String> {
    let closes = weights.volume * weights.size / stiffness;
    if closes <= bounds::GREATEST_CLOSING * weights.size {
        return None;
    }
    let (unit, factor) = if bounds::STIFFNESS_IN_NEWTONS_PER_MM3.contains(&stiffness) {
        ("N/mm³ (MPa/mm)", 1e9)
    } else if bounds::STIFFNESS_IN_MEGAPASCALS_PER_M.contains(&stiffness) {
        ("MPa/m", 1e6)
    } else {
        return None;
    };
    Some(format!(
        "{} is {} Pa/m: under the weight of one block the joint closes by {} m. It looks like {unit}: stiffnesses are in Pa/m, write {:e}",
        path.key(key),
        short(stiffness),
        short(closes),
        stiffness * factor
    ))
}

fn young(young: f64, path: &JsonPath) -> Option<String> {
    let (unit, factor) = if bounds::YOUNG_IN_GIGAPASCALS.contains(&young) {
        ("GPa", 1e9)
    } else if bounds::YOUNG_IN_MEGAPASCALS.contains(&young) {
        ("MPa (N/mm²)", 1e6)
    } else {
        return None;
    };
    Some(format!(
        "{path} is {} Pa, softer than any building material. It looks like {unit}: moduli are in Pa, write {:e}",
        short(young),
        young * factor
    ))
}

/// The unit that a stress was written in, and how many Pa it is.
fn unit(
    stress: f64,
    mega: std::ops::RangeInclusive<f64>,
    kilo: std::ops::RangeInclusive<f64>,
) -> Option<(&'static str, f64)> {
    if mega.contains(&stress) {
        Some(("MPa (N/mm²)", 1e6))
    } else {
        kilo.contains(&stress).then_some(("kPa (kN/m²)", 1e3))
    }
}
