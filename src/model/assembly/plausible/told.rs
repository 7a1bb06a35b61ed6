//! What every guess at a mistake is told with.

use super::{
    super::{Assembly, Block},
    bounds,
};

/// Mistakes of several kinds, each with the first place where it is: ten thousand loads in another
/// unit are one finding.
#[derive(Default)]
pub(super) struct Told(pub Vec<(&'static str, String, usize)>);

impl Told {
    pub fn add(&mut self, kind: &'static str, text: impl FnOnce() -> String) {
        match self.0.iter_mut().find(|told| told.0 == kind) {
            Some(told) => told.2 += 1,
            None => self.0.push((kind, text(), 0)),
        }
    }

    pub fn texts(self, noun: &str) -> Vec<String> {
        let text = |(_, text, more): (_, String, usize)| {
            if more > 0 { format!("{text} (and {more} more {noun})") } else { text }
        };
        self.0.into_iter().map(text).collect()
    }
}

/// Density of a block, kg/m³.
pub(super) fn density(block: &Block) -> f64 {
    block.mass / block.solid.volume()
}

/// The free blocks.
pub(super) fn free(assembly: &Assembly) -> impl Iterator<Item = &Block> {
    assembly.blocks.iter().filter(|b| !b.support)
}

/// Whether the scene is in SI units and of this world as far as one can tell: Earth's gravity, and
/// no density of exactly 1.
pub(super) fn is_on_earth(assembly: &Assembly) -> bool {
    /// Mass over volume gives a density back up to rounding.
    const ROUNDING: f64 = 1e-9;
    bounds::EARTH.contains(&assembly.gravity.norm())
        && !free(assembly).any(|b| (density(b) - 1.0).abs() < ROUNDING)
}

/// What the median free block weighs per volume (N/m³) and measures (m), where all free blocks are
/// as heavy as things that are built.
pub(super) struct Weights {
    pub volume: f64,
    pub size: f64,
}

impl Weights {
    pub fn of(assembly: &Assembly) -> Option<Self> {
        if !is_on_earth(assembly) || !free(assembly).all(|b| bounds::SOLID.contains(&density(b))) {
            return None;
        }
        let density = median(free(assembly).map(density))?;
        Some(Self {
            volume: density * assembly.gravity.norm(),
            size: median(free(assembly).map(|b| b.size))?,
        })
    }
}

/// The lower median.
pub(super) fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len().checked_sub(1)? / 2).copied()
}

/// The first block whose value is `odd`, with the value and the number of the others.
pub(super) fn first<'a>(
    blocks: impl Iterator<Item = &'a Block>,
    value: impl Fn(&Block) -> f64,
    odd: impl Fn(f64) -> bool,
) -> Option<(&'a Block, f64, String)> {
    let mut hits = blocks.map(|b| (b, value(b))).filter(|&(_, v)| odd(v));
    let (block, value) = hits.next()?;
    let count = hits.count();
    Some((block, value, others(count)))
}

/// How many there are beside the one that is named.
pub(super) fn others(count: usize) -> String {
    if count > 0 { format!(" (and {count} more)") } else { String::new() }
}

/// A number in few digits, as one writes it.
pub(super) fn short(value: f64) -> String {
    let value = if value.is_finite() && value != 0.0 {
        format!("{value:.3e}").parse().unwrap_or(value)
    } else {
        value
    };
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}
