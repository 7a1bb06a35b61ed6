//! At which scales of a motion of the ground a machine overturns. More shaking may be less harmful
//! (bands: Zhang & Makris, J. Eng. Mech. 127, 2001, 473–483), so that scales are scanned before they
//! are halved, and two flips nearer to each other than the scan's step stay unseen.

use super::{Fate, Machine, RunSettings, run};
use crate::ground::Motion;

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// From this scale.
    pub from: f64,
    /// To this one.
    pub to: f64,
    /// In so many steps.
    pub steps: usize,
    /// Brackets are narrowed to this × the scale.
    pub width: f64,
}

/// Two scales with different fates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    /// The lower one.
    pub lower: f64,
    /// The upper one.
    pub upper: f64,
    /// Whether it overturns at the upper one (and stands at the lower one), or the other way round.
    pub overturns_above: bool,
}

impl Bracket {
    /// The scale at which it overturns.
    pub fn overturns_at(&self) -> f64 {
        if self.overturns_above { self.upper } else { self.lower }
    }

    /// The scale at which it stands.
    pub fn stands_at(&self) -> f64 {
        if self.overturns_above { self.lower } else { self.upper }
    }
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// The scales that were run, with the number of impacts before it overturned; none where it
    /// stood.
    pub seen: Vec<(f64, Option<usize>)>,
    /// Where the fate flips.
    pub flips: Vec<Bracket>,
}

/// Scans scales and narrows every flip down by halving.
pub fn scan(machine: &Machine, motion: &Motion, settings: &RunSettings, search: &Search) -> Scan {
    let fate = |scale: f64| {
        let settings = RunSettings { keep: false, fate_only: true, ..settings.clone() };
        let history = run(machine, &motion.scaled(scale), &settings);
        matches!(history.fate, Fate::Overturns { .. }).then_some(history.impacts.len())
    };
    let steps = search.steps.max(1);
    let at = |k: usize| search.from + (search.to - search.from) * k as f64 / steps as f64;
    let seen: Vec<(f64, Option<usize>)> = (0..=steps).map(|k| (at(k), fate(at(k)))).collect();
    let flips = seen
        .windows(2)
        .filter(|pair| pair[0].1.is_some() != pair[1].1.is_some())
        .map(|pair| {
            let overturns_above = pair[1].1.is_some();
            let (mut lower, mut upper) = (pair[0].0, pair[1].0);
            while upper - lower > search.width * upper.abs() {
                let middle = 0.5 * (lower + upper);
                if !(lower < middle && middle < upper) {
                    break;
                }
                if fate(middle).is_some() == overturns_above {
                    upper = middle
                } else {
                    lower = middle
                }
            }
            Bracket { lower, upper, overturns_above }
        })
        .collect();
    Scan { seen, flips }
}
