//! Scene → assembly → interfaces, timed.

use super::axes;
use crate::{
    assembly::{self, Assembly},
    error::{Finding, FindingCode, InputError},
    interface::{self, Interface, Interfaces},
    program,
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
    /// Running the scene in time.
    pub simulate: f64,
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
    /// An assembly with its interfaces as they were detected; adds what they say together.
    pub fn new(assembly: Assembly, mut interfaces: Interfaces) -> Self {
        interfaces.findings.extend(floating(&assembly, &interfaces));
        interfaces.findings.extend(without_effect(&interfaces));
        interfaces.findings.extend(axes::slip(&assembly, &interfaces));
        Self { assembly, interfaces, timings: Timings::default() }
    }

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
/// The scene cannot be resolved, or its contacts cannot be found.
pub fn prepare(scene: &Scene) -> Result<Model, InputError> {
    let start = Instant::now();
    let assembly = assembly::resolve(scene)?;
    let resolve = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let interfaces = interface::detect(&assembly)?;
    let mut model = Model::new(assembly, interfaces);
    model.timings = Timings { resolve, detect: start.elapsed().as_secs_f64(), ..Timings::default() };
    Ok(model)
}

/// Says which free blocks nothing holds.
fn floating(assembly: &Assembly, interfaces: &Interfaces) -> Option<Finding> {
    const NAMED: usize = 8;
    let loose: Vec<&str> = program::floating(assembly, interfaces).into_iter().flatten().map(|i| assembly.blocks[i].id.as_str()).collect();
    let more = loose.len().saturating_sub(NAMED);
    let names = loose[..loose.len() - more].join(", ");
    let text = match (loose.len(), more) {
        (0, _) => return None,
        (1, _) => format!("a free block touches nothing that is held: {names}"),
        (n, 0) => format!("{n} free blocks have no contact path to a support: {names}"),
        (n, more) => format!("{n} free blocks have no contact path to a support: {names} and {more} more"),
    };
    Some(Finding::new(FindingCode::Floating, text))
}

/// Says what joints are given that their contacts cannot use: stresses need an area, a rolling arm an edge or a point.
fn without_effect(interfaces: &Interfaces) -> Vec<Finding> {
    let count = |unused: &dyn Fn(&Interface) -> bool| interfaces.list.iter().filter(|f| unused(f)).count();
    let faces = count(&|f| f.law.rolling_arm > 0.0 && f.rolling_arm() == 0.0);
    let lines = count(&|f| f.points.len() < 3 && !f.law.friction_only());
    let mut findings = Vec::new();
    if faces > 0 {
        findings.push(format!(
            "{faces} contacts on faces have a rolling arm: not used there, for the corners of a face carry couples by themselves"
        ));
    }
    if lines > 0 {
        findings.push(format!(
            "{lines} contacts at edges or points have a strength, cohesion or pore pressure: not used there, for they have no area"
        ));
    }
    findings.into_iter().map(|text| Finding::new(FindingCode::WithoutEffect, text)).collect()
}
