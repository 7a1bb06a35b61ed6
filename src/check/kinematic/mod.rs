//! Mechanisms under earthquakes, as Italian practice takes them (NTC 2018; Circolare 21 January
//! 2019 n. 7, C8.7.1.2.1): from the mechanism that limit analysis proves worst to the mass that
//! takes part, the acceleration at which it starts, its capacity curve and what a site demands of
//! it.
//!
//! All of it is arithmetic on what is proved elsewhere: the load factor α0 with its mechanism, and
//! the points of the curve. Names are those of the Circolare: weights `P` rest on the blocks and
//! are pushed by an earthquake, `Q` are pushed only, `δ` is the horizontal virtual displacement of
//! the point where a weight acts (of a block its centre of mass), `FC` the factor of confidence.
//!
//! | | |
//! |---|---|
//! | share of the mass that takes part | `e* = (Σ(P+Q)δ)² / (Σ(P+Q) Σ(P+Q)δ²)` |
//! | mass that takes part | `M* = e* Σ(P+Q) / g` |
//! | acceleration | `a = α g / (e* FC)` |
//! | equivalent displacement | `d = d_C Σ(P+Q)δ² / (δ_C Σ(P+Q)δ)`, C the control point |
//! | limit states | `d_SLV = 0.4 d0`, `d_SLC = 0.6 d0`, d0 where the curve vanishes |
//! | secant periods | `T_SLV = 1.68 π √(d_SLV / a(d_SLV))`, `T_SLC = 1.56 π √(d_SLC / a(d_SLC))` |
//!
//! Sums go over the masses of the blocks that move: what rests is no part of the mechanism.

mod capacity;
mod demand;
mod mass;
mod participation;
mod spectrum;
mod tells;

pub use capacity::{Capacity, LimitState, SLC, SLV, States, capacity};
pub use demand::{Check, Demand, demand};
pub use mass::{Mass, MassKind, Quake, oblique, quake, without_members};
pub use participation::{Participation, STILL, Share, control_point, same_motion, way_of};
pub use spectrum::{DAMPING, Elastic, Floor};
pub use tells::{Unique, is_unique};

pub use crate::question::CONFIDENCE;
