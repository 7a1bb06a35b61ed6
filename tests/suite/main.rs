//! One integration binary: tests by behaviour.

mod ask;

mod agreement;
mod analytic;
mod bad_input;
mod certificates;
mod cli;
mod coulomb;
mod determinism;
mod dynamics;
mod grains;
mod invariance;
mod layering;
mod published;
mod readme;
mod real;
mod reference;
mod scenes;
mod strength;
