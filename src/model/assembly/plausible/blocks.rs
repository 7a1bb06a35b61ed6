//! Gravity, densities and sizes.

use super::{bounds, density, first, free, is_on_earth, median, short};
use crate::assembly::Assembly;

/// What looks like a mistake in them.
pub(super) fn mistakes(assembly: &Assembly) -> Vec<String> {
    [gravity(assembly), densities(assembly), large(assembly), small(assembly), odd(assembly)]
        .into_iter()
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

fn densities(assembly: &Assembly) -> Option<String> {
    let unit = |d: f64| bounds::DENSITY_UNITS.iter().find(|u| u.window.contains(&d));
    // What was drawn by lot, or scaled for a trial, has densities of all kinds; a mistake has those
    // of stone in one other unit.
    if is_on_earth(assembly)
        && let Some((block, value, others)) = first(free(assembly), density, |d| unit(d).is_some())
        && let Some(unit) = unit(value)
        && free(assembly)
            .map(density)
            .all(|d| unit.window.contains(&d) || bounds::SOLID.contains(&d))
    {
        return Some(format!(
            "Block {:?}{others} has a density of {} kg/m³, where stone has 1200 to 3300. It looks like {}: densities are in kg/m³, write {:.0}",
            block.id,
            short(value),
            unit.name,
            value * unit.kilograms
        ));
    }
    // In a problem with units of its own, weights that are not quite 1 and masses over nine decades
    // are what somebody chose.
    let odd = |d: f64| !bounds::DENSITY.contains(&d) && is_on_earth(assembly);
    let (block, value, others) = first(free(assembly), density, odd)?;
    Some(format!(
        "Block {:?}{others} has a density of {value:.3e} kg/m³; stone has about 2400. Is it in kg/m³ (not t/m³ or g/cm³), and are lengths in m?",
        block.id
    ))
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
