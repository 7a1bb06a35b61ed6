//! One integration binary: tests by behaviour.

mod ask;

mod analytic;
mod cli;
mod coulomb;
mod published;
mod readme;
mod reference;
mod scenes;
