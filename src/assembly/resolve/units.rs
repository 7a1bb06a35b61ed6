//! Numbers that look like a slip of units by a thousand or more. Findings only: there are grains and there are cliffs.

use crate::{
    assembly::{Assembly, Block},
    error::{Finding, FindingCode},
    tolerance::{SLIP_DENSITY, SLIP_GRAVITY, SLIP_SIZE, SLIP_SIZE_RATIO},
};

/// What looks like a slip of units.
pub(super) fn slips(assembly: &Assembly) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut tell = |text: String| findings.push(Finding::new(FindingCode::Units, text));

    let g = assembly.gravity.norm();
    if !SLIP_GRAVITY.contains(&g) {
        tell(format!("Gravity is {g:.3e} m/s²; on Earth it is 9.81. Are the units m and s?"));
    }

    let blocks = &assembly.blocks;
    let density = |b: &Block| b.mass / b.solid.volume();
    if let Some((block, value, others)) = first(blocks.iter().filter(|b| !b.support), density, |d| !SLIP_DENSITY.contains(&d)) {
        tell(format!(
            "Block {:?}{others} has a density of {value:.3e} kg/m³; stone has about 2400. Is it in kg/m³ (not t/m³ or g/cm³), and are lengths in m?",
            block.id
        ));
    }
    if let Some((block, value, others)) = first(blocks.iter(), |b| b.size, |s| !SLIP_SIZE.contains(&s)) {
        tell(format!("Block {:?}{others} measures {value:.3e} m across. Are lengths in m?", block.id));
    }

    let mut sizes: Vec<f64> = blocks.iter().map(|b| b.size).collect();
    sizes.sort_by(f64::total_cmp);
    // The lower and the upper median: of two blocks neither is the odd one, and neither hides behind itself.
    let (low, high) = (sizes[(sizes.len() - 1) / 2], sizes[sizes.len() / 2]);
    let odd = |s: f64| s >= SLIP_SIZE_RATIO * low || s * SLIP_SIZE_RATIO <= high;
    if let Some((block, value, others)) = first(blocks.iter(), |b| b.size, odd) {
        let median = if value > high { low } else { high };
        tell(format!(
            "Block {:?}{others} measures {value:.3e} m across, the median of all blocks {median:.3e} m. Are all lengths in the same unit, m?",
            block.id
        ));
    }
    findings
}

/// The first block whose value is `odd`, with the value and the number of the others.
fn first<'a>(
    blocks: impl Iterator<Item = &'a Block>,
    value: impl Fn(&Block) -> f64,
    odd: impl Fn(f64) -> bool,
) -> Option<(&'a Block, f64, String)> {
    let mut hits = blocks.map(|b| (b, value(b))).filter(|&(_, v)| odd(v));
    let (block, value) = hits.next()?;
    let count = hits.count();
    Some((block, value, if count > 0 { format!(" (and {count} more)") } else { String::new() }))
}
