//! One integration binary: tests by behaviour.

mod ask;

mod agreement;
mod analytic;
mod bad_input;
mod certificates;
mod cli;
mod coulomb;
mod critical;
mod determinism;
mod dynamics;
mod extreme;
mod grains;
mod granular;
mod invariance;
mod layering;
mod published;
mod readme;
mod real;
mod reference;
mod scenes;
mod strength;
mod sweep;
mod thrust;
