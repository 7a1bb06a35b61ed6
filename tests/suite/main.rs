//! One integration binary: tests by behaviour.

// A test ends where something is not as it should be, in its helpers too.
#![allow(clippy::expect_used, clippy::panic, clippy::unreachable, clippy::unwrap_used)]

/// Says that a test could not be run here, and why. `.ci/run` names a file, and prints at its end how
/// many there were.
fn skipped(why: &str) {
    use std::io::Write;
    let test = std::thread::current().name().unwrap_or_default().to_string();
    eprintln!("skipped: {test}: {why}");
    if let Some(path) = std::env::var_os("VOUSSOIR_SKIPPED") {
        let mut file = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        writeln!(file, "{test}: {why}").unwrap();
    }
}

mod ask;

mod agreement;
mod analytic;
mod bad_input;
mod bridge;
mod browser;
mod certificates;
mod cli;
mod combinations;
mod coulomb;
mod cracks;
mod critical;
mod determinism;
mod doubts;
mod drawings;
mod dry;
mod dynamics;
mod edges;
mod experiments;
mod extreme;
#[cfg(target_os = "linux")]
mod faults;
mod findings;
mod flows;
mod gallery;
mod grains;
mod granular;
mod ground;
mod hostile;
mod implied;
mod invariance;
mod kinematic;
mod large;
mod layering;
mod live;
mod members;
mod mesh_files;
mod meshes;
mod mistakes;
mod page;
mod parts;
mod path;
mod path_in_time;
mod path_members;
mod path_slides;
mod pictures;
mod piles;
mod published;
mod readme;
mod real;
mod recheck;
mod record;
mod reference;
mod rocking;
mod same;
mod scenes;
mod schema;
mod sensitivity;
mod shaken;
mod stage_order;
mod stages;
mod state;
mod state_members;
mod strength;
mod sweep;
mod symmetry;
mod templates;
mod thrust;
mod train;
mod without;
mod words;
