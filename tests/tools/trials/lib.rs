//! Trials of the whole on random scenes. Numbers of scenes depend on a seed and their own number alone,
//! so that what was found can be looked at again.
//!
//! * [`soak`]: verdicts held against their certificates, against omissions and, of a sample, against
//!   simulations;
//! * [`edges`]: blocks that meet at edges and corners, held against the same with flats there;
//! * [`alike`]: each scene beside its mirror image, a larger, a moved and a renamed one, every question;
//! * [`cross`]: each scene asked in several ways that must give one answer;
//! * [`forge`]: results changed into false ones, all of which must be refused;
//! * [`slopes`]: derivatives of load factors, held against differences;
//! * [`fuzz`]: inputs of every reader changed at random.

#![forbid(unsafe_code)]

pub mod alike;
pub mod cross;
pub mod edges;
pub mod forge;
pub mod fuzz;
mod random;
pub mod slopes;
pub mod soak;
