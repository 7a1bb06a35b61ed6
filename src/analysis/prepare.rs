//! Scene → assembly → interfaces, timed.

use crate::{
    assembly::{self, Assembly},
    error::{Finding, InputError},
    interface::{self, Interfaces},
    scene::Scene,
};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Seconds per stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Timings {
    /// Reading the file.
    pub read: f64,
    /// Resolving the scene.
    pub resolve: f64,
    /// Finding the interfaces.
    pub detect: f64,
    /// Building and solving programs, certificates included.
    pub solve: f64,
    /// Verifying the answer from the scene once more before it is given.
    pub check: f64,
}

/// A scene made ready for questions.
#[derive(Clone, Debug)]
pub struct Model {
    /// The blocks and loads.
    pub assembly: Assembly,
    /// The contacts.
    pub interfaces: Interfaces,
    /// Seconds per stage so far.
    pub timings: Timings,
}

impl Model {
    /// Findings of every stage so far.
    pub fn findings(&self) -> impl Iterator<Item = &Finding> {
        self.assembly.findings.iter().chain(&self.interfaces.findings)
    }

    /// Contact points of all interfaces.
    pub fn contact_points(&self) -> usize {
        self.interfaces.list.iter().map(|f| f.points.len()).sum()
    }
}

/// Resolves a scene and finds its interfaces.
///
/// # Errors
/// The scene cannot be resolved, or two blocks touch without a known friction.
pub fn prepare(scene: &Scene) -> Result<Model, InputError> {
    let start = Instant::now();
    let assembly = assembly::resolve(scene)?;
    let resolve = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let interfaces = interface::detect(&assembly)?;
    let detect = start.elapsed().as_secs_f64();
    Ok(Model { assembly, interfaces, timings: Timings { resolve, detect, ..Timings::default() } })
}
