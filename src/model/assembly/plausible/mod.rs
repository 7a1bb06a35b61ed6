//! Numbers that look like mistakes: of units, of axes, of places. Findings only, each with the
//! probable mistake and the remedy, for there are grains and there are cliffs; what is refused (a
//! load far off its block) is refused where the load is resolved.
//!
//! One number alone is rarely proof: a density of 24 is foam, a compressive strength of 5 Pa
//! somebody's unit problem. So real weights are asked for first, under Earth's gravity and with
//! densities of stone, and a scene in units of its own (a density of exactly 1, unit gravity) is
//! left alone. Which way supports face can be judged only where contacts are known:
//! `analysis::prepare` says that.

mod blocks;
mod bounds;
mod bridges;
mod joints;
mod loads;
mod members;
mod site;
mod told;

pub(super) use loads::{mass_place, place};
pub(super) use members::{members, point};

use crate::assembly::Assembly;
use base::error::{Finding, FindingCode};
use scene::Scene;
use told::{Told, Weights, density, first, free, is_on_earth, median, short};

/// What looks like a mistake in a resolved scene.
pub(super) fn mistakes(scene: &Scene, assembly: &Assembly) -> Vec<Finding> {
    let units =
        blocks::mistakes(scene, assembly).into_iter().chain(joints::mistakes(scene, assembly));
    let units = units.chain(site::mistakes(scene)).chain(bridges::mistakes(scene, assembly));
    let units = units.map(|text| Finding::new(FindingCode::Units, text));
    units
        .chain(
            loads::mistakes(scene, assembly)
                .into_iter()
                .chain(bridges::not_crossed(scene))
                .map(|text| Finding::new(FindingCode::Loads, text)),
        )
        .collect()
}
