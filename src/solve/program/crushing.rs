//! Joints that can crush, as a program has them.

use super::bearing::Bearing;
use model::{
    interface::Interfaces,
    strength::{
        crushing::{Cut, crushes, edge_bounds},
        tension,
    },
};

/// A joint with a compressive strength.
#[derive(Clone, Debug)]
pub struct CrushingJoint {
    /// Index of the interface.
    pub interface: usize,
    /// Compressive and tensile strength together, Pa: normal forces count from the tensile strength
    /// on.
    pub(super) strength: f64,
    /// Area, m².
    pub(super) area: f64,
    /// Its bearings.
    pub(super) bearings: std::ops::Range<usize>,
    /// Greatest width, m, and distances of the bearings, m, for each edge.
    pub(super) edges: Vec<(f64, Vec<f64>)>,
    /// Weight of each bearing and capacity of the linear bounds so far.
    pub(super) cuts: Vec<(Vec<f64>, f64)>,
}

impl CrushingJoint {
    /// Adds a linear bound.
    pub(super) fn add(&mut self, cut: &Cut, bearings: &[Bearing]) {
        let weights =
            bearings[self.bearings.clone()].iter().map(|b| b.mean(&cut.weights)).collect();
        self.cuts.push((weights, cut.capacity));
    }
}

/// The joints of a program that have a compressive strength.
pub(super) fn sections(interfaces: &Interfaces, bearings: &[Bearing]) -> Vec<CrushingJoint> {
    let mut sections = Vec::new();
    let mut first = 0;
    for (interface, face) in interfaces.list.iter().enumerate() {
        let count = bearings[first..].iter().take_while(|b| b.interface == interface).count();
        let own = first..first + count;
        first += count;
        if !crushes(face) {
            continue;
        }
        let edges = edge_bounds(face).into_iter();
        let edges = edges
            .map(|(width, d)| (width, bearings[own.clone()].iter().map(|b| b.mean(&d)).collect()))
            .collect();
        let strength = face.law.compression + tension(face);
        sections.push(CrushingJoint {
            interface,
            strength,
            area: face.area,
            bearings: own,
            edges,
            cuts: Vec::new(),
        });
    }
    sections
}
