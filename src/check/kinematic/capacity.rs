//! The capacity curve of a mechanism and its limit states (Circolare 7/2019, C8.7.1.2.1).
//!
//! The exact curve is followed with finite rotations, each point of it a load factor with a proof.
//! The straight line of practice runs from a0 at rest to d0, where the exact curve vanishes: a
//! convention, not a proof.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Limit states lie at these shares of d0.
pub const SLV: f64 = 0.4;
/// See [`SLV`].
pub const SLC: f64 = 0.6;

/// A limit state on a curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitState {
    /// Equivalent displacement, m.
    pub d: f64,
    /// Acceleration there, m/s².
    pub a: f64,
    /// Secant period, s.
    pub period: f64,
}

/// Both limit states on one curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct States {
    /// Safeguarding life, at 0.4 d0.
    pub slv: LimitState,
    /// Preventing collapse, at 0.6 d0.
    pub slc: LimitState,
}

/// What the capacity curve gives.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Capacity {
    /// Equivalent displacement over the way of the control point.
    pub d_over_control: f64,
    /// Acceleration at the start of the curve, m/s²: of what lasts.
    pub a0: f64,
    /// Way of the control point at which the curve vanishes, m.
    pub control_d0: f64,
    /// The equivalent displacement there, m.
    pub d0: f64,
    /// On the exact curve, whose points are proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exact: Option<States>,
    /// On the straight line from a0 to d0, a convention.
    pub straight: States,
}

fn state(d: f64, a: f64, factor: f64) -> LimitState {
    LimitState { d, a, period: factor * PI * (d / a).sqrt() }
}

/// What a curve that vanishes gives; points are ways of the control point, m, with accelerations,
/// m/s². Nothing where there are no two of them, or nothing is left to begin with.
pub fn capacity(points: &[(f64, f64)], d_over_control: f64) -> Option<Capacity> {
    let (first, last) = (points.first()?, points.last()?);
    let (a0, control_d0) = (first.1, last.0);
    if !(a0 > 0.0 && control_d0 > 0.0 && d_over_control > 0.0) {
        return None;
    }
    let d0 = d_over_control * control_d0;
    let line = |share: f64| a0 * (1.0 - share);
    let on = |share: f64| {
        let at = share * control_d0;
        let near = |p: &&(f64, f64)| (p.0 - at).abs() <= ON_THE_POINT * control_d0;
        // A jump has two points at one value: the later one is what holds from there on.
        points.iter().rev().find(near).map(|p| p.1).filter(|a| *a > 0.0)
    };
    let exact = on(SLV).zip(on(SLC)).map(|(slv, slc)| States {
        slv: state(SLV * d0, slv, 1.68),
        slc: state(SLC * d0, slc, 1.56),
    });
    let straight =
        States { slv: state(SLV * d0, line(SLV), 1.68), slc: state(SLC * d0, line(SLC), 1.56) };
    Some(Capacity { d_over_control, a0, control_d0, d0, exact, straight })
}

/// Limit states are read off points of the curve this × d0 away at most. Larger: the acceleration
/// is that of another displacement. Smaller: the search for d0, which knows it to 1e-9, hides its
/// own points.
const ON_THE_POINT: f64 = 1e-8;
