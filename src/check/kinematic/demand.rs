//! What the earthquakes of a site demand of a mechanism (Circolare 7/2019, C8.7.1.2.1).
//!
//! Ratios are accelerations that are met over those demanded. With the periods of the ground's
//! spectrum held, all of it is proportional to a_g, so that the ratio is also the share of the
//! demanded a_g that is met.

use super::{
    capacity::{LimitState, States},
    spectrum::{DAMPING, Elastic, Floor},
};
use crate::question::Verification;
use scene::Site;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::f64::consts::TAU;

/// One check: what is met over what is demanded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Check {
    /// What is compared, with its formula.
    pub what: String,
    /// What the mechanism has, m/s² or m.
    pub capacity: f64,
    /// What is demanded, in the same unit.
    pub demand: f64,
    /// Capacity over demand.
    pub ratio: f64,
}

/// What the site demands.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Demand {
    /// The least ratio of all checks.
    pub ratio: f64,
    /// The least ratio of the linear checks: a0 against accelerations over q.
    pub linear: f64,
    /// The least ratio of the checks of displacements, on the exact curve and on the straight line.
    pub displacement: Option<f64>,
    /// The checks.
    pub checks: Vec<Check>,
    /// γ1 of the building, where there is one.
    pub gamma_1: Option<f64>,
    /// a_Z, m/s²: the acceleration of the floor, where there is a building; of SLV.
    pub a_z: Option<f64>,
    /// What is not checked, and why.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
}

impl Demand {
    /// The ratio of the verification that governs, the least of both where none is chosen; nothing
    /// where it was not made.
    pub fn governing(&self, by: Option<Verification>) -> Option<f64> {
        match by {
            None => Some(self.ratio),
            Some(Verification::Linear) => Some(self.linear),
            Some(Verification::Displacement) => self.displacement,
        }
    }
}

fn check(what: String, capacity: f64, demand: f64) -> Check {
    Check { what, capacity, demand, ratio: capacity / demand }
}

/// The checks of a mechanism that starts at `a0`, m/s², with the limit states of its curves where
/// there are any: (their name, both states).
pub fn demand(site: &Site, a0: f64, curves: &[(&str, States)], gravity: f64) -> Demand {
    let q = site.q.unwrap_or(2.0);
    let xi = site.damping_percent.unwrap_or(DAMPING);
    let ground = Elastic::new(&site.slv, gravity);
    let (mut checks, mut left_out) = (Vec::new(), Vec::new());
    let linear = "linear SLV, on the ground: a0 ≥ a_g S / q";
    checks.push(check(format!("{linear}, q = {q}"), a0, ground.ground / q));
    let floor = site.building.as_ref().map(|b| Floor::new(b, &ground));
    // At the foundation itself no floor moves against the ground.
    if let Some(floor) = floor.as_ref().filter(|f| f.a_z > 0.0) {
        checks.push(check(
            format!("linear SLV, on the floor: a0 ≥ a_Z / q, q = {q}"),
            a0,
            floor.a_z / q,
        ));
    }
    let linear_checks = checks.len();
    let slc = site.slc.as_ref().map(|s| ("SLC", Elastic::new(s, gravity)));
    let spectra: Vec<_> = [("SLV", ground)].into_iter().chain(slc).collect();
    if curves.is_empty() {
        left_out.push(
            "displacements: no curve reaches both limit states, or none was computed (--linear)"
                .into(),
        );
    }
    for (curve, states) in curves {
        for (word, spectrum) in &spectra {
            let state = if *word == "SLV" { states.slv } else { states.slc };
            let LimitState { d, period, .. } = state;
            checks.push(check(
                format!("{word} by the {curve}, on the ground: d ≥ S_e(T, ξ) (T/2π)², ξ = {xi} %"),
                d,
                spectrum.displacement(period, xi),
            ));
            let above = site.building.as_ref().map(|b| Floor::new(b, spectrum));
            let above = above.filter(|f| f.a_z > 0.0);
            let above = above.and_then(|f| f.acceleration(period, xi, spectrum));
            checks.extend(above.map(|a| {
                let what = format!(
                    "{word} by the {curve}, on the floor: d ≥ S_eZ(T, ξ) (T/2π)², ξ = {xi} %"
                );
                check(what, d, a * (period / TAU).powi(2))
            }));
        }
    }
    if site.slc.is_none() {
        left_out.push("SLC: the site has no spectrum for it".into());
    }
    if site.building.as_ref().is_some_and(|b| b.amplification.is_none()) {
        left_out.push("the floor spectrum beyond period 0: the factor 1.1 ξ^-0.5 of C7.2.3 is below 1 with ξ in percent, as the text has it, and above 4 with ξ as a fraction. Give \"amplification\" in the building of the site, from the code that applies".into());
    }
    let least = |list: &[Check]| list.iter().map(|c| c.ratio).fold(f64::INFINITY, f64::min);
    let (first, rest) = checks.split_at(linear_checks);
    let displacement = (!rest.is_empty()).then(|| least(rest));
    Demand {
        ratio: least(&checks),
        linear: least(first),
        displacement,
        gamma_1: floor.map(|f| f.gamma),
        a_z: floor.map(|f| f.a_z),
        checks,
        left_out,
    }
}
