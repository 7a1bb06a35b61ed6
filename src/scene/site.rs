//! The earthquakes of a place, as the Italian code (NTC 2018) gives them: an elastic spectrum for
//! each limit state, and the building in which a mechanism stands above the ground.
//!
//! Numbers of the site come from its hazard study; nothing is looked up. Accelerations are in m/s².

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// The site.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Site {
    /// Spectrum of the limit state of safeguarding life (SLV).
    pub slv: Spectrum,
    /// Spectrum of the limit state of preventing collapse (SLC).
    pub slc: Option<Spectrum>,
    /// Behaviour factor of the linear check; 2 where nothing is said.
    pub q: Option<f64>,
    /// Damping of the mechanism, in percent of the critical one; 5 where nothing is said.
    pub damping_percent: Option<f64>,
    /// The building, where the mechanism stands above the ground.
    pub building: Option<Building>,
}

/// An elastic spectrum of horizontal acceleration (NTC 2018, 3.2.3.2.1). The period at which its
/// branch of constant velocity begins is given as `t_c`, or by `t_c_star` and `c_c`.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spectrum {
    /// Peak acceleration on rock, a_g, m/s².
    pub a_g: f64,
    /// Greatest amplification, F0.
    pub f_0: f64,
    /// Soil and topography, S = S_S S_T.
    pub s: f64,
    /// T_C*, s: on rock.
    pub t_c_star: Option<f64>,
    /// C_C, by which the soil lengthens T_C*.
    pub c_c: Option<f64>,
    /// T_C, s.
    pub t_c: Option<f64>,
    /// T_B, s; T_C / 3 where nothing is said.
    pub t_b: Option<f64>,
    /// T_D, s; 4 a_g / g + 1.6 where nothing is said.
    pub t_d: Option<f64>,
}

/// The building in which a mechanism stands above the ground.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Building {
    /// Period of its first mode, s.
    pub t_1: f64,
    /// Number of storeys.
    pub storeys: u32,
    /// Height of the building above its foundation, m.
    pub height: f64,
    /// Height of the mechanism's base above the foundation, m.
    pub z: f64,
    /// Damping of the building, in percent of the critical one; 5 where nothing is said.
    pub damping_percent: Option<f64>,
    /// By how much a floor amplifies at its own period, before the damping of the mechanism counts:
    /// what the Circolare writes as 1.1 ξ^−0.5. It is not computed, for the unit of ξ in it is not
    /// beyond doubt; without it the floor spectrum is known at period 0 alone.
    pub amplification: Option<f64>,
}
