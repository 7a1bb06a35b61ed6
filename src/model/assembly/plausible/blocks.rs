//! Gravity, densities and sizes.

use super::{
    bounds, bounds::DensityUnit, density, first, free, is_on_earth, median, short, told::others,
};
use crate::assembly::{Assembly, Block};
use scene::Scene;
use std::collections::HashSet;

/// What looks like a mistake in them.
pub(super) fn mistakes(scene: &Scene, assembly: &Assembly) -> Vec<String> {
    let sizes = [large(assembly), small(assembly), odd(assembly)];
    [gravity(assembly), densities(scene, assembly), turned(scene)]
        .into_iter()
        .chain(sizes)
        .flatten()
        .collect()
}

fn gravity(assembly: &Assembly) -> Option<String> {
    let g = assembly.gravity.norm();
    if bounds::GRAVITY_IN_FEET.contains(&g) {
        return Some(format!(
            "Gravity is {} m/s², which is that of Earth in ft/s²: write [0, 0, -9.81], with lengths in m",
            short(g)
        ));
    }
    (!bounds::GRAVITY.contains(&g))
        .then(|| format!("Gravity is {g:.3e} m/s²; on Earth it is 9.81. Are the units m and s?"))
}

/// Densities and masses. A mass that is heavy for the size of its block may be one of something else
/// than stone; in tonnes it is far too light.
fn densities(scene: &Scene, assembly: &Assembly) -> Option<String> {
    if !is_on_earth(assembly) {
        return None;
    }
    let weighed: HashSet<&str> =
        scene.blocks.iter().filter(|b| b.mass.is_some()).map(|b| b.id.as_str()).collect();
    let is_weighed = |b: &Block| weighed.contains(b.id.as_str());
    let unit = |b: &Block| {
        let mut units = bounds::DENSITY_UNITS.iter();
        let known = |u: &&DensityUnit| u.window.contains(&density(b));
        units.find(|u| known(u) && (!is_weighed(b) || u.kilograms == bounds::TONNE))
    };
    // What was drawn by lot, or scaled for a trial, has densities of all kinds; a mistake has those
    // of stone in one other unit.
    if let Some((block, unit)) = free(assembly).find_map(|b| Some((b, unit(b)?)))
        && free(assembly)
            .map(density)
            .all(|d| unit.window.contains(&d) || bounds::SOLID.contains(&d))
    {
        let (value, all) = (density(block), free(assembly).filter(|b| unit_of(b, unit)));
        let others = others(all.count() - 1);
        return Some(match is_weighed(block) {
            true => format!(
                "Block {:?}{others} has a mass of {} kg, {} kg/m³ of its volume, where stone has 1200 to 3300. It looks like t: masses are in kg, write {}",
                block.id,
                short(block.mass),
                short(value),
                short(block.mass * unit.kilograms)
            ),
            false => format!(
                "Block {:?}{others} has a density of {} kg/m³, where stone has 1200 to 3300. It looks like {}: densities are in kg/m³, write {:.0}",
                block.id,
                short(value),
                unit.name,
                value * unit.kilograms
            ),
        });
    }
    // In a problem with units of its own, weights that are not quite 1 and masses over nine decades
    // are what somebody chose.
    let given = || free(assembly).filter(|b| !is_weighed(b));
    let (block, value, others) = first(given(), density, |d| !bounds::DENSITY.contains(&d))?;
    Some(format!(
        "Block {:?}{others} has a density of {value:.3e} kg/m³; stone has about 2400. Is it in kg/m³ (not t/m³ or g/cm³), and are lengths in m?",
        block.id
    ))
}

/// Whether a block has a density of stone in this unit.
fn unit_of(block: &Block, unit: &DensityUnit) -> bool {
    unit.window.contains(&density(block))
}

