//! What a simulation says.

use base::error::Finding;
use check::terms::{Fate, Fidelity, Run};
use nalgebra::{UnitQuaternion, Vector3};

/// The motion of a block from the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstMotion {
    /// Way of the centre of mass, m.
    pub way: Vector3<f64>,
    /// Rotation vector, radians.
    pub turn: Vector3<f64>,
}

/// The contact force between two blocks: mean over the last step, on `b`, N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanContact {
    /// Index of the first block, `a < b`.
    pub a: usize,
    /// Index of the second block.
    pub b: usize,
    /// Force on `b`, N.
    pub force: Vector3<f64>,
    /// Sum of the normal parts, N.
    pub normal_force: f64,
}

/// Where every block is at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// s.
    pub time: f64,
    /// Settings of the run it belongs to.
    pub fidelity: Fidelity,
    /// Largest displacement so far over the block's thickness.
    pub relative: f64,
    /// Kinetic energy of all blocks, J.
    pub energy: f64,
    /// Centre of mass (m), orientation, velocity (m/s) and spin (rad/s) of each block, in scene
    /// order.
    pub blocks: Vec<Pose>,
}

/// Where a block is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Centre of mass, m.
    pub center: Vector3<f64>,
    /// Rotation from the start.
    pub turn: UnitQuaternion<f64>,
    /// Velocity of the centre of mass, m/s.
    pub velocity: Vector3<f64>,
    /// Spin, rad/s.
    pub spin: Vector3<f64>,
}

/// The answer of [`simulate`](super::simulate).
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationOutcome {
    /// What became of it, by the last run.
    pub fate: Fate,
    /// When the first block had fallen, s.
    pub collapse: Option<f64>,
    /// The runs, the decisive one last.
    pub runs: Vec<Run>,
    /// The motion from the start to where some block first moved by
    /// [`FIRST_MOTION`](super::FIRST_MOTION) × its thickness; empty where none did.
    pub first_motion: Vec<FirstMotion>,
    /// Contact forces at the end, by pairs of blocks.
    pub contacts: Vec<MeanContact>,
    /// What is left when the contact forces on the supports and all loads are added up, over the
    /// sum of the loads' sizes: 0 at rest.
    pub reaction_error: f64,
    /// The frames that were asked for.
    pub frames: Vec<Frame>,
    /// What the simulation could not respect.
    pub findings: Vec<Finding>,
}
