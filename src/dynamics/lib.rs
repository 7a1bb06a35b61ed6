//! What happens in time: the same assembly run by a rigid-body engine, as a second opinion that
//! knows nothing of programs and solvers.
//!
//! The engine (rapier) integrates Newton's law with Coulomb friction at contacts that are very
//! slightly soft. It proves nothing: near a critical parameter it may err (see [`Fidelity`]), and
//! it shows one history, that of loads which act from one moment on without any self-stress. *Its
//! error grows with the number of blocks in a row*, because its contact forces come out of a fixed
//! number of iterations.
//!
//! A block has fallen when it moved by more than [`FALLEN`] of its thickness and still moves; the
//! scene stands when every block came to rest within [`SETTLED`]; in between the settings are
//! refined, and then it stays undecided.
//!
//! Joints resist by friction, by their rolling arm, and by the water in them, which pushes as it
//! does at the start. Members act as springs as stiff as a step allows, cut at their bounds; a scene
//! with dowels or fingers is not run. Cohesion, tensile and compressive strength are left out, which
//! the outcome's findings say.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod bodies;
mod cell;
mod clock;
pub mod granular;
mod members;
mod outcome;
mod pieces;
mod rapier;
mod refused;
mod rolling;
mod run;
mod units;

pub use check::terms::{Fate, Fidelity, Run, Stop};
pub use outcome::{FirstMotion, Frame, MeanContact, Pose, SimulationOutcome};
pub use run::{
    BlockMotion, Burden, Carriage, CarriedAlong, Shaken, ShakenFate, Shaking, SupportWay, beyond,
    carry, shake, simulate,
};

#[cfg(doc)]
use base::tolerance::{FALLEN, SETTLED};

/// The first motion is read where some block moved by this × its thickness. Larger: blocks have met
/// new neighbours on the way. Smaller: settling on soft contacts hides the motion.
pub const FIRST_MOTION: f64 = 0.01;

/// What the caller may change about a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationSettings {
    /// One kind of run only; by default a fast one, and a fine one unless that shows that it
    /// stands.
    pub fidelity: Option<Fidelity>,
    /// Time to simulate at most, s; by default 10 √(H/g), H the height of the scene, and at least
    /// 10 √(L/g), L the median block size.
    pub seconds: Option<f64>,
    /// Threads of the engine. The answer does not depend on them, bit by bit.
    pub threads: usize,
    /// Frames to take over the horizon, evenly spread, the first at the start; 0 for none.
    pub frames: usize,
    /// Keep the frames in the outcome; whoever watches sees them anyway.
    pub keep_frames: bool,
    /// Simulate to the horizon although the outcome is clear.
    pub to_the_end: bool,
    /// Show every step to whoever watches ([`Progress::moment`]).
    pub every_step: bool,
}

impl Default for SimulationSettings {
    fn default() -> Self {
        Self {
            fidelity: None,
            seconds: None,
            threads: 1,
            frames: 0,
            keep_frames: true,
            to_the_end: false,
            every_step: false,
        }
    }
}

/// How far a simulation is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress<'a> {
    /// Settings of the run.
    pub fidelity: Fidelity,
    /// Time simulated, s.
    pub time: f64,
    /// Time allowed, s.
    pub horizon: f64,
    /// Largest displacement over the block's thickness so far.
    pub relative: f64,
    /// A frame that has just been taken.
    pub frame: Option<&'a Frame>,
    /// Where everything is now, if every step was asked for.
    pub moment: Option<&'a Frame>,
}