/// Rotations in radians: all of them are, or none.
fn turned(scene: &Scene) -> Option<String> {
    let turns = || {
        let angles = scene.blocks.iter().filter_map(|b| Some((b, b.rotation_deg.as_ref()?.angle)));
        angles.filter(|a| a.1 != 0.0)
    };
    let round =
        |angle: f64| (angle.to_degrees() / bounds::ROUND_DEGREES).round() * bounds::ROUND_DEGREES;
    let is_radians = |angle: f64| {
        angle.abs() <= std::f64::consts::TAU
            && round(angle) != 0.0
            && (angle.to_degrees() - round(angle)).abs() <= bounds::ROUND_WITHIN
    };
    let (block, angle) = turns().next()?;
    let others = others(turns().count() - 1);
    turns().all(|t| is_radians(t.1)).then(|| {
        format!(
            "Block {:?}{others} is rotated by {}°, which is {}° in radians: \"rotation_deg\" takes degrees, write {}",
            block.id,
            short(angle),
            round(angle),
            round(angle)
        )
    })
}

/// Everything in millimetres, centimetres or inches.
fn large(assembly: &Assembly) -> Option<String> {
    let many = free(assembly).count() >= bounds::MANY;
    let size = median(free(assembly).map(|b| b.size))?;
    let beyond = size > if many { bounds::LARGE_OF_MANY } else { bounds::LARGE };
    let unit = if many && bounds::CENTIMETRES.contains(&size) {
        "centimetres (--scale 0.01) or inches (--scale 0.0254)"
    } else if !beyond || !bounds::SIZE.contains(&size) {
        return None;
    } else if size <= bounds::LARGE_IN_CENTIMETRES {
        "millimetres (--scale 0.001) or centimetres (--scale 0.01)"
    } else {
        "millimetres (--scale 0.001)"
    };
    let (block, value, others) = first(free(assembly), |b| b.size, |s| s >= size)?;
    Some(format!(
        "Block {:?}{others} measures {} m across, where stones have 0.1 to 10. It looks like {unit}: lengths are in m; \
         import with that scale, or give a mesh that \"scale\"",
        block.id,
        short(value)
    ))
}

/// Beyond what anybody models.
fn small(assembly: &Assembly) -> Option<String> {
    let (block, value, others) = first(free(assembly), |b| b.size, |s| !bounds::SIZE.contains(&s))?;
    Some(format!("Block {:?}{others} measures {value:.3e} m across. Are lengths in m?", block.id))
}

/// One block in another unit than the others.
fn odd(assembly: &Assembly) -> Option<String> {
    let free: Vec<_> = free(assembly).collect();
    let size = median(free.iter().map(|b| b.size))?;
    if free.len() >= bounds::SEVERAL
        && let Some((block, value, others)) = first(
            free.iter().copied(),
            |b| b.size,
            |s| bounds::IN_MILLIMETRES_AMONG_METRES.contains(&(s / size)),
        )
    {
        return Some(format!(
            "Block {:?}{others} measures {} m across, the median of the free blocks {}. It looks like millimetres among metres: give its mesh \
             \"scale\": 0.001",
            block.id,
            short(value),
            short(size)
        ));
    }
    let mut sizes: Vec<f64> = assembly.blocks.iter().map(|b| b.size).collect();
    sizes.sort_by(f64::total_cmp);
    // The lower and the upper median: of two blocks neither is the odd one, and neither hides
    // behind itself.
    let (low, high) = (sizes[(sizes.len() - 1) / 2], sizes[sizes.len() / 2]);
    let odd = |s: f64| s >= bounds::SIZE_RATIO * low || s * bounds::SIZE_RATIO <= high;
    let (block, value, others) = first(assembly.blocks.iter(), |b| b.size, odd)?;
    let median = if value > high { low } else { high };
    Some(format!(
        "Block {:?}{others} measures {value:.3e} m across, the median of all blocks {median:.3e} m. Are all lengths in the same unit, m?",
        block.id
    ))
}
